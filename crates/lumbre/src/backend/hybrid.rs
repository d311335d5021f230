//! Frames in real time: what the camera sees is rasterised, rays bring the rest.

use super::RenderError;
use lumbre_core::Film;
use lumbre_core::hybrid::{FrameDone, FrameView, PixelPlanes};
use lumbre_core::measure::{Frames, PassTime};
use std::time::Instant;

/// Draws hybrid frames of a scene, one after another.
pub trait FrameRenderer {
    /// Draws a frame.
    ///
    /// # Errors
    /// If the device fails or has no room for it.
    fn frame(&mut self, shot: &FrameView<'_>) -> Result<FrameDone, RenderError> {
        self.next(shot)?;
        let mut last = FrameDone::default();
        while let Some(done) = self.finish()? {
            last = done;
        }
        Ok(last)
    }

    /// Begins a frame; returns one that was under way before, if the device has as many as keep it busy.
    ///
    /// # Errors
    /// If the device fails or has no room for it.
    fn next(&mut self, shot: &FrameView<'_>) -> Result<Option<FrameDone>, RenderError>;

    /// Waits for the oldest frame under way; `None`: there is none.
    ///
    /// # Errors
    /// If the device fails.
    fn finish(&mut self) -> Result<Option<FrameDone>, RenderError>;

    /// What the last frame knows of its pixels, row by row from the top; its columns and rows are those of
    /// [`drawn_size`](lumbre_core::hybrid::HybridSettings::drawn_size).
    ///
    /// # Errors
    /// If the device fails.
    ///
    /// # Panics
    /// Before the first frame.
    fn planes(&mut self) -> Result<Vec<PixelPlanes>, RenderError>;

    /// The last frame that was begun, as a film of one sample.
    ///
    /// # Errors
    /// If the device fails.
    ///
    /// # Panics
    /// Before the first frame.
    fn film(&mut self) -> Result<&Film, RenderError>;
}

/// Draws frames for measurements, nothing of them read back but counters. `shot` says what each shows.
///
/// # Errors
/// If the device fails.
pub fn frames<'a>(
    renderer: &mut dyn FrameRenderer,
    count: u32,
    mut shot: impl FnMut(u32) -> FrameView<'a>,
) -> Result<Frames, RenderError> {
    let mut frames = Frames::default();
    let (mut rays, mut last) = (0, Instant::now());
    for i in 0..count {
        let shot = shot(i);
        frames.progress.samples += u64::from(shot.size[0]) * u64::from(shot.size[1]);
        let mut done = renderer.next(&shot)?;
        while let Some(frame) = done {
            let now = Instant::now();
            frames.seconds.push((now - last).as_secs_f64());
            last = now;
            rays += frame.report.rays;
            frames.progress.rays += frame.report.rays + frame.report.shadow_rays;
            for (name, ms) in frame.passes {
                PassTime::add(&mut frames.passes, name, ms);
            }
            done = if i + 1 == count { renderer.finish()? } else { None };
        }
    }
    frames.path_rays = Some(rays);
    Ok(frames)
}
