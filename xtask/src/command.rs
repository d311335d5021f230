//! Runs cargo, the same one that runs us.

use crate::tree;
use std::process::Command;

/// `cargo SUBCOMMAND ARGS` at the workspace root with extra environment variables; its output is shown.
///
/// # Errors
/// The command line, when it could not start or failed.
pub(crate) fn cargo(subcommand: &str, args: &[String], env: &[(&str, &str)]) -> Result<(), String> {
    let line = format!("cargo {subcommand} {}", args.join(" "));
    let mut command = command(subcommand);
    command.args(args).envs(env.iter().copied());
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{}` failed: {status}", line.trim_end())),
        Err(error) => Err(format!("`{}` did not start: {error}", line.trim_end())),
    }
}

/// `cargo metadata` as JSON: of the workspace's own packages, or with `dependencies` of all.
///
/// # Errors
/// What cargo printed.
pub(crate) fn metadata(dependencies: bool) -> Result<serde_json::Value, String> {
    let mut command = command("metadata");
    command.args(["--format-version", "1", "--locked"]);
    if !dependencies {
        command.arg("--no-deps");
    }
    let output = command.output().map_err(|e| format!("`cargo metadata` did not start: {e}"))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    serde_json::from_slice(&output.stdout).map_err(|e| format!("cargo metadata: {e}"))
}

fn command(subcommand: &str) -> Command {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.arg(subcommand).current_dir(tree::root());
    command
}
