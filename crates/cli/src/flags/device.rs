//! Flags on what renders: shared by the commands that do.

use clap::Args;
use lumbre::{Device, GpuOptions};

/// What renders.
#[derive(Args, Debug)]
#[command(next_help_heading = "Running")]
pub(crate) struct DeviceArgs {
    /// Where to render: `auto`, the best GPU that traces rays, or the CPU where there is none or it fails; `cpu`; `gpu`, the best
    /// GPU or an error; `gpu:N`, or the name of a GPU or a part of it. `lumbre devices` lists them.
    #[arg(long, value_name = "auto|cpu|gpu|gpu:N|NAME", default_value = "auto")]
    pub(crate) device: Device,

    /// Lets Vulkan's validation layer, where it is installed, look over every call of a GPU: slow, for those who change this
    /// program.
    #[arg(long)]
    pub(crate) validation: bool,

    /// Threads. [default: one for each processor]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
}

impl DeviceArgs {
    /// How a GPU is used.
    pub(crate) fn options(&self) -> GpuOptions {
        GpuOptions { validation: self.validation }
    }
}
