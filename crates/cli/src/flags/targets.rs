//! Flags on when a render ends.

use super::values::{duration, error};
use clap::Args;
use lumbre::Targets;
use std::time::Duration;

/// When to stop.
#[derive(Args, Debug, Default)]
#[command(next_help_heading = "When to stop (at whichever comes first)")]
pub(crate) struct TargetArgs {
    /// Samples per pixel. [default: 4096 if neither --time nor --target-error is given either]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=MAX_SPP))]
    pub(crate) spp: Option<u32>,

    /// Time for the whole command but the writing of the picture, such as 30s, 1.5min, 1h30min. [default: 10min if neither --spp
    /// nor --target-error is given either]
    #[arg(long, value_name = "TIME", value_parser = duration, allow_negative_numbers = true)]
    pub(crate) time: Option<Duration>,

    /// Stop when the picture is this good: the estimated relMSE that `lumbre compare` would find against a perfect one. 0.02 is
    /// grainy, 0.005 shows some grain, 0.001 none. 64 samples are taken at least. [default: 0.002 if neither --spp nor --time is given either]
    #[arg(long, value_name = "E", value_parser = error, allow_negative_numbers = true)]
    pub(crate) target_error: Option<f64>,

    /// Write the outputs again and again with what there is so far, this far apart.
    #[arg(long, value_name = "TIME", value_parser = duration, allow_negative_numbers = true)]
    pub(crate) save_every: Option<Duration>,
}

/// Up to here a float in an EXR layer counts samples exactly.
const MAX_SPP: i64 = 1 << 24;

/// Without any of the flags.
const DEFAULT_ERROR: f64 = 0.002;
const DEFAULT_SPP: u32 = 4096;
const DEFAULT_TIME: Duration = Duration::from_secs(600);

impl TargetArgs {
    /// Whether any target was given.
    pub(crate) fn given(&self) -> bool {
        self.spp.is_some() || self.time.is_some() || self.target_error.is_some()
    }

    /// The same in the library's terms, when so much time has gone already.
    pub(crate) fn targets(&self, gone: Duration) -> Targets {
        let (spp, time, error) = if self.given() {
            (self.spp, self.time, self.target_error)
        } else {
            (Some(DEFAULT_SPP), Some(DEFAULT_TIME), Some(DEFAULT_ERROR))
        };
        Targets { spp, time: time.map(|t| t.saturating_sub(gone)), error, ..Targets::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_target_takes_the_place_of_all_defaults() {
        let gone = Duration::from_secs(2);
        let none = TargetArgs::default().targets(gone);
        assert_eq!((none.spp, none.error), (Some(DEFAULT_SPP), Some(DEFAULT_ERROR)));
        assert_eq!(none.time, Some(DEFAULT_TIME - gone));
        let only = TargetArgs { spp: Some(7), ..TargetArgs::default() }.targets(gone);
        assert_eq!(only, Targets::spp(7));
        let late = TargetArgs { time: Some(Duration::from_secs(1)), ..TargetArgs::default() }.targets(gone);
        assert_eq!(late, Targets::time(Duration::ZERO));
    }
}
