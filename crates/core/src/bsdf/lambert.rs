//! Lambert's diffuse reflection: radiance the same in all directions, f = ρ/π.
//!
//! Lambert 1760. Directions are drawn by the cosine (Malley's method, exact: weight ρ) or, for comparison, uniformly.

use crate::math::{INV_PI, Vec3};
use crate::warp::{UNIFORM_HEMISPHERE_PDF, cosine_hemisphere, cosine_hemisphere_pdf, uniform_hemisphere};

/// How diffuse directions are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum DiffuseSampling {
    /// In proportion to the cosine.
    #[default]
    Cosine,
    /// Uniformly over the hemisphere: noisier, for comparison only.
    Uniform,
}

impl DiffuseSampling {
    /// A direction above the surface.
    #[inline]
    pub fn sample(self, u: [f32; 2]) -> Vec3 {
        match self {
            DiffuseSampling::Cosine => cosine_hemisphere(u),
            DiffuseSampling::Uniform => uniform_hemisphere(u),
        }
    }

    /// Density of [`DiffuseSampling::sample`], sr⁻¹; `cos_i > 0`.
    #[inline]
    pub fn pdf(self, cos_i: f32) -> f32 {
        match self {
            DiffuseSampling::Cosine => cosine_hemisphere_pdf(cos_i),
            DiffuseSampling::Uniform => UNIFORM_HEMISPHERE_PDF,
        }
    }
}

/// f · cos θi of a Lambert surface of albedo 1; `cos_i > 0`.
#[inline]
pub fn eval(cos_i: f32) -> f32 {
    INV_PI * cos_i
}
