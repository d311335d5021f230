//! Frames in a row, for measurements: what a frame takes when the sums stay where they are.

use super::{Backend, RenderError};
use lumbre_core::Film;
use lumbre_core::control::Progress;
use lumbre_core::settings::View;
use std::time::Instant;

/// Time that a device spent on one of its passes, by its own clock.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    /// Which pass.
    pub name: String,
    /// How often it ran.
    pub count: u64,
    /// Milliseconds in all.
    pub total_ms: f64,
}

impl PassTime {
    /// Milliseconds of one run, in the mean.
    pub fn mean_ms(&self) -> f64 {
        self.total_ms / self.count.max(1) as f64
    }
}

/// What [`Backend::frames`] took.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frames {
    /// Seconds of each frame, from the end of the one before (of the first: from the call).
    pub seconds: Vec<f64>,
    /// What was done in all.
    pub progress: Progress,
    /// Rays that go on a path, that of the camera too, but no shadow rays; `None` where they are not counted apart.
    pub path_rays: Option<u64>,
    /// The device's passes, over all frames; empty where it has no clock.
    pub passes: Vec<PassTime>,
}

/// What the rays of a frame take by themselves ([`Backend::replayed`]): traced in the order and the launches of the frame, with nothing
/// shaded. Times are the device's own, milliseconds, medians of some runs; 0 where it has no clock.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Replayed {
    /// Rays that go on a path, that of the camera too.
    pub path_rays: u64,
    /// Rays to lights.
    pub shadow_rays: u64,
    /// What is not replayed: shadow rays that follow light through glass (the way there is), and those of shadow catchers.
    pub left_out: u64,
    /// Time for those of paths, launch after launch.
    pub path_ms: f64,
    /// Time for those to lights, launch after launch.
    pub shadow_ms: f64,
    /// Time for all of them, those launched beside one another that the frame launches so.
    pub ms: f64,
}

/// Acceleration structures of a scene on a device ([`Backend::accel`]): what they hold, and what making them took by the device's own
/// clock (0 where it has none).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AccelReport {
    /// Bottom-level structures.
    pub structures: usize,
    /// Triangles in them.
    pub triangles: u64,
    /// Instances in the top level.
    pub instances: usize,
    /// Bytes of the bottom level as built.
    pub bytes_built: u64,
    /// Bytes of it after compaction.
    pub bytes: u64,
    /// Bytes of the top level.
    pub top_bytes: u64,
    /// Milliseconds to build the bottom level.
    pub build_ms: f64,
    /// Milliseconds to compact it.
    pub compact_ms: f64,
    /// Milliseconds to build the top level.
    pub top_build_ms: f64,
}

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
        let pass = PassTime { name: "trace".into(), count: 4, total_ms: 10.0 };
        assert_eq!(pass.mean_ms(), 2.5);
    }
}
