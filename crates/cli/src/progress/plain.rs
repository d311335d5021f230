//! Progress in words.

use super::{Finish, Moment};

/// Samples, rays per second and time left.
pub(super) fn figures(m: &Moment) -> String {
    let left = m.seconds_left().map_or_else(|| "-".into(), duration);
    format!("{} samples, {:.2} Mrays/s, {left} left", count(m.done.samples), m.mrays_per_second())
}

/// A line on the way.
pub(super) fn moment(m: &Moment) -> String {
    format!("{:3.0} %  {}", 100.0 * m.fraction(), figures(m))
}

/// The line at the end.
pub(super) fn finish(f: &Finish) -> String {
    let rate = |n: u64| n as f64 / f.render_seconds.max(1e-9) * 1e-6;
    format!(
        "render: {} for {} samples and {} rays ({:.2} Msamples/s, {:.2} Mrays/s); load {}, build {}, write {}",
        duration(f.render_seconds),
        count(f.done.samples),
        count(f.done.rays),
        rate(f.done.samples),
        rate(f.done.rays),
        duration(f.load_seconds),
        duration(f.build_seconds),
        duration(f.write_seconds),
    )
}

fn count(n: u64) -> String {
    match n {
        0..100_000 => n.to_string(),
        100_000..10_000_000 => format!("{:.2} M", n as f64 * 1e-6),
        _ => format!("{:.1} M", n as f64 * 1e-6),
    }
}

fn duration(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    match whole {
        0..60 => format!("{seconds:.1} s"),
        60..3600 => format!("{} min {:02} s", whole / 60, whole % 60),
        _ => format!("{} h {:02} min", whole / 3600, whole % 3600 / 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_and_counts_are_short() {
        assert_eq!(duration(0.25), "0.2 s");
        assert_eq!(duration(59.7), "1 min 00 s");
        assert_eq!(duration(3725.0), "1 h 02 min");
        assert_eq!(
            (count(999), count(1_234_567), count(59_000_000)),
            ("999".into(), "1.23 M".into(), "59.0 M".into())
        );
    }
}
