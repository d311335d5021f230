//! Flags of `lumbre compare`.

use super::values::{Threshold, exposure, threshold};
use clap::Args;
use lumbre::core::color::Exposure;
use std::path::PathBuf;

/// Shown below the flags.
pub(crate) const EXAMPLES: &str = "\
Two HDR pictures (.exr, .hdr): rmse, relmse and hdr-flip are of their radiance; psnr and
ldr-flip are of what a screen shows after --exposure, the same factor for both, found from
the reference. Two pictures for a screen (.png, .jpg): all figures are of their linearised
values, and there is no hdr-flip. One of each: the HDR one is first brought to the screen by
--exposure.

Examples:
  lumbre compare reference.exr picture.exr
  lumbre compare reference.exr picture.exr -o difference.png
      dark where they look the same, yellow where they differ
  lumbre compare reference.png picture.png --fail-above ldr-flip=0.05 --fail-above rmse=0.02
      for tests: exit code 1 when a figure is above its bound, or TEST has pixels that are
      no numbers

Exit codes:
  0 done, 1 above a bound, 2 wrong usage, 65 bad data or different sizes, 66 cannot open,
  74 cannot write";

/// Flags of `lumbre compare`.
#[derive(Args, Debug)]
pub(crate) struct CompareArgs {
    /// The picture taken for true: .exr, .hdr, .png or .jpg.
    #[arg(value_name = "REFERENCE")]
    pub(crate) reference: PathBuf,

    /// The picture to be measured.
    #[arg(value_name = "TEST")]
    pub(crate) test: PathBuf,

    /// Writes where they differ (the FLIP map in magma colours; of HDR-FLIP if there is one).
    #[arg(short, long, value_name = "DIFF.png")]
    pub(crate) output: Option<PathBuf>,

    /// Exits with code 1 if the figure is above this value: rmse, relmse, ldr-flip, hdr-flip, or non-finite (the number of
    /// pixels of TEST alone that are no numbers, 0 unless given). May be given several times.
    #[arg(long, value_name = "METRIC=VALUE", value_parser = threshold)]
    pub(crate) fail_above: Vec<Threshold>,

    /// Prints one JSON object; an infinite PSNR is null.
    #[arg(long)]
    pub(crate) json: bool,

    /// Layer of both EXR files, instead of the picture itself.
    #[arg(long, value_name = "NAME")]
    pub(crate) layer: Option<String>,

    /// Brightness at which HDR pictures are shown, as in `lumbre render`.
    #[arg(long, value_name = "auto|thesis|EV", default_value = "auto", value_parser = exposure)]
    #[arg(allow_hyphen_values = true)]
    pub(crate) exposure: Exposure,
}
