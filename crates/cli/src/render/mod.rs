//! `lumbre render`: from flags to a picture, or to one path.

mod outputs;
mod replay;
mod report;
mod scene;

use crate::exit::{Code, Failure};
use crate::flags::render::RenderArgs;
use crate::flags::values::Size;
use crate::interrupt::{self, Phase};
use crate::progress::{Finish, Reporter, Start};
use crate::{console, memory};
use lumbre::core::film::Crop;
use lumbre::prelude::*;
use lumbre::{Watched, core::control::Control};
use outputs::Outputs;
use scene::Opened;
use std::time::Instant;

/// Runs the command.
pub(crate) fn run(args: &RenderArgs) -> Result<Code, Failure> {
    // Whatever can be known to fail is found before the work begins.
    let (device, why) = args.run.device.choose();
    device.check()?;
    let outputs = if args.replay.pixel.is_some() { Outputs::none() } else { Outputs::check(args)? };
    let camera = args.camera.options()?;
    if let Some(Size(size)) = args.output.size {
        let part = args.camera.part(size)?;
        memory::check(part.size, outputs.bytes_per_pixel(), args.run.memory_limit)?;
    }
    let cancel = interrupt::install()?;
    let threads = args.run.threads.map_or(0, usize::from); // 0: rayon counts the processors
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|e| Failure::new(Code::Memory, format!("cannot start the threads: {e}")))?;
    pool.install(|| {
        let Opened { compiled, camera, size, sky_added, load_seconds } = scene::open(args, &camera)?;
        let part = args.camera.part(size)?;
        memory::check(part.size, outputs.bytes_per_pixel(), args.run.memory_limit)?;
        let view = View { camera, settings: args.sampling.settings(), frame: 0 };
        let mut job = Job { args, outputs, view, size, part, sky_added };
        let say = |backend: &dyn Backend, why| {
            console::note(format_args!("device: {} ({why})", backend.device()));
        };
        if let Some(pixel) = args.replay.pixel {
            let backend = lumbre::prepare_cpu(compiled)?;
            say(&backend, "--pixel always runs there");
            scene::focus(args, &backend, &mut job.view.camera);
            return replay::run(&job, &backend, pixel);
        }
        let start = Instant::now();
        let backend = lumbre::prepare(compiled, device)?;
        let build_seconds = start.elapsed().as_secs_f64();
        say(&*backend, why);
        scene::focus(args, &*backend, &mut job.view.camera);
        job.picture(&*backend, &cancel, load_seconds, build_seconds)
    })
}

/// What is to be rendered.
struct Job<'a> {
    args: &'a RenderArgs,
    outputs: Outputs,
    view: View,
    size: [u32; 2],
    /// What is rendered of it.
    part: Crop,
    sky_added: bool,
}

impl Job<'_> {
    fn picture(
        &self,
        backend: &dyn Backend,
        cancel: &CancelToken,
        load_seconds: f64,
        build_seconds: f64,
    ) -> Result<Code, Failure> {
        let start = Start {
            device: backend.device(),
            threads: rayon::current_num_threads(),
            size: self.part.size,
            spp: self.args.sampling.spp,
        };
        let mut film = Film::window(self.size, self.part);
        // From here on an interrupt saves what there is; so it must be said before anyone hears that it started.
        interrupt::enter(Phase::Rendering);
        let reporter = Reporter::begin(self.args.run.progress, start)?;
        let watched = Watched::new(cancel, |so_far| reporter.heard(so_far));
        let (done, render_seconds) = self.timed(backend, &mut film, &watched);
        reporter.rendered();
        interrupt::enter(Phase::Writing);

        let wanted = film.pixels().len() as u64 * u64::from(self.args.sampling.spp);
        let interrupted = done.samples < wanted;
        if interrupted && done.samples == 0 {
            return Err(Failure::new(
                Code::Killed,
                "interrupted before the first sample: nothing is written",
            ));
        }
        let saturated = report::film(&film);
        report::black(&film, &self.args.scene);
        let start = Instant::now();
        let interrupted_after = interrupted.then_some(done.samples);
        let metadata = outputs::metadata(self.args, self.sky_added, interrupted_after);
        self.outputs.write(&film, self.args.output.exposure, &metadata)?;
        let write_seconds = start.elapsed().as_secs_f64();
        reporter.finish(&Finish {
            done,
            load_seconds,
            build_seconds,
            render_seconds,
            write_seconds,
            interrupted,
            non_finite: film.non_finite_count(),
            saturated,
        })?;
        if !interrupted {
            return Ok(Code::Done);
        }
        let share = 100.0 * done.samples as f64 / wanted as f64;
        console::warning(format_args!("interrupted: the picture has {share:.1} % of its samples"));
        Ok(Code::Interrupted)
    }

    fn timed(&self, backend: &dyn Backend, film: &mut Film, control: &dyn Control) -> (Progress, f64) {
        let start = Instant::now();
        let done = lumbre::render(backend, &self.view, 0..self.args.sampling.spp, film, control);
        (done, start.elapsed().as_secs_f64())
    }
}
