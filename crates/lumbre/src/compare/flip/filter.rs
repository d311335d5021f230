//! The filters of FLIP (Andersson et al. 2020, sections 4.1.1 and 4.2.1) as pairs of one-dimensional kernels, and the
//! separable convolution that applies them. Beyond the border a picture repeats its border pixels.
//!
//! All two-dimensional kernels of the paper are Gaussians or derivatives of Gaussians, so each is a product of a kernel
//! along x and one along y; normalising the factors normalises the product.

use rayon::prelude::*;
use std::f64::consts::PI;

/// Odd number of weights, the middle one at offset 0.
pub(super) type Kernel = Vec<f32>;

/// Weights below this share of the largest one are cut off at the ends: they are lost in `f32` anyway.
const NEGLIGIBLE: f64 = 1e-9;

/// The kernels for one viewing distance.
pub(super) struct Kernels {
    /// Contrast sensitivity to black and white.
    pub(super) achromatic: Kernel,
    /// Contrast sensitivity to red and green.
    pub(super) red_green: Kernel,
    /// Contrast sensitivity to blue and yellow: two Gaussians with the weight of each.
    pub(super) blue_yellow: [(f32, Kernel); 2],
    /// Gaussian across a feature detector.
    pub(super) smooth: Kernel,
    /// First derivative: finds edges.
    pub(super) edge: Kernel,
    /// Second derivative: finds points.
    pub(super) point: Kernel,
}

impl Kernels {
    /// Kernels for an observer who sees `ppd` pixels per degree.
    pub(super) fn new(ppd: f64) -> Self {
        // Table 1 of the paper: a sqrt(pi/b) exp(-pi² x² / b), x in degrees.
        let csf = |b: f64| Gaussian { radius: csf_radius(ppd), inv_two_var: PI * PI / (b * ppd * ppd) };
        let (a1, b1, a2, b2) = (34.1, 0.04, 13.5, 0.025);
        // In two dimensions each Gaussian weighs its height times the square of its one-dimensional sum.
        let mass = |a: f64, b: f64| a * (PI / b).sqrt() * csf(b).weights(|_| 1.0).iter().sum::<f64>().powi(2);
        let (m1, m2) = (mass(a1, b1), mass(a2, b2));
        let share = |m: f64| (m / (m1 + m2)) as f32;

        // Section 4.2.1: the peak-to-trough width of human edge detectors is 0.082 degrees, two standard deviations.
        let sd = 0.5 * 0.082 * ppd;
        let feature = Gaussian { radius: (3.0 * sd).ceil() as i32, inv_two_var: 0.5 / (sd * sd) };
        Kernels {
            achromatic: unit_sum(csf(0.0047).weights(|_| 1.0)),
            red_green: unit_sum(csf(0.0053).weights(|_| 1.0)),
            blue_yellow: [
                (share(m1), unit_sum(csf(b1).weights(|_| 1.0))),
                (share(m2), unit_sum(csf(b2).weights(|_| 1.0))),
            ],
            smooth: unit_sum(feature.weights(|_| 1.0)),
            edge: unit_sides(feature.weights(|x| -x)),
            point: unit_sides(feature.weights(|x| x * x / (sd * sd) - 1.0)),
        }
    }
}

/// Three standard deviations of the widest Gaussian (b = 0.04); all sensitivity filters share it.
fn csf_radius(ppd: f64) -> i32 {
    (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * ppd).ceil() as i32
}

struct Gaussian {
    radius: i32,
    inv_two_var: f64,
}

impl Gaussian {
    /// `factor(x)` times the Gaussian at each pixel offset x.
    fn weights(&self, factor: impl Fn(f64) -> f64) -> Vec<f64> {
        let offsets = (-self.radius..=self.radius).map(f64::from);
        offsets.map(|x| factor(x) * (-x * x * self.inv_two_var).exp()).collect()
    }
}

/// Scaled so that the weights sum to 1, without negligible ends.
fn unit_sum(weights: Vec<f64>) -> Kernel {
    let sum: f64 = weights.iter().sum();
    let ends = weights.iter().take_while(|w| **w < NEGLIGIBLE * sum).count();
    weights[ends..weights.len() - ends].iter().map(|w| (w / sum) as f32).collect()
}

/// Scaled so that the positive weights sum to 1 and the negative ones to -1.
fn unit_sides(weights: Vec<f64>) -> Kernel {
    let positive: f64 = weights.iter().filter(|w| **w > 0.0).sum();
    let negative: f64 = -weights.iter().filter(|w| **w < 0.0).sum::<f64>();
    weights.iter().map(|w| (if *w > 0.0 { w / positive } else { w / negative }) as f32).collect()
}

/// Outputs computed together, so that the sums stay in registers.
const LANES: usize = 32;

/// One channel of a picture.
#[derive(Clone)]
pub(super) struct Plane {
    pub(super) width: usize,
    pub(super) data: Vec<f32>,
}

impl Plane {
    /// Convolved with `kx` along rows and `ky` along columns.
    pub(super) fn filtered(&self, kx: &Kernel, ky: &Kernel) -> Plane {
        self.along_rows(kx).along_columns(ky)
    }

    fn along_rows(&self, kernel: &Kernel) -> Plane {
        let (width, radius) = (self.width, kernel.len() / 2);
        let mut data = vec![0.0; self.data.len()];
        let rows = data.par_chunks_mut(width).zip(self.data.par_chunks(width));
        rows.for_each_init(
            || vec![0.0; width + 2 * radius + LANES],
            |padded, (out, row)| {
                padded[..radius].fill(row[0]);
                padded[radius..radius + width].copy_from_slice(row);
                padded[radius + width..].fill(row[width - 1]);
                for (block, out) in out.chunks_mut(LANES).enumerate() {
                    let mut sum = [0.0; LANES];
                    for (k, weight) in kernel.iter().enumerate() {
                        let from = block * LANES + k;
                        add_scaled(&mut sum, &padded[from..from + LANES], *weight);
                    }
                    out.copy_from_slice(&sum[..out.len()]);
                }
            },
        );
        Plane { width, data }
    }

    fn along_columns(&self, kernel: &Kernel) -> Plane {
        let width = self.width;
        let last = (self.data.len() / width - 1) as isize;
        let radius = (kernel.len() / 2) as isize;
        let mut data = vec![0.0; self.data.len()];
        data.par_chunks_mut(width).enumerate().for_each(|(y, out)| {
            for (block, out) in out.chunks_mut(LANES).enumerate() {
                let mut sum = [0.0; LANES];
                for (k, weight) in kernel.iter().enumerate() {
                    let row = (y as isize + k as isize - radius).clamp(0, last) as usize;
                    let from = row * width + block * LANES;
                    add_scaled(&mut sum, &self.data[from..from + out.len()], *weight);
                }
                out.copy_from_slice(&sum[..out.len()]);
            }
        });
        Plane { width, data }
    }
}

/// sum += weight * values, for as many as there are values.
#[inline(always)]
fn add_scaled(sum: &mut [f32; LANES], values: &[f32], weight: f32) {
    // The full case has a length known at compile time and becomes SIMD code.
    if let Ok(values) = <&[f32; LANES]>::try_from(values) {
        for (s, v) in sum.iter_mut().zip(values) {
            *s += weight * v;
        }
    } else {
        for (s, v) in sum.iter_mut().zip(values) {
            *s += weight * v;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The kernel of the paper in two dimensions, normalised there, against the product of our factors.
    #[test]
    fn products_are_the_two_dimensional_kernels() {
        let ppd = 67.0;
        let k = Kernels::new(ppd);
        let r = csf_radius(ppd);
        let g2 = |a: f64, b: f64, d2: f64| a * (PI / b).sqrt() * (-PI * PI * d2 / b).exp();
        let by = |x: i32, y: i32| {
            let d2 = f64::from(x * x + y * y) / (ppd * ppd);
            g2(34.1, 0.04, d2) + g2(13.5, 0.025, d2)
        };
        let total: f64 = (-r..=r).flat_map(|y| (-r..=r).map(move |x| by(x, y))).sum();
        for (x, y) in [(0, 0), (3, -2), (10, 10)] {
            let at = |kernel: &Kernel, i: i32| {
                let centre = kernel.len() as i32 / 2;
                f64::from(kernel.get((centre + i) as usize).copied().unwrap_or(0.0))
            };
            let ours: f64 = k.blue_yellow.iter().map(|(m, g)| f64::from(*m) * at(g, x) * at(g, y)).sum();
            assert!((ours - by(x, y) / total).abs() < 1e-8, "({x}, {y})");
        }
    }

    #[test]
    fn constants_pass_and_edges_answer_to_steps() {
        let k = Kernels::new(67.0);
        let (w, h) = (75, 40);
        let flat = Plane { width: w, data: vec![0.25; w * h] };
        for kernel in [&k.achromatic, &k.red_green, &k.blue_yellow[0].1, &k.blue_yellow[1].1, &k.smooth] {
            assert!(flat.filtered(kernel, kernel).data.iter().all(|v| (v - 0.25).abs() < 1e-6));
        }
        assert!(flat.filtered(&k.edge, &k.smooth).data.iter().all(|v| v.abs() < 1e-6));
        assert!(flat.filtered(&k.smooth, &k.point).data.iter().all(|v| v.abs() < 1e-6));

        // A step along x: full answer from the detector along x, none from the one along y.
        let step = Plane { width: w, data: (0..w * h).map(|i| f32::from(i % w >= 37)).collect() };
        let along_x = step.filtered(&k.edge, &k.smooth);
        let peak = along_x.data.iter().fold(0.0_f32, |m, v| m.max(v.abs()));
        assert!((peak - 1.0).abs() < 1e-5, "{peak}");
        assert!(step.filtered(&k.smooth, &k.edge).data.iter().all(|v| v.abs() < 1e-6));
    }

    #[test]
    fn pictures_smaller_than_the_kernel() {
        let k = Kernels::new(67.0);
        let one = Plane { width: 1, data: vec![0.5] };
        assert!((one.filtered(&k.smooth, &k.smooth).data[0] - 0.5).abs() < 1e-6);
    }
}
