//! What closes a point in: a few rays to all sides.

use glam::Vec3;
use lumbre_core::Ray;
use lumbre_core::warp;
use lumbre_cpu::CpuBackend;
use lumbre_cpu::interaction::Interaction;
use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::material::MaterialRecord;

/// How many rays are sent.
const RAYS: u32 = 64;

/// Directions all over the sphere: equal steps of height, turned by the golden angle each.
fn directions() -> impl Iterator<Item = Vec3> {
    const GOLDEN: f32 = 0.618_034;
    (0..RAYS).map(|i| {
        let (height, turn) = ((i as f32 + 0.5) / RAYS as f32, (i as f32 * GOLDEN).fract());
        warp::uniform_sphere([height, turn])
    })
}

/// The instance whose back faces are the first thing that `point` sees, whichever way it looks; `None` where there is no such
/// one, or where `lets_out` holds for a material that is seen.
pub(super) fn enclosing(
    backend: &CpuBackend,
    point: Vec3,
    lets_out: impl Fn(&MaterialRecord) -> bool,
) -> Option<u32> {
    let scene = backend.scene();
    let mut around = None;
    for dir in directions() {
        let ray = Ray::new(point, dir, 0.0);
        let hit = backend.accel().closest_hit(&ray, |_| true)?;
        let it = Interaction::new(scene, &ray, &hit);
        let another = around.is_some_and(|a| a != it.instance);
        if it.front || another || lets_out(&scene.materials[it.material as usize]) {
            return None;
        }
        around = Some(it.instance);
    }
    around
}

/// Size of an instance as a share of that of the scene, by their boxes in the world.
pub(super) fn share(scene: &CompiledScene, instance: u32) -> f32 {
    let instance = &scene.instances[instance as usize];
    let mesh = &scene.meshes[instance.mesh as usize];
    let key = &scene.transforms[instance.first_transform as usize];
    let vertices = mesh.first_vertex as usize..(mesh.first_vertex + mesh.vertex_count) as usize;
    let (mut min, mut max) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for p in &scene.positions[vertices] {
        let p = key.point(Vec3::from_array(*p));
        (min, max) = (min.min(p), max.max(p));
    }
    0.5 * (max - min).length() / scene.radius().max(f32::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_directions_leave_no_side_out() {
        let all: Vec<Vec3> = directions().collect();
        assert!(all.iter().all(|d| (d.length() - 1.0).abs() < 1e-5));
        // Every direction has a ray within 20 degrees.
        for i in 0..1000 {
            let u = [(i as f32 * 0.754_877_7).fract(), (i as f32 * 0.569_840_3).fract()];
            let wanted = warp::uniform_sphere(u);
            let nearest = all.iter().map(|d| d.dot(wanted)).fold(-1.0, f32::max);
            assert!(nearest > 0.94, "{wanted}: {nearest}");
        }
    }
}
