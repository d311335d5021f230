//! The project's own chores: `cargo xtask CHORE`. Each chore is one file; CI calls these and nothing else.
#![forbid(unsafe_code)]

mod check;
mod command;
mod gallery;
mod licences;
mod lint;
mod scenes;
mod targets;
mod tree;
mod typos;

use std::process::ExitCode;

const HELP: &str = "\
cargo xtask CHORE

check           fmt, lint, typos, licences, clippy and rustdoc, warnings being errors
test [ARGS]     cargo test
lint            rules of this project: crate dependencies, unsafe, sizes, forbidden calls
typos           spelling of .rs, .md and .toml files
licences        licences of all dependencies
shaders [--check]
                compile crates/shaders/glsl to SPIR-V, or compare only (builds glslang: needs a C++ compiler)
scenes [NAME...] [--check]
                write assets/scenes anew, or compare only
targets         whether the program compiles for Windows, macOS and 64-bit ARM
gallery [PART]  draw the pictures of docs/gallery.md again, those whose command contains PART
";

fn main() -> ExitCode {
    let mut args = std::env::args().skip(1);
    let chore = args.next().unwrap_or_default();
    let rest: Vec<String> = args.collect();
    let done = match (chore.as_str(), rest.is_empty()) {
        ("test", _) => command::cargo("test", &rest, &[]),
        ("shaders", _) => command::cargo("run", &shader_args(&rest), &[]),
        ("scenes", _) => scenes::run(&rest),
        ("gallery", _) => gallery::run(&rest),
        ("check", true) => check::run(),
        ("lint", true) => lint::run(),
        ("targets", true) => targets::run(),
        ("typos", true) => typos::run(),
        ("licences", true) => licences::run(),
        ("" | "help" | "--help" | "-h", _) => {
            print!("{HELP}");
            Ok(())
        }
        _ => Err(format!("no such chore: {chore} {}\n\n{HELP}", rest.join(" "))),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{}", message.trim_end());
            ExitCode::FAILURE
        }
    }
}

fn shader_args(rest: &[String]) -> Vec<String> {
    ["--quiet", "--locked", "--package", "xtask-shaders", "--"]
        .map(str::to_owned)
        .iter()
        .chain(rest)
        .cloned()
        .collect()
}
