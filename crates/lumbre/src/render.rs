//! Rendering a picture until a target is met: passes over the whole picture, so that it is even whenever it ends.

use crate::backend::{Backend, RenderError};
use crate::estimate::Estimator;
use crate::targets::{Ended, Outcome, RenderFailed, SoFar, Targets};
use lumbre_core::Film;
use lumbre_core::control::{Control, Progress};
use lumbre_core::settings::View;
use std::time::Instant;

/// Most samples between two looks at the picture where they may end the render.
const LONGEST_STEP: u32 = 16;
/// Seconds up to which more samples than that are taken at a time where looks are for people only: a fast device would spend more
/// time on looks, and on bringing the film to them, than on samples.
const LONG_STEP: f64 = 0.5;
/// Seconds that a pass should take at most, so that a time limit, an observer and the display of the error are served soon; a
/// pass takes one sample of each pixel at least.
const LONGEST_PASS: f64 = 1.0;
/// Seconds by which the last pass may miss a time limit, if it is expected to end that close behind it.
const LATE: f64 = 0.25;
/// Fewer samples per pixel than this are not trusted to say that the picture is good.
const LEAST_FOR_ERROR: u32 = 64;
/// The same for a picture whose samples are all alike.
const LEAST_IN_THE_DARK: u32 = 1024;

/// A [`Control`] that also sees the picture after each pass.
pub trait Watch: Control {
    /// Every pixel has got `so_far.spp` samples. Called from the thread that renders, which waits.
    fn passed(&self, _film: &Film, _so_far: &SoFar) {}
    /// True to end a cancelled render with the pass that it is in, which takes about a second or one sample of each pixel, so
    /// that the film stays even; otherwise it ends within the pass.
    fn ends_even(&self) -> bool {
        false
    }
    /// Something to tell people, in one line: that a device failed and another one goes on.
    fn notice(&self, _what: &str) {}
}

impl Watch for () {}

/// Adds samples to a film until the first of the targets is met; `watch` hears of it on the way and may end it earlier. It runs
/// on the rayon pool that it is called from.
///
/// The film may hold other samples already; its error is then estimated from the spread of all samples alone
/// ([`crate::estimate`]).
///
/// A device that fails is replaced where the backend knows another one ([`Backend::recover`]): `watch` gets a notice, the pass
/// that failed is made again, and the picture is of the same samples as if nothing had happened.
///
/// # Errors
/// If the device fails and there is no other. The film then holds the passes before, whole: every pixel has the samples that
/// the error's `outcome` tells.
///
/// ```no_run
/// # use lumbre::prelude::*;
/// # fn f(backend: &dyn Backend, view: &View) -> Result<(), lumbre::RenderFailed> {
/// let mut film = Film::new(800, 600);
/// let targets = Targets::error(0.005).or_spp(4096).or_time(std::time::Duration::from_secs(60));
/// let outcome = lumbre::render(backend, view, targets, &mut film, &())?;
/// println!("{} samples per pixel, estimated relMSE {:?}", outcome.spp, outcome.error);
/// # Ok(())
/// # }
/// ```
pub fn render(
    backend: &dyn Backend,
    view: &View,
    targets: impl Into<Targets>,
    film: &mut Film,
    watch: &dyn Watch,
) -> Result<Outcome, RenderFailed> {
    let targets = targets.into();
    let estimator = Estimator::new(film, &view.settings);
    let mut run = Run {
        targets,
        began: Instant::now(),
        per_sample: None,
        estimator,
        looked_at: 0,
        so_far: SoFar::default(),
    };
    // So that what is done once does not count as the speed of the first pass.
    let mut warm = false;
    let (ended, failure) = loop {
        if let Some(ended) = run.met() {
            break (ended, None);
        }
        if watch.cancelled() {
            break (Ended::Cancelled, None);
        }
        let worked = if warm { Ok(()) } else { backend.warm_up(view) };
        match worked.and_then(|()| run.pass(backend, view, film, watch)) {
            Ok(true) => watch.passed(film, &run.so_far),
            Ok(false) => break (Ended::Cancelled, None),
            Err(e) => match backend.recover(e) {
                Ok(what) => {
                    // The other device has a speed of its own.
                    run.per_sample = None;
                    watch.notice(&what);
                }
                Err(e) => break (Ended::Failed, Some(e)),
            },
        }
        warm = run.per_sample.is_some();
    };
    if ended != Ended::Cancelled {
        run.look(film);
    }
    let SoFar { spp, progress, error, .. } = run.so_far;
    let outcome = Outcome { ended, spp, progress, error, seconds: run.began.elapsed().as_secs_f64() };
    failure.map_or(Ok(outcome), |error| Err(RenderFailed { error, outcome }))
}

/// A render on its way.
struct Run {
    targets: Targets,
    began: Instant,
    /// Seconds for one sample of each pixel, as of the last pass.
    per_sample: Option<f64>,
    estimator: Estimator,
    /// Samples per pixel at the last look.
    looked_at: u32,
    so_far: SoFar,
}

impl Run {
    /// The target that is met, if any.
    fn met(&self) -> Option<Ended> {
        let (spp, error) = (self.so_far.spp, self.so_far.error);
        let good = self.targets.error.zip(error).is_some_and(|(wanted, e)| e <= wanted);
        // No spread at all is no light at all, or light that is yet to be found.
        let least = if error == Some(0.0) { LEAST_IN_THE_DARK } else { LEAST_FOR_ERROR };
        if good && is_look(spp) && spp >= least {
            return Some(Ended::Error);
        }
        if spp >= self.targets.most() {
            return Some(Ended::Spp);
        }
        (spp > 0 && self.room() == Some(0)).then_some(Ended::Time)
    }

    /// How many samples of each pixel fit into the time that is left; `None` without a limit.
    fn room(&self) -> Option<u32> {
        let left = self.targets.time?.as_secs_f64() - self.began.elapsed().as_secs_f64();
        let one = self.per_sample?;
        Some(if left > 0.0 && left < one && one < left + LATE { 1 } else { fitting(left, one) })
    }

    /// Samples between looks: a power of two.
    fn step(&self) -> u32 {
        match (self.targets.error, self.per_sample) {
            // The same looks on every machine: the same samples then end it.
            (Some(_), _) | (None, None) => LONGEST_STEP,
            (None, Some(one)) => match fitting(LONG_STEP, one).clamp(LONGEST_STEP, 1 << 20) {
                most if most.is_power_of_two() => most,
                most => most.next_power_of_two() / 2,
            },
        }
    }

    /// Samples of the next pass: up to the next look at the picture, within the bounds of time.
    fn length(&self) -> u32 {
        let spp = self.so_far.spp;
        let to_look = next_look(spp, self.step()).min(self.targets.most()) - spp;
        let short = self.per_sample.map_or(1, |s| fitting(LONGEST_PASS, s).max(1));
        to_look.min(short).min(self.room().unwrap_or(u32::MAX).max(1))
    }

    /// One pass over the picture; false if it was cancelled on the way. After an error all is as before.
    fn pass(
        &mut self,
        backend: &dyn Backend,
        view: &View,
        film: &mut Film,
        watch: &dyn Watch,
    ) -> Result<bool, RenderError> {
        let length = self.length();
        let first = self.targets.first_sample + self.so_far.spp;
        let began = Instant::now();
        let earlier = Earlier { done: self.so_far.progress, watch };
        let done = backend.render(view, first..first + length, film, &earlier)?;
        self.so_far.progress = sum(self.so_far.progress, done);
        if done.samples < film.pixels().len() as u64 * u64::from(length) {
            return Ok(false);
        }
        self.per_sample = Some(began.elapsed().as_secs_f64() / f64::from(length));
        self.so_far.spp += length;
        let last = self.so_far.spp == self.targets.most() || self.room() == Some(0);
        if is_look(self.so_far.spp) || last {
            self.look(film);
        }
        self.so_far.seconds = self.began.elapsed().as_secs_f64();
        self.so_far.seconds_left = self.seconds_left();
        Ok(true)
    }

    /// Estimates the error of the film as it is now.
    fn look(&mut self, film: &Film) {
        if self.looked_at != self.so_far.spp {
            self.looked_at = self.so_far.spp;
            self.so_far.error = self.estimator.look(film, self.so_far.spp);
        }
    }

    /// Until the first of the targets, at the speed of the last pass.
    fn seconds_left(&self) -> Option<f64> {
        let spp = f64::from(self.so_far.spp);
        let wanted = self.targets.spp.map(f64::from);
        let clean = self.targets.error.and_then(|e| self.estimator.spp_for(e));
        let clean = clean.map(|n| n.max(f64::from(LEAST_FOR_ERROR)));
        let samples = wanted.into_iter().chain(clean).map(|n| (n - spp).max(0.0)).reduce(f64::min);
        let by_samples = samples.zip(self.per_sample).map(|(n, s)| n * s);
        let by_time = self.targets.time.map(|t| (t.as_secs_f64() - self.so_far.seconds).max(0.0));
        by_samples.into_iter().chain(by_time).reduce(f64::min)
    }
}

/// How many times `one` fits into `seconds`.
fn fitting(seconds: f64, one: f64) -> u32 {
    // `as` saturates: a pass too fast to be measured fits as often as you like.
    (seconds.max(0.0) / one.max(1e-12)) as u32
}

/// With a step of 16, the error is looked at after 1, 2, 4, 8, 16, 32, 48, … samples per pixel: all powers of two, as the estimate
/// wants them, and often enough to end soon after a target is met.
fn next_look(spp: u32, step: u32) -> u32 {
    if spp < step { (spp + 1).next_power_of_two() } else { (spp / step * step).saturating_add(step) }
}

fn is_look(spp: u32) -> bool {
    spp > 0 && next_look(spp - 1, LONGEST_STEP) == spp
}

fn sum(a: Progress, b: Progress) -> Progress {
    Progress { samples: a.samples + b.samples, rays: a.rays + b.rays }
}

/// Adds the passes before this one to what the backend reports.
struct Earlier<'a> {
    done: Progress,
    watch: &'a dyn Watch,
}

impl Control for Earlier<'_> {
    fn cancelled(&self) -> bool {
        !self.watch.ends_even() && self.watch.cancelled()
    }
    fn progress(&self, so_far: Progress) {
        self.watch.progress(sum(self.done, so_far));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_core::film::FilmSample;
    use lumbre_core::hash::unit;
    use lumbre_core::settings::RenderSettings;
    use lumbre_core::{Camera, Rgb};
    use std::ops::Range;
    use std::sync::Mutex;
    use std::time::Duration;

    /// Uniform noise, each sample as slow as asked; remembers what it was asked for.
    #[derive(Default)]
    struct Noise {
        nap: Duration,
        asked: Mutex<Vec<Range<u32>>>,
    }

    impl Backend for Noise {
        fn device(&self) -> String {
            "none".into()
        }
        fn memory(&self) -> u64 {
            0
        }
        fn render(
            &self,
            _: &View,
            samples: Range<u32>,
            film: &mut Film,
            control: &dyn Control,
        ) -> Result<Progress, RenderError> {
            self.asked.lock().unwrap().push(samples.clone());
            let mut done = Progress::default();
            for i in samples {
                for p in 0..film.width() * film.height() {
                    if control.cancelled() {
                        return Ok(done);
                    }
                    let (x, y) = (p % film.width(), p / film.width());
                    film.add(
                        [x, y],
                        i,
                        &FilmSample { radiance: Rgb::splat(unit(p, i)), ..FilmSample::default() },
                    );
                    done.samples += 1;
                }
                std::thread::sleep(self.nap);
            }
            control.progress(done);
            Ok(done)
        }
    }

    fn view() -> View {
        let camera = Camera::look_at(glam::Vec3::ZERO, glam::Vec3::Z, glam::Vec3::Y, 1.0, 1.0);
        View { camera, settings: RenderSettings::default(), frame: 0 }
    }

    fn run(noise: &Noise, targets: Targets, watch: &dyn Watch) -> (Outcome, Film) {
        let mut film = Film::new(16, 8);
        let outcome = render(noise, &view(), targets, &mut film, watch).unwrap();
        (outcome, film)
    }

    #[test]
    fn passes_cover_the_range_once_and_end_at_each_look() {
        for (first, spp) in [(0, 0), (5, 1), (0, 64), (7, 333), (u32::MAX - 20, 20)] {
            let noise = Noise::default();
            let targets = Targets::spp(spp).or_error(1e-12).from_sample(first);
            let (outcome, film) = run(&noise, targets, &());
            assert_eq!((outcome.ended, outcome.spp), (Ended::Spp, spp));
            assert_eq!(outcome.progress.samples, 16 * 8 * u64::from(spp));
            assert!(film.pixels().iter().all(|p| p.samples() == spp));
            let asked = noise.asked.into_inner().unwrap();
            let all: Vec<u32> = asked.iter().cloned().flatten().collect();
            assert_eq!(all, (first..first + spp).collect::<Vec<_>>());
            for look in (0..spp).filter(|&n| is_look(n)) {
                assert!(asked.iter().any(|r| r.end == first + look), "{look}: {asked:?}");
            }
        }
        let looks: Vec<u32> = (0..70).filter(|&n| is_look(n)).collect();
        assert_eq!(looks, [1, 2, 4, 8, 16, 32, 48, 64]);
    }

    /// Where no error ends a render, a fast device takes more samples at a time, to each power of two; a slow one does not.
    #[test]
    fn looks_for_people_are_as_far_apart_as_they_are_quick() {
        let length = |targets: Targets, per_sample: f64, spp: u32| {
            let estimator = Estimator::new(&Film::new(1, 1), &RenderSettings::default());
            let so_far = SoFar { spp, ..SoFar::default() };
            let began = Instant::now();
            Run { targets, began, per_sample: Some(per_sample), estimator, looked_at: 0, so_far }.length()
        };
        let (free, bound) = (Targets::spp(1 << 30), Targets::spp(1 << 30).or_error(1e-9));
        for (one, lengths) in [
            (1e-9, [1, 1, 2, 16, 50, 1000]),
            (0.5 / 64.0, [1, 1, 2, 16, 50, 40]),
            (0.5 / 90.0, [1, 1, 2, 16, 50, 40]),
            (0.5 / 16.0, [1, 1, 2, 16, 2, 8]),
            (0.25, [1, 1, 2, 4, 2, 4]),
            (3.0, [1; 6]),
        ] {
            let found = [0, 1, 2, 16, 78, 1048].map(|spp| length(free, one, spp));
            assert_eq!(found, lengths, "{one} s for a sample");
        }
        assert_eq!([0, 1, 2, 16, 78, 1048].map(|spp| length(bound, 1e-9, spp)), [1, 1, 2, 16, 2, 8]);
        // The passes of a free render: all powers of two among their ends.
        let noise = Noise::default();
        run(&noise, Targets::spp(300), &());
        let ends: Vec<u32> = noise.asked.into_inner().unwrap().iter().map(|r| r.end).collect();
        assert!([1, 2, 4, 8, 16, 32, 64, 128, 256, 300].iter().all(|p| ends.contains(p)), "{ends:?}");
    }

    #[test]
    fn a_range_is_a_target_too() {
        assert_eq!(Targets::from(3..10), Targets::spp(7).from_sample(3));
        // No index is left after the last one.
        let noise = Noise::default();
        let (outcome, _) = run(&noise, Targets::default().from_sample(u32::MAX - 3), &());
        assert_eq!((outcome.ended, outcome.spp), (Ended::Spp, 3));
    }

    #[test]
    fn the_first_target_ends_it() {
        // relMSE of n samples: 1/12 / 0.26 / n.
        let error = |n: f64| 1.0 / 12.0 / 0.26 / n;
        let all = Targets::error(error(90.0)).or_time(Duration::from_secs(3600)).or_spp(100_000);
        let (by_error, _) = run(&Noise::default(), all, &());
        assert_eq!(by_error.ended, Ended::Error);
        assert!((60..130).contains(&by_error.spp), "{by_error:?}");
        assert!(by_error.error.is_some_and(|e| e <= error(90.0)));
        let (by_spp, _) = run(&Noise::default(), all.or_spp(40), &());
        assert_eq!((by_spp.ended, by_spp.spp), (Ended::Spp, 40));
        assert!(by_spp.error.is_some_and(|e| (e / error(40.0) - 1.0).abs() < 0.5), "{by_spp:?}");
        let slow = Noise { nap: Duration::from_millis(5), ..Noise::default() };
        let (by_time, film) = run(&slow, all.or_error(1e-9).or_time(Duration::from_millis(300)), &());
        assert_eq!(by_time.ended, Ended::Time);
        assert!(film.pixels().iter().all(|p| p.samples() == by_time.spp), "even");
        assert!(by_time.spp < 500, "{by_time:?}");
        // However little time there is, there is a picture.
        let (at_once, _) = run(&slow, Targets::time(Duration::ZERO), &());
        assert!(at_once.spp >= 1 && at_once.ended == Ended::Time);
        // A good guess of the error after a few samples is not enough.
        let (early, _) = run(&Noise::default(), Targets::error(1e9), &());
        assert_eq!((early.ended, early.spp), (Ended::Error, LEAST_FOR_ERROR));
    }

    /// Cancels when a picture of so many samples was seen.
    struct Cancelling(u32, Mutex<Vec<SoFar>>);
    impl Control for Cancelling {
        fn cancelled(&self) -> bool {
            self.1.lock().unwrap().last().is_some_and(|s| s.spp >= self.0)
        }
    }
    impl Watch for Cancelling {
        fn passed(&self, film: &Film, so_far: &SoFar) {
            assert!(film.pixels().iter().all(|p| p.samples() == so_far.spp));
            self.1.lock().unwrap().push(*so_far);
        }
    }

    #[test]
    fn who_watches_sees_each_pass_and_may_end_it() {
        let watch = Cancelling(32, Mutex::default());
        let targets = Targets::spp(64).or_error(1e-9);
        let (outcome, _) =
            run(&Noise { nap: Duration::from_micros(100), ..Noise::default() }, targets, &watch);
        assert_eq!((outcome.ended, outcome.spp), (Ended::Cancelled, 32));
        let seen = watch.1.into_inner().unwrap();
        assert!(seen.windows(2).all(|w| w[0].spp < w[1].spp && w[0].seconds <= w[1].seconds));
        assert!(seen.iter().all(|s| s.seconds_left.is_some_and(|s| s >= 0.0)));
        assert_eq!(seen.last().unwrap().progress, outcome.progress);
        assert!(seen[0].error.is_none() && seen.last().unwrap().error.is_some());
    }

    #[test]
    fn the_same_samples_end_it_however_fast_they_come() {
        let targets = Targets::error(0.005);
        let at =
            |nap: u64| run(&Noise { nap: Duration::from_micros(nap), ..Noise::default() }, targets, &()).0;
        let (fast, slow) = (at(0), at(2000));
        assert_eq!((fast.spp, fast.error), (slow.spp, slow.error));
    }
}
