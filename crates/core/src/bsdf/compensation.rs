//! Rough interfaces and the light that single scattering loses.
//!
//! [`Rough`] is what all rough models share: the microfacet distribution, of one width or two (KHR_materials_anisotropy), and its albedo table. [`Compensation`] is the lobe of Kulla
//! and Conty 2017 that returns the lost light, f = (1-E(μo))(1-E(μi)) / (π (1-Eavg)), reciprocal and energy-true (E depends on the azimuth where there are two widths), with its own
//! sampling, the same at all azimuths: (1-E(μ)) μ behaves as μ / (μ² + α²) (1-E falls with the square of μ/α, the small-angle limit of Smith's Λ), whose integral inverts in closed form.
//! Cosine sampling would meet weights of 1e4 at small α.

use super::aniso_albedo::Albedo;
use crate::math::{INV_PI, PI, Vec3, exp, ln, safe_sqrt, sin_cos};
use crate::microfacet::{ALPHA_SMOOTH, Ggx};
use crate::rgb::Spectrum;

/// A rough interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rough {
    /// Its microfacets.
    pub ggx: Ggx,
    /// Its directional albedo.
    pub albedo: Albedo,
}

impl Rough {
    /// From the perceptual roughness, α = roughness², and the strength of its anisotropy in [0, 1], which widens the facets along
    /// x: αx = α + (1 - α) strength². `None` where both widths are below [`ALPHA_SMOOTH`], and the surface is perfectly smooth.
    #[inline]
    pub fn new(roughness: f32, anisotropy: f32) -> Option<Self> {
        let alpha = (roughness * roughness).min(1.0);
        // Written so that NaN counts as smooth, and as isotropic.
        let ggx = if anisotropy > 0.0 { Ggx::stretched(alpha, anisotropy) } else { Ggx::isotropic(alpha) };
        (ggx.alpha_x >= ALPHA_SMOOTH).then(|| Rough { ggx, albedo: Albedo::new(&ggx) })
    }
}

/// The lobe of multiply scattered light, for reflectance 1; models scale it by [`multiple_scattering`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compensation {
    /// The larger width.
    alpha: f32,
    /// 1 / (π (1 - Eavg)).
    scale: f32,
    /// ln(1 + 1/α²): integral of 2μ / (μ² + α²).
    log_norm: f32,
}

impl Compensation {
    /// For one interface.
    #[inline]
    pub fn new(albedo: &Albedo) -> Self {
        let alpha = albedo.alpha();
        Compensation {
            alpha,
            scale: INV_PI / albedo.average().deficit,
            log_norm: ln(1.0 + 1.0 / (alpha * alpha)),
        }
    }

    /// f · cos θi, given 1 - E towards both sides; `cos_i > 0`.
    #[inline]
    pub fn eval(&self, deficit_o: f32, deficit_i: f32, cos_i: f32) -> f32 {
        deficit_o * deficit_i * self.scale * cos_i
    }

    /// A direction above the surface.
    #[inline]
    pub fn sample(&self, u: [f32; 2]) -> Vec3 {
        let cos = (self.alpha * safe_sqrt(exp(u[0] * self.log_norm) - 1.0)).min(1.0);
        let sin = safe_sqrt(1.0 - cos * cos);
        let (s, c) = sin_cos(2.0 * PI * u[1]);
        Vec3::new(sin * c, sin * s, cos)
    }

    /// Density of [`Compensation::sample`], sr⁻¹.
    #[inline]
    pub fn pdf(&self, cos_i: f32) -> f32 {
        let alpha = self.alpha;
        INV_PI * cos_i / (self.log_norm * (cos_i * cos_i + alpha * alpha))
    }
}

/// Share of the lost light that comes back when each further bounce keeps `f_avg`: the geometric series of bounces,
/// F²E / (1 - F (1-E)) with hemispherical averages. Kulla and Conty 2017, with the first bounce's F as Hill 2018 adds it.
#[inline]
pub fn multiple_scattering(f_avg: Spectrum, deficit_avg: f32) -> Spectrum {
    f_avg.map(|f| f * f * (1.0 - deficit_avg) / (1.0 - f * deficit_avg))
}
