//! Flags that take one sample again instead of a picture.

use super::values::pixel;
use clap::Args;

/// Debugging one path.
#[derive(Args, Debug)]
#[command(next_help_heading = "One path")]
pub(crate) struct ReplayArgs {
    /// Instead of a picture, trace one camera sample of this pixel (column, row, from the top left) and print each step on
    /// stdout. All other flags must be those of the picture.
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pub(crate) pixel: Option<[u32; 2]>,

    /// Which sample of that pixel, from 0.
    #[arg(long, value_name = "N", requires = "pixel", default_value_t = 0, allow_negative_numbers = true)]
    pub(crate) sample: u32,
}
