//! The boundary of a solid, clear dielectric: reflection and refraction, smooth or rough.
//!
//! Walter et al. 2007 with the exact unpolarised Fresnel law, visible normals sampled (Heitz 2018); their i is our wo, their o our
//! wi. `eta` is the index on the other side over the index on the side of `wo`, which is always +z. The base colour tints what crosses.
//!
//! A thin film on the side of the smaller index replaces Fresnel's reflectance band by band ([`super::thin_film`]); from
//! inside it passes what it passes from outside along the same path.
//!
//! In [`TransportMode::Radiance`] what crosses is scaled by (ηi/ηt)² = 1/eta², as radiance is compressed into a narrower
//! cone (Veach 1997, 5.2). Light scattered more than once between microfacets is left out, so a rough boundary loses light:
//! the white furnace at ior 1.5, worst angle of either side, keeps at least 0.86 up to roughness 0.3, 0.78 at 0.5, 0.60 at 0.75, 0.35 at 1
//! (tested: testkit `bsdf/energy`), and never gains any.
//!
//! Where a path that carries all wavelengths enters a solid that disperses ([`crate::wavelength`]), directions follow the index at one wavelength,
//! and Fresnel's law takes that of the d line: what is reflected there does not depend on the wavelength and keeps its colour.

use super::compensation::Rough;
use super::thin_film::ThinFilm;
use super::{BsdfSample, Lobe, TransportMode};
use crate::fresnel::{dielectric, dielectric_refracted, refract};
use crate::math::Vec3;
use crate::microfacet::{Ggx, reflect};
use crate::rgb::Spectrum;

/// Below this value of α |eta - 1| the boundary counts as smooth: refraction spreads less than anything resolved, and half
/// vectors lose their digits.
const SMOOTH_SPREAD: f32 = 1e-4;

/// A boundary between two clear media.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    eta: f32,
    /// The index ratio in Fresnel's law: `eta` but where the solid disperses.
    eta_fresnel: f32,
    film: Option<ThinFilm>,
    tint: Spectrum,
    rough: Option<Ggx>,
}

impl Dielectric {
    /// `eta` > 0: index beyond over index on the side of `wo`; `eta_fresnel`: see [`super::BsdfParams`]; `film` over the
    /// reflectance of `eta_fresnel`; `tint` in [0, 1] per crossing.
    #[inline]
    pub fn new(
        eta: f32,
        eta_fresnel: Option<f32>,
        film: Option<ThinFilm>,
        tint: Spectrum,
        rough: Option<Rough>,
    ) -> Self {
        let spread = (eta - 1.0).abs();
        let rough = rough.map(|r| r.ggx).filter(|g| g.alpha_x * spread >= SMOOTH_SPREAD);
        // Beside a rough axis the other is as smooth as digits allow, the same from both sides.
        let least = SMOOTH_SPREAD / spread * eta.max(1.0);
        let rough = rough.map(|g| Ggx { alpha_y: g.alpha_y.max(least.min(g.alpha_x)), ..g });
        Dielectric { eta, eta_fresnel: eta_fresnel.unwrap_or(eta), film, tint, rough }
    }

    /// Reflectance with the film, given that without, `cos` on the side of `wo`; and the probability of following the reflection.
    #[inline]
    fn filmed(&self, plain: f32, cos: f32) -> (Spectrum, f32) {
        match &self.film {
            Some(film) if plain < 1.0 => {
                // The film asks for the angle on the thinner side.
                let outside = if self.eta < 1.0 { dielectric_refracted(cos, self.eta).1 } else { cos };
                let f = film.reflectance(Spectrum::splat(plain), outside);
                (f, f.average())
            }
            _ => (Spectrum::splat(plain), plain),
        }
    }

    /// True when it scatters by a density rather than into two directions.
    #[inline]
    pub fn is_smooth_lobe(&self) -> bool {
        self.rough.is_some()
    }

    /// Reflected plus transmitted part at normal incidence.
    #[inline]
    pub fn albedo(&self) -> Spectrum {
        let (f, _) = self.filmed(dielectric(1.0, self.eta_fresnel), 1.0);
        f + (Spectrum::WHITE - f) * self.tint
    }

    /// What passes when the ray is let straight through: tint and Fresnel at the angle in the thinner medium, on whichever side the
    /// ray is, so that entering and leaving a parallel body count alike. Black when rough.
    #[inline]
    pub fn straight_transmittance(&self, cos: f32) -> Spectrum {
        if self.rough.is_some() {
            return Spectrum::BLACK;
        }
        let plain = dielectric(cos, self.eta_fresnel.max(1.0 / self.eta_fresnel));
        let outside = Dielectric { eta: 1.0, ..*self };
        self.tint * (Spectrum::WHITE - outside.filmed(plain, cos).0)
    }

    /// Scale of radiance across the boundary.
    #[inline]
    fn eta_scale(&self, mode: TransportMode) -> f32 {
        match mode {
            TransportMode::Radiance => 1.0 / (self.eta * self.eta),
            TransportMode::Importance => 1.0,
        }
    }

    /// Reflectance and the cosine of the refracted ray.
    #[inline]
    fn fresnel_refracted(&self, cos: f32) -> (f32, f32) {
        let (fresnel, cos_t) = dielectric_refracted(cos, self.eta);
        if self.eta_fresnel == self.eta {
            return (fresnel, cos_t);
        }
        (dielectric(cos, self.eta_fresnel), cos_t)
    }

    /// f · |cos θi| and density. Directions as in [`super::Bsdf`], `wo.z > 0`.
    #[inline]
    pub fn eval_pdf(&self, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Spectrum, f32) {
        let black = (Spectrum::BLACK, 0.0);
        let Some(ggx) = &self.rough else { return black };
        if wi.z > 0.0 {
            let m = (wo + wi).normalize();
            let (f, pdf) = ggx.reflection(wo, wi, m);
            let cos = wo.dot(m);
            let (fresnel, prob) = self.filmed(dielectric(cos, self.eta_fresnel), cos);
            (fresnel * f, prob * pdf)
        } else if wi.z < 0.0 {
            self.refraction(ggx, wo, wi, mode)
        } else {
            black
        }
    }

    /// Walter et al. 2007, eq. 16, 17, 21.
    #[inline]
    fn refraction(&self, ggx: &Ggx, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Spectrum, f32) {
        let h = wo + wi * self.eta;
        let len2 = h.length_squared();
        if len2 < 1e-18 {
            return (Spectrum::BLACK, 0.0);
        }
        let m = h * (1.0f32.copysign(h.z) / len2.sqrt());
        let (cos_o, cos_i) = (wo.dot(m), -wi.dot(m));
        // Facets seen from behind on either side do not refract between these directions.
        if cos_o <= 0.0 || cos_i <= 0.0 {
            return (Spectrum::BLACK, 0.0);
        }
        let (fresnel, prob) = self.filmed(dielectric(cos_o, self.eta_fresnel), cos_o);
        // d ωm / d ωi; the denominator (wo·m + eta wi·m)² is the squared length of the unnormalised half vector.
        let jacobian = self.eta * self.eta * cos_i / len2;
        let pdf = ggx.pdf_visible_normal(wo, m) * jacobian;
        let f = pdf * ggx.g1(wi) * self.eta_scale(mode);
        (self.tint * (Spectrum::WHITE - fresnel) * f, pdf * (1.0 - prob))
    }

    /// Draws a direction; Fresnel's reflectance chooses between the two sides.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2], mode: TransportMode) -> Option<BsdfSample> {
        let Some(ggx) = &self.rough else { return Some(self.sample_smooth(wo, u_lobe, mode)) };
        let m = ggx.sample_visible_normal(wo, u);
        let cos = wo.dot(m).clamp(0.0, 1.0);
        let (plain, cos_t) = self.fresnel_refracted(cos);
        if u_lobe < self.filmed(plain, cos).1 {
            let wi = reflect(wo, m);
            if wi.z <= 0.0 {
                return None;
            }
            let (f, pdf) = self.eval_pdf(wo, wi, mode);
            return BsdfSample::smooth(wi, f, pdf, Lobe::GlossyReflection);
        }
        let wi = refract(wo, m, cos_t, self.eta).normalize();
        if wi.z >= 0.0 {
            return None;
        }
        let (f, pdf) = self.refraction(ggx, wo, wi, mode);
        let sample = BsdfSample::smooth(wi, f, pdf, Lobe::GlossyTransmission)?;
        Some(BsdfSample { eta_scale: self.eta_scale(mode), ..sample })
    }

    #[inline]
    fn sample_smooth(&self, wo: Vec3, u_lobe: f32, mode: TransportMode) -> BsdfSample {
        let cos = wo.z.min(1.0);
        let (plain, cos_t) = self.fresnel_refracted(cos);
        let (fresnel, prob) = self.filmed(plain, cos);
        if u_lobe < prob {
            let wi = Vec3::new(-wo.x, -wo.y, wo.z);
            return BsdfSample::delta(wi, fresnel, prob, Lobe::SpecularReflection);
        }
        let inv = 1.0 / self.eta;
        let wi = Vec3::new(-wo.x * inv, -wo.y * inv, -cos_t);
        let eta_scale = self.eta_scale(mode);
        let weight = self.tint * (Spectrum::WHITE - fresnel) * eta_scale;
        BsdfSample { eta_scale, ..BsdfSample::delta(wi, weight, 1.0 - prob, Lobe::SpecularTransmission) }
    }
}
