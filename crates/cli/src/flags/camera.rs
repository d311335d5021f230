//! Flags on where the picture is taken from.

use super::values::{fov, vec3};
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

    /// Vertical field of view, degrees.
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
}

fn choice(text: &str) -> Result<CameraChoice, String> {
    match text {
        "" => Err("expected a name or a number".into()),
        _ => Ok(text.parse().map_or_else(|_| CameraChoice::Name(text.into()), CameraChoice::Index)),
    }
}
