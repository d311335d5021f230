//! What hybrid frames honour beside the settings of a render: what the camera sees is rasterised, the rest is brought by rays.

use crate::Spectrum;
use crate::settings::View;

/// How edges are made smooth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum AntiAliasing {
    /// Not at all: one sample at the centre of each pixel.
    None,
    /// In each frame by itself, along the edges that it finds (FXAA).
    Fxaa,
    /// Over frames, which look through other places of their pixels.
    #[default]
    Temporal,
}

/// Settings of hybrid frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HybridSettings {
    /// Most rays one after another, the camera's not counted: 0 shows what emits.
    pub depth: u32,
    /// Radiance that stands for all light that no ray brings; `None`: found from the lights of the scene.
    pub ambient: Option<Spectrum>,
    /// Lamps that have a size and the disc of the sun light what the camera sees, with penumbras. Otherwise lamps only glow, and the sun is a point
    /// of the sky.
    pub soft_shadows: bool,
    /// Ambient light does not reach what things stand close to.
    pub ambient_occlusion: bool,
    /// Metres that count as close; `None`: found from the size of the scene.
    pub occlusion_reach: Option<f32>,
    /// What the camera sees is lit by the sky and by other surfaces, in the place of ambient light. These have ambient light.
    pub global_illumination: bool,
    /// What each frame has one sample of is filtered over space and time; otherwise it is shown as it is.
    pub filter: bool,
    /// Edges.
    pub anti_aliasing: AntiAliasing,
    /// Rows and columns that are drawn, over those that are shown: [`HybridSettings::LEAST_SCALE`] to 1. Below 1 only with
    /// [`AntiAliasing::Temporal`], which makes up for it.
    pub render_scale: f32,
}

impl HybridSettings {
    /// Largest `depth`.
    pub const MOST_DEPTH: u32 = 64;

    /// What the thesis's program draws: sharp shadows, mirrors and glass, ambient light.
    pub const THESIS: Self = HybridSettings {
        depth: 10,
        ambient: None,
        soft_shadows: false,
        ambient_occlusion: false,
        occlusion_reach: None,
        global_illumination: false,
        filter: false,
        anti_aliasing: AntiAliasing::Fxaa,
        render_scale: 1.0,
    };

    /// Smallest `render_scale`.
    pub const LEAST_SCALE: f32 = 0.5;

    /// Everything.
    pub const ALL: Self = HybridSettings {
        soft_shadows: true,
        global_illumination: true,
        filter: true,
        anti_aliasing: AntiAliasing::Temporal,
        ..HybridSettings::THESIS
    };

    /// Columns and rows of a frame for a picture of this size.
    pub fn drawn_size(&self, shown: [u32; 2]) -> [u32; 2] {
        let scale = match self.anti_aliasing {
            AntiAliasing::Temporal => self.render_scale.clamp(Self::LEAST_SCALE, 1.0),
            _ => 1.0,
        };
        shown.map(|n| ((n as f32 * scale).round() as u32).clamp(n.min(1), n))
    }

    /// Whether frames have samples of light that are filtered.
    pub fn has_soft_light(&self) -> bool {
        self.soft_shadows || self.global_illumination || self.ambient_occlusion
    }
}

impl Default for HybridSettings {
    fn default() -> Self {
        HybridSettings::ALL
    }
}

/// What was done for a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameReport {
    /// Rays from surfaces: mirrored, refracted.
    pub rays: u64,
    /// Rays to lights.
    pub shadow_rays: u64,
    /// Rays for which there was no room: their light is missing.
    pub dropped: u64,
}

/// What a frame knows of a pixel, of the frame's own size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelPlanes {
    /// Shading normal, world space, on the side of the camera; zero for the sky.
    pub normal: [f32; 3],
    /// Distance along the camera's ray, metres; infinite for the sky.
    pub distance: f32,
    /// Directional albedo of all lobes, 0 to 1.
    pub albedo: [f32; 3],
    /// Perceptual roughness.
    pub roughness: f32,
    /// Reflectance of the interface over the diffuse base at normal incidence.
    pub specularity: f32,
    /// Point, world space, metres.
    pub position: [f32; 3],
    /// Instance of the scene; `None` for the sky.
    pub instance: Option<u32>,
    /// Material of the scene; `None` for the sky.
    pub material: Option<u32>,
    /// From here to where the point was in the frame before, pixels.
    pub motion: [f32; 2],
    /// Emitted radiance.
    pub emission: [f32; 3],
    /// Share of light that is mirrored along delta lobes.
    pub mirrored: f32,
    /// Share of light that is let through along them.
    pub through: f32,
    /// Index of refraction, of a solid the ratio of both sides.
    pub index: f32,
    /// Light that has no noise.
    pub sharp: [f32; 3],
    /// This frame's sample of light straight from lamps and sun.
    pub soft: [f32; 3],
    /// This frame's sample of light from the sky and other surfaces.
    pub gathered: [f32; 3],
    /// Both after the filter; the samples themselves where there is none.
    pub filtered: [f32; 3],
}

/// What a frame took.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameDone {
    /// What was traced for it.
    pub report: FrameReport,
    /// Milliseconds of its passes by the device's clock, in their order; a pass that runs several times stands there as often. All 0 where the
    /// device has no clock.
    pub passes: Vec<(&'static str, f64)>,
}

/// What is drawn: from where, how large, how.
#[derive(Clone, Copy, Debug)]
pub struct FrameView<'a> {
    /// Camera, and of its settings those that say what surfaces and lights look like. Lenses are pinholes.
    pub view: &'a View,
    /// Columns and rows.
    pub size: [u32; 2],
    /// What rays bring.
    pub settings: &'a HybridSettings,
}
