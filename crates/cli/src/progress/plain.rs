//! Progress in words.

use super::{Finish, Moment};

/// Samples per pixel, rays per second, error and time left.
pub(super) fn figures(m: &Moment) -> String {
    let left = m.seconds_left.map_or_else(|| "-".into(), duration);
    let (error, speed) = (error(m.error), m.mrays_per_second());
    format!("{} spp, error {error}, {speed:.2} Mrays/s, {left} left", m.spp)
}

/// A line on the way.
pub(super) fn moment(m: &Moment) -> String {
    let share = m.fraction().map_or_else(|| "  -".into(), |f| format!("{:3.0}", 100.0 * f));
    format!("{share} %  {}", figures(m))
}

/// The line at the end.
pub(super) fn finish(f: &Finish) -> String {
    let done = &f.outcome;
    let rate = |n: u64| millions_per_second(n, done.seconds);
    format!(
        "render: {} for {} samples and {} rays ({:.2} Msamples/s, {:.2} Mrays/s); load {}, build {}, write {}",
        duration(done.seconds),
        count(done.progress.samples),
        count(done.progress.rays),
        rate(done.progress.samples),
        rate(done.progress.rays),
        duration(f.load_seconds),
        duration(f.build_seconds),
        duration(f.write_seconds),
    )
}

pub(super) fn millions_per_second(n: u64, seconds: f64) -> f64 {
    n as f64 / seconds.max(1e-9) * 1e-6
}

/// An estimated error in two digits.
pub(crate) fn error(error: Option<f64>) -> String {
    match error {
        None => "-".into(),
        Some(e) if e == 0.0 || (1e-4..1e3).contains(&e) => {
            // Two digits that count: 0.0034, 0.12, 47.
            let digits = if e == 0.0 { 0 } else { (1.0 - e.log10().floor()).max(0.0) as usize };
            format!("{e:.digits$}")
        }
        Some(e) => format!("{e:.1e}"),
    }
}

pub(super) fn count(n: u64) -> String {
    match n {
        0..100_000 => n.to_string(),
        100_000..10_000_000 => format!("{:.2} M", n as f64 * 1e-6),
        _ => format!("{:.1} M", n as f64 * 1e-6),
    }
}

/// A length of time for people.
pub(crate) fn duration(seconds: f64) -> String {
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

    #[test]
    fn errors_have_two_digits() {
        let all =
            [None, Some(0.0), Some(0.003_44), Some(0.12), Some(4.7), Some(47.3), Some(2.5e-6)].map(error);
        assert_eq!(all, ["-", "0", "0.0034", "0.12", "4.7", "47", "2.5e-6"]);
    }
}
