//! Indexed triangle meshes as the shape builders make them: `f64` in, `f32` out when they are written.

use super::Placement;
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// An indexed triangle mesh, counter-clockwise seen from outside. `uvs` and `colors` are empty or as long as `positions`.
#[derive(Clone, Default)]
pub(crate) struct Mesh {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) normals: Vec<DVec3>,
    pub(crate) uvs: Vec<DVec2>,
    /// Linear factors on the base colour.
    pub(crate) colors: Vec<DVec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Adds a vertex without texture coordinates and returns its index.
    pub(crate) fn push(&mut self, position: DVec3, normal: DVec3) -> u32 {
        self.positions.push(position);
        self.normals.push(normal.normalize());
        self.positions.len() as u32 - 1
    }

    /// Adds a vertex and returns its index.
    pub(crate) fn push_uv(&mut self, position: DVec3, normal: DVec3, uv: DVec2) -> u32 {
        self.uvs.push(uv);
        self.push(position, normal)
    }

    /// Two triangles over a quadrilateral given counter-clockwise.
    pub(crate) fn quad(&mut self, a: u32, b: u32, c: u32, d: u32) {
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }

    /// A flat quadrilateral with corners of its own, counter-clockwise, and their texture coordinates.
    pub(crate) fn flat_quad(&mut self, corners: [DVec3; 4], uvs: [DVec2; 4]) {
        let n = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let n = if n.length_squared() > 0.0 { n } else { DVec3::Y };
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| self.push_uv(corners[i], n, uvs[i]));
        self.quad(a, b, c, d);
    }

    /// Twice the area vector of a triangle.
    pub(crate) fn area_vector(&self, t: [u32; 3]) -> DVec3 {
        let [a, b, c] = t.map(|i| self.positions[i as usize]);
        (b - a).cross(c - a)
    }

    /// Adds all of `other`. What one of the two lacks (texture coordinates, colours) is filled with zero and white.
    pub(crate) fn append(&mut self, other: &Mesh) {
        let base = self.positions.len();
        if !self.uvs.is_empty() || !other.uvs.is_empty() {
            self.uvs.resize(base, DVec2::ZERO);
            self.uvs.extend(&other.uvs);
            self.uvs.resize(base + other.positions.len(), DVec2::ZERO);
        }
        if !self.colors.is_empty() || !other.colors.is_empty() {
            self.colors.resize(base, DVec3::ONE);
            self.colors.extend(&other.colors);
            self.colors.resize(base + other.positions.len(), DVec3::ONE);
        }
        self.positions.extend(&other.positions);
        self.normals.extend(&other.normals);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + base as u32)));
    }

    /// Adds a copy of `other` at a place.
    pub(crate) fn append_at(&mut self, other: &Mesh, placement: &Placement) {
        self.append(&other.clone().placed(placement));
    }

    /// The mesh, scaled, turned and moved. A scale of negative determinant keeps outside outside.
    pub(crate) fn placed(mut self, placement: &Placement) -> Mesh {
        for p in &mut self.positions {
            *p = placement.rotation * (*p * placement.scale) + placement.translation;
        }
        for n in &mut self.normals {
            *n = (placement.rotation * (*n / placement.scale)).normalize();
        }
        let s = placement.scale;
        if s.x * s.y * s.z < 0.0 {
            self.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        self
    }

    /// The mesh moved.
    pub(crate) fn moved(self, by: DVec3) -> Mesh {
        self.placed(&Placement::at(by))
    }

    /// The mesh without the triangles whose plane faces `direction` within 8°: a side that nobody sees.
    pub(crate) fn without_side(mut self, direction: DVec3) -> Mesh {
        let areas: Vec<DVec3> = self.triangles.iter().map(|t| self.area_vector(*t).normalize()).collect();
        let mut areas = areas.iter();
        self.triangles.retain(|_| areas.next().is_some_and(|a| a.dot(direction) < 0.99));
        self
    }

    /// Texture coordinates in metres by projection along the axis that each triangle faces most, upright and not mirrored on
    /// walls; `offset` is added. Vertices between two projections are doubled.
    pub(crate) fn box_uvs(self, offset: DVec2) -> Mesh {
        let mut out = Mesh::default();
        let mut known: HashMap<(u32, usize), u32> = HashMap::new();
        for &t in &self.triangles {
            let facing = self.area_vector(t);
            let axis = facing.abs().max_position();
            let side = facing[axis].signum();
            let t = t.map(|i| {
                *known.entry((i, axis * 2 + usize::from(side > 0.0))).or_insert_with(|| {
                    let p = self.positions[i as usize];
                    if let Some(c) = self.colors.get(i as usize) {
                        out.colors.push(*c);
                    }
                    out.push_uv(p, self.normals[i as usize], project(p, axis, side) + offset)
                })
            });
            out.triangles.push(t);
        }
        out
    }

    /// The mesh with every vertex in one colour, a factor on the base colour.
    pub(crate) fn tinted(mut self, color: DVec3) -> Mesh {
        self.colors = vec![color; self.positions.len()];
        self
    }

    /// The mesh with a colour for each vertex, found from its position.
    pub(crate) fn colored(mut self, color: impl Fn(DVec3) -> DVec3) -> Mesh {
        self.colors = self.positions.iter().map(|p| color(*p)).collect();
        self
    }
}

/// Texture coordinates in metres of a point on a face towards `side` of `axis`.
pub(crate) fn project(p: DVec3, axis: usize, side: f64) -> DVec2 {
    match axis {
        0 => DVec2::new(-side * p.z, -p.y),
        1 => DVec2::new(p.x, side * p.z),
        _ => DVec2::new(side * p.x, -p.y),
    }
}

#[cfg(test)]
pub(crate) mod checks {
    use super::*;

    /// Every triangle has area and faces the side of its vertex normals; normals are unit.
    pub(crate) fn assert_oriented(mesh: &Mesh) {
        assert_eq!(mesh.positions.len(), mesh.normals.len());
        assert!(mesh.uvs.is_empty() || mesh.uvs.len() == mesh.positions.len());
        for n in &mesh.normals {
            assert!((n.length() - 1.0).abs() < 1e-9, "normal {n} is not unit");
        }
        for &t in &mesh.triangles {
            let area = mesh.area_vector(t);
            assert!(area.length() > 1e-9, "degenerate triangle {t:?}");
            for i in t {
                let cos = area.normalize().dot(mesh.normals[i as usize]);
                assert!(cos > 0.5, "triangle {t:?} faces away from its normal {i}: {cos}");
            }
        }
    }

    /// Every edge, by position, is used once in each direction: the surface is closed and has no cracks.
    pub(crate) fn assert_closed(mesh: &Mesh) {
        let key = |i: u32| mesh.positions[i as usize].as_vec3().to_array().map(|x| (x + 0.0).to_bits());
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

    /// The volume inside a closed mesh that faces outward (divergence theorem).
    pub(crate) fn volume(mesh: &Mesh) -> f64 {
        mesh.triangles.iter().map(|&t| mesh.area_vector(t).dot(mesh.positions[t[0] as usize]) / 6.0).sum()
    }

    #[test]
    #[should_panic(expected = "faces away")]
    fn a_flipped_triangle_is_noticed() {
        let mut mesh = super::super::icosphere(1);
        mesh.triangles[7].swap(0, 1);
        assert_oriented(&mesh);
    }

    #[test]
    #[should_panic(expected = "edge without its opposite")]
    fn a_missing_triangle_is_noticed() {
        let mut mesh = super::super::icosphere(1);
        mesh.triangles.pop();
        assert_closed(&mesh);
    }

    #[test]
    fn mirrored_and_turned_copies_still_face_outward() {
        let mut mirrored = Placement::at(DVec3::new(1.0, 2.0, 3.0)).turned_y(33.0);
        mirrored.scale = DVec3::new(-1.0, 2.0, 0.5);
        let mesh = super::super::icosphere(2).placed(&mirrored);
        assert_oriented(&mesh);
        assert!(volume(&mesh) > 0.0);
    }

    #[test]
    fn projected_coordinates_are_upright_and_not_mirrored() {
        let mesh = super::super::rounded_box(DVec3::ONE, 0.1, 1).box_uvs(DVec2::ZERO);
        assert_oriented(&mesh);
        assert_closed(&mesh);
        for &t in &mesh.triangles {
            let [a, b, c] = t.map(|i| mesh.uvs[i as usize]);
            // v grows downwards: a front face winds clockwise in (u, v) as numbers.
            assert!((b - a).perp_dot(c - a) < 0.0, "mirrored");
        }
    }
}
