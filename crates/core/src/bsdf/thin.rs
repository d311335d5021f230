//! A thin wall of clear or tinted dielectric: a parallel slab whose thickness is not seen (KHR_materials_transmission without volume).
//!
//! Exact Fresnel at both interfaces and all orders of internal reflection, summed as a geometric series (Stokes 1862), with
//! a = base colour lost on each pass: T = (1-F)² a / (1 - F²a²), R = F + F (1-F)² a² / (1 - F²a²). Clear, that is (1-F)/(1+F) and
//! 2F/(1+F). What passes goes straight on.
//!
//! A thin film lies on both faces and replaces F, band by band ([`super::thin_film`]).
//!
//! Rough: a microfacet reflection lobe with reflectance R and, as glTF has it, the same lobe mirrored to the other side with T, plus the light of
//! multiple scattering (Kulla and Conty 2017) split between the two sides as R : T at a typical angle. Reciprocal; 1 in the white furnace.

use super::albedo::Directional;
use super::compensation::{Compensation, Rough, multiple_scattering};
use super::thin_film::ThinFilm;
use super::{BsdfSample, Lobe};
use crate::fresnel::dielectric;
use crate::math::{ONE_MINUS_EPSILON, Vec3};
use crate::microfacet::reflect;
use crate::rgb::Spectrum;

/// Cosine at which multiply scattered light is split between the two sides: the mean over the cosine-weighted hemisphere.
const TYPICAL_COS: f32 = 2.0 / 3.0;

/// What a slab reflects and transmits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    /// Back to the side of the ray.
    pub reflected: Spectrum,
    /// To the other side.
    pub transmitted: Spectrum,
}

/// A thin wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thin {
    face: Face,
    tint: Spectrum,
    rough: Option<RoughThin>,
}

/// One of the two faces of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Face {
    ior: f32,
    film: Option<ThinFilm>,
}

impl Face {
    #[inline]
    fn reflectance(&self, cos: f32) -> Spectrum {
        let plain = Spectrum::splat(dielectric(cos, self.ior));
        self.film.map_or(plain, |film| film.reflectance(plain, cos))
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct RoughThin {
    surface: Rough,
    compensation: Compensation,
    /// Multiply scattered light, by side.
    multiple: Slab,
    /// The share of single scattering at a typical angle, mean over the bands.
    single_mean: f32,
}

impl Thin {
    /// `ior` > 0 relative to the outside; `tint` in [0, 1] per pass.
    #[inline]
    pub fn new(ior: f32, film: Option<ThinFilm>, tint: Spectrum, rough: Option<Rough>) -> Self {
        let face = Face { ior, film };
        let rough = rough.map(|surface| {
            let typical = slab(face.reflectance(TYPICAL_COS), tint);
            let kept = typical.reflected + typical.transmitted;
            let f_ms = multiple_scattering(kept, surface.albedo.average().deficit);
            // Black stays black: R and T over their sum, without dividing zero by zero.
            let share = |part: Spectrum| f_ms * part / kept.max(1e-9);
            RoughThin {
                surface,
                compensation: Compensation::new(&surface.albedo),
                multiple: Slab {
                    reflected: share(typical.reflected),
                    transmitted: share(typical.transmitted),
                },
                single_mean: kept.average(),
            }
        });
        Thin { face, tint, rough }
    }

    #[inline]
    fn slab(&self, cos: f32) -> Slab {
        slab(self.face.reflectance(cos), self.tint)
    }

    /// True when it scatters by a density rather than into two directions.
    #[inline]
    pub fn is_smooth_lobe(&self) -> bool {
        self.rough.is_some()
    }

    /// Reflected plus transmitted part at normal incidence.
    #[inline]
    pub fn albedo(&self) -> Spectrum {
        let slab = self.slab(1.0);
        slab.reflected + slab.transmitted
    }

    /// What passes straight on; black when rough.
    #[inline]
    pub fn transmittance(&self, cos: f32) -> Spectrum {
        if self.rough.is_some() { Spectrum::BLACK } else { self.slab(cos).transmitted }
    }

    /// f · |cos θi| and density. Directions as in [`super::Bsdf`], `wo.z > 0`.
    #[inline]
    pub fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        match &self.rough {
            Some(rough) if wi.z != 0.0 => {
                self.rough_eval_pdf(rough, rough.surface.albedo.directional(wo), wo, wi)
            }
            _ => (Spectrum::BLACK, 0.0),
        }
    }

    #[inline]
    fn rough_eval_pdf(&self, rough: &RoughThin, at_o: Directional, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        // What is transmitted is the reflection lobe seen in the mirror of the wall.
        let mirrored = Vec3::new(wi.x, wi.y, wi.z.abs());
        let m = (wo + mirrored).normalize();
        let (single, pdf_single) = rough.surface.ggx.reflection(wo, mirrored, m);
        let slab = self.slab(wo.dot(m));
        let (part, multiple, prob_side) = if wi.z > 0.0 {
            (slab.reflected, rough.multiple.reflected, prob_reflected(&slab))
        } else {
            (slab.transmitted, rough.multiple.transmitted, 1.0 - prob_reflected(&slab))
        };
        let prob_side_multiple =
            if wi.z > 0.0 { prob_reflected(&rough.multiple) } else { 1.0 - prob_reflected(&rough.multiple) };
        let deficit_i = rough.surface.albedo.deficit(mirrored);
        let f = part * single + multiple * rough.compensation.eval(at_o.deficit, deficit_i, mirrored.z);
        let p = rough.prob_multiple(at_o);
        let pdf =
            (1.0 - p) * prob_side * pdf_single + p * prob_side_multiple * rough.compensation.pdf(mirrored.z);
        (f, pdf)
    }

    /// Draws a direction; the slab's reflectance chooses between the two sides.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<BsdfSample> {
        let Some(rough) = &self.rough else { return Some(self.sample_smooth(wo, u_lobe)) };
        let at_o = rough.surface.albedo.directional(wo);
        let p = rough.prob_multiple(at_o);
        let (mut wi, prob, u_side) = if u_lobe < p {
            (rough.compensation.sample(u), prob_reflected(&rough.multiple), u_lobe / p)
        } else {
            let m = rough.surface.ggx.sample_visible_normal(wo, u);
            let prob = prob_reflected(&self.slab(wo.dot(m).clamp(0.0, 1.0)));
            (reflect(wo, m), prob, (u_lobe - p) / (1.0 - p))
        };
        if wi.z <= 0.0 {
            return None;
        }
        let lobe = if u_side.min(ONE_MINUS_EPSILON) < prob {
            Lobe::GlossyReflection
        } else {
            wi.z = -wi.z;
            Lobe::GlossyTransmission
        };
        let (f, pdf) = self.rough_eval_pdf(rough, at_o, wo, wi);
        BsdfSample::smooth(wi, f, pdf, lobe)
    }

    #[inline]
    fn sample_smooth(&self, wo: Vec3, u_lobe: f32) -> BsdfSample {
        let slab = self.slab(wo.z.min(1.0));
        let prob = prob_reflected(&slab);
        if u_lobe < prob {
            let wi = Vec3::new(-wo.x, -wo.y, wo.z);
            BsdfSample::delta(wi, slab.reflected, prob, Lobe::SpecularReflection)
        } else {
            BsdfSample::delta(-wo, slab.transmitted, 1.0 - prob, Lobe::ThinTransmission)
        }
    }
}

impl RoughThin {
    #[inline]
    fn prob_multiple(&self, at_o: Directional) -> f32 {
        let multiple = at_o.deficit * (self.multiple.reflected + self.multiple.transmitted).average();
        let sum = multiple + (1.0 - at_o.deficit) * self.single_mean;
        if sum > 0.0 { multiple / sum } else { 0.0 }
    }
}

/// Reflection and transmission of a slab whose faces reflect `f`, with transmittance `a` per pass, all orders.
#[inline]
pub fn slab(f: Spectrum, a: Spectrum) -> Slab {
    // At F = 1 nothing enters; the clear slab's 0/0 is avoided.
    let series = |f: f32, a: f32| {
        if f < 1.0 { (1.0 - f) * (1.0 - f) * a / (1.0 - f * f * a * a) } else { 0.0 }
    };
    let transmitted = Spectrum::new(series(f.r, a.r), series(f.g, a.g), series(f.b, a.b));
    Slab { reflected: f + transmitted * a * f, transmitted }
}

/// Probability of following the reflection.
#[inline]
fn prob_reflected(slab: &Slab) -> f32 {
    let (r, t) = (slab.reflected.average(), slab.transmitted.average());
    if r + t > 0.0 { r / (r + t) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clear_slab_all_orders() {
        for (deg, t, r) in [(0.0f64, 0.9231, 0.0769), (60.0, 0.8362, 0.1638)] {
            let f = Spectrum::splat(dielectric(deg.to_radians().cos() as f32, 1.5));
            let s = slab(f, Spectrum::WHITE);
            assert!((f64::from(s.transmitted.r) - t).abs() < 5.1e-5, "{s:?}");
            assert!((f64::from(s.reflected.r) - r).abs() < 5.1e-5, "{s:?}");
        }
        let grazing = slab(Spectrum::splat(dielectric(0.0, 1.5)), Spectrum::WHITE);
        assert_eq!((grazing.reflected, grazing.transmitted), (Spectrum::WHITE, Spectrum::BLACK));
    }

    #[test]
    fn tinted_slab_equals_the_summed_orders() {
        let (f, a) = (dielectric(0.4, 1.5), 0.3f32);
        let s = slab(Spectrum::splat(f), Spectrum::splat(a));
        let (mut r, mut t, mut inside) = (f, 0.0, (1.0 - f) * a);
        for order in 0..20 {
            if order % 2 == 0 {
                t += inside * (1.0 - f)
            } else {
                r += inside * (1.0 - f)
            }
            inside *= f * a;
        }
        assert!((s.reflected.g - r).abs() < 1e-6 && (s.transmitted.g - t).abs() < 1e-6);
    }
}
