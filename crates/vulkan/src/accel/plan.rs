//! Which acceleration structures a scene gets.
//!
//! What rays must ask of a triangle is decided by flags of the instance and by its record of the shader binding table, so all triangles
//! of a structure are of one [`Class`], and a mesh with triangles of several is divided into parts. Meshes that stand in the world once
//! are merged: one structure with a geometry and a transform for each (a structure for each class), so that rays do not walk a hundred overlapping
//! trees; meshes used more often keep structures of their own, shared by their instances. The CPU does the same: cpu/src/accel.rs.

use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::geometry::InstanceRecord;
use lumbre_scene::compiled::material::MaterialRecord;
use lumbre_shaders::layout::{GeometryRecord, HitClass};
use std::ops::Range;
use std::sync::Arc;

/// What a structure's triangles have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Class {
    /// What rays must ask of them.
    pub(crate) hit: HitClass,
    /// Camera rays do not see their backs.
    pub(crate) culls: bool,
    /// They wind the other way in the structure than in their meshes. Facing is decided in the space of the structure: transforms of
    /// instances do not change it, those of geometries do.
    pub(crate) mirrored: bool,
}

/// Triangles of a mesh that are of one class.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    pub(crate) mesh: u32,
    /// Never `mirrored`.
    pub(crate) class: Class,
    /// Their numbers in the mesh; `None`: all of them.
    pub(crate) triangles: Option<Vec<u32>>,
    pub(crate) count: u32,
}

/// A geometry of a structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct GeometryPlan {
    /// Which part.
    pub(crate) part: usize,
    /// The instance whose transform is built in; `None`: vertices stay in object space.
    pub(crate) placed: Option<u32>,
}

/// A bottom-level structure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct BlasPlan {
    pub(crate) class: Class,
    pub(crate) geometries: Vec<GeometryPlan>,
}

/// An instance of the top-level structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct InstancePlan {
    pub(crate) blas: usize,
    /// The instance of the scene; `None` for merged ones.
    pub(crate) instance: Option<u32>,
    /// Its first record.
    pub(crate) first_record: usize,
}

/// The meshes of a scene, divided by class.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Division {
    /// Of each material.
    classes: Vec<Class>,
    parts: Vec<Part>,
    /// Which are those of each mesh.
    of_mesh: Vec<Range<usize>>,
}

/// Structures, and what stands for each of their geometries when it is hit.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plan {
    division: Arc<Division>,
    pub(crate) structures: Vec<BlasPlan>,
    pub(crate) instances: Vec<InstancePlan>,
    /// Instance and part of each record.
    pub(crate) hits: Vec<(u32, usize)>,
}

/// Most triangles that are merged into one structure, so that memory and scratch space of a build stay bounded.
const MOST_MERGED: u64 = 8 << 20;

impl Class {
    fn of(material: &MaterialRecord) -> Self {
        let hit = match material.has_coverage() {
            true => HitClass::Covered,
            false if material.is_opaque() => HitClass::Opaque,
            false => HitClass::Transmissive,
        };
        Class { hit, culls: material.culls_back_faces(), mirrored: false }
    }
}

impl Division {
    fn new(scene: &CompiledScene, classes: Vec<Class>) -> Self {
        let mut parts = Vec::new();
        let of = |mesh: usize| {
            let first = parts.len();
            divide(scene, mesh as u32, &classes, &mut parts);
            first..parts.len()
        };
        let of_mesh = (0..scene.meshes.len()).map(of).collect();
        Division { classes, parts, of_mesh }
    }
}

fn classes(scene: &CompiledScene) -> Vec<Class> {
    scene.materials.iter().map(Class::of).collect()
}

impl Plan {
    /// `merge`: meshes that stand in the world once share structures.
    pub(crate) fn new(scene: &CompiledScene, merge: bool) -> Self {
        Plan::of(scene, merge, Arc::new(Division::new(scene, classes(scene))))
    }

    /// The plan of a scene with the same meshes, whose materials and instances may be others.
    pub(crate) fn again(&self, scene: &CompiledScene, merge: bool) -> Self {
        let classes = classes(scene);
        let division = match classes == self.division.classes {
            true => self.division.clone(),
            false => Arc::new(Division::new(scene, classes)),
        };
        Plan::of(scene, merge, division)
    }

    fn of(scene: &CompiledScene, merge: bool, division: Arc<Division>) -> Self {
        let mut plan = Plan { division: division.clone(), ..Plan::default() };
        let mut uses = vec![0u32; scene.meshes.len()];
        scene.instances.iter().for_each(|i| uses[i.mesh as usize] += 1);
        let merges = |i: &InstanceRecord| {
            merge && uses[i.mesh as usize] == 1 && i.transform_count == 1 && i.mask == u32::MAX
        };
        let (once, shared): (Vec<u32>, Vec<u32>) =
            (0..scene.instances.len() as u32).partition(|&i| merges(&scene.instances[i as usize]));
        let parts_of = |i: &u32| division.of_mesh[scene.instances[*i as usize].mesh as usize].clone();
        plan.merge(scene, once.iter().flat_map(|i| parts_of(i).map(|p| (*i, p))));
        plan.share(shared.iter().flat_map(|i| parts_of(i).map(|p| (*i, p))));
        plan
    }

    /// Parts of meshes.
    pub(crate) fn parts(&self) -> &[Part] {
        &self.division.parts
    }

    /// Whether the structures of another plan would be the same, where instances may have moved or not.
    pub(crate) fn has_structures_of(&self, other: &Plan, moved: bool) -> bool {
        let placed = |s: &BlasPlan| s.geometries.iter().any(|g| g.placed.is_some());
        let parts = Arc::ptr_eq(&self.division, &other.division) || self.parts() == other.parts();
        parts && self.structures == other.structures && !(moved && self.structures.iter().any(placed))
    }

    /// Structures of parts placed in the world once.
    fn merge(&mut self, scene: &CompiledScene, placed: impl Iterator<Item = (u32, usize)>) {
        let mut by_class: Vec<(Class, u32, usize)> = placed
            .map(|(instance, part)| {
                let key = &scene.transforms[scene.instances[instance as usize].first_transform as usize];
                let class = self.parts()[part].class;
                (Class { mirrored: class.culls && key.handedness < 0.0, ..class }, instance, part)
            })
            .collect();
        by_class.sort_by_key(|&(class, instance, _)| (class, instance));
        let mut triangles = 0;
        for (class, instance, part) in by_class {
            let count = u64::from(self.parts()[part].count);
            let fits = |last: &&mut BlasPlan| last.class == class && triangles + count <= MOST_MERGED;
            if self.structures.last_mut().filter(fits).is_none() {
                let first_record = self.hits.len();
                self.instances.push(InstancePlan {
                    blas: self.structures.len(),
                    instance: None,
                    first_record,
                });
                self.structures.push(BlasPlan { class, geometries: Vec::new() });
                triangles = 0;
            }
            triangles += count;
            let structure = self.structures.last_mut().expect("just made");
            structure.geometries.push(GeometryPlan { part, placed: Some(instance) });
            self.hits.push((instance, part));
        }
    }

    /// A structure for each part, shared by its instances.
    fn share(&mut self, placed: impl Iterator<Item = (u32, usize)>) {
        let mut structure_of = vec![None; self.parts().len()];
        for (instance, part) in placed {
            let blas = *structure_of[part].get_or_insert_with(|| {
                let geometries = vec![GeometryPlan { part, placed: None }];
                let class = self.division.parts[part].class;
                self.structures.push(BlasPlan { class, geometries });
                self.structures.len() - 1
            });
            let first_record = self.hits.len();
            self.instances.push(InstancePlan { blas, instance: Some(instance), first_record });
            self.hits.push((instance, part));
        }
    }

    /// What shaders read of each geometry, given the addresses of indices and numbers of each part.
    pub(crate) fn records(&self, parts: &[[u64; 2]]) -> Vec<GeometryRecord> {
        let record = |&(instance, part): &(u32, usize)| GeometryRecord {
            triangle_ids: parts[part][1],
            instance,
            mesh: self.parts()[part].mesh,
        };
        self.hits.iter().map(record).collect()
    }
}

/// Divides the triangles of a mesh by class.
fn divide(scene: &CompiledScene, mesh: u32, classes: &[Class], parts: &mut Vec<Part>) {
    let record = &scene.meshes[mesh as usize];
    let first = record.first_triangle as usize;
    let materials = &scene.triangle_materials[first..first + record.triangle_count as usize];
    let class_of = |material: &u32| classes[*material as usize];
    let mut found: Vec<Class> = Vec::new();
    let mut last = None;
    for material in materials {
        if last != Some(material) {
            last = Some(material);
            if !found.contains(&class_of(material)) {
                found.push(class_of(material));
            }
        }
    }
    found.sort();
    for &class in &found {
        let ids = || (0..).zip(materials).filter(|(_, m)| class_of(m) == class).map(|(i, _)| i);
        let triangles: Option<Vec<u32>> = (found.len() > 1).then(|| ids().collect());
        let count = triangles.as_ref().map_or(record.triangle_count, |t| t.len() as u32);
        parts.push(Part { mesh, class, triangles, count });
    }
}
