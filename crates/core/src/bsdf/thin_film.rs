//! Interference in a thin transparent film over a surface (KHR_materials_iridescence).
//!
//! Airy's sum (Airy 1833) over all orders between the two faces of the film, for both polarisations, integrated over the visible spectrum in Fourier
//! space (Belcour and Barla 2017, section 4): order m takes from the spectrum the cosine transform of a band's sensitivity at m
//! times the optical path. The Rec. 709 sensitivities under D65 are fitted by five Gaussians in wavenumber (own fit to the CIE 1931
//! observer and D65 at 1 nm, CIE 2018; transforms within 0.02, rms 0.005), so that each transform is a sum of damped cosines. They are
//! normalised per band: what does not interfere keeps its colour, at any thickness.
//!
//! The base is known by what it reflects without film, S(θ), often Schlick's law. As in the extension its real index n3 comes from
//! S(0); no glTF metal tells its absorption. With T the transmittance of the film between air and n3, and T13 that of air to n3
//! alone, the surface reflects 1 - T (1 - S) / T13, which the extension approximates by Schlick's law for both faces. So a film of
//! thickness 0, or of index 1, gives back S at every angle; where S is Fresnel's law the film is exact; a white mirror stays white.
//! The outside is air.

use super::FilmParams;
use crate::math::{PI, exp, lerp, safe_sqrt, sin_cos, sqr};
use crate::rgb::Spectrum;

/// Wavenumbers of the Gaussians, nm⁻¹.
const WAVENUMBER: [f32; 5] = [1.644_55e-3, 1.763_24e-3, 1.885_64e-3, 2.097_98e-3, 2.208_25e-3];
/// Their standard deviations, nm⁻¹.
const DEVIATION: [f32; 5] = [0.071_31e-3, 0.104_31e-3, 0.080_53e-3, 0.128_46e-3, 0.103_64e-3];
/// Their shares in each band; those of a band sum to 1.
const SHARE: [Spectrum; 5] = [
    Spectrum::new(1.240_21, -0.277_98, 0.014_40),
    Spectrum::new(0.426_38, 0.760_40, -0.115_50),
    Spectrum::new(-0.576_94, 0.504_61, -0.033_85),
    Spectrum::new(-0.364_39, 0.248_65, 0.027_42),
    Spectrum::new(0.274_74, -0.235_68, 1.107_53),
];

/// Orders of interference at most, and the contribution below which they stop. Four are usual, dozens where thin films meet grazing light.
const ORDERS: u32 = 64;
const NEGLIGIBLE: f32 = 1e-4;

/// Largest root of the reflectance of a base at normal incidence: n3 is infinite at 1.
const MAX_AMPLITUDE: f32 = 0.999;

/// A film over a base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinFilm {
    factor: f32,
    ior: f32,
    /// Twice the thickness, nm.
    path_nm: f32,
    /// Index of the base, n3.
    base: Spectrum,
}

impl ThinFilm {
    /// The film over a base that reflects `f0` at normal incidence. `None` where the film does nothing: no share, no thickness, the
    /// index of air or a smaller one.
    #[inline]
    pub fn new(params: &FilmParams, f0: Spectrum) -> Option<Self> {
        let &FilmParams { factor, ior, thickness_nm } = params;
        // Written so that NaN counts as no film.
        let seen = factor > 0.0 && ior > 1.0 && thickness_nm > 0.0;
        seen.then(|| ThinFilm {
            factor: factor.min(1.0),
            ior: ior.min(100.0),
            // Where interference has long averaged out, more thickness changes nothing.
            path_nm: 2.0 * thickness_nm.min(1e5),
            base: f0.map(|f0| {
                let r = safe_sqrt(f0).min(MAX_AMPLITUDE);
                (1.0 + r) / (1.0 - r)
            }),
        })
    }

    /// Reflectance of the surface with the film, each band in [0, 1]. `plain` is its reflectance without, in [0, 1], at the same
    /// angle; `cos` that of the angle in the air outside.
    // Kept out of the way of the surfaces without film.
    #[inline(never)]
    pub fn reflectance(&self, plain: Spectrum, cos: f32) -> Spectrum {
        let passed = self.passed(cos.clamp(1e-6, 1.0));
        let film = |plain: f32, passed: f32| {
            lerp(plain, (1.0 - (1.0 - plain) * passed).clamp(0.0, 1.0), self.factor)
        };
        Spectrum::new(film(plain.r, passed.r), film(plain.g, passed.g), film(plain.b, passed.b))
    }

    /// T / T13, with both polarisations summed in each; Fresnel's amplitudes after Born and Wolf 1999, 1.5.2.
    fn passed(&self, cos1: f32) -> Spectrum {
        let n2 = self.ior;
        // Snell's law; n² - 1 is factored so that indices close to 1 lose no digits at grazing angles.
        let refracted = |n: f32| ((n - 1.0) * (n + 1.0) + cos1 * cos1).sqrt() / n;
        let cos2 = refracted(n2);
        let cos3 = self.base.map(refracted);
        let transforms = Transforms::new(self.path_nm * n2 * cos2);
        let (mut film, mut alone) = (Spectrum::BLACK, Spectrum::BLACK);
        // Admittances of the three sides for each polarisation: an amplitude is (a - b) / (a + b).
        let perpendicular = (cos1, n2 * cos2, self.base * cos3);
        let parallel = (1.0 / cos1, n2 / cos2, self.base * cos3.map(|c| 1.0 / c));
        for (y1, y2, y3) in [perpendicular, parallel] {
            let (r12, t12) = amplitude(y1, y2);
            let p = y3.map(|y3| -r12 * amplitude(y2, y3).0);
            let direct = y3.map(|y3| {
                let t23 = amplitude(y2, y3).1;
                // 1 - p² without cancellation.
                t12 * t23 / (t12 + t23 - t12 * t23)
            });
            film += direct * transforms.sum(p, direct.max_component());
            alone += y3.map(|y3| amplitude(y1, y3).1);
        }
        film * alone.map(|t| 1.0 / t)
    }
}

/// Nodes μ = √x and weights of the mean over the cosine-weighted hemisphere, 2 ∫ f(μ) μ dμ = ∫ f(√x) dx: Gauss-Legendre on
/// [0, 1], six points (Abramowitz and Stegun 1964, table 25.4).
pub const AVERAGE: [(f32, f32); 6] = [
    (0.183_753_2, 0.085_662_246),
    (0.411_576_6, 0.180_380_79),
    (0.617_001_1, 0.233_956_97),
    (0.786_962_3, 0.233_956_97),
    (0.911_375_2, 0.180_380_79),
    (0.982_972_4, 0.085_662_246),
];

/// Mean of a reflectance over the cosine-weighted hemisphere.
pub fn average(reflectance: impl Fn(f32) -> Spectrum) -> Spectrum {
    AVERAGE.iter().fold(Spectrum::BLACK, |sum, &(cos, weight)| sum + reflectance(cos) * weight)
}

/// Reflected amplitude and transmittance of one face between admittances `a` and `b`, both above 0.
#[inline]
fn amplitude(a: f32, b: f32) -> (f32, f32) {
    let sum = a + b;
    ((a - b) / sum, 4.0 * a * b / sqr(sum))
}

/// The cosine transforms of the Gaussians at multiples of one optical path.
struct Transforms {
    /// Cosine at the path itself.
    cos: [f32; 5],
    /// Damping at the path itself.
    damping: [f32; 5],
}

impl Transforms {
    fn new(path_nm: f32) -> Self {
        let at = |k: usize| sin_cos(2.0 * PI * (path_nm * WAVENUMBER[k])).1;
        let damping = |k: usize| {
            let x = PI * DEVIATION[k] * path_nm;
            exp(-2.0 * x * x)
        };
        Transforms { cos: core::array::from_fn(at), damping: core::array::from_fn(damping) }
    }

    /// 1 + 2 Σ pᵐ Sₘ; `scale` is what the sum will be multiplied by, which tells when to stop.
    fn sum(&self, p: Spectrum, scale: f32) -> Spectrum {
        // cos mφ by its recurrence; damping^(m²) by its: the ratio of neighbours grows by damping² each step.
        let (mut before, mut cos) = ([1.0f32; 5], self.cos);
        let (mut damping, mut ratio) = (self.damping, self.damping);
        let mut power = p * 2.0;
        let mut sum = Spectrum::WHITE;
        for _ in 0..ORDERS {
            let mut transform = Spectrum::BLACK;
            let mut most = 0.0f32;
            for k in 0..5 {
                transform += SHARE[k] * (cos[k] * damping[k]);
                most = most.max(damping[k]);
                (before[k], cos[k]) = (cos[k], 2.0 * self.cos[k] * cos[k] - before[k]);
                ratio[k] *= self.damping[k] * self.damping[k];
                damping[k] *= ratio[k];
            }
            sum += power * transform;
            power *= p;
            if scale * most * power.map(f32::abs).max_component() < NEGLIGIBLE {
                break;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::{dielectric, f0_from_ior, schlick};

    fn film(ior: f32, thickness_nm: f32, f0: Spectrum) -> ThinFilm {
        ThinFilm::new(&FilmParams { factor: 1.0, ior, thickness_nm }, f0).expect("a film")
    }
    fn cos(deg: f32) -> f32 {
        f64::from(deg).to_radians().cos() as f32
    }
    fn worst(a: Spectrum, b: Spectrum) -> f32 {
        (a - b).map(f32::abs).max_component()
    }

    /// Against Airy's formula for each polarisation summed over wavelengths, 360 to 780 nm at 1 nm, with the CIE 1931 observer, D65 and the
    /// Rec. 709 matrix, computed apart from this code: film index and thickness, index of the base, angle.
    #[test]
    fn matches_the_sum_over_wavelengths() {
        let rows: [(f32, f32, f32, f32, [f64; 3]); 12] = [
            (1.33, 300.0, 1.50, 0.0, [0.0226, 0.0063, 0.0265]),
            (1.33, 300.0, 1.50, 60.0, [0.0919, 0.0835, 0.0461]),
            (1.33, 300.0, 1.50, 80.0, [0.3740, 0.3889, 0.3641]),
            (1.80, 400.0, 1.50, 0.0, [0.1337, 0.1050, 0.0704]),
            (1.80, 400.0, 1.50, 45.0, [0.0579, 0.1429, 0.0637]),
            (1.80, 400.0, 1.50, 75.0, [0.2350, 0.3005, 0.3111]),
            (2.40, 150.0, 20.00, 0.0, [0.8941, 0.5622, 0.4284]),
            (2.40, 150.0, 20.00, 60.0, [0.8058, 0.7293, 0.3729]),
            (1.80, 400.0, 6.96, 0.0, [0.1797, 0.3105, 0.4679]),
            (1.80, 400.0, 6.96, 30.0, [0.3898, 0.2140, 0.5426]),
            (1.80, 400.0, 6.96, 70.0, [0.5650, 0.4383, 0.4335]),
            (1.40, 1000.0, 6.96, 20.0, [0.3710, 0.4813, 0.4765]),
        ];
        for (ior, thickness, n3, deg, want) in rows {
            let base = Spectrum::splat(dielectric(cos(deg), n3));
            let got = film(ior, thickness, Spectrum::splat(f0_from_ior(n3))).reflectance(base, cos(deg));
            let want = Spectrum::from_array(want.map(|v| v as f32));
            assert!(worst(got, want) < 2e-3, "{ior} {thickness} {n3} {deg}: {got:?} {want:?}");
        }
    }

    #[test]
    fn no_film_is_the_plain_surface() {
        let f0 = Spectrum::new(0.04, 0.5, 0.95);
        for deg in [0.0, 40.0, 70.0, 89.0] {
            let plain = schlick(f0, 1.0, cos(deg));
            for nearly_none in [film(1.8, 1e-3, f0), film(1.000_01, 400.0, f0)] {
                let got = nearly_none.reflectance(plain, cos(deg));
                assert!(worst(got, plain) < 1e-4, "{deg}: {got:?} {plain:?}");
            }
        }
        let params = FilmParams { factor: 1.0, ior: 1.5, thickness_nm: 300.0 };
        for none in [
            FilmParams { factor: 0.0, ..params },
            FilmParams { thickness_nm: 0.0, ..params },
            FilmParams { ior: 1.0, ..params },
            FilmParams { ior: f32::NAN, ..params },
        ] {
            assert_eq!(ThinFilm::new(&none, f0), None);
        }
        // The film grows out of nothing without a step.
        let start = film(1.8, 1.0, f0).reflectance(f0, 1.0);
        assert!(worst(start, f0) < 2e-3 && worst(start, f0) > 0.0, "{start:?}");
    }

    #[test]
    fn a_film_of_the_same_index_is_not_seen() {
        for deg in [0.0, 50.0, 80.0] {
            let base = Spectrum::splat(dielectric(cos(deg), 1.5));
            let got = film(1.5, 350.0, Spectrum::splat(f0_from_ior(1.5))).reflectance(base, cos(deg));
            assert!(worst(got, base) < 1e-5, "{deg}: {got:?} {base:?}");
        }
    }

    /// A white mirror stays white, whatever the film; and the factor mixes.
    #[test]
    fn white_stays_white() {
        for (ior, thickness) in [(1.33, 300.0), (2.4, 550.0)] {
            for deg in [0.0, 60.0, 89.9] {
                let got = film(ior, thickness, Spectrum::WHITE).reflectance(Spectrum::WHITE, cos(deg));
                assert!(worst(got, Spectrum::WHITE) < 1e-6, "{got:?}");
            }
        }
        let f0 = Spectrum::splat(0.5);
        let whole = film(1.8, 400.0, f0);
        let half = ThinFilm { factor: 0.5, ..whole };
        let want = (whole.reflectance(f0, 1.0) + f0) * 0.5;
        assert!(worst(half.reflectance(f0, 1.0), want) < 1e-6);
    }

    /// Thick films do not interfere: incoherent sum of both faces, (R12 + R23 - 2 R12 R23) / (1 - R12 R23), at normal incidence.
    #[test]
    fn thick_films_lose_their_colour() {
        let (a, b) = (f0_from_ior(1.5), f0_from_ior(2.5 / 1.5));
        let want = Spectrum::splat((a + b - 2.0 * a * b) / (1.0 - a * b));
        let f0 = Spectrum::splat(f0_from_ior(2.5));
        let got = film(1.5, 30_000.0, f0).reflectance(f0, 1.0);
        assert!(worst(got, want) < 1e-5, "{got:?} {want:?}");
    }

    #[test]
    fn always_between_0_and_1() {
        let f0 = Spectrum::new(0.0, 0.4, 0.9999);
        for ior in [1.01, 1.33, 2.4, 90.0] {
            for thickness in [0.1, 60.0, 300.0, 1_500.0, 1e9] {
                for c in [0.0, 1e-6, 1e-3, 0.3, 0.9, 1.0] {
                    let got = film(ior, thickness, f0).reflectance(schlick(f0, 1.0, c), c);
                    for v in got.to_array() {
                        assert!((0.0..=1.0).contains(&v), "{ior} {thickness} {c}: {got:?}");
                    }
                }
            }
        }
    }
}
