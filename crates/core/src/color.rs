//! The sRGB transfer curve (IEC 61966-2-1) and exposure.

use crate::hash::{hash_combine, hash_u32, to_unit};
use crate::math::{exp, exp2, ln, pow, sqr};
use crate::rgb::Rgb;
use std::sync::LazyLock;

/// Linear 0..1 to sRGB 0..1; values outside are clamped.
#[inline]
pub fn srgb_encode(x: f32) -> f32 {
    let x = x.clamp(0.0, 1.0);
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * pow(x, 1.0 / 2.4) - 0.055 }
}

/// sRGB 0..1 to linear 0..1.
#[inline]
pub fn srgb_decode(x: f32) -> f32 {
    if x <= 0.040_45 { x / 12.92 } else { pow((x + 0.055) / 1.055, 2.4) }
}

static DECODE_U8: LazyLock<[f32; 256]> =
    LazyLock::new(|| core::array::from_fn(|i| srgb_decode(i as f32 / 255.0)));

/// The linear value of each 8-bit sRGB code.
#[inline]
pub fn srgb_decode_table() -> &'static [f32; 256] {
    &DECODE_U8
}

/// The 8-bit sRGB code nearest to a linear value.
#[inline]
pub fn srgb_encode_u8(x: f32) -> u8 {
    (srgb_encode(x) * 255.0 + 0.5) as u8
}

/// A colour that tells things apart: linear, bright enough to be seen, chosen by a hash of a number.
pub fn label(number: u32) -> Rgb {
    let band = |i| 0.05 + 0.95 * sqr(to_unit(hash_combine(hash_u32(number), i)));
    Rgb::new(band(0), band(1), band(2))
}

/// How a picture's radiance is scaled before it is shown.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Exposure {
    /// The log-average luminance becomes middle grey, 0.18.
    #[default]
    Auto,
    /// 0.5 over the average luminance, that clamped to 0.1..1: what the first thesis does.
    Thesis,
    /// A factor of 2^EV.
    Ev(f32),
}

impl Exposure {
    /// Bounds of the automatic factor: a picture in which nothing is lit stays dark.
    pub const AUTO_RANGE: (f32, f32) = (1e-6, 1e6);

    /// The factor for a picture of this width, row by row. Pixels that are not finite do not count, nor do black areas in the
    /// average of `Auto`, which looks at the picture from afar: means of blocks, so that noise does not pass for darkness.
    pub fn factor(self, pixels: &[Rgb], width: usize) -> f32 {
        match self {
            Exposure::Ev(ev) => exp2(ev),
            Exposure::Thesis => {
                0.5 / mean(pixels.iter().map(|p| p.luminance())).unwrap_or(1.0).clamp(0.1, 1.0)
            }
            Exposure::Auto => {
                let blocks = block_means(pixels, width);
                let lit = blocks.iter().copied().filter(|y| *y > 0.0);
                let Some(average) = mean(lit.clone()) else { return 1.0 };
                // A thousandth of the mean floors the logarithm, so that near-black areas do not rule.
                let floor = 1e-3 * average;
                let log_average = mean(lit.map(|y| ln(y.max(floor)))).map_or(average, exp);
                (0.18 / log_average).clamp(Self::AUTO_RANGE.0, Self::AUTO_RANGE.1)
            }
        }
    }
}

/// A factor of exposure on its way from the last frame's to `target`, for pictures that follow one another: `share` (0 to 1) of the way
/// in the logarithm, so that getting brighter takes as long as getting darker.
pub fn exposure_eased(previous: f32, target: f32, share: f32) -> f32 {
    if share >= 1.0 { target } else { previous * pow(target / previous, share) }
}

/// The share of the way that a frame of `seconds` goes, so that all but 1/e of it is gone after `time_constant` seconds, at whatever
/// rate frames come. A time constant of 0 goes all the way.
pub fn ease_share(seconds: f32, time_constant: f32) -> f32 {
    if time_constant > 0.0 { 1.0 - exp(-seconds.max(0.0) / time_constant) } else { 1.0 }
}

/// Side of the blocks, pixels, through which automatic exposure sees a picture of this width: about 40 across.
pub fn block_side(width: usize) -> usize {
    (width / 40).max(1)
}

/// Mean luminance of each block of the picture; blocks without a finite pixel are left out.
fn block_means(pixels: &[Rgb], width: usize) -> Vec<f32> {
    let side = block_side(width);
    let columns = width.div_ceil(side);
    let rows: Vec<&[Rgb]> = pixels.chunks(width.max(1)).collect();
    let block = |rows: &[&[Rgb]], column: usize| {
        let part =
            |row: &&[Rgb]| row[(column * side).min(row.len())..((column + 1) * side).min(row.len())].to_vec();
        mean(rows.iter().flat_map(part).map(Rgb::luminance))
    };
    rows.chunks(side).flat_map(|rows| (0..columns).filter_map(move |c| block(rows, c))).collect()
}

/// Mean of the finite values, in double precision; `None` if there are none.
fn mean(values: impl Iterator<Item = f32>) -> Option<f32> {
    let (sum, n) =
        values.filter(|v| v.is_finite()).fold((0.0f64, 0u64), |(s, n), v| (s + f64::from(v), n + 1));
    (n > 0).then(|| (sum / n as f64) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ANALYTIC row 45.
    #[test]
    fn srgb_closed_forms() {
        assert!((srgb_encode(0.5) - 0.7354).abs() < 5e-5);
        assert!((srgb_encode(0.18) - 0.4614).abs() < 5e-5);
        assert!((srgb_decode(128.0 / 255.0) - 0.2159).abs() < 5e-5);
        for i in 0..=255u8 {
            assert_eq!(srgb_encode_u8(srgb_decode_table()[i as usize]), i);
        }
    }

    #[test]
    fn noise_is_not_darkness() {
        let noisy: Vec<Rgb> =
            (0..400 * 300).map(|i| Rgb::splat(if i % 7 == 0 { 7.0 } else { 0.0 })).collect();
        assert!((Exposure::Auto.factor(&noisy, 400) / 0.18 - 1.0).abs() < 0.05);
    }

    #[test]
    fn exposure_puts_the_log_average_at_middle_grey() {
        let picture = [Rgb::splat(1.0), Rgb::splat(4.0), Rgb::BLACK, Rgb::splat(f32::NAN)];
        assert!((Exposure::Auto.factor(&picture, 4) - 0.18 / 2.0).abs() < 1e-6);
        assert_eq!(Exposure::Auto.factor(&[Rgb::BLACK], 1), 1.0);
        assert_eq!(Exposure::Ev(3.0).factor(&picture, 4), 8.0);
        assert_eq!(Exposure::Thesis.factor(&[Rgb::splat(0.25)], 1), 2.0);
        assert_eq!(Exposure::Thesis.factor(&[Rgb::splat(9.0)], 1), 0.5);
        assert_eq!(Exposure::Thesis.factor(&[Rgb::splat(0.001)], 1), 5.0);
    }

    #[test]
    fn exposure_eases_alike_at_every_frame_rate() {
        assert_eq!(exposure_eased(3.0, 7.0, 1.0), 7.0);
        assert!((exposure_eased(1.0, 4.0, 0.5) - 2.0).abs() < 1e-6);
        let after_a_second = |frames: u16| {
            let share = ease_share(1.0 / f32::from(frames), 0.5);
            (0..frames).fold(1.0, |factor, _| exposure_eased(factor, 16.0, share))
        };
        // All but e⁻² of four stops.
        let want = exp2(4.0 * (1.0 - exp(-2.0)));
        assert!([1, 7, 60].iter().all(|n| (after_a_second(*n) / want - 1.0).abs() < 1e-4));
        assert_eq!(ease_share(0.01, 0.0), 1.0);
    }
}
