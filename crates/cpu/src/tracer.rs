//! Rays against the scene: the closest hit with stochastic coverage and back-face culling.

use crate::accel::Accel;
use crate::bvh::Hit;
use crate::interaction::{Interaction, attributes, geometric_normal, material_of};
use crate::surface;
use lumbre_core::Ray;
use lumbre_core::hash::{hash_combine, to_unit};
use lumbre_core::settings::RenderSettings;
use lumbre_scene::CompiledScene;

/// What every ray needs.
#[derive(Clone, Copy)]
pub struct Tracer<'a> {
    /// Scene.
    pub scene: &'a CompiledScene,
    /// Its acceleration structures.
    pub accel: &'a Accel,
    /// Settings.
    pub settings: &'a RenderSettings,
}

/// Identifies a ray for stochastic coverage: hashed with what it hits, so that the verdict does not depend on the order of
/// hits.
#[derive(Clone, Copy, Debug)]
pub struct CoverageKey(u32);

impl CoverageKey {
    /// Key of the path's ray that leaves vertex `vertex` (0: the camera).
    pub fn path(stream: u32, vertex: u32) -> Self {
        CoverageKey(hash_combine(stream, 2 * vertex))
    }
    /// Key of the shadow ray from vertex `vertex`.
    pub fn shadow(stream: u32, vertex: u32) -> Self {
        CoverageKey(hash_combine(stream, 2 * vertex + 1))
    }
    /// Key of the shadow ray from the shadow catcher seen from vertex `vertex` after `passed` others: its verdicts multiply those
    /// of the rays behind it, so that they must be independent.
    pub fn catcher(stream: u32, vertex: u32, passed: u32) -> Self {
        CoverageKey(hash_combine(hash_combine(stream, 2 * vertex + 1), passed + 1))
    }
    /// A number in [0, 1) for this ray and triangle.
    #[inline]
    fn unit(self, hit: &Hit) -> f32 {
        to_unit(hash_combine(hash_combine(self.0, hit.instance), hit.triangle))
    }
}

impl Tracer<'_> {
    /// True when the ray finds the surface there.
    #[inline]
    pub fn covered(&self, hit: &Hit, key: CoverageKey) -> bool {
        let material = &self.scene.materials[material_of(self.scene, hit) as usize];
        if !material.has_coverage() {
            return true;
        }
        key.unit(hit) < surface::coverage(self.scene, material, &attributes(self.scene, hit))
    }

    /// The closest surface that a path's ray finds.
    #[inline]
    pub fn closest_hit(&self, ray: &Ray, key: CoverageKey) -> Option<Interaction> {
        let hit = self.accel.closest_hit(ray, |hit| self.covered(hit, key))?;
        Some(Interaction::new(self.scene, ray, &hit))
    }

    /// The closest surface that a camera ray finds: back faces of single-sided opaque materials do not count.
    pub fn closest_hit_camera(&self, ray: &Ray, key: CoverageKey) -> Option<Interaction> {
        if self.settings.shade_back_faces {
            return self.closest_hit(ray, key);
        }
        let visible = |hit: &Hit| {
            let material = &self.scene.materials[material_of(self.scene, hit) as usize];
            let culled = material.culls_back_faces() && geometric_normal(self.scene, hit).dot(ray.dir) >= 0.0;
            !culled && self.covered(hit, key)
        };
        let hit = self.accel.closest_hit_camera(ray, visible)?;
        Some(Interaction::new(self.scene, ray, &hit))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Verdicts that multiply along one path come from different keys.
    #[test]
    fn keys_of_one_path_differ() {
        let keys = |v| {
            let catchers = (0..4).map(move |passed| CoverageKey::catcher(7, v, passed).0);
            [CoverageKey::path(7, v).0, CoverageKey::shadow(7, v).0].into_iter().chain(catchers)
        };
        let all: std::collections::HashSet<u32> = (0..64).flat_map(keys).collect();
        assert_eq!(all.len(), 64 * 6);
    }
}
