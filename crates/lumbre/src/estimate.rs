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
//! sampler V = ρ W with a constant ρ (near 1; the spread is that of luminance, while the error counts channels), and ρ is
//! R(n) = C(n) / W(n). Sobol points integrate a part of the variance much better than that, and it vanishes fast; the rest,
//! edges and what many dimensions share, they treat like independent numbers. So the model is V(m) = W(m) (f + g (n / m)^0.7),
//! n being the last power of two: a part of the error that falls like 1/m and one that falls like m^-1.7. (Owen 1997: m^-3 for
//! smooth integrands; between m^-1.5 and m^-2 for those with edges. The exponent was chosen among 1.5 to 2 by measurement.) Then
//! R(n) = f + a g with a = 2^1.7 - 1, R(n/2) = f + 2^0.7 a g, and so on: a line through the last three ratios gives f and g.
//! Three, since in two dimensions Sobol points are better at powers of four than at those between, and two ratios see
//! too much of that. Ratios, and not the C themselves, since whatever else changes from one power of two to the
//! next, a pixel hit by a rare bright path or a better guess of r, changes C and W alike.
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
//! It is meant to be right within a factor of 1.3 from 64 samples and for errors between 1e-4 and 0.5, beyond which there is
//! nothing to see or nothing but noise.
//!
//! - What has not been seen cannot be counted: a picture whose error is in fireflies that are still to come is worse than it
//!   says, and jumps when they come. Scenes with caustics through glass are like that at any number of samples.
//! - Below 64 samples it is a hint (at 32 within 1.5, below a factor of two and more). [`crate::render()`] does not stop by error before.
//! - A picture that converges like m^-2 or faster, all smooth and lit directly, is mostly better than it says, by up to fifteen
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
    /// R at the last powers of two, the last one first.
    ratios: Vec<f64>,
    model: Model,
    /// What the last look found: samples and W.
    last: Option<(u32, f64)>,
}

/// By how much the fast part of the error falls faster than 1/m.
const FASTER: f64 = 0.7;
/// How many ratios the line goes through.
const LEVELS: usize = 3;

/// V(m) / W(m) = f + g (n / m)^0.7.
#[derive(Clone, Copy, Debug)]
struct Model {
    f: f64,
    g: f64,
    n: f64,
}

impl Model {
    /// V = W.
    const SPREAD: Model = Model { f: 1.0, g: 0.0, n: 1.0 };

    /// From R at n, n/2, … samples.
    fn new(ratios: &[f64], n: u32) -> Self {
        let last = ratios.first().copied().unwrap_or(1.0);
        // The line R = f + slope x with x = 1, 2^0.7, 4^0.7, …
        let points = || ratios.iter().enumerate().map(|(i, r)| (f64::powf(2.0, FASTER * i as f64), *r));
        let count = ratios.len() as f64;
        let (x, y) = points().fold((0.0, 0.0), |(x, y), p| (x + p.0 / count, y + p.1 / count));
        let up: f64 = points().map(|p| (p.0 - x) * (p.1 - y)).sum();
        let across: f64 = points().map(|p| (p.0 - x).powi(2)).sum();
        let slope = if across > 0.0 { up / across } else { 0.0 };
        let n = f64::from(n);
        if slope <= 0.0 {
            // Ratios that rise are luck.
            return Model { f: last, g: 0.0, n };
        }
        // On the line; no less than half of what was seen, where the ratios fall faster than the model knows.
        let now = (y + slope * (1.0 - x)).max(0.5 * last);
        let slope = slope.min(now);
        Model { f: now - slope, g: slope / (f64::powf(2.0, 1.0 + FASTER) - 1.0), n }
    }

    fn at(&self, m: f64) -> f64 {
        self.f + self.g * (self.n / m).powf(FASTER)
    }

    /// The number of samples at which the error, now that of W at `m`, will be `wanted`.
    fn solve(&self, m: f64, w: f64, wanted: f64) -> f64 {
        // The error falls with the count: by halving, between far too few and far too many.
        let (mut low, mut high) = (m * 1e-6, m * 1e12);
        for _ in 0..64 {
            let middle = (low * high).sqrt();
            let error = w * m / middle * self.at(middle);
            if error > wanted { low = middle } else { high = middle }
        }
        high
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
            ratios: Vec::new(),
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
            self.ratios.insert(0, change / spread);
            self.ratios.truncate(if self.independent { 1 } else { LEVELS });
            self.model = Model::new(&self.ratios, spp);
        }
        if power {
            self.before.clear();
            self.before.extend(film.pixels().iter().map(|p| p.radiance().to_array()));
            self.half = spp;
        }
        self.last = spread.is_finite().then_some((spp, spread));
        self.last.map(|(spp, spread)| spread * self.model.at(f64::from(spp)))
    }

    /// Samples per pixel at which the error will be `wanted`, by what is known at the last look.
    pub fn spp_for(&self, wanted: f64) -> Option<f64> {
        self.last.map(
            |(spp, w)| if w > 0.0 { self.model.solve(f64::from(spp), w, wanted) } else { f64::from(spp) },
        )
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
        // V(m) = 0.5 / m + 3 / m^1.7, W(m) = 1 / m: what C would be at 64, 32 and 16.
        let v = |m: f64| 0.5 / m + 3.0 / m.powf(1.7);
        let ratio = |n: f64| (v(n / 2.0) - v(n)) * n;
        let model = Model::new(&[64.0, 32.0, 16.0].map(ratio), 64);
        for m in [64.0, 96.0, 128.0] {
            let error = model.at(m) / m;
            assert!((error / v(m) - 1.0).abs() < 1e-12, "{m}: {error}");
        }
        let when = model.solve(96.0, 1.0 / 96.0, v(400.0));
        assert!((when / 400.0 - 1.0).abs() < 1e-9, "{when}");
        // One ratio alone is all there is to know; ratios that rise are luck; those that fall too fast leave something.
        assert_eq!(Model::new(&[0.8], 2).at(2.0), 0.8);
        assert_eq!(Model::new(&[1.0, 0.5, 0.4], 16).at(16.0), 1.0);
        let steep = Model::new(&[0.01, 0.2, 0.9], 16);
        assert!(steep.f >= 0.0 && (0.001..0.01).contains(&steep.at(16.0)), "{steep:?}");
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
