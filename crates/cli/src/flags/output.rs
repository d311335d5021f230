//! Flags on the picture: where it goes, how large it is, how bright.

use super::values::{Size, exposure, size};
use clap::Args;
use lumbre::core::color::Exposure;
use std::path::PathBuf;

/// The picture.
#[derive(Args, Debug)]
#[command(next_help_heading = "Picture")]
pub(crate) struct OutputArgs {
    /// File to write: .png (8-bit sRGB) or .exr (linear, 32-bit floats, with layers). May be given several times.
    /// [default: the scene's name with .png, beside it or in this folder; never an existing file]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,

    /// Columns and rows of the picture, up to 32768 each. [default: 720 rows in the shape that the camera was framed for,
    /// 1280x720 where the scene does not say]
    #[arg(long, value_name = "WxH", value_parser = size, allow_hyphen_values = true)]
    pub(crate) size: Option<Size>,

    /// Brightness of a PNG: `auto` makes the log-average luminance middle grey (0.18), `thesis` is 0.5 over the average clamped
    /// to 0.1..1, a number is stops: each one more doubles. An EXR keeps its radiance as it is.
    #[arg(long, value_name = "auto|thesis|EV", default_value = "auto", value_parser = exposure)]
    #[arg(allow_hyphen_values = true)]
    pub(crate) exposure: Exposure,
}
