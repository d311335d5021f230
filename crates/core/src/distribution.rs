//! Discrete distributions as cumulative tables, sampled by bisection: in order, so that a stratified number stays stratified.

use crate::math::ONE_MINUS_EPSILON;

/// An entry drawn from a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Which entry.
    pub index: usize,
    /// Its probability.
    pub probability: f32,
    /// Where in the entry the number fell, in [0, 1): as good a random number as the one spent.
    pub remainder: f32,
}

/// Appends the cumulative table of `weights` (not negative, finite) to `out`: `weights.len() + 1` values from 0 to 1, all zero if
/// every weight is. Returns the sum of the weights.
pub fn write_cdf(weights: &[f32], out: &mut Vec<f32>) -> f64 {
    let total: f64 = weights.iter().map(|&w| f64::from(w)).sum();
    let mut sum = 0.0;
    out.push(0.0);
    for (i, &w) in weights.iter().enumerate() {
        sum += f64::from(w);
        let last = i + 1 == weights.len() && total > 0.0;
        out.push(if last {
            1.0
        } else if total > 0.0 {
            (sum / total) as f32
        } else {
            0.0
        });
    }
    total
}

/// The entry that `u` in [0, 1) falls into; never one of probability 0. `None` for a table of zeros.
#[inline]
pub fn sample_cdf(cdf: &[f32], u: f32) -> Option<Choice> {
    let end = cdf.partition_point(|&c| c <= u);
    if end == 0 || end >= cdf.len() {
        return None;
    }
    let (low, high) = (cdf[end - 1], cdf[end]);
    let remainder = ((u - low) / (high - low)).min(ONE_MINUS_EPSILON);
    Some(Choice { index: end - 1, probability: high - low, remainder })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_drawn_by_weight_and_never_where_it_is_zero() {
        let mut cdf = Vec::new();
        assert_eq!(write_cdf(&[0.0, 1.0, 0.0, 3.0, 0.0], &mut cdf), 4.0);
        let mut counts = [0; 5];
        for i in 0..400 {
            let c = sample_cdf(&cdf, i as f32 / 400.0).unwrap();
            counts[c.index] += 1;
            assert!((0.0..1.0).contains(&c.remainder));
        }
        assert_eq!(counts, [0, 100, 0, 300, 0]);
        assert_eq!(sample_cdf(&cdf, ONE_MINUS_EPSILON).unwrap().index, 3);
        let mut black = Vec::new();
        write_cdf(&[0.0, 0.0], &mut black);
        assert!(
            sample_cdf(&black, 0.3).is_none()
                && sample_cdf(&[], 0.3).is_none()
                && sample_cdf(&[0.0], 0.3).is_none()
        );
    }
}
