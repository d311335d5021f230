//! The tables of what decides a picture besides its scene: settings of the render, with the names of the command line's flags, and the look.

use super::param::{Access, Changes, FRACTION, HUGE, Param, Row, field, number, or};
use super::value::{Kind, Value};
use crate::look::Look;
use lumbre_core::bsdf::DiffuseSampling;
use lumbre_core::color::Exposure;
use lumbre_core::film::Film;
use lumbre_core::filter::FilterKind;
use lumbre_core::sampler::SamplerKind;
use lumbre_core::settings::{RenderSettings, TransmissiveShadows};
use lumbre_core::tone::ToneCurve;

/// Access to a field of an enum without values, by a list of its words.
macro_rules! words {
    ($field:ident $list:ident) => {
        Access {
            get: |s| Value::Word(word(&$list, s.$field)),
            set: |s, v| s.$field = meaning(&$list, v.word()),
        }
    };
}

/// The word of a value.
fn word<T: PartialEq + Copy>(list: &[(&'static str, T)], value: T) -> &'static str {
    list.iter().find(|(_, v)| *v == value).map_or("", |(word, _)| word)
}

/// The value of a word that was checked.
fn meaning<T: Copy>(list: &[(&'static str, T)], word: &str) -> T {
    list.iter().find(|(w, _)| *w == word).unwrap_or(&list[0]).1
}

const SAMPLERS: [(&str, SamplerKind); 2] =
    [("sobol", SamplerKind::Sobol), ("independent", SamplerKind::Independent)];
const FILTERS: [(&str, FilterKind); 5] = [
    ("box", FilterKind::Box),
    ("tent", FilterKind::Tent),
    ("gaussian", FilterKind::Gaussian),
    ("blackman-harris", FilterKind::BlackmanHarris),
    ("point", FilterKind::Point),
];
const SHADOWS: [(&str, TransmissiveShadows); 3] = [
    ("auto", TransmissiveShadows::Auto),
    ("physical", TransmissiveShadows::Physical),
    ("straight", TransmissiveShadows::Straight),
];
const HEMISPHERES: [(&str, DiffuseSampling); 2] =
    [("cosine", DiffuseSampling::Cosine), ("uniform", DiffuseSampling::Uniform)];
const BACK_FACES: [(&str, bool); 2] = [("cull", false), ("shade", true)];
const BACKGROUNDS: [(&str, bool); 2] = [("scene", false), ("transparent", true)];
const TONES: [(&str, ToneCurve); 6] = [
    ("linear", ToneCurve::Linear),
    ("srgb", ToneCurve::Srgb),
    ("reinhard", ToneCurve::Reinhard),
    ("aces", ToneCurve::Aces),
    ("agx", ToneCurve::Agx),
    ("neutral", ToneCurve::Neutral),
];

/// The words of a list.
const fn choice<T: Copy, const N: usize>(list: &[(&'static str, T); N]) -> [&'static str; N] {
    let mut words = [""; N];
    let mut i = 0;
    while i < N {
        words[i] = list[i].0;
        i += 1;
    }
    words
}

const EVENTS: Kind =
    Kind::Whole { range: [0, RenderSettings::DEPTH_BOUND], slider: [0, 50], words: &["unlimited"] };

type OfPaths = Param<RenderSettings>;

/// All settings of a render that decide the picture.
pub(super) const SETTINGS: &[OfPaths] = &[
    OfPaths::new(
        "maxDepth",
        "Depth",
        EVENTS,
        Access {
            get: |s| s.max_depth.map_or(Value::Word("unlimited"), Value::Whole),
            set: |s, v| s.max_depth = v.as_whole(),
        },
    ),
    OfPaths::new(
        "roughBounces",
        "Rough bounces",
        EVENTS,
        Access {
            get: |s| s.rough_bounces.map_or(Value::Word("unlimited"), Value::Whole),
            set: |s, v| s.rough_bounces = v.as_whole(),
        },
    ),
    OfPaths::new(
        "roulette",
        "Roulette from",
        Kind::Whole { range: [0, u32::MAX], slider: [0, 50], words: &["off"] },
        Access {
            get: |s| s.roulette.map_or(Value::Word("off"), Value::Whole),
            set: |s, v| s.roulette = v.as_whole(),
        },
    ),
    OfPaths::new("sampler", "Sampler", Kind::Choice(&choice(&SAMPLERS)), words!(sampler SAMPLERS)),
    OfPaths::new(
        "seed",
        "Seed",
        Kind::Whole { range: [0, u32::MAX], slider: [0, 100], words: &[] },
        Access { get: |s| Value::Whole(s.seed), set: |s, v| s.seed = v.as_whole().unwrap_or(0) },
    ),
    OfPaths::new("filter", "Filter", Kind::Choice(&choice(&FILTERS)), words!(filter FILTERS)),
    OfPaths::new("lightSampling", "Aim at lights", Kind::Flag, field!(flag light_sampling)),
    OfPaths::new(
        "transmissiveShadows",
        "Shadows of glass",
        Kind::Choice(&choice(&SHADOWS)),
        words!(transmissive_shadows SHADOWS),
    ),
    OfPaths::new(
        "backFaces",
        "Back faces",
        Kind::Choice(&choice(&BACK_FACES)),
        words!(shade_back_faces BACK_FACES),
    ),
    OfPaths::new(
        "hemisphere",
        "Diffuse directions",
        Kind::Choice(&choice(&HEMISPHERES)),
        words!(diffuse_sampling HEMISPHERES),
    ),
    OfPaths::new(
        "clamp",
        "Clamp",
        or(
            Kind::Number { range: [1e-12, HUGE], slider: [0.1, 1e3], log: true, unit: "nit", words: &[] },
            &["off"],
        ),
        Access {
            get: |s| s.clamp.map_or(Value::Word("off"), Value::Number),
            set: |s, v| s.clamp = v.as_number(),
        },
    ),
    OfPaths::new(
        "background",
        "Background",
        Kind::Choice(&choice(&BACKGROUNDS)),
        words!(transparent_background BACKGROUNDS),
    ),
];

/// Settings as rows, with the names of the command line's flags.
pub fn settings_rows(settings: &RenderSettings) -> Vec<Row> {
    Changes::default().rows(SETTINGS, *settings)
}

/// How a film is developed.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct LookEdits {
    /// Exposure, tone curve and lens.
    pub look: Look,
    /// Stops by which an exposure that finds itself is brighter.
    pub offset_ev: f32,
}

impl LookEdits {
    /// The factor of its exposure on this film.
    pub fn exposure_factor(&self, film: &Film) -> f32 {
        let factor = self.look.exposure_factor(film);
        if matches!(self.look.exposure, Exposure::Ev(_)) { factor } else { factor * self.offset_ev.exp2() }
    }
}

const STOPS: Kind = number([-100.0, 100.0], [-10.0, 10.0], "EV");

type OfLook = Param<LookEdits>;

/// All parameters of the look.
pub(super) const LOOK: &[OfLook] = &[
    OfLook::new(
        "exposure",
        "Exposure",
        or(STOPS, &["auto", "thesis"]),
        Access {
            get: |l| match l.look.exposure {
                Exposure::Auto => Value::Word("auto"),
                Exposure::Thesis => Value::Word("thesis"),
                Exposure::Ev(ev) => Value::Number(ev),
            },
            set: |l, v| {
                l.look.exposure = match v {
                    Value::Word("thesis") => Exposure::Thesis,
                    other => other.as_number().map_or(Exposure::Auto, Exposure::Ev),
                }
            },
        },
    ),
    OfLook::new("exposureOffset", "Brighter by", STOPS, field!(number offset_ev))
        .when(|l| !matches!(l.look.exposure, Exposure::Ev(_))),
    OfLook::new(
        "tone",
        "Tone curve",
        Kind::Choice(&choice(&TONES)),
        Access {
            get: |l| Value::Word(word(&TONES, l.look.tone)),
            set: |l, v| l.look.tone = meaning(&TONES, v.word()),
        },
    ),
    OfLook::new("vignette", "Vignette", FRACTION, field!(number look.vignette)),
    OfLook::new(
        "aberration",
        "Aberration",
        number([-Look::MAX_ABERRATION, Look::MAX_ABERRATION], [-5.0, 5.0], "%"),
        field!(number look.aberration),
    ),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_have_the_names_of_the_command_line() {
        assert_eq!(choice(&TONES), ToneCurve::ALL.map(ToneCurve::name));
        for (word, tone) in TONES {
            assert_eq!(word, tone.name());
        }
    }
}
