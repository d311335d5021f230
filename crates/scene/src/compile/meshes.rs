//! Meshes and the instances of them.

use super::{CompileError, Placed, check, grow, index32, lobes, tangents};
use crate::compiled::geometry::{InstanceRecord, MeshRecord, TransformKey, Vertex, attribute};
use crate::compiled::material::flag;
use crate::compiled::{CompiledScene, NONE};
use crate::{Mesh, Primitive, Scene};
use std::borrow::Cow;

/// Compiles the meshes that are placed, then the instances. Returns the transform of each instance, in order.
pub(super) fn compile(
    scene: &Scene,
    placed: &[Placed],
    out: &mut CompiledScene,
    notes: &mut Vec<String>,
) -> Result<Vec<glam::Affine3A>, CompileError> {
    out.bounds = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    let mut compiled = vec![NONE; scene.meshes.len()];
    let mut kept = Vec::with_capacity(placed.len());
    for p in placed {
        let mesh = &mut compiled[p.mesh.index()];
        if *mesh == NONE {
            *mesh = index32(out.meshes.len(), "meshes")?;
            add_mesh(scene, p.mesh.index(), out, notes)?;
        }
        let record = out.meshes[*mesh as usize];
        if record.triangle_count == 0 {
            continue;
        }
        let vertices = record.first_vertex as usize..(record.first_vertex + record.vertex_count) as usize;
        for v in &out.positions[vertices] {
            let w = p.to_world.transform_point3((*v).into());
            if w.is_finite() {
                grow(&mut out.bounds, w);
            }
        }
        out.instances.push(InstanceRecord {
            mesh: *mesh,
            first_transform: index32(out.transforms.len(), "transforms")?,
            transform_count: 1,
            first_light: NONE,
            mask: if p.visible { u32::MAX } else { 0 },
            node: p.node,
        });
        out.transforms.push(TransformKey::new(p.to_world, 0.0));
        kept.push(p.to_world);
    }
    Ok(kept)
}

fn add_mesh(
    scene: &Scene,
    id: usize,
    out: &mut CompiledScene,
    notes: &mut Vec<String>,
) -> Result<(), CompileError> {
    let mesh: &Mesh = &scene.meshes[id];
    let (first_vertex, first_triangle) = (out.positions.len(), out.triangles.len());
    let (mut opaque, mut culls, mut emissive) = (true, false, false);
    for (i, primitive) in mesh.primitives.iter().enumerate() {
        let place = || format!("/meshes/{id}/primitives/{i}");
        validate(scene, primitive, &place)?;
        // The default material stands behind the authored ones.
        let material = primitive.material.map_or(scene.materials.len(), |m| m.index());
        let record = &out.materials[material];
        opaque &= record.is_opaque();
        culls |= record.culls_back_faces();
        emissive |= record.has(flag::EMISSIVE);
        let tangent_uv_set = scene.materials.get(material).and_then(lobes::tangent_uv_set);
        let uv = if tangent_uv_set == Some(1) { &primitive.uv1 } else { &primitive.uv0 };
        let primitive =
            if tangent_uv_set.is_none() || !primitive.tangents.is_empty() || primitive.indices.is_empty() {
                Cow::Borrowed(primitive)
            } else if uv.is_empty() {
                let what =
                    "no texture coordinates for its normal map or anisotropy, which go without tangents";
                notes.push(format!("{}: {what}", place()));
                Cow::Borrowed(primitive)
            } else {
                Cow::Owned(tangents::with_tangents(primitive, uv))
            };
        append(&primitive, material as u32, out)?;
    }
    let first_emissive_rank = if emissive { add_emissive_ranks(first_triangle, out)? } else { NONE };
    out.meshes.push(MeshRecord {
        first_triangle: index32(first_triangle, "triangles")?,
        triangle_count: index32(out.triangles.len(), "triangles")? - first_triangle as u32,
        first_vertex: index32(first_vertex, "vertices")?,
        vertex_count: index32(out.positions.len(), "vertices")? - first_vertex as u32,
        first_emissive_rank,
        opaque: u32::from(opaque),
        culls: u32::from(culls),
        attributes: attributes(&out.normals[first_vertex..], &out.vertices[first_vertex..]),
    });
    Ok(())
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

/// Numbers the emissive triangles of the mesh that begins at `first_triangle`.
fn add_emissive_ranks(first_triangle: usize, out: &mut CompiledScene) -> Result<u32, CompileError> {
    let first = index32(out.emissive_ranks.len(), "emissive triangles")?;
    let mut rank = 0;
    for &material in &out.triangle_materials[first_triangle..] {
        let emits = out.materials[material as usize].has(flag::EMISSIVE);
        out.emissive_ranks.push(if emits { rank } else { NONE });
        rank += u32::from(emits);
    }
    Ok(first)
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

fn append(p: &Primitive, material: u32, out: &mut CompiledScene) -> Result<(), CompileError> {
    let base = index32(out.positions.len(), "vertices")?;
    index32(out.positions.len() + p.positions.len(), "vertices")?;
    out.positions.extend(p.positions.iter().map(|v| v.to_array()));
    let normal = |i: usize| p.normals.get(i).map_or([0.0; 3], |n| n.normalize_or_zero().to_array());
    out.normals.extend((0..p.positions.len()).map(normal));
    out.vertices.extend((0..p.positions.len()).map(|i| Vertex {
        tangent: p.tangents.get(i).map_or([0.0; 4], |t| t.to_array()),
        uv: [&p.uv0, &p.uv1].map(|uv| uv.get(i).map_or([0.0; 2], |v| v.to_array())),
        color: p.colors.get(i).map_or([1.0; 4], |c| c.to_array()),
    }));
    out.triangles.extend(p.indices.chunks_exact(3).map(|t| [base + t[0], base + t[1], base + t[2]]));
    out.triangle_materials.resize(out.triangles.len(), material);
    Ok(())
}
