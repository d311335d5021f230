//! Multiple importance sampling.

/// Power heuristic with β = 2 for one sample of each of two techniques; `pdf_a` is the one that made the sample.
/// Both in the same measure. Veach 1997, eq. 9.13.
///
/// Written as a ratio, so that squares of large densities do not overflow. Densities below the normal floats count as 0 and those above
/// 2¹²⁵ as that: GPUs take the former for 0 and need not divide by the latter, and both sides are to decide alike.
#[inline]
pub fn power_heuristic(pdf_a: f32, pdf_b: f32) -> f32 {
    let (a, b) = (pdf_within(pdf_a), pdf_within(pdf_b));
    if a == 0.0 {
        return 0.0;
    }
    let r = b / a;
    1.0 / (1.0 + r * r)
}

/// A density as far as it tells; what is no number stays none.
#[inline]
fn pdf_within(pdf: f32) -> f32 {
    const LARGEST: f32 = 4.253_529_6e37;
    if pdf < f32::MIN_POSITIVE {
        0.0
    } else if pdf > LARGEST {
        LARGEST
    } else {
        pdf
    }
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
        assert_eq!(power_heuristic(f32::INFINITY, 1e20), 1.0);
        assert!(power_heuristic(f32::NAN, 1.0).is_nan() && power_heuristic(1.0, f32::NAN).is_nan());
        // As if small numbers were 0, whether or not they are.
        assert_eq!([power_heuristic(1e-38, 0.0), power_heuristic(f32::MIN_POSITIVE, 1e-38)], [0.0, 1.0]);
    }
}
