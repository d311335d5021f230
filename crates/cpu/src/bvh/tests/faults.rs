//! The comparison with the plain loop notices faults planted in the tree.

use super::super::query::Closest;
use super::super::ray::TravRay;
use super::super::simd::portable::Portable;
use super::super::wide::Child;
use super::*;

/// A sphere full of rays at vertices and edges, whose tree `spoil` may damage; returns how many queries went wrong.
fn wrong_with(spoil: impl FnOnce(&mut Blas)) -> usize {
    let mesh = icosphere(3, |_| 1.0);
    let mut blas = Blas::build(&mesh.0, &mesh.1);
    spoil(&mut blas);
    let tlas = Tlas::build(&[InstanceDesc::new(0, Affine3A::IDENTITY)], vec![Arc::new(blas)]);
    let mut random = Random(80);
    let rays: Vec<Ray> = (0..3000)
        .map(|i| {
            let origin = random.point(0.5);
            let target = mesh.0[random.index(mesh.0.len())];
            ray(origin, if i % 2 == 0 { target - origin } else { random.direction() })
        })
        .collect();
    differences(&tlas, rays)
}

#[test]
fn a_sound_tree_passes() {
    assert_eq!(wrong_with(|_| ()), 0);
}

#[test]
fn boxes_too_small_by_a_hundred_thousandth_are_noticed() {
    let shrink = |blas: &mut Blas| {
        for node in &mut blas.nodes {
            for (row, plane) in node.planes.iter_mut().enumerate() {
                let inwards = if row % 2 == 0 { 1e-5 } else { -1e-5 };
                plane.iter_mut().for_each(|p| *p += inwards);
            }
        }
    };
    assert!(wrong_with(shrink) > 0);
}

#[test]
fn one_box_too_small_is_noticed() {
    let shrink = |blas: &mut Blas| {
        let node = blas.nodes.last_mut().expect("a node");
        for axis in 0..3 {
            let (lo, hi) = (node.planes[2 * axis][0], node.planes[2 * axis + 1][0]);
            node.planes[2 * axis][0] = lo + 0.4 * (hi - lo);
            node.planes[2 * axis + 1][0] = hi - 0.4 * (hi - lo);
        }
    };
    assert!(wrong_with(shrink) > 0);
}

#[test]
fn a_lost_child_is_noticed() {
    let lose = |blas: &mut Blas| {
        let node = blas.nodes.last_mut().expect("a node");
        node.planes[0][0] = f32::INFINITY;
        node.planes[1][0] = f32::NEG_INFINITY;
    };
    assert!(wrong_with(lose) > 0);
}

#[test]
fn a_leaf_without_its_second_packet_is_noticed() {
    let cut = |blas: &mut Blas| {
        let mut children = blas.nodes.iter_mut().flat_map(|n| &mut n.children);
        let child = children.find(|c| c.is_leaf() && c.packet_range().1 > 1);
        let child = child.expect("a leaf of two packets");
        *child = Child::packets(child.packet_range().0, 1);
    };
    assert!(wrong_with(cut) > 0);
}

/// Rays that run along the faces of a needle's box, traced with the margins of `TravRay` or with none; returns how many
/// closest hits differ from the plain loop.
fn wrong_along_needles(margins: bool) -> usize {
    let mesh = needles(81, 400);
    let blas = Blas::build(&mesh.0, &mesh.1);
    let tlas = scene(&mesh);
    let mut random = Random(82);
    let mut wrong = 0;
    for _ in 0..20_000 {
        let [a, b, c] = mesh.1[random.index(mesh.1.len())].map(|i| mesh.0[i as usize]);
        let origin = random.point(2.0);
        let r = ray(origin, [a, b, c, a.lerp(b, random.next())][random.index(4)] - origin);
        let mut trav = TravRay::new(r.origin, r.dir, r.t_min, &blas.bounds, 0.0).expect("in the domain");
        if !margins {
            for axis in 0..3 {
                trav.near[axis] = trav.origin[axis] * trav.rdir[axis];
                trav.far[axis] = trav.near[axis];
            }
        }
        let mut query = Closest::new(r.t_max, |_: &Hit| true);
        let mut t_best = r.t_max;
        // SAFETY: the portable level needs nothing.
        unsafe { blas.trace::<Portable, _>(&trav, &mut t_best, (0, true), &mut query) };
        wrong += usize::from(bits(&query.into_hit()) != bits(&tlas.closest_hit_brute(&r, |_| true)));
    }
    wrong
}

#[test]
fn the_margins_of_boxes_are_needed_and_enough() {
    assert_eq!(wrong_along_needles(true), 0);
    let without = wrong_along_needles(false);
    assert!(without > 10, "{without}");
}
