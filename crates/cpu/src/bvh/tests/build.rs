//! The builder: determinism, awkward input, quality.

use super::super::collapse::WIDTH;
use super::super::wide::Child;
use super::*;

fn build_with(threads: usize, (positions, triangles): &Mesh) -> Blas {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    pool.install(|| Blas::build(positions, triangles))
}

/// Everything in the tree, as bits.
fn dump(blas: &Blas) -> Vec<u32> {
    let mut out = vec![blas.root.map_or(0, |r| r.0)];
    for node in &blas.nodes {
        out.extend(node.planes.iter().flatten().map(|x| x.to_bits()));
        out.extend(node.children.iter().map(|c| c.0));
    }
    for packet in &blas.packets {
        out.extend(packet.rows.iter().flatten().map(|x| x.to_bits()));
        out.extend(packet.ids);
    }
    out
}

#[test]
fn the_tree_does_not_depend_on_threads() {
    // Large enough for parallel binning, parallel subtrees and parallel packets.
    let mesh = soup(20, 150_000, 1.0, 0.01);
    let one = dump(&build_with(1, &mesh));
    assert_eq!(one, dump(&build_with(2, &mesh)));
    assert_eq!(one, dump(&build_with(5, &mesh)));
    let other = soup(21, 150_000, 1.0, 0.01);
    assert_ne!(one, dump(&build_with(1, &other)), "the dump tells trees apart");
}

/// Walks the tree, checks that boxes hold what is below them and that every triangle occurs in exactly one leaf; returns the
/// depth of nodes.
fn check_tree(blas: &Blas) -> usize {
    fn visit(blas: &Blas, child: Child, lo: Vec3, hi: Vec3, seen: &mut Vec<u32>) -> usize {
        if child.is_leaf() {
            let (first, count) = child.packet_range();
            for packet in &blas.packets[first..first + count] {
                for lane in 0..packet.ids.len() {
                    for v in 0..3 {
                        let p = Vec3::from_array([0, 1, 2].map(|axis| packet.rows[3 * v + axis][lane]));
                        assert!(p.cmpge(lo).all() && p.cmple(hi).all(), "{p} outside {lo} {hi}");
                    }
                }
                let mut ids = packet.ids.to_vec();
                ids.dedup();
                seen.extend(ids);
            }
            return 0;
        }
        let node = &blas.nodes[child.0 as usize];
        let mut depth = 0;
        for lane in 0..WIDTH {
            let corner = |side: usize| Vec3::from_array([0, 1, 2].map(|a| node.planes[2 * a + side][lane]));
            let (l, h) = (corner(0), corner(1));
            if l.x > h.x {
                continue;
            }
            assert!(l.cmpge(lo).all() && h.cmple(hi).all());
            depth = depth.max(visit(blas, node.children[lane], l, h, seen));
        }
        depth + 1
    }
    let Some((lo, hi)) = blas.bounds() else { return 0 };
    let mut seen = Vec::new();
    let depth = visit(blas, blas.root.expect("bounds, hence a root"), lo, hi, &mut seen);
    let count = seen.len();
    seen.sort_unstable();
    seen.dedup();
    assert_eq!((seen.len(), count), (blas.triangle_count(), blas.triangle_count()));
    depth
}

#[test]
fn every_triangle_has_its_leaf() {
    for (seed, count) in [(22, 1), (23, 4), (24, 5), (25, 8), (26, 9), (27, 64), (28, 5000)] {
        let (positions, triangles) = soup(seed, count, 1.0, 0.2);
        let blas = Blas::build(&positions, &triangles);
        assert_eq!(blas.triangle_count(), count);
        check_tree(&blas);
    }
}

#[test]
fn coincident_triangles_and_centres() {
    // The same triangle many times, and triangles of many sizes around one centre.
    let count = 20_000u32;
    let corners = [Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, -1.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
    let same: Mesh = (corners.to_vec(), vec![[0, 1, 2]; count as usize]);
    let blas = Blas::build(&same.0, &same.1);
    assert!(check_tree(&blas) <= 16);
    let hit = scene(&same).closest_hit(&ray(Vec3::new(0.1, 0.0, 3.0), Vec3::NEG_Z), |_| true);
    assert_eq!(hit.map(|h| h.triangle), Some(0), "the first of all those that coincide");

    let nested: Mesh = (
        (0..count).flat_map(|i| corners.map(|c| c * (1.0 + i as f32 * 1e-3))).collect(),
        (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
    );
    assert!(check_tree(&Blas::build(&nested.0, &nested.1)) <= 24);
}

#[test]
fn depth_is_bounded_for_triangles_in_geometric_progression() {
    // Each triangle is twice the size and distance of the one before: the heuristic splits off one at a time.
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for i in 0..100u32 {
        let s = 2f32.powi(i as i32 - 45);
        positions.extend([Vec3::splat(s), Vec3::new(2.0 * s, s, s), Vec3::new(s, 2.0 * s, s)]);
        triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let mesh = (positions, triangles);
    assert!(check_tree(&Blas::build(&mesh.0, &mesh.1)) <= super::super::binary::MAX_DEPTH);
    let mut random = Random(29);
    let rays = (0..300).map(|_| {
        let p = mesh.0[random.index(mesh.0.len())];
        ray(p * random.range(-1.0, 2.0), random.direction())
    });
    assert_eq!(differences(&scene(&mesh), rays), 0);
}

#[test]
fn triangles_that_cannot_be_hit_are_left_out() {
    let ok = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let p = |x: f32| Vec3::new(x, 0.5, 0.0);
    let positions = [
        ok.to_vec(),
        vec![p(f32::NAN), p(f32::INFINITY), p(f32::NEG_INFINITY), p(2e18), p(3.0), p(4.0), p(5.0)],
    ]
    .concat();
    let triangles = [[0, 1, 3], [0, 4, 1], [5, 0, 1], [0, 6, 1], [0, 0, 1], [2, 2, 2], [7, 8, 9], [0, 1, 2]];
    let mesh = (positions, triangles.to_vec());
    let blas = Blas::build(&mesh.0, &mesh.1);
    assert_eq!(blas.triangle_count(), 1);
    let hit = scene(&mesh).closest_hit(&ray(Vec3::new(0.2, 0.2, 1.0), Vec3::NEG_Z), |_| true);
    assert_eq!(hit.map(|h| (h.triangle, h.t)), Some((7, 1.0)));
}

#[test]
fn nothing_at_all() {
    for mesh in [(vec![], vec![]), (vec![Vec3::ZERO; 3], vec![[0, 1, 2]; 5])] {
        let tlas = scene(&mesh);
        assert_eq!(tlas.bounds(), None);
        for level in at_all_levels(&tlas) {
            assert!(level.closest_hit(&ray(Vec3::ZERO, Vec3::Z), |_| true).is_none());
            assert!(!level.any_hit(&ray(Vec3::ZERO, Vec3::Z), |_| true));
        }
    }
    let empty = Tlas::build(&[], vec![]);
    assert!(empty.closest_hit(&ray(Vec3::ZERO, Vec3::Z), |_| true).is_none());
}

#[test]
#[should_panic(expected = "instance 1: mesh 3 of 1")]
fn an_instance_of_no_mesh_is_a_bug() {
    let desc = |blas| InstanceDesc::new(blas, Affine3A::IDENTITY);
    Tlas::build(&[desc(0), desc(3)], vec![Arc::new(Blas::build(&[], &[]))]);
}
