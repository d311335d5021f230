//! Directional albedo of GGX reflection, tabulated: what single scattering returns, so that models can put back what it loses
//! (Kulla and Conty 2017) and layer without inventing light.
//!
//! E(μ, α) is the albedo for reflectance 1, B(μ, α) the part weighted by Schlick's (1 - wo·m)⁵; the albedo of a Schlick interface
//! is then exactly f0 (E - B) + f90 B. Stored are 1 - E over x = μ (1 + α) / (μ + α), a coordinate in which the dip of E at
//! cosines near α has the same width for every α, and the cosine c with B = E (1 - c)⁵, which is nearly μ itself. Rows are linear in √α.
//! Interpolation is within 0.002 of both E and B (tested where the tables are made: testkit `bsdf_tables`).

use super::albedo_data::{DEFICIT, DEFICIT_AVERAGE, SCHLICK_AVERAGE, SCHLICK_COS};
use crate::fresnel::schlick_weight;
use crate::math::lerp;
use crate::microfacet::ALPHA_SMOOTH;

/// Rows: widths.
pub const N_ALPHA: usize = 32;
/// Columns: cosines.
pub const N_MU: usize = 32;

/// √[`ALPHA_SMOOTH`]: the roughness of the first row.
const FIRST_ROUGHNESS: f32 = 0.031_622_776;

/// Width of row `k`, for the quadrature.
pub fn alpha_of_row(k: usize) -> f64 {
    let first = f64::from(ALPHA_SMOOTH).sqrt();
    (first + (1.0 - first) * k as f64 / (N_ALPHA - 1) as f64).powi(2)
}

/// Cosine of column `j` of the table of 1 - E in a row of width `alpha`, for the quadrature.
pub fn mu_of_column(j: usize, alpha: f64) -> f64 {
    let x = j as f64 / (N_MU - 1) as f64;
    alpha * x / (1.0 + alpha - x)
}

/// E and B at one cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Directional {
    /// 1 - E: what is lost at reflectance 1.
    pub deficit: f32,
    /// B: what Schlick's grazing weight returns.
    pub schlick: f32,
}

impl Directional {
    /// A perfectly smooth mirror.
    #[inline]
    pub fn smooth(mu: f32) -> Self {
        Directional { deficit: 0.0, schlick: schlick_weight(mu) }
    }
    /// Albedo of an interface with reflectance `f0` at normal and `f90` at grazing incidence.
    #[inline]
    pub fn reflected(self, f0: f32, f90: f32) -> f32 {
        f0 * (1.0 - self.deficit - self.schlick) + f90 * self.schlick
    }
    /// 1 - [`Directional::reflected`] as a sum of terms that are not negative for `f0 <= f90 <= 1`, so that nothing cancels.
    #[inline]
    pub fn passed(self, f0: f32, f90: f32) -> f32 {
        (1.0 - f90) + f90 * self.deficit + (f90 - f0) * (1.0 - self.deficit - self.schlick)
    }
}

/// The tables at one width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlbedoRow {
    alpha: f32,
    row: u32,
    frac: f32,
}

impl AlbedoRow {
    /// For a width from [`ALPHA_SMOOTH`] to 1.
    #[inline]
    pub fn new(alpha: f32) -> Self {
        let p = (alpha.sqrt() - FIRST_ROUGHNESS) * ((N_ALPHA - 1) as f32 / (1.0 - FIRST_ROUGHNESS));
        let row = (p.max(0.0) as u32).min(N_ALPHA as u32 - 2);
        AlbedoRow { alpha, row, frac: (p - row as f32).clamp(0.0, 1.0) }
    }

    /// The width it was made for.
    #[inline]
    pub fn alpha(&self) -> f32 {
        self.alpha
    }

    /// 1 - E at `mu` in [0, 1].
    #[inline]
    pub fn deficit(&self, mu: f32) -> f32 {
        self.lookup(&DEFICIT, mu * (1.0 + self.alpha) / (mu + self.alpha))
    }

    /// Both at `mu` in [0, 1].
    #[inline]
    pub fn directional(&self, mu: f32) -> Directional {
        let deficit = self.deficit(mu);
        let schlick = (1.0 - deficit) * schlick_weight(self.lookup(&SCHLICK_COS, mu));
        Directional { deficit, schlick }
    }

    /// Both averaged over the hemisphere with the cosine.
    #[inline]
    pub fn average(&self) -> Directional {
        let k = self.row as usize;
        Directional {
            // Stored over α^1.5, which changes slowly from row to row.
            deficit: lerp(DEFICIT_AVERAGE[k], DEFICIT_AVERAGE[k + 1], self.frac)
                * self.alpha
                * self.alpha.sqrt(),
            schlick: lerp(SCHLICK_AVERAGE[k], SCHLICK_AVERAGE[k + 1], self.frac),
        }
    }

    #[inline]
    fn lookup(&self, table: &[[f32; N_MU]; N_ALPHA], x: f32) -> f32 {
        let p = (x * (N_MU - 1) as f32).clamp(0.0, (N_MU - 1) as f32);
        let j = (p as usize).min(N_MU - 2);
        let t = p - j as f32;
        let (a, b) = (&table[self.row as usize], &table[self.row as usize + 1]);
        lerp(lerp(a[j], a[j + 1], t), lerp(b[j], b[j + 1], t), self.frac)
    }
}
