//! When a render ends, and how it ended.

use crate::backend::RenderError;
use lumbre_core::control::Progress;
use std::ops::Range;
use std::time::Duration;

/// Targets of a render, which ends at whichever comes first. Without any it goes on until it is cancelled or has no sample
/// index left.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Targets {
    /// Samples per pixel.
    pub spp: Option<u32>,
    /// Time since the render began. Passes are sized by the speed so far, so it ends within about a second of it and every
    /// pixel has its share; the first sample of each pixel is always taken, however long that takes.
    pub time: Option<Duration>,
    /// Estimated relMSE of the picture against the truth, as [`crate::Estimator`] tells it. It is asked after 1, 2, 4, 8, 16
    /// samples per pixel and then after each 16 more, never in between, so that the same picture ends at the same sample on
    /// every machine; below 64 samples (1024 where all samples are alike, as in a black picture) it does not end a render.
    pub error: Option<f64>,
    /// Index of the first sample of each pixel: parts of one picture begin where others end.
    pub first_sample: u32,
}

impl Targets {
    /// So many samples per pixel.
    pub fn spp(spp: u32) -> Self {
        Targets { spp: Some(spp), ..Self::default() }
    }
    /// So much time.
    pub fn time(time: Duration) -> Self {
        Targets { time: Some(time), ..Self::default() }
    }
    /// An estimated error no larger than this.
    pub fn error(error: f64) -> Self {
        Targets { error: Some(error), ..Self::default() }
    }
    /// Ends after so many samples per pixel at the latest.
    pub fn or_spp(self, spp: u32) -> Self {
        Targets { spp: Some(spp), ..self }
    }
    /// Ends after so much time at the latest.
    pub fn or_time(self, time: Duration) -> Self {
        Targets { time: Some(time), ..self }
    }
    /// Ends as soon as the estimated error is no larger than this.
    pub fn or_error(self, error: f64) -> Self {
        Targets { error: Some(error), ..self }
    }
    /// Begins at this sample index instead of 0.
    pub fn from_sample(self, first_sample: u32) -> Self {
        Targets { first_sample, ..self }
    }
    /// Most samples per pixel that can be taken: the target, or what indices there are.
    pub(crate) fn most(&self) -> u32 {
        self.spp.unwrap_or(u32::MAX).min(u32::MAX - self.first_sample)
    }
}

/// Exactly these samples of each pixel.
impl From<Range<u32>> for Targets {
    fn from(range: Range<u32>) -> Self {
        Targets::spp(range.end.saturating_sub(range.start)).from_sample(range.start)
    }
}

/// What ended a render.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// All samples were taken.
    Spp,
    /// The time was up.
    Time,
    /// The estimated error was reached.
    Error,
    /// It was cancelled; pixels may differ in their samples by one pass.
    Cancelled,
    /// The device failed and no other could go on; all pixels have the same samples.
    Failed,
}

/// A render after a pass over the whole picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SoFar {
    /// Samples that every pixel has got.
    pub spp: u32,
    /// What was done in all.
    pub progress: Progress,
    /// Seconds since it began.
    pub seconds: f64,
    /// Estimated relMSE; `None` before there are two samples per pixel.
    pub error: Option<f64>,
    /// Seconds until it will end, at whichever target comes first; `None` where no target tells yet.
    pub seconds_left: Option<f64>,
}

/// How a render ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// What ended it.
    pub ended: Ended,
    /// Samples that every pixel has got.
    pub spp: u32,
    /// What was done in all, that of a pass that was cancelled too.
    pub progress: Progress,
    /// Seconds that it took.
    pub seconds: f64,
    /// Estimated relMSE; `None` with fewer than two samples per pixel. Of a cancelled render, that of the last look.
    pub error: Option<f64>,
}

/// A render that its device could not finish.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{error}")]
pub struct RenderFailed {
    /// What happened.
    pub error: RenderError,
    /// How far it came; what ended it is [`Ended::Failed`]. The film holds that many samples of every pixel.
    pub outcome: Outcome,
}
