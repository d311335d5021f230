//! Records of meshes and where they stand.

use super::NONE;
use bytemuck::{Pod, Zeroable};
use glam::{Affine3A, Mat3A, Vec3, Vec3A};

/// Attributes of a vertex beside position and normal, object space.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Vertex {
    /// Unit tangent and the sign of the bitangent; zero: none.
    pub tangent: [f32; 4],
    /// Two sets of texture coordinates.
    pub uv: [[f32; 2]; 2],
    /// Linear colour and alpha.
    pub color: [f32; 4],
}

/// Bits of [`MeshRecord::attributes`]: some vertex of the mesh has them.
pub mod attribute {
    /// Normals that are not zero.
    pub const NORMAL: u32 = 1;
    /// Tangents that are not zero.
    pub const TANGENT: u32 = 2;
    /// Texture coordinates that are not zero.
    pub const UV: u32 = 4;
    /// Colours that are not white.
    pub const COLOR: u32 = 8;
}

/// A mesh: a range of triangles and of vertices.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct MeshRecord {
    /// First of `triangles`.
    pub first_triangle: u32,
    /// How many.
    pub triangle_count: u32,
    /// First of `positions`.
    pub first_vertex: u32,
    /// How many.
    pub vertex_count: u32,
    /// Start of its part of `emissive_ranks`, or [`NONE`].
    pub first_emissive_rank: u32,
    /// 1 when every triangle stops every ray: no coverage, no transmission; any-hit work can be skipped.
    pub opaque: u32,
    /// 1 when camera rays must look which side of a triangle they meet.
    pub culls: u32,
    /// Bits of [`attribute`]: what its vertices have.
    pub attributes: u32,
}

/// A mesh placed in the world.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct InstanceRecord {
    /// Which mesh.
    pub mesh: u32,
    /// First of its `transforms`.
    pub first_transform: u32,
    /// How many; 1 while nothing moves.
    pub transform_count: u32,
    /// Light of the first emissive triangle of its mesh, or [`NONE`] where there is none or it is hidden.
    pub first_light: u32,
    /// Ray mask; 0 where it is hidden, so that no ray meets it and it does not light.
    pub mask: u32,
    /// Node of the authored scene.
    pub node: u32,
}

/// Where an instance is at one moment: rows of 3x4 matrices.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TransformKey {
    /// Object to world.
    pub object_to_world: [[f32; 4]; 3],
    /// World to object.
    pub world_to_object: [[f32; 4]; 3],
    /// +1, or -1 where the transform mirrors: it turns the side that winding makes the front.
    pub handedness: f32,
    /// Largest factor by which it stretches a length.
    pub scale: f32,
    /// Moment in the shutter interval, 0 to 1.
    pub time: f32,
}

impl TransformKey {
    /// From a transform that can be inverted.
    pub fn new(object_to_world: Affine3A, time: f32) -> Self {
        let handedness = if object_to_world.matrix3.determinant() < 0.0 { -1.0 } else { 1.0 };
        TransformKey {
            object_to_world: to_rows(object_to_world),
            world_to_object: to_rows(object_to_world.inverse()),
            handedness,
            // The Frobenius norm: never below the largest stretch, at most √3 above.
            scale: (object_to_world.matrix3.x_axis.length_squared()
                + object_to_world.matrix3.y_axis.length_squared()
                + object_to_world.matrix3.z_axis.length_squared())
            .sqrt(),
            time,
        }
    }
    /// A point of the object in world space.
    #[inline]
    pub fn point(&self, p: Vec3) -> Vec3 {
        let row = |r: &[f32; 4]| r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3];
        let [x, y, z] = &self.object_to_world;
        Vec3::new(row(x), row(y), row(z))
    }
    /// A vector of the object in world space.
    #[inline]
    pub fn vector(&self, v: Vec3) -> Vec3 {
        let row = |r: &[f32; 4]| r[0] * v.x + r[1] * v.y + r[2] * v.z;
        let [x, y, z] = &self.object_to_world;
        Vec3::new(row(x), row(y), row(z))
    }
    /// A normal of the object in world space, not of unit length: by the inverse transpose, so that mirroring keeps the front side,
    /// as glTF asks.
    #[inline]
    pub fn normal(&self, n: Vec3) -> Vec3 {
        let row = |r: &[f32; 4]| Vec3::new(r[0], r[1], r[2]);
        let [x, y, z] = &self.world_to_object;
        row(x) * n.x + row(y) * n.y + row(z) * n.z
    }
    /// Object to world.
    #[inline]
    pub fn object_to_world(&self) -> Affine3A {
        from_rows(&self.object_to_world)
    }
    /// World to object.
    #[inline]
    pub fn world_to_object(&self) -> Affine3A {
        from_rows(&self.world_to_object)
    }
}

fn to_rows(a: Affine3A) -> [[f32; 4]; 3] {
    let m = a.matrix3.transpose();
    let row = |r: Vec3A, t: f32| [r.x, r.y, r.z, t];
    [row(m.x_axis, a.translation.x), row(m.y_axis, a.translation.y), row(m.z_axis, a.translation.z)]
}

#[inline]
fn from_rows(r: &[[f32; 4]; 3]) -> Affine3A {
    let column = |i: usize| Vec3A::new(r[0][i], r[1][i], r[2][i]);
    Affine3A { matrix3: Mat3A::from_cols(column(0), column(1), column(2)), translation: column(3) }
}

impl MeshRecord {
    /// Rank of a triangle among the emissive ones of the mesh.
    #[inline]
    pub fn emissive_rank(&self, ranks: &[u32], triangle: u32) -> Option<u32> {
        if self.first_emissive_rank == NONE {
            return None;
        }
        let rank = ranks[(self.first_emissive_rank + triangle) as usize];
        (rank != NONE).then_some(rank)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Quat;

    #[test]
    fn transforms_survive_the_record() {
        let a = Affine3A::from_scale_rotation_translation(
            Vec3::new(1.0, -2.0, 3.0),
            Quat::from_rotation_y(0.7),
            Vec3::new(4.0, 5.0, 6.0),
        );
        let key = TransformKey::new(a, 0.0);
        assert_eq!(key.object_to_world(), a);
        assert_eq!(key.handedness, -1.0);
        let p = Vec3::new(0.1, 0.2, 0.3);
        assert!((key.world_to_object().transform_point3(a.transform_point3(p)) - p).length() < 1e-5);
        assert!((key.point(p) - a.transform_point3(p)).length() < 1e-6);
        assert!((key.vector(p) - a.transform_vector3(p)).length() < 1e-6);
        // A normal stays perpendicular to what it was perpendicular to.
        assert!(key.normal(Vec3::new(0.2, -0.1, 0.0)).dot(key.vector(p)).abs() < 1e-6);
        assert!(key.scale >= 3.0);
    }
}
