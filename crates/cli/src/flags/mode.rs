//! Flags on how frames are drawn: by paths, or by rasterising and rays.

use super::values::vec3;
use clap::{Args, ValueEnum};
use lumbre::core::Spectrum;
use lumbre::core::hybrid::HybridSettings;
use lumbre::core::settings::RenderSettings;

/// Ways to draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Mode {
    /// Unbiased path tracing
    Path,
    /// As in real time: what the camera sees is rasterised, rays bring mirrors, glass and shadows (a GPU)
    Hybrid,
}

/// How frames are drawn.
#[derive(Args, Debug)]
#[command(next_help_heading = "Mode")]
pub(crate) struct ModeArgs {
    /// How the picture is drawn.
    #[arg(long, value_name = "MODE", default_value = "path")]
    pub(crate) mode: Mode,

    /// hybrid: radiance that stands for light that no ray brings, nits. [default: found from sky and lamps]
    #[arg(long, value_name = "R,G,B", value_parser = vec3, allow_hyphen_values = true)]
    pub(crate) ambient: Option<lumbre::core::math::Vec3>,
}

impl ModeArgs {
    /// What hybrid frames honour.
    pub(crate) fn hybrid(&self, settings: &RenderSettings) -> HybridSettings {
        let most = HybridSettings::MOST_DEPTH;
        HybridSettings {
            depth: settings.max_depth.unwrap_or(most).min(most),
            ambient: self.ambient.map(|a| Spectrum::new(a.x, a.y, a.z)),
        }
    }
}
