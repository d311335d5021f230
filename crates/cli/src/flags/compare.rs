//! Flags of `lumbre compare`.

use super::values::exposure;
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

/// A figure of `lumbre compare` that can be bounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Metric {
    Rmse,
    RelMse,
    LdrFlip,
    HdrFlip,
    NonFinite,
}

impl Metric {
    const ALL: [Metric; 5] =
        [Metric::Rmse, Metric::RelMse, Metric::LdrFlip, Metric::HdrFlip, Metric::NonFinite];

    /// Its name on the command line.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Metric::Rmse => "rmse",
            Metric::RelMse => "relmse",
            Metric::LdrFlip => "ldr-flip",
            Metric::HdrFlip => "hdr-flip",
            Metric::NonFinite => "non-finite",
        }
    }
}

/// `--fail-above`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Threshold {
    pub(crate) metric: Metric,
    pub(crate) value: f64,
}

/// `METRIC=VALUE`.
pub(crate) fn threshold(text: &str) -> Result<Threshold, String> {
    let (name, value) = text.split_once('=').ok_or("expected METRIC=VALUE, such as ldr-flip=0.05")?;
    if name == "psnr" {
        return Err("of psnr more is better; bound rmse instead".into());
    }
    let metric = Metric::ALL.into_iter().find(|m| m.name() == name).ok_or_else(|| {
        format!("no metric {name:?}; there are {}", Metric::ALL.map(Metric::name).join(", "))
    })?;
    let value = value.parse::<f64>().ok().filter(|v| *v >= 0.0);
    let value = value.ok_or_else(|| format!("the bound of {name} is not a number from 0"))?;
    Ok(Threshold { metric, value })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_name_a_metric_and_a_value() {
        assert_eq!(threshold("rmse=0.1"), Ok(Threshold { metric: Metric::Rmse, value: 0.1 }));
        for wrong in ["rmse", "psnr=30", "foo=1", "rmse=-1", "rmse=nan", "rmse=x"] {
            assert!(threshold(wrong).is_err(), "{wrong}");
        }
    }
}
