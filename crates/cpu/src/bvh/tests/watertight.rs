//! No ray slips between triangles that share edges: from inside a closed surface every ray hits.

use super::*;

/// Traces `count` rays from inside: half in random directions, half exactly at vertices and points of edges.
fn misses(mesh: &Mesh, inside: f32, count: usize, seed: u32) -> usize {
    let tlas = scene(mesh);
    let levels = at_all_levels(&tlas);
    let mut random = Random(seed);
    let mut missed = 0;
    for i in 0..count {
        let origin = random.direction() * inside * random.next();
        let [a, b, _] = mesh.1[random.index(mesh.1.len())].map(|i| mesh.0[i as usize]);
        let dir = match i % 4 {
            0 | 1 => random.direction(),
            2 => a - origin,
            _ => a + (b - a) * [0.5, random.next()][i / 4 % 2] - origin,
        };
        // The levels take turns: that they agree is tested elsewhere.
        let level = &levels[i / 4 % levels.len()];
        missed += usize::from(level.closest_hit(&ray(origin, dir), |_| true).is_none());
        missed += usize::from(!level.any_hit(&ray(origin, dir), |_| true));
    }
    missed
}

#[test]
fn no_ray_leaves_a_sphere() {
    assert_eq!(misses(&icosphere(5, |_| 1.0), 0.99, 600_000, 40), 0);
}

#[test]
fn no_ray_leaves_a_crumpled_ball() {
    let wave = |x: f32| lumbre_core::math::sin_cos(x).0;
    let bumps = |d: Vec3| 1.0 + 0.1 * wave(17.0 * d.x) * wave(13.0 * d.y + 5.0 * d.z);
    assert_eq!(misses(&icosphere(6, bumps), 0.8, 600_000, 41), 0);
}

#[test]
fn no_ray_leaves_a_coarse_ball_far_from_zero() {
    // Here the grid of floats is coarse against the triangles: vertices are shared, so nothing may open.
    let (positions, triangles) = icosphere(4, |_| 1.0);
    let shift = Vec3::new(4096.0, -2048.0, 1024.0);
    let mesh = (positions.iter().map(|p| *p + shift).collect(), triangles);
    let tlas = scene(&mesh);
    let mut random = Random(42);
    for i in 0..100_000 {
        let origin = shift + random.direction() * 0.9 * random.next();
        let target = mesh.0[random.index(mesh.0.len())];
        let dir = if i % 2 == 0 { random.direction() } else { target - origin };
        assert!(tlas.closest_hit(&ray(origin, dir), |_| true).is_some(), "{origin} {dir}");
    }
}

#[test]
fn a_missing_triangle_is_noticed() {
    let mut mesh = icosphere(3, |_| 1.0);
    mesh.1.swap_remove(77);
    assert!(misses(&mesh, 0.9, 40_000, 43) > 0);
}
