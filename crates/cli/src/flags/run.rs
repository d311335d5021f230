//! Flags on how the program runs: device, threads, memory, progress. None of them changes the picture.

use super::values::bytes;
use clap::{Args, ValueEnum};
use lumbre::Device;

/// Kinds of devices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum DeviceFlag {
    /// The best there is
    Auto,
    /// The processors of this machine
    Cpu,
}

impl DeviceFlag {
    /// The same in the library's terms, and why it is taken.
    pub(crate) fn choose(self) -> (Device, &'static str) {
        match self {
            DeviceFlag::Auto => (Device::Auto, "auto: the only kind of device so far"),
            DeviceFlag::Cpu => (Device::Cpu, "as --device asks"),
        }
    }
}

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
    /// Where to render.
    #[arg(long, default_value = "auto")]
    pub(crate) device: DeviceFlag,

    /// Threads. [default: one for each processor]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,

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
