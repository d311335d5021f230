//! From what an author writes to what a backend reads.
//!
//! Ids are checked here, so that backends may index without asking. What cannot be drawn but does no harm (a mesh squeezed flat
//! by its transform, a punctual light without power) is left out and named in the notes.
//!
//! A scene that differs little from one that was compiled is made from that: each stage asks whether what it reads is still the same
//! (`earlier.rs`) and then shares what it made. The result is the same either way.

mod earlier;
mod environment;
mod geometry;
mod lights;
mod lobes;
mod materials;
mod meshes;
mod tangents;
mod textures;

use crate::compiled::CompiledScene;
use crate::compiled::changes::SceneChanges;
use crate::{MeshId, PlacedNode, Scene};
use earlier::Earlier;
use glam::{Affine3A, Mat4, Vec3};

/// Why a scene cannot be compiled.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CompileError {
    /// An id points past the end of its vector.
    #[error("{place}: there is no {what} {index}")]
    MissingId {
        /// Where the id stands, as a JSON-like path.
        place: String,
        /// Kind of thing it should name.
        what: &'static str,
        /// The id.
        index: u32,
    },
    /// A vector has the wrong length, or a value is out of its domain.
    #[error("{place}: {message}")]
    Invalid {
        /// Where.
        place: String,
        /// What is wrong.
        message: String,
    },
    /// More of something than can be drawn.
    #[error("the scene has more {what} than can be drawn ({limit} at most)")]
    TooLarge {
        /// Of what.
        what: &'static str,
        /// How many can be drawn.
        limit: u32,
    },
}

/// A compiled scene and what was left out of it.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// The scene.
    pub scene: CompiledScene,
    /// One line for each thing that was left out or replaced.
    pub notes: Vec<String>,
}

/// A mesh that a node places in the world.
struct Placed {
    node: u32,
    mesh: MeshId,
    to_world: Affine3A,
    visible: bool,
}

/// Compiles a scene.
///
/// # Errors
/// If an id points nowhere, an array has the wrong length, or there is more than can be drawn.
pub fn compile(scene: &Scene) -> Result<Compiled, CompileError> {
    build(scene, None)
}

/// Compiles `after` and says in what it differs from `compiled`, which [`compile`] or this function made of `before`. The result is that
/// of [`compile`] bit for bit; what both scenes share ([`Scene`]) and what follows from it is taken from `compiled`. So edits of
/// materials, lights, nodes and environment cost what these cost, unless a material begins to need tangents. Edits of meshes or
/// images cost as much as [`compile`].
///
/// # Errors
/// As [`compile`].
pub fn recompile(
    before: &Scene,
    compiled: &CompiledScene,
    after: &Scene,
) -> Result<(Compiled, SceneChanges), CompileError> {
    let made = build(after, Earlier::new(before, compiled, after).as_ref())?;
    let changes = SceneChanges::between(compiled, &made.scene);
    Ok((made, changes))
}

fn build(scene: &Scene, earlier: Option<&Earlier<'_>>) -> Result<Compiled, CompileError> {
    let mut out = CompiledScene::default();
    let mut notes = Vec::new();
    textures::compile(scene, earlier, &mut out)?;
    materials::compile(scene, &mut out, &mut notes)?;
    let (placed, lights) = walk(scene, &mut notes)?;
    let meshes = geometry::compile(scene, &placed, earlier, &mut out, &mut notes)?;
    meshes::compile(scene, &placed, (&meshes, earlier), &mut out)?;
    lights::compile(scene, &lights, earlier, &mut out, &mut notes)?;
    if let Some(earlier) = earlier {
        earlier::share(earlier.compiled, &mut out);
    }
    Ok(Compiled { scene: out, notes })
}

/// A punctual light that a node places in the world.
type PlacedLight = (crate::LightId, Affine3A);

/// Collects what the nodes place.
fn walk(scene: &Scene, notes: &mut Vec<String>) -> Result<(Vec<Placed>, Vec<PlacedLight>), CompileError> {
    let (mut placed, mut lights) = (Vec::new(), Vec::new());
    for PlacedNode { id, to_world, visible } in scene.placed_nodes() {
        let node = &scene.nodes[id.index()];
        let place = || format!("/nodes/{}", id.0);
        check(node.camera.map(|c| c.0), scene.cameras.len(), "camera", place)?;
        check(node.mesh.map(|m| m.0), scene.meshes.len(), "mesh", place)?;
        check(node.light.map(|l| l.0), scene.lights.len(), "light", place)?;
        for child in &node.children {
            check(Some(child.0), scene.nodes.len(), "node", place)?;
        }
        let to_world = affine(to_world);
        if let Some(mesh) = node.mesh {
            if invertible(to_world) {
                placed.push(Placed { node: id.0, mesh, to_world, visible });
            } else {
                notes.push(format!(
                    "/nodes/{}: its transform has no volume or is not finite; its mesh is not drawn",
                    id.0
                ));
            }
        }
        if let Some(light) = node.light.filter(|_| visible) {
            lights.push((light, to_world));
        }
    }
    Ok((placed, lights))
}

/// The affine part of a matrix, whatever its last row says.
fn affine(m: Mat4) -> Affine3A {
    Affine3A::from_mat4(Mat4::from_cols(
        m.x_axis.truncate().extend(0.0),
        m.y_axis.truncate().extend(0.0),
        m.z_axis.truncate().extend(0.0),
        m.w_axis.truncate().extend(1.0),
    ))
}

/// True when a ray can be brought to object space and its hit back.
fn invertible(a: Affine3A) -> bool {
    let m = a.matrix3;
    let (x, y, z) = (m.x_axis.length(), m.y_axis.length(), m.z_axis.length());
    // Relative to the lengths of the axes, so that small models count as well.
    a.is_finite()
        && a.inverse().is_finite()
        && m.determinant().abs() > 1e-6 * (x * y * z).max(f32::MIN_POSITIVE)
}

/// Checks an id against the length of its vector.
fn check(
    id: Option<u32>,
    len: usize,
    what: &'static str,
    place: impl Fn() -> String,
) -> Result<(), CompileError> {
    match id {
        Some(index) if index as usize >= len => Err(CompileError::MissingId { place: place(), what, index }),
        _ => Ok(()),
    }
}

/// Narrows a count to the width of an index.
fn index32(n: usize, what: &'static str) -> Result<u32, CompileError> {
    // NONE is not an index.
    u32::try_from(n)
        .ok()
        .filter(|&n| n < u32::MAX)
        .ok_or(CompileError::TooLarge { what, limit: u32::MAX - 1 })
}

/// Grows a bounding box.
fn grow(bounds: &mut [[f32; 3]; 2], p: Vec3) {
    let [min, max] = bounds.map(Vec3::from_array);
    *bounds = [min.min(p).to_array(), max.max(p).to_array()];
}
