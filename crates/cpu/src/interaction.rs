//! Where a ray met a surface, in world space.

use crate::bvh::Hit;
use glam::Vec3;
use lumbre_core::Ray;
use lumbre_core::ray::offset_ray_origin;
use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::geometry::{TransformKey, Vertex, attribute};

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interaction {
    /// The point, from its barycentric coordinates.
    pub p: Vec3,
    /// Bound of the distance to the vertices of its triangle, metres.
    pub extent: f32,
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

/// The records behind a hit.
struct Records<'a> {
    key: &'a TransformKey,
    attributes: u32,
    triangle: usize,
    vertices: [usize; 3],
}

impl<'a> Records<'a> {
    #[inline]
    fn new(scene: &'a CompiledScene, hit: &Hit) -> Self {
        let instance = &scene.instances[hit.instance as usize];
        let mesh = &scene.meshes[instance.mesh as usize];
        let triangle = (mesh.first_triangle + hit.triangle) as usize;
        Records {
            // One key holds for all times; more are for motion, which is not drawn yet.
            key: &scene.transforms[instance.first_transform as usize],
            attributes: mesh.attributes,
            triangle,
            vertices: scene.triangles[triangle].map(|v| v as usize),
        }
    }
    #[inline]
    fn has(&self, attribute: u32) -> bool {
        self.attributes & attribute != 0
    }
    #[inline]
    fn positions(&self, scene: &CompiledScene) -> [Vec3; 3] {
        self.vertices.map(|v| Vec3::from_array(scene.positions[v]))
    }
    fn attributes(&self, scene: &CompiledScene, w: [f32; 3]) -> HitAttributes {
        let [a, b, c] = self.vertices.map(|v| &scene.vertices[v]);
        let mix = |x: f32, y: f32, z: f32| w[0] * x + w[1] * y + w[2] * z;
        let mut out = HitAttributes { uv: [[0.0; 2]; 2], color: [1.0; 4] };
        if self.has(attribute::UV) {
            out.uv =
                core::array::from_fn(|s| core::array::from_fn(|i| mix(a.uv[s][i], b.uv[s][i], c.uv[s][i])));
        }
        if self.has(attribute::COLOR) {
            out.color = core::array::from_fn(|i| mix(a.color[i], b.color[i], c.color[i]));
        }
        out
    }
}

#[inline]
fn weights(hit: &Hit) -> [f32; 3] {
    [1.0 - hit.b1 - hit.b2, hit.b1, hit.b2]
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
    let records = Records::new(scene, hit);
    let [p0, p1, p2] = records.positions(scene);
    unit(records.key.normal((p1 - p0).cross(p2 - p0)))
}

/// Texture coordinates and colour at a hit.
pub fn attributes(scene: &CompiledScene, hit: &Hit) -> HitAttributes {
    Records::new(scene, hit).attributes(scene, weights(hit))
}

/// To unit length, also where the square of the length leaves the range of `f32`.
#[inline]
fn unit(n: Vec3) -> Vec3 {
    let len2 = n.length_squared();
    if len2 > 1e-30 && len2 < 1e30 {
        n * (1.0 / len2.sqrt())
    } else {
        (n / n.abs().max_element().max(f32::MIN_POSITIVE)).normalize_or(Vec3::Y)
    }
}

impl Interaction {
    /// From what the BVH found.
    pub fn new(scene: &CompiledScene, ray: &Ray, hit: &Hit) -> Self {
        let records = Records::new(scene, hit);
        let key = records.key;
        let [p0, p1, p2] = records.positions(scene);
        let w = weights(hit);
        let p = p0 * w[0] + p1 * w[1] + p2 * w[2];
        let extent = [p0, p1, p2].map(|v| (v - p).abs().max_element());
        let ng = unit(key.normal((p1 - p0).cross(p2 - p0)));
        let mix3 = |a: [f32; 3], b: [f32; 3], c: [f32; 3]| {
            Vec3::from_array(a) * w[0] + Vec3::from_array(b) * w[1] + Vec3::from_array(c) * w[2]
        };
        let mut ns = ng;
        if records.has(attribute::NORMAL) {
            let [n0, n1, n2] = records.vertices.map(|v| scene.normals[v]);
            let n = mix3(n0, n1, n2);
            if n.length_squared() > 1e-12 {
                ns = unit(key.normal(n));
                // Normals that disagree with the winding would turn the surface inside out.
                ns = if ns.dot(ng) < 0.0 { -ns } else { ns };
            }
        }
        let (mut tangent, mut bitangent_sign) = (Vec3::ZERO, 1.0);
        if records.has(attribute::TANGENT) {
            let [v0, v1, v2] = records.vertices.map(|v| &scene.vertices[v]);
            let t = |v: &Vertex| [v.tangent[0], v.tangent[1], v.tangent[2]];
            tangent = key.vector(mix3(t(v0), t(v1), t(v2)));
            bitangent_sign = v0.tangent[3] * key.handedness;
        }
        let HitAttributes { uv, color } = records.attributes(scene, w);
        Interaction {
            p: key.point(p),
            extent: extent[0].max(extent[1]).max(extent[2]) * key.scale,
            ng,
            ns,
            tangent,
            bitangent_sign,
            uv,
            color,
            t: hit.t,
            instance: hit.instance,
            triangle: hit.triangle,
            material: scene.triangle_materials[records.triangle],
            front: ng.dot(ray.dir) < 0.0,
        }
    }

    /// Origin of a ray that leaves this point in direction `wi`.
    #[inline]
    pub fn leave(&self, wi: Vec3) -> Vec3 {
        offset_ray_origin(self.p, self.ng, wi, self.extent)
    }
}
