//! Two backends, one picture: the same samples drawn by both, compared path by path.
//!
//! Both take the same random numbers, so that nearly all paths are the same but for rounding. A few fork: where rounding decides a comparison, they
//! go on as different paths of the same distribution. So the share of pixels that agree is high, and what forks must average out.

use lumbre_core::Film;

/// Relative difference from which two samples of a path count as forked.
const FORKED: f32 = 1e-3;
/// Radiance below this share of the picture's mean counts as that share, so that the dark does not ask for more digits than anyone sees.
const DARK: f32 = 0.01;
/// Rounding may pull all pixels the same way: this share of the mean counts as part of the standard error.
const ROUNDING: f64 = 1e-5;

/// How two renders of the same samples differ.
#[derive(Clone, Copy, Debug, Default)]
pub struct Paired {
    /// Pixels.
    pub pixels: usize,
    /// Pixels whose means agree within 1e-3 relative.
    pub close: usize,
    /// Paths.
    pub paths: usize,
    /// Paths that differ by more than that.
    pub forks: usize,
    /// Difference of the image means over the mean of the first.
    pub bias: f64,
    /// The same over its standard error, estimated from the spread over pixels, and rounding.
    pub z: f64,
}

/// What the paired test demands.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Least share of pixels that agree within 1e-3.
    pub close: f64,
    /// Largest relative difference of the image means.
    pub bias: f64,
    /// Largest |z| of it.
    pub z: f64,
}

impl Bounds {
    /// For scenes without textures.
    pub const PLAIN: Bounds = Bounds { close: 0.99, bias: 1e-3, z: 4.5 };
    /// For scenes with textures, which devices filter with fewer digits.
    pub const TEXTURED: Bounds = Bounds { close: 0.95, ..Bounds::PLAIN };
}

impl Paired {
    /// Compares films that hold one sample of each pixel each: `pairs` in the order of their samples.
    ///
    /// # Panics
    /// If the films are not of the same size.
    pub fn new(pairs: &[(Film, Film)]) -> Self {
        let Some((first, _)) = pairs.first() else { return Paired::default() };
        let pixels = first.pixels().len();
        let mut sums = vec![[[0.0f32; 3]; 2]; pixels];
        let mean =
            |f: &Film| f.radiance().iter().map(|c| f64::from(c.average())).sum::<f64>() / pixels as f64;
        let overall = pairs.iter().map(|(a, _)| mean(a)).sum::<f64>() / pairs.len() as f64;
        let floor = DARK * overall as f32;
        let mut forks = 0;
        for (a, b) in pairs {
            assert_eq!((a.width(), a.height()), (b.width(), b.height()), "films of different sizes");
            for (i, (p, q)) in a.radiance().iter().zip(b.radiance()).enumerate() {
                let (p, q) = (p.to_array(), q.to_array());
                forks += usize::from(!close(p, q, floor));
                for band in 0..3 {
                    sums[i][0][band] += p[band];
                    sums[i][1][band] += q[band];
                }
            }
        }
        let floor = floor * pairs.len() as f32;
        let agree = sums.iter().filter(|[p, q]| close(*p, *q, floor)).count();
        let (bias, z) = difference(&sums, overall * pairs.len() as f64);
        Paired { pixels, close: agree, paths: pixels * pairs.len(), forks, bias, z }
    }

    /// What is out of bounds, if anything.
    pub fn faults(&self, bounds: &Bounds) -> Vec<String> {
        let share = self.close as f64 / self.pixels.max(1) as f64;
        let mut faults = Vec::new();
        if self.pixels == 0 || share < bounds.close {
            faults.push(format!(
                "{:.2} % of pixels agree, wanted {:.1} %",
                100.0 * share,
                100.0 * bounds.close
            ));
        }
        if self.bias.is_nan() || self.bias.abs() > bounds.bias {
            faults.push(format!("the means differ by {:.4} %", 100.0 * self.bias));
        }
        if self.z.is_nan() || self.z.abs() > bounds.z {
            faults.push(format!("z is {:.1}", self.z));
        }
        faults
    }
}

impl core::fmt::Display for Paired {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Paired { pixels, close, paths, forks, bias, z } = *self;
        let (share, forked) = (close as f64 / pixels as f64, forks as f64 / paths as f64);
        write!(
            f,
            "{:.2} % of {pixels} pixels agree; {forks} of {paths} paths fork ({:.3} %); means differ by {:+.4} % (z {z:+.1})",
            100.0 * share,
            100.0 * forked,
            100.0 * bias
        )
    }
}

fn close(p: [f32; 3], q: [f32; 3], floor: f32) -> bool {
    p.iter().zip(q).all(|(&p, q)| (p - q).abs() <= FORKED * p.abs().max(q.abs()).max(floor))
}

/// Difference of the means over `mean`, and over its standard error.
fn difference(sums: &[[[f32; 3]; 2]], mean: f64) -> (f64, f64) {
    let n = sums.len() as f64;
    let average = |c: &[f32; 3]| c.iter().map(|v| f64::from(*v)).sum::<f64>() / 3.0;
    let differences: Vec<f64> = sums.iter().map(|[p, q]| average(q) - average(p)).collect();
    let d = differences.iter().sum::<f64>() / n;
    let variance = differences.iter().map(|v| (v - d) * (v - d)).sum::<f64>() / (n - 1.0).max(1.0);
    let error = (variance / n + (ROUNDING * mean).powi(2)).sqrt();
    (if mean > 0.0 { d / mean } else { d }, if error > 0.0 { d / error } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_core::Rgb;
    use lumbre_core::film::FilmSample;
    use lumbre_core::hash::unit;

    fn film(value: impl Fn(u32) -> f32) -> Film {
        let mut film = Film::new(32, 32);
        for i in 0..1024 {
            let radiance = Rgb::splat(value(i));
            film.add([i % 32, i / 32], 0, &FilmSample { radiance, ..FilmSample::default() });
        }
        film
    }

    fn faults(value: impl Fn(u32) -> f32) -> usize {
        let pairs: Vec<_> = (0..4).map(|s| (film(|i| unit(i, s)), film(|i| unit(i, s) * value(i)))).collect();
        Paired::new(&pairs).faults(&Bounds::PLAIN).len()
    }

    #[test]
    fn rounding_passes_and_one_per_cent_does_not() {
        assert_eq!(faults(|_| 1.0), 0);
        assert_eq!(faults(|i| 1.0 + 1e-5 * unit(i, 7)), 0);
        assert_eq!(faults(|_| 1.01), 3);
        // A few forked paths that average out.
        assert_eq!(faults(|i| if i % 200 == 0 { 0.5 + unit(i, 9) } else { 1.0 }), 0);
        assert!(faults(|i| if i % 50 == 0 { 0.5 } else { 1.0 }) > 0);
        assert!(!Paired::new(&[]).faults(&Bounds::PLAIN).is_empty(), "nothing compared is no agreement");
    }
}
