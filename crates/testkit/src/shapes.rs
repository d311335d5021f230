//! Simple shapes for tests: wound counter-clockwise from outside (or from the side of their normal).

use glam::{Vec2, Vec3};
use lumbre_scene::{Material, Mesh, MeshId, Node, Primitive, Scene};
use std::collections::HashMap;

/// A parallelogram from `corner` along `a` and `b`; its front is the side of `a × b`.
pub fn quad(corner: Vec3, a: Vec3, b: Vec3) -> Primitive {
    Primitive {
        positions: vec![corner, corner + a, corner + a + b, corner + b],
        normals: vec![a.cross(b).normalize(); 4],
        uv0: vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Primitive::default()
    }
}

/// A rectangle centred at `centre` with half axes `a` and `b`; its front is the side of `a × b`.
pub fn rectangle(centre: Vec3, a: Vec3, b: Vec3) -> Primitive {
    quad(centre - a - b, 2.0 * a, 2.0 * b)
}

/// A regular polygon of `n` sides and the area of a disc of this radius; its front is the side of `normal`.
pub fn disc(centre: Vec3, normal: Vec3, radius: f32, n: u32) -> Primitive {
    let frame = lumbre_core::Frame::from_normal(normal);
    let step = 2.0 * std::f32::consts::PI / n as f32;
    let r = radius * (step / lumbre_core::math::sin_cos(step).0).sqrt();
    let rim = (0..n).map(|i| {
        let (s, c) = lumbre_core::math::sin_cos(step * i as f32);
        centre + (frame.t * c + frame.b * s) * r
    });
    Primitive {
        positions: std::iter::once(centre).chain(rim).collect(),
        indices: (0..n).flat_map(|i| [0, 1 + i, 1 + (i + 1) % n]).collect(),
        ..Primitive::default()
    }
}

/// An icosahedron subdivided `level` times with its vertices on the sphere: 20 · 4^level triangles, flat.
pub fn icosphere(centre: Vec3, radius: f32, level: u32) -> Primitive {
    let g = 0.5 * (1.0 + 5f32.sqrt());
    let mut v: Vec<Vec3> = Vec::new();
    for s in [-1.0, 1.0] {
        for t in [-g, g] {
            v.extend([Vec3::new(s, t, 0.0), Vec3::new(0.0, s, t), Vec3::new(t, 0.0, s)]);
        }
    }
    v.iter_mut().for_each(|p| *p = p.normalize());
    // The faces of an icosahedron are the triples of mutual neighbours.
    let near = |a: Vec3, b: Vec3| (a - b).length() < 1.2;
    let mut faces = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if near(v[i], v[j]) && near(v[j], v[k]) && near(v[i], v[k]) {
                    let outward = (v[j] - v[i]).cross(v[k] - v[i]).dot(v[i]) > 0.0;
                    faces.push(if outward { [i, j, k] } else { [i, k, j] });
                }
            }
        }
    }
    for _ in 0..level {
        let mut middles: HashMap<(usize, usize), usize> = HashMap::new();
        let mut middle = |a: usize, b: usize, v: &mut Vec<Vec3>| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                v.push((v[a] + v[b]).normalize());
                v.len() - 1
            })
        };
        faces = faces
            .into_iter()
            .flat_map(|[a, b, c]| {
                let (x, y, z) = (middle(a, b, &mut v), middle(b, c, &mut v), middle(c, a, &mut v));
                [[a, x, z], [b, y, x], [c, z, y], [x, y, z]]
            })
            .collect();
    }
    Primitive {
        positions: v.iter().map(|p| centre + *p * radius).collect(),
        indices: faces.into_iter().flatten().map(|i| i as u32).collect(),
        ..Primitive::default()
    }
}

/// The same with interpolated normals.
pub fn smooth_icosphere(centre: Vec3, radius: f32, level: u32) -> Primitive {
    let p = icosphere(centre, radius, level);
    Primitive { normals: p.positions.iter().map(|v| (*v - centre).normalize()).collect(), ..p }
}

/// A closed body with valleys: an icosphere whose radius waves.
pub fn bumpy_icosphere(centre: Vec3, radius: f32, level: u32) -> Primitive {
    let p = icosphere(Vec3::ZERO, 1.0, level);
    let wave = |v: Vec3| {
        let s = |x: f32| lumbre_core::math::sin_cos(x).0;
        1.0 + 0.25 * s(5.0 * v.x + 1.0) * s(4.0 * v.y) * s(6.0 * v.z + 0.5)
    };
    Primitive { positions: p.positions.iter().map(|v| centre + *v * (radius * wave(*v))).collect(), ..p }
}

/// A box between two corners, flat.
pub fn cuboid(min: Vec3, max: Vec3) -> Primitive {
    let d = max - min;
    let (x, y, z) = (Vec3::X * d.x, Vec3::Y * d.y, Vec3::Z * d.z);
    let sides = [
        quad(min, y, x),
        quad(min, z, y),
        quad(min, x, z),
        quad(max, -x, -y),
        quad(max, -y, -z),
        quad(max, -z, -x),
    ];
    join(&sides)
}

/// Several primitives in one; attributes beyond positions and normals are dropped.
pub fn join(parts: &[Primitive]) -> Primitive {
    let mut out = Primitive::default();
    for p in parts {
        let first = out.positions.len() as u32;
        out.positions.extend(&p.positions);
        out.normals.extend(&p.normals);
        out.indices.extend(p.indices.iter().map(|i| i + first));
    }
    out
}

/// The same triangles seen from the other side.
pub fn inside_out(p: Primitive) -> Primitive {
    let indices = p.indices.chunks_exact(3).flat_map(|t| [t[0], t[2], t[1]]).collect();
    Primitive { indices, normals: p.normals.iter().map(|n| -*n).collect(), ..p }
}

/// Adds a shape of one material to a scene, at its own place.
pub fn add(scene: &mut Scene, shape: Primitive, material: Material) -> MeshId {
    let material = Some(scene.add_material(material));
    let mesh =
        scene.add_mesh(Mesh { name: String::new(), primitives: vec![Primitive { material, ..shape }] });
    scene.add_root(Node { mesh: Some(mesh), ..Node::default() });
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume by the divergence theorem: positive when all faces wind outwards and the body is closed.
    fn volume(p: &Primitive) -> f32 {
        let v = |i: u32| p.positions[i as usize];
        p.indices.chunks_exact(3).map(|t| v(t[0]).dot(v(t[1]).cross(v(t[2]))) / 6.0).sum()
    }

    #[test]
    fn bodies_are_closed_and_wind_outwards() {
        assert!((volume(&icosphere(Vec3::ZERO, 1.0, 4)) - 4.189).abs() < 0.02);
        assert_eq!(icosphere(Vec3::ZERO, 1.0, 2).indices.len(), 3 * 20 * 16);
        assert!((volume(&cuboid(Vec3::new(-1.0, 0.0, 2.0), Vec3::new(1.0, 3.0, 4.0))) - 12.0).abs() < 1e-4);
        assert!(volume(&inside_out(cuboid(Vec3::ZERO, Vec3::ONE))) < 0.0);
        assert!(volume(&bumpy_icosphere(Vec3::ZERO, 1.0, 4)) > 3.0);
        let d = disc(Vec3::ZERO, Vec3::Y, 2.0, 64);
        let area: Vec3 = d
            .indices
            .chunks_exact(3)
            .map(|t| [0, 1, 2].map(|k| d.positions[t[k] as usize]))
            .map(|[a, b, c]| 0.5 * (b - a).cross(c - a))
            .sum();
        assert!((area.y - 4.0 * std::f32::consts::PI).abs() < 1e-3, "{area}");
    }
}
