//! `lumbre completions` and `lumbre man`: made from the flags, so that they are as current as the program.

use crate::console;
use crate::exit::{Code, Failure};
use crate::flags::Cli;
use crate::flags::generate::{CompletionsArgs, ManArgs};
use clap::{Command, CommandFactory};
use std::path::Path;
use std::{fs, io};

/// Prints the completions of a shell.
pub(crate) fn completions(args: &CompletionsArgs) -> Result<Code, Failure> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "lumbre", &mut text);
    // The line feed at the end is `result`'s.
    console::result(String::from_utf8_lossy(&text).trim_end())?;
    Ok(Code::Done)
}

/// Prints the manual page of the program, or writes those of all commands into a folder.
pub(crate) fn man(args: &ManArgs) -> Result<Code, Failure> {
    let failed = |e: io::Error| Failure::new(Code::CannotWrite, format!("manual page: {e}"));
    match &args.folder {
        None => {
            let page = page(Cli::command()).map_err(failed)?;
            console::result(String::from_utf8_lossy(&page).trim_end())?;
        }
        Some(folder) => {
            let mut program = Cli::command();
            program.build();
            let commands: Vec<Command> =
                program.get_subcommands().filter(|c| c.get_name() != "help").cloned().collect();
            write(folder, "lumbre", Cli::command())?;
            for command in commands {
                let name = format!("lumbre-{}", command.get_name());
                write(folder, &name, command)?;
            }
        }
    }
    Ok(Code::Done)
}

fn page(command: Command) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    let source = concat!("lumbre ", env!("CARGO_PKG_VERSION"));
    clap_mangen::Man::new(command).source(source).manual("Lumbre").render(&mut text)?;
    Ok(text)
}

fn write(folder: &Path, name: &str, command: Command) -> Result<(), Failure> {
    let path = folder.join(format!("{name}.1"));
    let failed =
        |e: io::Error| Failure::new(Code::CannotWrite, format!("{}: cannot write: {e}", path.display()));
    fs::write(&path, page(command).map_err(failed)?).map_err(failed)?;
    console::note(format_args!("wrote {}", path.display()));
    Ok(())
}
