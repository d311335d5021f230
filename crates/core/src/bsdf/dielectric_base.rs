//! The opaque dielectric of glTF 2.0: a GGX interface over a diffuse base.
//!
//! The interface reflects f0 + (f90 - f0)(1 - wo·m)⁵ (glTF appendix B, KHR_materials_specular), so its albedo E(μ) is known exactly
//! from two tables ([`super::albedo`]). The base is ρ (1-E(μo))(1-E(μi)) / (π (1-Eavg)) (Kelemen and Szirmay-Kalos 2001), with E
//! the largest band of the interface, as KHR_materials_specular asks: a coloured interface does not give the base the complementary
//! tint. Reciprocal, never above 1 in any band, and 1 for a white base. glTF's literal mix loses or gains light at grazing angles.
//! Without an interface (f90 = 0) it is exactly Lambert.

use super::albedo::Directional;
use super::compensation::Rough;
use super::lambert::{self, DiffuseSampling};
use super::{BsdfSample, Lobe};
use crate::fresnel::{SCHLICK_AVERAGE, schlick};
use crate::math::{INV_PI, Vec3};
use crate::microfacet::reflect;
use crate::rgb::Spectrum;

/// Smallest probability with which the interface is chosen.
const MIN_PROB: f32 = 1e-7;

/// A dielectric interface over a diffuse base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DielectricBase {
    /// Diffuse albedo ρ.
    rho: Spectrum,
    f0: Spectrum,
    f90: f32,
    /// Largest band of `f0`.
    f0_max: f32,
    /// Means of ρ and `f0` over the bands, for choosing the lobe.
    rho_mean: f32,
    f0_mean: f32,
    /// 1 / (π (1 - Eavg)), or 0 where the interface lets nothing through.
    scale: f32,
    rough: Option<Rough>,
    sampling: DiffuseSampling,
}

impl DielectricBase {
    /// `rho`, `f0`, `f90` in [0, 1] with `f0 <= f90`; `rough` is `None` for a smooth interface and is not read when `f90` is 0.
    #[inline]
    pub fn new(
        rho: Spectrum,
        f0: Spectrum,
        f90: f32,
        rough: Option<Rough>,
        sampling: DiffuseSampling,
    ) -> Self {
        let f0_max = f0.max_component();
        let average = match &rough {
            Some(rough) => rough.albedo.average(),
            None => Directional { deficit: 0.0, schlick: SCHLICK_AVERAGE },
        };
        let passed = average.passed(f0_max, f90);
        let scale = if passed > 1e-7 { INV_PI / passed } else { 0.0 };
        let (rho_mean, f0_mean) = (rho.average(), f0.average());
        DielectricBase { rho, f0, f90, f0_max, rho_mean, f0_mean, scale, rough, sampling }
    }

    /// True when nothing lies over the diffuse base.
    #[inline]
    pub fn is_lambert(&self) -> bool {
        self.f90 == 0.0
    }

    /// True when the base or a rough interface scatters by a density.
    #[inline]
    pub fn is_smooth_lobe(&self) -> bool {
        !self.rho.is_black() || (self.rough.is_some() && !self.is_lambert())
    }

    /// Hemispherical albedo.
    #[inline]
    pub fn albedo(&self) -> Spectrum {
        if self.is_lambert() {
            return self.rho;
        }
        let average = match &self.rough {
            Some(rough) => rough.albedo.average(),
            None => Directional { deficit: 0.0, schlick: SCHLICK_AVERAGE },
        };
        self.f0.map(|f0| average.reflected(f0, self.f90)) + self.rho * average.passed(self.f0_max, self.f90)
    }

    #[inline]
    fn at(&self, mu: f32) -> Directional {
        match &self.rough {
            Some(rough) => rough.albedo.directional(mu),
            None => Directional::smooth(mu),
        }
    }

    /// Probability of drawing from the interface: its share of the reflected light.
    #[inline]
    fn prob_specular(&self, at_o: Directional) -> f32 {
        let specular = at_o.reflected(self.f0_mean, self.f90);
        let diffuse = self.rho_mean * at_o.passed(self.f0_max, self.f90);
        let prob = specular / (specular + diffuse);
        // Shares that no random number can meet are dropped, 0/0 (nothing reflects) with them.
        if prob > MIN_PROB { prob } else { 0.0 }
    }

    /// f · cos θi and density. Directions as in [`super::Bsdf`], `wo.z > 0`.
    #[inline]
    pub fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        if wi.z <= 0.0 {
            return (Spectrum::BLACK, 0.0);
        }
        if self.is_lambert() {
            return (self.rho * lambert::eval(wi.z), self.sampling.pdf(wi.z));
        }
        self.layered_eval_pdf(self.at(wo.z), wo, wi)
    }

    #[inline]
    fn layered_eval_pdf(&self, at_o: Directional, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let p = self.prob_specular(at_o);
        let passed = at_o.passed(self.f0_max, self.f90) * self.at(wi.z).passed(self.f0_max, self.f90);
        let mut f = self.rho * (passed * self.scale * wi.z);
        let mut pdf = (1.0 - p) * self.sampling.pdf(wi.z);
        if let Some(rough) = &self.rough {
            let m = (wo + wi).normalize();
            let (specular, pdf_specular) = rough.ggx.reflection(wo, wi, m);
            f += schlick(self.f0, self.f90, wo.dot(m)) * specular;
            pdf += p * pdf_specular;
        }
        (f, pdf)
    }

    /// Draws a direction.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Option<BsdfSample> {
        if self.is_lambert() {
            let wi = self.sampling.sample(u);
            return match self.sampling {
                // The cosine and the density cancel exactly.
                DiffuseSampling::Cosine if wi.z > 0.0 => {
                    Some(BsdfSample::new(wi, self.rho, self.sampling.pdf(wi.z), Lobe::DiffuseReflection))
                }
                _ => {
                    let (f, pdf) = self.eval_pdf(wo, wi);
                    BsdfSample::smooth(wi, f, pdf, Lobe::DiffuseReflection)
                }
            };
        }
        let at_o = self.at(wo.z);
        let p = self.prob_specular(at_o);
        let (wi, lobe) = if u_lobe < p {
            let Some(rough) = &self.rough else {
                let wi = Vec3::new(-wo.x, -wo.y, wo.z);
                let f = schlick(self.f0, self.f90, wo.z);
                return Some(BsdfSample::delta(wi, f, p, Lobe::SpecularReflection));
            };
            (reflect(wo, rough.ggx.sample_visible_normal(wo, u)), Lobe::GlossyReflection)
        } else {
            (self.sampling.sample(u), Lobe::DiffuseReflection)
        };
        if wi.z <= 0.0 {
            return None;
        }
        let (f, pdf) = self.layered_eval_pdf(at_o, wo, wi);
        BsdfSample::smooth(wi, f, pdf, lobe)
    }
}
