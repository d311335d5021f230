//! Where a ray met a surface, in world space.

use crate::bvh::Hit;
use glam::{Affine3A, Vec3, Vec3A};
use lumbre_core::Ray;
use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::geometry::{InstanceRecord, TransformKey};

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interaction {
    /// The point, from its barycentric coordinates.
    pub p: Vec3,
    /// Unit geometric normal on the front side, the one from which the triangle winds counter-clockwise.
    pub ng: Vec3,
    /// Unit interpolated normal, on the same side as `ng`.
    pub ns: Vec3,
    /// Interpolated tangent, not normalised; zero if there is none.
    pub tangent: Vec3,
    /// Sign of the bitangent: B = sign · ns × tangent.
    pub bitangent_sign: f32,
    /// Two sets of texture coordinates.
    pub uv: [[f32; 2]; 2],
    /// Vertex colour and alpha.
    pub color: [f32; 4],
    /// Distance along the ray, in units of its direction.
    pub t: f32,
    /// Instance.
    pub instance: u32,
    /// Triangle within the mesh.
    pub triangle: u32,
    /// Material.
    pub material: u32,
    /// The ray came from the side of `ng`.
    pub front: bool,
}

/// What coverage and culling need to know of a hit; cheaper than an [`Interaction`].
#[derive(Clone, Copy, Debug)]
pub struct HitAttributes {
    /// Two sets of texture coordinates.
    pub uv: [[f32; 2]; 2],
    /// Vertex colour and alpha.
    pub color: [f32; 4],
}

/// Transform of an instance at a time. One key holds for all times; more are for motion, which is not drawn yet.
#[inline]
pub(crate) fn transform<'a>(scene: &'a CompiledScene, instance: &InstanceRecord) -> &'a TransformKey {
    &scene.transforms[instance.first_transform as usize]
}

/// Vertex indices of a hit triangle.
#[inline]
fn vertices(scene: &CompiledScene, hit: &Hit) -> [usize; 3] {
    let mesh = &scene.meshes[scene.instances[hit.instance as usize].mesh as usize];
    scene.triangles[(mesh.first_triangle + hit.triangle) as usize].map(|v| v as usize)
}

/// Material of a hit triangle.
#[inline]
pub fn material_of(scene: &CompiledScene, hit: &Hit) -> u32 {
    let mesh = &scene.meshes[scene.instances[hit.instance as usize].mesh as usize];
    scene.triangle_materials[(mesh.first_triangle + hit.triangle) as usize]
}

/// Geometric normal of a hit triangle on its front side, world space, unit.
#[inline]
pub fn geometric_normal(scene: &CompiledScene, hit: &Hit) -> Vec3 {
    let [p0, p1, p2] = vertices(scene, hit).map(|v| Vec3::from_array(scene.positions[v]));
    let world_to_object = transform(scene, &scene.instances[hit.instance as usize]).world_to_object();
    normal_to_world(&world_to_object, (p1 - p0).cross(p2 - p0))
}

/// Object normals go by the inverse transpose; mirroring then keeps the front side, as glTF asks. Scaled up first, since the
/// cross product of tiny edges may be too small to square.
#[inline]
fn normal_to_world(world_to_object: &Affine3A, n: Vec3) -> Vec3 {
    let m = world_to_object.matrix3;
    let n = n / n.abs().max_element().max(f32::MIN_POSITIVE);
    let n = Vec3A::from(n);
    let world = Vec3::new(m.x_axis.dot(n), m.y_axis.dot(n), m.z_axis.dot(n));
    (world / world.abs().max_element().max(f32::MIN_POSITIVE)).normalize_or(Vec3::Y)
}

/// Texture coordinates and colour at a hit.
pub fn attributes(scene: &CompiledScene, hit: &Hit) -> HitAttributes {
    let [a, b, c] = vertices(scene, hit).map(|v| &scene.vertices[v]);
    let w = [1.0 - hit.b1 - hit.b2, hit.b1, hit.b2];
    let mix = |x: f32, y: f32, z: f32| w[0] * x + w[1] * y + w[2] * z;
    let uv = core::array::from_fn(|s| core::array::from_fn(|i| mix(a.uv[s][i], b.uv[s][i], c.uv[s][i])));
    let color = core::array::from_fn(|i| mix(a.color[i], b.color[i], c.color[i]));
    HitAttributes { uv, color }
}

impl Interaction {
    /// From what the BVH found.
    pub fn new(scene: &CompiledScene, ray: &Ray, hit: &Hit) -> Self {
        let instance = &scene.instances[hit.instance as usize];
        let key = transform(scene, instance);
        let (to_world, to_object) = (key.object_to_world(), key.world_to_object());
        let index = vertices(scene, hit);
        let [p0, p1, p2] = index.map(|v| Vec3::from_array(scene.positions[v]));
        let [v0, v1, v2] = index.map(|v| &scene.vertices[v]);
        let w = [1.0 - hit.b1 - hit.b2, hit.b1, hit.b2];
        let mix3 = |a: [f32; 3], b: [f32; 3], c: [f32; 3]| {
            Vec3::from_array(a) * w[0] + Vec3::from_array(b) * w[1] + Vec3::from_array(c) * w[2]
        };
        let p = to_world.transform_point3(p0 * w[0] + p1 * w[1] + p2 * w[2]);
        let ng = normal_to_world(&to_object, (p1 - p0).cross(p2 - p0));
        let n = mix3(v0.normal, v1.normal, v2.normal);
        let ns = if n.length_squared() < 1e-12 { ng } else { normal_to_world(&to_object, n) };
        let tangent = mix3(
            [v0.tangent[0], v0.tangent[1], v0.tangent[2]],
            [v1.tangent[0], v1.tangent[1], v1.tangent[2]],
            [v2.tangent[0], v2.tangent[1], v2.tangent[2]],
        );
        let HitAttributes { uv, color } = attributes(scene, hit);
        Interaction {
            p,
            ng,
            // Normals that disagree with the winding would turn the surface inside out.
            ns: if ns.dot(ng) < 0.0 { -ns } else { ns },
            tangent: to_world.transform_vector3(tangent),
            bitangent_sign: v0.tangent[3] * key.handedness,
            uv,
            color,
            t: hit.t,
            instance: hit.instance,
            triangle: hit.triangle,
            material: material_of(scene, hit),
            front: ng.dot(ray.dir) < 0.0,
        }
    }
}
