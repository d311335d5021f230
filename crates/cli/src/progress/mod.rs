//! Progress of a render: a bar on a terminal, lines elsewhere, JSON for programs, or nothing.

mod bar;
mod json;
mod plain;

use crate::console;
use crate::exit::Failure;
use crate::flags::run::ProgressFlag;
use lumbre::core::control::Progress;
use std::io::IsTerminal;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// What is being rendered.
#[derive(Clone, Debug)]
pub(crate) struct Start {
    pub(crate) device: String,
    pub(crate) threads: usize,
    pub(crate) size: [u32; 2],
    pub(crate) spp: u32,
}

impl Start {
    fn total(&self) -> u64 {
        u64::from(self.size[0]) * u64::from(self.size[1]) * u64::from(self.spp)
    }
}

/// How a render went.
#[derive(Clone, Debug)]
pub(crate) struct Finish {
    pub(crate) done: Progress,
    pub(crate) load_seconds: f64,
    pub(crate) build_seconds: f64,
    /// The render alone.
    pub(crate) render_seconds: f64,
    pub(crate) write_seconds: f64,
    pub(crate) interrupted: bool,
    pub(crate) non_finite: u64,
    pub(crate) saturated: u64,
}

/// A moment of a render.
#[derive(Clone, Copy, Debug)]
struct Moment {
    done: Progress,
    total: u64,
    seconds: f64,
}

impl Moment {
    fn mrays_per_second(&self) -> f64 {
        self.done.rays as f64 / self.seconds.max(1e-9) * 1e-6
    }
    fn fraction(&self) -> f64 {
        self.done.samples as f64 / self.total.max(1) as f64
    }
    /// `None` before the first samples.
    fn seconds_left(&self) -> Option<f64> {
        let fraction = self.fraction();
        (fraction > 0.0).then(|| self.seconds * (1.0 - fraction).max(0.0) / fraction)
    }
}

#[derive(Debug)]
enum Style {
    Bar(bar::Bar),
    Plain,
    Json,
    Off,
}

/// Shows progress. Hears of every tile from any thread and speaks at intervals.
#[derive(Debug)]
pub(crate) struct Reporter {
    style: Style,
    start: Start,
    began: Instant,
    interval: Duration,
    /// Milliseconds after `began` at which to speak again.
    due: AtomicU64,
    /// The most heard of so far: calls may overtake each other.
    samples: AtomicU64,
    rays: AtomicU64,
}

impl Reporter {
    /// Begins to report; `json` says at once what is about to be rendered.
    pub(crate) fn begin(flag: ProgressFlag, start: Start) -> Result<Self, Failure> {
        let terminal = std::io::stderr().is_terminal();
        let (style, interval) = match flag {
            ProgressFlag::Auto if terminal => (Style::Bar(bar::Bar::new(start.total())), 0),
            ProgressFlag::Auto | ProgressFlag::Plain => (Style::Plain, 5000),
            ProgressFlag::Json => (Style::Json, 500),
            ProgressFlag::Off => (Style::Off, 0),
        };
        if let Style::Json = style {
            console::result(json::start(&start))?;
        }
        // A program that listens hears of the first tile, a reader of lines only of renders that take a while.
        let first = if let Style::Plain = style { interval } else { 0 };
        Ok(Reporter {
            style,
            start,
            began: Instant::now(),
            interval: Duration::from_millis(interval),
            due: AtomicU64::new(first),
            samples: AtomicU64::new(0),
            rays: AtomicU64::new(0),
        })
    }

    /// What has been done so far.
    pub(crate) fn heard(&self, so_far: Progress) {
        let samples = self.samples.fetch_max(so_far.samples, Ordering::Relaxed).max(so_far.samples);
        let rays = self.rays.fetch_max(so_far.rays, Ordering::Relaxed).max(so_far.rays);
        let elapsed = self.began.elapsed();
        let now = elapsed.as_millis() as u64;
        let due = self.due.load(Ordering::Relaxed);
        let next = now + self.interval.as_millis() as u64;
        // Of several threads that find it due, one speaks.
        if now < due || self.due.compare_exchange(due, next, Ordering::Relaxed, Ordering::Relaxed).is_err() {
            return;
        }
        let done = Progress { samples, rays };
        let moment = Moment { done, total: self.start.total(), seconds: elapsed.as_secs_f64() };
        match &self.style {
            Style::Bar(bar) => bar.show(&moment),
            Style::Plain => console::note(plain::moment(&moment)),
            // Whoever listened may be gone; the picture is still wanted.
            Style::Json => drop(console::result(json::moment(&moment))),
            Style::Off => {}
        }
    }

    /// The render is over: the bar goes away.
    pub(crate) fn rendered(&self) {
        if let Style::Bar(_) = self.style {
            console::set_bar(None);
        }
    }

    /// All is written: the summary.
    pub(crate) fn finish(&self, finish: &Finish) -> Result<(), Failure> {
        match self.style {
            Style::Json => console::result(json::finish(&self.start, finish)),
            Style::Bar(_) | Style::Plain => {
                console::note(plain::finish(finish));
                Ok(())
            }
            Style::Off => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn start() -> Start {
        Start { device: "CPU".into(), threads: 2, size: [10, 10], spp: 4 }
    }

    #[test]
    fn time_left_follows_from_what_is_done() {
        let done = Progress { samples: 100, rays: 5_000_000 };
        let m = Moment { done, total: 400, seconds: 2.0 };
        assert_eq!((m.fraction(), m.seconds_left(), m.mrays_per_second()), (0.25, Some(6.0), 2.5));
        assert_eq!(Moment { done: Progress::default(), ..m }.seconds_left(), None);
    }

    #[test]
    fn reports_never_go_back_when_tiles_overtake_each_other() {
        let r = Reporter::begin(ProgressFlag::Off, start()).unwrap();
        r.heard(Progress { samples: 50, rays: 80 });
        r.heard(Progress { samples: 40, rays: 60 });
        assert_eq!((r.samples.into_inner(), r.rays.into_inner()), (50, 80));
    }

    #[test]
    fn json_lines_are_objects_with_the_promised_keys() {
        let finish = Finish {
            done: Progress { samples: 400, rays: 900 },
            load_seconds: 0.5,
            build_seconds: 0.25,
            render_seconds: 2.0,
            write_seconds: 0.125,
            interrupted: false,
            non_finite: 0,
            saturated: 0,
        };
        let line: serde_json::Value = serde_json::from_str(&json::finish(&start(), &finish)).unwrap();
        assert_eq!(line["event"], "done");
        for (key, value) in [("render_seconds", 2.0), ("load_seconds", 0.5), ("build_seconds", 0.25)] {
            assert_eq!(line[key], value, "{key}");
        }
        for (key, value) in [("samples", 400), ("rays", 900), ("width", 10), ("height", 10), ("spp", 4)] {
            assert_eq!(line[key], value, "{key}");
        }
        let none = Moment { done: Progress::default(), total: 400, seconds: 0.0 };
        let line: serde_json::Value = serde_json::from_str(&json::moment(&none)).unwrap();
        assert!(line["seconds_left"].is_null() && line["samples"] == 0);
    }
}
