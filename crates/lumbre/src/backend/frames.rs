//! Frames in a row, for measurements: what a frame takes when the sums stay where they are.

use super::{Backend, RenderError};
use lumbre_core::Film;
use lumbre_core::measure::Frames;
use lumbre_core::settings::View;
use std::time::Instant;

/// Frames by plain renders into one film.
pub(super) fn by_renders(
    backend: &(impl Backend + ?Sized),
    view: &View,
    size: [u32; 2],
    spp: u32,
    count: u32,
) -> Result<Frames, RenderError> {
    let mut film = Film::new(size[0], size[1]);
    let mut frames = Frames::default();
    for frame in 0..count {
        let (began, first) = (Instant::now(), frame * spp);
        let done = backend.render(view, first..first + spp, &mut film, &())?;
        frames.seconds.push(began.elapsed().as_secs_f64());
        frames.progress.samples += done.samples;
        frames.progress.rays += done.rays;
    }
    Ok(frames)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Device, prepare};
    use lumbre_core::Camera;
    use lumbre_core::settings::RenderSettings;
    use lumbre_scene::{Scene, compile};

    #[test]
    fn frames_are_counted_and_each_has_its_time() {
        let backend = prepare(compile(&Scene::default()).unwrap().scene, Device::Cpu).unwrap();
        let camera = Camera::look_at(glam::Vec3::ZERO, glam::Vec3::Z, glam::Vec3::Y, 1.0, 1.5);
        let view = View { camera, settings: RenderSettings::default(), frame: 0 };
        let frames = backend.frames(&view, [6, 4], 3, 5).unwrap();
        assert_eq!((frames.seconds.len(), frames.progress.samples), (5, 6 * 4 * 3 * 5));
        assert!(frames.progress.rays >= frames.progress.samples && frames.passes.is_empty());
        assert!(frames.seconds.iter().all(|s| *s > 0.0));
        assert_eq!(backend.frames(&view, [6, 4], 1, 0), Ok(Frames::default()));
    }
}
