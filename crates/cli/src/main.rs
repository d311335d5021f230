//! The `lumbre` command: flags in, pictures out, and an exit code that says how it went.
#![forbid(unsafe_code)]

mod bench;
mod compare;
mod console;
mod device;
mod devices;
mod edited;
mod exit;
mod flags;
mod generate;
mod info;
mod interrupt;
mod lit;
mod memory;
mod merge;
mod outputs;
mod progress;
mod render;
#[cfg(feature = "viewer")]
mod view;

use clap::Parser;
use exit::{Code, Failure};
use flags::{Cli, Command};
use std::panic::{self, PanicHookInfo};
use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let started = Instant::now();
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(e) => {
            // Help and version come this way too, on stdout and with code 0.
            let _ = e.print();
            return if e.use_stderr() { Code::Usage.into() } else { Code::Done.into() };
        }
    };
    panic::set_hook(Box::new(report_bug));
    guarded(|| run(cli.command, started)).into()
}

fn run(command: Command, started: Instant) -> Result<Code, Failure> {
    match command {
        Command::Render(mut args) => render::run(&mut args),
        #[cfg(feature = "viewer")]
        Command::View(args) => view::run(&args),
        Command::Info(mut args) => info::run(&mut args),
        Command::Devices(args) => devices::run(&args),
        Command::Bench(mut args) => bench::run(&mut args, started),
        Command::Compare(args) => compare::run(&args),
        Command::Completions(args) => generate::completions(&args),
        Command::Man(args) => generate::man(&args),
        Command::Merge(args) => merge::run(&args),
    }
}

/// Runs a command to its exit code, whatever happens in it.
fn guarded(command: impl FnOnce() -> Result<Code, Failure>) -> Code {
    // What the command was working on is not looked at again after a panic.
    let outcome = panic::catch_unwind(panic::AssertUnwindSafe(command));
    console::set_bar(None);
    match outcome {
        Ok(Ok(code)) => code,
        Ok(Err(failure)) => {
            console::error(&failure.message);
            failure.code
        }
        Err(_) => Code::Bug,
    }
}

/// One line where a panic arose, on whichever thread.
fn report_bug(info: &PanicHookInfo<'_>) {
    // A damaged file, which ends in an error of its own.
    if lumbre::io::decoder_is_running() {
        return;
    }
    let payload = info.payload();
    let text = payload.downcast_ref::<&str>().copied();
    let what = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message");
    let place = info.location().map_or_else(String::new, |l| format!(" ({}:{})", l.file(), l.line()));
    console::error(format_args!(
        "this is a bug of lumbre {}: {what}{place}; please report it with the command line and, if possible, the scene",
        env!("CARGO_PKG_VERSION")
    ));
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_flags_are_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn a_panic_is_a_bug_and_a_failure_keeps_its_code() {
        assert_eq!(guarded(|| panic!("on purpose")), Code::Bug);
        assert_eq!(guarded(|| Err(Failure::new(Code::Memory, "none left"))), Code::Memory);
        assert_eq!(guarded(|| Ok(Code::Interrupted)), Code::Interrupted);
    }
}
