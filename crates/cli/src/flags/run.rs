//! Flags on how the program runs: device, threads, memory, progress. None of them changes the picture but for the last bits of a
//! number, which a GPU rounds in its own way.

use super::device::DeviceArgs;
use super::values::bytes;
use clap::{Args, ValueEnum};

/// Ways to show progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProgressFlag {
    /// A bar on a terminal, plain lines elsewhere
    Auto,
    /// A line on stderr every few seconds
    Plain,
    /// One JSON object per line on stdout; the last one has the times
    Json,
    /// No progress (notes and warnings still appear)
    Off,
}

/// How to run.
#[derive(Args, Debug)]
#[command(next_help_heading = "Running")]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) device: DeviceArgs,

    /// Refuse a picture that takes more memory than this: bytes, or with K, M, G or T, powers of 1024. [default: what the
    /// system has]
    #[arg(long, value_name = "SIZE", value_parser = bytes, allow_negative_numbers = true)]
    pub(crate) memory_limit: Option<u64>,

    /// How to show progress.
    #[arg(long, default_value = "auto")]
    pub(crate) progress: ProgressFlag,

    /// At the end, say in a table what took how much time and memory; with --progress json as part of the last line.
    #[arg(long)]
    pub(crate) stats: bool,
}
