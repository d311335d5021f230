//! Directional albedo of anisotropic GGX reflection: E and B of [`super::albedo`] for two widths.
//!
//! Four dimensions: the larger and the smaller width, and the direction by its two profiles, the cosines of the angles that
//! its projections onto the xz and the yz plane make with the normal. In these the limit is simple: with the smaller width
//! 0 the surface is a stack of grooves, and E depends on the xz profile alone. Columns are spaced as in
//! [`super::albedo`], about the width along their axis for 1 - E, about its root for B. Of B/E the tables hold the difference to
//! the isotropic surface that is as rough as this one is along the azimuth of the direction, which has the narrow part at grazing angles.
//!
//! The tables lean to the safe side, so that compensation and layering do not gain light: 1 - E is stored a little too small, B
//! a little too large near the horizon. 1 - E lies between -0.014 and +0.008 of the truth, B between -0.02 and
//! +0.11 (tested where the tables are made: testkit `aniso_tables`). Averages over the hemisphere are those of the interpolation.

use super::albedo::{AlbedoRow, Directional, column};
pub use super::aniso_albedo_deficit::{DEFICIT, DEFICIT_AVERAGE};
pub use super::aniso_albedo_schlick::{SCHLICK_AVERAGE, SCHLICK_RESIDUAL};
use crate::math::{Vec3, lerp};
use crate::microfacet::Ggx;

/// Nodes: larger width, share of the smaller one, xz profile, yz profile.
pub const SIZE: [usize; 4] = [10, 6, 12, 12];
/// Number of nodes.
pub const NODES: usize = SIZE[0] * SIZE[1] * SIZE[2] * SIZE[3];
/// Unit of the stored integers.
pub const UNIT: f32 = 1e-4;
/// Hemispherical averages for each step of the two widths.
pub const AVERAGES_PER_STEP: [usize; 2] = [4, 4];
/// Hemispherical averages by larger and smaller width.
pub const AVERAGES: [usize; 2] =
    [AVERAGES_PER_STEP[0] * (SIZE[0] - 1) + 1, AVERAGES_PER_STEP[1] * (SIZE[1] - 1) + 1];

/// √[`crate::microfacet::ALPHA_SMOOTH`]: the smallest roughness.
const FIRST_ROUGHNESS: f32 = 0.031_622_776;

/// Both widths (larger first) at positions in [0, 1] of the first two dimensions, for the quadrature.
pub fn alphas_at(u: f64, v: f64) -> [f64; 2] {
    let first = f64::from(FIRST_ROUGHNESS);
    let x = first + (1.0 - first) * u;
    let y = first + (x - first) * v;
    [x * x, y * y]
}

/// The tables at one pair of widths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnisoRow {
    alpha_x: f32,
    alpha_y: f32,
    /// Position among the larger widths, in steps of the table.
    u: f32,
    /// Position among the smaller widths.
    v: f32,
}

impl AnisoRow {
    /// For widths from [`crate::microfacet::ALPHA_SMOOTH`] to 1, the larger one along x.
    pub fn new(ggx: &Ggx) -> Self {
        let (x, y) = (ggx.alpha_x.sqrt(), ggx.alpha_y.sqrt());
        let range = (x - FIRST_ROUGHNESS).max(0.0);
        let v = if range > 1e-6 { ((y - FIRST_ROUGHNESS) / range).clamp(0.0, 1.0) } else { 1.0 };
        AnisoRow {
            alpha_x: ggx.alpha_x,
            alpha_y: ggx.alpha_y,
            u: range * ((SIZE[0] - 1) as f32 / (1.0 - FIRST_ROUGHNESS)),
            v: v * (SIZE[1] - 1) as f32,
        }
    }

    /// The larger width.
    #[inline]
    pub fn alpha(&self) -> f32 {
        self.alpha_x
    }

    /// 1 - E towards `w`, on either side.
    pub fn deficit(&self, w: Vec3) -> f32 {
        self.lookup(&DEFICIT, w, [self.alpha_x, self.alpha_y]).clamp(0.0, 1.0)
    }

    /// Both towards `w`.
    pub fn directional(&self, w: Vec3) -> Directional {
        let deficit = self.deficit(w);
        let along = AlbedoRow::new(self.width_along(w)).directional(w.z.abs());
        let residual = self.lookup(&SCHLICK_RESIDUAL, w, [self.alpha_x.sqrt(), self.alpha_y.sqrt()]);
        let share = along.schlick / (1.0 - along.deficit) + residual;
        Directional { deficit, schlick: (1.0 - deficit) * share.clamp(0.0, 1.0) }
    }

    /// Both averaged over the hemisphere with the cosine.
    pub fn average(&self) -> Directional {
        let steps = AVERAGES_PER_STEP.map(|n| n as f32);
        let (i, s) = cell(self.u * steps[0], AVERAGES[0]);
        let (j, t) = cell(self.v * steps[1], AVERAGES[1]);
        let at = |table: &[[f32; AVERAGES[1]]; AVERAGES[0]]| {
            lerp(lerp(table[i][j], table[i][j + 1], t), lerp(table[i + 1][j], table[i + 1][j + 1], t), s)
        };
        Directional {
            // Stored over α^1.5, which changes slowly.
            deficit: at(&DEFICIT_AVERAGE) * self.alpha_x * self.alpha_x.sqrt(),
            schlick: at(&SCHLICK_AVERAGE),
        }
    }

    /// Width of the profile in the vertical plane of `w`: α² = αx² cos²φ + αy² sin²φ (Heitz 2014).
    fn width_along(&self, w: Vec3) -> f32 {
        let r2 = w.x * w.x + w.y * w.y;
        if r2 < 1e-12 {
            return self.alpha_x;
        }
        let (x, y) = (self.alpha_x * w.x, self.alpha_y * w.y);
        ((x * x + y * y) / r2).sqrt()
    }

    fn lookup(&self, table: &[i16; NODES], w: Vec3, warp: [f32; 2]) -> f32 {
        let profile = |tangent: f32| {
            let len = (tangent * tangent + w.z * w.z).sqrt();
            if len > 0.0 { (w.z.abs() / len).min(1.0) } else { 1.0 }
        };
        let at = [
            cell(self.u, SIZE[0]),
            cell(self.v, SIZE[1]),
            column(profile(w.x), warp[0], SIZE[2]),
            column(profile(w.y), warp[1], SIZE[3]),
        ];
        let mut sum = 0.0;
        for corner in 0..16 {
            let (mut index, mut weight) = (0, 1.0);
            for (d, &(i, t)) in at.iter().enumerate() {
                let far = corner >> d & 1;
                index = index * SIZE[d] + i + far;
                weight *= if far == 1 { t } else { 1.0 - t };
            }
            sum += weight * f32::from(table[index]);
        }
        sum * UNIT
    }
}

/// Cell and fraction of a position among `n` nodes.
#[inline]
fn cell(p: f32, n: usize) -> (usize, f32) {
    let p = p.clamp(0.0, (n - 1) as f32);
    let i = (p as usize).min(n - 2);
    (i, p - i as f32)
}

/// The same for both kinds of surface: one width, or two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Albedo {
    /// The same width in all directions.
    Isotropic(AlbedoRow),
    /// Two widths.
    Anisotropic(AnisoRow),
}

impl Albedo {
    /// For the distribution of the interface.
    #[inline]
    pub fn new(ggx: &Ggx) -> Self {
        if ggx.is_anisotropic() {
            Albedo::Anisotropic(AnisoRow::new(ggx))
        } else {
            Albedo::Isotropic(AlbedoRow::new(ggx.alpha_x))
        }
    }

    /// The larger width.
    #[inline]
    pub fn alpha(&self) -> f32 {
        match self {
            Albedo::Isotropic(row) => row.alpha(),
            Albedo::Anisotropic(row) => row.alpha(),
        }
    }

    /// 1 - E towards `w`, on either side.
    #[inline]
    pub fn deficit(&self, w: Vec3) -> f32 {
        match self {
            Albedo::Isotropic(row) => row.deficit(w.z.abs()),
            Albedo::Anisotropic(row) => row.deficit(w),
        }
    }

    /// E and B towards `w`, on either side.
    #[inline]
    pub fn directional(&self, w: Vec3) -> Directional {
        match self {
            Albedo::Isotropic(row) => row.directional(w.z.abs()),
            Albedo::Anisotropic(row) => row.directional(w),
        }
    }

    /// Both averaged over the hemisphere with the cosine.
    #[inline]
    pub fn average(&self) -> Directional {
        match self {
            Albedo::Isotropic(row) => row.average(),
            Albedo::Anisotropic(row) => row.average(),
        }
    }
}
