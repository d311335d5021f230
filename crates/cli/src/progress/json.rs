//! Progress for programs: one JSON object per line. `event` is `start`, `progress` or `done`; the last line is `done`, printed
//! when the files are in place. Times are seconds, memory is bytes; what is not known is null. `spp` of `start` is the target,
//! later on what every pixel has got.

use super::{Finish, Moment, Start, plain};
use lumbre::{Ended, PassTime};
use serde_json::{Value, json};

pub(super) fn start(s: &Start) -> String {
    json!({
        "event": "start",
        "version": env!("CARGO_PKG_VERSION"),
        "device": s.device,
        "threads": s.threads,
        "width": s.size[0],
        "height": s.size[1],
        "spp": s.targets.spp,
        "target_seconds": s.targets.time.map(|t| t.as_secs_f64()),
        "target_error": s.targets.error,
    })
    .to_string()
}

pub(super) fn moment(m: &Moment) -> String {
    json!({
        "event": "progress",
        "samples": m.done.samples,
        "total_samples": m.total,
        "spp": m.spp,
        "error": m.error,
        "rays": m.done.rays,
        "mrays_per_second": m.mrays_per_second(),
        "seconds": m.seconds,
        "seconds_left": m.seconds_left,
    })
    .to_string()
}

pub(super) fn finish(s: &Start, f: &Finish) -> String {
    let done = &f.outcome;
    let mut line = json!({
        "event": "done",
        "interrupted": matches!(done.ended, Ended::Cancelled | Ended::Failed),
        "ended_by": match done.ended {
            Ended::Spp => "spp",
            Ended::Time => "time",
            Ended::Error => "error",
            Ended::Cancelled => "interrupt",
            Ended::Failed => "device",
        },
        "error": done.error,
        "load_seconds": f.load_seconds,
        "build_seconds": f.build_seconds,
        "render_seconds": done.seconds,
        "write_seconds": f.write_seconds,
        "samples": done.progress.samples,
        "rays": done.progress.rays,
        "width": s.size[0],
        "height": s.size[1],
        "spp": done.spp,
        "threads": s.threads,
        "device": s.device,
        "non_finite_samples": f.non_finite,
        "saturated_sums": f.saturated,
    });
    if let (Some(stats), Value::Object(line)) = (&f.stats, &mut line) {
        let m = &stats.memory;
        let memory = json!({
            "scene": m.scene,
            "acceleration": m.acceleration,
            "film": m.film,
            "peak": m.peak,
        });
        let speed = json!({
            "mrays_per_second": plain::millions_per_second(done.progress.rays, done.seconds),
            "msamples_per_second": plain::millions_per_second(done.progress.samples, done.seconds),
            "rays_per_sample": stats.rays_per_sample(f),
        });
        let pass = |p: &PassTime| json!({ "name": p.name, "count": p.count, "mean_ms": p.mean_ms() });
        let passes: Vec<Value> = stats.passes.iter().map(pass).collect();
        line.insert("stats".into(), json!({ "memory": memory, "speed": speed, "gpu_passes": passes }));
    }
    line.to_string()
}
