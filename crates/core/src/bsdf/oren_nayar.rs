//! Rough diffuse reflection that keeps its energy: EON (Portsmouth, Kutz and Hill 2024), Oren and Nayar's model in the form of
//! Fujii 2012 plus a lobe for the light that single scattering loses.
//!
//! Single scattering is ρ/π A (1 + r s/t) with A = 1 / (1 + c₁ r), s = wo·wi - μo μi, and t the larger cosine where s > 0, else 1. Its
//! albedo for ρ = 1 is A (1 + r g(μ)), g in closed form, so what is lost, A r (c₁ - g(μ)), is known without a table, and the lobe that
//! returns it makes the furnace of a white surface exactly 1. Reciprocal, never above ρ. Roughness 0 is Lambert.
//!
//! Sampling is derived here. For a fixed `wo` the positive part of the model is at most cos θi + r sin θo (wi·x)⁺, x the direction of `wo` along
//! the surface: the cosine about the normal and a cosine about x. Directions come from a mixture of the two, the second folded up to
//! the surface's side; weights stay below 1.5 at every angle, where the cosine alone meets 80 at grazing ones.

use crate::math::{INV_PI, PI, Vec3, acos, safe_sqrt};
use crate::rgb::Spectrum;
use crate::warp::cosine_hemisphere;

/// 1/2 - 2/(3π), the largest value of [`g`], at grazing angles.
const C1: f32 = 0.5 - 2.0 / (3.0 * PI);
/// 2/3 - 28/(15π), the mean of [`g`] over the cosine-weighted hemisphere.
const C2: f32 = 2.0 / 3.0 - 28.0 / (15.0 * PI);

/// Directional albedo of s/t alone, over π: G(θ)/π of Portsmouth, Kutz and Hill 2024.
#[inline]
fn g(mu: f32) -> f32 {
    let sin = safe_sqrt(1.0 - mu * mu);
    // (1 - sin³)/cos with 1 - sin = cos²/(1 + sin): nothing is divided by a grazing cosine.
    let tail = mu * (1.0 + sin + sin * sin) / (1.0 + sin) - 1.0;
    INV_PI * sin * (acos(mu) - sin * mu + (2.0 / 3.0) * tail)
}

/// f · cos θi for diffuse albedo `rho` and `roughness` in (0, 1]; both directions above the surface.
#[inline]
pub fn eval(rho: Spectrum, roughness: f32, wo: Vec3, wi: Vec3) -> Spectrum {
    let a = 1.0 / (1.0 + C1 * roughness);
    let s = wo.x * wi.x + wo.y * wi.y;
    let ratio = if s > 0.0 { s / wo.z.max(wi.z) } else { s };
    // At opposite grazing directions 1 + s vanishes, up to rounding.
    let single = a * (1.0 + roughness * ratio).max(0.0);
    let lost = |mu: f32| (C1 - g(mu)).max(0.0);
    let multiple = a * roughness * lost(wo.z) * lost(wi.z) * (1.0 / (C1 - C2));
    (rho * single + rho_multiple(rho, roughness) * multiple) * (INV_PI * wi.z)
}

/// Share that comes back of what single scattering loses: the series of further bounces, each keeping `rho`.
#[inline]
fn rho_multiple(rho: Spectrum, roughness: f32) -> Spectrum {
    let average = average(roughness);
    rho.map(|r| r * r * average / (1.0 - r * (1.0 - average)))
}

/// Albedo of single scattering at ρ = 1, averaged over the hemisphere.
#[inline]
fn average(roughness: f32) -> f32 {
    (1.0 + C2 * roughness) / (1.0 + C1 * roughness)
}

/// Hemispherical albedo.
#[inline]
pub fn albedo(rho: Spectrum, roughness: f32) -> Spectrum {
    let average = average(roughness);
    rho * average + rho_multiple(rho, roughness) * (1.0 - average)
}

/// Probability of drawing about the direction of `wo` along the surface. Half of r sin θo would bound the weights most tightly; the
/// further factor accounts for t, and has the least variance of the forms tried.
#[inline]
fn prob_towards_viewer(roughness: f32, wo: Vec3) -> f32 {
    let share = 0.5 * roughness * safe_sqrt((1.0 - wo.z * wo.z) * (1.0 - wo.z));
    share / (1.0 + share)
}

/// Unit direction of `wo` along the surface; any one at normal incidence, where it is not drawn about.
#[inline]
fn along_surface(wo: Vec3) -> Vec3 {
    Vec3::new(wo.x, wo.y, 0.0).normalize_or(Vec3::X)
}

/// A direction above the surface, with density [`pdf`]. `u_lobe` chooses between the two cosines.
#[inline]
pub fn sample(roughness: f32, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Vec3 {
    let v = cosine_hemisphere(u);
    if u_lobe >= prob_towards_viewer(roughness, wo) {
        return v;
    }
    let x = along_surface(wo);
    let y = Vec3::new(-x.y, x.x, 0.0);
    x * v.z + y * v.y + Vec3::Z * v.x.abs()
}

/// Density of [`sample`], sr⁻¹; `wi.z > 0`.
#[inline]
pub fn pdf(roughness: f32, wo: Vec3, wi: Vec3) -> f32 {
    let p = prob_towards_viewer(roughness, wo);
    INV_PI * ((1.0 - p) * wi.z + p * 2.0 * along_surface(wo).dot(wi).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Its ends, and its mean: 2 ∫ g μ dμ.
    #[test]
    fn albedo_of_single_scattering() {
        assert!((g(0.0) - C1).abs() < 1e-7 && g(1.0).abs() < 1e-7);
        let n = 100_000;
        let mean: f64 = (0..n)
            .map(|i| (f64::from(i) + 0.5) / f64::from(n))
            .map(|mu| 2.0 * mu * f64::from(g(mu as f32)) / f64::from(n))
            .sum();
        assert!((mean - f64::from(C2)).abs() < 1e-6, "{mean} {C2}");
    }

    /// Towards the light a rough surface is brighter than Lambert at grazing angles, away from it darker.
    #[test]
    fn it_shines_back() {
        let [wo, away] = [1.0, -1.0].map(|s: f32| Vec3::new(0.8 * s, 0.0, 0.6));
        let lambert = INV_PI * 0.6;
        let white = |wi| eval(Spectrum::WHITE, 1.0, wo, wi).g;
        assert!(white(wo) > 1.5 * lambert && white(away) < 0.8 * lambert);
    }
}
