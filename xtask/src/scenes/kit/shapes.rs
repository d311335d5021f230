//! The shapes of the scenes: rectangle, rounded box, icosphere, torus knot, surface of revolution. All carry the exact
//! normals of the surface they approximate, so they shade smoothly at modest triangle counts.

use super::Mesh;
use glam::{DVec2, DVec3};
use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_4, TAU};

/// The parallelogram `corner`, `corner + u`, `corner + u + v`, `corner + v`, facing `u × v`.
pub(crate) fn rectangle(corner: DVec3, u: DVec3, v: DVec3) -> Mesh {
    let mut mesh = Mesh::default();
    let n = u.cross(v);
    let [a, b, c, d] = [corner, corner + u, corner + u + v, corner + v].map(|p| mesh.push(p, n));
    mesh.quad(a, b, c, d);
    mesh
}

/// A body of flat convex faces, each given counter-clockwise seen from outside.
pub(crate) fn faceted(faces: &[Vec<DVec3>]) -> Mesh {
    let mut mesh = Mesh::default();
    for face in faces {
        let n = (face[1] - face[0]).cross(face[2] - face[0]);
        let corners: Vec<u32> = face.iter().map(|p| mesh.push(*p, n)).collect();
        for pair in corners[1..].windows(2) {
            mesh.triangles.push([corners[0], pair[0], pair[1]]);
        }
    }
    mesh
}

/// A box of half extents `half` around the origin whose edges and corners are rounded with `radius`, in `steps` segments per
/// eighth of a turn. Its vertices are those of a cube sphere whose eight octants were pulled apart.
pub(crate) fn rounded_box(half: DVec3, radius: f64, steps: usize) -> Mesh {
    // Grid lines of one face as (tangent of the angle, side): the middle line occurs twice, once per octant.
    let line = |i: usize| libm::tan(FRAC_PI_4 * (i as f64 / steps as f64 - 1.0));
    let below = (0..=steps).map(|i| (line(i), -1.0));
    let above = (0..=steps).map(|i| (line(i + steps), 1.0));
    let lines: Vec<(f64, f64)> = below.chain(above).collect();
    let inner = half - DVec3::splat(radius);
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let base = mesh.positions.len();
            for &(tv, sv) in &lines {
                for &(tu, su) in &lines {
                    // (u, v, w) is right-handed for the positive face; the negative face mirrors u.
                    let (mut direction, mut octant) = ([0.0; 3], [0.0; 3]);
                    (direction[axis], octant[axis]) = (side, side);
                    (direction[(axis + 1) % 3], octant[(axis + 1) % 3]) = (tu * side, su * side);
                    (direction[(axis + 2) % 3], octant[(axis + 2) % 3]) = (tv, sv);
                    let n = DVec3::from(direction).normalize();
                    mesh.push(inner * DVec3::from(octant) + n * radius, n);
                }
            }
            grid(&mut mesh, base, lines.len(), lines.len());
        }
    }
    mesh
}

/// Quads over a `columns` × `rows` grid of vertices that starts at `base`, column index fastest.
fn grid(mesh: &mut Mesh, base: usize, columns: usize, rows: usize) {
    let at = |x: usize, y: usize| (base + y * columns + x) as u32;
    for y in 0..rows - 1 {
        for x in 0..columns - 1 {
            mesh.quad(at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
        }
    }
}

/// The unit sphere as an icosahedron, each triangle split in four `levels` times.
pub(crate) fn icosphere(levels: usize) -> Mesh {
    let g = (1.0 + 5f64.sqrt()) / 2.0;
    let mut mesh = Mesh::default();
    // Three golden rectangles, one per axis pair (x, y), (y, z), (z, x).
    for axis in 0..3 {
        for (a, b) in [(-1.0, -g), (1.0, -g), (-1.0, g), (1.0, g)] {
            let mut p = [0.0; 3];
            (p[axis], p[(axis + 1) % 3]) = (a, b);
            let p = DVec3::from(p).normalize();
            mesh.push(p, p);
        }
    }
    // A face is any three vertices that are mutually nearest; turned to face outward.
    let edge = 2.0 / (1.0 + g * g).sqrt();
    let p = mesh.positions.clone();
    let near = |a: usize, b: usize| (p[a] - p[b]).length() < edge * 1.01;
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(c, a) {
                    let outward = (p[b] - p[a]).cross(p[c] - p[a]).dot(p[a]) > 0.0;
                    let (b, c) = if outward { (b, c) } else { (c, b) };
                    mesh.triangles.push([a as u32, b as u32, c as u32]);
                }
            }
        }
    }
    for _ in 0..levels {
        split_sphere(&mut mesh);
    }
    mesh
}

/// Splits each triangle of a sphere in four, new vertices pushed out to the sphere.
fn split_sphere(mesh: &mut Mesh) {
    let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
    for [a, b, c] in std::mem::take(&mut mesh.triangles) {
        let mut middle = |i: u32, j: u32| {
            *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                let p = (mesh.positions[i as usize] + mesh.positions[j as usize]).normalize();
                mesh.push(p, p)
            })
        };
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        mesh.triangles.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
    }
}

/// A tube of radius `tube` along the (2, 3) torus knot (trefoil) wound on a torus of radii 1 and `minor` around the z axis,
/// `rings` rings of `sides` vertices each.
pub(crate) fn trefoil(minor: f64, tube: f64, rings: usize, sides: usize) -> Mesh {
    let curve = |t: f64| {
        let r = 1.0 + minor * libm::cos(3.0 * t);
        DVec3::new(r * libm::cos(2.0 * t), r * libm::sin(2.0 * t), -minor * libm::sin(3.0 * t))
    };
    let mut mesh = Mesh::default();
    for ring in 0..rings {
        let t = TAU * ring as f64 / rings as f64;
        let centre = curve(t);
        // d/dt of the curve, and the direction away from the torus' core circle: together they frame the tube without twist.
        let r = 1.0 + minor * libm::cos(3.0 * t);
        let (s2, c2) = libm::sincos(2.0 * t);
        let dr = -3.0 * minor * libm::sin(3.0 * t);
        let tangent =
            DVec3::new(dr * c2 - 2.0 * r * s2, dr * s2 + 2.0 * r * c2, -3.0 * minor * libm::cos(3.0 * t))
                .normalize();
        let outward = centre - DVec3::new(c2, s2, 0.0);
        let normal = (outward - tangent * outward.dot(tangent)).normalize();
        let binormal = tangent.cross(normal);
        for side in 0..sides {
            let (s, c) = libm::sincos(TAU * side as f64 / sides as f64);
            let n = normal * c + binormal * s;
            mesh.push(centre + n * tube, n);
        }
    }
    let at = |ring: usize, side: usize| ((ring % rings) * sides + side % sides) as u32;
    for ring in 0..rings {
        for side in 0..sides {
            mesh.quad(at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side));
        }
    }
    mesh
}

/// The surface that a uniform cubic B-spline through the plane (radius, height) sweeps around the y axis, outside to the right
/// of its direction of travel. The first and the last control point lie on the axis, where the curve meets it at a right angle;
/// `steps` segments per span, `sides` around.
pub(crate) fn revolve(profile: &[DVec2], steps: usize, sides: usize) -> Mesh {
    // Mirrored neighbours make the curve cross the axis horizontally.
    let mirror = |p: DVec2| DVec2::new(-p.x, p.y);
    let mut control = vec![mirror(profile[1])];
    control.extend(profile);
    control.push(mirror(profile[profile.len() - 2]));
    let samples = (profile.len() - 1) * steps;
    let mut mesh = Mesh::default();
    for row in 0..=samples {
        let (point, slope) = bspline(&control, row as f64 / steps as f64);
        let normal = DVec2::new(slope.y, -slope.x).normalize();
        if row == 0 || row == samples {
            mesh.push(DVec3::new(0.0, point.y, 0.0), DVec3::Y * normal.y.signum());
            continue;
        }
        for side in 0..sides {
            let (s, c) = libm::sincos(TAU * side as f64 / sides as f64);
            mesh.push(
                DVec3::new(point.x * c, point.y, -point.x * s),
                DVec3::new(normal.x * c, normal.y, -normal.x * s),
            );
        }
    }
    // Fans at the two poles, quads between.
    let at = |row: usize, side: usize| (1 + (row - 1) * sides + side % sides) as u32;
    let last = (mesh.positions.len() - 1) as u32;
    for side in 0..sides {
        mesh.triangles.push([0, at(1, side + 1), at(1, side)]);
        for row in 1..samples - 1 {
            mesh.quad(at(row, side), at(row, side + 1), at(row + 1, side + 1), at(row + 1, side));
        }
        mesh.triangles.push([at(samples - 1, side), at(samples - 1, side + 1), last]);
    }
    mesh
}

/// Point and derivative of a uniform cubic B-spline at `t` in [0, number of spans].
fn bspline(control: &[DVec2], t: f64) -> (DVec2, DVec2) {
    let span = (t as usize).min(control.len() - 4);
    let x = t - span as f64;
    let (y, c) = (1.0 - x, &control[span..span + 4]);
    let w = [y * y * y, 3.0 * x * x * x - 6.0 * x * x + 4.0, 3.0 * y * y * y - 6.0 * y * y + 4.0, x * x * x]
        .map(|w| w / 6.0);
    let d = [-0.5 * y * y, 1.5 * x * x - 2.0 * x, -1.5 * y * y + 2.0 * y, 0.5 * x * x];
    let sum = |w: [f64; 4]| (0..4).map(|i| c[i] * w[i]).sum();
    (sum(w), sum(d))
}

#[cfg(test)]
mod tests {
    use super::super::checks::{assert_closed, assert_oriented};
    use super::*;

    #[test]
    fn shapes_are_closed_and_face_outward() {
        let egg = revolve(&[DVec2::ZERO, DVec2::new(0.5, 0.0), DVec2::new(0.5, 1.0), DVec2::Y], 6, 32);
        for mesh in
            [rounded_box(DVec3::new(1.0, 0.4, 0.7), 0.1, 3), icosphere(2), trefoil(0.42, 0.24, 200, 14), egg]
        {
            assert_oriented(&mesh);
            assert_closed(&mesh);
            // A closed surface that faces outward has positive volume (divergence theorem).
            let volume: f64 =
                mesh.triangles.iter().map(|&t| mesh.area_vector(t).dot(mesh.positions[t[0] as usize])).sum();
            assert!(volume > 0.0);
        }
    }

    #[test]
    fn sizes_are_as_told() {
        let half = DVec3::new(1.0, 0.4, 0.7);
        let mesh = rounded_box(half, 0.1, 3);
        let top = mesh.positions.iter().fold(DVec3::MIN, |a, &b| a.max(b));
        assert!((top - half).length() < 1e-12, "{top}");
        let sphere = icosphere(4);
        assert_eq!((sphere.positions.len(), sphere.triangles.len()), (2562, 5120));
        assert!(sphere.positions.iter().all(|p| (p.length() - 1.0).abs() < 1e-12));
    }

    #[test]
    fn spline_derivative_matches_a_difference_quotient() {
        let control: Vec<DVec2> =
            [(0.0, 0.0), (1.0, 0.2), (1.5, 1.0), (0.3, 2.0), (0.1, 2.5)].map(DVec2::from).to_vec();
        for t in [0.1, 0.5, 0.99, 1.01, 1.7] {
            let h = 1e-6;
            let quotient = (bspline(&control, t + h).0 - bspline(&control, t - h).0) / (2.0 * h);
            assert!((quotient - bspline(&control, t).1).length() < 1e-6, "at {t}");
        }
    }
}
