//! Progress of a render: a bar on a terminal, lines elsewhere, JSON for programs, or nothing.

mod bar;
mod json;
pub(crate) mod plain;
pub(crate) mod stats;

use crate::console;
use crate::exit::Failure;
use crate::flags::run::ProgressFlag;
use lumbre::core::control::Progress;
use lumbre::{Outcome, SoFar, Targets};
use stats::Stats;
use std::io::IsTerminal;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// What is being rendered.
#[derive(Clone, Debug)]
pub(crate) struct Start {
    pub(crate) device: String,
    pub(crate) threads: usize,
    pub(crate) size: [u32; 2],
    pub(crate) targets: Targets,
}

impl Start {
    /// Camera samples, where the target says how many.
    fn total(&self) -> Option<u64> {
        let pixels = u64::from(self.size[0]) * u64::from(self.size[1]);
        self.targets.spp.map(|spp| pixels * u64::from(spp))
    }

    /// A moment so many seconds after the beginning.
    fn moment(&self, done: Progress, so_far: &SoFar, seconds: f64) -> Moment {
        let total = self.total();
        let by_samples = total.filter(|_| done.samples > 0).map(|total| {
            let share = done.samples as f64 / total.max(1) as f64;
            seconds * (1.0 - share).max(0.0) / share
        });
        let by_time = self.targets.time.map(|t| (t.as_secs_f64() - seconds).max(0.0));
        // What the last pass promised, most of all of the error.
        let promised = so_far.seconds_left.map(|left| (left + so_far.seconds - seconds).max(0.0));
        let left = [by_samples, by_time, promised].into_iter().flatten().reduce(f64::min);
        Moment { done, total, spp: so_far.spp, error: so_far.error, seconds, seconds_left: left }
    }
}

/// How a render went.
#[derive(Clone, Debug)]
pub(crate) struct Finish {
    pub(crate) outcome: Outcome,
    pub(crate) load_seconds: f64,
    pub(crate) build_seconds: f64,
    pub(crate) write_seconds: f64,
    pub(crate) non_finite: u64,
    pub(crate) saturated: u64,
    /// Where a table was asked for.
    pub(crate) stats: Option<Stats>,
}

/// A moment of a render.
#[derive(Clone, Copy, Debug)]
struct Moment {
    done: Progress,
    total: Option<u64>,
    /// What every pixel has got.
    spp: u32,
    error: Option<f64>,
    seconds: f64,
    /// Towards whichever target comes first; `None` before anything is known.
    seconds_left: Option<f64>,
}

impl Moment {
    fn mrays_per_second(&self) -> f64 {
        plain::millions_per_second(self.done.rays, self.seconds)
    }
    /// Of the time that it will take.
    fn fraction(&self) -> Option<f64> {
        self.seconds_left.map(|left| self.seconds / (self.seconds + left).max(1e-9))
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
    /// After the last pass.
    passed: Mutex<SoFar>,
}

impl Reporter {
    /// Begins to report; `json` says at once what is about to be rendered.
    pub(crate) fn begin(flag: ProgressFlag, start: Start) -> Result<Self, Failure> {
        let terminal = std::io::stderr().is_terminal();
        let (style, interval) = match flag {
            ProgressFlag::Auto if terminal => (Style::Bar(bar::Bar::new()), 0),
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
            passed: Mutex::default(),
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
        let so_far = *self.passed.lock().unwrap_or_else(PoisonError::into_inner);
        let moment = self.start.moment(done, &so_far, elapsed.as_secs_f64());
        match &self.style {
            Style::Bar(bar) => bar.show(&moment),
            Style::Plain => console::note(plain::moment(&moment)),
            // Whoever listened may be gone; the picture is still wanted.
            Style::Json => drop(console::result(json::moment(&moment))),
            Style::Off => {}
        }
    }

    /// Every pixel has got some samples more.
    pub(crate) fn passed(&self, so_far: &SoFar) {
        *self.passed.lock().unwrap_or_else(PoisonError::into_inner) = *so_far;
    }

    /// The render is over: the bar goes away.
    pub(crate) fn rendered(&self) {
        if let Style::Bar(_) = self.style {
            console::set_bar(None);
        }
    }

    /// All is written: the summary.
    pub(crate) fn finish(&self, finish: &Finish) -> Result<(), Failure> {
        if let Style::Json = self.style {
            return console::result(json::finish(&self.start, finish));
        }
        if !matches!(self.style, Style::Off) {
            console::note(plain::finish(finish));
        }
        if let Some(stats) = &finish.stats {
            stats.table(finish).iter().for_each(console::note);
        }
        Ok(())
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use lumbre::Ended;

    fn start() -> Start {
        Start { device: "CPU".into(), threads: 2, size: [10, 10], targets: Targets::spp(4) }
    }

    /// A render that is done.
    pub(crate) fn finished() -> Finish {
        let progress = Progress { samples: 400, rays: 900 };
        Finish {
            outcome: Outcome { ended: Ended::Spp, spp: 4, progress, seconds: 2.0, error: Some(0.125) },
            load_seconds: 0.5,
            build_seconds: 0.25,
            write_seconds: 0.125,
            non_finite: 0,
            saturated: 0,
            stats: None,
        }
    }

    #[test]
    fn time_left_is_that_of_the_first_target() {
        let done = Progress { samples: 100, rays: 5_000_000 };
        let so_far = SoFar { spp: 1, seconds: 1.5, ..SoFar::default() };
        let m = start().moment(done, &so_far, 2.0);
        assert_eq!((m.fraction(), m.seconds_left, m.mrays_per_second()), (Some(0.25), Some(6.0), 2.5));
        let clean = SoFar { seconds_left: Some(3.5), ..so_far };
        assert_eq!(start().moment(done, &clean, 2.0).seconds_left, Some(3.0));
        let late = Start { targets: Targets::time(Duration::from_secs(3)), ..start() };
        assert_eq!(late.moment(done, &so_far, 2.0).seconds_left, Some(1.0));
        let none = Start { targets: Targets::default(), ..start() }.moment(done, &so_far, 2.0);
        assert_eq!((none.seconds_left, none.fraction(), none.total), (None, None, None));
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
        let parsed = |line: String| -> serde_json::Value { serde_json::from_str(&line).unwrap() };
        let line = parsed(json::finish(&start(), &finished()));
        assert_eq!((&line["event"], &line["ended_by"]), (&"done".into(), &"spp".into()));
        for (key, value) in
            [("render_seconds", 2.0), ("load_seconds", 0.5), ("build_seconds", 0.25), ("error", 0.125)]
        {
            assert_eq!(line[key], value, "{key}");
        }
        for (key, value) in [("samples", 400), ("rays", 900), ("width", 10), ("height", 10), ("spp", 4)] {
            assert_eq!(line[key], value, "{key}");
        }
        assert!(line["stats"].is_null());
        let line = parsed(json::moment(&start().moment(Progress::default(), &SoFar::default(), 0.0)));
        assert!(line["seconds_left"].is_null() && line["error"].is_null() && line["samples"] == 0);
        assert_eq!((&line["spp"], &line["total_samples"]), (&0.into(), &400.into()));
        let line = parsed(json::start(&Start { targets: Targets::error(0.5), ..start() }));
        assert!(line["spp"].is_null() && line["target_seconds"].is_null() && line["target_error"] == 0.5);
    }
}
