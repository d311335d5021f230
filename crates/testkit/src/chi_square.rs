//! Pearson's chi-square test of a direction sampler against the density it claims.
//!
//! Works for anything that draws directions: BSDFs, lights seen from a point, lenses. The sphere is cut into bins by height and azimuth
//! about an axis; counts are compared with the density integrated over each bin. Bins with fewer than five expected samples are
//! pooled, as the approximation asks. Over many tests the significance is corrected after Šidák.

use lumbre_core::Frame;
use lumbre_core::math::Vec3;
use std::f64::consts::PI;

/// Expected counts below this are pooled.
const MIN_EXPECTED: f64 = 5.0;

/// Absolute error at which the integral over a cell counts as settled: far below the noise of 1e6 draws in a bin.
const TOLERANCE: f64 = 5e-8;

/// Halvings of a bin at most.
const MAX_DEPTH: u32 = 6;

/// How the sphere is cut into bins.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// Pole of the grid, unit: place it where the density is narrow.
    pub axis: Vec3,
    /// Height (1 - cos θ)/2 of the ring where the density is narrow: 0 is the pole.
    pub ring: f64,
    /// Bins by angle from the axis; edges at heights (1 - cos θ)/2 = sᵖ, s equidistant, or mirrored about the ring, half of them on each side.
    pub n_theta: usize,
    /// Bins by azimuth, equidistant.
    pub n_phi: usize,
    /// p: 1 gives equal areas, larger values crowd the bins at the ring.
    pub power: f64,
    /// Halvings of a bin at least when the density is integrated: a few for densities with edges, which may cut a corner off a bin
    /// that coarse points miss.
    pub halvings: u32,
}

impl Grid {
    /// Equal-area bins for broad densities about +z.
    pub fn broad() -> Self {
        Grid { axis: Vec3::Z, ring: 0.0, n_theta: 40, n_phi: 40, power: 1.0, halvings: 0 }
    }
    /// Bins that crowd about `axis`, the more the larger `power`.
    pub fn about(axis: Vec3, power: f64) -> Self {
        Grid { axis: axis.normalize(), ring: 0.0, n_theta: 48, n_phi: 24, power, halvings: 0 }
    }

    /// Bins that crowd about the cone of directions with the cosine `cos` to `axis`.
    pub fn about_cone(axis: Vec3, cos: f64, power: f64) -> Self {
        Grid { axis: axis.normalize(), ring: 0.5 - 0.5 * cos, n_theta: 48, n_phi: 40, power, halvings: 0 }
    }

    /// The same for a density that ends at edges.
    pub fn with_edges(self) -> Self {
        Grid { halvings: 3, ..self }
    }

    fn bins(&self) -> usize {
        self.n_theta * self.n_phi
    }

    fn bin_of(&self, frame: &Frame, w: Vec3) -> usize {
        let local = frame.to_local(w);
        // (1 - cos θ)/2 from the chord where that is the more exact form.
        let tangent2 = f64::from(local.x).powi(2) + f64::from(local.y).powi(2);
        let z = f64::from(local.z);
        let below = if z > 0.0 { tangent2 / (2.0 * (1.0 + z)) } else { (1.0 - z) / 2.0 };
        let s = self.position(below.clamp(0.0, 1.0));
        let phi = f64::from(local.y).atan2(f64::from(local.x)) / (2.0 * PI);
        let i = ((s * self.n_theta as f64) as usize).min(self.n_theta - 1);
        let j = ((phi.rem_euclid(1.0) * self.n_phi as f64) as usize).min(self.n_phi - 1);
        i * self.n_phi + j
    }

    /// Where the ring lies among the bins.
    fn middle(&self) -> f64 {
        if self.ring > 0.0 { 0.5 } else { 0.0 }
    }

    /// Height at a position in [0, 1] among the bins, and its derivative.
    fn height(&self, s: f64) -> (f64, f64) {
        let middle = self.middle();
        let (whole, part) = if s < middle { (-self.ring, middle) } else { (1.0 - self.ring, 1.0 - middle) };
        let t = (s - middle).abs() / part;
        let slope = self.power * whole.abs() / part * t.powf(self.power - 1.0);
        (self.ring + whole * t.powf(self.power), slope)
    }

    /// The position of a height.
    fn position(&self, below: f64) -> f64 {
        let middle = self.middle();
        if below < self.ring {
            return middle - middle * ((self.ring - below) / self.ring).powf(1.0 / self.power);
        }
        middle + (1.0 - middle) * ((below - self.ring) / (1.0 - self.ring)).powf(1.0 / self.power)
    }

    /// Integral of `pdf` over one bin.
    fn integrate(&self, frame: &Frame, bin: usize, pdf: &impl Fn(Vec3) -> f32) -> f64 {
        let (i, j) = (bin / self.n_phi, bin % self.n_phi);
        let (ds, dv) = (1.0 / self.n_theta as f64, 1.0 / self.n_phi as f64);
        // Integrand over the unit square of (s, azimuth / 2π).
        let integrand = |s: f64, v: f64| {
            let (below, slope) = self.height(s);
            let jacobian = 4.0 * PI * slope;
            let (z, r) = (1.0 - 2.0 * below, 2.0 * (below * (1.0 - below)).max(0.0).sqrt());
            let (sp, cp) = (2.0 * PI * v).sin_cos();
            let w = frame.to_world(Vec3::new((r * cp) as f32, (r * sp) as f32, z as f32));
            jacobian * f64::from(pdf(w))
        };
        Cell { s: i as f64 * ds, v: j as f64 * dv, ds, dv }.integrate(&integrand, self.halvings)
    }
}

/// A rectangle of the unit square.
#[derive(Clone, Copy)]
pub(crate) struct Cell {
    pub(crate) s: f64,
    pub(crate) v: f64,
    pub(crate) ds: f64,
    pub(crate) dv: f64,
}

impl Cell {
    /// Integral of `f` over the cell, halved at least `halvings` times.
    pub(crate) fn integrate(self, f: &impl Fn(f64, f64) -> f64, halvings: u32) -> f64 {
        self.refine(f, self.gauss(f), (MAX_DEPTH, MAX_DEPTH - halvings))
    }

    fn gauss(&self, f: &impl Fn(f64, f64) -> f64) -> f64 {
        let mut sum = 0.0;
        for (a, wa) in GAUSS {
            for (b, wb) in GAUSS {
                sum += wa * wb * f(self.s + a * self.ds, self.v + b * self.dv);
            }
        }
        sum * self.ds * self.dv
    }

    /// Quarters the cell until its integral settles: edges such as horizons cut through bins. `depth`: halvings left, and
    /// what may at most be left of them.
    fn refine(&self, f: &impl Fn(f64, f64) -> f64, coarse: f64, (depth, most): (u32, u32)) -> f64 {
        let (ds, dv) = (self.ds / 2.0, self.dv / 2.0);
        let quarters = [(0.0, 0.0), (ds, 0.0), (0.0, dv), (ds, dv)]
            .map(|(a, b)| Cell { s: self.s + a, v: self.v + b, ds, dv })
            .map(|cell| (cell, cell.gauss(f)));
        let fine: f64 = quarters.iter().map(|(_, value)| value).sum();
        if depth == 0 || (depth <= most && (fine - coarse).abs() < TOLERANCE) {
            return fine;
        }
        quarters.iter().map(|(cell, value)| cell.refine(f, *value, (depth - 1, most))).sum()
    }
}

/// Gauss-Legendre nodes and weights on [0, 1], four points.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_13, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_29, 0.173_927_422_568_726_93),
];

/// Outcome of one test.
#[derive(Clone, Copy, Debug)]
pub struct ChiSquare {
    /// Probability of a statistic at least this large if the density is right.
    pub p_value: f64,
    /// Integral of the density over the sphere.
    pub integral: f64,
    /// Share of draws that gave a direction.
    pub accepted: f64,
    /// Pearson's statistic.
    pub statistic: f64,
    /// Bins less one, after pooling.
    pub degrees: usize,
    /// Number of draws.
    pub draws: usize,
}

impl ChiSquare {
    /// True unless the hypothesis is rejected at `significance` over `tests` tests together (Šidák 1967), or the density does not integrate
    /// to the share of draws that gave a direction.
    pub fn accept(&self, significance: f64, tests: usize) -> bool {
        let sigma = (self.accepted * (1.0 - self.accepted) / self.draws as f64).sqrt();
        (self.integral - self.accepted).abs() <= 4.5 * sigma + 5e-4
            && self.p_value >= 1.0 - (1.0 - significance).powf(1.0 / tests as f64)
    }
}

/// Draws `n` times; `sample(k)` is `None` where the k-th draw gives no direction, which must happen with probability 1 less
/// the integral of `pdf` (sr⁻¹, over the sphere).
pub fn test(
    grid: &Grid,
    n: usize,
    mut sample: impl FnMut(u32) -> Option<Vec3>,
    pdf: impl Fn(Vec3) -> f32,
) -> ChiSquare {
    let frame = Frame::from_normal(grid.axis);
    let mut counts = vec![0u64; grid.bins() + 1];
    for k in 0..n {
        let bin = sample(k as u32).map_or(grid.bins(), |w| grid.bin_of(&frame, w));
        counts[bin] += 1;
    }
    let expected: Vec<f64> = (0..grid.bins()).map(|b| grid.integrate(&frame, b, &pdf)).collect();
    compare(&counts, &expected, n)
}

/// Compares counts with the shares of `n` draws that are expected in each bin; `counts` has one entry more, for draws that fell
/// in no bin.
///
/// # Panics
/// If it has not.
pub fn compare(counts: &[u64], expected: &[f64], n: usize) -> ChiSquare {
    let bins = expected.len();
    assert_eq!(counts.len(), bins + 1, "one count for each bin and one for what fell in none");
    let integral: f64 = expected.iter().sum();
    let accepted = 1.0 - counts[bins] as f64 / n as f64;
    let nowhere = (1.0 - integral).max(0.0);

    let (mut statistic, mut used) = (0.0, 0usize);
    let (mut pooled_count, mut pooled_expected) = (0.0, 0.0);
    for (&count, &share) in counts.iter().zip(expected.iter().chain([&nowhere])) {
        let (count, share) = (count as f64, share * n as f64);
        if share < MIN_EXPECTED {
            pooled_count += count;
            pooled_expected += share;
        } else {
            statistic += (count - share).powi(2) / share;
            used += 1;
        }
    }
    if pooled_expected >= MIN_EXPECTED {
        statistic += (pooled_count - pooled_expected).powi(2) / pooled_expected;
        used += 1;
    } else if pooled_count > MIN_EXPECTED + 5.0 * MIN_EXPECTED.sqrt() {
        // Draws where the density says there is next to nothing.
        statistic = f64::INFINITY;
    }
    let degrees = used.saturating_sub(1).max(1);
    ChiSquare { p_value: survival(statistic, degrees), integral, accepted, statistic, degrees, draws: n }
}

/// Probability that a chi-square variable with `degrees` degrees of freedom exceeds `x`: the regularised upper incomplete gamma
/// function Q(degrees/2, x/2), by its series or continued fraction (Abramowitz and Stegun 1964, 6.5.29 and 6.5.31).
pub fn survival(x: f64, degrees: usize) -> f64 {
    if !x.is_finite() {
        return 0.0;
    }
    let (a, x) = (degrees as f64 / 2.0, x / 2.0);
    if x <= 0.0 {
        return 1.0;
    }
    let scale = (a * x.ln() - x - ln_gamma(a)).exp();
    if x < a + 1.0 {
        let (mut term, mut sum, mut k) = (1.0 / a, 1.0 / a, a);
        while term.abs() > sum.abs() * 1e-15 {
            k += 1.0;
            term *= x / k;
            sum += term;
        }
        return (1.0 - sum * scale).max(0.0);
    }
    // Lentz's method.
    let tiny = 1e-300;
    let mut b = x + 1.0 - a;
    let (mut c, mut d) = (1.0 / tiny, 1.0 / b);
    let mut h = d;
    for i in 1..10_000 {
        let i = f64::from(i);
        let an = -i * (i - a);
        b += 2.0;
        d = 1.0 / (an * d + b + tiny);
        c = b + an / c + tiny;
        let delta = d * c;
        h *= delta;
        if (delta - 1.0).abs() < 1e-14 {
            break;
        }
    }
    scale * h
}

/// ln Γ(x) for x > 0: Stirling's series after shifting x above 10 (Abramowitz and Stegun 1964, 6.1.41).
fn ln_gamma(mut x: f64) -> f64 {
    let mut shift = 0.0;
    while x < 10.0 {
        shift -= x.ln();
        x += 1.0;
    }
    let r = 1.0 / (x * x);
    let series = (1.0 / 12.0 - r * (1.0 / 360.0 - r * (1.0 / 1260.0 - r / 1680.0))) / x;
    shift + (x - 0.5) * x.ln() - x + 0.5 * (2.0 * PI).ln() + series
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_core::hash::unit;
    use lumbre_core::warp::{cosine_hemisphere, cosine_hemisphere_pdf, uniform_cone, uniform_cone_pdf};

    fn draw(k: u32) -> [f32; 2] {
        [unit(k, 101), unit(k, 102)]
    }

    #[test]
    fn survival_function_against_printed_tables() {
        for (x, degrees, p) in
            [(3.841, 1, 0.05), (18.307, 10, 0.05), (124.342, 100, 0.05), (135.807, 100, 0.01)]
        {
            assert!((survival(x, degrees) - p).abs() < 2e-5, "{x} {degrees}: {}", survival(x, degrees));
        }
        assert!((survival(2.0, 2) - (-1.0f64).exp()).abs() < 1e-12);
        assert!(survival(1000.0, 1000) > 0.4 && survival(1000.0, 1000) < 0.6);
    }

    #[test]
    fn right_density_is_accepted() {
        let r = test(
            &Grid::broad(),
            1_000_000,
            |k| Some(cosine_hemisphere(draw(k))),
            |w| cosine_hemisphere_pdf(w.z),
        );
        assert!(r.accept(0.01, 1), "{r:?}");
        assert!((r.integral - 1.0).abs() < 1e-3 && r.accepted == 1.0);
    }

    #[test]
    fn narrow_density_is_resolved() {
        let axis = Vec3::new(0.3, -0.5, 0.2).normalize();
        let frame = Frame::from_normal(axis);
        let h = 1e-4;
        // A cone ends at an edge; place a bin edge on it by the choice of the power: s = (h/2)^(1/p) = 1/2.
        let power = (h / 2.0f64).ln() / 0.5f64.ln();
        let r = test(
            &Grid::about(axis, power),
            200_000,
            |k| Some(frame.to_world(uniform_cone(draw(k), h as f32))),
            |w| {
                if frame.to_local(w).truncate().length_squared() < 2e-4 && axis.dot(w) > 0.0 {
                    uniform_cone_pdf(h as f32)
                } else {
                    0.0
                }
            },
        );
        assert!((r.integral - 1.0).abs() < 2e-3, "{r:?}");
    }

    #[test]
    fn positions_invert_heights() {
        for grid in [Grid::broad(), Grid::about(Vec3::Z, 4.0), Grid::about_cone(Vec3::Y, 0.3, 5.0)] {
            for s in [0.0, 0.03, 0.3, 0.5, 0.77, 1.0] {
                let (height, slope) = grid.height(s);
                assert!(
                    (grid.position(height) - s).abs() < 1e-4 && (0.0..=1.0).contains(&height),
                    "{s} {height}"
                );
                let near = grid.height(s + 1e-6).0;
                assert!(((near - height) / 1e-6 - slope).abs() < 1e-3, "{s} {slope}");
            }
        }
    }

    #[test]
    fn wrong_densities_are_rejected() {
        let n = 1_000_000;
        let grid = Grid::broad();
        let cosine = |k| Some(cosine_hemisphere(draw(k)));
        // 1 % too large, the shape slightly off, the wrong law, draws lost, draws outside.
        assert!(!test(&grid, n, cosine, |w| 1.01 * cosine_hemisphere_pdf(w.z)).accept(0.01, 100));
        let tilted = |w: Vec3| cosine_hemisphere_pdf(w.z) * (1.0 + 0.03 * w.x);
        assert!(!test(&grid, n, cosine, tilted).accept(0.01, 100));
        let uniform = |w: Vec3| if w.z > 0.0 { 0.5 / lumbre_core::math::PI } else { 0.0 };
        assert!(!test(&grid, n, cosine, uniform).accept(0.01, 100));
        let lossy = |k: u32| if k.is_multiple_of(100) { None } else { cosine(k) };
        assert!(!test(&grid, n, lossy, |w| cosine_hemisphere_pdf(w.z)).accept(0.01, 100));
        let leaking = |k: u32| if k.is_multiple_of(1000) { Some(-Vec3::Z) } else { cosine(k) };
        assert!(!test(&grid, n, leaking, |w| cosine_hemisphere_pdf(w.z)).accept(0.01, 100));
    }
}
