//! How fast things go: frames that were rendered and frames that were shown, rays, and how long the interface itself took.

use lumbre::session::FrameStats;
use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Frame times that the plot shows.
pub const PLOTTED: usize = 180;
/// Over how long rates are taken, unless that is less than [`FRAMES`].
const WINDOW: Duration = Duration::from_secs(2);
/// Frames that a rate needs.
const FRAMES: f64 = 3.0;
/// Longest that a step of the interface may take.
pub const LIMIT: Duration = Duration::from_millis(50);

/// A frame as the meter keeps it.
#[derive(Clone, Copy, Debug)]
struct Made {
    at: Instant,
    seconds: f64,
    rays: u64,
    samples: u64,
}

/// What was measured.
#[derive(Clone, Debug, Default)]
pub struct Meter {
    made: VecDeque<Made>,
    shown: VecDeque<Instant>,
    /// Milliseconds of the last frames.
    plot: VecDeque<f32>,
    samples: u64,
    last_update: Duration,
    longest_update: Duration,
    updates: u64,
    long_updates: u64,
    answer: Duration,
}

impl Meter {
    /// A frame was rendered. Those without samples are the last one in another look.
    pub fn made(&mut self, stats: &FrameStats, at: Instant) {
        if stats.samples == 0 || stats.seconds <= 0.0 {
            return;
        }
        self.samples += stats.samples;
        self.made.push_back(Made { at, seconds: stats.seconds, rays: stats.rays, samples: stats.samples });
        if self.plot.len() == PLOTTED {
            self.plot.pop_front();
        }
        self.plot.push_back((stats.seconds * 1e3) as f32);
    }

    /// A new frame was put on the screen.
    pub fn shown(&mut self, at: Instant) {
        self.shown.push_back(at);
    }

    /// A step of the interface took so long.
    pub fn updated(&mut self, took: Duration) {
        self.last_update = took;
        self.longest_update = self.longest_update.max(took);
        self.updates += 1;
        self.long_updates += u64::from(took > LIMIT);
    }

    /// A wish was seen on the screen so long after it was made.
    pub fn answered(&mut self, took: Duration) {
        self.answer = took;
    }

    /// From the last wish to the first frame that had it.
    pub fn answer(&self) -> Duration {
        self.answer
    }

    /// Forgets what is too old to count.
    pub fn tick(&mut self, now: Instant) {
        let slow = self.made.back().map_or(0.0, |m| FRAMES * m.seconds);
        let window = WINDOW.max(Duration::try_from_secs_f64(slow).unwrap_or(Duration::MAX));
        let old = |at: Instant| now.saturating_duration_since(at) > window;
        while self.made.front().is_some_and(|m| old(m.at)) {
            self.made.pop_front();
        }
        while self.shown.front().is_some_and(|at| old(*at)) {
            self.shown.pop_front();
        }
    }

    /// Frames rendered a second.
    pub fn rendered_fps(&self, now: Instant) -> f64 {
        rate(self.made.iter().map(|m| m.at), now)
    }

    /// Frames shown a second.
    pub fn shown_fps(&self, now: Instant) -> f64 {
        rate(self.shown.iter().copied(), now)
    }

    /// Mean time of a frame, milliseconds.
    pub fn mean_ms(&self) -> f64 {
        let count = self.made.len().max(1) as f64;
        self.made.iter().map(|m| m.seconds).sum::<f64>() * 1e3 / count
    }

    /// Millions of rays and of samples in a second of rendering.
    pub fn millions(&self) -> (f64, f64) {
        let seconds = self.made.iter().map(|m| m.seconds).sum::<f64>().max(1e-9);
        let sum = |of: fn(&Made) -> u64| self.made.iter().map(of).sum::<u64>() as f64 * 1e-6 / seconds;
        (sum(|m| m.rays), sum(|m| m.samples))
    }

    /// Camera samples since the window opened.
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// Milliseconds of the last frames, the oldest first.
    pub fn plot(&self) -> impl ExactSizeIterator<Item = f32> + '_ {
        self.plot.iter().copied()
    }

    /// The last step of the interface and the longest one.
    pub fn updates(&self) -> (Duration, Duration) {
        (self.last_update, self.longest_update)
    }

    /// Steps of the interface, and those of them longer than [`LIMIT`].
    pub fn update_counts(&self) -> (u64, u64) {
        (self.updates, self.long_updates)
    }
}

/// Events a second: between the first that is kept and now, so that a stop shows.
fn rate(times: impl Iterator<Item = Instant>, now: Instant) -> f64 {
    let (mut first, mut count) = (None, 0u32);
    for at in times {
        first = first.or(Some(at));
        count += 1;
    }
    let span = first.map_or(Duration::ZERO, |first| now.saturating_duration_since(first));
    if count < 2 || span.is_zero() { 0.0 } else { f64::from(count - 1) / span.as_secs_f64() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stats(samples: u64, seconds: f64) -> FrameStats {
        FrameStats { samples, rays: 3 * samples, seconds, ..FrameStats::default() }
    }

    #[test]
    fn rates_are_of_the_last_seconds() {
        let (mut meter, began) = (Meter::default(), Instant::now());
        let at = |i: u64| began + Duration::from_millis(100 * i);
        for i in 0..=50 {
            meter.made(&stats(1_000_000, 0.05), at(i));
            if i % 2 == 0 {
                meter.shown(at(i));
            }
            meter.tick(at(i));
        }
        let now = at(50);
        assert!((meter.rendered_fps(now) - 10.0).abs() < 1e-6);
        assert!((meter.shown_fps(now) - 5.0).abs() < 1e-6, "fewer are shown than rendered");
        assert!((meter.mean_ms() - 50.0).abs() < 1e-6);
        let (rays, samples) = meter.millions();
        assert!((rays - 60.0).abs() < 1e-6 && (samples - 20.0).abs() < 1e-6);
        assert_eq!(meter.samples(), 51_000_000);
        let later = at(100);
        meter.tick(later);
        assert_eq!((meter.rendered_fps(later), meter.mean_ms()), (0.0, 0.0));
    }

    #[test]
    fn slow_frames_have_a_rate() {
        let (mut meter, began) = (Meter::default(), Instant::now());
        let at = |s: u64| began + Duration::from_secs(s);
        for i in 1..=4 {
            meter.made(&stats(1, 5.0), at(5 * i));
            meter.tick(at(5 * i + 4));
        }
        assert!((meter.rendered_fps(at(20)) - 0.2).abs() < 1e-9);
        meter.tick(at(60));
        assert_eq!(meter.rendered_fps(at(60)), 0.0);
    }

    #[test]
    fn frames_without_samples_do_not_count() {
        let mut meter = Meter::default();
        meter.made(&stats(0, 0.0), Instant::now());
        assert_eq!(meter.plot().len(), 0);
        for _ in 0..10 * PLOTTED {
            meter.made(&stats(1, 0.002), Instant::now());
        }
        assert_eq!(meter.plot().len(), PLOTTED);
        assert_eq!(meter.plot().next(), Some(2.0));
    }

    #[test]
    fn the_longest_step_of_the_interface_is_kept() {
        let mut meter = Meter::default();
        for ms in [1, 60, 2] {
            meter.updated(Duration::from_millis(ms));
        }
        assert_eq!(meter.updates(), (Duration::from_millis(2), Duration::from_millis(60)));
        assert_eq!(meter.update_counts(), (3, 1));
    }
}
