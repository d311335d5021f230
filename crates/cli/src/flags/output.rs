//! Flags on the picture: where it goes, how large it is, what it looks like.

use super::values::{Size, aberration, exposure, size, vignette};
use clap::{Args, ValueEnum};
use lumbre::core::color::Exposure;
use lumbre::core::settings::RenderSettings;
use lumbre::core::tone::ToneCurve;
use lumbre::edits::LookEdits;
use lumbre::output::Look;
use std::path::PathBuf;

/// What stands behind the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Background {
    /// Its sky or environment
    Scene,
    /// Nothing: PNG and EXR get alpha, JPEG and HDR black
    Transparent,
}

/// The picture.
#[derive(Args, Debug)]
#[command(next_help_heading = "Picture")]
pub(crate) struct OutputArgs {
    /// File to write: .png, .jpg (8 bits a band, for display), .hdr (linear radiance) or .exr (linear, 32-bit floats, with
    /// layers); - is standard output, a PNG, or of another format as exr:-. May be given several times.
    /// [default: the scene's name with .png, beside it or in this folder; never a file that is there already]
    #[arg(short, long, value_name = "FILE", allow_hyphen_values = true)]
    pub(crate) output: Vec<PathBuf>,

    /// Columns and rows of the picture, up to 32768 each. [default: 720 rows in the shape that the camera was framed for,
    /// 1280x720 where the scene does not say]
    #[arg(long, value_name = "WxH", value_parser = size, allow_hyphen_values = true)]
    pub(crate) size: Option<Size>,

    /// What the camera sees behind the scene. What is left out still gives light. [default: scene]
    #[arg(long)]
    pub(crate) background: Option<Background>,

    /// Number of the first sample of each pixel. A render can be split: each part takes --spp samples from here, its .exr carries
    /// the exact sums, and `lumbre merge` adds them to the bits of one run.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u32).range(..=LAST_FIRST_SAMPLE))]
    pub(crate) first_sample: Option<u32>,

    /// An .exr carries the exact sums of its samples (about 150 bytes a pixel before compression), so that `lumbre merge` can add
    /// more; --first-sample implies it.
    #[arg(long)]
    pub(crate) keep_sums: bool,

    #[command(flatten)]
    pub(crate) look: LookArgs,
}

/// So that the numbers of samples stay within 32 bits.
const LAST_FIRST_SAMPLE: i64 = u32::MAX as i64 - (1 << 24);

impl OutputArgs {
    /// Whether an EXR is to carry exact sums.
    pub(crate) fn keeps_sums(&self) -> bool {
        self.keep_sums || self.first_sample.is_some()
    }

    /// Settings with what was given of the background.
    pub(crate) fn settings(&self, base: RenderSettings) -> RenderSettings {
        let transparent = self.background.map(|b| b == Background::Transparent);
        RenderSettings { transparent_background: transparent.unwrap_or(base.transparent_background), ..base }
    }
}

/// How a file says that its background is left out.
pub(crate) const BACKGROUND: &str = "background";
/// As above.
pub(crate) const TRANSPARENT: &str = "transparent";

/// How a film is developed for a display.
#[derive(Args, Debug)]
#[command(next_help_heading = "Look (PNG and JPEG; EXR and HDR keep radiance as it is)")]
pub(crate) struct LookArgs {
    /// Brightness: `auto` makes the log-average luminance middle grey (0.18), `thesis` is 0.5 over the average clamped to
    /// 0.1..1, a number is stops: each one more doubles. [default: auto]
    #[arg(long, value_name = "auto|thesis|EV", value_parser = exposure, allow_hyphen_values = true)]
    pub(crate) exposure: Option<Exposure>,

    /// Tone curve: `srgb` and `linear` (gamma 2.2) clip what is brighter than white; `reinhard`, `aces` and `agx` roll it off,
    /// and so does `neutral`, which keeps the colours of materials. [default: srgb]
    #[arg(long, value_name = "CURVE", value_parser = tone)]
    pub(crate) tone: Option<ToneCurve>,

    /// Darkens towards the corners, which keep 1 - X of their light; 0 to 1. [default: 0]
    #[arg(long, value_name = "X", value_parser = vignette, allow_negative_numbers = true)]
    pub(crate) vignette: Option<f32>,

    /// Chromatic aberration: enlarges red about the centre by X per cent and makes blue smaller by as much; -50 to 50.
    /// [default: 0]
    #[arg(long, value_name = "X", value_parser = aberration, allow_hyphen_values = true)]
    pub(crate) aberration: Option<f32>,

    /// Quality of a JPEG.
    #[arg(long, value_name = "1..100", default_value_t = lumbre::output::QUALITY, allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u8).range(1..=100))]
    pub(crate) quality: u8,
}

impl LookArgs {
    /// The same in the library's terms: what was given, in the place of what stands in `base`.
    pub(crate) fn look(&self, base: LookEdits) -> LookEdits {
        let LookEdits { look, offset_ev } = base;
        let look = Look {
            exposure: self.exposure.unwrap_or(look.exposure),
            tone: self.tone.unwrap_or(look.tone),
            vignette: self.vignette.unwrap_or(look.vignette),
            aberration: self.aberration.unwrap_or(look.aberration),
            ..look
        };
        // Who says an exposure means just that.
        LookEdits { look, offset_ev: if self.exposure.is_some() { 0.0 } else { offset_ev } }
    }
}

/// `--tone`.
fn tone(text: &str) -> Result<ToneCurve, String> {
    let names = || ToneCurve::ALL.map(ToneCurve::name).join(", ");
    let found = ToneCurve::ALL.into_iter().find(|t| t.name() == text);
    found.ok_or_else(|| format!("the curves are {}", names()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_have_their_names() {
        assert_eq!(tone("agx"), Ok(ToneCurve::Agx));
        assert_eq!(tone("AgX"), Err("the curves are linear, srgb, reinhard, aces, agx, neutral".into()));
        assert_eq!(ToneCurve::default().name(), "srgb", "as the flag says");
    }
}
