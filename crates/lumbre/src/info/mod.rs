//! What a scene holds, what it will take to draw it, and why its picture might be black or not as meant.
//!
//! [`info`] compiles the scene, builds its trees and sends a handful of rays from its cameras and lights, and it draws a
//! picture of some thousand samples; that takes about as long as opening the scene for a render.

mod count;
mod hints;
mod lobes;
mod probe;
#[cfg(test)]
mod tests;
mod view;

pub use hints::{Hint, HintKind};

use crate::{DeviceError, camera, prepare_cpu};
use glam::Vec3;
use lumbre_scene::{CompileError, Compiled, Projection, Scene, compile};

/// What there is to know about a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneInfo {
    /// Meshes and what they are made of.
    pub geometry: GeometryInfo,
    /// Corners of the box around all that is drawn, metres, world space; `None`: nothing is drawn.
    pub bounds: Option<[Vec3; 2]>,
    /// Textures and their images.
    pub textures: TextureInfo,
    /// What gives light.
    pub lights: LightInfo,
    /// The materials, by id.
    pub materials: Vec<MaterialInfo>,
    /// The cameras that the nodes place, in the order in which [`CameraChoice::Index`](crate::CameraChoice) counts them.
    pub cameras: Vec<CameraInfo>,
    /// Memory that it takes.
    pub memory: MemoryInfo,
    /// What is left out of the picture or replaced: one line each, as [`compile()`] tells them.
    pub notes: Vec<String>,
    /// Why the picture might not be as meant; the gravest first.
    pub hints: Vec<Hint>,
}

/// Meshes and what they are made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GeometryInfo {
    /// Meshes.
    pub meshes: usize,
    /// Parts of meshes, each of one material.
    pub primitives: usize,
    /// Meshes placed in the world.
    pub instances: usize,
    /// Triangles, each mesh counted once.
    pub triangles: u64,
    /// Triangles, each mesh counted as often as it is placed.
    pub drawn_triangles: u64,
    /// Vertices, each mesh counted once.
    pub vertices: u64,
    /// Triangles without area, which no ray meets; each mesh counted once.
    pub degenerate_triangles: u64,
    /// Primitives without normals, which are shaded flat.
    pub flat_primitives: usize,
}

/// Textures and their images.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TextureInfo {
    /// Textures in use.
    pub textures: usize,
    /// The images behind them.
    pub images: Vec<ImageInfo>,
    /// Bytes of all images, decoded.
    pub bytes: u64,
}

/// One image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImageInfo {
    /// Its name, or that of its file; may be empty.
    pub name: String,
    /// Columns and rows.
    pub size: [u32; 2],
    /// Bytes, decoded.
    pub bytes: u64,
}

/// What gives light; only what shines counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LightInfo {
    /// Point lights.
    pub point: usize,
    /// Spot lights.
    pub spot: usize,
    /// Directional lights.
    pub directional: usize,
    /// Materials in use that emit.
    pub emissive_materials: usize,
    /// Emissive triangles in the world.
    pub emissive_triangles: usize,
    /// The background: "none", "colour", "gradient" or "map".
    pub background: &'static str,
    /// Whether there is a sun.
    pub sun: bool,
}

/// One material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaterialInfo {
    /// Its name; may be empty.
    pub name: String,
    /// Whether something that is drawn is made of it.
    pub used: bool,
    /// What it is made of, in plain words ("diffuse", "clearcoat", "alpha mask"…).
    pub lobes: Vec<&'static str>,
    /// How many textures it refers to.
    pub textures: usize,
}

/// One camera.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraInfo {
    /// Its name, else that of its node; may be empty.
    pub name: String,
    /// How it projects.
    pub projection: Projection,
    /// Where it stands, metres, world space.
    pub position: Vec3,
}

/// Memory that a scene takes, bytes; a film comes on top ([`Film::bytes`](lumbre_core::Film::bytes)).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MemoryInfo {
    /// The compiled scene.
    pub scene: u64,
    /// The trees that the CPU traces rays against.
    pub acceleration: u64,
    /// The authored scene, which is there beside the compiled one while it is opened, and gone before the render.
    pub opening: u64,
}

/// Why nothing can be said about a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum InfoError {
    /// It cannot be compiled.
    #[error(transparent)]
    Compile(#[from] CompileError),
    /// The rays that look for hints cannot be traced.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

/// Looks a scene over.
///
/// # Errors
/// If the scene cannot be compiled, or the environment variable `LUMBRE_SIMD` holds no known level.
pub fn info(scene: &Scene) -> Result<SceneInfo, InfoError> {
    let Compiled { scene: compiled, notes } = compile(scene)?;
    let geometry = count::geometry(scene, &compiled);
    let [min, max] = compiled.bounds.map(Vec3::from_array);
    let bounds = (geometry.drawn_triangles > 0 && min.cmple(max).all()).then_some([min, max]);
    let lights = count::lights(scene, &compiled);
    let materials = lobes::materials(scene);
    let scene_bytes = compiled.bytes();
    let backend = prepare_cpu(compiled)?;
    let memory = MemoryInfo {
        scene: scene_bytes,
        acceleration: backend.accel().memory() as u64,
        opening: count::authored_bytes(scene),
    };
    let mut hints = hints::of_scene(scene, &geometry, bounds);
    if bounds.is_some() {
        hints.extend(view::hints(scene, &backend));
    }
    hints.sort_by_key(|h| h.kind);
    Ok(SceneInfo {
        geometry,
        bounds,
        textures: count::textures(scene),
        lights,
        materials,
        cameras: camera::infos(scene),
        memory,
        notes,
        hints,
    })
}
