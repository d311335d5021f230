//! Flags on how light is sampled.

use super::values::{Depth, Roulette, depth, positive, roulette};
use clap::{Args, ValueEnum};
use lumbre::core::bsdf::DiffuseSampling;
use lumbre::core::filter::FilterKind;
use lumbre::core::sampler::SamplerKind;
use lumbre::core::settings::{RenderSettings, TransmissiveShadows};

/// Random streams.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Sampler {
    /// Owen-scrambled Sobol points: converges faster
    Sobol,
    /// Independent random numbers
    Independent,
}

/// Pixel filters.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Filter {
    /// Exactly one pixel
    Box,
    /// Radius of one pixel
    Tent,
    /// Standard deviation of half a pixel, radius 1.5
    Gaussian,
    /// Radius 1.5 pixels
    BlackmanHarris,
}

/// A switch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Switch {
    On,
    Off,
}

/// Shadow rays at smooth glass.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Shadows {
    /// Solid glass lets the light of point lights and the sun through straight, with its tint
    Auto,
    /// Solid glass blocks: caustics come from scattered rays alone
    Physical,
    /// Solid glass lets all light through straight
    Straight,
}

/// Ways to draw diffuse directions.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Hemisphere {
    /// In proportion to the cosine
    Cosine,
    /// Uniformly: noisier
    Uniform,
}

/// What camera rays see of the back of single-sided opaque surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BackFaces {
    /// Nothing, as glTF asks
    Cull,
    /// The surface
    Shade,
}

/// Sampling.
#[derive(Args, Debug)]
#[command(next_help_heading = "Sampling")]
pub(crate) struct SamplingArgs {
    /// Most scattering events on a path.
    #[arg(long, value_name = "N|unlimited", allow_negative_numbers = true, default_value = "16", value_parser = depth)]
    pub(crate) max_depth: Depth,

    /// First scattering event after which Russian roulette may end a path.
    #[arg(long, value_name = "N|off", allow_negative_numbers = true, default_value = "4", value_parser = roulette)]
    pub(crate) roulette: Roulette,

    /// Random stream.
    #[arg(long, default_value = "sobol")]
    pub(crate) sampler: Sampler,

    /// Seed of the random stream: another one gives other noise.
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true)]
    pub(crate) seed: u32,

    /// Pixel filter.
    #[arg(long, default_value = "blackman-harris")]
    pub(crate) filter: Filter,

    /// Aim rays at the lights (next-event estimation); off: lights are found by chance, and point lights never.
    #[arg(long, default_value = "on")]
    pub(crate) light_sampling: Switch,

    /// What shadow rays do at smooth solid glass and water; thin panes always let light through with their tint.
    #[arg(long, default_value = "auto")]
    pub(crate) transmissive_shadows: Shadows,

    /// Whether camera rays see the back of single-sided opaque surfaces.
    #[arg(long, default_value = "cull")]
    pub(crate) back_faces: BackFaces,

    /// Most that light which has scattered twice or more may add to a sample at a time, nits (biased: it takes bright dots away,
    /// and light with them). [default: no limit]
    #[arg(long, value_name = "X", allow_negative_numbers = true, value_parser = positive)]
    pub(crate) clamp: Option<f32>,

    /// How diffuse directions are drawn (for comparisons).
    #[arg(long, default_value = "cosine")]
    pub(crate) hemisphere: Hemisphere,
}

impl SamplingArgs {
    /// The same in the library's terms.
    pub(crate) fn settings(&self) -> RenderSettings {
        RenderSettings {
            max_depth: self.max_depth.0,
            roulette: self.roulette.0,
            sampler: match self.sampler {
                Sampler::Sobol => SamplerKind::Sobol,
                Sampler::Independent => SamplerKind::Independent,
            },
            seed: self.seed,
            filter: match self.filter {
                Filter::Box => FilterKind::Box,
                Filter::Tent => FilterKind::Tent,
                Filter::Gaussian => FilterKind::Gaussian,
                Filter::BlackmanHarris => FilterKind::BlackmanHarris,
            },
            light_sampling: self.light_sampling == Switch::On,
            transmissive_shadows: match self.transmissive_shadows {
                Shadows::Auto => TransmissiveShadows::Auto,
                Shadows::Physical => TransmissiveShadows::Physical,
                Shadows::Straight => TransmissiveShadows::Straight,
            },
            diffuse_sampling: match self.hemisphere {
                Hemisphere::Cosine => DiffuseSampling::Cosine,
                Hemisphere::Uniform => DiffuseSampling::Uniform,
            },
            shade_back_faces: self.back_faces == BackFaces::Shade,
            clamp: self.clamp,
            transparent_background: false,
            object_colors: false,
        }
    }

    /// Names and values as they stand on the command line, for the metadata of a file.
    pub(crate) fn described(&self) -> Vec<(&'static str, String)> {
        vec![
            ("maxDepth", self.max_depth.to_string()),
            ("roulette", self.roulette.to_string()),
            ("sampler", name(self.sampler)),
            ("seed", self.seed.to_string()),
            ("filter", name(self.filter)),
            ("lightSampling", name(self.light_sampling)),
            ("transmissiveShadows", name(self.transmissive_shadows)),
            ("backFaces", name(self.back_faces)),
            ("hemisphere", name(self.hemisphere)),
            ("clamp", self.clamp.map_or_else(|| "off".into(), |c| c.to_string())),
        ]
    }
}

/// The name of a value on the command line.
fn name(value: impl ValueEnum) -> String {
    value.to_possible_value().map(|v| v.get_name().to_string()).unwrap_or_default()
}
