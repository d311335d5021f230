//! The gloss of MTL materials (illumination models 2, 3 and 5 of the format): Phong's lobe, or a mirror, over a diffuse base.
//!
//! Phong 1975, with the energy normalisation (n + 2) / 2π of Lafortune and Willems 1994 and the divisor max(cos θo, cos θi) of Neumann,
//! Neumann and Szirmay-Kalos 1999 in place of none: f = F (n + 2) / (2π max(cos θo, cos θi)) cosⁿ α, α between `wi` and the mirror
//! direction of `wo`. Reciprocal. Its albedo is F at normal incidence, never more, and turns into that of the mirror as n grows; without
//! the divisor a sharp lobe would fade as cos θo while the mirror does not. What is lost lies below the horizon: at most 1 - (n + 2) / (2n + 2), half
//! for sharp lobes, and that only where the lobe is cut in two (at 60° and n = 50: 9 %). Below n = 1 the form would exceed 1 by up to 8.6 %
//! and is divided by a line above that.
//!
//! F is the specular colour, or with `fresnel` runs from it to 1 by Schlick with the larger of the two cosines, so that the albedo of the lobe is at
//! most that of the mirror, E(μ) = F(μ); the base then gets (1 - E(μo)) (1 - E(μi)) / (1 - Eavg) as under any interface
//! ([`super::dielectric_base`]). Without it the base stays as it is. Kd + Ks above 1 is brought to 1 here, by the largest band.

use super::diffuse::Diffuse;
use super::{BsdfSample, GlossParams, Lobe, TransportMode, unit_interval};
use crate::fresnel::{SCHLICK_AVERAGE, schlick, schlick_weight};
use crate::math::{INV_PI, ONE_MINUS_EPSILON, PI, Vec3, exp, ln, pow, safe_sqrt, sin_cos};
use crate::rgb::Spectrum;

/// From this exponent on the lobe is a mirror: as narrow as microfacets of [`crate::microfacet::ALPHA_SMOOTH`].
const MIRROR: f32 = 2e6;

/// How far the albedo of the lobe would exceed 1 at n = 0.
const EXCESS_AT_ZERO: f32 = 0.086;

/// Gloss over a diffuse base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong {
    diffuse: Diffuse,
    specular: Spectrum,
    /// Mean over the bands of what the base scatters, for choosing the lobe.
    diffuse_mean: f32,
    /// Exponent, or `None` for a mirror.
    exponent: Option<f32>,
    fresnel: bool,
}

impl Phong {
    /// Gloss over `diffuse`.
    #[inline]
    pub fn new(diffuse: Diffuse, gloss: &GlossParams) -> Self {
        let specular = gloss.specular.map(unit_interval);
        let sum = (diffuse.albedo() + specular).max_component();
        let scale = if sum > 1.0 { 1.0 / sum } else { 1.0 };
        let diffuse = diffuse.darkened(scale);
        Phong {
            diffuse,
            specular: specular * scale,
            diffuse_mean: diffuse.albedo().average(),
            // Written so that NaN counts as 0.
            exponent: if gloss.exponent >= MIRROR { None } else { Some(gloss.exponent.max(0.0)) },
            fresnel: gloss.fresnel,
        }
    }

    /// True when the base or the lobe scatters by a density.
    #[inline]
    pub fn is_smooth_lobe(&self) -> bool {
        !self.diffuse.is_black() || (self.exponent.is_some() && (self.fresnel || !self.specular.is_black()))
    }

    /// Hemispherical albedo, what the lobe loses at grazing angles not counted.
    #[inline]
    pub fn albedo(&self) -> Spectrum {
        if !self.fresnel {
            return self.diffuse.albedo() + self.specular;
        }
        let reflected = self.specular * (1.0 - SCHLICK_AVERAGE) + Spectrum::splat(SCHLICK_AVERAGE);
        reflected + self.diffuse.albedo() * ((1.0 - self.specular.max_component()) * (1.0 - SCHLICK_AVERAGE))
    }

    #[inline]
    fn reflectance(&self, cos: f32) -> Spectrum {
        if self.fresnel { schlick(self.specular, 1.0, cos) } else { self.specular }
    }

    /// Factor on the base: what passes on the way in and out over its mean.
    #[inline]
    fn passed(&self, cos_o: f32, cos_i: f32) -> f32 {
        if !self.fresnel {
            return 1.0;
        }
        let [o, i] = [cos_o, cos_i].map(|c| 1.0 - schlick_weight(c));
        (1.0 - self.specular.max_component()) * o * i * (1.0 / (1.0 - SCHLICK_AVERAGE))
    }

    /// Probability of drawing from the lobe: its share of the reflected light.
    #[inline]
    fn prob_specular(&self, cos_o: f32) -> f32 {
        let specular = self.reflectance(cos_o).average();
        let passed = if self.fresnel {
            (1.0 - self.specular.max_component()) * (1.0 - schlick_weight(cos_o))
        } else {
            1.0
        };
        let sum = specular + self.diffuse_mean * passed;
        if sum > 0.0 { specular / sum } else { 0.0 }
    }

    /// f · |cos θi| and density. Directions as in [`super::Bsdf`], `wo.z > 0`.
    #[inline]
    pub fn eval_pdf(&self, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Spectrum, f32) {
        let p = self.prob_specular(wo.z);
        let (f, pdf) = self.diffuse.eval_pdf(wo, wi, mode);
        let (mut f, mut pdf) = (f * self.passed(wo.z, wi.z.abs()), (1.0 - p) * pdf);
        if let Some(n) = self.exponent.filter(|_| wi.z > 0.0) {
            let lobe = lobe_density(n, wo, wi);
            let most = wo.z.max(wi.z);
            f += self.reflectance(most) * (lobe * normalisation(n) * (wi.z / most));
            pdf += p * lobe;
        }
        (f, pdf)
    }

    /// Draws a direction.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2], mode: TransportMode) -> Option<BsdfSample> {
        let p = self.prob_specular(wo.z);
        let (wi, lobe) = if u_lobe < p {
            let mirror = Vec3::new(-wo.x, -wo.y, wo.z);
            let Some(n) = self.exponent else {
                let f = self.reflectance(wo.z);
                return Some(BsdfSample::delta(mirror, f, p, Lobe::SpecularReflection));
            };
            let wi = about(mirror, n, u);
            if wi.z <= 0.0 {
                return None;
            }
            (wi, Lobe::GlossyReflection)
        } else {
            let u_lobe = ((u_lobe - p) / (1.0 - p)).clamp(0.0, ONE_MINUS_EPSILON);
            let wi = self.diffuse.sample(wo, u_lobe, u);
            (wi, Diffuse::lobe(wi))
        };
        let (f, pdf) = self.eval_pdf(wo, wi, mode);
        let sample = BsdfSample::smooth(wi, f, pdf, lobe)?;
        let crossed = lobe.is_transmission();
        Some(BsdfSample { eta_scale: if crossed { self.diffuse.crossing(mode) } else { 1.0 }, ..sample })
    }
}

/// (n + 2) / (n + 1), lowered where the lobe would exceed 1.
#[inline]
fn normalisation(n: f32) -> f32 {
    (n + 2.0) / ((n + 1.0) * (1.0 + EXCESS_AT_ZERO * (1.0 - n).max(0.0)))
}

/// (n + 1) / 2π cosⁿ α: the density of [`about`], sr⁻¹.
#[inline]
fn lobe_density(n: f32, wo: Vec3, wi: Vec3) -> f32 {
    // 1 - cos α from the chord between unit vectors, which keeps its digits at small angles.
    let x = 0.5 * (wi - Vec3::new(-wo.x, -wo.y, wo.z)).length_squared();
    if x >= 1.0 {
        return 0.0;
    }
    let ln_cos = if x < 1e-2 { -x * (1.0 + x * (0.5 + x * (1.0 / 3.0))) } else { ln(1.0 - x) };
    (n + 1.0) * (0.5 * INV_PI) * exp(n * ln_cos)
}

/// A direction about the unit `axis`, its cosine to it drawn in proportion to cosⁿ.
#[inline]
fn about(axis: Vec3, n: f32, u: [f32; 2]) -> Vec3 {
    let cos = pow(1.0 - u[0], 1.0 / (n + 1.0));
    let sin = safe_sqrt((1.0 - cos) * (1.0 + cos));
    let (s, c) = sin_cos(2.0 * PI * u[1]);
    crate::Frame::from_normal(axis).to_world(Vec3::new(sin * c, sin * s, cos)).normalize()
}
