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

/// Steps of a table: as many as a random number has, so that the probability of an entry is exactly how often it is drawn.
const STEPS: u32 = 1 << 24;

/// Appends the cumulative table of `weights` (not negative, finite, at most 2²³ of them) to `out`: `weights.len() + 1` multiples of 2⁻²⁴
/// from 0 to 1, all zero if every weight is. Every positive weight gets at least one step. Returns the sum of the weights.
pub fn write_cdf(weights: &[f32], out: &mut Vec<f32>) -> f64 {
    let positive = weights.iter().filter(|&&w| w > 0.0).count() as u32;
    assert!(positive <= STEPS / 2, "{positive} entries do not fit a table of {STEPS} steps");
    let total: f64 = weights.iter().map(|&w| f64::from(w)).sum();
    // One step each, the rest by weight.
    let (mut sum, mut passed) = (0.0, 0);
    out.push(0.0);
    for &w in weights {
        sum += f64::from(w);
        passed += u32::from(w > 0.0);
        let share = if total > 0.0 { sum / total } else { 0.0 };
        let steps = if passed == positive && total > 0.0 {
            STEPS
        } else {
            passed + (share * f64::from(STEPS - positive)) as u32
        };
        out.push(steps as f32 / STEPS as f32);
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
    // The middle of the step that `u` stands for.
    let remainder = ((u - low + 0.5 / STEPS as f32) / (high - low)).min(ONE_MINUS_EPSILON);
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
        // However small a weight, it is drawn as often as its probability says.
        let (mut uneven, mut drawn) = (Vec::new(), [0u32; 3]);
        write_cdf(&[1e-30, 1e30, 1e-3], &mut uneven);
        for i in (0..64).chain(STEPS - 64..STEPS) {
            drawn[sample_cdf(&uneven, i as f32 / STEPS as f32).unwrap().index] += 1;
        }
        assert_eq!(drawn, [1, 126, 1]);
        assert_eq!(uneven[1], 1.0 / STEPS as f32);
        let mut black = Vec::new();
        write_cdf(&[0.0, 0.0], &mut black);
        assert!(
            sample_cdf(&black, 0.3).is_none()
                && sample_cdf(&[], 0.3).is_none()
                && sample_cdf(&[0.0], 0.3).is_none()
        );
    }
}
