//! `cargo xtask targets`: whether the program compiles for other systems than this one. It needs their standard libraries
//! (`rustup target add …`), no linker and no C compiler of theirs.

use crate::command::cargo;

/// Systems that Lumbre is meant to run on and that CI does not run.
const TARGETS: [&str; 3] = ["x86_64-pc-windows-gnu", "aarch64-apple-darwin", "aarch64-unknown-linux-gnu"];

/// Checks the libraries and the program for each of them.
///
/// # Errors
/// The targets for which they do not compile.
pub(crate) fn run() -> Result<(), String> {
    let compiles = |target: &&str| {
        eprintln!("target {target}");
        let words = ["--locked", "--package", "lumbre-cli", "--target", target].map(str::to_owned);
        cargo("check", &words, &[]).is_ok()
    };
    let failed: Vec<&str> = TARGETS.into_iter().filter(|t| !compiles(t)).collect();
    match failed[..] {
        [] => Ok(()),
        _ => Err(format!("does not compile for {} (is `rustup target add` missing?)", failed.join(", "))),
    }
}
