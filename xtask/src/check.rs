//! `cargo xtask check`: everything that can be said of the source without running it (only the rules' own tests are run). All steps run, also after one
//! failed, and each says how long it took.

use crate::{command::cargo, licences, lint, scenes, typos};
use std::time::Instant;

type Step = (&'static str, fn() -> Result<(), String>);

/// The quick ones first. xtask is no default member, so that its rules are tested here and not by `cargo test`.
const STEPS: &[Step] = &[
    ("xtask", || cargo("test", &words("--package xtask --quiet --locked"), &[])),
    ("fmt", || cargo("fmt", &words("--all --check"), &[])),
    ("lint", lint::run),
    ("typos", typos::run),
    ("licences", licences::run),
    ("scenes", || scenes::run(&["--check".to_owned()])),
    ("clippy", || cargo("clippy", &words("--workspace --all-targets --locked -- -D warnings"), &[])),
    ("lean", || cargo("check", &words("--package lumbre --no-default-features --examples --locked"), &[])),
    ("doc", || cargo("doc", &words("--workspace --no-deps --locked"), &[("RUSTDOCFLAGS", "-D warnings")])),
];

/// Runs all steps.
///
/// # Errors
/// The names of the steps that failed.
pub(crate) fn run() -> Result<(), String> {
    let mut failed = Vec::new();
    for (name, step) in STEPS {
        let start = Instant::now();
        let verdict = match step() {
            Ok(()) => "ok",
            Err(message) => {
                eprintln!("{}", message.trim_end());
                failed.push(*name);
                "FAILED"
            }
        };
        eprintln!("check {name}: {verdict}, {:.1} s", start.elapsed().as_secs_f32());
    }
    if failed.is_empty() { Ok(()) } else { Err(format!("check failed: {}", failed.join(", "))) }
}

fn words(line: &str) -> Vec<String> {
    line.split_whitespace().map(str::to_owned).collect()
}
