//! What the path tracer's shaders and Rust share beside the records of `CompiledScene`, which go to the device as they are. Each struct has a
//! twin of the same name and the same members in `glsl/scene/layout.glsl`; a test compares the offsets of both.
//!
//! Arrays are reached by 64-bit device addresses, so that a big scene may lie in many buffers: per-mesh data is addressed mesh by mesh.

use bytemuck::{Pod, Zeroable};
use lumbre_scene::compiled::lights::{EnvironmentRecord, SunRecord};

/// Where everything of a scene lies.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SceneTable {
    /// `GeometryRecord`s: what the hits of each geometry of an acceleration structure are.
    pub geometries: u64,
    /// `MeshTable`s, as many as meshes.
    pub meshes: u64,
    /// `InstanceRecord`s.
    pub instances: u64,
    /// `TransformKey`s.
    pub transforms: u64,
    /// `MaterialRecord`s.
    pub materials: u64,
    /// `LobesRecord`s.
    pub lobes: u64,
    /// `TextureTable`s.
    pub textures: u64,
    /// Ranks of triangles among the emissive ones of their meshes.
    pub emissive_ranks: u64,
    /// `LightRecord`s.
    pub lights: u64,
    /// Cumulative probabilities of the near lights, `near_lights` + 1 floats.
    pub near_light_cdf: u64,
    /// The same for the far ones.
    pub far_light_cdf: u64,
    /// `TriangleLightRecord`s.
    pub triangle_lights: u64,
    /// `PunctualRecord`s.
    pub punctual_lights: u64,
    /// Texels of the environment, three floats each.
    pub environment_pixels: u64,
    /// Its distribution over rows.
    pub environment_row_cdf: u64,
    /// Its distribution within rows.
    pub environment_cell_cdf: u64,
    /// Lights of the scene's space: the first of `lights`.
    pub near_lights: u32,
    /// Lights from far away: the others.
    pub far_lights: u32,
    /// The sun.
    pub sun: SunRecord,
    /// The environment.
    pub environment: EnvironmentRecord,
}

/// A geometry of a bottom-level structure: `gl_InstanceCustomIndexEXT` + `gl_GeometryIndexEXT` is its place in the list.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct GeometryRecord {
    /// Address of a `u32` for each of its primitives, the triangle's number in its mesh; 0: they are numbered alike.
    pub triangle_ids: u64,
    /// Which instance of the scene.
    pub instance: u32,
    /// Which mesh.
    pub mesh: u32,
}

/// Where the data of a mesh lie. Indices of `triangles` count from the start of the arrays of vertices here.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct MeshTable {
    /// Three indices for each triangle of the mesh.
    pub triangles: u64,
    /// A material for each triangle of the mesh.
    pub triangle_materials: u64,
    /// Positions, three floats each.
    pub positions: u64,
    /// Normals, three floats each.
    pub normals: u64,
    /// `Vertex`es.
    pub vertices: u64,
    /// Start of its part of `emissive_ranks`, or `NONE`.
    pub first_emissive_rank: u32,
    /// Bits of `attribute`: what its vertices have.
    pub attributes: u32,
}

/// A texture: how it is read, and where its texels lie for shaders that filter by hand.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct TextureTable {
    /// Address of its texels, RGBA8, red in the low byte; 0 where they lie in an image only.
    pub texels: u64,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Along u: one of `wrap`.
    pub wrap_s: u32,
    /// Along v: one of `wrap`.
    pub wrap_t: u32,
    /// 1: the nearest texel; 0: bilinear.
    pub nearest: u32,
    /// Nothing: keeps the addresses aligned.
    pub unused: u32,
}

/// Classes of triangles by what rays must ask of them. A geometry holds triangles of one class; its place in the shader binding table
/// is that of its class.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u32)]
pub enum HitClass {
    /// Stops every ray.
    Opaque = 0,
    /// Always there, but lets some light through: shadow rays ask.
    Transmissive = 1,
    /// There only in part: every ray asks.
    Covered = 2,
}

impl HitClass {
    /// All of them, in the order of the shader binding table.
    pub const ALL: [HitClass; 3] = [HitClass::Opaque, HitClass::Transmissive, HitClass::Covered];
}

/// Kinds of rays, in the order of the shader binding table: the hit record of a class is `class * RAY_KINDS + kind`, the miss
/// record is `kind`.
pub const RAY_KINDS: u32 = 2;
/// Rays of paths: the closest surface.
pub const RAY_RADIANCE: u32 = 0;
/// Shadow rays: whether anything is in the way.
pub const RAY_SHADOW: u32 = 1;

/// Bindings of descriptor set 0.
pub mod binding {
    /// The top-level acceleration structure.
    pub const TLAS: u32 = 0;
    /// Textures: as many as the scene has.
    pub const TEXTURES: u32 = 1;
}
