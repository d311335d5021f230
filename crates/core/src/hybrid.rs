//! What hybrid frames honour beside the settings of a render: what the camera sees is rasterised, the rest is brought by rays.

use crate::Spectrum;

/// Settings of hybrid frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HybridSettings {
    /// Most rays one after another, the camera's not counted: 0 shows what emits.
    pub depth: u32,
    /// Radiance that stands for all light that no ray brings; `None`: found from the lights of the scene.
    pub ambient: Option<Spectrum>,
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
