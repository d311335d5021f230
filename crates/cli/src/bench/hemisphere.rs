//! Uniform against cosine-weighted diffuse directions, as the second thesis compares them: what a frame takes, and what noise is
//! left after some samples. Noise times time tells which is better.

use super::measure::Plan;
use super::render;
use super::sweep::Sweep;
use super::table::{Cell, Column, Table};
use crate::exit::Failure;
use crate::flags::bench::BenchArgs;
use lumbre::Targets;
use lumbre::core::bsdf::DiffuseSampling;
use lumbre::core::settings::RenderSettings;

/// From here on the error estimate is to be trusted.
const SPP: u32 = 64;

const KINDS: [(&str, DiffuseSampling); 2] =
    [("cosine", DiffuseSampling::Cosine), ("uniform", DiffuseSampling::Uniform)];

const COLUMNS: [Column; 5] = [
    ("hemisphere", "hemisphere"),
    ("frame_ms", "ms a frame"),
    ("spp", "samples per pixel"),
    ("error", "estimated relMSE"),
    ("error_seconds", "relMSE x s"),
];

pub(super) fn table(args: &BenchArgs) -> Result<Table, Failure> {
    let (plan, spp) = (Plan::of(args), args.spp.unwrap_or(SPP));
    Sweep::of(args).walk(args, &COLUMNS, |spot| {
        let row = |(kind, diffuse_sampling): (&str, DiffuseSampling)| {
            let view = spot.view(RenderSettings { diffuse_sampling, ..spot.settings() })?;
            let frame_ms = plan.run(spot.backend, &view, spot.size, 1)?.frame_ms;
            let error = render(spot.backend, &view, spot.size, Targets::spp(spp))?.error;
            spot.note(format_args!("{kind}, {frame_ms:.3} ms a frame"));
            // The time of frames, so that reading back does not count.
            let product = error.map(|e| e * f64::from(spp) * frame_ms * 1e-3);
            let (kind, spp) = (Cell::Text(kind.into()), Cell::Whole(spp.into()));
            Ok(vec![kind, Cell::Number(frame_ms), spp, error.into(), product.into()])
        };
        KINDS.into_iter().map(row).collect()
    })
}
