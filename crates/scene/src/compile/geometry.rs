//! Triangles and vertices of the meshes that are placed.

use super::{CompileError, Earlier, Placed, check, index32, lobes, tangents};
use crate::compiled::geometry::{MeshRecord, Vertex, attribute};
use crate::compiled::{CompiledScene, NONE};
use crate::{Material, Mesh, Primitive, Scene};
use std::borrow::Cow;

/// The meshes that are compiled.
pub(super) struct Meshes {
    /// Their ids, in the order of their records.
    pub(super) order: Vec<usize>,
    /// All is as it was in the earlier scene: order, vertices, triangles and their materials.
    pub(super) unchanged: bool,
}

/// Compiles each mesh that is placed, in the order in which the first of its nodes stands; flags and emissive triangles are left to
/// `meshes`.
pub(super) fn compile(
    scene: &Scene,
    placed: &[Placed],
    earlier: Option<&Earlier<'_>>,
    out: &mut CompiledScene,
    notes: &mut Vec<String>,
) -> Result<Meshes, CompileError> {
    let order = order(scene, placed);
    let before = earlier.map(|e| Before::new(e, scene));
    let kept: Vec<Option<usize>> =
        order.iter().map(|&id| before.as_ref().and_then(|b| b.record(scene, id))).collect();
    let in_place = kept.iter().enumerate().all(|(i, kept)| *kept == Some(i));
    let unchanged =
        before.as_ref().is_some_and(|b| b.same_materials && in_place && b.order.len() == order.len());
    if let Some(earlier) = earlier.filter(|_| unchanged) {
        keep_all(earlier.compiled, out);
        order.iter().for_each(|&id| note_all(scene, id, notes));
        return Ok(Meshes { order, unchanged });
    }
    let mut arrays = Arrays::default();
    for (&id, kept) in order.iter().zip(kept) {
        index32(arrays.meshes.len(), "meshes")?;
        match (kept, before.as_ref()) {
            (Some(record), Some(before)) => {
                note_all(scene, id, notes);
                arrays.keep(&before.earlier.compiled.meshes[record], before)?;
            }
            _ => arrays.add(scene, id, notes)?,
        }
    }
    arrays.finish(out);
    Ok(Meshes { order, unchanged })
}

/// The meshes that nodes place, each once.
fn order(scene: &Scene, placed: &[Placed]) -> Vec<usize> {
    let mut seen = vec![false; scene.meshes.len()];
    let ids = placed.iter().map(|p| p.mesh.index());
    ids.filter(|&id| !std::mem::replace(&mut seen[id], true)).collect()
}

/// Shares the arrays of a scene with the same geometry.
fn keep_all(from: &CompiledScene, out: &mut CompiledScene) {
    out.positions = from.positions.clone();
    out.normals = from.normals.clone();
    out.vertices = from.vertices.clone();
    out.triangles = from.triangles.clone();
    out.triangle_materials = from.triangle_materials.clone();
    out.meshes = from.meshes.clone();
}

/// The earlier scene's meshes.
struct Before<'a> {
    earlier: &'a Earlier<'a>,
    order: Vec<usize>,
    /// There were as many materials, so that the default one has the same number.
    same_materials: bool,
    /// Numbers of the default material, then and now.
    default: [u32; 2],
}

impl<'a> Before<'a> {
    fn new(earlier: &'a Earlier<'a>, scene: &Scene) -> Self {
        let default = [earlier.authored, scene].map(|s| s.materials.len() as u32);
        let order = order(earlier.authored, &earlier.placed);
        Before { earlier, order, same_materials: default[0] == default[1], default }
    }

    /// The record of a mesh whose vertices would be the same again.
    fn record(&self, scene: &Scene, id: usize) -> Option<usize> {
        let record = self.order.iter().position(|&o| o == id)?;
        let same = |p: &Primitive| {
            let known = p.material.is_none_or(|m| m.index() < scene.materials.len());
            known && Tangents::of(self.earlier.authored, p).along() == Tangents::of(scene, p).along()
        };
        scene.meshes[id].primitives.iter().all(same).then_some(record)
    }
}

/// Where the tangents of a primitive come from.
#[derive(Clone, Copy)]
enum Tangents {
    /// The file, or nobody asks for any.
    Own,
    /// Its material asks for some, and there are no texture coordinates.
    Missing,
    /// They are made along this set of texture coordinates.
    Made(u32),
}

impl Tangents {
    fn of(scene: &Scene, p: &Primitive) -> Self {
        let material: Option<&Material> = p.material.and_then(|m| scene.materials.get(m.index()));
        match material.and_then(lobes::tangent_uv_set) {
            Some(set) if p.tangents.is_empty() && !p.indices.is_empty() => {
                if uv(p, set).is_empty() {
                    Tangents::Missing
                } else {
                    Tangents::Made(set)
                }
            }
            _ => Tangents::Own,
        }
    }

    /// The set of texture coordinates that decides the vertices.
    fn along(self) -> Option<u32> {
        if let Tangents::Made(set) = self { Some(set) } else { None }
    }
}

fn uv(p: &Primitive, set: u32) -> &[glam::Vec2] {
    if set == 1 { &p.uv1 } else { &p.uv0 }
}

/// Notes what primitives of a mesh go without.
fn note_all(scene: &Scene, id: usize, notes: &mut Vec<String>) {
    for (i, p) in scene.meshes[id].primitives.iter().enumerate() {
        note(id, i, Tangents::of(scene, p), notes);
    }
}

fn note(mesh: usize, primitive: usize, tangents: Tangents, notes: &mut Vec<String>) {
    if let Tangents::Missing = tangents {
        let what = "no texture coordinates for its normal map or anisotropy, which go without tangents";
        notes.push(format!("/meshes/{mesh}/primitives/{primitive}: {what}"));
    }
}

/// The arrays while they grow.
#[derive(Default)]
struct Arrays {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    vertices: Vec<Vertex>,
    triangles: Vec<[u32; 3]>,
    triangle_materials: Vec<u32>,
    meshes: Vec<MeshRecord>,
}

impl Arrays {
    fn finish(self, out: &mut CompiledScene) {
        out.positions = self.positions.into();
        out.normals = self.normals.into();
        out.vertices = self.vertices.into();
        out.triangles = self.triangles.into();
        out.triangle_materials = self.triangle_materials.into();
        out.meshes = self.meshes;
    }

    /// Adds a mesh of the scene.
    fn add(&mut self, scene: &Scene, id: usize, notes: &mut Vec<String>) -> Result<(), CompileError> {
        let mesh: &Mesh = &scene.meshes[id];
        let (first_vertex, first_triangle) = (self.positions.len(), self.triangles.len());
        for (i, primitive) in mesh.primitives.iter().enumerate() {
            validate(scene, primitive, &|| format!("/meshes/{id}/primitives/{i}"))?;
            let tangents = Tangents::of(scene, primitive);
            note(id, i, tangents, notes);
            let made = match tangents {
                Tangents::Made(set) => Cow::Owned(tangents::with_tangents(primitive, uv(primitive, set))),
                Tangents::Own | Tangents::Missing => Cow::Borrowed(primitive),
            };
            // The default material stands behind the authored ones.
            let material = primitive.material.map_or(scene.materials.len(), |m| m.index());
            self.append(&made, material as u32)?;
        }
        let attributes = attributes(&self.normals[first_vertex..], &self.vertices[first_vertex..]);
        self.add_record(first_vertex, first_triangle, attributes)
    }

    /// Adds a mesh as it was.
    fn keep(&mut self, record: &MeshRecord, before: &Before<'_>) -> Result<(), CompileError> {
        let from = before.earlier.compiled;
        let (first_vertex, first_triangle) = (self.positions.len(), self.triangles.len());
        let vertices = record.first_vertex as usize..(record.first_vertex + record.vertex_count) as usize;
        let triangles =
            record.first_triangle as usize..(record.first_triangle + record.triangle_count) as usize;
        let base = index32(first_vertex, "vertices")?;
        index32(first_vertex + vertices.len(), "vertices")?;
        self.positions.extend_from_slice(&from.positions[vertices.clone()]);
        self.normals.extend_from_slice(&from.normals[vertices.clone()]);
        self.vertices.extend_from_slice(&from.vertices[vertices]);
        let moved = |t: &[u32; 3]| t.map(|v| v - record.first_vertex + base);
        self.triangles.extend(from.triangles[triangles.clone()].iter().map(moved));
        let [then, now] = before.default;
        let material = |&m: &u32| if m == then { now } else { m };
        self.triangle_materials.extend(from.triangle_materials[triangles].iter().map(material));
        self.add_record(first_vertex, first_triangle, record.attributes)
    }

    /// The record of a mesh that begins there and ends here.
    fn add_record(
        &mut self,
        first_vertex: usize,
        first_triangle: usize,
        attributes: u32,
    ) -> Result<(), CompileError> {
        self.meshes.push(MeshRecord {
            first_triangle: index32(first_triangle, "triangles")?,
            triangle_count: index32(self.triangles.len(), "triangles")? - first_triangle as u32,
            first_vertex: index32(first_vertex, "vertices")?,
            vertex_count: index32(self.positions.len(), "vertices")? - first_vertex as u32,
            first_emissive_rank: NONE,
            opaque: 0,
            culls: 0,
            attributes,
        });
        Ok(())
    }

    fn append(&mut self, p: &Primitive, material: u32) -> Result<(), CompileError> {
        let base = index32(self.positions.len(), "vertices")?;
        index32(self.positions.len() + p.positions.len(), "vertices")?;
        self.positions.extend(p.positions.iter().map(|v| v.to_array()));
        let normal = |i: usize| p.normals.get(i).map_or([0.0; 3], |n| n.normalize_or_zero().to_array());
        self.normals.extend((0..p.positions.len()).map(normal));
        self.vertices.extend((0..p.positions.len()).map(|i| Vertex {
            tangent: p.tangents.get(i).map_or([0.0; 4], |t| t.to_array()),
            uv: [&p.uv0, &p.uv1].map(|uv| uv.get(i).map_or([0.0; 2], |v| v.to_array())),
            color: p.colors.get(i).map_or([1.0; 4], |c| c.to_array()),
        }));
        self.triangles.extend(p.indices.chunks_exact(3).map(|t| [base + t[0], base + t[1], base + t[2]]));
        self.triangle_materials.resize(self.triangles.len(), material);
        Ok(())
    }
}

/// What these vertices have, as bits.
fn attributes(normals: &[[f32; 3]], vertices: &[Vertex]) -> u32 {
    let bit = |has: fn(&Vertex) -> bool, bit: u32| if vertices.iter().any(has) { bit } else { 0 };
    let normal = if normals.iter().any(|n| *n != [0.0; 3]) { attribute::NORMAL } else { 0 };
    normal
        | bit(|v| v.tangent != [0.0; 4], attribute::TANGENT)
        | bit(|v| v.uv != [[0.0; 2]; 2], attribute::UV)
        | bit(|v| v.color != [1.0; 4], attribute::COLOR)
}

fn validate(scene: &Scene, p: &Primitive, place: &dyn Fn() -> String) -> Result<(), CompileError> {
    check(p.material.map(|m| m.0), scene.materials.len(), "material", place)?;
    let n = p.positions.len();
    let invalid = |message: String| Err(CompileError::Invalid { place: place(), message });
    let lengths = [
        ("normals", p.normals.len()),
        ("tangents", p.tangents.len()),
        ("texture coordinates", p.uv0.len()),
        ("second texture coordinates", p.uv1.len()),
        ("colours", p.colors.len()),
    ];
    for (what, len) in lengths {
        if len != 0 && len != n {
            return invalid(format!("{n} positions but {len} {what}"));
        }
    }
    if !p.indices.len().is_multiple_of(3) {
        return invalid(format!("{} indices are not a whole number of triangles", p.indices.len()));
    }
    match p.indices.iter().find(|&&i| i as usize >= n) {
        Some(i) => invalid(format!("index {i} of a vertex where there are {n}")),
        None => Ok(()),
    }
}
