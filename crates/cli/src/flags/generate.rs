//! Flags of `lumbre completions` and `lumbre man`.

use clap::Args;
use clap_complete::Shell;
use std::path::PathBuf;

/// Shown below the flags.
pub(crate) const COMPLETIONS_EXAMPLES: &str = "\
Examples:
  lumbre completions bash > ~/.local/share/bash-completion/completions/lumbre
  lumbre completions zsh > ~/.zfunc/_lumbre
      with ~/.zfunc in fpath
  lumbre completions fish > ~/.config/fish/completions/lumbre.fish

Exit codes:
  0 done, 2 wrong usage, 74 cannot write";

/// Flags of `lumbre completions`.
#[derive(Args, Debug)]
pub(crate) struct CompletionsArgs {
    /// For which shell.
    #[arg(value_name = "SHELL")]
    pub(crate) shell: Shell,
}

/// Shown below the flags.
pub(crate) const MAN_EXAMPLES: &str = "\
Examples:
  lumbre man | man -l -
      this program's page, now
  lumbre man ~/.local/share/man/man1
      a page for each command, for `man lumbre-render` later

Exit codes:
  0 done, 2 wrong usage, 74 cannot write";

/// Flags of `lumbre man`.
#[derive(Args, Debug)]
pub(crate) struct ManArgs {
    /// Folder for the pages of all commands; without it that of the program is printed.
    #[arg(value_name = "FOLDER")]
    pub(crate) folder: Option<PathBuf>,
}
