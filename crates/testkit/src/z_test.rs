//! Are two noisy pictures estimates of the same one? Means of blocks of pixels are compared in units of their standard error.
//!
//! A block is rejected beyond the bound that a fair one passes with probability (1 - 0.01)^(1/blocks) (Šidák 1967, as Mitsuba 3's
//! `test_renders.py` does by pixel), and 99.75 % of the blocks must be accepted. Blocks rather than pixels, since the mean of
//! few samples is not normal, and an error of a few per cent hides in the noise of one pixel.

use lumbre_core::Rgb;
use lumbre_core::film::Film;

/// Luminance of a picture with the variance of each pixel's mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Mean luminance of each pixel, row by row.
    pub mean: Vec<f64>,
    /// Variance of that mean.
    pub variance: Vec<f64>,
}

impl Picture {
    /// What a film holds, its samples taken as independent.
    pub fn of_film(film: &Film) -> Self {
        Picture {
            width: film.width() as usize,
            height: film.height() as usize,
            mean: film.pixels().iter().map(|p| f64::from(p.radiance().luminance())).collect(),
            variance: film.pixels().iter().map(|p| f64::from(p.error()).powi(2)).collect(),
        }
    }

    /// From colours whose variance is known by channel. How the channels vary together is not, so they count as rising and
    /// falling as one: the variance of the luminance can only be smaller.
    pub fn of_colors(width: usize, height: usize, mean: &[Rgb], variance: &[Rgb]) -> Self {
        let error = |v: &Rgb| f64::from(v.map(|c| c.max(0.0).sqrt()).luminance());
        Picture {
            width,
            height,
            mean: mean.iter().map(|c| f64::from(c.luminance())).collect(),
            variance: variance.iter().map(|v| error(v).powi(2)).collect(),
        }
    }

    /// The picture of means over blocks of `side` x `side` pixels; those that stick out on the right and below are left out.
    pub fn blocks(&self, side: usize) -> Picture {
        let (width, height) = (self.width / side, self.height / side);
        let sum = |values: &[f64], block: usize| -> f64 {
            let (x, y) = (block % width * side, block / width * side);
            (y..y + side).map(|y| values[y * self.width + x..][..side].iter().sum::<f64>()).sum()
        };
        let n = (side * side) as f64;
        Picture {
            width,
            height,
            mean: (0..width * height).map(|b| sum(&self.mean, b) / n).collect(),
            variance: (0..width * height).map(|b| sum(&self.variance, b) / (n * n)).collect(),
        }
    }

    /// Every value times `factor(column, row)`: how tests plant an error.
    pub fn scaled(&self, factor: impl Fn(usize, usize) -> f64) -> Picture {
        let mut out = self.clone();
        for i in 0..out.mean.len() {
            let f = factor(i % self.width, i / self.width);
            out.mean[i] *= f;
            out.variance[i] *= f * f;
        }
        out
    }

    /// The same means with the variances of another picture of the same scene, made of `share` times as many samples: where a block misses rare bright paths it misses them in its own variance as well, a long run does not.
    pub fn with_variance_of(&self, other: &Picture, share: f64) -> Picture {
        let variance = other.variance.iter().map(|v| v * share).collect();
        Picture { variance, ..self.clone() }
    }

    /// Mean over the picture, and its standard error.
    pub fn overall(&self) -> (f64, f64) {
        let n = self.mean.len() as f64;
        (self.mean.iter().sum::<f64>() / n, self.variance.iter().sum::<f64>().sqrt() / n)
    }
}

/// What the comparison found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Blocks compared.
    pub blocks: usize,
    /// Share of them within the bound.
    pub accepted: f64,
    /// The bound on |z|.
    pub bound: f64,
    /// Largest |z|.
    pub worst: f64,
    /// Mean of z² over the blocks: 1 where both variances are right.
    pub mean_square: f64,
    /// Median over the blocks of the standard error relative to the mean.
    pub noise: f64,
    /// Mean of the picture over that of the reference, less 1.
    pub offset: f64,
    /// Standard error of `offset`.
    pub offset_error: f64,
}

/// Share of blocks that must be within the bound.
const ACCEPTED: f64 = 0.9975;
const SIGNIFICANCE: f64 = 0.01;
/// Bound on the mean over the whole picture, in standard errors.
const MEAN_BOUND: f64 = 4.5;

impl Outcome {
    /// True when the blocks agree one by one and together, and the means over the picture agree within `relative` and 4.5 standard errors.
    pub fn accept(&self, relative: f64) -> bool {
        self.blocks_agree()
            && self.spread_agrees()
            && self.offset.abs() <= relative
            && self.offset.abs() <= MEAN_BOUND * self.offset_error
    }

    /// True when the differences are no larger all together than the variances say: the mean of z² has a variance of 2 / blocks.
    pub fn spread_agrees(&self) -> bool {
        self.mean_square <= 1.0 + MEAN_BOUND * (2.0 / self.blocks as f64).sqrt()
    }

    /// True when enough blocks are within the bound.
    pub fn blocks_agree(&self) -> bool {
        self.accepted >= ACCEPTED
    }
}

/// Compares a picture with a reference by blocks of `side` x `side` pixels.
///
/// # Panics
/// If their sizes differ.
pub fn compare(ours: &Picture, reference: &Picture, side: usize) -> Outcome {
    assert_eq!((ours.width, ours.height), (reference.width, reference.height), "pictures of one size");
    let (a, b) = (ours.blocks(side), reference.blocks(side));
    let n = a.mean.len();
    let z: Vec<f64> = (0..n)
        .map(|i| {
            let difference = a.mean[i] - b.mean[i];
            let error = (a.variance[i] + b.variance[i]).sqrt();
            if difference.abs() <= 1e-6 * b.mean[i].abs() { 0.0 } else { difference / error }
        })
        .collect();
    let bound = bound(n);
    let mut noise: Vec<f64> = (0..n).map(|i| (a.variance[i] + b.variance[i]).sqrt() / b.mean[i]).collect();
    noise.sort_by(f64::total_cmp);
    let ((ours, our_error), (theirs, their_error)) = (ours.overall(), reference.overall());
    Outcome {
        blocks: n,
        accepted: z.iter().filter(|z| z.abs() <= bound).count() as f64 / n as f64,
        bound,
        worst: z.iter().fold(0.0, |m, z| m.max(z.abs())),
        mean_square: z.iter().map(|z| z * z).sum::<f64>() / n as f64,
        noise: noise[n / 2],
        offset: ours / theirs - 1.0,
        offset_error: our_error.hypot(their_error) / theirs,
    }
}

/// |z| that one of `n` fair comparisons exceeds with probability 1 - (1 - 0.01)^(1/n), by bisection of the normal law.
fn bound(n: usize) -> f64 {
    let alpha = 1.0 - (1.0 - SIGNIFICANCE).powf(1.0 / n as f64);
    let (mut low, mut high) = (0.0, 40.0);
    for _ in 0..80 {
        let z: f64 = 0.5 * (low + high);
        // Two-sided: z² is chi-square of one degree.
        let beyond = crate::chi_square::survival(z * z, 1);
        *(if beyond > alpha { &mut low } else { &mut high }) = z;
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_core::hash::unit;

    /// A picture of a ramp with noise of 2 % in each pixel (sums of twelve uniform numbers).
    fn noisy(seed: u32) -> Picture {
        let (width, height) = (64, 48);
        let truth = |i: usize| 0.5 + (i % width) as f64 / width as f64;
        let noise = |i: usize| (0..12).map(|k| f64::from(unit(i as u32, seed + k)) - 0.5).sum::<f64>();
        Picture {
            width,
            height,
            mean: (0..width * height).map(|i| truth(i) * (1.0 + 0.02 * noise(i))).collect(),
            variance: (0..width * height).map(|i| (0.02 * truth(i)).powi(2)).collect(),
        }
    }

    #[test]
    fn bounds_are_those_of_the_normal_law() {
        assert!((bound(1) - 2.5758).abs() < 1e-3, "{}", bound(1));
        assert!((bound(1000) - 4.4161).abs() < 2e-3, "{}", bound(1000));
    }

    #[test]
    fn equal_pictures_pass_and_wrong_ones_do_not() {
        let (a, b) = (noisy(100), noisy(200));
        let same = compare(&a, &b, 4);
        assert!(same.accept(0.002) && (same.mean_square - 1.0).abs() < 0.4, "{same:?}");
        assert_eq!(same.blocks, 192);
        let bright = compare(&a.scaled(|_, _| 1.03), &b, 4);
        assert!(!bright.blocks_agree() && !bright.accept(1.0), "{bright:?}");
        // One part in ten too bright, the rest too dark, so that the mean is right.
        let local = compare(&a.scaled(|x, _| if x < 8 { 1.08 } else { 0.995 }), &b, 4);
        assert!(!local.blocks_agree(), "{local:?}");
        assert!(!compare(&a.scaled(|_, _| 1.003), &b, 4).accept(0.002));
    }

    #[test]
    fn variances_of_channels_bound_that_of_the_luminance() {
        let p = Picture::of_colors(1, 1, &[Rgb::splat(2.0)], &[Rgb::splat(0.09)]);
        assert!((p.variance[0] - 0.09).abs() < 1e-6 && (p.mean[0] - 2.0).abs() < 1e-6);
    }
}
