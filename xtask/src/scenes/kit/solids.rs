//! Solids of buildings and furniture: bevelled boxes, extruded outlines, turned profiles, tubes along paths. Texture
//! coordinates, where there are any, are in metres.

use super::Mesh;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A box from `low` to `high` whose edges are cut off by `bevel`. The faces are flat, the bevels shade from one to the other: 44
/// triangles. No texture coordinates: [`Mesh::box_uvs`] gives it some.
pub(crate) fn bevel_box(low: DVec3, high: DVec3, bevel: f64) -> Mesh {
    let (centre, half) = ((low + high) / 2.0, (high - low) / 2.0);
    assert!(half.min_element() > bevel, "the bevel {bevel} is too wide for a box of half size {half}");
    let mut mesh = Mesh::default();
    // The vertex of a corner that belongs to the face of an axis: 8 corners, 3 axes.
    let sign = |corner: usize, axis: usize| if corner >> axis & 1 == 1 { 1.0 } else { -1.0 };
    for corner in 0..8 {
        for axis in 0..3 {
            let mut p = [0.0; 3];
            for (i, x) in p.iter_mut().enumerate() {
                *x = sign(corner, i) * (half[i] - if i == axis { 0.0 } else { bevel });
            }
            mesh.push(centre + DVec3::from(p), DVec3::AXES[axis] * sign(corner, axis));
        }
    }
    let at = |corner: usize, axis: usize| (corner * 3 + axis) as u32;
    for axis in 0..3 {
        let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        for side in [0, 1usize] {
            let base = side << axis;
            oriented(&mut mesh, centre, &[base, base | u, base | u | v, base | v].map(|c| at(c, axis)));
            // The bevel along this axis at two of its edges: both values of v, one of u.
            let (first, second) = ((axis + 1) % 3, (axis + 2) % 3);
            for other in [0, v] {
                let edge = if side == 0 { other } else { other | u };
                let [a, b] = [edge, edge | 1 << axis];
                oriented(&mut mesh, centre, &[at(a, first), at(b, first), at(b, second), at(a, second)]);
            }
        }
    }
    for corner in 0..8 {
        oriented(&mut mesh, centre, &[0, 1, 2].map(|axis| at(corner, axis)));
    }
    mesh
}

/// Adds a flat convex face, turned so that it faces away from `centre`.
fn oriented(mesh: &mut Mesh, centre: DVec3, face: &[u32]) {
    let p = |i: usize| mesh.positions[face[i] as usize];
    let outward = (p(1) - p(0)).cross(p(2) - p(0)).dot(p(0) - centre) > 0.0;
    for i in 1..face.len() - 1 {
        let (b, c) = if outward { (face[i], face[i + 1]) } else { (face[i + 1], face[i]) };
        mesh.triangles.push([face[0], b, c]);
    }
}

/// The prism over a simple polygon in the plane (x, y), counter-clockwise, from z = 0 to `depth`, with flat sides and texture
/// coordinates in metres.
pub(crate) fn extrude(outline: &[DVec2], depth: f64) -> Mesh {
    let mut mesh = Mesh::default();
    for (i, &a) in outline.iter().enumerate() {
        let b = outline[(i + 1) % outline.len()];
        let corners = [a.extend(0.0), b.extend(0.0), b.extend(depth), a.extend(depth)];
        let along = (b - a).length();
        mesh.flat_quad(corners, [(0.0, 0.0), (along, 0.0), (along, depth), (0.0, depth)].map(DVec2::from));
    }
    for (z, n) in [(depth, DVec3::Z), (0.0, DVec3::NEG_Z)] {
        let ids: Vec<u32> =
            outline.iter().map(|p| mesh.push_uv(p.extend(z), n, DVec2::new(p.x * n.z, -p.y))).collect();
        for [a, b, c] in ears(outline) {
            let (b, c) = if n.z > 0.0 { (b, c) } else { (c, b) };
            mesh.triangles.push([ids[a], ids[b], ids[c]]);
        }
    }
    mesh
}

/// The same prism with the edges of both ends cut off by `bevel`, shaded round there; no texture coordinates.
pub(crate) fn extrude_beveled(outline: &[DVec2], depth: f64, bevel: f64) -> Mesh {
    let n = outline.len();
    let normal = |i: usize| {
        let along = (outline[(i + 1) % n] - outline[i % n]).normalize();
        DVec2::new(along.y, -along.x)
    };
    // Each corner moved inward so that both its edges move by the bevel.
    let inner: Vec<DVec2> = (0..n)
        .map(|i| {
            let (a, b) = (normal(i + n - 1), normal(i));
            outline[i] - (a + b) * bevel / (1.0 + a.dot(b))
        })
        .collect();
    let mut mesh = Mesh::default();
    for (z, end, side) in [(0.0, DVec3::NEG_Z, bevel), (depth, DVec3::Z, depth - bevel)] {
        let cap: Vec<u32> = inner.iter().map(|p| mesh.push(p.extend(z), end)).collect();
        let turn = |mesh: &mut Mesh, [a, b, c]: [u32; 3]| {
            mesh.triangles.push(if end.z > 0.0 { [a, b, c] } else { [a, c, b] });
        };
        for t in ears(&inner) {
            turn(&mut mesh, t.map(|i| cap[i]));
        }
        for i in 0..n {
            let out = normal(i).extend(0.0);
            let [a, b] = [i, (i + 1) % n].map(|j| mesh.push(outline[j].extend(side), out));
            turn(&mut mesh, [a, b, cap[(i + 1) % n]]);
            turn(&mut mesh, [a, cap[(i + 1) % n], cap[i]]);
        }
    }
    for i in 0..n {
        let (a, b, out) = (outline[i], outline[(i + 1) % n], normal(i).extend(0.0));
        let corners = [a.extend(bevel), b.extend(bevel), b.extend(depth - bevel), a.extend(depth - bevel)];
        let [a, b, c, d] = corners.map(|p| mesh.push(p, out));
        mesh.quad(a, b, c, d);
    }
    mesh
}

/// Triangles of a simple polygon, counter-clockwise, by cutting off ears (Meisters 1975).
fn ears(outline: &[DVec2]) -> Vec<[usize; 3]> {
    let mut left: Vec<usize> = (0..outline.len()).collect();
    let mut out = Vec::new();
    let side = |a: usize, b: usize, c: usize| (outline[b] - outline[a]).perp_dot(outline[c] - outline[a]);
    while left.len() > 3 {
        let n = left.len();
        let ear = (0..n).find(|&i| {
            let (a, b, c) = (left[(i + n - 1) % n], left[i], left[(i + 1) % n]);
            let inside = |&&p: &&usize| {
                ![a, b, c].contains(&p)
                    && side(a, b, p) >= 0.0
                    && side(b, c, p) >= 0.0
                    && side(c, a, p) >= 0.0
            };
            side(a, b, c) > 1e-12 && left.iter().find(inside).is_none()
        });
        let i = ear.expect("the outline is simple and counter-clockwise");
        out.push([left[(i + n - 1) % n], left[i], left[(i + 1) % n]]);
        left.remove(i);
    }
    out.push([left[0], left[1], left[2]]);
    out
}

/// A profile of (radius, height) turned about the y axis, its outside to the right of its direction of travel (upwards for an
/// outer wall). Corners sharper than `crease_deg` stay sharp. u runs around in metres at the largest radius, v along the profile.
pub(crate) fn lathe(profile: &[DVec2], sides: usize, crease_deg: f64) -> Mesh {
    let widest = profile.iter().fold(0.0, |r: f64, p| r.max(p.x));
    let normal = |i: usize| {
        let along = (profile[i + 1] - profile[i]).normalize();
        DVec2::new(along.y, -along.x)
    };
    let smooth = libm::cos(crease_deg.to_radians());
    let mut mesh = Mesh::default();
    let mut length = 0.0;
    for i in 0..profile.len() - 1 {
        let (own, step) = (normal(i), (profile[i + 1] - profile[i]).length());
        let joined = |j: usize| if own.dot(normal(j)) > smooth { (own + normal(j)).normalize() } else { own };
        let begin = if i > 0 { joined(i - 1) } else { own };
        let end = if i + 2 < profile.len() { joined(i + 1) } else { own };
        let base = mesh.positions.len() as u32;
        for k in 0..=sides {
            let turn = k as f64 / sides as f64;
            // The seam is closed exactly.
            let (s, c) = libm::sincos(TAU * (k % sides) as f64 / sides as f64);
            for (p, n, v) in [(profile[i], begin, length), (profile[i + 1], end, length + step)] {
                let uv = DVec2::new(TAU * widest * turn, -v);
                mesh.push_uv(DVec3::new(p.x * c, p.y, -p.x * s), DVec3::new(n.x * c, n.y, -n.x * s), uv);
            }
        }
        for k in 0..sides as u32 {
            let [a, b, c, d] = [0, 2, 3, 1].map(|j| base + 2 * k + j);
            if profile[i].x > 0.0 {
                mesh.triangles.push([a, b, c]);
            }
            if profile[i + 1].x > 0.0 {
                mesh.triangles.push([a, c, d]);
            }
        }
        length += step;
    }
    mesh
}

/// A polyline with its inner corners replaced by arcs of `steps` segments that begin `radius` before the corner.
pub(crate) fn round_path(points: &[DVec3], radius: f64, steps: usize) -> Vec<DVec3> {
    let mut out = vec![points[0]];
    for w in points.windows(3) {
        let (before, after) = ((w[0] - w[1]).normalize() * radius, (w[2] - w[1]).normalize() * radius);
        for i in 0..=steps {
            // A quadratic curve that touches both legs: near enough to an arc.
            let t = i as f64 / steps as f64;
            out.push(w[1] + before * (1.0 - t) * (1.0 - t) + after * t * t);
        }
    }
    out.extend(points.last());
    out
}

/// A round tube along a path, with flat ends; u runs around, v along, in metres. Rings turn with the path, without twist.
pub(crate) fn tube(path: &[DVec3], radius: f64, sides: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let direction = |i: usize| {
        let (a, b) = (path[i.saturating_sub(1)], path[(i + 1).min(path.len() - 1)]);
        (b - a).normalize()
    };
    let mut normal = direction(0).any_orthonormal_vector();
    let mut length = 0.0;
    let mut rings = Vec::new();
    for (i, &centre) in path.iter().enumerate() {
        let along = direction(i);
        normal = (normal - along * normal.dot(along)).normalize();
        let binormal = along.cross(normal);
        if i > 0 {
            length += (centre - path[i - 1]).length();
        }
        let ring: Vec<DVec3> = (0..sides)
            .map(|k| {
                let (s, c) = libm::sincos(TAU * k as f64 / sides as f64);
                normal * c + binormal * s
            })
            .collect();
        for k in 0..=sides {
            let n = ring[k % sides];
            let uv = DVec2::new(TAU * radius * k as f64 / sides as f64, -length);
            mesh.push_uv(centre + n * radius, n, uv);
        }
        rings.push((centre, along));
    }
    let at = |ring: usize, k: usize| (ring * (sides + 1) + k) as u32;
    for ring in 0..path.len() - 1 {
        for k in 0..sides {
            mesh.quad(at(ring, k), at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k));
        }
    }
    for (ring, out) in [(0, -direction(0)), (path.len() - 1, direction(path.len() - 1))] {
        let middle = mesh.push_uv(rings[ring].0, out, DVec2::ZERO);
        let rim: Vec<u32> = (0..sides)
            .map(|k| mesh.push_uv(mesh.positions[at(ring, k) as usize], out, DVec2::ZERO))
            .collect();
        for k in 0..sides {
            let (a, b) = (rim[k], rim[(k + 1) % sides]);
            mesh.triangles.push(if ring == 0 { [middle, b, a] } else { [middle, a, b] });
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::super::checks::{assert_closed, assert_oriented, volume};
    use super::*;

    #[test]
    fn solids_are_closed_and_face_outward() {
        let corner =
            [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)].map(DVec2::from);
        let bollard = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.8), (0.05, 0.9), (0.0, 0.9)].map(DVec2::from);
        let path = round_path(&[DVec3::ZERO, DVec3::Y, DVec3::new(1.0, 1.0, 0.0), DVec3::ONE], 0.2, 6);
        let solids = [
            (bevel_box(DVec3::new(-1.0, 0.0, 2.0), DVec3::new(0.0, 0.5, 4.0), 0.02), 1.0, 0.02),
            (extrude(&corner, 0.5), 1.5, 1e-9),
            (extrude_beveled(&corner, 0.5, 0.02), 1.5, 0.01),
            (lathe(&bollard, 24, 30.0), 0.0, f64::MAX),
            (tube(&path, 0.05, 12), 0.0, f64::MAX),
        ];
        for (mesh, expected, tolerance) in solids {
            assert_oriented(&mesh);
            assert_closed(&mesh);
            assert!(volume(&mesh) > 0.0 && (volume(&mesh) - expected).abs() < tolerance);
        }
    }

    #[test]
    fn a_box_has_the_size_that_was_told() {
        let (low, high) = (DVec3::new(-1.0, 0.0, 2.0), DVec3::new(0.0, 0.5, 4.0));
        let mesh = bevel_box(low, high, 0.02);
        assert_eq!(mesh.triangles.len(), 44);
        let fold = |pick: fn(DVec3, DVec3) -> DVec3| mesh.positions.iter().copied().reduce(pick).unwrap();
        assert!((fold(DVec3::min) - low).length() < 1e-12 && (fold(DVec3::max) - high).length() < 1e-12);
    }
}
