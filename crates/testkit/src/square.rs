//! Chi-square of a sampler on the unit square against the density it claims: for lenses, pixel filters and lights, in coordinates
//! whose lines follow the edges of the density.

use crate::chi_square::{Cell, ChiSquare, compare};

/// Bins of the unit square.
#[derive(Clone, Copy, Debug)]
pub struct Bins {
    /// Along the first coordinate.
    pub columns: usize,
    /// Along the second.
    pub rows: usize,
}

impl Bins {
    /// The bin of a point, or the one past the end for a point outside the square.
    fn of(self, [x, y]: [f64; 2]) -> usize {
        let index = |v: f64, n: usize| ((v * n as f64) as usize).min(n - 1);
        let inside = |v: f64| (0.0..=1.0).contains(&v);
        if inside(x) && inside(y) {
            index(y, self.rows) * self.columns + index(x, self.columns)
        } else {
            self.columns * self.rows
        }
    }

    fn cell(self, bin: usize) -> Cell {
        let (ds, dv) = (1.0 / self.columns as f64, 1.0 / self.rows as f64);
        Cell { s: (bin % self.columns) as f64 * ds, v: (bin / self.columns) as f64 * dv, ds, dv }
    }
}

/// Draws `n` times; `sample(k)` is `None`, or outside the unit square, with probability 1 less the integral of `density`.
pub fn test(
    bins: Bins,
    n: usize,
    sample: impl Fn(u32) -> Option<[f64; 2]>,
    density: impl Fn(f64, f64) -> f64,
) -> ChiSquare {
    let count = bins.columns * bins.rows;
    let mut counts = vec![0u64; count + 1];
    for k in 0..n {
        counts[sample(k as u32).map_or(count, |p| bins.of(p))] += 1;
    }
    let expected: Vec<f64> = (0..count).map(|b| bins.cell(b).integrate(&density, 0)).collect();
    compare(&counts, &expected, n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_core::hash::unit;

    const BINS: Bins = Bins { columns: 20, rows: 30 };

    fn uniform(k: u32) -> [f64; 2] {
        [unit(k, 5), unit(k, 6)].map(f64::from)
    }

    #[test]
    fn right_densities_are_accepted_and_wrong_ones_are_not() {
        let n = 400_000;
        let ramp = |k: u32| {
            let [x, y] = uniform(k);
            Some([x.sqrt(), y])
        };
        assert!(test(BINS, n, ramp, |x, _| 2.0 * x).accept(0.01, 1));
        for wrong in [1.01, 0.99] {
            assert!(!test(BINS, n, ramp, |x, _| wrong * 2.0 * x).accept(0.01, 100));
        }
        assert!(!test(BINS, n, ramp, |x, y| 2.0 * x * (1.03 - 0.06 * y)).accept(0.01, 100));
    }

    #[test]
    fn points_outside_count_as_none() {
        let n = 100_000;
        let wide = |k: u32| Some([1.25 * uniform(k)[0], uniform(k)[1]]);
        let r = test(BINS, n, wide, |_, _| 0.8);
        assert!(r.accept(0.01, 1) && (r.accepted - 0.8).abs() < 0.01, "{r:?}");
        assert!(!test(BINS, n, wide, |_, _| 1.0).accept(0.01, 1));
    }
}
