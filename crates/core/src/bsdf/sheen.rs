//! Sheen: upright fibres that shine at grazing angles (KHR_materials_sheen).
//!
//! Microfacets of reflectance 1, tinted, with the distribution "Charlie" (Estevez and Kulla 2017): D = (2 + p) sinᵖθ / 2π, p = 1/α,
//! α = roughness². For their masking the authors fitted a curve that holds from roughness 0.3 or so; below, it returns up to nine times the
//! light it gets. Smith's masking of the same facets (Heitz 2014) returns at most 1 by construction. It needs the area that facets
//! show to a direction, σ(θ) = ∫ D ⟨m·ω⟩ dm, which has no closed form; but cos θ / 2 + √(¼ + k sin²θ), the form that it has exactly for GGX, bounds
//! it from above when k = σ(90°)² - ¼, by 4 % at most, and by less than 1 % where the lobe is bright. So
//!
//!   V = 1 / (4 (μo ηi + μi ηo)), η(μ) = √(¼ + k (1 - μ²)),
//!
//! height-correlated, reciprocal, and darker than Smith's: it never gains. k comes from Watson's bound of a ratio of gamma functions
//! (Watson 1959): σ(90°)² <= (2 + p)² / (π (2p + 5)), off by 1 % at most. From roughness 0.3 and above a cosine of 0.05 the albedo
//! is within 0.1 of that of the authors' fit, which falls again towards the horizon; at lower roughness it is darker, as it must be.
//!
//! Left out: multiple scattering between fibres, and the authors' softening of the terminator, which is not reciprocal.

pub use super::sheen_data::{AVERAGE, DIRECTIONAL};
use crate::math::{INV_PI, PI, Vec3, exp, lerp, ln, pow, safe_sqrt, sin_cos, sqr};
use crate::rgb::Spectrum;

/// Rows of the albedo table: roughnesses.
pub const N_ROUGHNESS: usize = 32;
/// Columns of the albedo table: cosines.
pub const N_MU: usize = 32;
/// Narrower fibres are not told apart: their sheen is confined to the last degrees before the horizon.
pub const MIN_ROUGHNESS: f32 = 0.05;

/// Added to the albedo when choosing: interpolation may round a faint sheen to none.
const ALBEDO_FLOOR: f32 = 0.01;

/// Roughness of row `k`, for the quadrature.
pub fn roughness_of_row(k: usize) -> f64 {
    let first = f64::from(MIN_ROUGHNESS);
    first + (1.0 - first) * k as f64 / (N_ROUGHNESS - 1) as f64
}

/// Cosine of column `j` in a row of the given roughness, for the quadrature.
pub fn mu_of_column(j: usize, roughness: f64) -> f64 {
    let x = j as f64 / (N_MU - 1) as f64;
    let x = x * x;
    (roughness * x / (1.0 + roughness - x)).min(1.0)
}

/// A layer of fibres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheen {
    color: Spectrum,
    color_mean: f32,
    color_max: f32,
    roughness: f32,
    /// p = 1/α.
    exponent: f32,
    /// (2 + p) / 8π: of D and V.
    scale: f32,
    /// k of the shown area.
    k: f32,
    row: usize,
    frac: f32,
}

impl Sheen {
    /// `color` in [0, 1]; `roughness` perceptual.
    #[inline]
    pub fn new(color: Spectrum, roughness: f32) -> Self {
        // Written so that NaN counts as the least.
        let roughness = if roughness > MIN_ROUGHNESS { roughness.min(1.0) } else { MIN_ROUGHNESS };
        let exponent = 1.0 / (roughness * roughness);
        let p = (roughness - MIN_ROUGHNESS) * ((N_ROUGHNESS - 1) as f32 / (1.0 - MIN_ROUGHNESS));
        let row = (p as usize).min(N_ROUGHNESS - 2);
        Sheen {
            color,
            color_mean: color.average(),
            color_max: color.max_component(),
            roughness,
            exponent,
            scale: (2.0 + exponent) * (0.125 * INV_PI),
            k: sqr(2.0 + exponent) * INV_PI / (2.0 * exponent + 5.0) - 0.25,
            row,
            frac: p - row as f32,
        }
    }

    /// What white fibres return of light from all around, at `mu` in [0, 1].
    #[inline]
    pub fn directional(&self, mu: f32) -> f32 {
        let s = (mu * (1.0 + self.roughness) / (mu + self.roughness)).sqrt();
        let p = (s * (N_MU - 1) as f32).min((N_MU - 1) as f32);
        let j = (p as usize).min(N_MU - 2);
        let along = |row: &[f32; N_MU]| lerp(row[j], row[j + 1], p - j as f32);
        lerp(along(&DIRECTIONAL[self.row]), along(&DIRECTIONAL[self.row + 1]), self.frac)
    }

    /// The same averaged over the hemisphere with the cosine.
    #[inline]
    pub fn average(&self) -> f32 {
        lerp(AVERAGE[self.row], AVERAGE[self.row + 1], self.frac)
    }

    /// Hemispherical albedo.
    #[inline]
    pub fn albedo(&self) -> Spectrum {
        self.color * self.average()
    }

    /// Share of light that the layer leaves to what lies beneath, given [`Sheen::directional`]: by the strongest band, so
    /// that a coloured sheen does not give what lies beneath the complementary tint (KHR_materials_sheen).
    #[inline]
    pub fn passed(&self, directional: f32) -> f32 {
        1.0 - self.color_max * directional
    }

    /// The share of light for choosing a layer, given [`Sheen::directional`].
    #[inline]
    pub fn importance(&self, directional: f32) -> f32 {
        self.color_mean * (directional + ALBEDO_FLOOR)
    }

    /// f · cos θi; both directions above the surface.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        let cos = (wo + wi).normalize().z;
        let sin2 = (1.0 - cos) * (1.0 + cos);
        let eta = |mu: f32| (0.25 + self.k * ((1.0 - mu) * (1.0 + mu)).max(0.0)).sqrt();
        let shown = wo.z * eta(wi.z) + wi.z * eta(wo.z);
        self.color * (self.scale * pow(sin2.max(0.0), 0.5 * self.exponent) * wi.z / shown)
    }

    /// Rate of the exponential by which heights are drawn. With t = μo + μi the lobe, summed over the azimuth, falls as
    /// erfc(t / √8α) μi / t: from μo = 0 within about two roughnesses, from larger μo at the rate μo / 4α. Half that rate and
    /// a width of two roughnesses keep every weight below three times the mean.
    #[inline]
    fn rate(&self, mu: f32) -> f32 {
        0.5 / self.roughness + 0.12 * self.exponent * mu
    }

    /// Width γ of the azimuth about that of `wo`, at the cosines `mu` and `cos` with sines `sin_o` and `sin_i`. In x = tan(φ/2)
    /// the lobe is close to exp(-β x²) / (1 + x²), and uniform azimuths are a Cauchy distribution of width 1: a narrower one serves.
    #[inline]
    fn width(&self, (mu, sin_o): (f32, f32), (cos, sin_i): (f32, f32)) -> f32 {
        let sines = sin_o * sin_i;
        let beta = 0.5 * self.exponent * sines * sqr((mu + cos) / (1.0 + mu * cos + sines));
        1.0 / (1.0 + 3.0 * beta).sqrt()
    }

    /// A direction above the surface (or on its horizon), with density [`Sheen::pdf`].
    #[inline]
    pub fn sample(&self, wo: Vec3, u: [f32; 2]) -> Vec3 {
        let rate = self.rate(wo.z);
        let cos = (-ln(1.0 - u[0] * (1.0 - exp(-rate))) / rate).clamp(0.0, 1.0);
        let (sin_o, sin_i) = (wo.truncate().length(), safe_sqrt((1.0 - cos) * (1.0 + cos)));
        let gamma = self.width((wo.z, sin_o), (cos, sin_i));
        // x = γ tan ψ, and the azimuth from x without its angle.
        let (s, c) = sin_cos(PI * (u[1] - 0.5));
        let (a, b) = (c * c, sqr(gamma * s));
        let (cos_phi, sin_phi) = ((a - b) / (a + b), 2.0 * gamma * s * c / (a + b));
        let (x, y) = if sin_o > 0.0 { (wo.x / sin_o, wo.y / sin_o) } else { (1.0, 0.0) };
        Vec3::new(sin_i * (x * cos_phi - y * sin_phi), sin_i * (y * cos_phi + x * sin_phi), cos)
    }

    /// Density of [`Sheen::sample`], sr⁻¹; `wi.z > 0`.
    #[inline]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        let rate = self.rate(wo.z);
        let height = rate * exp(-rate * wi.z) / (1.0 - exp(-rate));
        let (o, i) = (wo.truncate(), wi.truncate());
        let (sin_o, sin_i) = (o.length(), i.length());
        let gamma = self.width((wo.z, sin_o), (wi.z, sin_i));
        let sines = sin_o * sin_i;
        let cos_phi = if sines > 0.0 { (o.dot(i) / sines).clamp(-1.0, 1.0) } else { 1.0 };
        height * gamma * INV_PI / (sqr(gamma) * (1.0 + cos_phi) + (1.0 - cos_phi))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Area shown by the facets to a direction, by quadrature: the azimuth in closed form.
    fn shown_area(mu: f64, p: f64) -> f64 {
        let (n, sin) = (20_000, (1.0 - mu * mu).sqrt());
        (0..n)
            .map(|i| (f64::from(i) + 0.5) / f64::from(n))
            .map(|s| {
                // Heights crowd at 0, where the facets are when p is large.
                let (z, dz) = (s * s, 2.0 * s / f64::from(n));
                let (a, b) = (mu * z, sin * (1.0 - z * z).sqrt());
                let edge = if b > 0.0 { (-a / b).clamp(-1.0, 1.0).acos() } else { std::f64::consts::PI };
                let d = (2.0 + p) / (2.0 * std::f64::consts::PI) * (1.0 - z * z).powf(0.5 * p);
                2.0 * d * (a * edge + b * edge.sin()) * dz
            })
            .sum()
    }

    #[test]
    fn masking_is_bounded_by_smiths() {
        for roughness in [0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0f32] {
            let sheen = Sheen::new(Spectrum::WHITE, roughness);
            for mu in [0.0, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97, 0.99, 0.999, 1.0] {
                let exact = shown_area(mu, f64::from(sheen.exponent));
                let bound = 0.5 * mu + (0.25 + f64::from(sheen.k) * (1.0 - mu * mu)).sqrt();
                let ratio = bound / exact;
                assert!(ratio > 1.0 - 1e-4 && ratio < 1.045, "{roughness} {mu}: {ratio}");
                if mu <= 0.5 {
                    assert!(ratio < 1.016, "{roughness} {mu}: {ratio}");
                }
            }
        }
    }

    /// Facets seen from above show their whole ground.
    #[test]
    fn distribution_is_normalised() {
        for p in [1.0, 10.0, 400.0] {
            assert!((shown_area(1.0, p) - 1.0).abs() < 1e-6);
        }
    }
}
