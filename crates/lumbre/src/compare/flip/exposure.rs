//! The exposures of HDR-FLIP and its tone curve (Andersson et al. 2021, section 4).

use lumbre_core::Rgb;

/// Narkowicz' fit of the ACES curve (2016), (k0 x² + k1 x) / (k3 x² + k4 x + k5), with the exposure of 0.6 that the fit
/// leaves out multiplied in.
const ACES: [f64; 5] = [0.36 * 2.51, 0.6 * 0.03, 0.36 * 2.43, 0.6 * 0.59, 0.14];

/// The tone-mapped value that the brightest pixel has in the first exposure, and the median pixel in the last.
const TARGET: f64 = 0.85;

/// A series of exposures in stops (powers of 2), evenly spaced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exposures {
    /// The darkest picture of the series.
    pub start: f64,
    /// The brightest.
    pub stop: f64,
    /// How many there are, at least 1.
    pub count: usize,
}

impl Exposures {
    /// The series for a reference: from the exposure that brings its brightest pixel to 0.85 on the tone curve to the one
    /// that brings its median pixel there, in steps of about a stop, at least two. A black reference and one whose median
    /// is its maximum have one exposure. A median below `f32::EPSILON` counts as `f32::EPSILON`.
    pub(super) fn of(reference: &[Rgb]) -> Exposures {
        let mut luminance: Vec<f32> = reference.iter().map(|c| c.luminance()).collect();
        let brightest = luminance.iter().fold(0.0_f32, |m, y| m.max(*y));
        if brightest <= 0.0 {
            return Exposures { start: 0.0, stop: 0.0, count: 1 };
        }
        let middle = luminance.len() / 2;
        let median = luminance.select_nth_unstable_by(middle, f32::total_cmp).1.max(f32::EPSILON);
        let x = inverse_aces(TARGET);
        let start = (x / f64::from(brightest)).log2();
        let stop = (x / f64::from(median)).log2();
        if stop <= start {
            return Exposures { start, stop: start, count: 1 };
        }
        Exposures { start, stop, count: ((stop - start).ceil() as usize).max(2) }
    }

    /// The exposures, in stops.
    pub fn stops(&self) -> impl Iterator<Item = f64> {
        let step = (self.stop - self.start) / (self.count.max(2) - 1) as f64;
        (0..self.count).map(move |i| self.start + i as f64 * step)
    }
}

/// The x that the curve maps to `y`, the larger solution of its quadratic equation.
fn inverse_aces(y: f64) -> f64 {
    let [k0, k1, k3, k4, k5] = ACES;
    let (a, b, c) = (k0 - y * k3, k1 - y * k4, -y * k5);
    ((b * b - 4.0 * a * c).sqrt() - b) / (2.0 * a)
}

/// Exposure by `stops` and the ACES curve: any finite colour to [0, 1]. Negative values count as 0.
pub(super) fn tone_curve(stops: f64) -> impl Fn(Rgb) -> Rgb + Sync {
    let scale = stops.exp2() as f32;
    let [k0, k1, k3, k4, k5] = ACES.map(|k| k as f32);
    move |c| {
        c.map(|v| {
            // Far beyond white the squares would overflow; 1e6 is white already.
            let x = (v.max(0.0) * scale).min(1e6);
            ((k0 * x + k1) * x / ((k3 * x + k4) * x + k5)).clamp(0.0, 1.0)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_brings_maximum_and_median_to_the_target() {
        let mut pixels = vec![Rgb::splat(0.2); 9];
        pixels[3] = Rgb::splat(30.0);
        let e = Exposures::of(&pixels);
        assert_eq!(e.count, 8); // log2(150) = 7.2
        let stops: Vec<f64> = e.stops().collect();
        assert_eq!(stops.len(), 8);
        assert!((tone_curve(stops[0])(pixels[3]).r - 0.85).abs() < 1e-5);
        assert!((tone_curve(stops[7])(pixels[0]).r - 0.85).abs() < 1e-5);
    }

    #[test]
    fn degenerate_references() {
        assert_eq!(Exposures::of(&[Rgb::BLACK; 4]), Exposures { start: 0.0, stop: 0.0, count: 1 });
        let flat = Exposures::of(&[Rgb::WHITE; 4]);
        assert_eq!((flat.count, flat.start), (1, flat.stop));
        // Mostly black: the median is held at epsilon, and the series stays finite.
        let mut dark = vec![Rgb::BLACK; 9];
        dark[0] = Rgb::splat(5.0);
        let e = Exposures::of(&dark);
        assert!((e.start + 1.238_63).abs() < 1e-4 && (e.stop - 24.083_30).abs() < 1e-4 && e.count == 26);
    }

    #[test]
    fn the_curve_takes_any_finite_value() {
        let f = tone_curve(60.0);
        assert_eq!(f(Rgb::new(-1.0, 0.0, f32::MAX)).to_array(), [0.0, 0.0, 1.0]);
    }
}
