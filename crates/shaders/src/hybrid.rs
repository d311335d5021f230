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
    /// Soft light over time.
    pub const FILTER_TEMPORAL: &[u8] = include_bytes!("../spirv/hybrid/filter/temporal.comp.spv");
    /// Soft light over space.
    pub const FILTER_ATROUS: &[u8] = include_bytes!("../spirv/hybrid/filter/atrous.comp.spv");
    /// Sharp and soft light.
    pub const COMPOSE: &[u8] = include_bytes!("../spirv/hybrid/compose.comp.spv");
    /// Edges, over time.
    pub const AA_TEMPORAL: &[u8] = include_bytes!("../spirv/hybrid/anti_aliasing/temporal.comp.spv");
    /// Edges of one frame.
    pub const AA_FXAA: &[u8] = include_bytes!("../spirv/hybrid/anti_aliasing/fxaa.comp.spv");
    /// The picture, to the film.
    pub const GATHER: &[u8] = include_bytes!("../spirv/hybrid/gather.comp.spv");
}

/// How many times four words the planes of a pixel take.
pub const PLANE_QUADS: u64 = 6;
/// How many times four words of them are kept for the next frame.
pub const PREVIOUS_QUADS: u64 = 2;
/// How many times four words a ray takes: without solids, and with them.
pub const RAY_QUADS: [u64; 2] = [4, 6];
/// How many times four words a shadow ray takes: without solids, and with them.
pub const SHADOW_QUADS: [u64; 2] = [3, 5];

/// Kinds of light that a frame sums apart: sharp, soft and gathered.
pub const CHANNELS: u64 = 3;
/// Bytes of the sums from which ambient light is found.
pub const MEASURED_BYTES: u64 = 32;
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
    /// Address of the light of each pixel, three sums of quanta for each of [`CHANNELS`].
    pub sums: u64,
    /// Addresses of what gathering rays brought in the mean: two sums that take turns, [`MEASURED_BYTES`] each.
    pub measured: [u64; 2],
    /// Address of the numbers of lights with sharp shadows.
    pub sharp_lights: u64,
    /// Address of what is kept of the planes of the frame before: [`PREVIOUS_QUADS`] of each pixel.
    pub previous_planes: u64,
    /// Addresses of soft light and its variance, four floats a pixel: two that take turns.
    pub soft: [u64; 2],
    /// Address of what the next frame goes on from.
    pub soft_history: u64,
    /// Addresses of its moments over frames: two that take turns.
    pub moments: [u64; 2],
    /// Address of the frame before anti-aliasing.
    pub drawn: u64,
    /// Addresses of the picture that is shown: two that take turns.
    pub shown: [u64; 2],
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
    /// The same in the frame before.
    pub previous_jitter: [f32; 2],
    /// For cameras whose rays are parallel: metres that are drawn.
    pub far: f32,
    /// Nearest distance that is drawn, metres.
    pub near: f32,
    /// Radiance that stands for what no ray brings, until it is measured.
    pub ambient: [f32; 3],
    /// Metres beyond which nothing occludes ambient light.
    pub occlusion_reach: f32,
    /// The camera of the frame before.
    pub previous: CameraRecord,
    /// Columns and rows of the picture that is shown.
    pub shown_size: [u32; 2],
    /// Which of two buffers that take turns between frames is this frame's.
    pub turn: u32,
    /// 1: there was a frame before.
    pub has_history: u32,
    /// 1: and nothing has changed since.
    pub is_still: u32,
    /// 1: `ambient` counts, whatever is measured.
    pub ambient_is_given: u32,
    /// Always 0: what alignment leaves over.
    pub unused: u32,
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
