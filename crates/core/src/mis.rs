//! Multiple importance sampling.

/// Power heuristic with β = 2 for one sample of each of two techniques; `pdf_a` is the one that made the sample.
/// Both in the same measure. Veach 1997, eq. 9.13.
///
/// Written as a ratio, so that squares of large densities do not overflow; an infinite `pdf_a` gives 1.
#[inline]
pub fn power_heuristic(pdf_a: f32, pdf_b: f32) -> f32 {
    if pdf_a <= 0.0 {
        return 0.0;
    }
    let r = pdf_b / pdf_a;
    1.0 / (1.0 + r * r)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_both_techniques_add_to_one() {
        for (a, b) in [(1.0, 2.0), (1e30, 1e25), (1e-20, 3.0), (5.0, 0.0)] {
            assert!((power_heuristic(a, b) + power_heuristic(b, a) - 1.0).abs() < 1e-6);
        }
        assert_eq!(power_heuristic(0.0, 1.0), 0.0);
    }
}
