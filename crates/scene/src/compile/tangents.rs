//! Tangents for normal maps, by MikkTSpace (the `bevy_mikktspace` crate), as glTF asks where a file brings none.

use crate::Primitive;
use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::{Vec2, Vec3, Vec4};
use std::collections::HashMap;

/// Unindexed view of a primitive that collects one tangent for each corner.
struct Corners<'a> {
    primitive: &'a Primitive,
    uv: &'a [Vec2],
    tangents: Vec<Vec4>,
}

impl Corners<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.primitive.indices[3 * face + corner] as usize
    }
    fn face_normal(&self, face: usize) -> Vec3 {
        let [a, b, c] = [0, 1, 2].map(|k| self.primitive.positions[self.vertex(face, k)]);
        (b - a).cross(c - a).normalize_or_zero()
    }
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.primitive.indices.len() / 3
    }
    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }
    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.primitive.positions[self.vertex(face, corner)].to_array()
    }
    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        match self.primitive.normals.get(self.vertex(face, corner)) {
            Some(n) => n.to_array(),
            None => self.face_normal(face).to_array(),
        }
    }
    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        // glTF's v points down, the green of its normal maps up.
        let uv = self.uv[self.vertex(face, corner)];
        [uv.x, 1.0 - uv.y]
    }
    fn set_tangent(&mut self, tangent: Option<TangentSpace>, face: usize, corner: usize) {
        let t = tangent.map_or(Vec4::ZERO, |t| Vec4::from_array(t.tangent_encoded()));
        self.tangents[3 * face + corner] = if t.is_finite() { t } else { Vec4::ZERO };
    }
}

/// The same triangles with tangents along `uv`. Vertices whose corners got different tangents are split; primitives
/// without normals get flat ones. Degenerate corners get a zero tangent.
pub(super) fn with_tangents(primitive: &Primitive, uv: &[Vec2]) -> Primitive {
    let mut corners = Corners { primitive, uv, tangents: vec![Vec4::ZERO; primitive.indices.len()] };
    if generate_tangents(&mut corners).is_err() {
        return primitive.clone();
    }
    let flat = primitive.normals.is_empty();
    let mut out = Primitive { material: primitive.material, ..Primitive::default() };
    let mut seen: HashMap<(u32, [u32; 4], usize), u32> = HashMap::with_capacity(primitive.positions.len());
    for (i, &vertex) in primitive.indices.iter().enumerate() {
        let tangent = corners.tangents[i];
        // Flat corners belong to their face alone.
        let key = (vertex, tangent.to_array().map(f32::to_bits), if flat { i / 3 } else { 0 });
        let next = out.positions.len() as u32;
        let index = *seen.entry(key).or_insert(next);
        if index == next {
            let v = vertex as usize;
            let push2 = |to: &mut Vec<Vec2>, from: &[Vec2]| to.extend(from.get(v));
            out.positions.push(primitive.positions[v]);
            out.normals.push(if flat { corners.face_normal(i / 3) } else { primitive.normals[v] });
            out.tangents.push(tangent);
            push2(&mut out.uv0, &primitive.uv0);
            push2(&mut out.uv1, &primitive.uv1);
            out.colors.extend(primitive.colors.get(v));
        }
        out.indices.push(index);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quad in the xy plane with u along x and v down: tangent +x, bitangent +y (up the picture).
    #[test]
    fn bitangent_points_up_the_picture() {
        let p = Primitive {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
            uv0: vec![Vec2::new(0.0, 1.0), Vec2::new(1.0, 1.0), Vec2::new(1.0, 0.0), Vec2::ZERO],
            indices: vec![0, 1, 2, 0, 2, 3],
            ..Primitive::default()
        };
        for normals in [vec![Vec3::Z; 4], vec![]] {
            let out = with_tangents(&Primitive { normals, ..p.clone() }, &p.uv0);
            assert_eq!(out.indices.len(), 6);
            for (t, n) in out.tangents.iter().zip(&out.normals) {
                assert!((t.truncate() - Vec3::X).length() < 1e-5, "{t}");
                assert!((n.cross(t.truncate()) * t.w - Vec3::Y).length() < 1e-5, "{t}");
            }
        }
    }
}
