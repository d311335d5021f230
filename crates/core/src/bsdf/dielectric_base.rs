//! The opaque dielectric of glTF 2.0: a GGX interface over a diffuse base.
//!
//! What the interface ([`super::interface`]) does not reflect reaches the base, ρ (1-E(μo))(1-E(μi)) / (π (1-Eavg)) (Kelemen and
//! Szirmay-Kalos 2001), with E the largest band of the interface's albedo, as KHR_materials_specular asks: a coloured interface does not give the base the complementary
//! tint. Reciprocal, never above 1 in any band, and 1 for a white Lambert base. glTF's literal mix loses or gains light at grazing angles.
//! A base that is rough or transmits ([`super::diffuse`]) is scaled by the same factors, its other side taken to have the same
//! interface. Without an interface the base is all there is.

use super::diffuse::Diffuse;
use super::interface::{Interface, Shares};
use super::lambert::DiffuseSampling;
use super::{BsdfSample, Lobe, TransportMode};
use crate::math::{ONE_MINUS_EPSILON, Vec3};
use crate::microfacet::reflect;
use crate::rgb::Spectrum;

/// Smallest probability with which the interface is chosen.
const MIN_PROB: f32 = 1e-7;

/// A dielectric interface over a diffuse base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DielectricBase {
    diffuse: Diffuse,
    interface: Interface,
    /// Mean of the base's albedo over the bands, for choosing the lobe; not read without an interface.
    diffuse_mean: f32,
    /// 1 / (1 - Eavg), or 0 where the interface lets nothing through.
    scale: f32,
}

impl DielectricBase {
    /// The base beneath an interface.
    #[inline]
    pub fn new(diffuse: Diffuse, interface: Interface) -> Self {
        let passed = interface.average_passed();
        let scale = if passed > 1e-7 { 1.0 / passed } else { 0.0 };
        DielectricBase { diffuse, interface, diffuse_mean: diffuse.albedo().average(), scale }
    }

    /// A Lambert surface without an interface.
    #[inline]
    pub fn lambert(rho: Spectrum, sampling: DiffuseSampling) -> Self {
        let diffuse = Diffuse::lambert(rho, sampling);
        DielectricBase { diffuse, interface: Interface::NONE, diffuse_mean: 0.0, scale: 1.0 }
    }

    /// True when nothing lies over the diffuse base.
    #[inline]
    fn is_bare(&self) -> bool {
        self.interface.is_none()
    }

    /// True for plain Lambert.
    #[inline]
    pub fn is_lambert(&self) -> bool {
        self.is_bare() && self.diffuse.is_lambert()
    }

    /// True when the base or a rough interface scatters by a density.
    #[inline]
    pub fn is_smooth_lobe(&self) -> bool {
        !self.diffuse.is_black() || (self.interface.rough().is_some() && !self.is_bare())
    }

    /// Hemispherical albedo.
    #[inline]
    pub fn albedo(&self) -> Spectrum {
        let diffuse = self.diffuse.albedo();
        if self.is_bare() {
            return diffuse;
        }
        self.interface.albedo() + diffuse * self.interface.average_passed()
    }

    /// Probability of drawing from the interface: its share of the reflected light.
    #[inline]
    fn prob_specular(&self, at_o: Shares) -> f32 {
        let prob = at_o.reflected / (at_o.reflected + self.diffuse_mean * at_o.passed);
        // Shares that no random number can meet are dropped, 0/0 (nothing reflects) with them.
        if prob > MIN_PROB { prob } else { 0.0 }
    }

    /// f · |cos θi| and density. Directions as in [`super::Bsdf`], `wo.z > 0`.
    #[inline]
    pub fn eval_pdf(&self, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Spectrum, f32) {
        if self.is_bare() {
            return self.diffuse.eval_pdf(wo, wi, mode);
        }
        if wi.z <= 0.0 && self.diffuse.is_lambert() {
            return (Spectrum::BLACK, 0.0);
        }
        self.layered_eval_pdf(self.interface.shares(wo), wo, wi, mode)
    }

    #[inline]
    fn layered_eval_pdf(&self, at_o: Shares, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Spectrum, f32) {
        let (base, pdf_base) = self.diffuse.eval_pdf(wo, wi, mode);
        let p = self.prob_specular(at_o);
        let passed = at_o.passed * self.interface.shares(wi).passed;
        let mut f = base * (passed * self.scale);
        let mut pdf = (1.0 - p) * pdf_base;
        if let Some(rough) = self.interface.rough().filter(|_| wi.z > 0.0) {
            let m = (wo + wi).normalize();
            let (specular, pdf_specular) = rough.ggx.reflection(wo, wi, m);
            f += self.interface.reflectance(wo.dot(m)) * specular;
            pdf += p * pdf_specular;
        }
        (f, pdf)
    }

    /// Draws a direction.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2], mode: TransportMode) -> Option<BsdfSample> {
        if self.is_bare() {
            let wi = self.diffuse.sample(wo, u_lobe, u);
            if self.draws_by_the_cosine() && wi.z > 0.0 {
                // The cosine and the density cancel exactly.
                let (rho, pdf) = (self.diffuse.albedo(), DiffuseSampling::Cosine.pdf(wi.z));
                return Some(BsdfSample::new(wi, rho, pdf, Lobe::DiffuseReflection));
            }
            let (f, pdf) = self.diffuse.eval_pdf(wo, wi, mode);
            return self.crossed(BsdfSample::smooth(wi, f, pdf, Diffuse::lobe(wi)), mode);
        }
        let at_o = self.interface.shares(wo);
        let p = self.prob_specular(at_o);
        let (wi, lobe) = if u_lobe < p {
            let Some(rough) = self.interface.rough() else {
                let wi = Vec3::new(-wo.x, -wo.y, wo.z);
                return Some(BsdfSample::delta(
                    wi,
                    self.interface.reflectance(wo.z),
                    p,
                    Lobe::SpecularReflection,
                ));
            };
            let wi = reflect(wo, rough.ggx.sample_visible_normal(wo, u));
            if wi.z <= 0.0 {
                return None;
            }
            (wi, Lobe::GlossyReflection)
        } else {
            let u_lobe = ((u_lobe - p) / (1.0 - p)).min(ONE_MINUS_EPSILON);
            let wi = self.diffuse.sample(wo, u_lobe, u);
            (wi, Diffuse::lobe(wi))
        };
        let (f, pdf) = self.layered_eval_pdf(at_o, wo, wi, mode);
        self.crossed(BsdfSample::smooth(wi, f, pdf, lobe), mode)
    }

    /// A bare Lambert base, drawn by the cosine.
    #[inline]
    fn draws_by_the_cosine(&self) -> bool {
        self.diffuse.is_lambert() && self.diffuse.sampling() == DiffuseSampling::Cosine
    }

    /// Notes the scale of radiance that crossed.
    #[inline]
    fn crossed(&self, sample: Option<BsdfSample>, mode: TransportMode) -> Option<BsdfSample> {
        let mut sample = sample?;
        if sample.lobe == Lobe::DiffuseTransmission {
            sample.eta_scale = self.diffuse.crossing(mode);
        }
        Some(sample)
    }
}
