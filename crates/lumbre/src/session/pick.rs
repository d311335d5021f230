//! What stands at a place of the view: found among all triangles one after another, since no device but the CPU keeps its tree where it can be
//! asked from here, and all threads are busy with samples. Ten million triangles take about a tenth of a second.

use super::sink::Picked;
use glam::{DVec3, Vec3};
use lumbre_core::Camera;
use lumbre_core::settings::RenderSettings;
use lumbre_scene::compiled::geometry::InstanceRecord;
use lumbre_scene::compiled::triangle::intersect;
use lumbre_scene::{CompiledScene, MaterialId, NodeId};

/// The nearest triangle on the ray through a place of the picture: `at` from its top left corner, 0 to 1 along each axis. Lenses count
/// by their centre, and cut-outs as a whole; backs that the camera does not see are not there.
pub(super) fn pick(
    scene: &CompiledScene,
    camera: &Camera,
    settings: &RenderSettings,
    at: [f32; 2],
) -> Option<Picked> {
    let ray = camera.ray(at, [0.5, 0.5], 0.0);
    let (origin, dir) = (ray.origin, ray.dir);
    let visible = scene.instances.iter().filter(|i| i.mask != 0);
    let nearest = visible
        .filter_map(|i| closest(scene, settings, i, [origin, dir]).map(|(t, triangle)| (t, triangle, i)));
    let (distance, triangle, instance) = nearest.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let mesh = &scene.meshes[instance.mesh as usize];
    let to_world = scene.transforms[instance.first_transform as usize].object_to_world();
    let at = (mesh.first_triangle + triangle) as usize;
    let [a, b, c] =
        scene.triangles[at].map(|v| to_world.transform_point3(Vec3::from_array(scene.positions[v as usize])));
    let normal = (b - a).cross(c - a).normalize_or(Vec3::Y);
    let material = scene.triangle_materials[at];
    // The last one stands in where none is given.
    let authored = (material as usize) + 1 < scene.materials.len();
    Some(Picked {
        node: NodeId(instance.node),
        material: authored.then_some(MaterialId(material)),
        triangle,
        point: origin + dir * distance,
        normal: if normal.dot(dir) > 0.0 { -normal } else { normal },
        distance,
    })
}

/// Nearest triangle of an instance: distance and its number in the mesh.
fn closest(
    scene: &CompiledScene,
    settings: &RenderSettings,
    instance: &InstanceRecord,
    [origin, dir]: [Vec3; 2],
) -> Option<(f32, u32)> {
    let mesh = &scene.meshes[instance.mesh as usize];
    let to_object = scene.transforms[instance.first_transform as usize].object_to_world().inverse();
    // Not normalised: distances stay those of the world.
    let o = DVec3::from(to_object.transform_point3(origin));
    let d = DVec3::from(to_object.transform_vector3(dir));
    let triangles = &scene.triangles[mesh.first_triangle as usize..][..mesh.triangle_count as usize];
    let hit = |(i, t): (usize, &[u32; 3])| {
        let corners = t.map(|v| Vec3::from_array(scene.positions[v as usize]).into());
        let (t, front) = intersect(corners, o, d)?;
        let material = scene.triangle_materials[mesh.first_triangle as usize + i];
        let seen =
            front || settings.shade_back_faces || !scene.materials[material as usize].culls_back_faces();
        seen.then_some((t as f32, i as u32))
    };
    triangles.iter().enumerate().filter_map(hit).min_by(|a, b| a.0.total_cmp(&b.0))
}
