//! What is shared with the shaders that trace a list of rays and say what they hit. Twin: `glsl/replay/push.glsl`.

use bytemuck::{Pod, Zeroable};

/// Ray generation.
pub const RGEN: &[u8] = include_bytes!("../spirv/replay/replay.rgen.spv");
/// Ray generation that looks textures up instead: [`TextureQuery`]s for rays, [`TextureAnswer`]s for hits.
pub const TEXTURE_RGEN: &[u8] = include_bytes!("../spirv/replay/texture.rgen.spv");
/// Closest hit of a path's ray.
pub const RCHIT: &[u8] = include_bytes!("../spirv/replay/hit.rchit.spv");
/// Any hit of a ray of any kind. Constant 0, `bool`: all such surfaces let it pass; otherwise none.
pub const RAHIT: &[u8] = include_bytes!("../spirv/replay/hit.rahit.spv");
/// Any hit of a path's ray that asks surfaces as the path tracer does.
pub const PATH_RAHIT: &[u8] = include_bytes!("../spirv/replay/path.rahit.spv");
/// Any hit of such a shadow ray.
pub const SHADOW_RAHIT: &[u8] = include_bytes!("../spirv/replay/shadow.rahit.spv");
/// Rays and findings of a list of the path tracer: [`CollectPush`].
pub const COLLECT: &[u8] = include_bytes!("../spirv/replay/collect.comp.spv");
/// Miss of a path's ray.
pub const PATH_RMISS: &[u8] = include_bytes!("../spirv/replay/path.rmiss.spv");
/// Miss of a shadow ray.
pub const SHADOW_RMISS: &[u8] = include_bytes!("../spirv/replay/shadow.rmiss.spv");

/// Kinds in [`ReplayRay::kind`].
pub mod kind {
    /// A ray of a path.
    pub const PATH: u32 = 0;
    /// A ray of the camera, which does not see the back faces of some surfaces.
    pub const CAMERA: u32 = 1;
    /// A shadow ray.
    pub const SHADOW: u32 = 2;
    /// A shadow ray that solids let pass straight.
    pub const SHADOW_STRAIGHT: u32 = 3;
    /// No ray.
    pub const NONE: u32 = 4;
}

/// A ray.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ReplayRay {
    /// Origin, metres.
    pub origin: [f32; 3],
    /// Nearest distance that counts.
    pub t_min: f32,
    /// Direction, unit.
    pub dir: [f32; 3],
    /// Farthest distance that counts.
    pub t_max: f32,
    /// One of [`kind`].
    pub kind: u32,
    /// Which surfaces it finds that are there only in part, where the replay asks as the path tracer does.
    pub key: u32,
}

/// What it hits.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ReplayHit {
    /// Distance; negative: nothing was hit. 0 for a shadow ray that something stops; it does not say what.
    pub t: f32,
    /// Instance of the scene.
    pub instance: u32,
    /// Triangle of its mesh.
    pub triangle: u32,
    /// Barycentric coordinates of the second and third vertex.
    pub b: [f32; 2],
}

/// A place of a texture.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TextureQuery {
    /// Which texture.
    pub texture: u32,
    /// 1: colours are coded by the sRGB curve; 0: all is linear.
    pub srgb: u32,
    /// Texture coordinates.
    pub uv: [f32; 2],
}

/// What is there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TextureAnswer {
    /// From an image.
    pub value: [f32; 4],
    /// Alpha from texels in memory; -1 where there are none.
    pub alpha: f32,
}

/// Push constants.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct Push {
    /// Address of the tables of numbers; only looking textures up reads them.
    pub tables: u64,
    /// Address of the [`crate::layout::SceneTable`].
    pub scene: u64,
    /// Address of the rays.
    pub rays: u64,
    /// Address of what they hit.
    pub hits: u64,
    /// How many there are.
    pub count: u32,
    /// Nothing: a record without gaps.
    pub unused: u32,
}

/// What [`CollectPush`] asks for beside the shadow rays of a group of lights, in `path.group`.
pub mod collect {
    /// Rays of paths, before they are traced.
    pub const PATHS: u32 = 2;
    /// What they found.
    pub const FOUND: u32 = 3;
}

/// Push constants of [`COLLECT`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct CollectPush {
    /// What the path tracer is told.
    pub path: crate::view::Push,
    /// Address of the rays.
    pub rays: u64,
    /// Address of what they found.
    pub hits: u64,
}
