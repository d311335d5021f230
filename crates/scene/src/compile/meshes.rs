//! What of meshes depends on their materials, and the instances of them.

use super::geometry::Meshes;
use super::{CompileError, Earlier, Placed, grow, index32};
use crate::compiled::geometry::{InstanceRecord, TransformKey};
use crate::compiled::material::{MaterialRecord, flag};
use crate::compiled::{CompiledScene, NONE};
use crate::{Mesh, Scene};

/// Completes the records of the meshes, and compiles the instances.
pub(super) fn compile(
    scene: &Scene,
    placed: &[Placed],
    (meshes, earlier): (&Meshes, Option<&Earlier<'_>>),
    out: &mut CompiledScene,
) -> Result<(), CompileError> {
    let unchanged = earlier.filter(|_| meshes.unchanged);
    let uses: Vec<Uses> = meshes.order.iter().map(|&id| Uses::of(&scene.meshes[id], out)).collect();
    for (mesh, uses) in out.meshes.iter_mut().zip(&uses) {
        (mesh.opaque, mesh.culls) = (u32::from(uses.opaque), u32::from(uses.culls));
    }
    match unchanged.filter(|e| same_emitters(&e.compiled.materials, &out.materials)) {
        // The records of the meshes, too, are those of the earlier scene.
        Some(earlier) => out.emissive_ranks = earlier.compiled.emissive_ranks.clone(),
        None => add_emissive_ranks(&uses, out)?,
    }
    add_instances(scene, placed, meshes, out)?;
    out.bounds = match unchanged.filter(|e| e.stands(&out.instances, &out.transforms)) {
        Some(earlier) => earlier.compiled.bounds,
        None => bounds(out),
    };
    Ok(())
}

/// What the materials of a mesh have in common.
struct Uses {
    opaque: bool,
    culls: bool,
    emissive: bool,
}

impl Uses {
    fn of(mesh: &Mesh, out: &CompiledScene) -> Self {
        let mut uses = Uses { opaque: true, culls: false, emissive: false };
        for primitive in &mesh.primitives {
            // The default material stands behind the authored ones.
            let material = &out.materials[primitive.material.map_or(out.materials.len() - 1, |m| m.index())];
            uses.opaque &= material.is_opaque();
            uses.culls |= material.culls_back_faces();
            uses.emissive |= material.has(flag::EMISSIVE);
        }
        uses
    }
}

/// Whether the same of as many materials emit.
fn same_emitters(before: &[MaterialRecord], after: &[MaterialRecord]) -> bool {
    let emits = |m: &MaterialRecord| m.has(flag::EMISSIVE);
    before.iter().map(emits).eq(after.iter().map(emits))
}

/// Numbers the emissive triangles of each mesh that has any.
fn add_emissive_ranks(uses: &[Uses], out: &mut CompiledScene) -> Result<(), CompileError> {
    let mut ranks = Vec::new();
    for (mesh, uses) in out.meshes.iter_mut().zip(uses) {
        mesh.first_emissive_rank = NONE;
        if !uses.emissive {
            continue;
        }
        mesh.first_emissive_rank = index32(ranks.len(), "emissive triangles")?;
        let first = mesh.first_triangle as usize;
        let mut rank = 0;
        for &material in &out.triangle_materials[first..first + mesh.triangle_count as usize] {
            let emits = out.materials[material as usize].has(flag::EMISSIVE);
            ranks.push(if emits { rank } else { NONE });
            rank += u32::from(emits);
        }
    }
    out.emissive_ranks = ranks.into();
    Ok(())
}

/// Instances of meshes that have triangles.
fn add_instances(
    scene: &Scene,
    placed: &[Placed],
    meshes: &Meshes,
    out: &mut CompiledScene,
) -> Result<(), CompileError> {
    let mut record_of = vec![NONE; scene.meshes.len()];
    (0..).zip(&meshes.order).for_each(|(record, &id)| record_of[id] = record);
    let (mut instances, mut transforms) = (Vec::new(), Vec::new());
    for p in placed {
        let mesh = record_of[p.mesh.index()];
        if out.meshes[mesh as usize].triangle_count == 0 {
            continue;
        }
        instances.push(InstanceRecord {
            mesh,
            first_transform: index32(transforms.len(), "transforms")?,
            transform_count: 1,
            first_light: NONE,
            mask: if p.visible { u32::MAX } else { 0 },
            node: p.node,
        });
        transforms.push(TransformKey::new(p.to_world, 0.0));
    }
    out.transforms = transforms.into();
    out.instances = instances.into();
    Ok(())
}

/// The box around the vertices of all instances, hidden ones too.
fn bounds(out: &CompiledScene) -> [[f32; 3]; 2] {
    let mut bounds = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    for instance in &out.instances[..] {
        let mesh = &out.meshes[instance.mesh as usize];
        let to_world = out.transforms[instance.first_transform as usize].object_to_world();
        let vertices = mesh.first_vertex as usize..(mesh.first_vertex + mesh.vertex_count) as usize;
        for v in &out.positions[vertices] {
            let w = to_world.transform_point3((*v).into());
            if w.is_finite() {
                grow(&mut bounds, w);
            }
        }
    }
    bounds
}
