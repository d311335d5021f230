//! Reconstruction filters, by importance sampling: a sample's position is drawn from the filter and its weight is 1, so a
//! camera sample touches only its own pixel. Ernst, Stamminger and Greiner 2006, "Filter Importance Sampling".

use crate::math::{PI, exp, lerp, safe_sqrt, sin_cos};

/// Shape of the pixel filter. All are separable, symmetric and nowhere negative. Shaders number them in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum FilterKind {
    /// Exactly one pixel.
    Box,
    /// Radius 1 pixel.
    Tent,
    /// Standard deviation 0.5 pixels, cut at 1.5.
    Gaussian,
    /// The four-term window of Harris 1978, radius 1.5 pixels.
    #[default]
    BlackmanHarris,
    /// No filter: every sample at the centre of its pixel.
    Point,
}

/// Intervals of the tabulated inverse.
pub const TABLE: usize = 256;

/// A filter ready to be sampled.
#[derive(Clone, Debug)]
pub struct Filter {
    kind: FilterKind,
    /// Distance from the centre, pixels, beyond which a share `(i / TABLE)²` of the filter lies: the square makes the knots
    /// dense in the tails. Unused for box and tent.
    distance: [f32; TABLE + 1],
}

impl FilterKind {
    /// Where the filter ends, pixels from its centre.
    pub fn radius(self) -> f32 {
        match self {
            FilterKind::Box => 0.5,
            FilterKind::Tent => 1.0,
            FilterKind::Gaussian | FilterKind::BlackmanHarris => 1.5,
            FilterKind::Point => 0.0,
        }
    }

    /// The filter's value at `x` pixels from the centre, in one dimension, not normalised.
    pub fn value(self, x: f32) -> f32 {
        let r = self.radius();
        if x.abs() > r {
            return 0.0;
        }
        match self {
            FilterKind::Box | FilterKind::Point => 1.0,
            FilterKind::Tent => 1.0 - x.abs(),
            FilterKind::Gaussian => exp(-2.0 * x * x),
            FilterKind::BlackmanHarris => {
                let t = PI * (x / r + 1.0);
                let c = |k: f32| sin_cos(k * t).1;
                0.35875 - 0.48829 * c(1.0) + 0.14128 * c(2.0) - 0.01168 * c(3.0)
            }
        }
    }
}

impl Filter {
    /// Tabulates the filter.
    pub fn new(kind: FilterKind) -> Self {
        Filter { kind, distance: invert(kind) }
    }

    /// The tabulated inverse: distances from the centre, pixels, beyond which a share `(i / TABLE)²` of half the filter lies.
    pub fn distances(&self) -> &[f32; TABLE + 1] {
        &self.distance
    }

    /// Offset from the pixel's centre for a point of the unit square, pixels.
    #[inline]
    pub fn sample(&self, u: [f32; 2]) -> [f32; 2] {
        u.map(|u| match self.kind {
            FilterKind::Point => 0.0,
            FilterKind::Box => u - 0.5,
            FilterKind::Tent if u < 0.5 => safe_sqrt(2.0 * u) - 1.0,
            FilterKind::Tent => 1.0 - safe_sqrt(2.0 - 2.0 * u),
            FilterKind::Gaussian | FilterKind::BlackmanHarris => {
                let signed = 2.0 * u - 1.0;
                let x = safe_sqrt(1.0 - signed.abs()) * TABLE as f32;
                let i = (x as usize).min(TABLE - 1);
                lerp(self.distance[i], self.distance[i + 1], x - i as f32).copysign(signed)
            }
        })
    }
}

/// Integrates half of the filter inwards from its end on a fine grid, and inverts that.
fn invert(kind: FilterKind) -> [f32; TABLE + 1] {
    const FINE: usize = 64 * TABLE;
    let r = kind.radius();
    let step = r / FINE as f32;
    let beyond = |i: usize| r - i as f32 * step;
    let mut sums = vec![0.0f64; FINE + 1];
    for i in 0..FINE {
        sums[i + 1] = sums[i] + f64::from(kind.value(beyond(i) - 0.5 * step));
    }
    let mut distance = [0.0; TABLE + 1];
    let mut i = 0;
    for (k, out) in distance.iter_mut().enumerate() {
        let share = k as f64 / TABLE as f64;
        let target = sums[FINE] * share * share;
        while i + 1 < FINE && sums[i + 1] < target {
            i += 1;
        }
        let t = ((target - sums[i]) / (sums[i + 1] - sums[i]).max(1e-300)).clamp(0.0, 1.0);
        *out = beyond(i) - t as f32 * step;
    }
    distance
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_stays_at_the_centre() {
        let filter = Filter::new(FilterKind::Point);
        assert_eq!([[0.0, 0.3], [0.999, 0.5]].map(|u| filter.sample(u)), [[0.0; 2]; 2]);
    }

    /// The drawn offsets follow the filter: second moments and support agree with quadrature.
    #[test]
    fn samples_follow_the_filter() {
        for kind in [FilterKind::Box, FilterKind::Tent, FilterKind::Gaussian, FilterKind::BlackmanHarris] {
            let filter = Filter::new(kind);
            let n = 100_000;
            let (mut mean, mut second) = (0.0f64, 0.0f64);
            for i in 0..n {
                let [x, _] = filter.sample([(i as f32 + 0.5) / n as f32, 0.5]);
                assert!(x.abs() <= kind.radius() * 1.000_001);
                mean += f64::from(x) / n as f64;
                second += f64::from(x * x) / n as f64;
            }
            let (mut norm, mut expected) = (0.0f64, 0.0f64);
            for i in 0..n {
                let x = kind.radius() * (2.0 * (i as f32 + 0.5) / n as f32 - 1.0);
                norm += f64::from(kind.value(x));
                expected += f64::from(kind.value(x) * x * x);
            }
            assert!(mean.abs() < 1e-4, "{kind:?} mean {mean}");
            assert!(
                (second / (expected / norm) - 1.0).abs() < 2e-3,
                "{kind:?}: {second} {}",
                expected / norm
            );
        }
    }
}
