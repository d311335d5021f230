//! Progress for programs: one JSON object per line. `event` is `start`, `progress` or `done`; the last line is `done`, printed
//! when the files are in place. Times are seconds.

use super::{Finish, Moment, Start};
use serde_json::json;

pub(super) fn start(s: &Start) -> String {
    json!({
        "event": "start",
        "version": env!("CARGO_PKG_VERSION"),
        "device": s.device,
        "threads": s.threads,
        "width": s.size[0],
        "height": s.size[1],
        "spp": s.spp,
    })
    .to_string()
}

pub(super) fn moment(m: &Moment) -> String {
    json!({
        "event": "progress",
        "samples": m.done.samples,
        "total_samples": m.total,
        "rays": m.done.rays,
        "mrays_per_second": m.mrays_per_second(),
        "seconds": m.seconds,
        "seconds_left": m.seconds_left(),
    })
    .to_string()
}

pub(super) fn finish(s: &Start, f: &Finish) -> String {
    json!({
        "event": "done",
        "interrupted": f.interrupted,
        "load_seconds": f.load_seconds,
        "build_seconds": f.build_seconds,
        "render_seconds": f.render_seconds,
        "write_seconds": f.write_seconds,
        "samples": f.done.samples,
        "rays": f.done.rays,
        "width": s.size[0],
        "height": s.size[1],
        "spp": s.spp,
        "threads": s.threads,
        "device": s.device,
        "non_finite_samples": f.non_finite,
        "saturated_sums": f.saturated,
    })
    .to_string()
}
