//! Measures how errors fall on the smooth scene and draws `docs/convergence.svg`: `cargo run --release --example convergence
//! -p lumbre-testkit`.
#![forbid(unsafe_code)]

use lumbre_core::sampler::SamplerKind;
use lumbre_testkit::convergence::{Series, powers_of_two, smooth_picture, smooth_pictures};
use lumbre_testkit::plot::{Plot, svg};
use std::path::Path;

/// Side of the pictures, pixels.
const SIDE: u32 = 24;
/// Samples per pixel of the picture taken as the truth.
const TRUTH: u32 = 32_768;

fn main() -> std::io::Result<()> {
    let truth = smooth_picture(SamplerKind::Sobol, 99, SIDE, TRUTH);
    let samples = powers_of_two(0, 11);
    let measure = |kind, name: &str| {
        let series = Series { name: name.into(), ..smooth_pictures(kind, &samples, SIDE, &truth) };
        println!("{name}: slope {:.3}", series.fit().slope);
        series.points.iter().for_each(|(n, error)| println!("  {n:5} {error:.3e}"));
        series
    };
    let plot = Plot {
        title: "Error of a picture by samples per pixel",
        x: "samples per pixel",
        y: "relative RMSE",
        series: &[
            (measure(SamplerKind::Independent, "independent samples"), "#c2410c"),
            (measure(SamplerKind::Sobol, "Owen-scrambled Sobol"), "#1d4ed8"),
        ],
    };
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    std::fs::create_dir_all(&docs)?;
    std::fs::write(docs.join("convergence.svg"), svg(&plot))
}
