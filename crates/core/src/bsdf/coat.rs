//! Varnish over a surface (KHR_materials_clearcoat): the reflection of a clear dielectric of index 1.5, Schlick's reflectance
//! 0.04 + 0.96 (1 - cos θ)⁵ at GGX microfacets, about a normal of its own. Perfectly smooth below [`crate::microfacet::ALPHA_SMOOTH`].
//!
//! What it does not reflect passes: also the light that single scattering between rough facets loses, so nothing needs to be put back. Left out:
//! absorption in the varnish, refraction on the way through it, and the reflections between it and what lies beneath.

use super::albedo::Directional;
use super::compensation::Rough;
use super::{BsdfSample, Lobe};
use crate::frame::Frame;
use crate::fresnel::{SCHLICK_AVERAGE, schlick_weight};
use crate::math::{Vec3, lerp};
use crate::microfacet::reflect;
use crate::rgb::Spectrum;

/// Reflectance at normal incidence, of index 1.5.
const F0: f32 = 0.04;

/// A layer of varnish.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coat {
    factor: f32,
    rough: Option<Rough>,
    normal: Vec3,
}

impl Coat {
    /// `factor` in [0, 1]; `roughness` perceptual; `normal` unit, in the local frame of the surface.
    #[inline]
    pub fn new(factor: f32, roughness: f32, normal: Vec3) -> Self {
        Coat { factor, rough: Rough::new(roughness, 0.0), normal }
    }

    /// True when it scatters by a density rather than as a mirror.
    #[inline]
    pub fn is_smooth_lobe(&self) -> bool {
        self.rough.is_some()
    }

    /// Hemispherical albedo.
    #[inline]
    pub fn albedo(&self) -> f32 {
        let average = match &self.rough {
            Some(rough) => rough.albedo.average(),
            None => Directional { deficit: 0.0, schlick: SCHLICK_AVERAGE },
        };
        self.factor * average.reflected(F0, 1.0)
    }

    /// Share of the light of a direction that reaches what lies beneath, or comes from there. Directions below the horizon of the varnish
    /// count as grazing ones; a direction on the other side of the surface meets the same varnish there.
    #[inline]
    pub fn passed(&self, w: Vec3) -> f32 {
        let mu = self.normal.dot(w) * 1.0f32.copysign(w.z);
        let mu = mu.clamp(0.0, 1.0);
        let at = match &self.rough {
            Some(rough) => rough.albedo.directional(Vec3::new(0.0, 0.0, mu)),
            None => Directional::smooth(mu),
        };
        lerp(1.0, at.passed(F0, 1.0), self.factor)
    }

    /// f · cos θi, with the cosine to its own normal, and density; both directions above the surface.
    #[inline]
    pub fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (f32, f32) {
        let Some(rough) = &self.rough else { return (0.0, 0.0) };
        let frame = Frame::from_normal(self.normal);
        let (wo, wi) = (frame.to_local(wo), frame.to_local(wi));
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return (0.0, 0.0);
        }
        let m = (wo + wi).normalize();
        let (f, pdf) = rough.ggx.reflection(wo, wi, m);
        (self.factor * reflectance(wo.dot(m)) * f, pdf)
    }

    /// Draws a direction; a delta lobe's weight is given, a smooth one's is left to the caller. `None` below a horizon.
    #[inline]
    pub fn sample(&self, wo: Vec3, u: [f32; 2]) -> Option<BsdfSample> {
        let Some(rough) = &self.rough else {
            let cos = self.normal.dot(wo);
            let wi = reflect(wo, self.normal);
            let weight = Spectrum::splat(self.factor * reflectance(cos));
            let sample = BsdfSample::delta(wi, weight, 1.0, Lobe::SpecularReflection);
            return (cos > 0.0 && wi.z > 0.0).then_some(sample);
        };
        let frame = Frame::from_normal(self.normal);
        let wo = frame.to_local(wo);
        if wo.z <= 0.0 {
            return None;
        }
        let local = reflect(wo, rough.ggx.sample_visible_normal(wo, u));
        let wi = frame.to_world(local);
        let sample = BsdfSample::new(wi, Spectrum::BLACK, 0.0, Lobe::GlossyReflection);
        (local.z > 0.0 && wi.z > 0.0).then_some(sample)
    }
}

#[inline]
fn reflectance(cos: f32) -> f32 {
    lerp(F0, 1.0, schlick_weight(cos))
}
