//! The table of the camera, and of bookmarks: which of the file's cameras, and what is changed of it.

use super::EditsError;
use super::param::{Access, Changes, HUGE, Param, field, number, or};
use super::value::{Kind, Value};
use crate::camera::{Aperture, CameraChoice, CameraOptions, Focus};
use glam::Vec3;
use lumbre_core::camera::{Camera, Projection};
use lumbre_core::math::atan2;

/// A camera as people speak of it.
#[derive(Clone, Debug)]
pub(super) struct Shot {
    camera: String,
    eye: Vec3,
    target: Vec3,
    up: Vec3,
    fov_deg: f32,
    /// Of what parallel rays see, metres.
    height: f32,
    is_parallel: bool,
    aperture: Value,
    focus: Value,
}

impl From<&Camera> for Shot {
    /// What it looks at is what is in focus, as far as is known.
    fn from(camera: &Camera) -> Self {
        let fov_deg = match camera.projection {
            Projection::Perspective { tan_half_fov_y } => 2.0 * atan2(tan_half_fov_y, 1.0).to_degrees(),
            Projection::Orthographic { .. } => crate::camera::DEFAULT_FOV.to_degrees(),
        };
        let (height, is_parallel) = match camera.projection {
            Projection::Perspective { .. } => (1.0, false),
            Projection::Orthographic { half_height } => (2.0 * half_height, true),
        };
        let open = camera.lens_radius > 0.0;
        Shot {
            camera: String::new(),
            eye: camera.origin,
            target: camera.origin + camera.forward * camera.focus_distance,
            up: camera.up,
            fov_deg,
            height,
            is_parallel,
            aperture: if open { Value::Number(2.0 * camera.lens_radius) } else { Value::Word("off") },
            focus: if open { Value::Number(camera.focus_distance) } else { Value::Word("auto") },
        }
    }
}

const POINT: Kind = Kind::Vector { unit: "m", range: [-HUGE, HUGE] };

type One = Param<Shot>;

/// All parameters of the camera.
pub(super) const SHOT: &[One] = &[
    One::new(
        "camera",
        "Camera of the file",
        Kind::Camera,
        Access {
            get: |s| Value::Text(s.camera.clone()),
            set: |s, v| s.camera = v.as_text().unwrap_or_default().to_owned(),
        },
    ),
    One::new("eye", "Eye", POINT, field!(vector eye)),
    One::new("target", "Looks at", POINT, field!(vector target)),
    One::new("up", "Up", Kind::Vector { unit: "", range: [-HUGE, HUGE] }, field!(vector up)),
    One::new("fov", "Field of view", number([0.001, 179.9], [5.0, 120.0], "°"), field!(number fov_deg)),
    One::new(
        "height",
        "Height of the view",
        Kind::Number { range: [1e-6, 1e9], slider: [0.1, 1e3], log: true, unit: "m", words: &[] },
        field!(number height),
    )
    .when(|s| s.is_parallel),
    One::new(
        "aperture",
        "Aperture",
        Kind::Aperture,
        Access { get: |s| s.aperture.clone(), set: |s, v| s.aperture = v.clone() },
    ),
    One::new(
        "focus",
        "Focus",
        or(
            Kind::Number { range: [1e-4, 1e9], slider: [0.1, 1e3], log: true, unit: "m", words: &[] },
            &["auto"],
        ),
        Access { get: |s| s.focus.clone(), set: |s, v| s.focus = v.clone() },
    )
    .when(|s| s.aperture != Value::Word("off")),
];

/// Which of the file's cameras a text means: a number is one, all else a name.
pub(super) fn choice(text: &str) -> CameraChoice {
    text.parse().map_or_else(|_| CameraChoice::Name(text.into()), CameraChoice::Index)
}

impl Changes {
    /// Sets a parameter of a camera.
    pub(super) fn set_shot(&mut self, name: &str, value: Value) -> Result<(), EditsError> {
        let mut changed = self.clone();
        changed.insert(SHOT, name, value)?;
        changed.check_shot()?;
        *self = changed;
        Ok(())
    }

    /// A camera that stands where it looks has no direction.
    pub(super) fn check_shot(&self) -> Result<(), EditsError> {
        if self.get("eye").is_some() && self.get("eye") == self.get("target") {
            let reason = "eye and target are the same point: there is no direction";
            return Err(EditsError::new("target", reason));
        }
        Ok(())
    }

    /// Stands here and looks there, both at once: what else is changed of the camera stays.
    ///
    /// # Errors
    /// If a number is not finite or beyond what the tables take, or both are the same point.
    pub fn look(&mut self, eye: Vec3, target: Vec3) -> Result<(), EditsError> {
        let mut changed = self.clone();
        changed.remove("target");
        changed.set_shot("eye", Value::Vector(eye))?;
        changed.set_shot("target", Value::Vector(target))?;
        *self = changed;
        Ok(())
    }

    /// These changes of a camera, in the terms of [`crate::find_camera`].
    pub fn camera_options(&self) -> CameraOptions {
        let vector = |name| self.get(name).and_then(Value::as_vector);
        CameraOptions {
            choice: self.get("camera").and_then(Value::as_text).map_or(CameraChoice::Default, choice),
            look_from: vector("eye"),
            look_at: vector("target"),
            up: vector("up"),
            fov: self.get("fov").and_then(Value::as_number).map(f32::to_radians),
            height: self.get("height").and_then(Value::as_number),
            aperture: self.get("aperture").map(|v| match v {
                Value::FNumber(n) => Aperture::FNumber(*n),
                other => Aperture::Diameter(other.as_number().unwrap_or(0.0)),
            }),
            focus: self.get("focus").and_then(Value::as_number).map_or(Focus::Auto, Focus::Distance),
        }
    }
}
