//! How near the path tracer is to the device's ceiling: the rays of a frame, traced again by themselves with nothing shaded, over the time
//! of the frame.

use super::measure::{Figures, Plan};
use super::sweep::Sweep;
use super::table::{Cell, Column, Table};
use crate::device;
use crate::exit::{Code, Failure};
use crate::flags::bench::BenchArgs;
use lumbre::Replayed;

/// Scattering events.
const DEPTHS: [u32; 2] = [4, 10];

/// Replays whose median counts.
const RUNS: u32 = 9;

const COLUMNS: [Column; 11] = [
    ("frame_ms", "ms a frame"),
    ("replay_ms", "ms of its rays"),
    ("share", "share"),
    ("path_ms", "ms of paths"),
    ("shadow_ms", "ms of shadow rays"),
    ("path_rays", "path rays"),
    ("shadow_rays", "shadow rays"),
    ("left_out", "rays left out"),
    ("replay_mrays_per_second", "Mrays/s of the replay"),
    ("mrays_per_second", "Mrays/s of the frame"),
    ("gpu_ms", "GPU ms"),
];

pub(super) fn table(args: &BenchArgs) -> Result<Table, Failure> {
    let open = device::open(&args.device)?;
    if !open.is_gpu() {
        return Err(unavailable(open.why()));
    }
    drop(open);
    let plan = Plan::of(args);
    let table = Sweep::of(args).or_depths(args, DEPTHS).walk(args, &COLUMNS, |spot| {
        let view = spot.view(spot.settings())?;
        let figures = plan.run(spot.backend, &view, spot.size, 1)?;
        let replayed = spot.backend.replayed(&view, spot.size, RUNS)?;
        let replayed = replayed.ok_or_else(|| unavailable(&spot.backend.device()))?;
        spot.note(format_args!("{:.3} ms a frame, {:.3} ms its rays", figures.frame_ms, replayed.ms));
        Ok(vec![row(&figures, &replayed)])
    })?;
    let frames = format!("median of up to {} after {}", args.frames, args.warm_up);
    Ok(table.with("frames", frames).with("replays", format!("median of {RUNS} after 1")))
}

fn unavailable(why: &str) -> Failure {
    Failure::new(Code::Unavailable, format!("share: no GPU whose rays could be replayed ({why})"))
}

fn row(f: &Figures, r: &Replayed) -> Vec<Cell> {
    let rays = r.path_rays + r.shadow_rays;
    // A device without a clock says 0.
    let timed = |value: f64| Some(value).filter(|_| r.ms > 0.0).into();
    vec![
        Cell::Number(f.frame_ms),
        timed(r.ms),
        timed(r.ms / f.frame_ms),
        timed(r.path_ms),
        timed(r.shadow_ms),
        Cell::Whole(r.path_rays),
        Cell::Whole(r.shadow_rays),
        Cell::Whole(r.left_out),
        timed(rays as f64 / r.ms * 1e-3),
        Cell::Number(f.mrays_per_second),
        Cell::Passes(f.passes.clone()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_is_that_of_the_frame() {
        let figures = Figures {
            frames: 1,
            fps: 50.0,
            frame_ms: 20.0,
            mrays_per_second: 4.0,
            path_length: None,
            passes: Vec::new(),
        };
        let of = |ms| Replayed { path_rays: 60_000, shadow_rays: 20_000, ms, ..Replayed::default() };
        let timed = row(&figures, &of(8.0));
        assert_eq!((&timed[2], &timed[8]), (&Cell::Number(0.4), &Cell::Number(10.0)));
        let untimed = row(&figures, &of(0.0));
        assert_eq!((&untimed[1], &untimed[2], &untimed[8]), (&Cell::None, &Cell::None, &Cell::None));
        assert_eq!((timed.len(), untimed.len()), (COLUMNS.len(), COLUMNS.len()));
    }
}
