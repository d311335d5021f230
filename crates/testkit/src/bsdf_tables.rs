//! Quadrature behind the albedo tables of the microfacet models (`lumbre_core::bsdf::albedo`), in `f64` and without use of the
//! code it checks, and the text of their data file.
//!
//! E(μ, α) is the directional albedo of GGX reflection with height-correlated Smith masking and reflectance 1; B(μ, α) is the
//! same with the integrand times Schlick's (1 - wo·m)⁵. Integrated over the spherical cap of visible normals (Dupuy and Benyoub
//! 2023), where the integrand is the bounded ratio G2/G1 of Heitz 2018.

use lumbre_core::bsdf::albedo::{AVERAGES_PER_ROW, N_ALPHA, N_AVERAGE, N_MU, alpha_of_row, mu_of_column};
use std::f64::consts::PI;
use std::fmt::Write;

/// Points of the quadrature along the height and the azimuth of the cap.
const N_CAP: [usize; 2] = [768, 256];

/// What one cell of the tables is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Albedo {
    /// 1 - E.
    pub deficit: f64,
    /// B.
    pub schlick: f64,
}

/// Deficit and Schlick part at one cosine (in [0, 1]) and width (in (0, 1]), by the midpoint rule.
pub fn directional(mu: f64, alpha: f64) -> Albedo {
    let sin = (1.0 - mu * mu).max(0.0).sqrt();
    let stretched = |z: f64| (alpha * alpha * (1.0 - z * z) + z * z).sqrt();
    let lo = stretched(mu);
    let (wx, wz) = (alpha * sin / lo, mu / lo);
    let (mut deficit, mut schlick, mut total) = (0.0, 0.0, 0.0);
    for i in 0..N_CAP[0] {
        // v is the height above the cap's rim: cubed, because steep facets, which lose light, crowd at the rim.
        let s = (i as f64 + 0.5) / N_CAP[0] as f64;
        let (v, dv) = (s * s * s, 3.0 * s * s);
        let t = (1.0 - v) * (1.0 + wz);
        let (hz, radius) = (v * (1.0 + wz), (t * (2.0 - t)).max(0.0).sqrt());
        for j in 0..N_CAP[1] {
            let (sp, cp) = (PI * (j as f64 + 0.5) / N_CAP[1] as f64).sin_cos();
            let (mx, my, mz) = (alpha * (radius * cp + wx), alpha * radius * sp, hz);
            let len = (mx * mx + my * my + mz * mz).sqrt();
            let (mx, mz) = (mx / len, mz / len);
            let c = sin * mx + mu * mz;
            let zi = 2.0 * c * mz - mu;
            let g = if zi > 0.0 { zi * (mu + lo) / (zi * lo + mu * stretched(zi)) } else { 0.0 };
            deficit += dv * (1.0 - g);
            schlick += dv * g * (1.0 - c).max(0.0).powi(5);
            total += dv;
        }
    }
    Albedo { deficit: deficit / total, schlick: schlick / total }
}

/// The tables, `[row][column]`, and the averages by quarter row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tables {
    /// 1 - E.
    pub deficit: Vec<Vec<f64>>,
    /// B / E - (1 - μ)⁵.
    pub schlick_excess: Vec<Vec<f64>>,
    /// 2 ∫ (1 - E) μ dμ of the interpolated table, over α^1.5 to make it slow to change.
    pub deficit_average: Vec<f64>,
    /// 2 ∫ B μ dμ of the interpolated table.
    pub schlick_average: Vec<f64>,
}

/// One row: 1 - E and B / E - (1 - μ)⁵.
pub fn row(k: usize) -> [Vec<f64>; 2] {
    let alpha = alpha_of_row(k as f64);
    let at = |w: f64, f: &dyn Fn(f64, Albedo) -> f64| -> Vec<f64> {
        (0..N_MU).map(|j| mu_of_column(j, w)).map(|mu| f(mu, directional(mu, alpha))).collect()
    };
    let deficit = at(alpha, &|_, a| a.deficit);
    [deficit, at(alpha.sqrt(), &|mu, a| a.schlick / (1.0 - a.deficit) - (1.0 - mu).powi(5))]
}

impl Tables {
    /// Computes everything.
    pub fn new() -> Self {
        let mut tables = Tables::default();
        for [deficit, excess] in (0..N_ALPHA).map(row) {
            tables.deficit.push(deficit);
            tables.schlick_excess.push(excess);
        }
        for k in 0..N_AVERAGE {
            let k = k as f64 / AVERAGES_PER_ROW as f64;
            let average = tables.average(k);
            tables.deficit_average.push(average.deficit / alpha_of_row(k).powf(1.5));
            tables.schlick_average.push(average.schlick);
        }
        tables
    }

    /// Hemispherical averages of the bilinear interpolation at a fractional row.
    fn average(&self, k: f64) -> Albedo {
        let alpha = alpha_of_row(k);
        let i = (k as usize).min(N_ALPHA - 2);
        let lookup = |table: &[Vec<f64>], mu: f64, w: f64| {
            let p = (mu * (1.0 + w) / (mu + w)).sqrt() * (N_MU - 1) as f64;
            let j = (p as usize).min(N_MU - 2);
            let along = |row: &[f64]| row[j] + (row[j + 1] - row[j]) * (p - j as f64);
            let (a, b) = (along(&table[i]), along(&table[i + 1]));
            a + (b - a) * (k - i as f64)
        };
        let n = 10_000;
        let mut sum = Albedo { deficit: 0.0, schlick: 0.0 };
        for s in (0..n).map(|i| (i as f64 + 0.5) / n as f64) {
            // μ = s⁴ spreads the points over the narrow dip at grazing angles.
            let mu = s.powi(4);
            let weight = 8.0 * s.powi(7) / n as f64;
            let deficit = lookup(&self.deficit, mu, alpha);
            let schlick = (1.0 - mu).powi(5) + lookup(&self.schlick_excess, mu, alpha.sqrt());
            sum.deficit += weight * deficit;
            sum.schlick += weight * (1.0 - deficit) * schlick.max(0.0);
        }
        sum
    }
}

/// The text of `crates/core/src/bsdf/albedo_data.rs`, before formatting.
pub fn data_file() -> String {
    let tables = Tables::new();
    let mut out = String::from(
        "//! Data of [`super::albedo`], written by `cargo run --release -p lumbre-testkit --example bsdf_tables`. Do not edit.\n\
         #![allow(clippy::approx_constant, reason = \"a table meets π/4 by chance\")]\n\n\
         use super::albedo::{N_ALPHA, N_AVERAGE, N_MU};\n",
    );
    for (name, doc, table) in [
        ("DEFICIT", "1 - E by width and warped cosine.", &tables.deficit),
        ("SCHLICK_EXCESS", "B / E - (1 - μ)⁵ by width and warped cosine.", &tables.schlick_excess),
    ] {
        let _ = writeln!(out, "\n/// {doc}\npub static {name}: [[f32; N_MU]; N_ALPHA] = [");
        for row in table {
            let _ = writeln!(out, "    [{}],", literals(row));
        }
        out.push_str("];\n");
    }
    for (name, doc, values) in [
        ("DEFICIT_AVERAGE", "Hemispherical 1 - E by width, over α^1.5.", &tables.deficit_average),
        ("SCHLICK_AVERAGE", "Hemispherical B by width.", &tables.schlick_average),
    ] {
        let _ = writeln!(out, "\n/// {doc}\npub static {name}: [f32; N_AVERAGE] = [{}];", literals(values));
    }
    out
}

/// Numbers as a data file has them.
pub(crate) fn literals(values: &[f64]) -> String {
    let text: Vec<String> =
        values.iter().map(|v| format!("{:.4e}", if v.abs() < 1e-30 { 0.0 } else { *v })).collect();
    text.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_core::bsdf::albedo::AlbedoRow;

    #[test]
    fn quadrature_meets_the_closed_table() {
        for (alpha, mu, e) in
            [(1.0, 1.0, 0.3069), (1.0, 0.1, 0.7602), (0.5, 0.75, 0.6821), (0.5, 0.25, 0.7652)]
        {
            assert!((1.0 - directional(mu, alpha).deficit - e).abs() < 6e-5, "{alpha} {mu}");
        }
    }
    /// The checked-in tables are what the quadrature gives, to the digits printed.
    #[test]
    fn data_is_fresh() {
        for k in [0, 1, 7, 15, 24, N_ALPHA - 1] {
            let alpha = alpha_of_row(k as f64);
            let core = AlbedoRow::new(alpha as f32);
            let [deficit, excess] = row(k);
            for j in 0..N_MU {
                let got = core.deficit(mu_of_column(j, alpha) as f32);
                assert!(
                    (f64::from(got) - deficit[j]).abs() < 3e-5,
                    "row {k} column {j}: {got} {}",
                    deficit[j]
                );
                let mu = mu_of_column(j, alpha.sqrt());
                let d = core.directional(mu as f32);
                let want = (1.0 - f64::from(d.deficit)) * ((1.0 - mu).powi(5) + excess[j]).max(0.0);
                assert!((f64::from(d.schlick) - want).abs() < 3e-5, "row {k} column {j}: {d:?} {want}");
            }
        }
    }

    /// Between nodes, including narrow dips at grazing angles.
    #[test]
    fn interpolation_error_is_bounded() {
        for i in 0..10 {
            let roughness: f64 = 0.032 + 0.1 * i as f64 + 0.003 * (i * i % 7) as f64;
            let alpha = (roughness * roughness).min(1.0);
            let row = AlbedoRow::new(alpha as f32);
            for j in 0..30 {
                let mu = ((j as f64 + 0.5) / 30.0).powi(3);
                let (got, want) = (row.directional(mu as f32), directional(mu, alpha));
                assert!(
                    (f64::from(got.deficit) - want.deficit).abs() < 0.0012,
                    "{alpha} {mu}: {got:?} {want:?}"
                );
                assert!(
                    (f64::from(got.schlick) - want.schlick).abs() < 0.003,
                    "{alpha} {mu}: {got:?} {want:?}"
                );
            }
        }
    }

    /// Stored averages are those of the interpolated tables: what compensation relies on.
    #[test]
    fn averages_belong_to_the_interpolation() {
        for i in 0..30 {
            let alpha = (0.0317 + 0.9683 * f64::from(i) / 29.0).powi(2);
            let row = AlbedoRow::new(alpha as f32);
            let n = 5_000;
            let (mut deficit, mut schlick) = (0.0, 0.0);
            for s in (0..n).map(|i| (f64::from(i) + 0.5) / f64::from(n)) {
                let d = row.directional(s.powi(4) as f32);
                let weight = 8.0 * s.powi(7) / f64::from(n);
                deficit += weight * f64::from(d.deficit);
                schlick += weight * f64::from(d.schlick);
            }
            let average = row.average();
            assert!((f64::from(average.deficit) / deficit - 1.0).abs() < 3e-3, "{alpha}");
            assert!((f64::from(average.schlick) / schlick - 1.0).abs() < 1e-3, "{alpha}");
        }
    }
}
