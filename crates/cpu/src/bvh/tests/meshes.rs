//! Meshes to trace.

use super::{Mesh, Random};
use glam::Vec3;
use std::collections::HashMap;

/// Unconnected triangles of about `size` in the cube of half edge `spread`.
pub(super) fn soup(seed: u32, count: usize, spread: f32, size: f32) -> Mesh {
    let mut random = Random(seed);
    let mut positions = Vec::new();
    for _ in 0..count {
        let centre = random.point(spread);
        positions.extend((0..3).map(|_| centre + random.point(size)));
    }
    (positions, (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect())
}

/// Needles: as long as the cube, as thin as rounding allows.
pub(super) fn needles(seed: u32, count: usize) -> Mesh {
    let mut random = Random(seed);
    let mut positions = Vec::new();
    for _ in 0..count {
        let (from, along) = (random.point(1.0), random.direction() * random.range(0.5, 4.0));
        let width = 10f32.powf(random.range(-8.0, -2.0));
        positions.extend([from, from + along, from + along * random.next() + random.direction() * width]);
    }
    (positions, (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect())
}

/// A closed surface: an icosahedron divided `levels` times, each vertex moved to `radius` of its direction.
pub(super) fn icosphere(levels: u32, radius: impl Fn(Vec3) -> f32) -> Mesh {
    let g = (1.0 + 5f32.sqrt()) / 2.0;
    let mut positions = Vec::new();
    for (a, b) in [(-1.0, g), (1.0, g), (-1.0, -g), (1.0, -g)] {
        positions.extend([Vec3::new(a, b, 0.0), Vec3::new(0.0, a, b), Vec3::new(b, 0.0, a)]);
    }
    // All faces: triples of mutual neighbours, at distance 2.
    let near = |a: usize, b: usize| (positions[a] - positions[b]).length() < 2.1;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(a, c) {
                    triangles.push([a as u32, b as u32, c as u32]);
                }
            }
        }
    }
    assert_eq!(triangles.len(), 20);
    for _ in 0..levels {
        let mut middles = HashMap::new();
        let mut middle = |a: u32, b: u32, positions: &mut Vec<Vec3>| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                positions.push((positions[a as usize] + positions[b as usize]) * 0.5);
                positions.len() as u32 - 1
            })
        };
        let mut finer = Vec::with_capacity(4 * triangles.len());
        for &[a, b, c] in &triangles {
            let ab = middle(a, b, &mut positions);
            let bc = middle(b, c, &mut positions);
            let ca = middle(c, a, &mut positions);
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    for p in &mut positions {
        let d = p.normalize();
        *p = d * radius(d);
    }
    (positions, triangles)
}

/// The square from -1 to 1 at `z`, of `n` by `n` cells of two triangles each: all vertices and edges fall on round numbers.
pub(super) fn grid(n: u32, z: f32) -> Mesh {
    let at = |i: u32| i as f32 / n as f32 * 2.0 - 1.0;
    let positions = (0..=n).flat_map(|y| (0..=n).map(move |x| Vec3::new(at(x), at(y), z))).collect();
    let mut triangles = Vec::new();
    for y in 0..n {
        for x in 0..n {
            let i = y * (n + 1) + x;
            triangles.extend([[i, i + 1, i + n + 2], [i, i + n + 2, i + n + 1]]);
        }
    }
    (positions, triangles)
}

pub(super) fn map((positions, triangles): Mesh, f: impl Fn(Vec3) -> Vec3) -> Mesh {
    (positions.into_iter().map(f).collect(), triangles)
}
