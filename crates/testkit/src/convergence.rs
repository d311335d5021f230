//! How fast errors fall with the number of samples: measured series of root mean square errors, and the slopes of their logarithms.

use crate::ready::{Ready, asset, open};
use lumbre_core::filter::FilterKind;
use lumbre_core::sampler::{Sampler, SamplerKind};
use lumbre_core::settings::RenderSettings;

/// Errors by number of samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What was measured.
    pub name: String,
    /// (samples, root mean square error).
    pub points: Vec<(f64, f64)>,
}

/// A line through the logarithms: error = `scale` · samplesˢˡᵒᵖᵉ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Exponent.
    pub slope: f64,
    /// Error of one sample by the fit.
    pub scale: f64,
}

impl Series {
    /// Least squares on the logarithms.
    ///
    /// # Panics
    /// With fewer than two points, or an error that is not positive.
    pub fn fit(&self) -> Fit {
        assert!(self.points.len() >= 2 && self.points.iter().all(|p| p.1 > 0.0), "{:?}", self.points);
        let n = self.points.len() as f64;
        let logs: Vec<(f64, f64)> = self.points.iter().map(|p| (p.0.ln(), p.1.ln())).collect();
        let mean = |f: fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>() / n;
        let (x, y) = (mean(|p| p.0), mean(|p| p.1));
        let covariance: f64 = logs.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
        let variance: f64 = logs.iter().map(|p| (p.0 - x).powi(2)).sum();
        let slope = covariance / variance;
        Fit { slope, scale: (y - slope * x).exp() }
    }
}

/// 2^first, …, 2^last.
pub fn powers_of_two(first: u32, last: u32) -> Vec<u32> {
    (first..=last).map(|k| 1 << k).collect()
}

/// Errors of a smooth integral over the unit square, taken with the numbers that send paths on from their first vertex, over `keys`
/// streams. The integrand is f(x) f(y) with f(x) = x eˣ, whose integral is 1: it is smooth, and neither periodic nor
/// symmetric, so that nothing cancels by luck (the test function of Owen 1997, "Scrambled net variance for integrals of smooth
/// functions", is of this kind).
pub fn integral(kind: SamplerKind, samples: &[u32], keys: u32) -> Series {
    let f = |u: f32| f64::from(u) * f64::from(u).exp();
    let rmse = |n: u32| {
        let square = |key: u32| {
            let value = |i: u32| {
                let [x, y] = Sampler::new(kind, n, 0, [key, 3], i).direction(0);
                f(x) * f(y)
            };
            ((0..n).map(value).sum::<f64>() / f64::from(n) - 1.0).powi(2)
        };
        ((0..keys).map(square).sum::<f64>() / f64::from(keys)).sqrt()
    };
    Series { name: format!("{kind:?}"), points: samples.iter().map(|&n| (f64::from(n), rmse(n))).collect() }
}

/// The smooth scene: a wide floor under a small light, direct light only, box filter. Pixels are integrals over place in the pixel
/// and on the light, of functions without an edge.
pub fn smooth_scene(kind: SamplerKind, seed: u32) -> Ready {
    let mut ready = open(&asset("smooth.gltf"), 1.0);
    ready.view.settings = RenderSettings {
        max_depth: Some(1),
        roulette: None,
        sampler: kind,
        filter: FilterKind::Box,
        seed,
        ..RenderSettings::default()
    };
    ready
}

/// Luminance of every pixel of the smooth scene.
pub fn smooth_picture(kind: SamplerKind, seed: u32, side: u32, samples: u32) -> Vec<f64> {
    let film = smooth_scene(kind, seed).film([side, side], 0..samples);
    film.pixels().iter().map(|p| f64::from(p.radiance().luminance())).collect()
}

/// Errors of pictures of the smooth scene against one of many samples, relative to its mean. Every number of samples has a seed of
/// its own.
pub fn smooth_pictures(kind: SamplerKind, samples: &[u32], side: u32, truth: &[f64]) -> Series {
    let mean = truth.iter().sum::<f64>() / truth.len() as f64;
    let rmse = |n: u32| {
        let picture = smooth_picture(kind, n, side, n);
        let squares: f64 = picture.iter().zip(truth).map(|(a, b)| (a - b).powi(2)).sum();
        (squares / truth.len() as f64).sqrt() / mean
    };
    Series { name: format!("{kind:?}"), points: samples.iter().map(|&n| (f64::from(n), rmse(n))).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fits_find_the_exponent() {
        let points = [1.0, 2.0, 4.0, 8.0, 64.0].map(|n: f64| (n, 3.0 * n.powf(-0.75))).to_vec();
        let fit = Series { name: String::new(), points }.fit();
        assert!((fit.slope + 0.75).abs() < 1e-12 && (fit.scale - 3.0).abs() < 1e-12, "{fit:?}");
        assert_eq!(powers_of_two(2, 4), [4, 8, 16]);
    }
}
