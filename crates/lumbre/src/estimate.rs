//! How far a picture still is from the truth, told from its own samples: the relMSE that `lumbre compare` would find against a
//! perfect picture, mean over pixels and channels of (x - r)² / (r² + 0.01) (Rousselle et al. 2011), without knowing r.
//!
//! # Derivation
//!
//! Let x_n be a pixel's mean after n samples and V(n) = E (x_n - r)². When the two halves of 2n samples are alike,
//! E (x_2n - x_n)² = V(n) - V(2n): with a, b the errors of the halves, x_2n - x_n = (b - a) / 2, whose mean square is
//! (V(n) - E ab) / 2, and V(2n) = (V(n) + E ab) / 2; the difference V(n) - V(2n) is the same. It needs no independence, so it
//! holds for scrambled Sobol points, whose halves fill each other's gaps. So at each power of two the squared change C of the
//! picture since half as many samples says how much of the error went away; what is left follows if one knows how errors fall.
//!
//! The scale for that is W(n), the error that the spread of the samples promises if they were independent. For the independent
//! sampler V = ρ W with a constant ρ (near 1; the spread is that of luminance, while the error counts channels). Sobol points
//! integrate a part of the variance much better than that, and it vanishes fast; the rest, edges and what many dimensions
//! share, they treat like independent numbers. So the model is V(m) = W(m) (f + g n / m), n being the last power of two: a
//! part that falls like 1/m and one that falls like 1/m² (Owen 1997 has between m^-1.5 and m^-3 for integrands from edges to
//! smooth). Then C(n) = W(n) (f + 3 g). Two successive ratios R(n) = C(n) / W(n) and R(n/2) give g = (R(n/2) - R(n)) / 3,
//! clamped to what leaves f and g not negative. Ratios, and not the C themselves, since whatever else changes from one
//! power of two to the next, a pixel hit by a rare bright path or a better guess of r, changes C and W alike.
//!
//! # The denominator
//!
//! r² + 0.01 must be guessed. With x² for r² the estimate is far too small (a third at 32 samples in the Cornell box): a pixel
//! that is too bright by chance also has too large a denominator. The median of the 3x3 pixels around it is nearly free of
//! such luck but wrong at textures and edges. Between the two a pixel is placed by how far it lies from the median in units of
//! its own standard error e (James and Stein 1961): r = med + max(0, 1 - e² / (x - med)²) (x - med). And r is at least x / 6, so that
//! one sample in one pixel, which may be a rare path or a lamp smaller than a pixel, cannot promise thousands.
//!
//! # Where it fails
//!
//! - What has not been seen cannot be counted: a picture whose error is in fireflies that are still to come is worse than it
//!   says, and jumps when they come. Scenes with caustics through glass are like that at any number of samples.
//! - Below 16 samples it is a hint (a factor of two). [`crate::render`] does not stop by error before.
//! - A picture that converges like m^-2 or faster, all smooth and lit directly, is better than it says, by up to fifteen
//!   times; errors are 1e-5 and less there.
//! - Bias is not noise: a clamped or depth-limited picture approaches another truth.
//! - A film that holds samples from elsewhere: [`from_spread`] is all there is to say, for Sobol points an upper estimate.
//!
//! Measured: `docs/convergence.md`, and tested in `testkit/tests/proofs/error_estimate.rs`.

use lumbre_core::Film;
use lumbre_core::film::PixelSums;
use lumbre_core::sampler::SamplerKind;
use lumbre_core::settings::RenderSettings;
use rayon::prelude::*;

/// Of the definition of relMSE: what keeps dark pixels from counting too much.
const EPSILON: f64 = 0.01;
/// A pixel is taken to be at least this share of what it shows. Measured: 1/4 makes estimates at 16 samples a third too small,
/// no bound makes them three times too large where there are caustics.
const LEAST_SHARE: f64 = 1.0 / 6.0;

/// Follows a film from its first sample and estimates its error. Deterministic: it depends on the film and the counts at which it was
/// asked, not on threads.
#[derive(Clone, Debug)]
pub struct Estimator {
    /// The film was empty at the beginning, and its halves can be compared.
    whole: bool,
    /// Errors fall like 1/n.
    independent: bool,
    /// Means at `half` samples.
    before: Vec<[f32; 3]>,
    half: u32,
    /// R at the last power of two.
    ratio: Option<f64>,
    model: Model,
    /// What the last look found: samples and W.
    last: Option<(u32, f64)>,
}

/// V(m) / W(m) = f + g n / m.
#[derive(Clone, Copy, Debug)]
struct Model {
    f: f64,
    g: f64,
    n: f64,
}

impl Model {
    /// V = W.
    const SPREAD: Model = Model { f: 1.0, g: 0.0, n: 1.0 };

    /// From R at n samples and the one at half as many.
    fn new(ratio: f64, before: Option<f64>, n: u32) -> Self {
        let g = before.map_or(0.0, |b| (b - ratio) / 3.0).clamp(0.0, ratio / 3.0);
        Model { f: ratio - 3.0 * g, g, n: f64::from(n) }
    }
    fn at(&self, m: u32) -> f64 {
        self.f + self.g * self.n / f64::from(m)
    }
    /// The number of samples at which the error, now that of W at `m`, will be `wanted`.
    fn solve(&self, m: u32, w: f64, wanted: f64) -> f64 {
        // With t = m / answer: w t (f + g' t) = wanted.
        let (m, g) = (f64::from(m), self.g * self.n / f64::from(m));
        let root = (self.f * self.f + 4.0 * g * wanted / w).sqrt();
        // The form without cancellation.
        m * (self.f + root) / (2.0 * wanted / w)
    }
}

impl Estimator {
    /// Before the first sample. `film` is what will be looked at.
    pub fn new(film: &Film, settings: &RenderSettings) -> Self {
        Estimator {
            whole: film.pixels().iter().all(|p| p.samples() == 0),
            independent: settings.sampler == SamplerKind::Independent,
            before: Vec::new(),
            half: 0,
            ratio: None,
            model: Model::SPREAD,
            last: None,
        }
    }

    /// Bytes that following a film of so many pixels takes.
    pub fn bytes(pixels: u64) -> u64 {
        pixels * size_of::<[f32; 3]>() as u64
    }

    /// The estimated relMSE of a film that has got `spp` samples in every pixel; `None` below two. To be right it must be asked
    /// at all powers of two; in between it may be.
    pub fn look(&mut self, film: &Film, spp: u32) -> Option<f64> {
        let power = self.whole && spp.is_power_of_two();
        let compared = power && spp == self.half.saturating_mul(2);
        let Sums { change, spread } = sums(film, if compared { &self.before } else { &[] })?;
        if compared && spread > 0.0 {
            let ratio = change / spread;
            let before = self.ratio.replace(ratio).filter(|_| !self.independent);
            self.model = Model::new(ratio, before, spp);
        }
        if power {
            self.before.clear();
            self.before.extend(film.pixels().iter().map(|p| p.radiance().to_array()));
            self.half = spp;
        }
        self.last = spread.is_finite().then_some((spp, spread));
        self.last.map(|(spp, spread)| spread * self.model.at(spp))
    }

    /// Samples per pixel at which the error will be `wanted`, by what is known at the last look.
    pub fn spp_for(&self, wanted: f64) -> Option<f64> {
        self.last.map(|(spp, w)| if w > 0.0 { self.model.solve(spp, w, wanted) } else { f64::from(spp) })
    }
}

/// The error of any film from the spread of its samples alone, as if they were independent: for Sobol points mostly too large, by
/// a third to a half. `None` where a pixel has fewer than two samples.
pub fn from_spread(film: &Film) -> Option<f64> {
    sums(film, &[]).map(|s| s.spread).filter(|s| s.is_finite())
}

/// Means over pixels and channels.
#[derive(Clone, Copy, Debug)]
struct Sums {
    /// (x - before)² / (r² + 0.01); 0 without a `before`.
    change: f64,
    /// Squared standard error of the luminance over (r² + 0.01).
    spread: f64,
}

/// `None` for a film without pixels.
fn sums(film: &Film, before: &[[f32; 3]]) -> Option<Sums> {
    let (width, height) = (film.width() as usize, film.height() as usize);
    // Summed row by row and then over rows, so that threads do not decide the order.
    let rows: Vec<[f64; 2]> = (0..height).into_par_iter().map(|y| row_sums(film, before, y)).collect();
    let total = rows.iter().fold([0.0; 2], |t, r| [t[0] + r[0], t[1] + r[1]]);
    let count = (3 * width * height) as f64;
    (count > 0.0).then(|| Sums { change: total[0] / count, spread: total[1] / count })
}

fn row_sums(film: &Film, before: &[[f32; 3]], y: usize) -> [f64; 2] {
    let width = film.width() as usize;
    let row = |y: usize| &film.pixels()[y * width..(y + 1) * width];
    let means = |y: usize| row(y).iter().map(|p| p.radiance().to_array()).collect::<Vec<_>>();
    let rows = [y.saturating_sub(1), y, (y + 1).min(film.height() as usize - 1)].map(means);
    let (mut change, mut spread) = (0.0, 0.0);
    for (x, pixel) in row(y).iter().enumerate() {
        let columns = [x.saturating_sub(1), x, (x + 1).min(width - 1)];
        let own = rows[1][x];
        let denominators =
            denominators(pixel, own, |c| median(columns.map(|x| [0, 1, 2].map(|y| rows[y][x][c]))));
        let error = f64::from(pixel.error());
        for c in 0..3 {
            if let Some(b) = before.get(y * width + x) {
                change += f64::from(own[c] - b[c]).powi(2) / denominators[c];
            }
            spread += error * error / denominators[c];
        }
    }
    [change, spread]
}

/// r² + 0.01 of each channel, r guessed between what the pixel shows and the median of its surroundings.
fn denominators(pixel: &PixelSums, own: [f32; 3], median: impl Fn(usize) -> f32) -> [f64; 3] {
    let around = [0, 1, 2].map(median);
    let luminance = |c: [f32; 3]| f64::from(lumbre_core::Rgb::from_array(c).luminance());
    let (distance, error) = (luminance(own) - luminance(around), f64::from(pixel.error()));
    let share = if distance == 0.0 { 0.0 } else { (1.0 - (error / distance).powi(2)).max(0.0) };
    [0, 1, 2].map(|c| {
        let (own, around) = (f64::from(own[c]), f64::from(around[c]));
        let r = around + share * (own - around);
        (r * r).max((LEAST_SHARE * own).powi(2)) + EPSILON
    })
}

/// Median of nine: that of the largest of the columns' least, the median of their middles, and the least of their largest. None
/// of the three pairs that this leaves out on either side can be the middle: each has five above or below it.
fn median(columns: [[f32; 3]; 3]) -> f32 {
    let [a, b, c] = columns.map(sorted);
    let low = a[0].max(b[0]).max(c[0]);
    let high = a[2].min(b[2]).min(c[2]);
    sorted([low, sorted([a[1], b[1], c[1]])[1], high])[1]
}

fn sorted([a, b, c]: [f32; 3]) -> [f32; 3] {
    let (a, b) = (a.min(b), a.max(b));
    let (b, c) = (b.min(c), b.max(c));
    [a.min(b), a.max(b), c]
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_core::film::FilmSample;
    use lumbre_core::hash::unit;
    use lumbre_core::rgb::Rgb;

    #[test]
    fn medians_are_those_of_sorting() {
        for seed in 0..500 {
            let v: [f32; 9] = std::array::from_fn(|i| (unit(seed, i as u32) * 8.0).floor());
            let columns = [[v[0], v[1], v[2]], [v[3], v[4], v[5]], [v[6], v[7], v[8]]];
            let mut all = v;
            all.sort_by(f32::total_cmp);
            assert_eq!(median(columns), all[4], "{v:?}");
        }
    }

    #[test]
    fn the_model_gives_back_what_it_was_made_of() {
        // V(m) = 0.5 / m + 3 / m², W(m) = 1 / m: what C would be at 32 and 64.
        let v = |m: f64| 0.5 / m + 3.0 / (m * m);
        let ratio = |n: f64| (v(n / 2.0) - v(n)) * n;
        let model = Model::new(ratio(64.0), Some(ratio(32.0)), 64);
        for m in [64, 96, 128] {
            let error = model.at(m) / f64::from(m);
            assert!((error / v(f64::from(m)) - 1.0).abs() < 1e-12, "{m}: {error}");
        }
        let when = model.solve(96, 1.0 / 96.0, v(400.0));
        assert!((when / 400.0 - 1.0).abs() < 1e-12, "{when}");
        // Beyond 1/m² there is nothing to subtract, and ratios that rise are luck.
        assert_eq!(Model::new(1.0, Some(9.0), 4).f, 0.0);
        assert_eq!(Model::new(1.0, Some(0.5), 4).g, 0.0);
    }

    /// Independent noise of a known variance about 0.5: r² + ε is 0.26.
    fn noisy(film: &mut Film, samples: std::ops::Range<u32>) {
        for pixel in 0..film.width() * film.height() {
            for i in samples.clone() {
                let radiance = Rgb::splat(unit(pixel, i));
                let at = [pixel % film.width(), pixel / film.width()];
                film.add(at, i, &FilmSample { radiance, ..FilmSample::default() });
            }
        }
    }

    #[test]
    fn independent_noise_is_estimated_at_any_count() {
        let mut film = Film::new(40, 30);
        let settings = RenderSettings { sampler: SamplerKind::Independent, ..RenderSettings::default() };
        let mut e = Estimator::new(&film, &settings);
        assert_eq!(e.spp_for(0.1), None);
        let mut n = 0;
        for next in [1, 2, 4, 8, 16, 24, 32, 48, 64] {
            noisy(&mut film, n..next);
            n = next;
            let truth = 1.0 / 12.0 / f64::from(n) / 0.26;
            match e.look(&film, n) {
                None => assert_eq!(n, 1),
                Some(error) if n >= 16 => {
                    assert!((error / truth - 1.0).abs() < 0.1, "{n}: {error} for {truth}");
                    let when = e.spp_for(truth / 10.0).unwrap() / f64::from(10 * n);
                    assert!((when - 1.0).abs() < 0.1, "{n}: {when}");
                }
                Some(_) => {}
            }
        }
        let spread = from_spread(&film).unwrap();
        assert!((spread * 64.0 * 12.0 * 0.26 - 1.0).abs() < 0.1, "{spread}");
        // A film that holds samples already has its spread only.
        let mut late = Estimator::new(&film, &RenderSettings::default());
        noisy(&mut film, 64..128);
        assert_eq!(late.look(&film, 64), from_spread(&film));
        assert_eq!(from_spread(&Film::new(2, 2)), None);
    }

    #[test]
    fn a_picture_without_noise_has_no_error() {
        let mut film = Film::new(3, 3);
        let mut e = Estimator::new(&film, &RenderSettings::default());
        for n in 1..=2 {
            for p in 0..9 {
                film.add(
                    [p % 3, p / 3],
                    n,
                    &FilmSample { radiance: Rgb::splat(0.25), ..FilmSample::default() },
                );
            }
            let error = e.look(&film, n);
            assert!(n < 2 || error == Some(0.0), "{error:?}");
        }
        assert_eq!(e.spp_for(0.001), Some(2.0));
    }
}
