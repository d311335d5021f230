//! Flags on where the picture is taken from.

use super::values::{fov, joined, vec3};
use crate::exit::Failure;
use clap::Args;
use lumbre::core::math::Vec3;
use lumbre::{CameraChoice, CameraOptions};

/// The camera.
#[derive(Args, Debug)]
#[command(next_help_heading = "Camera")]
pub(crate) struct CameraArgs {
    /// Which of the scene's cameras: its name, that of its node, or its number from 0. [default: the first; the whole scene
    /// in view if there is none]
    #[arg(long, value_name = "NAME|INDEX", value_parser = choice)]
    pub(crate) camera: Option<CameraChoice>,

    /// Puts the eye here, metres.
    #[arg(long, value_name = "X,Y,Z", value_parser = vec3, allow_hyphen_values = true)]
    pub(crate) look_from: Option<Vec3>,

    /// Turns the camera to this point, metres.
    #[arg(long, value_name = "X,Y,Z", value_parser = vec3, allow_hyphen_values = true)]
    pub(crate) look_at: Option<Vec3>,

    /// Vertical field of view, degrees. An orthographic camera becomes a perspective one.
    #[arg(long, value_name = "DEG", value_parser = fov, allow_hyphen_values = true)]
    pub(crate) fov: Option<f32>,
}

impl CameraArgs {
    /// The same in the library's terms.
    pub(crate) fn options(&self) -> Result<CameraOptions, Failure> {
        if self.look_from.is_some() && self.look_from == self.look_at {
            return Err(Failure::usage(
                "--look-from and --look-at are the same point: there is no direction",
            ));
        }
        Ok(CameraOptions {
            choice: self.camera.clone().unwrap_or_default(),
            look_from: self.look_from,
            look_at: self.look_at,
            fov: self.fov.map(f32::to_radians),
        })
    }

    /// Names and values of the flags that were given, for the metadata of a file.
    pub(crate) fn described(&self) -> Vec<(&'static str, String)> {
        let camera = self.camera.as_ref().and_then(|c| match c {
            CameraChoice::Default => None,
            CameraChoice::Index(i) => Some(i.to_string()),
            CameraChoice::Name(name) => Some(name.clone()),
        });
        let point = |p: Vec3| joined(&p.to_array());
        let all = [
            ("camera", camera),
            ("lookFrom", self.look_from.map(point)),
            ("lookAt", self.look_at.map(point)),
            ("fov", self.fov.map(|f| f.to_string())),
        ];
        all.into_iter().filter_map(|(name, value)| Some((name, value?))).collect()
    }
}

fn choice(text: &str) -> Result<CameraChoice, String> {
    match text {
        "" => Err("expected a name or a number".into()),
        _ => Ok(text.parse().map_or_else(|_| CameraChoice::Name(text.into()), CameraChoice::Index)),
    }
}
