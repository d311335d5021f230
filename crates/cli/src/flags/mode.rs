//! Flags on how frames are drawn: by paths, or by rasterising and rays.

use super::sampling::Switch;
use super::values::vec3;
use clap::{Args, ValueEnum};
use lumbre::core::Spectrum;
use lumbre::core::hybrid::{AntiAliasing, HybridSettings};
use lumbre::core::math::Vec3;
use lumbre::core::settings::RenderSettings;
use std::path::PathBuf;

/// Ways to draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Mode {
    /// Unbiased path tracing
    Path,
    /// As in real time: what the camera sees is rasterised, the rest is brought by rays (takes a GPU)
    Hybrid,
}

/// What frames have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Set {
    /// Sharp shadows, mirrors, glass, ambient light, FXAA
    Thesis,
    /// Soft shadows and light between surfaces too, filtered, and temporal anti-aliasing
    All,
}

/// Ways to smooth edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Edges {
    /// None: one sample at the centre of each pixel
    None,
    /// Each frame by itself
    Fxaa,
    /// Over frames
    Temporal,
}

/// What hybrid frames have.
#[derive(Args, Debug)]
#[command(next_help_heading = "Hybrid frames")]
pub(crate) struct HybridArgs {
    /// What frames have, where the flags below do not say it.
    #[arg(long, value_name = "SET", default_value = "all")]
    pub(crate) hybrid: Set,

    /// Penumbras of lamps and sun where the camera sees them. [default: that of --hybrid]
    #[arg(long)]
    pub(crate) soft_shadows: Option<Switch>,

    /// Ambient light stays away from where things meet; without light between surfaces. [default: off]
    #[arg(long)]
    pub(crate) ambient_occlusion: Option<Switch>,

    /// Light that sky and surfaces throw on what the camera sees, one ray a pixel. [default: that of --hybrid]
    #[arg(long)]
    pub(crate) global_illumination: Option<Switch>,

    /// Filters the noise of all of these over space and time. [default: that of --hybrid]
    #[arg(long)]
    pub(crate) light_filter: Option<Switch>,

    /// How edges are made smooth. [default: fxaa for `thesis`, temporal for `all`]
    #[arg(long)]
    pub(crate) anti_aliasing: Option<Edges>,

    /// Rows and columns that are drawn over those that are shown, 0.5 to 1; with temporal anti-aliasing. [default: 1]
    #[arg(long, value_name = "X", value_parser = render_scale, allow_hyphen_values = true)]
    pub(crate) render_scale: Option<f32>,

    /// Writes what the last frame knows of its pixels into this folder, a PNG each: normal, depth, position, albedo, roughness, specularity,
    /// mirrored, through, index, emission, object, material, motion, sharp, soft, gathered, filtered.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) planes: Option<PathBuf>,

    /// Radiance that stands for light that no ray brings, nits. [default: found from sky and lamps]
    #[arg(long, value_name = "R,G,B", value_parser = ambient, allow_hyphen_values = true)]
    pub(crate) ambient: Option<Vec3>,
}

/// `--ambient`.
fn ambient(text: &str) -> Result<Vec3, String> {
    let value = vec3(text)?;
    if value.min_element() >= 0.0 { Ok(value) } else { Err("light cannot be negative".into()) }
}

/// `--render-scale`.
fn render_scale(text: &str) -> Result<f32, String> {
    let least = HybridSettings::LEAST_SCALE;
    match text.trim().parse::<f32>() {
        Ok(x) if (least..=1.0).contains(&x) => Ok(x),
        _ => Err(format!("expected a number from {least} to 1")),
    }
}

impl HybridArgs {
    /// The same in the library's terms; how many rays follow one another is `--max-depth`.
    pub(crate) fn settings(&self, render: &RenderSettings) -> HybridSettings {
        let base = match self.hybrid {
            Set::Thesis => HybridSettings::THESIS,
            Set::All => HybridSettings::ALL,
        };
        let on = |switch: Option<Switch>, base: bool| switch.map_or(base, |s| s == Switch::On);
        let most = HybridSettings::MOST_DEPTH;
        let edges = self.anti_aliasing.map(|e| match e {
            Edges::None => AntiAliasing::None,
            Edges::Fxaa => AntiAliasing::Fxaa,
            Edges::Temporal => AntiAliasing::Temporal,
        });
        HybridSettings {
            depth: render.max_depth.unwrap_or(most).min(most),
            ambient: self.ambient.map(|a| Spectrum::new(a.x, a.y, a.z)),
            soft_shadows: on(self.soft_shadows, base.soft_shadows),
            ambient_occlusion: on(self.ambient_occlusion, base.ambient_occlusion),
            global_illumination: on(self.global_illumination, base.global_illumination),
            filter: on(self.light_filter, base.filter),
            anti_aliasing: edges.unwrap_or(base.anti_aliasing),
            render_scale: self.render_scale.unwrap_or(base.render_scale),
            ..base
        }
    }

    /// Frames of a still picture, where nobody says how many: as many as light is gathered over.
    pub(crate) fn still_frames(&self, settings: &HybridSettings) -> u32 {
        let temporal = settings.anti_aliasing == AntiAliasing::Temporal;
        if settings.has_soft_light() || temporal { 32 } else { 1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct Only {
        #[command(flatten)]
        hybrid: HybridArgs,
    }

    fn settings(flags: &[&str]) -> HybridSettings {
        let all = Only::try_parse_from(std::iter::once("x").chain(flags.iter().copied()));
        all.unwrap().hybrid.settings(&RenderSettings { max_depth: Some(10), ..RenderSettings::default() })
    }

    #[test]
    fn sets_and_switches() {
        assert_eq!(settings(&[]), HybridSettings::ALL);
        assert_eq!(settings(&["--hybrid", "thesis"]), HybridSettings::THESIS);
        let mixed = settings(&["--hybrid", "thesis", "--soft-shadows", "on", "--anti-aliasing", "none"]);
        assert!(mixed.soft_shadows && !mixed.filter && mixed.anti_aliasing == AntiAliasing::None);
        assert_eq!(settings(&["--render-scale", "0.5"]).render_scale, 0.5);
        for bad in [["--render-scale", "0.3"], ["--ambient", "-1,0,0"]] {
            assert!(Only::try_parse_from(["x", bad[0], bad[1]]).is_err(), "{bad:?}");
        }
    }
}
