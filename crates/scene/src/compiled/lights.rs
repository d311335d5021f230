//! Records of lights.

use bytemuck::{Pod, Zeroable};
use lumbre_core::Rgb;

/// Kinds in [`LightRecord::kind`].
pub mod kind {
    /// An emissive triangle: index into `triangle_lights`.
    pub const TRIANGLE: u32 = 0;
    /// A point light: index into `punctual_lights`.
    pub const POINT: u32 = 1;
    /// A spot light: index into `punctual_lights`.
    pub const SPOT: u32 = 2;
    /// A directional light: index into `punctual_lights`.
    pub const DIRECTIONAL: u32 = 3;
    /// The sun.
    pub const SUN: u32 = 4;
    /// The environment.
    pub const ENVIRONMENT: u32 = 5;
}

/// Lights are sampled in two groups, one light of each at a vertex: what comes from afar says nothing of what lamps give, nor
/// how much of either a wall keeps away.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightGroup {
    /// Emissive triangles, point and spot lights.
    Near,
    /// Directional lights, sun, environment.
    Far,
}

/// One light of the light sampler.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct LightRecord {
    /// One of [`kind`].
    pub kind: u32,
    /// Index into the array of its kind.
    pub index: u32,
}

/// An emissive triangle, world space.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TriangleLightRecord {
    /// First vertex.
    pub p0: [f32; 3],
    /// Second vertex less the first.
    pub e1: [f32; 3],
    /// Third vertex less the first.
    pub e2: [f32; 3],
    /// Emitted radiance before any texture.
    pub radiance: Rgb,
    /// The instance it belongs to.
    pub instance: u32,
    /// Its triangle within the mesh.
    pub triangle: u32,
    /// +1: emits on the side from which it winds counter-clockwise; -1: on the other; 0: on both.
    pub side: f32,
    /// 1 when the material has an emissive texture, which must be looked up.
    pub textured: u32,
}

/// A point, spot or directional light, world space.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct PunctualRecord {
    /// Candela, or lux for directional light.
    pub intensity: Rgb,
    /// Where it stands.
    pub position: [f32; 3],
    /// The way its light travels, unit.
    pub axis: [f32; 3],
    /// Cosine of the angle where a spot's falloff begins.
    pub cos_inner: f32,
    /// Cosine of the angle where it ends.
    pub cos_outer: f32,
}

/// The sun.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SunRecord {
    /// Unit direction to it.
    pub direction: [f32; 3],
    /// 1 - cos of its angular radius.
    pub one_minus_cos: f32,
    /// Its radiance.
    pub radiance: Rgb,
    /// Its place in `lights`, or [`super::NONE`].
    pub light: u32,
}

impl Default for SunRecord {
    fn default() -> Self {
        SunRecord { direction: [0.0, 1.0, 0.0], one_minus_cos: 0.0, radiance: Rgb::BLACK, light: super::NONE }
    }
}

/// The environment map.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct EnvironmentRecord {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Rotation about +y, radians.
    pub rotation: f32,
    /// Its place in `lights`, or [`super::NONE`].
    pub light: u32,
}

impl Default for EnvironmentRecord {
    fn default() -> Self {
        EnvironmentRecord { width: 1, height: 1, rotation: 0.0, light: super::NONE }
    }
}
