//! Quadrature behind the albedo table of the sheen (`lumbre_core::bsdf::sheen`), in `f64` and without use of the code it checks, and
//! the text of its data file.

use crate::bsdf_tables::literals;
use lumbre_core::bsdf::sheen::{N_MU, N_ROUGHNESS, mu_of_column, roughness_of_row};
use std::f64::consts::PI;
use std::fmt::Write;

/// Points of the quadrature along the height and half the azimuth.
const N_DIRECTIONS: [usize; 2] = [384, 256];
/// Points of the average along the cosine.
const N_AVERAGE: usize = 256;

/// Share of light from all around that white fibres return at the cosine `mu`, by the midpoint rule.
pub fn directional(mu: f64, roughness: f64) -> f64 {
    let p = 1.0 / (roughness * roughness);
    let k = (2.0 + p).powi(2) / (PI * (2.0 * p + 5.0)) - 0.25;
    let eta = |mu: f64| (0.25 + k * (1.0 - mu * mu)).sqrt();
    let sin_o = (1.0 - mu * mu).max(0.0).sqrt();
    let mut sum = 0.0;
    for i in 0..N_DIRECTIONS[0] {
        // Heights crowd at the horizon, azimuths about that of the viewer, as the lobe does.
        let s = (i as f64 + 0.5) / N_DIRECTIONS[0] as f64;
        let (z, dz) = (s.powi(3), 3.0 * s * s / N_DIRECTIONS[0] as f64);
        let sines = sin_o * (1.0 - z * z).sqrt();
        let geometry = z / (4.0 * (mu * eta(z) + z * eta(mu)));
        for j in 0..N_DIRECTIONS[1] {
            let t = (j as f64 + 0.5) / N_DIRECTIONS[1] as f64;
            let (phi, dphi) = (PI * t * t, 2.0 * PI * t / N_DIRECTIONS[1] as f64);
            let half2 = (mu + z).powi(2) / (2.0 + 2.0 * (mu * z + sines * phi.cos()));
            let d = (2.0 + p) / (2.0 * PI) * (1.0 - half2).max(0.0).powf(0.5 * p);
            sum += 2.0 * d * geometry * dphi * dz;
        }
    }
    sum
}

/// One row of the table.
pub fn row(k: usize) -> Vec<f64> {
    let roughness = roughness_of_row(k);
    (0..N_MU).map(|j| directional(mu_of_column(j, roughness), roughness)).collect()
}

/// 2 ∫ E μ dμ.
pub fn average(roughness: f64) -> f64 {
    let points = (0..N_AVERAGE).map(|i| (i as f64 + 0.5) / N_AVERAGE as f64);
    points.map(|mu| 2.0 * mu * directional(mu, roughness) / N_AVERAGE as f64).sum()
}

/// The text of `crates/core/src/bsdf/sheen_data.rs`, before formatting.
pub fn data_file() -> String {
    let mut out = String::from(
        "//! Data of [`super::sheen`], written by `cargo run --release -p lumbre-testkit --example bsdf_tables`. Do not edit.\n\n\
         use super::sheen::{N_MU, N_ROUGHNESS};\n\n\
         /// E by roughness and warped cosine.\n\
         pub static DIRECTIONAL: [[f32; N_MU]; N_ROUGHNESS] = [\n",
    );
    for k in 0..N_ROUGHNESS {
        let _ = writeln!(out, "    [{}],", literals(&row(k)));
    }
    let averages: Vec<f64> = (0..N_ROUGHNESS).map(|k| average(roughness_of_row(k))).collect();
    let _ = writeln!(
        out,
        "];\n\n/// Hemispherical E by roughness.\npub static AVERAGE: [f32; N_ROUGHNESS] = [{}];",
        literals(&averages)
    );
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_core::Spectrum;
    use lumbre_core::bsdf::sheen::Sheen;

    fn white(roughness: f64) -> Sheen {
        Sheen::new(Spectrum::WHITE, roughness as f32)
    }

    /// The checked-in table is what the quadrature gives, to the digits printed.
    #[test]
    fn data_is_fresh() {
        for k in [0, 1, 7, 15, 24, N_ROUGHNESS - 1] {
            let roughness = roughness_of_row(k);
            for (j, want) in row(k).into_iter().enumerate() {
                let got = f64::from(white(roughness).directional(mu_of_column(j, roughness) as f32));
                assert!((got - want).abs() < 3e-5, "row {k} column {j}: {got} {want}");
            }
            let (got, want) = (f64::from(white(roughness).average()), average(roughness));
            assert!((got - want).abs() < 3e-5, "row {k}: {got} {want}");
        }
    }

    #[test]
    fn interpolation_error_is_bounded() {
        for i in 0..24 {
            let roughness = 0.051 + 0.04 * f64::from(i) + 0.003 * f64::from(i * i % 7);
            for j in 0..40 {
                let mu = ((f64::from(j) + 0.5) / 40.0).powi(3);
                let (got, want) =
                    (f64::from(white(roughness).directional(mu as f32)), directional(mu, roughness));
                assert!((got - want).abs() < 0.002, "{roughness} {mu}: {got} {want}");
            }
        }
    }

    /// No roughness returns more than it gets, down to the horizon; and fewer points give the same.
    #[test]
    fn never_gains() {
        for k in 0..N_ROUGHNESS {
            let most = row(k).into_iter().fold(0.0, f64::max);
            assert!(most <= 1.0 + 1e-4 && most > 0.98, "row {k}: {most}");
        }
    }
}
