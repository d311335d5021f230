//! Metal: GGX reflection whose reflectance runs from the base colour at normal incidence to 1 at grazing incidence (glTF 2.0,
//! appendix B: Schlick), plus the light of multiple scattering (Kulla and Conty 2017).
//!
//! A thin film replaces the reflectance by its own ([`super::thin_film`]). Perfectly smooth below [`crate::microfacet::ALPHA_SMOOTH`]: a mirror. Left out: measured eta and k.

use super::albedo::Directional;
use super::compensation::{Compensation, Rough, multiple_scattering};
use super::thin_film::{self, ThinFilm};
use super::{BsdfSample, Lobe};
use crate::fresnel::{SCHLICK_AVERAGE, schlick};
use crate::math::Vec3;
use crate::microfacet::reflect;
use crate::rgb::Spectrum;

/// A metal interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metal {
    f0: Spectrum,
    film: Option<ThinFilm>,
    rough: Option<RoughMetal>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct RoughMetal {
    surface: Rough,
    compensation: Compensation,
    /// What multiple scattering keeps, per band.
    f_ms: Spectrum,
}

impl Metal {
    /// `f0` in [0, 1] per band; `rough` is `None` for a mirror.
    #[inline]
    pub fn new(f0: Spectrum, film: Option<ThinFilm>, rough: Option<Rough>) -> Self {
        let mut metal = Metal { f0, film, rough: None };
        metal.rough = rough.map(|surface| RoughMetal {
            surface,
            compensation: Compensation::new(&surface.albedo),
            f_ms: multiple_scattering(metal.average_reflectance(), surface.albedo.average().deficit),
        });
        metal
    }

    /// At one facet.
    #[inline]
    fn reflectance(&self, cos: f32) -> Spectrum {
        let plain = schlick(self.f0, 1.0, cos);
        self.film.map_or(plain, |film| film.reflectance(plain, cos))
    }

    /// Over the cosine-weighted hemisphere.
    #[inline]
    fn average_reflectance(&self) -> Spectrum {
        match &self.film {
            None => self.f0 * (1.0 - SCHLICK_AVERAGE) + Spectrum::splat(SCHLICK_AVERAGE),
            Some(_) => thin_film::average(|cos| self.reflectance(cos)),
        }
    }

    /// True when it scatters by a density rather than as a mirror.
    #[inline]
    pub fn is_smooth_lobe(&self) -> bool {
        self.rough.is_some()
    }

    /// Hemispherical albedo.
    #[inline]
    pub fn albedo(&self) -> Spectrum {
        let Some(rough) = &self.rough else { return self.average_reflectance() };
        let average = rough.surface.albedo.average();
        let single = match &self.film {
            None => self.f0.map(|f0| average.reflected(f0, 1.0)),
            Some(_) => self.average_reflectance() * (1.0 - average.deficit),
        };
        single + rough.f_ms * average.deficit
    }

    /// f · cos θi and density. Directions as in [`super::Bsdf`], `wo.z > 0`.
    #[inline]
    pub fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        match &self.rough {
            Some(rough) if wi.z > 0.0 => {
                self.rough_eval_pdf(rough, rough.surface.albedo.directional(wo), wo, wi)
            }
            _ => (Spectrum::BLACK, 0.0),
        }
    }

    #[inline]
    fn rough_eval_pdf(&self, rough: &RoughMetal, at_o: Directional, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let m = (wo + wi).normalize();
        let (single, pdf_single) = rough.surface.ggx.reflection(wo, wi, m);
        let multiple = rough.compensation.eval(at_o.deficit, rough.surface.albedo.deficit(wi), wi.z);
        let f = self.reflectance(wo.dot(m)) * single + rough.f_ms * multiple;
        let p = rough.prob_multiple(self.f0, at_o);
        (f, (1.0 - p) * pdf_single + p * rough.compensation.pdf(wi.z))
    }

    /// Draws a direction.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<BsdfSample> {
        let Some(rough) = &self.rough else {
            let wi = Vec3::new(-wo.x, -wo.y, wo.z);
            return Some(BsdfSample::delta(wi, self.reflectance(wo.z), 1.0, Lobe::SpecularReflection));
        };
        let at_o = rough.surface.albedo.directional(wo);
        let wi = if u_lobe < rough.prob_multiple(self.f0, at_o) {
            rough.compensation.sample(u)
        } else {
            reflect(wo, rough.surface.ggx.sample_visible_normal(wo, u))
        };
        if wi.z <= 0.0 {
            return None;
        }
        let (f, pdf) = self.rough_eval_pdf(rough, at_o, wo, wi);
        BsdfSample::smooth(wi, f, pdf, Lobe::GlossyReflection)
    }
}

impl RoughMetal {
    /// Probability of drawing from the multiple scattering lobe: its share of the reflected light, without a film.
    #[inline]
    fn prob_multiple(&self, f0: Spectrum, at_o: Directional) -> f32 {
        let multiple = at_o.deficit * self.f_ms.average();
        let single = at_o.reflected(f0.average(), 1.0);
        let sum = multiple + single;
        if sum > 0.0 { multiple / sum } else { 0.0 }
    }
}
