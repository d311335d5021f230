//! Triangle meshes.

use crate::MaterialId;
use glam::{Vec2, Vec3, Vec4};

/// Triangles of one material. Attribute vectors are either empty or as long as `positions`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Primitive {
    /// Vertex positions, metres, object space.
    pub positions: Vec<Vec3>,
    /// Unit normals; empty: flat shading.
    pub normals: Vec<Vec3>,
    /// Unit tangents, w = ±1 the sign of the bitangent; empty: made by MikkTSpace where a normal map needs them.
    pub tangents: Vec<Vec4>,
    /// First texture coordinates; v points down, as in glTF.
    pub uv0: Vec<Vec2>,
    /// Second texture coordinates.
    pub uv1: Vec<Vec2>,
    /// Linear vertex colours with alpha; they multiply the base colour.
    pub colors: Vec<Vec4>,
    /// Three vertex indices per triangle, each below `positions.len()`.
    pub indices: Vec<u32>,
    /// `None`: a white, two-sided dielectric.
    pub material: Option<MaterialId>,
}

/// A mesh, shared by any number of nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Name; may be empty.
    pub name: String,
    /// Its parts.
    pub primitives: Vec<Primitive>,
}
