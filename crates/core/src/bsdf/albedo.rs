//! Directional albedo of GGX reflection, tabulated: what single scattering returns, so that models can put back what it loses
//! (Kulla and Conty 2017) and layer without inventing light.
//!
//! E(μ, α) is the albedo for reflectance 1, B(μ, α) the part weighted by Schlick's (1 - wo·m)⁵; the albedo of a Schlick interface
//! is then exactly f0 (E - B) + f90 B. Stored are 1 - E and the excess B/E - (1-μ)⁵, each over s = √(μ (1 + w) / (μ + w)): for 1 - E
//! with w = α, in which its peak at cosines near α has the same width in every row; for the excess with w = √α. Rows are linear in √α, hemispherical
//! averages (of the interpolated tables, so that compensation neither gains nor loses) are four times as dense.
//! Interpolation is within 0.0012 of E and 0.003 of B (tested where the tables are made: testkit `bsdf_tables`).

pub use super::albedo_data::{DEFICIT, DEFICIT_AVERAGE, SCHLICK_AVERAGE, SCHLICK_EXCESS};
use crate::fresnel::schlick_weight;
use crate::math::lerp;
use crate::microfacet::ALPHA_SMOOTH;

/// Rows: widths.
pub const N_ALPHA: usize = 32;
/// Columns: cosines.
pub const N_MU: usize = 32;
/// Hemispherical averages for each step between rows.
pub const AVERAGES_PER_ROW: usize = 4;
/// Hemispherical averages.
pub const N_AVERAGE: usize = AVERAGES_PER_ROW * (N_ALPHA - 1) + 1;

/// √[`ALPHA_SMOOTH`]: the roughness of the first row.
const FIRST_ROUGHNESS: f32 = 0.031_622_776;

/// Width at row `k`, which may be fractional, for the quadrature.
pub fn alpha_of_row(k: f64) -> f64 {
    let first = f64::from(ALPHA_SMOOTH).sqrt();
    let roughness = first + (1.0 - first) * k / (N_ALPHA - 1) as f64;
    roughness * roughness
}

/// Cosine of column `j` in a row with warp `w`, for the quadrature.
pub fn mu_of_column(j: usize, w: f64) -> f64 {
    cosine_at(j as f64 / (N_MU - 1) as f64, w)
}

/// Cosine at a position in [0, 1] along columns with warp `w`.
pub fn cosine_at(x: f64, w: f64) -> f64 {
    let x = x * x;
    w * x / (1.0 + w - x)
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
    roughness: f32,
    row: u32,
    frac: f32,
}

impl AlbedoRow {
    /// For a width from [`ALPHA_SMOOTH`] to 1.
    #[inline]
    pub fn new(alpha: f32) -> Self {
        let roughness = alpha.sqrt();
        let p = (roughness - FIRST_ROUGHNESS) * ((N_ALPHA - 1) as f32 / (1.0 - FIRST_ROUGHNESS));
        let row = (p.max(0.0) as u32).min(N_ALPHA as u32 - 2);
        AlbedoRow { alpha, roughness, row, frac: (p - row as f32).clamp(0.0, 1.0) }
    }

    /// The width it was made for.
    #[inline]
    pub fn alpha(&self) -> f32 {
        self.alpha
    }

    /// 1 - E at `mu` in [0, 1].
    #[inline]
    pub fn deficit(&self, mu: f32) -> f32 {
        self.lookup(&DEFICIT, column(mu, self.alpha, N_MU))
    }

    /// Both at `mu` in [0, 1].
    #[inline]
    pub fn directional(&self, mu: f32) -> Directional {
        let deficit = self.deficit(mu);
        let excess = self.lookup(&SCHLICK_EXCESS, column(mu, self.roughness, N_MU));
        Directional { deficit, schlick: (1.0 - deficit) * (schlick_weight(mu) + excess).max(0.0) }
    }

    /// Both averaged over the hemisphere with the cosine.
    #[inline]
    pub fn average(&self) -> Directional {
        let p = (self.row as f32 + self.frac) * AVERAGES_PER_ROW as f32;
        let k = (p as usize).min(N_AVERAGE - 2);
        let t = p - k as f32;
        Directional {
            // Stored over α^1.5, which changes slowly from row to row.
            deficit: lerp(DEFICIT_AVERAGE[k], DEFICIT_AVERAGE[k + 1], t) * self.alpha * self.roughness,
            schlick: lerp(SCHLICK_AVERAGE[k], SCHLICK_AVERAGE[k + 1], t),
        }
    }

    #[inline]
    fn lookup(&self, table: &[[f32; N_MU]; N_ALPHA], (j, t): (usize, f32)) -> f32 {
        let (a, b) = (&table[self.row as usize], &table[self.row as usize + 1]);
        lerp(lerp(a[j], a[j + 1], t), lerp(b[j], b[j + 1], t), self.frac)
    }
}

/// Column and fraction of a cosine among `n` with warp `w`.
#[inline]
pub(super) fn column(mu: f32, w: f32, n: usize) -> (usize, f32) {
    let s = (mu * (1.0 + w) / (mu + w)).sqrt();
    let p = (s * (n - 1) as f32).clamp(0.0, (n - 1) as f32);
    let j = (p as usize).min(n - 2);
    (j, p - j as f32)
}
