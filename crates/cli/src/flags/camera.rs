//! Flags on where the picture is taken from.

use super::values::{aperture, crop, focus, fov, joined, vec3};
use crate::exit::Failure;
use clap::Args;
use lumbre::core::film::Crop;
use lumbre::core::math::Vec3;
use lumbre::edits::Edits;
use lumbre::{Aperture, CameraChoice, CameraOptions, Focus};

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

    /// Opens the lens, so that only what is in focus is sharp: `f/2.8` as on a camera with a sensor 24 mm high, or the diameter
    /// of the lens in metres. [default: everything is sharp]
    #[arg(long, value_name = "f/N|DIAMETER", value_parser = aperture, allow_hyphen_values = true)]
    pub(crate) aperture: Option<Aperture>,

    /// What is in focus: a distance in metres along the direction of view, or `auto`, what lies in the centre of the picture.
    /// [default: auto]
    #[arg(long, value_name = "D|auto", value_parser = focus, allow_hyphen_values = true)]
    pub(crate) focus: Option<Focus>,

    /// Renders only this part of the picture: column and row of its top left pixel, columns and rows. Its pixels are those of
    /// the whole picture, to the bit.
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop, allow_hyphen_values = true)]
    pub(crate) crop: Option<Crop>,
}

impl CameraArgs {
    /// The part of a picture of this size that is rendered.
    pub(crate) fn part(&self, size: [u32; 2]) -> Result<Crop, Failure> {
        let Some(crop) = self.crop else { return Ok(Crop { origin: [0, 0], size }) };
        let inside =
            (0..2).all(|i| crop.origin[i].checked_add(crop.size[i]).is_some_and(|end| end <= size[i]));
        if inside {
            return Ok(crop);
        }
        let (Crop { origin: [x, y], size: [w, h] }, [width, height]) = (crop, size);
        Err(Failure::usage(format!(
            "--crop {x},{y},{w},{h} reaches outside of the picture of {width}x{height}"
        )))
    }

    /// The same in the library's terms: what was given, in the place of the edits' camera. Another camera, or a bookmark by its
    /// name, takes the place of all of that.
    pub(crate) fn options(&self, edits: &Edits) -> Result<CameraOptions, Failure> {
        let base = match &self.camera {
            None => edits.camera_options(),
            Some(CameraChoice::Name(name)) if let Some(bookmark) = edits.bookmark(name) => {
                bookmark.changes.camera_options()
            }
            Some(choice) => CameraOptions { choice: choice.clone(), ..CameraOptions::default() },
        };
        let options = CameraOptions {
            look_from: self.look_from.or(base.look_from),
            look_at: self.look_at.or(base.look_at),
            fov: self.fov.map(f32::to_radians).or(base.fov),
            aperture: self.aperture.or(base.aperture),
            focus: self.focus.unwrap_or(base.focus),
            ..base
        };
        if options.look_from.is_some() && options.look_from == options.look_at {
            let from = if self.look_from.is_some() { "--look-from" } else { "the eye of the edits" };
            let at = if self.look_at.is_some() { "--look-at" } else { "their target" };
            return Err(Failure::usage(format!("{from} and {at} are the same point: there is no direction")));
        }
        if self.focus.is_some() && options.aperture.is_none() {
            return Err(Failure::usage("--focus means nothing without --aperture: everything is sharp"));
        }
        Ok(options)
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
            ("aperture", self.aperture.map(|a| a.to_string())),
            ("focus", self.focus.map(|f| f.to_string())),
            ("crop", self.crop.map(|Crop { origin: [x, y], size: [w, h] }| format!("{x},{y},{w},{h}"))),
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
