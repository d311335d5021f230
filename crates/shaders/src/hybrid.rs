//! What the passes of a hybrid frame are told, and the SPIR-V of these passes. Twin: `glsl/hybrid/frame.glsl`.

use crate::camera::CameraRecord;
use crate::view::{Push, QueueHead};
use bytemuck::{Pod, Zeroable};

/// Passes of a hybrid frame, in order.
pub mod passes {
    /// Triangles as numbers: vertices.
    pub const VISIBLE_VERT: &[u8] = include_bytes!("../spirv/hybrid/visible.vert.spv");
    /// Triangles as numbers: pixels.
    pub const VISIBLE_FRAG: &[u8] = include_bytes!("../spirv/hybrid/visible.frag.spv");
    /// The same for what is there only in part: vertices.
    pub const COVERED_VERT: &[u8] = include_bytes!("../spirv/hybrid/covered.vert.spv");
    /// The same for what is there only in part: pixels.
    pub const COVERED_FRAG: &[u8] = include_bytes!("../spirv/hybrid/covered.frag.spv");
    /// Planes and first light.
    pub const PLANES: &[u8] = include_bytes!("../spirv/hybrid/planes.comp.spv");
    /// Lengths of lists.
    pub const ADVANCE: &[u8] = include_bytes!("../spirv/hybrid/advance.comp.spv");
    /// Closest surfaces.
    pub const TRACE: &[u8] = include_bytes!("../spirv/hybrid/trace.rgen.spv");
    /// What rays have met.
    pub const SHADE: &[u8] = include_bytes!("../spirv/hybrid/shade.comp.spv");
    /// Shadow rays.
    pub const SHADOW: &[u8] = include_bytes!("../spirv/hybrid/shadow.rgen.spv");
    /// Shadow rays through what lets light through.
    pub const GLASS: &[u8] = include_bytes!("../spirv/hybrid/glass.rgen.spv");
    /// The frame, to the film.
    pub const GATHER: &[u8] = include_bytes!("../spirv/hybrid/gather.comp.spv");
}

/// How many times four words the planes of a pixel take.
pub const PLANE_QUADS: u64 = 5;
/// How many times four words a ray takes: without solids, and with them.
pub const RAY_QUADS: [u64; 2] = [4, 6];
/// How many times four words a shadow ray takes: without solids, and with them.
pub const SHADOW_QUADS: [u64; 2] = [3, 5];

/// Shadow rays to lights with sharp shadows that one surface asks for.
pub const MOST_SHARP: u32 = 4;

/// Lengths of lists, and what is counted.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct FrameHeads {
    /// Rays: one list is read while the other is written.
    pub rays: [QueueHead; 2],
    /// Shadow rays, likewise.
    pub shadows: [QueueHead; 2],
    /// Those of them that meet what lets light through.
    pub glass: [QueueHead; 2],
    /// Groups that shade: `VkDispatchIndirectCommand`.
    pub groups: [u32; 3],
    /// Rays traced from surfaces in this frame.
    pub traced_rays: u32,
    /// Shadow rays.
    pub traced_shadows: u32,
    /// Rays for which there was no room.
    pub dropped: u32,
}

/// Where everything of a frame lies.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct FrameTable {
    /// Address of geometry and primitive of each pixel.
    pub ids: u64,
    /// Address of the planes: [`PLANE_QUADS`] of each pixel.
    pub planes: u64,
    /// Address of two lists of `ray_capacity` rays.
    pub rays: u64,
    /// Address of two lists of `shadow_capacity` shadow rays.
    pub shadows: u64,
    /// Address of two lists of as many numbers of shadow rays.
    pub glass: u64,
    /// Address of the [`FrameHeads`].
    pub heads: u64,
    /// Address of the light of each pixel, three sums of quanta.
    pub sums: u64,
    /// Address of the numbers of lights with sharp shadows.
    pub sharp_lights: u64,
    /// Address of the transforms as they were in the frame before.
    pub previous_transforms: u64,
    /// How many lights have sharp shadows.
    pub sharp_light_count: u32,
    /// Rays that there is room for in a list.
    pub ray_capacity: u32,
    /// Shadow rays that there is room for in a list.
    pub shadow_capacity: u32,
    /// Most rays one after another, the camera's not counted.
    pub depth: u32,
    /// Where in their pixels the camera looks, from the centre, pixels.
    pub jitter: [f32; 2],
    /// For cameras whose rays are parallel: metres that are drawn.
    pub far: f32,
    /// Nearest distance that is drawn, metres.
    pub near: f32,
    /// Radiance that stands for what no ray brings.
    pub ambient: [f32; 3],
    /// The camera of the frame before.
    pub previous: CameraRecord,
}

/// Push constants of the passes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct FramePush {
    /// As the path tracer has them.
    pub path: Push,
    /// Address of the [`FrameTable`].
    pub frame: u64,
}
