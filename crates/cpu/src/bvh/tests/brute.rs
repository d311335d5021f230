//! Every hit equals that of the loop over all triangles, in every bit, at every SIMD level.

use super::*;

fn rays(seed: u32, count: usize, from: f32) -> Vec<Ray> {
    let mut random = Random(seed);
    (0..count).map(|_| ray(random.point(from), random.direction())).collect()
}

/// Rays from random points, every other one aimed at a point of a triangle.
fn aimed(seed: u32, count: usize, mesh: &Mesh, from: f32) -> Vec<Ray> {
    let mut random = Random(seed);
    let mut all = rays(seed, count, from);
    for r in all.iter_mut().step_by(2) {
        r.dir = random.on(mesh) - r.origin;
    }
    all
}

/// Rays that graze what they are aimed at: from random points to and along edges and vertices.
fn rays_at_edges(seed: u32, count: usize, (positions, triangles): &Mesh, from: f32) -> Vec<Ray> {
    let mut random = Random(seed);
    let mut out = Vec::new();
    for _ in 0..count {
        let [a, b, c] = triangles[random.index(triangles.len())].map(|i| positions[i as usize]);
        let origin = random.point(from);
        let on_edge = a + (b - a) * random.next();
        let targets = [a, on_edge, a + (b - a) * 0.5, (a + b + c) / 3.0];
        out.extend(targets.map(|p| ray(origin, p - origin)));
        // In the plane of the triangle, and starting on it.
        out.push(ray(a - (b - a) * random.range(0.0, 4.0), b - a));
        out.push(ray(on_edge - (c - a) * 2.0, c - a));
        out.push(ray(on_edge, random.direction()));
    }
    out.retain(|r| r.dir.length_squared() > 0.0);
    out
}

#[test]
fn random_soups() {
    for (seed, count, size) in [(1, 1, 0.5), (2, 5, 0.5), (3, 33, 0.5), (4, 700, 0.2), (5, 3000, 0.05)] {
        let mesh = soup(seed, count, 1.0, size);
        assert_exact(&scene(&mesh), aimed(100 + seed, 2000, &mesh, 1.5), 1000);
    }
}

#[test]
fn overlapping_large_triangles() {
    let mesh = soup(6, 500, 0.1, 3.0);
    assert_exact(&scene(&mesh), aimed(106, 1000, &mesh, 3.0), 700);
}

#[test]
fn needles_and_grazing_rays() {
    let mesh = needles(7, 600);
    let tlas = scene(&mesh);
    assert_exact(&tlas, rays_at_edges(107, 500, &mesh, 2.0), 500);
}

#[test]
fn needles_seen_from_afar_where_rounding_is_coarse() {
    let mesh = map(needles(8, 300), |p| p + Vec3::new(1000.0, -3000.0, 500.0));
    let tlas = scene(&mesh);
    assert_exact(&tlas, rays_at_edges(108, 300, &mesh, 10_000.0), 100);
}

#[test]
fn rays_through_edges_and_vertices() {
    let mesh = soup(9, 1000, 1.0, 0.3);
    assert_exact(&scene(&mesh), rays_at_edges(109, 500, &mesh, 2.0), 2000);
    let mesh = icosphere(3, |_| 1.0);
    assert_exact(&scene(&mesh), rays_at_edges(110, 500, &mesh, 2.0), 2000);
}

#[test]
fn flat_meshes_on_round_numbers() {
    // Boxes without thickness, planes of nodes that coincide with edges, and rays exactly on them.
    let mesh = grid(16, 0.25);
    let tlas = scene(&mesh);
    let mut all = Vec::new();
    let mut random = Random(111);
    for i in 0..3000 {
        let target = mesh.0[random.index(mesh.0.len())];
        let origin = match i % 4 {
            0 => Vec3::new(target.x, target.y, 2.0),
            1 => Vec3::new(target.x, -3.0, target.z),
            2 => mesh.0[random.index(mesh.0.len())],
            _ => random.point(2.0),
        };
        if origin != target {
            all.push(ray(origin, target - origin));
        }
    }
    assert_exact(&tlas, all, 1000);
}

#[test]
fn scales_from_tiny_to_huge() {
    for exponent in [-60, -40, -20, -10, 10, 30, 50] {
        let scale = 2f32.powi(exponent);
        let unit = soup(10, 300, 1.0, 0.3);
        let mut all = aimed(112, 500, &unit, 1.5);
        all.extend(rays_at_edges(113, 200, &unit, 2.0));
        let mesh = map(unit, |p| p * scale);
        for r in &mut all {
            r.origin *= scale;
        }
        assert_exact(&scene(&mesh), all, 500);
    }
}

#[test]
fn intervals_cut_where_the_hit_is() {
    // An interval that begins or ends exactly at a hit excludes it; one float farther includes it.
    let mesh = soup(11, 800, 1.0, 0.3);
    let tlas = scene(&mesh);
    let mut all = Vec::new();
    for r in aimed(114, 1500, &mesh, 1.5) {
        if let Some(hit) = tlas.closest_hit(&r, |_| true) {
            all.extend([
                Ray { t_max: hit.t, ..r },
                Ray { t_max: hit.t.next_up(), ..r },
                Ray { t_min: hit.t, ..r },
                Ray { t_min: hit.t.next_down(), ..r },
                Ray { t_min: hit.t.next_down(), t_max: hit.t.next_up(), ..r },
                Ray { t_min: hit.t, t_max: hit.t, ..r },
            ]);
            let none = tlas.closest_hit(&Ray { t_max: hit.t, ..r }, |_| true);
            assert!(none.is_none(), "{none:?} before {hit:?}");
            let same =
                tlas.closest_hit(&Ray { t_min: hit.t.next_down(), t_max: hit.t.next_up(), ..r }, |_| true);
            assert_eq!(bits(&same), bits(&Some(hit)));
            let later = tlas.closest_hit(&Ray { t_min: hit.t, ..r }, |_| true);
            assert!(later.is_none_or(|l| l.t > hit.t));
        }
    }
    assert_exact(&tlas, all, 1000);
}

#[test]
fn barycentric_coordinates_lead_to_the_point() {
    let mesh = soup(12, 500, 1.0, 0.5);
    let tlas = scene(&mesh);
    let mut worst = 0f32;
    for r in aimed(115, 2000, &mesh, 1.5) {
        let Some(hit) = tlas.closest_hit(&r, |_| true) else { continue };
        let [a, b, c] = mesh.1[hit.triangle as usize].map(|i| mesh.0[i as usize]);
        let p = a * (1.0 - hit.b1 - hit.b2) + b * hit.b1 + c * hit.b2;
        worst = worst.max((p - r.at(hit.t)).length());
    }
    // Six roundings of coordinates up to 3.
    assert!(worst > 0.0 && worst < 2e-6, "{worst}");
}
