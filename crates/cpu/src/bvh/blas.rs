//! The lower level: the triangles of one mesh, in its own space.

use super::Hit;
use super::binary::{BinaryTree, BuildParams, MAX_PRIMS, Prim};
use super::bounds::Bounds;
use super::query::Query;
use super::ray::{MAX_COORDINATE, TravRay};
use super::simd::Simd;
use super::traverse::{Leaf, walk};
use super::triangle::{self, LANES, Packet, Sheared};
use super::wide::{Child, WideNode, collapse};
use glam::Vec3;
use rayon::prelude::*;

const PARAMS: BuildParams = BuildParams { block: LANES, max_leaf_blocks: 2, block_cost: 1.0 };

/// The tree over one mesh. It holds its own copy of the vertices.
#[derive(Clone, Debug)]
pub struct Blas {
    pub(super) nodes: Vec<WideNode>,
    pub(super) packets: Vec<Packet>,
    pub(super) root: Option<Child>,
    pub(super) bounds: Bounds,
    triangles: usize,
}

impl Blas {
    /// Builds the tree over `triangles`, which index `positions`; a hit names a triangle by its place in `triangles`.
    ///
    /// Triangles that cannot be hit are left out: those without area, and those with a coordinate that is not finite or
    /// beyond 2^60 in magnitude. Uses the current rayon pool; the result does not depend on its size.
    ///
    /// # Panics
    /// If an index is out of range, or there are more than 2^28 triangles.
    pub fn build(positions: &[Vec3], triangles: &[[u32; 3]]) -> Blas {
        assert!(triangles.len() <= MAX_PRIMS, "{} triangles, the limit is {MAX_PRIMS}", triangles.len());
        let vertices = |id: u32| triangles[id as usize].map(|i| positions[i as usize]);
        let prims: Vec<Prim> = (0..triangles.len() as u32)
            .into_par_iter()
            .with_min_len(4096)
            .filter_map(|id| {
                let [a, b, c] = vertices(id);
                let (lo, hi) = (a.min(b).min(c), a.max(b).max(c));
                can_be_hit([a, b, c]).then(|| Prim::new(lo, hi, id))
            })
            .collect();
        let Some(tree) = BinaryTree::build(prims, PARAMS) else {
            return Blas {
                nodes: Vec::new(),
                packets: Vec::new(),
                root: None,
                bounds: Bounds::EMPTY,
                triangles: 0,
            };
        };
        let mut ranges: Vec<(u32, u32)> = Vec::with_capacity(tree.prims.len() / 2);
        let (nodes, root) = collapse(&tree, |first, count| {
            let packet = ranges.len();
            ranges.extend((0..count).step_by(LANES).map(|i| (first + i, (count - i).min(LANES as u32))));
            Child::packets(packet, ranges.len() - packet)
        });
        let packets = ranges
            .par_iter()
            .with_min_len(1024)
            .map(|&(first, count)| {
                let prims = &tree.prims[first as usize..(first + count) as usize];
                Packet::new(prims.iter().map(|p| (p.id(), vertices(p.id()))))
            })
            .collect();
        let top = &tree.nodes[0];
        let bounds = Bounds::new(Vec3::from_array(top.lo), Vec3::from_array(top.hi));
        Blas { nodes, packets, root: Some(root), bounds, triangles: tree.prims.len() }
    }

    /// The box around all triangles that can be hit; `None` if there are none.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        self.root.map(|_| (self.bounds.lo.truncate(), self.bounds.hi.truncate()))
    }

    /// How many triangles can be hit.
    pub fn triangle_count(&self) -> usize {
        self.triangles
    }

    /// Memory held, in bytes.
    pub fn memory(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.packets[..])
    }

    /// Offers `query` the triangles that the ray hits with `t_min < t <= t_best`, roughly front to back.
    ///
    /// # Safety
    /// The processor must support `S`.
    #[inline(always)]
    pub(super) unsafe fn trace<S: Simd, Q: Query>(
        &self,
        ray: &TravRay,
        t_best: &mut f32,
        (instance, opaque): (u32, bool),
        query: &mut Q,
    ) -> bool {
        let Some(root) = self.root else { return false };
        // SAFETY: the caller vouches for the level, and the tree is as it was built.
        unsafe {
            let wide = S::ray(ray);
            let mut leaf = TriangleLeaf::<S, Q> {
                packets: &self.packets,
                ray: &wide,
                t_min: ray.t_min,
                instance,
                opaque,
                query,
                ended: false,
            };
            walk::<S>(&self.nodes, root, &wide, t_best, &mut leaf);
            leaf.ended
        }
    }

    /// As [`Blas::trace`] without a tree: every triangle in turn.
    pub(super) fn trace_brute<Q: Query>(
        &self,
        ray: &TravRay,
        t_best: &mut f32,
        (instance, opaque): (u32, bool),
        query: &mut Q,
    ) -> bool {
        let mut sheared: Sheared = [[0.0; LANES]; 9];
        for packet in &self.packets {
            triangle::filter(packet, ray, f32::INFINITY, &mut sheared);
            for lane in 0..LANES {
                if offer((packet, &sheared, lane), ray.t_min, t_best, (instance, opaque), query) {
                    return true;
                }
            }
        }
        false
    }
}

/// The packets at a leaf.
struct TriangleLeaf<'a, S: Simd, Q> {
    packets: &'a [Packet],
    ray: &'a S::Ray,
    t_min: f32,
    instance: u32,
    opaque: bool,
    query: &'a mut Q,
    ended: bool,
}

impl<S: Simd, Q: Query> Leaf for TriangleLeaf<'_, S, Q> {
    #[inline(always)]
    fn address(&self, child: Child) -> *const u8 {
        self.packets.as_ptr().wrapping_add(child.packet_range().0).cast()
    }

    #[inline(always)]
    unsafe fn visit(&mut self, child: Child, t_best: &mut f32) -> bool {
        let (first, count) = child.packet_range();
        debug_assert!(first + count <= self.packets.len());
        let mut sheared: Sheared = [[0.0; LANES]; 9];
        // SAFETY: leaves index the packets built with them.
        for packet in unsafe { self.packets.get_unchecked(first..first + count) } {
            // SAFETY: the caller vouches for the level.
            let mut mask = unsafe { S::triangles(packet, self.ray, *t_best, &mut sheared) };
            while mask != 0 {
                let lane = mask.trailing_zeros() as usize & (LANES - 1);
                mask &= mask - 1;
                let of = (self.instance, self.opaque);
                if offer((packet, &sheared, lane), self.t_min, t_best, of, self.query) {
                    self.ended = true;
                    return true;
                }
            }
        }
        false
    }
}

/// Offers `query` the triangle in a lane if the ray hits it with `t_min < t <= t_best`; true when it has enough.
#[inline(always)]
fn offer<Q: Query>(
    (packet, sheared, lane): (&Packet, &Sheared, usize),
    t_min: f32,
    t_best: &mut f32,
    (instance, opaque): (u32, bool),
    query: &mut Q,
) -> bool {
    // Without a closure, which the compiler would call.
    let Some(hit) = triangle::finish(sheared, lane) else { return false };
    hit.t > t_min
        && hit.t <= *t_best
        && query.offer(Hit::new(instance, packet.ids[lane], hit), opaque, t_best)
}

fn can_be_hit([a, b, c]: [Vec3; 3]) -> bool {
    // Comparisons with NaN are false.
    let inside = [a, b, c].iter().all(|p| p.abs().cmple(Vec3::splat(MAX_COORDINATE)).all());
    let (a, b, c) = (a.as_dvec3(), b.as_dvec3(), c.as_dvec3());
    inside && (b - a).cross(c - a) != glam::DVec3::ZERO
}
