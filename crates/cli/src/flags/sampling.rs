//! Flags on how light is sampled.

use super::output::BACKGROUND;
use super::values::{Depth, Roulette, depth, positive, roulette};
use clap::{Args, ValueEnum};
use lumbre::core::bsdf::DiffuseSampling;
use lumbre::core::filter::FilterKind;
use lumbre::core::sampler::SamplerKind;
use lumbre::core::settings::{RenderSettings, TransmissiveShadows};
use lumbre::edits::Value;

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
    /// None: all samples at the centre of their pixel
    Point,
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
    /// Most scattering events on a path. [default: 16]
    #[arg(long, value_name = "N|unlimited", allow_negative_numbers = true, value_parser = depth)]
    pub(crate) max_depth: Option<Depth>,

    /// How often surfaces that are no mirrors or clear glass may throw light on others: 0 leaves direct light, 1 adds what
    /// arrives by one such surface. [default: unlimited]
    #[arg(long, value_name = "N|unlimited", allow_negative_numbers = true, value_parser = depth)]
    pub(crate) rough_bounces: Option<Depth>,

    /// First scattering event after which Russian roulette may end a path. [default: 4]
    #[arg(long, value_name = "N|off", allow_negative_numbers = true, value_parser = roulette)]
    pub(crate) roulette: Option<Roulette>,

    /// Random stream. [default: sobol]
    #[arg(long)]
    pub(crate) sampler: Option<Sampler>,

    /// Seed of the random stream: another one gives other noise. [default: 0]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) seed: Option<u32>,

    /// Pixel filter. [default: blackman-harris]
    #[arg(long)]
    pub(crate) filter: Option<Filter>,

    /// Aim rays at the lights (next-event estimation); off: lights are found by chance, and point lights never. [default: on]
    #[arg(long)]
    pub(crate) light_sampling: Option<Switch>,

    /// What shadow rays do at smooth solid glass and water; thin panes always let light through with their tint. [default: auto]
    #[arg(long)]
    pub(crate) transmissive_shadows: Option<Shadows>,

    /// Whether camera rays see the back of single-sided opaque surfaces. [default: cull]
    #[arg(long)]
    pub(crate) back_faces: Option<BackFaces>,

    /// Most that light which has scattered twice or more may add to a sample at a time, nits (biased: it takes bright dots away,
    /// and light with them). [default: no limit]
    #[arg(long, value_name = "X", allow_negative_numbers = true, value_parser = positive)]
    pub(crate) clamp: Option<f32>,

    /// How diffuse directions are drawn (for comparisons). [default: cosine]
    #[arg(long)]
    pub(crate) hemisphere: Option<Hemisphere>,
}

impl SamplingArgs {
    /// The same in the library's terms: what was given, in the place of what stands in `base`.
    pub(crate) fn settings(&self, base: RenderSettings) -> RenderSettings {
        let sampler = self.sampler.map(|s| match s {
            Sampler::Sobol => SamplerKind::Sobol,
            Sampler::Independent => SamplerKind::Independent,
        });
        let filter = self.filter.map(|f| match f {
            Filter::Box => FilterKind::Box,
            Filter::Tent => FilterKind::Tent,
            Filter::Gaussian => FilterKind::Gaussian,
            Filter::BlackmanHarris => FilterKind::BlackmanHarris,
            Filter::Point => FilterKind::Point,
        });
        let shadows = self.transmissive_shadows.map(|s| match s {
            Shadows::Auto => TransmissiveShadows::Auto,
            Shadows::Physical => TransmissiveShadows::Physical,
            Shadows::Straight => TransmissiveShadows::Straight,
        });
        let diffuse = self.hemisphere.map(|h| match h {
            Hemisphere::Cosine => DiffuseSampling::Cosine,
            Hemisphere::Uniform => DiffuseSampling::Uniform,
        });
        RenderSettings {
            max_depth: self.max_depth.map_or(base.max_depth, |d| d.0),
            rough_bounces: self.rough_bounces.map_or(base.rough_bounces, |d| d.0),
            roulette: self.roulette.map_or(base.roulette, |r| r.0),
            sampler: sampler.unwrap_or(base.sampler),
            seed: self.seed.unwrap_or(base.seed),
            filter: filter.unwrap_or(base.filter),
            light_sampling: self.light_sampling.map_or(base.light_sampling, |s| s == Switch::On),
            transmissive_shadows: shadows.unwrap_or(base.transmissive_shadows),
            diffuse_sampling: diffuse.unwrap_or(base.diffuse_sampling),
            shade_back_faces: self.back_faces.map_or(base.shade_back_faces, |b| b == BackFaces::Shade),
            clamp: self.clamp.or(base.clamp),
            ..base
        }
    }
}

/// Names and values of settings as they stand on the command line, for the metadata of a file and the foot of a table.
pub(crate) fn described(settings: &RenderSettings) -> Vec<(&'static str, String)> {
    let text = |value: Value| match value {
        Value::Flag(on) => if on { "on" } else { "off" }.to_owned(),
        Value::Word(word) => word.to_owned(),
        other => other.to_string(),
    };
    let rows = lumbre::edits::settings_rows(settings).into_iter();
    // The background has its own place, and is said only where it is left out.
    rows.filter(|row| row.name != BACKGROUND).map(|row| (row.name, text(row.value))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{CommandFactory, Parser};

    #[derive(Debug, Parser)]
    struct Only {
        #[command(flatten)]
        sampling: SamplingArgs,
    }

    #[test]
    fn the_defaults_are_those_that_the_help_says() {
        let none = Only::try_parse_from(["x"]).unwrap().sampling.settings(RenderSettings::default());
        assert_eq!(none, RenderSettings::default());
        for arg in Only::command().get_arguments().filter(|a| a.get_id() != "help") {
            let help = arg.get_help().unwrap().to_string();
            let (_, said) = help.trim_end_matches(']').split_once("[default: ").unwrap();
            if said == "no limit" {
                continue;
            }
            let flag = format!("--{}", arg.get_long().unwrap());
            let given = Only::try_parse_from(["x", &flag, said]).unwrap().sampling;
            // Over settings that differ from the default in everything, it brings the default back.
            let other = RenderSettings {
                max_depth: None,
                rough_bounces: Some(1),
                roulette: None,
                sampler: SamplerKind::Independent,
                seed: 9,
                filter: FilterKind::Box,
                light_sampling: false,
                transmissive_shadows: TransmissiveShadows::Physical,
                diffuse_sampling: DiffuseSampling::Uniform,
                shade_back_faces: true,
                ..RenderSettings::default()
            };
            let differing = |s: &RenderSettings| {
                let (a, b) = (described(s), described(&RenderSettings::default()));
                a.into_iter().zip(b).filter(|(a, b)| a != b).count()
            };
            assert_eq!((differing(&other), differing(&given.settings(other))), (10, 9), "{flag}");
        }
    }
}
