//! One render from the first sample to the files.

use super::outputs;
use super::report;
use super::saving::Saver;
use crate::exit::{Code, Failure};
use crate::flags::render::RenderArgs;
use crate::interrupt::{self, Phase};
use crate::outputs::{Developed, Outputs, PartOf};
use crate::progress::stats::{Memory, Stats};
use crate::progress::{Finish, Reporter, Start};
use crate::{console, device, memory};
use lumbre::core::control::Control;
use lumbre::core::film::Crop;
use lumbre::fingerprint::{Fingerprint, SceneHash};
use lumbre::prelude::*;
use lumbre::{Ended, Estimator, RenderError, RenderFailed, SoFar, Watch};
use std::sync::atomic::AtomicBool;
use std::thread;
use std::time::Instant;

/// What is to be rendered.
pub(super) struct Job<'a> {
    pub(super) args: &'a RenderArgs,
    pub(super) outputs: Outputs,
    pub(super) view: View,
    pub(super) size: [u32; 2],
    /// What is rendered of it.
    pub(super) part: Crop,
    /// If the picture is to carry exact sums.
    pub(super) scene: Option<SceneHash>,
    pub(super) sky_added: bool,
    /// When the command began.
    pub(super) began: Instant,
}

/// What it is rendered with, and what that took.
pub(super) struct Prepared<'a> {
    pub(super) backend: &'a dyn Backend,
    pub(super) load_seconds: f64,
    pub(super) build_seconds: f64,
    pub(super) scene_bytes: u64,
}

impl Job<'_> {
    /// Renders and writes.
    pub(super) fn picture(&self, prepared: &Prepared<'_>, cancel: &CancelToken) -> Result<Code, Failure> {
        let targets = self.args.targets.targets(self.began.elapsed());
        let targets = targets.from_sample(self.args.output.first_sample.unwrap_or(0));
        let mut film = Film::window(self.size, self.part);
        let start = Start {
            device: prepared.backend.device(),
            threads: rayon::current_num_threads(),
            size: self.part.size,
            targets,
        };
        // From here on an interrupt saves what there is; so it must be said before anyone hears that it started.
        interrupt::enter(Phase::Rendering);
        if !self.args.targets.given() {
            report::chosen(&targets);
        }
        let reporter = Reporter::begin(self.args.run.progress, start)?;
        let watchers = Watchers { cancel, reporter: &reporter };
        let rendered = self.render(prepared.backend, &targets, &mut film, &watchers);
        reporter.rendered();
        interrupt::enter(Phase::Writing);

        let (outcome, failure) = match rendered {
            Ok(outcome) => (outcome, None),
            Err(RenderFailed { error, outcome }) => (outcome, Some(error)),
        };
        let early = matches!(outcome.ended, Ended::Cancelled | Ended::Failed);
        if early && outcome.progress.samples == 0 {
            return Err(nothing(failure));
        }
        device::validation(prepared.backend);
        let saturated = report::film(&film);
        report::black(&film, &self.args.scene);
        report::ended(&outcome, &targets);
        let start = Instant::now();
        let unfinished = early.then_some(outcome.progress.samples);
        self.developed(&film, outcome.spp, unfinished, |d| self.outputs.write(d))?;
        let write_seconds = start.elapsed().as_secs_f64();
        let stats = self.args.run.stats.then(|| self.stats(prepared, &film));
        reporter.finish(&Finish {
            outcome,
            load_seconds: prepared.load_seconds,
            build_seconds: prepared.build_seconds,
            write_seconds,
            non_finite: film.non_finite_count(),
            saturated,
            stats,
        })?;
        let spp = outcome.spp;
        if let Some(error) = failure {
            let message = format!("{error}: the picture so far is written, {spp} samples per pixel");
            return Err(Failure::new(Code::Unavailable, message));
        }
        if early {
            console::warning(format_args!("interrupted: the picture has {spp} samples per pixel"));
            return Ok(Code::Interrupted);
        }
        Ok(Code::Done)
    }

    fn render(
        &self,
        backend: &dyn Backend,
        targets: &Targets,
        film: &mut Film,
        watchers: &Watchers<'_>,
    ) -> Result<Outcome, RenderFailed> {
        let busy = AtomicBool::new(false);
        let save = |film: &Film, so_far: &SoFar| {
            self.developed(film, so_far.spp, Some(so_far.progress.samples), |d| self.outputs.save(d))
        };
        // The scope waits for a file that is still being written.
        thread::scope(|scope| {
            let saver = self.args.targets.save_every.map(|every| Saver::new(every, scope, &busy, &save));
            let watch = Watching { watchers, saver, ends_even: self.args.output.keeps_sums() };
            lumbre::render(backend, &self.view, *targets, film, &watch)
        })
    }

    /// The same for another view, into other files.
    pub(super) fn with(&self, view: View, outputs: Outputs) -> Job<'_> {
        Job { args: self.args, outputs, view, ..*self }
    }

    /// Writes a finished picture of so many samples.
    pub(super) fn written(&self, film: &Film, spp: u32) -> Result<(), Failure> {
        self.developed(film, spp, None, |d| self.outputs.write(d))
    }

    /// Writes the outputs through `write`; `unfinished`: the camera samples after which that is done too early.
    fn developed(
        &self,
        film: &Film,
        spp: u32,
        unfinished: Option<u64>,
        write: impl Fn(&Developed<'_>) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let mut metadata = outputs::metadata(self.args, self.sky_added, unfinished);
        metadata.push(("lumbre.spp".into(), spp.to_string()));
        let part = self.scene.map(|scene| PartOf {
            fingerprint: Fingerprint::new(scene, &self.view, self.size, self.part),
            first_sample: self.args.output.first_sample.unwrap_or(0),
        });
        write(&Developed { film, metadata: &metadata, part })
    }

    fn stats(&self, prepared: &Prepared<'_>, film: &Film) -> Stats {
        let pixels = film.pixels().len() as u64;
        Stats {
            memory: Memory {
                scene: prepared.scene_bytes,
                acceleration: prepared.backend.memory(),
                film: Film::bytes(film.width(), film.height()) + Estimator::bytes(pixels),
                peak: memory::peak(),
            },
            passes: prepared.backend.pass_times(),
        }
    }
}

/// Why nothing is written: the device failed, or the user interrupted.
fn nothing(failure: Option<RenderError>) -> Failure {
    const NOTHING: &str = "before the first sample: nothing is written";
    match failure {
        Some(error) => Failure::new(Code::Unavailable, format!("{error} {NOTHING}")),
        None => Failure::new(Code::Killed, format!("interrupted {NOTHING}")),
    }
}

/// Who wants to hear of a render, and who may end it.
struct Watchers<'a> {
    cancel: &'a CancelToken,
    reporter: &'a Reporter,
}

/// The same with who saves.
struct Watching<'a, S> {
    watchers: &'a Watchers<'a>,
    saver: Option<S>,
    /// A part is worth nothing when its pixels differ in their samples.
    ends_even: bool,
}

impl<S: super::saving::Save> Control for Watching<'_, S> {
    fn cancelled(&self) -> bool {
        self.watchers.cancel.is_cancelled()
    }
    fn progress(&self, so_far: Progress) {
        self.watchers.reporter.heard(so_far);
    }
}

impl<S: super::saving::Save> Watch for Watching<'_, S> {
    fn passed(&self, film: &Film, so_far: &SoFar) {
        self.watchers.reporter.passed(so_far);
        if let Some(saver) = &self.saver {
            saver.passed(film, so_far);
        }
    }
    fn ends_even(&self) -> bool {
        self.ends_even
    }
    fn notice(&self, what: &str) {
        console::warning(what);
    }
}
