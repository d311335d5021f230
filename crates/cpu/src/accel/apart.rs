//! Structures of a scene that is to be edited: a mesh has its own, one for each class of its triangles, so that a few leaves with
//! holes do not make all the rest ask for alpha.

use super::{Class, Instances, Origin, build_mesh};
use crate::bvh::{Blas, InstanceDesc};
use lumbre_scene::CompiledScene;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;

/// Numbers of triangles in their mesh; `None`: all of them.
type Triangles = Option<Arc<[u32]>>;

/// The triangles of a mesh that are of one class.
#[derive(Debug)]
pub(super) struct Part {
    mesh: u32,
    class: Class,
    pub(super) triangles: Triangles,
    pub(super) blas: Arc<Blas>,
}

/// The parts of all meshes, in their order. Structures of `earlier` ones, of the same meshes, are kept where they hold the same triangles.
pub(super) fn parts(scene: &CompiledScene, earlier: &[Part]) -> Vec<Part> {
    let classes: Vec<Class> = scene.materials.iter().map(Class::of_material).collect();
    let meshes = 0..scene.meshes.len() as u32;
    let divided: Vec<_> =
        meshes.into_par_iter().flat_map_iter(|mesh| divide(scene, mesh, &classes)).collect();
    let part = |(mesh, class, triangles): (u32, Class, Triangles)| {
        let kept = earlier[of_mesh(earlier, mesh)].iter().find(|p| p.triangles == triangles);
        let build = || Arc::new(build_part(scene, mesh, triangles.as_deref()));
        let blas = kept.map_or_else(build, |p| p.blas.clone());
        Part { mesh, class, triangles, blas }
    };
    divided.into_par_iter().map(part).collect()
}

/// Where the parts of a mesh stand.
fn of_mesh(parts: &[Part], mesh: u32) -> Range<usize> {
    parts.partition_point(|p| p.mesh < mesh)..parts.partition_point(|p| p.mesh <= mesh)
}

/// Divides the triangles of a mesh by class.
fn divide(scene: &CompiledScene, mesh: u32, classes: &[Class]) -> Vec<(u32, Class, Triangles)> {
    let record = &scene.meshes[mesh as usize];
    let first = record.first_triangle as usize;
    let materials = &scene.triangle_materials[first..first + record.triangle_count as usize];
    let mut found: Vec<Class> = Vec::new();
    // Triangles of a material lie together.
    for run in materials.chunk_by(|a, b| a == b) {
        let class = classes[run[0] as usize];
        if !found.contains(&class) {
            found.push(class);
        }
    }
    found.sort();
    if let [only] = found[..] {
        return vec![(mesh, only, None)];
    }
    let of =
        |class| (0..).zip(materials).filter(move |(_, m)| classes[**m as usize] == class).map(|(i, _)| i);
    found.into_iter().map(|class| (mesh, class, Some(of(class).collect()))).collect()
}

fn build_part(scene: &CompiledScene, mesh: u32, triangles: Option<&[u32]>) -> Blas {
    let record = &scene.meshes[mesh as usize];
    match triangles {
        None => build_mesh(scene, record, 0..record.triangle_count),
        Some(some) => build_mesh(scene, record, some.iter().copied()),
    }
}

/// The instances of the scene, over structures that are numbered as the parts are.
pub(super) fn instances(scene: &CompiledScene, parts: &[Part]) -> Instances {
    let mut instances = Instances::default();
    for (id, instance) in (0..).zip(&scene.instances[..]) {
        let object_to_world = scene.transforms[instance.first_transform as usize].object_to_world();
        for place in of_mesh(parts, instance.mesh) {
            let part = &parts[place];
            let desc = InstanceDesc::new(place as u32, object_to_world);
            instances.descs.push(InstanceDesc { mask: instance.mask, ..desc });
            instances.classes.push(part.class);
            instances.origins.push(match &part.triangles {
                Some(triangles) => Origin::Part(id, triangles.clone()),
                None => Origin::Instance(id),
            });
        }
    }
    instances
}
