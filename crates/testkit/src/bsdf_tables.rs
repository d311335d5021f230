//! Quadrature behind the albedo tables of the microfacet models (`lumbre_core::bsdf::albedo`), in `f64` and without use of the
//! code it checks, and the text of their data file.
//!
//! E(μ, α) is the directional albedo of GGX reflection with height-correlated Smith masking and reflectance 1; B(μ, α) is the
//! same with the integrand times Schlick's (1 - wo·m)⁵. Integrated over the spherical cap of visible normals (Dupuy and Benyoub
//! 2023), where the integrand is the bounded ratio G2/G1 of Heitz 2018.

use lumbre_core::bsdf::albedo::{N_ALPHA, N_MU, alpha_of_row, mu_of_column};
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

/// One row of the tables.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// 1 - E at each column's cosine.
    pub deficit: Vec<f64>,
    /// Effective cosine c with B = E (1 - c)⁵, at equidistant cosines.
    pub schlick_cos: Vec<f64>,
    /// 2 ∫ (1 - E) μ dμ of the interpolated row, over α^1.5 to make it slow to change.
    pub deficit_average: f64,
    /// 2 ∫ B μ dμ of the interpolated row.
    pub schlick_average: f64,
}

/// Effective Schlick cosine at one point.
pub fn schlick_cos(mu: f64, alpha: f64) -> f64 {
    let a = directional(mu, alpha);
    1.0 - (a.schlick / (1.0 - a.deficit)).powf(0.2)
}

/// Computes row `k`.
pub fn row(k: usize) -> Row {
    let alpha = alpha_of_row(k);
    let deficit: Vec<f64> = (0..N_MU).map(|j| directional(mu_of_column(j, alpha), alpha).deficit).collect();
    let schlick: Vec<f64> = (0..N_MU).map(|j| schlick_cos(j as f64 / (N_MU - 1) as f64, alpha)).collect();
    let lookup = |t: &[f64], x: f64| {
        let p = (x * (N_MU - 1) as f64).min((N_MU - 1) as f64 - 1e-9);
        let j = p as usize;
        t[j] + (t[j + 1] - t[j]) * (p - j as f64)
    };
    // μ = s⁴ spreads the points over the narrow dip at grazing angles.
    let n = 40_000;
    let (mut deficit_average, mut schlick_average) = (0.0, 0.0);
    for i in 0..n {
        let s = (i as f64 + 0.5) / n as f64;
        let mu = s.powi(4);
        let weight = 2.0 * mu * 4.0 * s.powi(3) / n as f64;
        let d = lookup(&deficit, mu * (1.0 + alpha) / (mu + alpha));
        deficit_average += weight * d;
        schlick_average += weight * (1.0 - d) * (1.0 - lookup(&schlick, mu)).powi(5);
    }
    deficit_average /= alpha.powf(1.5);
    Row { deficit, schlick_cos: schlick, deficit_average, schlick_average }
}

/// The text of `crates/core/src/bsdf/albedo_data.rs`.
pub fn data_file() -> String {
    let rows: Vec<Row> = (0..N_ALPHA).map(row).collect();
    let mut out = String::from(
        "//! Data of [`super::albedo`], written by `cargo run --release -p lumbre-testkit --example bsdf_tables`. Do not edit.\n\n\
         use super::albedo::{N_ALPHA, N_MU};\n",
    );
    type Pick = fn(&Row) -> &Vec<f64>;
    let tables: [(&str, &str, Pick); 2] = [
        ("DEFICIT", "1 - E by width and warped cosine.", |r| &r.deficit),
        ("SCHLICK_COS", "Effective Schlick cosine by width and cosine.", |r| &r.schlick_cos),
    ];
    for (name, doc, pick) in tables {
        let _ = writeln!(out, "\n/// {doc}\npub(super) static {name}: [[f32; N_MU]; N_ALPHA] = [");
        for r in &rows {
            let _ = writeln!(out, "    [{}],", literals(pick(r)));
        }
        out.push_str("];\n");
    }
    let averages: [(&str, &str, Vec<f64>); 2] = [
        (
            "DEFICIT_AVERAGE",
            "Hemispherical 1 - E by width.",
            rows.iter().map(|r| r.deficit_average).collect(),
        ),
        ("SCHLICK_AVERAGE", "Hemispherical B by width.", rows.iter().map(|r| r.schlick_average).collect()),
    ];
    for (name, doc, values) in averages {
        let _ =
            writeln!(out, "\n/// {doc}\npub(super) static {name}: [f32; N_ALPHA] = [{}];", literals(&values));
    }
    out
}

fn literals(values: &[f64]) -> String {
    let text: Vec<String> = values.iter().map(|v| format!("{:.4e}", v.max(0.0))).collect();
    text.join(", ")
}
