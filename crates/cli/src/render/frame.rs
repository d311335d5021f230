//! `--mode hybrid`: a frame as in real time, written as a picture.

use super::job::{Job, Prepared};
use super::report;
use crate::console;
use crate::device;
use crate::exit::{Code, Failure};
use crate::interrupt::{self, Phase};
use lumbre::core::hybrid::FrameView;
use std::time::Instant;

/// Draws it and writes it.
pub(super) fn run(job: &Job<'_>, prepared: &Prepared<'_>) -> Result<Code, Failure> {
    let settings = job.args.mode.hybrid(&job.view.settings);
    if job.view.camera.lens_radius > 0.0 {
        console::warning("--mode hybrid: the lens is drawn as a pinhole");
    }
    let mut renderer = prepared.backend.frame_renderer()?;
    let began = Instant::now();
    let shot = FrameView { view: &job.view, size: job.size, settings: &settings };
    let done = renderer.frame(&shot)?;
    let seconds = began.elapsed().as_secs_f64();
    device::validation(prepared.backend);
    let passes: f64 = done.passes.iter().map(|p| p.1).sum();
    console::note(format_args!(
        "a frame of {} rays and {} shadow rays: {:.2} ms on the device, {seconds:.2} s in all",
        done.report.rays, done.report.shadow_rays, passes
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
