//! Tone curves: from exposed linear radiance to what a display is sent, each band 0 to 1. Where a curve ends in linear
//! values of the display, the sRGB curve follows. Pure functions of one pixel, so that a shader can have the same.

use crate::color::srgb_encode;
use crate::math::{ln, pow};
use crate::rgb::Rgb;

/// How radiance becomes the values of a display. Shaders number the curves in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum ToneCurve {
    /// Clipped at 1, then the power 1/2.2: what the theses do.
    Linear,
    /// Clipped at 1, then the sRGB curve.
    #[default]
    Srgb,
    /// Reinhard's L / (1 + L) of luminance.
    Reinhard,
    /// The look of ACES, by Hill's fit.
    Aces,
    /// Sobotka's AgX, by Wrensch's fit.
    Agx,
    /// Khronos PBR Neutral: base colours stay as they are.
    Neutral,
}

/// Brighter than this looks no brighter: at a millionfold white every curve has long arrived at its end.
const BRIGHTEST: f32 = 1e6;

impl ToneCurve {
    /// All of them.
    pub const ALL: [ToneCurve; 6] = [
        ToneCurve::Linear,
        ToneCurve::Srgb,
        ToneCurve::Reinhard,
        ToneCurve::Aces,
        ToneCurve::Agx,
        ToneCurve::Neutral,
    ];

    /// Its name, as on the command line.
    pub fn name(self) -> &'static str {
        match self {
            ToneCurve::Linear => "linear",
            ToneCurve::Srgb => "srgb",
            ToneCurve::Reinhard => "reinhard",
            ToneCurve::Aces => "aces",
            ToneCurve::Agx => "agx",
            ToneCurve::Neutral => "neutral",
        }
    }

    /// What a display is sent for an exposed colour, 0 to 1. Bands that are negative or no numbers count as 0.
    pub fn display(self, exposed: Rgb) -> Rgb {
        // `max` takes the 0 where the other one is NaN.
        let color = exposed.max(0.0).min(BRIGHTEST);
        let encode = |c: Rgb| c.map(srgb_encode);
        match self {
            ToneCurve::Linear => color.map(|x| pow(x.min(1.0), 1.0 / 2.2)),
            ToneCurve::Srgb => encode(color),
            ToneCurve::Reinhard => encode(reinhard(color)),
            ToneCurve::Aces => encode(aces(color)),
            ToneCurve::Agx => agx(color),
            ToneCurve::Neutral => encode(neutral(color)),
        }
    }
}

/// Rows of a 3x3 matrix times a colour.
fn transformed(rows: &[[f32; 3]; 3], c: Rgb) -> Rgb {
    Rgb::from_array(rows.map(|[r, g, b]| r * c.r + g * c.g + b * c.b))
}

/// Luminance L becomes L / (1 + L), hue and saturation stay (Reinhard et al. 2002, eq. 3, without their key: exposure has
/// done that). Saturated colours may end above 1 in a band and are clipped there.
pub fn reinhard(c: Rgb) -> Rgb {
    c * (1.0 / (1.0 + c.luminance()))
}

/// From linear Rec. 709 to AP1, with the desaturation of ACES' reference rendering transform (Hill 2016).
const ACES_IN: [[f32; 3]; 3] =
    [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]];
/// The way back, with the desaturation of the output transform (Hill 2016).
const ACES_OUT: [[f32; 3]; 3] =
    [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]];

/// Reference rendering transform and output transform for sRGB of ACES 1.0 (Hill 2016, a rational fit), linear. Its
/// white of 1 comes out at 0.62; no factor is put before it.
pub fn aces(c: Rgb) -> Rgb {
    let fit = |v: f32| {
        let above = v * (v + 0.024_578_6) - 0.000_090_537;
        let below = v * (0.983_729 * v + 0.432_951_0) + 0.238_081;
        above / below
    };
    transformed(&ACES_OUT, transformed(&ACES_IN, c).map(fit)).map(|x| x.clamp(0.0, 1.0))
}

/// Rec. 709 drawn in towards grey (Sobotka 2022, as printed by Wrensch 2023).
const AGX_IN: [[f32; 3]; 3] = [
    [0.842479062253094, 0.0784335999999992, 0.0792237451477643],
    [0.0423282422610123, 0.878468636469772, 0.0791661274605434],
    [0.0423756549057051, 0.0784336, 0.879142973793104],
];
/// The inverse of [`AGX_IN`] (Wrensch 2023).
const AGX_OUT: [[f32; 3]; 3] = [
    [1.19687900512017, -0.0980208811401368, -0.0990297440797205],
    [-0.0528968517574562, 1.15190312990417, -0.0989611768448433],
    [-0.0529716355144438, -0.0980434501171241, 1.15107367264116],
];
/// Stops about 1 between which AgX tells brightness apart: 10 below and 6.5 above middle grey.
const AGX_STOPS: [f32; 2] = [-12.47393, 4.026069];
/// The contrast curve of AgX over its stops as a polynomial, constant first (Wrensch 2023).
const AGX_CONTRAST: [f32; 7] = [-0.00232, 0.1191, 0.4298, -6.868, 31.96, -40.14, 15.5];

/// AgX with its default look: primaries drawn in, logarithm, contrast, primaries drawn out. What comes out is already what
/// a display of gamma 2.2 is sent.
pub fn agx(c: Rgb) -> Rgb {
    let [low, high] = AGX_STOPS;
    let contrast = |x: f32| {
        // log2; black is below the lowest stop whatever its logarithm.
        let stops = ln(x.max(1e-10)) * core::f32::consts::LOG2_E;
        let t = (stops.clamp(low, high) - low) / (high - low);
        AGX_CONTRAST.iter().rev().fold(0.0, |sum, a| sum * t + a)
    };
    transformed(&AGX_OUT, transformed(&AGX_IN, c).map(contrast)).map(|x| x.clamp(0.0, 1.0))
}

/// Reflection that glass and plastic show head on; taken away, so that a base colour comes out as itself.
const NEUTRAL_F90: f32 = 0.04;
/// Where highlights begin to be compressed.
const NEUTRAL_START: f32 = 0.8 - NEUTRAL_F90;
/// How fast compressed highlights lose their colour.
const NEUTRAL_DESATURATION: f32 = 0.15;

/// Khronos PBR Neutral (Khronos 2024), linear: colours up to 0.8 come out 0.04 lower in each band, less the
/// reflection of a dielectric; brighter ones are compressed below 1 and turn white slowly.
pub fn neutral(c: Rgb) -> Rgb {
    let least = c.r.min(c.g).min(c.b);
    // Meets the constant with the same slope at 0.08.
    let offset =
        if least < 2.0 * NEUTRAL_F90 { least - least * least / (4.0 * NEUTRAL_F90) } else { NEUTRAL_F90 };
    let c = c - Rgb::splat(offset);
    let peak = c.max_component();
    if peak < NEUTRAL_START {
        return c;
    }
    let room = 1.0 - NEUTRAL_START;
    let compressed = 1.0 - room * room / (peak + room - NEUTRAL_START);
    let white = 1.0 - 1.0 / (NEUTRAL_DESATURATION * (peak - compressed) + 1.0);
    (c * (compressed / peak)).lerp(Rgb::splat(compressed), white)
}

/// Darkening towards the corners: the factor on linear radiance at a point `[x, y]`, measured from the centre of the picture
/// in halves of its diagonal, so that corners are at distance 1. `strength` 0 does nothing, 1 makes the corners black; in
/// between the light falls with the square of the distance.
pub fn vignette(strength: f32, [x, y]: [f32; 2]) -> f32 {
    (1.0 - strength * (x * x + y * y)).max(0.0)
}

/// Most aberration, per cent, either way.
pub const MAX_ABERRATION: f32 = 50.0;

/// One over the factor by which each band is enlarged about the centre of the picture: red by 1 + a, blue by 1 - a, green stays.
/// `aberration` is in per cent of the distance from the centre. (A quotient at each pixel would not be the same on every GPU.)
pub fn aberration_shrinks(aberration: f32) -> [f32; 3] {
    let a = 0.01 * aberration;
    [1.0 / (1.0 + a), 1.0, 1.0 / (1.0 - a)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(got: Rgb, want: [f32; 3]) -> bool {
        got.to_array().iter().zip(want).all(|(g, w)| (g - w).abs() < 2e-5)
    }

    /// Values by an evaluation of the published formulas in double precision.
    #[test]
    fn values_at_named_points() {
        let colored = Rgb::new(4.0, 0.5, 0.1);
        let greys = [0.18, 1.0, 16.0].map(Rgb::splat);
        let rows = [
            (ToneCurve::Linear, [0.45866, 1.0, 1.0], [1.0, 0.72974, 0.35112]),
            (ToneCurve::Srgb, [0.46136, 1.0, 1.0], [1.0, 0.73536, 0.34919]),
            (ToneCurve::Reinhard, [0.42695, 0.73536, 0.97368], [1.0, 0.51241, 0.23518]),
            (ToneCurve::Aces, [0.35846, 0.80895, 0.99556], [1.0, 0.73135, 0.42862]),
            (ToneCurve::Neutral, [0.41002, 0.94009, 0.99836], [0.99260, 0.65186, 0.59593]),
        ];
        for (curve, expected, hue) in rows {
            for (grey, want) in greys.into_iter().zip(expected) {
                assert!(
                    close(curve.display(grey), [want; 3]),
                    "{curve:?} {grey:?} {:?}",
                    curve.display(grey)
                );
            }
            assert!(close(curve.display(colored), hue), "{curve:?} {:?}", curve.display(colored));
            assert_eq!(curve.display(Rgb::BLACK), Rgb::BLACK);
        }
        let agx = |c| ToneCurve::Agx.display(c);
        assert!(close(agx(greys[0]), [0.49668, 0.49674, 0.49675]), "{:?}", agx(greys[0]));
        assert!(close(agx(greys[1]), [0.78675, 0.78688, 0.78689]), "{:?}", agx(greys[1]));
        assert!(close(agx(greys[2]), [0.99761, 0.99782, 0.99783]), "{:?}", agx(greys[2]));
        assert!(close(agx(colored), [0.97656, 0.71401, 0.55655]), "{:?}", agx(colored));
        assert_eq!(agx(Rgb::BLACK), Rgb::BLACK);
    }

    /// By hand: 0.18 / 1.18; 1 - 0.24² / (0.96 + 0.24 - 0.76) = 1 - 0.0576 / 0.44.
    #[test]
    fn closed_forms() {
        assert!((reinhard(Rgb::splat(0.18)).g - 0.152_542_4).abs() < 1e-6);
        assert!((reinhard(Rgb::new(0.0, 1.0, 0.0)).g - 1.0 / 1.7152).abs() < 1e-6);
        assert!((neutral(Rgb::WHITE).r - 0.869_090_9).abs() < 1e-6);
        assert!((aces(Rgb::WHITE).r - 0.619_115).abs() < 2e-5);
    }

    /// What the specification is for: a base colour up to 0.8 - 0.04 under white light, with the 0.04 that a dielectric
    /// reflects on top, comes out as that base colour.
    #[test]
    fn neutral_keeps_base_colours() {
        for base in [[0.759, 0.759, 0.759], [0.7, 0.1, 0.05], [0.2, 0.4, 0.75], [0.05, 0.75, 0.3]] {
            let shown = Rgb::from_array(base) + Rgb::splat(NEUTRAL_F90);
            assert!(close(neutral(shown), base), "{base:?} {:?}", neutral(shown));
        }
        // Brighter than that it must give way.
        assert!(!close(neutral(Rgb::splat(0.95)), [0.91; 3]));
        // Both pieces of the offset meet.
        let below = neutral(Rgb::new(0.079_999_9, 0.5, 0.5));
        assert!(close(below, [0.04, 0.46, 0.46]), "{below:?}");
    }

    #[test]
    fn greys_rise_stay_grey_and_stay_inside() {
        for curve in ToneCurve::ALL {
            let mut before = -1.0;
            for i in 0..4000 {
                // 2^-15 to 2^25, which lies beyond the brightest.
                let y = curve.display(Rgb::splat(crate::math::exp2(0.01 * i as f32 - 15.0)));
                assert!(y.g >= before - 1e-6, "{curve:?} falls at {i}");
                assert!(y.to_array().iter().all(|v| (0.0..=1.0).contains(v)), "{curve:?} {y:?}");
                assert!((y.r - y.b).abs() < 3e-4, "{curve:?} {y:?}");
                before = y.g;
            }
            assert!(before > 0.995, "{curve:?} ends at {before}");
        }
    }

    #[test]
    fn no_number_is_no_number() {
        let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 0.0, 1e-40, 1.0, f32::MAX];
        for curve in ToneCurve::ALL {
            for r in odd {
                for g in odd {
                    let y = curve.display(Rgb::new(r, g, 0.3));
                    assert!(y.to_array().iter().all(|v| (0.0..=1.0).contains(v)), "{curve:?} {r} {g}: {y:?}");
                }
            }
            assert_eq!(curve.display(Rgb::splat(f32::NAN)), curve.display(Rgb::BLACK));
            assert!(curve.display(Rgb::splat(f32::INFINITY)).g > 0.995);
        }
    }

    #[test]
    fn agx_comes_back_from_its_primaries() {
        for c in [Rgb::new(1.0, 0.0, 0.0), Rgb::new(0.2, 0.5, 0.9)] {
            let back = transformed(&AGX_OUT, transformed(&AGX_IN, c));
            assert!((back - c).to_array().iter().all(|d| d.abs() < 2e-4), "{back:?}");
        }
    }

    #[test]
    fn vignette_and_aberration_have_units() {
        assert_eq!(vignette(0.0, [0.6, 0.8]), 1.0);
        assert!((vignette(0.5, [0.6, 0.8]) - 0.5).abs() < 1e-6, "a corner keeps 1 - strength");
        assert!((vignette(0.5, [0.3, 0.4]) - 0.875).abs() < 1e-6, "half way a quarter of the loss");
        assert_eq!(vignette(1.0, [0.7, 0.8]), 0.0, "no negative light");
        assert_eq!(aberration_shrinks(0.0), [1.0; 3]);
        let [r, g, b] = aberration_shrinks(2.0);
        assert!((r * 1.02 - 1.0).abs() < 1e-6 && g == 1.0 && (b * 0.98 - 1.0).abs() < 1e-6);
    }
}
