//! The thesis's table of hybrid frames: frames per second at each size and depth.

use super::measure::Plan;
use super::sweep::{HD, Sweep};
use super::table::{Cell, Column, Table};
use crate::exit::Failure;
use crate::flags::bench::BenchArgs;
use lumbre::backend::hybrid::frames;
use lumbre::core::hybrid::{FrameView, HybridSettings};

/// Rays one after another.
const DEPTHS: [u32; 4] = [4, 6, 8, 10];

const COLUMNS: [Column; 6] = [
    ("fps", "fps"),
    ("frame_ms", "ms a frame"),
    ("mrays_per_second", "Mrays/s"),
    ("rays", "rays a pixel"),
    ("frames", "frames"),
    ("gpu_ms", "GPU ms"),
];

pub(super) fn table(args: &BenchArgs) -> Result<Table, Failure> {
    let plan = Plan::of(args);
    let sweep = Sweep::of(args).or_sizes(args, &[HD, [1920, 1080]]).or_depths(args, DEPTHS);
    let table = sweep.walk(args, &COLUMNS, |spot| {
        let view = spot.view(spot.settings())?;
        let depth = view.settings.max_depth.unwrap_or(HybridSettings::MOST_DEPTH);
        let settings =
            HybridSettings { depth: depth.min(HybridSettings::MOST_DEPTH), ..HybridSettings::THESIS };
        let mut renderer = spot.backend.frame_renderer()?;
        let shot = FrameView { view: &view, size: spot.size, settings: &settings };
        let figures = plan.run_by(|count| frames(&mut *renderer, count, |_| shot))?;
        spot.note(format_args!("{:.3} ms a frame", figures.frame_ms));
        let pixels = f64::from(spot.size[0]) * f64::from(spot.size[1]);
        Ok(vec![vec![
            Cell::Number(figures.fps),
            Cell::Number(figures.frame_ms),
            Cell::Number(figures.mrays_per_second),
            Cell::Number(figures.mrays_per_second * 1e6 / figures.fps / pixels),
            Cell::Whole(figures.frames as u64),
            Cell::Passes(figures.passes.clone()),
        ]])
    })?;
    Ok(table.with("frames", format!("median of up to {} after {}", args.frames, args.warm_up)))
}
