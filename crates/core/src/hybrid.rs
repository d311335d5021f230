//! What hybrid frames honour beside the settings of a render: what the camera sees is rasterised, the rest is brought by rays.

use crate::Spectrum;
use crate::settings::View;

/// Settings of hybrid frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HybridSettings {
    /// Most rays one after another, the camera's not counted: 0 shows what emits.
    pub depth: u32,
    /// Radiance that stands for all light that no ray brings; `None`: found from the lights of the scene.
    pub ambient: Option<Spectrum>,
}

impl HybridSettings {
    /// Largest `depth`.
    pub const MOST_DEPTH: u32 = 64;
}

impl Default for HybridSettings {
    fn default() -> Self {
        HybridSettings { depth: 10, ambient: None }
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
