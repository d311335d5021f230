//! Rays at the edge of what arithmetic can do, ties, and filters.

use super::*;

#[test]
fn axis_parallel_rays_with_zeros_of_both_signs() {
    let mesh = soup(50, 1500, 1.0, 0.2);
    let tlas = scene(&mesh);
    let mut random = Random(51);
    let mut all = Vec::new();
    for _ in 0..700 {
        let p = random.point(1.0);
        for axis in 0..3 {
            for zeros in [[0.0, 0.0], [-0.0, 0.0], [-0.0, -0.0], [1e-30, -1e-42]] {
                let mut dir = Vec3::ZERO;
                dir[axis] = if random.next() < 0.5 { 1.0 } else { -1.0 };
                dir[(axis + 1) % 3] = zeros[0];
                dir[(axis + 2) % 3] = zeros[1];
                all.push(ray(p, dir));
            }
        }
    }
    assert_exact(&tlas, all, 4000);
}

#[test]
fn axis_parallel_rays_in_the_planes_of_boxes() {
    // A cube: rays within its faces, along its edges, and on its surface.
    let corner = |i: u32| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2 & 1) as f32);
    let positions: Vec<Vec3> = (0..8).map(corner).collect();
    let quad = |a: u32, b: u32, c: u32, d: u32| [[a, b, c], [a, c, d]];
    let triangles = [
        quad(0, 1, 3, 2),
        quad(4, 5, 7, 6),
        quad(0, 1, 5, 4),
        quad(2, 3, 7, 6),
        quad(0, 2, 6, 4),
        quad(1, 3, 7, 5),
    ]
    .concat();
    let tlas = scene(&(positions.clone(), triangles));
    let mut all = Vec::new();
    for &p in &positions {
        for &q in &positions {
            for s in [0.0, 0.25, 0.5, 1.0] {
                let p = p.lerp(q, s);
                all.extend([Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z].map(|d| ray(p - d, d)));
                all.extend([Vec3::X, Vec3::NEG_Z, Vec3::ONE].map(|d| ray(p, d)));
            }
        }
    }
    assert_exact(&tlas, all, 500);
}

#[test]
fn rays_that_start_on_a_surface() {
    let mesh = soup(52, 600, 1.0, 0.4);
    let tlas = scene(&mesh);
    let mut random = Random(53);
    let mut all = Vec::new();
    for _ in 0..2000 {
        let p = random.on(&mesh);
        let a = mesh.0[random.index(mesh.0.len())];
        all.push(ray(p, random.direction()));
        all.push(Ray { t_min: 1e-4, ..ray(p, random.direction()) });
        all.push(ray(a, random.direction()));
    }
    assert_exact(&tlas, all, 2000);
    // Exactly on it, `t` is 0 and does not count.
    let flat = scene(&grid(4, 0.0));
    for dir in [Vec3::Z, Vec3::new(0.3, 0.1, -1.0)] {
        assert!(flat.closest_hit(&ray(Vec3::new(0.3, 0.1, 0.0), dir), |_| true).is_none());
    }
}

#[test]
fn rays_outside_of_the_domain_hit_nothing() {
    let tlas = scene(&grid(4, 0.0));
    let down = Vec3::NEG_Z;
    let fine = ray(Vec3::new(0.1, 0.1, 1.0), down);
    for level in at_all_levels(&tlas) {
        assert!(level.closest_hit(&fine, |_| true).is_some());
        let strange = [
            ray(Vec3::new(f32::NAN, 0.0, 1.0), down),
            ray(Vec3::new(0.0, f32::INFINITY, 1.0), down),
            ray(fine.origin, Vec3::ZERO),
            ray(fine.origin, Vec3::new(0.0, f32::NAN, -1.0)),
            ray(fine.origin, Vec3::new(0.0, 0.0, f32::NEG_INFINITY)),
            ray(Vec3::new(0.0, 0.0, 1e30), down),
            Ray { t_min: f32::NAN, t_max: -1.0, ..fine },
            Ray { t_max: f32::NAN, ..fine },
            Ray { t_max: 0.0, ..fine },
            Ray { t_max: -1.0, ..fine },
            Ray { t_min: f32::INFINITY, ..fine },
        ];
        for r in strange {
            assert!(level.closest_hit(&r, |_| true).is_none(), "{r:?}");
            assert!(!level.any_hit(&r, |_| true), "{r:?}");
        }
        let behind = Ray { t_min: -5.0, ..ray(Vec3::new(0.1, 0.1, -1.0), down) };
        assert!(level.closest_hit(&behind, |_| true).is_none(), "t_min below zero counts as zero");
    }
}

#[test]
fn directions_of_any_length_scale_t() {
    let mesh = soup(54, 400, 1.0, 0.3);
    let tlas = scene(&mesh);
    let mut random = Random(55);
    for _ in 0..500 {
        let r = ray(random.point(1.5), random.direction());
        let unit = tlas.closest_hit(&r, |_| true);
        for exponent in [-20, -3, 4, 25] {
            let scale = 2f32.powi(exponent);
            let hit = tlas.closest_hit(&Ray { dir: r.dir * scale, ..r }, |_| true);
            let back = hit.map(|h| Hit { t: h.t * scale, ..h });
            assert_eq!(bits(&back), bits(&unit), "powers of two change no digit");
        }
    }
}

#[test]
fn ties_go_to_the_smallest_instance_and_triangle() {
    // The same grid in reverse order of triangles, three times in place: all hits tie six times over.
    let (positions, mut triangles) = grid(8, 0.0);
    triangles.extend(triangles.clone());
    let mesh = Arc::new(Blas::build(&positions, &triangles));
    let blas = vec![mesh.clone(), mesh];
    let place = |blas| InstanceDesc::new(blas, Affine3A::IDENTITY);
    let tlas = Tlas::build(&[place(1), place(0), place(1)], blas);
    let mut random = Random(56);
    let mut all = Vec::new();
    for _ in 0..500 {
        let target = random.point(0.99) * Vec3::new(1.0, 1.0, 0.0);
        let origin = random.point(2.0) + 3.0 * Vec3::Z;
        all.push(ray(origin, target - origin));
    }
    for r in &all {
        let hit = tlas.closest_hit(r, |_| true).expect("on the grid");
        assert_eq!(hit.instance, 0);
        assert!((hit.triangle as usize) < triangles.len() / 2, "{hit:?}");
        // Among those refused, the next in order.
        let next = tlas_refusing(&tlas, r, hit);
        assert_eq!((next.instance, next.triangle), (0, hit.triangle + triangles.len() as u32 / 2));
        assert_eq!(next.t.to_bits(), hit.t.to_bits());
    }
    assert_exact(&tlas, all, 500);
}

/// The closest hit of the same scene, not opaque, but for one hit.
fn tlas_refusing(tlas: &Tlas, r: &Ray, refused: Hit) -> Hit {
    let mut copy = tlas.clone();
    let desc = |blas| InstanceDesc { opaque: false, ..InstanceDesc::new(blas, Affine3A::IDENTITY) };
    copy.update(&[desc(1), desc(0), desc(1)]);
    let other = |h: &Hit| (h.instance, h.triangle) != (refused.instance, refused.triangle);
    copy.closest_hit(r, other).expect("there are more")
}

#[test]
fn filters_are_asked_where_not_opaque_and_decide() {
    let mesh = soup(57, 900, 1.0, 0.3);
    let blas = vec![Arc::new(Blas::build(&mesh.0, &mesh.1))];
    let shift = Affine3A::from_translation(Vec3::new(0.05, 0.02, -0.03));
    let see_through = InstanceDesc { opaque: false, ..InstanceDesc::new(0, Affine3A::IDENTITY) };
    let tlas = Tlas::build(&[see_through, InstanceDesc::new(0, shift)], blas);
    // Keeps a fraction by a hash of the triangle, as stochastic alpha does.
    let kept = |h: &Hit| {
        assert_eq!(h.instance, 0, "the opaque instance is not asked about");
        hash_combine(7, h.triangle).is_multiple_of(5)
    };
    let mut random = Random(58);
    let (mut of_first, mut of_second, mut different) = (0, 0, 0);
    for _ in 0..2000 {
        let origin = random.point(1.5);
        let r = ray(origin, random.on(&mesh) - origin);
        let expected = tlas.closest_hit_brute(&r, kept);
        let unfiltered = tlas.closest_hit_brute(&r, |_| true);
        different += usize::from(bits(&expected) != bits(&unfiltered));
        for level in at_all_levels(&tlas) {
            let hit = level.closest_hit(&r, kept);
            assert_eq!(bits(&hit), bits(&expected));
            assert_eq!(level.any_hit(&r, kept), expected.is_some());
            if let Some(hit) = hit {
                of_first += usize::from(hit.instance == 0);
                of_second += usize::from(hit.instance == 1);
            }
        }
    }
    assert!(of_first > 500 && of_second > 2000 && different > 500, "{of_first} {of_second} {different}");
}

#[test]
fn levels_have_names() {
    for level in SimdLevel::ALL {
        assert_eq!(SimdLevel::parse(level.name()), Some(level));
    }
    assert_eq!(SimdLevel::parse("sse9"), None);
    assert_eq!(SimdLevel::parse(""), None);
    assert!(SimdLevel::Portable.is_supported() && SimdLevel::best().is_supported());
    let error = super::super::UnknownSimdLevel("sse9".into()).to_string();
    assert!(error.contains("LUMBRE_SIMD") && error.contains("sse9") && error.contains("avx512"), "{error}");
}
