//! Indexed triangle meshes as the shape builders make them: `f64` in, `f32` out when they are written.

use glam::{DVec2, DVec3};

/// An indexed triangle mesh, counter-clockwise seen from outside. `uvs` is empty or as long as `positions`.
#[derive(Clone, Default)]
pub(crate) struct Mesh {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) normals: Vec<DVec3>,
    pub(crate) uvs: Vec<DVec2>,
    pub(crate) triangles: Vec<[u16; 3]>,
}

impl Mesh {
    /// Adds a vertex and returns its index. Panics when the mesh outgrows 16-bit indices.
    pub(crate) fn push(&mut self, position: DVec3, normal: DVec3) -> u16 {
        // 65535 is the primitive restart value, which glTF forbids as an index.
        assert!(self.positions.len() < 65535, "mesh too large for 16-bit indices");
        self.positions.push(position);
        self.normals.push(normal.normalize());
        (self.positions.len() - 1) as u16
    }

    /// Two triangles over a quadrilateral given counter-clockwise.
    pub(crate) fn quad(&mut self, a: u16, b: u16, c: u16, d: u16) {
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }

    /// Twice the area vector of a triangle.
    #[cfg(test)]
    pub(crate) fn area_vector(&self, t: [u16; 3]) -> DVec3 {
        let [a, b, c] = t.map(|i| self.positions[usize::from(i)]);
        (b - a).cross(c - a)
    }
}

#[cfg(test)]
pub(crate) mod checks {
    use super::*;
    use std::collections::HashMap;

    /// Every triangle has area and faces the side of its vertex normals; normals are unit.
    pub(crate) fn assert_oriented(mesh: &Mesh) {
        assert_eq!(mesh.positions.len(), mesh.normals.len());
        for n in &mesh.normals {
            assert!((n.length() - 1.0).abs() < 1e-9, "normal {n} is not unit");
        }
        for &t in &mesh.triangles {
            let area = mesh.area_vector(t);
            assert!(area.length() > 1e-9, "degenerate triangle {t:?}");
            for i in t {
                let cos = area.normalize().dot(mesh.normals[usize::from(i)]);
                assert!(cos > 0.5, "triangle {t:?} faces away from its normal {i}: {cos}");
            }
        }
    }

    /// Every edge, by position, is used once in each direction: the surface is closed and has no cracks.
    pub(crate) fn assert_closed(mesh: &Mesh) {
        let key = |i: u16| mesh.positions[usize::from(i)].as_vec3().to_array().map(|x| (x + 0.0).to_bits());
        let mut edges: HashMap<_, i32> = HashMap::new();
        for t in &mesh.triangles {
            for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                *edges.entry((key(a), key(b))).or_default() += 1;
            }
        }
        for ((a, b), count) in &edges {
            assert_eq!(*count, 1, "edge used {count} times");
            assert_eq!(edges.get(&(*b, *a)), Some(&1), "edge without its opposite");
        }
    }

    #[test]
    #[should_panic(expected = "faces away")]
    fn a_flipped_triangle_is_noticed() {
        let mut mesh = crate::shapes::icosphere(1);
        mesh.triangles[7].swap(0, 1);
        assert_oriented(&mesh);
    }

    #[test]
    #[should_panic(expected = "edge without its opposite")]
    fn a_missing_triangle_is_noticed() {
        let mut mesh = crate::shapes::icosphere(1);
        mesh.triangles.pop();
        assert_closed(&mesh);
    }
}
