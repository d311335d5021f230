//! `--pixel x,y --sample n`: one camera sample again, step by step, on stdout.

use super::job::Job;
use crate::console;
use crate::exit::{Code, Failure};
use lumbre::core::film::FilmSample;
use lumbre::cpu::CpuBackend;
use lumbre::cpu::observer::{PathEvent, describe};

/// Traces the sample and prints it.
pub(super) fn run(job: &Job<'_>, backend: &CpuBackend, pixel: [u32; 2]) -> Result<Code, Failure> {
    let ([x, y], [width, height]) = (pixel, job.size);
    if x >= width || y >= height {
        return Err(Failure::usage(format!("--pixel {x},{y} lies outside the picture of {width}x{height}")));
    }
    if !job.args.output.output.is_empty() {
        console::note("no picture is written: --pixel prints one path instead");
    }
    let index = job.args.replay.sample;
    let mut failed = None;
    let mut print = |text: String| {
        if failed.is_none() {
            failed = console::result(text).err();
        }
    };
    print(format!(
        "sample  pixel {x},{y} of {width}x{height}, index {index}, seed {}",
        job.view.settings.seed
    ));
    let sample =
        backend.replay(&job.view, job.size, pixel, index, &mut |e: PathEvent<'_>| print(describe(&e)));
    print(outcome(&sample));
    failed.map_or(Ok(Code::Done), Err)
}

/// What the sample brings to its pixel.
fn outcome(sample: &FilmSample) -> String {
    let c = sample.radiance;
    let note = if c.is_finite() { "" } else { " (not finite: it counts as black)" };
    format!("result  radiance ({:.6}, {:.6}, {:.6}){note}", c.r, c.g, c.b)
}
