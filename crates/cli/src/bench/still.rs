//! A whole picture of many samples, as `lumbre render` makes it: the film is read back, the error estimated.

use super::render;
use super::sweep::Sweep;
use super::table::{Cell, Column, Table};
use crate::exit::Failure;
use crate::flags::bench::BenchArgs;
use lumbre::{Outcome, Targets};

/// Of the first thesis's pictures.
const SPP: u32 = 1000;

const COLUMNS: [Column; 5] = [
    ("spp", "samples per pixel"),
    ("seconds", "s"),
    ("msamples_per_second", "Msamples/s"),
    ("mrays_per_second", "Mrays/s"),
    ("error", "estimated relMSE"),
];

pub(super) fn table(args: &BenchArgs) -> Result<Table, Failure> {
    let targets = Targets::spp(args.spp.unwrap_or(SPP));
    Sweep::of(args).walk(args, &COLUMNS, |spot| {
        let outcome = render(spot.backend, &spot.view(spot.settings())?, spot.size, targets)?;
        spot.note(format_args!("{:.2} s", outcome.seconds));
        Ok(vec![row(&outcome)])
    })
}

fn row(o: &Outcome) -> Vec<Cell> {
    let rate = |n: u64| Cell::Number(n as f64 / o.seconds.max(1e-9) * 1e-6);
    let (samples, rays) = (rate(o.progress.samples), rate(o.progress.rays));
    vec![Cell::Whole(o.spp.into()), Cell::Number(o.seconds), samples, rays, o.error.into()]
}
