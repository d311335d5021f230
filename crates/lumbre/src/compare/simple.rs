//! Figures that look at each pixel alone: RMSE, relMSE, PSNR.

use super::{CompareError, ImageView, Score, check_pair};
use lumbre_core::Rgb;
use lumbre_core::color::srgb_encode;

/// Root of the mean squared difference over pixels and channels, linear values. 0 for equal pictures.
///
/// # Errors
/// When the sizes differ or no pixel is finite in both.
pub fn rmse(reference: ImageView, test: ImageView) -> Result<Score, CompareError> {
    let mean = mean_over_channels(reference, test, |r, t| (t - r) * (t - r))?;
    Ok(Score { value: mean.value.sqrt(), ..mean })
}

/// Mean over pixels and channels of (t - r)² / (r² + 0.01), linear values (Rousselle et al. 2011, section 5, with their
/// epsilon). 0 for equal pictures.
///
/// # Errors
/// When the sizes differ or no pixel is finite in both.
pub fn rel_mse(reference: ImageView, test: ImageView) -> Result<Score, CompareError> {
    mean_over_channels(reference, test, |r, t| (t - r) * (t - r) / (r * r + 0.01))
}

/// Peak signal-to-noise ratio in dB of the pictures as a screen shows them: clamped to [0, 1], then sRGB-encoded (not
/// rounded to 8 bit), peak 1. Infinite for equal pictures.
///
/// # Errors
/// When the sizes differ or no pixel is finite in both.
pub fn psnr(reference: ImageView, test: ImageView) -> Result<Score, CompareError> {
    // The curve clamps.
    let shown = |v: f64| f64::from(srgb_encode(v as f32));
    let mse = mean_over_channels(reference, test, |r, t| (shown(t) - shown(r)).powi(2))?;
    Ok(Score { value: -10.0 * mse.value.log10(), ..mse })
}

/// Mean of `f(reference, test)` over the three channels of all pixels that are finite in both.
fn mean_over_channels(
    reference: ImageView,
    test: ImageView,
    f: impl Fn(f64, f64) -> f64,
) -> Result<Score, CompareError> {
    let nonfinite = check_pair(reference, test)?;
    let finite = |(r, t): &(&Rgb, &Rgb)| r.is_finite() && t.is_finite();
    let mut sum = 0.0;
    for (r, t) in reference.pixels.iter().zip(test.pixels).filter(finite) {
        for c in 0..3 {
            sum += f(f64::from(r[c]), f64::from(t[c]));
        }
    }
    let pixels = reference.pixels.len() - nonfinite.either;
    Ok(Score { value: sum / (3 * pixels) as f64, nonfinite })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn uniform(v: f32) -> Vec<Rgb> {
        vec![Rgb::splat(v); 12]
    }

    fn view(pixels: &[Rgb]) -> ImageView<'_> {
        ImageView::new(4, 3, pixels).unwrap()
    }

    #[test]
    fn equal_pictures_score_perfectly() {
        let a = uniform(0.3);
        assert_eq!(rmse(view(&a), view(&a)).unwrap().value, 0.0);
        assert_eq!(rel_mse(view(&a), view(&a)).unwrap().value, 0.0);
        assert_eq!(psnr(view(&a), view(&a)).unwrap().value, f64::INFINITY);
    }

    #[test]
    fn closed_forms() {
        let (r, t) = (uniform(0.5), uniform(0.75));
        assert_eq!(rmse(view(&r), view(&t)).unwrap().value, 0.25);
        let expected = 0.0625 / 0.26;
        assert!((rel_mse(view(&r), view(&t)).unwrap().value - expected).abs() < 1e-12);
        // The reference, not the picture under test, is in the denominator.
        assert!((rel_mse(view(&t), view(&r)).unwrap().value - 0.0625 / 0.5725).abs() < 1e-12);
        // sRGB 0.5 is 0.2140411, sRGB 0.6 is 0.3185468 (linear): a difference of 0.1 is 20 dB.
        let (r, t) = (uniform(0.214_041_14), uniform(0.318_546_77));
        assert!((psnr(view(&r), view(&t)).unwrap().value - 20.0).abs() < 1e-4);
        // What a screen clips does not count.
        assert_eq!(psnr(view(&uniform(1.0)), view(&uniform(7.0))).unwrap().value, f64::INFINITY);
    }

    #[test]
    fn one_wrong_channel_counts_a_third() {
        let r = uniform(0.0);
        let mut t = uniform(0.0);
        t[5].g = 6.0;
        assert!((rmse(view(&r), view(&t)).unwrap().value - 1.0).abs() < 1e-12);
    }

    #[test]
    fn nonfinite_pixels_are_counted_and_left_out() {
        let (mut r, mut t) = (uniform(0.5), uniform(0.75));
        r[0].r = f32::NAN;
        t[0].b = f32::INFINITY;
        t[7].g = f32::NEG_INFINITY;
        let score = rmse(view(&r), view(&t)).unwrap();
        assert_eq!(score.value, 0.25);
        let n = score.nonfinite;
        assert_eq!((n.reference, n.test, n.either), (1, 2, 2));
        let bad = uniform(f32::NAN);
        assert_eq!(rmse(view(&r), view(&bad)), Err(CompareError::NothingFinite));
    }

    #[test]
    fn sizes_are_checked() {
        let a = uniform(0.0);
        let wide = ImageView::new(6, 2, &a).unwrap();
        let error = CompareError::SizeMismatch { reference: (4, 3), test: (6, 2) };
        assert_eq!(rmse(view(&a), wide), Err(error));
        assert!(matches!(ImageView::new(5, 3, &a), Err(CompareError::PixelCount { pixels: 12, .. })));
        assert!(matches!(ImageView::new(0, 3, &a), Err(CompareError::Empty { .. })));
        assert!(matches!(ImageView::new(usize::MAX, 3, &a), Err(CompareError::PixelCount { .. })));
    }
}
