//! Fresnel reflectance of smooth interfaces, unpolarised, and Snell's law.
//!
//! `eta` is always the index on the far side over the index on the side of the ray. Sources: Born and Wolf 1999, 1.5.2 and
//! 14.2; Walter et al. 2007, eq. 22 (the same law without the refracted angle); Schlick 1994. Polarisation
//! counts in [`crate::bsdf::thin_film`] only.

use crate::math::{Vec3, safe_sqrt, sqr};
use crate::rgb::Spectrum;

/// Mean of (1 - cos θ)⁵ over the cosine-weighted hemisphere, 2 ∫ (1 - μ)⁵ μ dμ.
pub const SCHLICK_AVERAGE: f32 = 1.0 / 21.0;

/// Reflectance of a dielectric interface and the cosine of the refracted ray.
///
/// `cos_i` in [0, 1], `eta` > 0. Total reflection gives `(1, 0)`; equal indices give `(0, cos_i)`.
#[inline]
pub fn dielectric_refracted(cos_i: f32, eta: f32) -> (f32, f32) {
    if eta == 1.0 {
        return (0.0, cos_i);
    }
    // g = η cos θt, with η² - 1 factored so that indices close to each other lose no digits at grazing angles.
    let g2 = (eta - 1.0) * (eta + 1.0) + cos_i * cos_i;
    if g2 <= 0.0 {
        return (1.0, 0.0);
    }
    let g = g2.sqrt();
    let r_s = (cos_i - g) / (cos_i + g);
    let c_p = eta * eta * cos_i;
    let r_p = (c_p - g) / (c_p + g);
    (0.5 * (r_s * r_s + r_p * r_p), (g / eta).min(1.0))
}

/// Reflectance of a dielectric interface; see [`dielectric_refracted`].
#[inline]
pub fn dielectric(cos_i: f32, eta: f32) -> f32 {
    dielectric_refracted(cos_i, eta).0
}

/// The refracted direction of `wo` at an interface with normal `m`, given the cosine from [`dielectric_refracted`].
/// `wo · m > 0`; the result is unit and on the other side.
#[inline]
pub fn refract(wo: Vec3, m: Vec3, cos_t: f32, eta: f32) -> Vec3 {
    let inv = 1.0 / eta;
    m * (wo.dot(m) * inv - cos_t) - wo * inv
}

/// Reflectance of a conductor with index `eta` + i `k` (both relative to the medium of the ray), for one wavelength.
#[inline]
pub fn conductor(cos_i: f32, eta: f32, k: f32) -> f32 {
    let c2 = cos_i * cos_i;
    let s2 = 1.0 - c2;
    let (eta2, k2) = (eta * eta, k * k);
    // a² + b² and a of the complex refracted component a + ib, squared length √(t0² + 4η²k²).
    let t0 = eta2 - k2 - s2;
    let a2_b2 = (t0 * t0 + 4.0 * eta2 * k2).sqrt();
    let two_a_c = 2.0 * safe_sqrt(0.5 * (a2_b2 + t0)) * cos_i;
    let r_s = (a2_b2 + c2 - two_a_c) / (a2_b2 + c2 + two_a_c);
    let (p, q) = (c2 * a2_b2 + s2 * s2, two_a_c * s2);
    0.5 * (r_s + r_s * (p - q) / (p + q))
}

/// (1 - cos θ)⁵, the weight of the grazing reflectance in Schlick's approximation.
#[inline]
pub fn schlick_weight(cos_i: f32) -> f32 {
    let x = (1.0 - cos_i).clamp(0.0, 1.0);
    let x2 = x * x;
    x2 * x2 * x
}

/// Schlick's approximation between the reflectance at normal incidence and at grazing incidence.
#[inline]
pub fn schlick(f0: Spectrum, f90: f32, cos_i: f32) -> Spectrum {
    let s = schlick_weight(cos_i);
    f0 * (1.0 - s) + Spectrum::splat(f90 * s)
}

/// Reflectance at normal incidence of an interface with relative index `ior`. An index of 0 stands for an infinite one
/// (KHR_materials_ior) and gives 1.
#[inline]
pub fn f0_from_ior(ior: f32) -> f32 {
    sqr((ior - 1.0) / (ior + 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cos_deg(deg: f64) -> f32 {
        deg.to_radians().cos() as f32
    }
    fn close(got: f32, want: f64) {
        assert!((f64::from(got) - want).abs() < 5.1e-5, "got {got}, want {want}");
    }

    #[test]
    fn normal_incidence() {
        for (ior, f0) in [(1.33, 0.0201), (1.5, 0.0400), (2.417, 0.1720)] {
            close(f0_from_ior(ior), f0);
            close(dielectric(1.0, ior), f0);
            close(dielectric(1.0, 1.0 / ior), f0);
        }
        assert_eq!(f0_from_ior(0.0), 1.0);
    }

    #[test]
    fn unpolarised_dielectric_at_angles() {
        for (deg, f) in [(30.0, 0.0415), (45.0, 0.0502), (60.0, 0.0892), (75.0, 0.2531), (85.0, 0.6128)] {
            close(dielectric(cos_deg(deg), 1.5), f);
        }
        // The grazing end: F → 1, and the interface is the same one seen from inside.
        assert_eq!(dielectric(0.0, 1.5), 1.0);
        // (From inside the curve is vertical at the critical angle, so the last cosines are left to the limit above.)
        for i in 10..100 {
            let c = i as f32 / 100.0;
            let (f, cos_t) = dielectric_refracted(c, 1.5);
            assert!((f - dielectric(cos_t, 1.0 / 1.5)).abs() < 2e-5, "{c}");
        }
    }

    #[test]
    fn brewster_and_critical_angle() {
        // At Brewster's angle the parallel part vanishes: what is left is half the perpendicular one, ((n²-1)/(n²+1))²/2.
        close(dielectric(cos_deg(56.3099), 1.5), 0.5 * (1.25f64 / 3.25).powi(2));
        let inside = 1.0 / 1.5;
        assert!(dielectric(cos_deg(41.80), inside) < 1.0);
        assert_eq!(dielectric(cos_deg(41.82), inside), 1.0);
    }

    #[test]
    fn snell() {
        for (deg, want) in [(45.0, 28.1255), (60.0, 35.2644)] {
            let (_, cos_t) = dielectric_refracted(cos_deg(deg), 1.5);
            assert!((f64::from(cos_t).acos().to_degrees() - want).abs() < 1e-3);
            let wo = Vec3::new((1.0 - sqr(cos_deg(deg))).sqrt(), 0.0, cos_deg(deg));
            let wi = refract(wo, Vec3::Z, cos_t, 1.5);
            assert!((wi.length() - 1.0).abs() < 1e-6 && (wi.z + cos_t).abs() < 1e-6);
            assert!((wi.x * 1.5 + wo.x).abs() < 1e-6, "tangential part over the index is kept");
        }
    }

    #[test]
    fn conductor_at_angles() {
        for (deg, f) in [(0.0, 0.9234), (45.0, 0.9213), (60.0, 0.9184), (85.0, 0.9636)] {
            close(conductor(cos_deg(deg), 0.2, 3.0), f);
        }
        // Without absorption it is the dielectric.
        for c in [0.1, 0.5, 1.0] {
            close(conductor(c, 1.5, 0.0), f64::from(dielectric(c, 1.5)));
        }
    }

    #[test]
    fn equal_indices_do_not_reflect() {
        for c in [0.0, 1e-30, 1e-4, 0.5, 1.0] {
            assert_eq!(dielectric_refracted(c, 1.0), (0.0, c));
        }
    }

    #[test]
    fn schlick_ends_and_average() {
        let f0 = Spectrum::new(0.1, 0.5, 0.9);
        assert_eq!(schlick(f0, 0.7, 1.0), f0);
        assert_eq!(schlick(f0, 0.7, 0.0), Spectrum::splat(0.7));
        let n = 10_000;
        let mean: f64 = (0..n)
            .map(|i| (f64::from(i) + 0.5) / f64::from(n))
            .map(|mu| 2.0 * mu * f64::from(schlick_weight(mu as f32)) / f64::from(n))
            .sum();
        assert!((mean - f64::from(SCHLICK_AVERAGE)).abs() < 1e-6);
    }
}
