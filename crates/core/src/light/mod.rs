//! Lights, one file for each kind. Each answers two questions: draw a direction towards the light from a point, and with what
//! density (sr⁻¹) would that have been done. Point, spot and directional lights cannot be hit; they answer with a delta.

pub mod directional;
pub mod environment;
pub mod point;
pub mod spot;
pub mod sun;
pub mod triangle;

use crate::math::Vec3;
use crate::rgb::Spectrum;

/// Light that arrives at a point from a light that no ray can hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeltaSample {
    /// Unit direction towards the light.
    pub wi: Vec3,
    /// Distance to it, metres; infinite for directional light.
    pub distance: f32,
    /// Irradiance on a surface that faces it, without occlusion.
    pub irradiance: Spectrum,
}
