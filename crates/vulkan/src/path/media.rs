//! Which solids a ray to infinity crosses, by asking every triangle of a solid: once for each place of the camera, where the CPU backend
//! has a tree to ask (`cpu/src/backend.rs`).

use glam::{DVec3, Vec3};
use lumbre_core::medium::MediumStack;
use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::material::{MaterialRecord, flag};
use lumbre_scene::compiled::surroundings::{Crossing, surroundings};
use lumbre_scene::compiled::triangle::intersect;

/// All triangles of solids that are not hidden.
pub(super) struct Solids {
    materials: Vec<MaterialRecord>,
    /// Corners in world space, counter-clockwise seen from the front, and the material.
    triangles: Vec<([Vec3; 3], u32)>,
}

fn is_solid(material: &MaterialRecord) -> bool {
    material.has(flag::SOLID)
}

impl Solids {
    pub(super) fn new(scene: &CompiledScene) -> Self {
        let mut triangles = Vec::new();
        if !scene.materials.iter().any(is_solid) {
            return Solids { materials: scene.materials.clone(), triangles };
        }
        for instance in scene.instances.iter().filter(|i| i.mask != 0) {
            let mesh = &scene.meshes[instance.mesh as usize];
            let key = &scene.transforms[instance.first_transform as usize];
            for triangle in mesh.first_triangle..mesh.first_triangle + mesh.triangle_count {
                let material = scene.triangle_materials[triangle as usize];
                if is_solid(&scene.materials[material as usize]) {
                    let [a, b, c] = scene.triangles[triangle as usize]
                        .map(|v| key.point(Vec3::from_array(scene.positions[v as usize])));
                    // A transform that mirrors turns the winding but not the front.
                    triangles.push((if key.handedness < 0.0 { [a, c, b] } else { [a, b, c] }, material));
                }
            }
        }
        Solids { materials: scene.materials.clone(), triangles }
    }

    /// Takes an edited scene, whose triangles are others or stand elsewhere if `moved`.
    pub(super) fn update(&mut self, scene: &CompiledScene, moved: bool) {
        if moved || self.materials.iter().map(is_solid).ne(scene.materials.iter().map(is_solid)) {
            *self = Solids::new(scene);
        } else {
            self.materials.clone_from(&scene.materials);
        }
    }

    /// The solids around a point.
    pub(super) fn around(&self, point: Vec3) -> MediumStack {
        surroundings(&self.materials, |dir| self.crossings(point, dir))
    }

    /// Surfaces along a ray, nearest first.
    fn crossings(&self, point: Vec3, dir: Vec3) -> Vec<Crossing> {
        let (origin, dir) = (DVec3::from(point), DVec3::from(dir));
        let mut found: Vec<(f64, Crossing)> = Vec::new();
        for (corners, material) in &self.triangles {
            if let Some((t, front)) = intersect(corners.map(DVec3::from), origin, dir) {
                found.push((t, Crossing { material: *material, front }));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found.into_iter().map(|(_, crossing)| crossing).collect()
    }
}
