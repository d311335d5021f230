//! What the integrators of every backend honour.

use crate::bsdf::DiffuseSampling;
use crate::camera::Camera;
use crate::filter::FilterKind;
use crate::sampler::SamplerKind;

/// What shadow rays do at smooth transmissive surfaces. Thin walls always let them pass with their tint, which is exact: the
/// direction does not change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum TransmissiveShadows {
    /// Solids let light through straight, with Fresnel and tint, where it comes from a light that scattered rays do not find
    /// (point, spot, directional, sun); they block the light of what can be hit (surfaces, sky), which paths find by themselves.
    #[default]
    Auto,
    /// Solids block: caustics come from scattered rays alone.
    Physical,
    /// Solids let all light through straight, and caustics through them are left out.
    Straight,
}

/// Settings of a path traced render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderSettings {
    /// Most scattering events on a path; `None`: no limit.
    pub max_depth: Option<u32>,
    /// How often light that has left its source may be scattered by lobes that are not delta lobes before it is scattered to the camera; `None`: no
    /// limit. 0: direct light, as in Whitted's method. 1: surfaces light others once.
    pub rough_bounces: Option<u32>,
    /// First event after which roulette may end a path; `None`: never.
    pub roulette: Option<u32>,
    /// Random stream.
    pub sampler: SamplerKind,
    /// Seed of the stream.
    pub seed: u32,
    /// Pixel filter.
    pub filter: FilterKind,
    /// Next-event estimation with multiple importance sampling; without it lights are found by chance alone.
    pub light_sampling: bool,
    /// Shadow rays at glass.
    pub transmissive_shadows: TransmissiveShadows,
    /// How diffuse directions are drawn.
    pub diffuse_sampling: DiffuseSampling,
    /// Camera rays see the back faces of single-sided opaque materials too.
    pub shade_back_faces: bool,
    /// Most that light which has scattered twice or more may add to a camera sample at a time (its largest band; hue is kept).
    /// Takes bright dots away, and light with them: biased. `None`: no limit.
    pub clamp: Option<f32>,
    /// What the camera sees of sky and sun, straight or through thin panes, is left out; alpha says where. They still give light.
    pub transparent_background: bool,
    /// The film's plane of albedo holds a colour for each object ([`crate::color::label`] of its number) instead.
    pub object_colors: bool,
}

impl RenderSettings {
    /// Bound that stands for "no limit": it ends a path that is caught between perfect mirrors.
    pub const DEPTH_BOUND: u32 = 65_536;
}

impl Default for RenderSettings {
    fn default() -> Self {
        RenderSettings {
            max_depth: Some(16),
            rough_bounces: None,
            roulette: Some(4),
            sampler: SamplerKind::Sobol,
            seed: 0,
            filter: FilterKind::default(),
            light_sampling: true,
            transmissive_shadows: TransmissiveShadows::Auto,
            diffuse_sampling: DiffuseSampling::Cosine,
            shade_back_faces: false,
            clamp: None,
            transparent_background: false,
            object_colors: false,
        }
    }
}

/// What is drawn: from where, and how.
#[derive(Clone, Debug)]
pub struct View {
    /// Camera.
    pub camera: Camera,
    /// Settings.
    pub settings: RenderSettings,
    /// Number of the frame: part of the random stream.
    pub frame: u32,
}
