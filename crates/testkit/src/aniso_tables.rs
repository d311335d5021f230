//! Quadrature behind the albedo tables of anisotropic microfacets (`lumbre_core::bsdf::aniso_albedo`), in `f64`, and the
//! text of their data files.
//!
//! As in [`crate::bsdf_tables`], but for two widths and every azimuth: the bounded ratio G2/G1 of Heitz 2018, integrated over the spherical cap
//! of visible normals (Dupuy and Benyoub 2023).

use crate::bsdf_tables::Albedo;
use lumbre_core::bsdf::albedo::{AlbedoRow, cosine_at};
use lumbre_core::bsdf::aniso_albedo::{AVERAGES, AVERAGES_PER_STEP, SIZE, UNIT, alphas_at};
use std::f64::consts::PI;
use std::fmt::Write;

/// Points of the quadrature along the height and the azimuth of the cap.
const N_CAP: [usize; 2] = [224, 128];

/// Added to B/E at the horizon of the most stretched surface: what interpolation may lack there.
const SCHLICK_MARGIN: f64 = 0.04;

/// Deficit and Schlick part towards `w` (unit, z in (0, 1]) for the widths `alpha` along x and y, by the midpoint rule.
pub fn directional(w: [f64; 3], alpha: [f64; 2]) -> Albedo {
    let [ax, ay] = alpha;
    let stretched = |[x, y, z]: [f64; 3]| (ax * ax * x * x + ay * ay * y * y + z * z).sqrt();
    let length = stretched(w);
    let cap = [ax * w[0] / length, ay * w[1] / length, w[2] / length];
    let (mut deficit, mut schlick, mut total) = (0.0, 0.0, 0.0);
    for i in 0..N_CAP[0] {
        // v is the height above the cap's rim: cubed, because steep facets, which lose light, crowd at the rim.
        let s = (i as f64 + 0.5) / N_CAP[0] as f64;
        let (v, dv) = (s * s * s, 3.0 * s * s);
        let t = (1.0 - v) * (1.0 + cap[2]);
        let (hz, radius) = (v * (1.0 + cap[2]), (t * (2.0 - t)).max(0.0).sqrt());
        for j in 0..N_CAP[1] {
            let (sp, cp) = (2.0 * PI * (j as f64 + 0.5) / N_CAP[1] as f64).sin_cos();
            let m = [ax * (radius * cp + cap[0]), ay * (radius * sp + cap[1]), hz];
            let len = (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]).sqrt();
            let m = m.map(|c| c / len);
            let c = w[0] * m[0] + w[1] * m[1] + w[2] * m[2];
            let wi = [0, 1, 2].map(|k| 2.0 * c * m[k] - w[k]);
            let g = if wi[2] > 0.0 {
                wi[2] * (w[2] + length) / (wi[2] * length + w[2] * stretched(wi))
            } else {
                0.0
            };
            deficit += dv * (1.0 - g);
            schlick += dv * g * (1.0 - c).max(0.0).powi(5);
            total += dv;
        }
    }
    Albedo { deficit: deficit / total, schlick: schlick / total }
}

/// The direction with the given profiles, cosines in [0, 1]; `sharp` keeps a trace of height where both are 0.
fn direction(profiles: [f64; 2]) -> [f64; 3] {
    let [x, y] = profiles.map(|c| {
        let c = c.clamp(1e-7, 1.0);
        (1.0 / (c * c) - 1.0).sqrt()
    });
    let z = 1.0 / (1.0 + x * x + y * y).sqrt();
    [x * z, y * z, z]
}

/// B/E of the isotropic surface with the width of the profile along the azimuth of `w`.
fn share_along([x, y, z]: [f64; 3], [ax, ay]: [f64; 2]) -> f64 {
    let r2 = x * x + y * y;
    let width = if r2 < 1e-12 { ax } else { ((ax * ax * x * x + ay * ay * y * y) / r2).sqrt() };
    let at = AlbedoRow::new(width as f32).directional(z as f32);
    f64::from(at.schlick / (1.0 - at.deficit))
}

/// A node of the tables: 1 - E, and B/E less that of `share_along`, before the margins.
pub fn node([i, j, k, l]: [usize; 4]) -> [f64; 2] {
    let at = |i: usize, d: usize| i as f64 / (SIZE[d] - 1) as f64;
    let alpha = alphas_at(at(i, 0), at(j, 1));
    let profiles = |warp: [f64; 2]| direction([cosine_at(at(k, 2), warp[0]), cosine_at(at(l, 3), warp[1])]);
    let deficit = directional(profiles(alpha), alpha).deficit;
    let w = profiles(alpha.map(f64::sqrt));
    let there = directional(w, alpha);
    [deficit, there.schlick / (1.0 - there.deficit) - share_along(w, alpha)]
}

/// 1 - E less what linear interpolation adds to it between nodes: most, 0.01, where it is near 0.03 and curves, and the widths (`v`: share
/// of the smaller one) are alike, which profiles describe least well.
fn lowered(deficit: f64, v: f64) -> f64 {
    let most = 0.02 + 0.015 * v;
    deficit - most * deficit / (deficit + most) * 0.05 / (deficit + 0.05)
}

/// A node with its margins, in stored units.
pub fn stored([i, j, k, l]: [usize; 4]) -> [i16; 2] {
    let [deficit, residual] = node([i, j, k, l]);
    let at = |i: usize, d: usize| i as f64 / (SIZE[d] - 1) as f64;
    let alpha = alphas_at(at(i, 0), at(j, 1)).map(f64::sqrt);
    let mu = direction([cosine_at(at(k, 2), alpha[0]), cosine_at(at(l, 3), alpha[1])])[2];
    let margin = SCHLICK_MARGIN * (1.0 - at(j, 1)) * (1.0 - mu).powi(30);
    [lowered(deficit, at(j, 1)), residual + margin].map(|v| (v / f64::from(UNIT)).round() as i16)
}

/// Both tables and the averages of their interpolation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tables {
    /// 1 - E and the residual of B/E, in stored units.
    pub nodes: [Vec<i16>; 2],
    /// 2 ∫ (1 - E) μ dμ, mean over the azimuth, over α^1.5 of the larger width; rows by the larger width.
    pub deficit_average: Vec<Vec<f64>>,
    /// The same of B, as it is.
    pub schlick_average: Vec<Vec<f64>>,
}

impl Tables {
    /// Computes everything.
    pub fn new() -> Self {
        let mut tables = Tables::default();
        for index in 0..SIZE.iter().product() {
            let [l, k] = [index % SIZE[3], index / SIZE[3] % SIZE[2]];
            let rest = index / (SIZE[3] * SIZE[2]);
            let [deficit, residual] = stored([rest / SIZE[1], rest % SIZE[1], k, l]);
            tables.nodes[0].push(deficit);
            tables.nodes[1].push(residual);
        }
        for i in 0..AVERAGES[0] {
            let (mut deficit, mut schlick) = (Vec::new(), Vec::new());
            for j in 0..AVERAGES[1] {
                let at = [(i, 0), (j, 1)].map(|(i, d)| i as f64 / AVERAGES_PER_STEP[d] as f64);
                let average = tables.average(at);
                let [alpha, _] = alphas_at(at[0] / (SIZE[0] - 1) as f64, 0.0);
                deficit.push(average.deficit / alpha.powf(1.5));
                schlick.push(average.schlick);
            }
            tables.deficit_average.push(deficit);
            tables.schlick_average.push(schlick);
        }
        tables
    }

    fn lookup(&self, table: usize, [u, v]: [f64; 2], w: [f64; 3], warp: [f64; 2]) -> f64 {
        let profile = |x: f64| w[2] / (x * x + w[2] * w[2]).sqrt();
        let column = |c: f64, w: f64, d: usize| (c * (1.0 + w) / (c + w)).sqrt() * (SIZE[d] - 1) as f64;
        let at = [u, v, column(profile(w[0]), warp[0], 2), column(profile(w[1]), warp[1], 3)];
        let mut sum = 0.0;
        for corner in 0..16 {
            let (mut index, mut weight) = (0, 1.0);
            for d in 0..4 {
                let (i, far) = ((at[d] as usize).min(SIZE[d] - 2), corner >> d & 1);
                let t = at[d] - i as f64;
                index = index * SIZE[d] + i + far;
                weight *= if far == 1 { t } else { 1.0 - t };
            }
            sum += weight * f64::from(self.nodes[table][index]);
        }
        sum * f64::from(UNIT)
    }

    /// Hemispherical averages at a position in steps of the table.
    fn average(&self, at: [f64; 2]) -> Albedo {
        let alpha = alphas_at(at[0] / (SIZE[0] - 1) as f64, at[1] / (SIZE[1] - 1) as f64);
        let (n_mu, n_phi) = (192, 48);
        let mut sum = Albedo { deficit: 0.0, schlick: 0.0 };
        for s in (0..n_mu).map(|i| (f64::from(i) + 0.5) / f64::from(n_mu)) {
            // μ = s⁴ spreads the points over the narrow dip at grazing angles.
            let mu = s.powi(4);
            let weight = 8.0 * s.powi(7) / f64::from(n_mu) / f64::from(n_phi);
            for j in 0..n_phi {
                let (sp, cp) = (0.5 * PI * (f64::from(j) + 0.5) / f64::from(n_phi)).sin_cos();
                let sin = (1.0 - mu * mu).sqrt();
                let w = [sin * cp, sin * sp, mu];
                let deficit = self.lookup(0, at, w, alpha).clamp(0.0, 1.0);
                let share = share_along(w, alpha) + self.lookup(1, at, w, alpha.map(f64::sqrt));
                sum.deficit += weight * deficit;
                sum.schlick += weight * (1.0 - deficit) * share.clamp(0.0, 1.0);
            }
        }
        sum
    }

    /// The text of `crates/core/src/bsdf/aniso_albedo_deficit.rs` and `…_schlick.rs`, before formatting.
    pub fn data_files(&self) -> [String; 2] {
        let texts = [
            ("deficit", "DEFICIT", "1 - E", "DEFICIT_AVERAGE", "1 - E, over α^1.5"),
            ("schlick", "SCHLICK_RESIDUAL", "B/E less the isotropic one", "SCHLICK_AVERAGE", "B"),
        ];
        let averages = [&self.deficit_average, &self.schlick_average];
        [0, 1].map(|t| {
            let (file, name, what, name_average, what_average) = texts[t];
            let mut out = format!(
                "//! Data of [`super::aniso_albedo`], written by `cargo run -p lumbre-testkit --example aniso_tables {file}`. Do \
                 not edit.\n\nuse super::aniso_albedo::{{AVERAGES, NODES}};\n\n\
                 /// {what} by widths and profiles.\npub static {name}: [i16; NODES] = ["
            );
            for value in &self.nodes[t] {
                let _ = write!(out, "{value}, ");
            }
            let _ = write!(
                out,
                "];\n\n/// Hemispherical {what_average}, by widths.\n\
                 pub static {name_average}: [[f32; AVERAGES[1]]; AVERAGES[0]] = ["
            );
            for row in averages[t] {
                let row: Vec<String> = row.iter().map(|v| format!("{v:.3e}")).collect();
                let _ = write!(out, "[{}],", row.join(", "));
            }
            out.push_str("];\n");
            out
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bsdf_tables;
    use lumbre_core::bsdf::aniso_albedo::AnisoRow;
    use lumbre_core::hash::unit;
    use lumbre_core::math::Vec3;
    use lumbre_core::microfacet::Ggx;

    fn to_vec3([x, y, z]: [f64; 3]) -> Vec3 {
        Vec3::new(x as f32, y as f32, z as f32)
    }

    #[test]
    fn equal_widths_are_the_isotropic_quadrature() {
        for (mu, alpha) in [(0.9, 0.5), (0.2, 0.1), (0.05, 1.0)] {
            let sin = f64::sqrt(1.0 - mu * mu);
            let (got, want) =
                (directional([sin * 0.6, sin * 0.8, mu], [alpha; 2]), bsdf_tables::directional(mu, alpha));
            assert!((got.deficit - want.deficit).abs() < 2e-4, "{got:?} {want:?}");
            assert!((got.schlick - want.schlick).abs() < 2e-4, "{got:?} {want:?}");
        }
    }

    /// The checked-in nodes are what the quadrature gives, some hundred of them.
    #[test]
    fn data_is_fresh() {
        for k in 0..150u32 {
            // Where the larger width is the smallest there is no smaller one: the first row is left out.
            let first = [1, 0, 0, 0];
            let node =
                [0, 1, 2, 3].map(|d| first[d] + (unit(k, d as u32) * (SIZE[d] - first[d]) as f32) as usize);
            let at = |d: usize| node[d] as f64 / (SIZE[d] - 1) as f64;
            let alpha = alphas_at(at(0), at(1));
            let ggx = Ggx { alpha_x: alpha[0] as f32, alpha_y: alpha[1] as f32 };
            let w = direction([cosine_at(at(2), alpha[0]), cosine_at(at(3), alpha[1])]);
            let got = AnisoRow::new(&ggx).deficit(to_vec3(w));
            let want = f32::from(stored(node)[0]) * UNIT;
            // With both profiles at the horizon positions lose digits.
            let limit = if node[2].min(node[3]) == 0 { 2e-3 } else { 3e-4 };
            assert!((got - want).abs() < limit, "{node:?}: {got} {want}");
        }
    }

    /// Between nodes, over the whole domain: as far off as the documentation says.
    #[test]
    fn interpolation_error_is_bounded() {
        let (mut low, mut high) = ([0.0f64; 2], [0.0f64; 2]);
        for k in 0..1_500u32 {
            let u = [0, 1, 2, 3].map(|d| f64::from(unit(k, d)));
            let alpha = alphas_at(u[0], u[1]);
            let mu = 1e-3 + 0.999 * u[2] * u[2];
            let sin = (1.0 - mu * mu).sqrt();
            let (sp, cp) = (0.5 * PI * u[3]).sin_cos();
            let w = [sin * cp, sin * sp, mu];
            let ggx = Ggx { alpha_x: alpha[0] as f32, alpha_y: alpha[1] as f32 };
            let (got, want) = (AnisoRow::new(&ggx).directional(to_vec3(w)), directional(w, alpha));
            let off = [f64::from(got.deficit) - want.deficit, f64::from(got.schlick) - want.schlick];
            for t in 0..2 {
                low[t] = low[t].min(off[t]);
                high[t] = high[t].max(off[t]);
            }
        }
        assert!(low[0] > -0.014 && high[0] < 0.008, "deficit {} {}", low[0], high[0]);
        assert!(low[1] > -0.02 && high[1] < 0.11, "schlick {} {}", low[1], high[1]);
        // Tight: a table half a percent further off would be found.
        assert!(low[0] < -0.008 && high[0] > 0.003 && high[1] > 0.05, "{low:?} {high:?}");
    }

    /// Stored averages are those of the interpolated tables: what compensation relies on.
    #[test]
    fn averages_belong_to_the_interpolation() {
        for k in 0..40u32 {
            let alpha = alphas_at(f64::from(unit(k, 7)), f64::from(unit(k, 8)));
            let row = AnisoRow::new(&Ggx { alpha_x: alpha[0] as f32, alpha_y: alpha[1] as f32 });
            let (n_mu, n_phi) = (200, 40);
            let (mut deficit, mut schlick) = (0.0, 0.0);
            for s in (0..n_mu).map(|i| (f64::from(i) + 0.5) / f64::from(n_mu)) {
                let weight = 8.0 * s.powi(7) / f64::from(n_mu) / f64::from(n_phi);
                for j in 0..n_phi {
                    let (sp, cp) = (0.5 * PI * (f64::from(j) + 0.5) / f64::from(n_phi)).sin_cos();
                    let sin = (1.0 - s.powi(8)).sqrt();
                    let d = row.directional(to_vec3([sin * cp, sin * sp, s.powi(4)]));
                    deficit += weight * f64::from(d.deficit);
                    schlick += weight * f64::from(d.schlick);
                }
            }
            let average = row.average();
            assert!(
                (f64::from(average.deficit) / deficit - 1.0).abs() < 1.5e-2,
                "{alpha:?} {average:?} {deficit}"
            );
            assert!((f64::from(average.schlick) - schlick).abs() < 5e-4, "{alpha:?} {average:?} {schlick}");
        }
    }
}
