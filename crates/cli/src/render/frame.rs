//! `--mode hybrid`: frames as in real time, the last of which is written as a picture.

use super::job::{Job, Prepared};
use super::report;
use crate::console;
use crate::device;
use crate::exit::{Code, Failure};
use crate::interrupt::{self, Phase};
use lumbre::core::hybrid::{FrameDone, FrameView};
use lumbre::prelude::*;
use std::time::Instant;

/// Draws it and writes it.
pub(super) fn run(job: &Job<'_>, prepared: &Prepared<'_>, cancel: &CancelToken) -> Result<Code, Failure> {
    let settings = job.args.hybrid.settings(&job.view.settings);
    let frames = job.args.frames.unwrap_or_else(|| job.args.hybrid.still_frames(&settings));
    if job.view.camera.lens_radius > 0.0 {
        console::warning("--mode hybrid: the lens is drawn as a pinhole");
    }
    let mut renderer = prepared.backend.frame_renderer()?;
    let began = Instant::now();
    let mut done = FrameDone::default();
    for frame in 0..frames {
        if cancel.is_cancelled() {
            return Err(Failure::new(Code::Killed, "interrupted before the last frame: nothing is written"));
        }
        let view = View { frame, ..job.view.clone() };
        done = renderer.frame(&FrameView { view: &view, size: job.size, settings: &settings })?;
    }
    let seconds = began.elapsed().as_secs_f64();
    device::validation(prepared.backend);
    let passes: f64 = done.passes.iter().map(|p| p.1).sum();
    console::note(format_args!(
        "{frames} frames in {seconds:.2} s; the last of {} rays and {} shadow rays, {passes:.2} ms on the device",
        done.report.rays, done.report.shadow_rays
    ));
    if done.report.dropped > 0 {
        console::warning(format_args!("{} rays had no room: their light is missing", done.report.dropped));
    }
    interrupt::enter(Phase::Writing);
    let film = renderer.film()?;
    report::film(film);
    report::black(film, &job.args.scene);
    job.written(film, 1)?;
    Ok(Code::Done)
}
