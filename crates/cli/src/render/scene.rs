//! Opens what is to be rendered: the scene, the light from far away, the camera and the size of the picture.

use crate::console;
use crate::device;
use crate::exit::Failure;
use crate::flags::render::RenderArgs;
use crate::flags::values::{MAX_SIDE, Size};
use crate::lit::{self, Lit};
use lumbre::core::Camera;
use lumbre::core::camera::Projection;
use lumbre::core::settings::View;
use lumbre::scene::CompiledScene;
use lumbre::{Aperture, Backend, CameraOptions, Focus};
use std::time::Instant;

/// A scene that is ready to be built for a device.
pub(super) struct Opened {
    pub(super) compiled: CompiledScene,
    pub(super) camera: Camera,
    pub(super) size: [u32; 2],
    /// The scene had no light and got the gradient sky.
    pub(super) sky_added: bool,
    pub(super) load_seconds: f64,
}

/// Loads, lights and compiles the scene, and finds the camera.
pub(super) fn open(args: &RenderArgs, options: &CameraOptions) -> Result<Opened, Failure> {
    let start = Instant::now();
    let Lit { scene, sky_added } = lit::load(&args.scene, &args.loading, &args.light)?;
    // Before the costly part: is the camera there?
    let aspect = lumbre::authored_aspect(&scene, &options.choice).map_err(Failure::usage)?;
    let compiled = lumbre::compile(&scene)?;
    compiled.notes.iter().for_each(console::warning);
    let size = match args.output.size {
        Some(Size(size)) => size,
        None => default_size(aspect),
    };
    let shape = size[0] as f32 / size[1] as f32;
    let found = lumbre::find_camera(&scene, &compiled.scene, options, shape).map_err(Failure::usage)?;
    if found.framed {
        console::note("camera: the scene has none; the whole of it is put in view");
    }
    let load_seconds = start.elapsed().as_secs_f64();
    Ok(Opened { compiled: compiled.scene, camera: found.camera, size, sky_added, load_seconds })
}

/// Focuses an open lens on the centre of the picture, unless a distance is asked for.
pub(super) fn focus(asked: &CameraOptions, backend: &dyn Backend, view: &mut View) -> Result<(), Failure> {
    if asked.aperture.is_none_or(|a| a == Aperture::Diameter(0.0)) {
        return Ok(());
    }
    let orthographic = matches!(view.camera.projection, Projection::Orthographic { .. });
    if orthographic && matches!(asked.aperture, Some(Aperture::FNumber(_))) {
        console::warning("--aperture f/N means nothing to an orthographic camera: a diameter in metres does");
    }
    if asked.focus != Focus::Auto {
        return Ok(());
    }
    match device::surely(backend, || lumbre::focus_distance(backend, view, [0.5, 0.5]))? {
        Some(metres) => {
            view.camera.focus_distance = metres;
            console::note(format_args!("focus: {metres:.3} m, the centre of the picture"));
        }
        None => {
            view.camera.focus_distance = FAR;
            console::note("focus: far away; nothing lies in the centre of the picture (--focus D)");
        }
    }
    Ok(())
}

/// Distance that stands for infinity, metres: a lens of a metre blurs less than a pixel of what is beyond.
const FAR: f32 = 1e5;

/// Rows of a picture for which no size was asked.
const ROWS: u32 = 720;

/// The shape that the camera was framed for, or 16:9.
fn default_size(aspect: Option<f32>) -> [u32; 2] {
    let Some(aspect) = aspect else { return [ROWS * 16 / 9, ROWS] };
    // A mad shape still makes a picture that can be held.
    let width = ((ROWS as f32 * aspect).round() as u32).clamp(1, MAX_SIDE);
    console::note(format_args!("size: {width}x{ROWS}, the shape that the camera was framed for"));
    [width, ROWS]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_camera_shapes_the_picture() {
        assert_eq!(default_size(None), [1280, 720]);
        assert_eq!(default_size(Some(4.0 / 3.0)), [960, 720]);
        assert_eq!(default_size(Some(1e-9)), [1, 720]);
        assert_eq!(default_size(Some(1e9)), [MAX_SIDE, 720]);
    }
}
