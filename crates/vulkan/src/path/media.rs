//! Which solids a ray to infinity crosses, by asking every triangle of a solid: once for each place of the camera, where the CPU backend
//! has a tree to ask (`cpu/src/backend.rs`).

use glam::{DVec3, Vec3};
use lumbre_core::medium::MediumStack;
use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::material::{MaterialRecord, flag};
use lumbre_scene::compiled::surroundings::{Crossing, surroundings};

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

/// Distance to a triangle and whether the ray comes from the side from which it winds counter-clockwise. Möller and Trumbore 1997.
fn intersect([p0, p1, p2]: [DVec3; 3], origin: DVec3, dir: DVec3) -> Option<(f64, bool)> {
    let (e1, e2) = (p1 - p0, p2 - p0);
    let p = dir.cross(e2);
    let det = e1.dot(p);
    let inv = 1.0 / det;
    let to = origin - p0;
    let (b1, q) = (to.dot(p) * inv, to.cross(e1));
    let (b2, t) = (dir.dot(q) * inv, e2.dot(q) * inv);
    // A ray in the plane of the triangle has a determinant of 0 and no finite distance.
    (b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0 && t > 0.0 && t.is_finite()).then_some((t, det > 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_are_crossed_on_their_sides() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let from = |z: f64| DVec3::new(0.25, 0.25, z);
        assert_eq!(intersect(corners, from(2.0), -DVec3::Z), Some((2.0, true)));
        assert_eq!(intersect(corners, from(-2.0), DVec3::Z), Some((2.0, false)));
        assert_eq!(intersect(corners, from(2.0), DVec3::Z), None);
        assert_eq!(intersect(corners, DVec3::new(0.8, 0.8, 1.0), -DVec3::Z), None);
        assert_eq!(intersect(corners, from(1.0), DVec3::X), None);
    }
}
