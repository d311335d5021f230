//! Pictures of which each is more than one render: hybrid frames as in real time, and rows of pictures along the way of a camera.

use super::job::{Job, Prepared};
use super::report;
use crate::console;
use crate::device;
use crate::exit::{Code, Failure};
use crate::flags::mode::Mode;
use crate::flags::render::RenderArgs;
use crate::interrupt::{self, Phase};
use lumbre::core::hybrid::{FrameDone, FrameView, HybridSettings};
use lumbre::io::one_line;
use lumbre::prelude::*;
use lumbre::{CameraPath, FrameRenderer, Plane};
use std::time::Instant;

/// Bytes of a file that says a way.
const LONGEST_PATH: u64 = 4 << 20;
/// Pictures along a way, where nobody says how many.
const PICTURES: u32 = 60;

/// The way of the camera, if there is one. Flags that mean nothing with what else is asked are errors.
pub(super) fn camera_path(args: &RenderArgs) -> Result<Option<CameraPath>, Failure> {
    if let Some(folder) = &args.hybrid.planes {
        if args.mode == Mode::Path {
            return Err(Failure::usage("--planes: takes --mode hybrid"));
        }
        lumbre::io::check_writable(folder.join("normal.png"))?;
    }
    let Some(path) = &args.camera_path else {
        if args.frames.is_some() && args.mode == Mode::Path {
            return Err(Failure::usage("--frames: takes --mode hybrid or --camera-path"));
        }
        return Ok(None);
    };
    if args.output.keeps_sums() || args.targets.save_every.is_some() {
        return Err(Failure::usage("--camera-path: its pictures have neither parts nor a state on the way"));
    }
    let text = lumbre::io::read_text(path, LONGEST_PATH)?;
    let way = CameraPath::parse(&text)
        .map_err(|e| Failure::new(Code::BadData, format!("{}: {e}", one_line(&path.to_string_lossy()))))?;
    Ok(Some(way))
}

/// Pictures along the way.
pub(super) fn walk(
    job: &Job<'_>,
    prepared: &Prepared<'_>,
    way: &CameraPath,
    cancel: &CancelToken,
) -> Result<Code, Failure> {
    let pictures = job.args.frames.unwrap_or(PICTURES);
    let base = job.view.camera;
    let mut frames = match job.args.mode {
        Mode::Path => None,
        Mode::Hybrid => Some(Hybrid::new(job, prepared)?),
    };
    for i in 0..pictures {
        let share = if pictures > 1 { i as f32 / (pictures - 1) as f32 } else { 0.0 };
        let view = View { camera: way.at(share, &base), frame: i, ..job.view.clone() };
        let outputs = job.outputs.numbered(i + 1);
        match &mut frames {
            Some(frames) => {
                if cancel.is_cancelled() {
                    console::warning(format_args!("interrupted: {i} of {pictures} pictures are written"));
                    return Ok(if i > 0 { Code::Interrupted } else { Code::Killed });
                }
                frames.draw(&view)?;
                job.with(view, outputs).written(frames.renderer.film()?, 1)?;
            }
            None => match job.with(view, outputs).picture(prepared, cancel)? {
                Code::Done => {}
                other => return Ok(other),
            },
        }
    }
    if let Some(mut frames) = frames {
        frames.said(prepared);
        frames.write_planes(job)?;
    }
    Ok(Code::Done)
}

/// A still picture of hybrid frames.
pub(super) fn still(job: &Job<'_>, prepared: &Prepared<'_>, cancel: &CancelToken) -> Result<Code, Failure> {
    let mut frames = Hybrid::new(job, prepared)?;
    let count = job.args.frames.unwrap_or_else(|| job.args.hybrid.still_frames(&frames.settings));
    for frame in 0..count {
        if cancel.is_cancelled() {
            return Err(Failure::new(Code::Killed, "interrupted before the last frame: nothing is written"));
        }
        frames.draw(&View { frame, ..job.view.clone() })?;
    }
    frames.said(prepared);
    interrupt::enter(Phase::Writing);
    let film = frames.renderer.film()?;
    report::film(film);
    report::black(film, &job.args.scene);
    job.written(film, 1)?;
    frames.write_planes(job)?;
    Ok(Code::Done)
}

/// Frames under way.
struct Hybrid<'a> {
    renderer: Box<dyn FrameRenderer + 'a>,
    size: [u32; 2],
    settings: HybridSettings,
    began: Instant,
    frames: u32,
    last: FrameDone,
    dropped: u64,
}

impl<'a> Hybrid<'a> {
    fn new(job: &Job<'_>, prepared: &Prepared<'a>) -> Result<Self, Failure> {
        if job.view.camera.lens_radius > 0.0 {
            console::warning("--mode hybrid: the lens is drawn as a pinhole");
        }
        Ok(Hybrid {
            renderer: prepared.backend.frame_renderer()?,
            size: job.size,
            settings: job.args.hybrid.settings(&job.view.settings),
            began: Instant::now(),
            frames: 0,
            last: FrameDone::default(),
            dropped: 0,
        })
    }

    fn draw(&mut self, view: &View) -> Result<(), Failure> {
        let shot = FrameView { view, size: self.size, settings: &self.settings };
        self.last = self.renderer.frame(&shot)?;
        self.frames += 1;
        self.dropped = self.dropped.max(self.last.report.dropped);
        Ok(())
    }

    /// Writes the planes of the last one, if they are asked for.
    fn write_planes(&mut self, job: &Job<'_>) -> Result<(), Failure> {
        let Some(folder) = &job.args.hybrid.planes else { return Ok(()) };
        let look = job.args.look();
        let factor = look.exposure_factor(self.renderer.film()?);
        let planes = self.renderer.planes()?;
        let [width, height] = self.settings.drawn_size(self.size);
        for plane in Plane::ALL {
            let path = folder.join(format!("{}.png", plane.name()));
            lumbre::io::write_png(&path, width, height, &plane.picture(&planes, &look.look, factor))?;
        }
        console::note(format_args!("wrote {} planes into {}", Plane::ALL.len(), folder.display()));
        Ok(())
    }

    /// Says what they took.
    fn said(&self, prepared: &Prepared<'_>) {
        device::validation(prepared.backend);
        let (seconds, report) = (self.began.elapsed().as_secs_f64(), self.last.report);
        let passes: f64 = self.last.passes.iter().map(|p| p.1).sum();
        console::note(format_args!(
            "{} frames in {seconds:.2} s; the last of {} rays and {} shadow rays, {passes:.2} ms on the device",
            self.frames, report.rays, report.shadow_rays
        ));
        if self.dropped > 0 {
            console::warning(format_args!("{} rays had no room: their light is missing", self.dropped));
        }
    }
}
