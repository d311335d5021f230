//! Measures how well the error of pictures is predicted and prints the table of `docs/convergence.md`: `LUMBRE_SCENES=… cargo run
//! --release --example error_estimate -p lumbre-testkit`.
#![forbid(unsafe_code)]

use lumbre_core::sampler::SamplerKind;
use lumbre_testkit::calibration::{Plan, SMOOTH, SUBJECTS, measure};

fn main() {
    println!("| scene | sampler | | 16 | 32 | 64 | 128 | 256 |\n|---|---|---|---|---|---|---|---|");
    for subject in SUBJECTS.iter().chain([&SMOOTH]) {
        for (sampler, name) in [(SamplerKind::Sobol, "Sobol"), (SamplerKind::Independent, "independent")] {
            let counts = vec![16, 32, 64, 128, 256];
            let plan = Plan { size: [96, 72], sampler, seeds: 6, counts, first_sample: 0 };
            let Some(rows) = measure(subject, &plan) else {
                eprintln!("{}: not there", subject.name);
                break;
            };
            let line = |what: &str, cells: Vec<String>| {
                println!("| {} | {name} | {what} | {} |", subject.name, cells.join(" | "));
            };
            line("relMSE", rows.iter().map(|r| format!("{:.1e}", r.measured)).collect());
            line(
                "predicted / measured",
                rows.iter().map(|r| format!("{:.2}", r.predicted / r.measured)).collect(),
            );
        }
    }
}
