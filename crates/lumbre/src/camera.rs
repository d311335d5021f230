//! Which camera a picture is taken with.

use crate::backend::{Backend, RenderError};
#[cfg(feature = "files")]
use crate::info::CameraInfo;
use glam::{Affine3A, Mat4, Vec3};
use lumbre_core::camera::{Camera, Projection};
use lumbre_core::film::Film;
use lumbre_core::filter::FilterKind;
use lumbre_core::math::{atan2, sin_cos, tan};
use lumbre_core::settings::{RenderSettings, View};
use lumbre_scene::{CompiledScene, Projection as Authored, Scene};
use std::fmt;

/// Vertical field of view where nothing says otherwise, radians (45°).
pub const DEFAULT_FOV: f32 = core::f32::consts::FRAC_PI_4;

/// Which camera of the scene.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub enum CameraChoice {
    /// The first one; the whole scene in view if there is none.
    #[default]
    Default,
    /// By its place among those of the scene, from 0.
    Index(usize),
    /// By the name of the camera or of its node.
    Name(String),
}

/// How far the lens is open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aperture {
    /// Diameter of the lens, metres.
    Diameter(f32),
    /// Focal length over diameter, on a camera whose sensor is [`SENSOR_HEIGHT`] high. No meaning without perspective.
    FNumber(f32),
}

impl fmt::Display for Aperture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Aperture::Diameter(metres) => metres.fmt(f),
            Aperture::FNumber(n) => write!(f, "f/{n}"),
        }
    }
}

/// What is sharp.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Focus {
    /// What lies in the centre of the picture: [`focus_distance`] finds it once there is a backend. Until then what is 1 m away.
    #[default]
    Auto,
    /// Distance along the direction of view, metres.
    Distance(f32),
}

impl fmt::Display for Focus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Focus::Auto => f.write_str("auto"),
            Focus::Distance(metres) => metres.fmt(f),
        }
    }
}

/// Height of the sensor that f-numbers are meant for, metres: that of 35 mm film in landscape.
pub const SENSOR_HEIGHT: f32 = 0.024;

/// What the caller wants to see.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct CameraOptions {
    /// Which of the scene's cameras.
    pub choice: CameraChoice,
    /// Eye; replaces the camera's place.
    pub look_from: Option<Vec3>,
    /// Point in the centre of the picture; replaces the camera's direction.
    pub look_at: Option<Vec3>,
    /// What is up in the picture; `None`: +y, or as the scene's camera is turned where nothing else turns it.
    pub up: Option<Vec3>,
    /// Vertical field of view, radians. It makes an orthographic camera a perspective one.
    pub fov: Option<f32>,
    /// Height of what an orthographic camera sees, metres; without meaning for perspective.
    pub height: Option<f32>,
    /// How far the lens is open; `None`: as the scene says, which is closed for all formats that are read.
    pub aperture: Option<Aperture>,
    /// What is sharp, if there is an aperture.
    pub focus: Focus,
}

/// A camera that was found, and where it came from.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundCamera {
    /// The camera.
    pub camera: Camera,
    /// The scene had none, so the whole of it was put in view.
    pub framed: bool,
}

/// The camera asked for is not in the scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no camera {wanted}; the scene has {}", list(.available))]
pub struct NoSuchCamera {
    /// What was asked for.
    pub wanted: String,
    /// Names of what there is.
    pub available: Vec<String>,
}

fn list(names: &[String]) -> String {
    if names.is_empty() { "none".into() } else { names.join(", ") }
}

/// A camera of the scene with its place in the world and its names.
struct Placed<'a> {
    camera: &'a lumbre_scene::Camera,
    to_world: Mat4,
    names: [&'a str; 2],
}

fn placed(scene: &Scene) -> Vec<Placed<'_>> {
    let nodes = scene.world_nodes().into_iter();
    nodes
        .filter_map(|(id, to_world)| {
            let node = &scene.nodes[id.index()];
            let camera = scene.cameras.get(node.camera?.index())?;
            Some(Placed { camera, to_world, names: [&camera.name, &node.name] })
        })
        .collect()
}

/// Names of the cameras of a scene in order: that of the camera, else of its node, else its number.
pub fn camera_names(scene: &Scene) -> Vec<String> {
    let name = |(i, p): (usize, Placed<'_>)| {
        p.names.into_iter().find(|n| !n.is_empty()).map_or_else(|| i.to_string(), str::to_string)
    };
    placed(scene).into_iter().enumerate().map(name).collect()
}

/// What there is to know about the cameras of a scene, in order.
#[cfg(feature = "files")]
pub(crate) fn infos(scene: &Scene) -> Vec<CameraInfo> {
    let one = |p: Placed<'_>| CameraInfo {
        name: p.names.into_iter().find(|n| !n.is_empty()).unwrap_or_default().to_string(),
        projection: p.camera.projection,
        position: p.to_world.w_axis.truncate(),
    };
    placed(scene).into_iter().map(one).collect()
}

/// The camera that was chosen; `None`: the default one of a scene that has none.
fn chosen<'a, 's>(
    scene: &Scene,
    cameras: &'a [Placed<'s>],
    choice: &CameraChoice,
) -> Result<Option<&'a Placed<'s>>, NoSuchCamera> {
    let missing = |wanted: String| NoSuchCamera { wanted, available: camera_names(scene) };
    match choice {
        CameraChoice::Default => Ok(cameras.first()),
        CameraChoice::Index(i) => cameras.get(*i).map(Some).ok_or_else(|| missing(i.to_string())),
        CameraChoice::Name(name) => {
            let found = cameras.iter().find(|c| c.names.contains(&name.as_str()));
            found.map(Some).ok_or_else(|| missing(format!("{name:?}")))
        }
    }
}

/// Width over height as the author of the chosen camera framed it; `None` where nothing usable is said.
///
/// # Errors
/// If there is no such camera.
pub fn authored_aspect(scene: &Scene, choice: &CameraChoice) -> Result<Option<f32>, NoSuchCamera> {
    let cameras = placed(scene);
    let Some(camera) = chosen(scene, &cameras, choice)? else { return Ok(None) };
    Ok(framed_aspect(&camera.camera.projection))
}

/// Width over height that a projection was framed for.
fn framed_aspect(projection: &Authored) -> Option<f32> {
    let aspect = match *projection {
        Authored::Perspective { aspect, .. } => aspect,
        Authored::Orthographic { xmag, ymag } => Some(xmag / ymag),
    };
    aspect.filter(|a| a.is_finite() && *a > 0.0)
}

/// Finds or makes the camera for a picture of this aspect (width over height).
pub fn find_camera(
    scene: &Scene,
    compiled: &CompiledScene,
    options: &CameraOptions,
    aspect: f32,
) -> Result<FoundCamera, NoSuchCamera> {
    let cameras = placed(scene);
    let (base, framed) = match chosen(scene, &cameras, &options.choice)? {
        Some(p) => (from_scene(p, options, aspect), false),
        None => (frame(compiled, options.fov.unwrap_or(DEFAULT_FOV), aspect), true),
    };
    let camera = with_lens(aimed(base, options), options);
    Ok(FoundCamera { camera, framed: framed && options.look_from.is_none() })
}

/// The authored camera. A picture wider than the author framed keeps the height of the view, a narrower one its width, so that
/// nothing the author showed is cut off.
fn from_scene(p: &Placed<'_>, options: &CameraOptions, aspect: f32) -> Camera {
    let fov = options.fov;
    let mut projection = match (fov, p.camera.projection) {
        (Some(fov), _) => Projection::perspective(fov),
        (None, Authored::Perspective { yfov, .. }) => Projection::perspective(yfov),
        (None, Authored::Orthographic { ymag, .. }) => Projection::Orthographic { half_height: ymag },
    };
    if let (Some(authored), None) = (framed_aspect(&p.camera.projection), fov) {
        projection = projection.scaled((authored / aspect).max(1.0));
    }
    if let (Projection::Orthographic { half_height }, Some(height)) = (&mut projection, options.height) {
        *half_height = 0.5 * height;
    }
    let mut camera = Camera::from_transform(Affine3A::from_mat4(p.to_world), projection, aspect);
    camera.lens_radius = p.camera.lens_radius;
    camera.focus_distance = p.camera.focus_distance;
    camera
}

/// Moves and turns a camera as the caller asked.
fn aimed(base: Camera, options: &CameraOptions) -> Camera {
    if options.look_from.is_none() && options.look_at.is_none() && options.up.is_none() {
        return base;
    }
    let eye = options.look_from.unwrap_or(base.origin);
    let target = options.look_at.unwrap_or(eye + base.forward);
    let turned = Camera::look_at(eye, target, options.up.unwrap_or(Vec3::Y), 1.0, base.aspect);
    Camera {
        projection: base.projection,
        lens_radius: base.lens_radius,
        focus_distance: base.focus_distance,
        ..turned
    }
}

/// Opens the lens as the caller asked. An f-number means nothing to parallel rays and leaves it closed.
fn with_lens(mut camera: Camera, options: &CameraOptions) -> Camera {
    if let Some(aperture) = options.aperture {
        camera.lens_radius = match (aperture, camera.projection) {
            (Aperture::Diameter(metres), _) => 0.5 * metres,
            // Focused far away, the sensor stands one focal length behind the lens.
            (Aperture::FNumber(n), Projection::Perspective { tan_half_fov_y }) => {
                0.5 * (0.5 * SENSOR_HEIGHT / tan_half_fov_y) / n
            }
            (Aperture::FNumber(_), Projection::Orthographic { .. }) => 0.0,
        };
    }
    if let Focus::Distance(metres) = options.focus {
        camera.focus_distance = metres;
    }
    camera
}

/// Rays that look for the distance: where coverage is stochastic they may differ.
const FOCUS_RAYS: u32 = 9;
/// How much smaller than the picture the spot is that they look at.
const FOCUS_SPOT: f32 = 1e-3;

/// Distance along the direction of view of what lies at `at` in the picture (the unit square, y down), metres; `None` where
/// nothing does. The median of a few rays; works on any backend.
///
/// # Errors
/// If the device fails.
pub fn focus_distance(backend: &dyn Backend, view: &View, at: [f32; 2]) -> Result<Option<f32>, RenderError> {
    let camera = &view.camera;
    let towards = Camera { lens_radius: 0.0, ..*camera }.ray(at, [0.5; 2], 0.0);
    let spot = Camera {
        origin: towards.origin,
        forward: towards.dir,
        right: camera.right,
        up: camera.right.cross(towards.dir).normalize_or(camera.up),
        projection: camera.projection.scaled(FOCUS_SPOT),
        lens_radius: 0.0,
        ..*camera
    };
    let settings = RenderSettings { max_depth: Some(0), filter: FilterKind::Box, ..view.settings };
    let view = View { camera: spot, settings, frame: 0 };
    let distance = |index: u32| {
        let mut film = Film::new(1, 1);
        backend.render(&view, index..index + 1, &mut film, &())?;
        Ok(film.pixel(0, 0).depth())
    };
    let mut found: Vec<f32> = (0..FOCUS_RAYS).map(distance).collect::<Result<_, _>>()?;
    found.retain(|d| d.is_finite());
    found.sort_by(f32::total_cmp);
    let along = towards.dir.dot(camera.forward);
    Ok(found.get(found.len() / 2).map(|d| d * along).filter(|d| *d > 0.0))
}

/// The whole scene in view, from its front (+z), a little from the right and from above.
fn frame(compiled: &CompiledScene, fov: f32, aspect: f32) -> Camera {
    let [min, max] = compiled.bounds.map(Vec3::from_array);
    let (centre, radius) =
        if min.cmpgt(max).any() { (Vec3::ZERO, 1.0) } else { (0.5 * (min + max), compiled.radius()) };
    let half = (0.5 * fov).min(atan2(tan(0.5 * fov) * aspect, 1.0));
    let distance = radius.max(1e-4) / sin_cos(half).0;
    let ((se, ce), (sa, ca)) = (sin_cos(0.30), sin_cos(0.45));
    let eye = centre + Vec3::new(ce * sa, se, ce * ca) * distance;
    Camera::look_at(eye, centre, Vec3::Y, fov, aspect)
}
