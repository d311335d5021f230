//! Instances: transforms of every kind, masks, culling in the world.

use super::*;
use glam::{Mat3, Quat};

fn sources() -> [Mesh; 3] {
    [soup(60, 200, 1.0, 0.3), icosphere(2, |_| 0.7), map(soup(61, 50, 1.0, 0.5), |p| p + 30.0)]
}

fn meshes() -> Vec<Arc<Blas>> {
    sources().iter().map(|m| Arc::new(Blas::build(&m.0, &m.1))).collect()
}

fn transform(random: &mut Random, kind: usize, spread: f32) -> Affine3A {
    let turn = Quat::from_axis_angle(random.direction(), random.range(0.0, 6.0));
    let at = random.point(spread);
    let s = |random: &mut Random| 2f32.powf(random.range(-3.0, 3.0));
    let scale = match kind {
        0 => Vec3::ONE,
        1 => Vec3::splat(s(random)),
        2 => Vec3::new(s(random), s(random), s(random)),
        // Mirrored.
        3 => Vec3::new(-s(random), s(random), s(random)),
        4 => -Vec3::splat(s(random)),
        // Nearly flat: ill-conditioned.
        _ => Vec3::new(1.0, 2f32.powf(random.range(-16.0, -6.0)), 1.0),
    };
    let skew = Mat3::from_cols(Vec3::X, Vec3::new(random.range(-1.0, 1.0), 1.0, 0.0), Vec3::Z);
    Affine3A::from_mat3_translation(Mat3::from_quat(turn) * skew * Mat3::from_diagonal(scale), at)
}

fn rays_in(random: &mut Random, tlas: &Tlas, count: usize, from: f32) -> Vec<Ray> {
    let (lo, hi) = tlas.bounds().expect("not empty");
    let mut within = || lo + (hi - lo) * Vec3::new(random.next(), random.next(), random.next());
    let pairs: Vec<_> = (0..count).map(|_| (within(), within())).collect();
    pairs.into_iter().map(|(a, b)| ray(b + (a - b) * from, b - a)).collect()
}

#[test]
fn all_kinds_of_transforms() {
    for kind in 0..6 {
        let mut random = Random(62 + kind as u32);
        let descs: Vec<_> =
            (0..40).map(|i| InstanceDesc::new(i % 3, transform(&mut random, kind, 6.0))).collect();
        let tlas = Tlas::build(&descs, meshes());
        let sources = sources();
        let mut aim = |mut rays: Vec<Ray>, count: usize| {
            for r in rays.iter_mut() {
                let desc = &descs[random.index(descs.len())];
                let target = desc.object_to_world.transform_point3(random.on(&sources[desc.blas as usize]));
                r.dir = target - r.origin;
            }
            assert_exact(&tlas, rays, count);
        };
        let mut other = Random(90 + kind as u32);
        aim(rays_in(&mut other, &tlas, 1000, 1.0), 800);
        // From afar, where rounding of the origin dominates.
        aim(rays_in(&mut other, &tlas, 500, 1000.0), 200);
    }
}

#[test]
fn transformed_hits_lie_where_they_should() {
    let mut random = Random(70);
    let mesh = icosphere(3, |_| 1.0);
    let blas = vec![Arc::new(Blas::build(&mesh.0, &mesh.1))];
    for kind in 0..5 {
        let to_world = transform(&mut random, kind, 3.0);
        let tlas = Tlas::build(&[InstanceDesc::new(0, to_world)], blas.clone());
        let world: Mesh = map(mesh.clone(), |p| to_world.transform_point3(p));
        let plain = scene(&world);
        let mut compared = 0;
        for r in rays_in(&mut random, &plain, 500, 1.0) {
            let (a, b) = (tlas.closest_hit(&r, |_| true), plain.closest_hit(&r, |_| true));
            // Rounding may tell them apart at silhouettes; where both hit the same triangle they agree.
            if let (Some(a), Some(b)) = (a, b)
                && a.triangle == b.triangle
            {
                let close = |x: f32, y: f32| (x - y).abs() < 2e-3;
                assert!(close(a.t, b.t) && close(a.b1, b.b1) && close(a.b2, b.b2), "{a:?} {b:?}");
                compared += 1;
            }
        }
        assert!(compared > 200, "{compared}");
    }
}

#[test]
fn singular_and_broken_transforms_are_skipped() {
    let m = |x: f32, y: f32, z: f32| Affine3A::from_scale(Vec3::new(x, y, z));
    let mut broken = Affine3A::IDENTITY;
    broken.translation.y = f32::NAN;
    let mut far = Affine3A::IDENTITY;
    far.translation.y = 1e30;
    let flat = Affine3A::from_mat3(Mat3::from_cols(Vec3::X, Vec3::X, Vec3::Z));
    let good = Affine3A::from_translation(Vec3::Z);
    let all = [m(1.0, 0.0, 1.0), m(0.0, 0.0, 0.0), broken, far, flat, m(f32::INFINITY, 1.0, 1.0), good];
    let descs: Vec<_> = all.iter().map(|&t| InstanceDesc::new(1, t)).collect();
    let tlas = Tlas::build(&descs, meshes());
    let hit = tlas.closest_hit(&ray(Vec3::new(0.01, 0.02, 5.0), Vec3::NEG_Z), |_| true);
    assert_eq!(hit.map(|h| h.instance), Some(6), "ids count those skipped");
    let rays = rays_in(&mut Random(71), &tlas, 300, 1.0);
    assert_exact(&tlas, rays, 100);
    assert_eq!(Tlas::build(&descs[..6], meshes()).bounds(), None);
}

#[test]
fn masks_select_instances() {
    let at = |z: f32, mask: u32| InstanceDesc {
        mask,
        ..InstanceDesc::new(1, Affine3A::from_translation(Vec3::new(0.0, 0.0, z)))
    };
    let tlas = Tlas::build(&[at(0.0, 1), at(2.0, 2), at(4.0, 6), at(6.0, 0)], meshes());
    let r = ray(Vec3::new(0.02, 0.01, 9.0), Vec3::NEG_Z);
    let instance = |mask| tlas.closest_hit_masked(&r, mask, |_| true).map(|h| h.instance);
    assert_eq!(instance(u32::MAX), Some(2), "a mask of zero is never seen");
    assert_eq!(instance(1), Some(0));
    assert_eq!(instance(2), Some(2));
    assert_eq!(instance(4), Some(2));
    assert_eq!(instance(8), None);
    assert!(tlas.any_hit_masked(&r, 1, |_| true) && !tlas.any_hit_masked(&r, 8, |_| true));
    assert_eq!(bits(&tlas.closest_hit_brute(&r, |_| true)), bits(&tlas.closest_hit(&r, |_| true)));
}

#[test]
fn many_instances_in_one_place() {
    let descs: Vec<_> = (0..5000).map(|_| InstanceDesc::new(1, Affine3A::IDENTITY)).collect();
    let tlas = Tlas::build(&descs, meshes());
    let hit = tlas.closest_hit(&ray(Vec3::new(0.01, 0.02, 5.0), Vec3::NEG_Z), |_| true);
    assert_eq!(hit.map(|h| h.instance), Some(0));
}

#[test]
fn update_moves_instances() {
    let at = |z: f32| InstanceDesc::new(1, Affine3A::from_translation(Vec3::new(0.0, 0.0, z)));
    let mut tlas = Tlas::build(&[at(0.0)], meshes()).with_level(SimdLevel::Portable);
    let r = ray(Vec3::new(0.02, 0.01, 9.0), Vec3::NEG_Z);
    let before = tlas.closest_hit(&r, |_| true).expect("a hit").t;
    tlas.update(&[at(-3.0), at(-1.0)]);
    let after = tlas.closest_hit(&r, |_| true).expect("a hit");
    assert!((after.t - before - 1.0).abs() < 1e-5 && after.instance == 1);
    assert_eq!(tlas.level(), SimdLevel::Portable);
}
