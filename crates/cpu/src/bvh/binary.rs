//! The binary tree under the wide one: top-down, binned surface area heuristic (Wald 2007, "On fast Construction of
//! SAH-based Bounding Volume Hierarchies"), parallel over subtrees and, near the root, over primitives.
//!
//! The tree is a function of the primitives in their given order only. Threads never change it: bins are merged by
//! minimum, maximum and integer sums, which are exact and commute, and each subtree owns its slice of primitives and nodes.
//!
//! On the way back up each node also gets the cheapest costs of being drawn as a forest of up to seven wide-node children
//! (see `collapse`), so that this work is parallel too.

use super::bounds::Bounds;
use super::collapse::Forest;
use glam::{Vec3, Vec4};
use rayon::prelude::*;

/// The most primitives a tree may hold: ids have 28 bits in [`Prim`].
pub(super) const MAX_PRIMS: usize = 1 << 28;
/// Depth from which on nodes are halved by count, whatever the heuristic says, so that depth stays below [`MAX_DEPTH`].
const SAH_DEPTH: u32 = 40;
/// No leaf lies deeper: below [`SAH_DEPTH`] a range of at most 2^28 primitives is halved until one is left.
pub(super) const MAX_DEPTH: usize = SAH_DEPTH as usize + 29;
/// Most bins per axis.
const MAX_BINS: usize = 32;
/// Subtrees at least this large are built as tasks of their own.
const TASK_PRIMS: usize = 2048;
/// Nodes at least this large are binned in parallel pieces of this size.
const BIN_CHUNK: usize = 32 * 1024;
/// Set in the id lane so that its bits are an ordinary float, on which vector arithmetic is never slow.
const ID_TAG: u32 = 0x4000_0000;

/// A primitive to the builder: its box, and its id in the spare lane of `hi`.
#[derive(Clone, Copy)]
pub(super) struct Prim {
    lo: Vec4,
    hi: Vec4,
}

impl Prim {
    /// A primitive with finite bounds and an id below [`MAX_PRIMS`].
    pub(super) fn new(lo: Vec3, hi: Vec3, id: u32) -> Self {
        debug_assert!((id as usize) < MAX_PRIMS);
        Prim { lo: lo.extend(0.0), hi: hi.extend(f32::from_bits(id | ID_TAG)) }
    }

    /// The id given to [`Prim::new`].
    #[inline]
    pub(super) fn id(&self) -> u32 {
        self.hi.w.to_bits() & !ID_TAG
    }

    #[inline]
    fn bounds(&self) -> Bounds {
        Bounds { lo: self.lo, hi: self.hi }
    }

    /// Twice the centre of the box.
    #[inline]
    fn centre2(&self) -> Vec4 {
        self.lo + self.hi
    }
}

/// A node of the binary tree. Its left child, if any, is the next node in the array.
#[derive(Clone, Copy, Default)]
pub(super) struct BinaryNode {
    pub(super) lo: [f32; 3],
    /// First primitive of the subtree.
    pub(super) first: u32,
    pub(super) hi: [f32; 3],
    /// Primitives of the subtree.
    pub(super) count: u32,
    /// Distance to the right child in the array; 0 for a leaf.
    pub(super) right: u32,
    /// The costs of this subtree as children of a wide node.
    pub(super) forest: Forest,
}

/// What the tree is for.
#[derive(Clone, Copy)]
pub(super) struct BuildParams {
    /// Primitives tested at once: a leaf costs one unit per started block, and ranges that fit in one are not split.
    pub(super) block: usize,
    /// Most blocks in a leaf of the wide tree.
    pub(super) max_leaf_blocks: usize,
    /// Cost of one block, in units of one visit of a wide node.
    pub(super) block_cost: f32,
}

impl BuildParams {
    #[inline]
    fn blocks(&self, count: u32) -> f32 {
        (count as usize).div_ceil(self.block) as f32
    }
}

/// The finished tree: `nodes[0]` is the root, and leaves index ranges of the reordered `prims`.
pub(super) struct BinaryTree {
    pub(super) nodes: Vec<BinaryNode>,
    pub(super) prims: Vec<Prim>,
}

impl BinaryTree {
    /// Builds the tree; `None` if there are no primitives.
    pub(super) fn build(mut prims: Vec<Prim>, params: BuildParams) -> Option<BinaryTree> {
        assert!(prims.len() <= MAX_PRIMS, "{} primitives, the limit is {MAX_PRIMS}", prims.len());
        if prims.is_empty() {
            return None;
        }
        let (bounds, centres) = prims
            .par_chunks(BIN_CHUNK)
            .map(extent)
            .reduce(|| (Bounds::EMPTY, Bounds::EMPTY), |a, b| (a.0.union(b.0), a.1.union(b.1)));
        let mut nodes = vec![BinaryNode::default(); 2 * prims.len() - 1];
        let range = Range { prims: &mut prims, nodes: &mut nodes, first: 0, bounds, centres, depth: 0 };
        range.build(&params);
        Some(BinaryTree { nodes, prims })
    }
}

fn extent(prims: &[Prim]) -> (Bounds, Bounds) {
    prims
        .iter()
        .fold((Bounds::EMPTY, Bounds::EMPTY), |(b, c), p| (b.union(p.bounds()), c.with_point(p.centre2())))
}

/// A subtree to be built: its primitives and the `2 n - 1` nodes it may use, of which the first is its root.
struct Range<'a> {
    prims: &'a mut [Prim],
    nodes: &'a mut [BinaryNode],
    first: u32,
    bounds: Bounds,
    centres: Bounds,
    depth: u32,
}

impl Range<'_> {
    fn build(mut self, params: &BuildParams) {
        let count = self.prims.len();
        let mut node = BinaryNode {
            lo: self.bounds.lo.truncate().to_array(),
            first: self.first,
            hi: self.bounds.hi.truncate().to_array(),
            count: count as u32,
            right: 0,
            forest: Forest::default(),
        };
        let area = self.bounds.half_area();
        let leaf_cost = area * params.blocks(count as u32) * params.block_cost;
        if count <= params.block {
            node.forest = Forest::leaf(leaf_cost);
            self.nodes[0] = node;
            return;
        }
        let (left, right) = self.split(params);
        let (at, both) = (left.count, left.count >= TASK_PRIMS && right.count >= TASK_PRIMS);
        let (first, depth) = (self.first, self.depth + 1);
        let (left_prims, right_prims) = self.prims.split_at_mut(at);
        let (root, rest) = self.nodes.split_at_mut(1);
        let (left_nodes, right_nodes) = rest.split_at_mut(2 * at - 1);
        let l = Range { prims: left_prims, nodes: left_nodes, first, ..left.range(depth) };
        let r =
            Range { prims: right_prims, nodes: right_nodes, first: first + at as u32, ..right.range(depth) };
        if both {
            rayon::join(|| l.build(params), || r.build(params));
        } else {
            l.build(params);
            r.build(params);
        }
        node.right = 2 * at as u32;
        let can_be_leaf = count <= params.block * params.max_leaf_blocks;
        node.forest = Forest::merge(
            &rest[0].forest,
            &rest[2 * at - 1].forest,
            area,
            if can_be_leaf { leaf_cost } else { f32::INFINITY },
        );
        root[0] = node;
    }

    /// Reorders the primitives into a left and a right part.
    fn split(&mut self, params: &BuildParams) -> (Part, Part) {
        if self.depth < SAH_DEPTH {
            let grid = Grid::new(self.prims.len(), self.centres);
            if let Some((axis, bin)) = grid.best_split(self.prims, params) {
                return partition(self.prims, |p| grid.bin(p, axis) < bin);
            }
        }
        let (left, right) = self.prims.split_at(self.prims.len() / 2);
        (Part::of(left), Part::of(right))
    }
}

/// One side of a split.
struct Part {
    count: usize,
    bounds: Bounds,
    centres: Bounds,
}

impl Part {
    fn of(prims: &[Prim]) -> Part {
        let (bounds, centres) = extent(prims);
        Part { count: prims.len(), bounds, centres }
    }

    fn range<'a>(&self, depth: u32) -> Range<'a> {
        let (bounds, centres) = (self.bounds, self.centres);
        Range { prims: &mut [], nodes: &mut [], first: 0, bounds, centres, depth }
    }
}

/// Moves the primitives that `is_left` accepts to the front, and measures both parts on the way.
fn partition(prims: &mut [Prim], is_left: impl Fn(&Prim) -> bool) -> (Part, Part) {
    let (mut i, mut j) = (0, prims.len());
    let mut left = (Bounds::EMPTY, Bounds::EMPTY);
    let mut right = left;
    let add = |e: &mut (Bounds, Bounds), p: &Prim| {
        e.0 = e.0.union(p.bounds());
        e.1 = e.1.with_point(p.centre2());
    };
    loop {
        while i < j && is_left(&prims[i]) {
            add(&mut left, &prims[i]);
            i += 1;
        }
        while i < j && !is_left(&prims[j - 1]) {
            j -= 1;
            add(&mut right, &prims[j]);
        }
        if i == j {
            break;
        }
        prims.swap(i, j - 1);
    }
    let n = prims.len();
    (
        Part { count: i, bounds: left.0, centres: left.1 },
        Part { count: n - i, bounds: right.0, centres: right.1 },
    )
}

/// The bins of one node: equal slices of the box of centres along each axis.
struct Grid {
    bins: usize,
    origin: Vec4,
    scale: Vec4,
}

/// What fell into each bin, per axis.
#[derive(Clone)]
struct Bins {
    bounds: [[Bounds; MAX_BINS]; 3],
    counts: [[u32; MAX_BINS]; 3],
}

impl Grid {
    fn new(count: usize, centres: Bounds) -> Grid {
        let bins = (4 + count / 16).min(MAX_BINS);
        let extent = centres.hi - centres.lo;
        // Centres are rounded to the nearest of `bins` planes: the first and last bin are half as wide.
        let scale = Vec4::splat((bins - 1) as f32) / extent;
        // Along an axis without extent all centres fall into bin 0, which offers no split.
        let usable = extent.cmpgt(Vec4::splat(1e-30)) & scale.cmplt(Vec4::splat(f32::MAX));
        Grid { bins, origin: centres.lo, scale: Vec4::select(usable, scale, Vec4::ZERO) }
    }

    /// 2^23: added to a float in [0, 2^22) it leaves the nearest integer in the low bits of the mantissa, a conversion that
    /// vectorises everywhere. Binning and partition share it, so that they always agree.
    const ROUND: f32 = 8_388_608.0;

    #[inline]
    fn bin_all(&self, p: &Prim) -> [usize; 3] {
        let f = (p.centre2() - self.origin) * self.scale + Vec4::splat(Self::ROUND);
        let bin = |x: f32| (x.to_bits() & (MAX_BINS as u32 - 1)) as usize;
        [bin(f.x), bin(f.y), bin(f.z)]
    }

    #[inline]
    fn bin(&self, p: &Prim, axis: usize) -> usize {
        self.bin_all(p)[axis]
    }

    fn fill(&self, prims: &[Prim]) -> Bins {
        let mut bins = Bins { bounds: [[Bounds::EMPTY; MAX_BINS]; 3], counts: [[0; MAX_BINS]; 3] };
        for p in prims {
            let b = p.bounds();
            for (axis, bin) in self.bin_all(p).into_iter().enumerate() {
                let slot = &mut bins.bounds[axis][bin];
                *slot = slot.union(b);
                bins.counts[axis][bin] += 1;
            }
        }
        bins
    }

    /// The cheapest split, as (axis, first bin of the right side); `None` if all centres share a bin on every axis.
    fn best_split(&self, prims: &[Prim], params: &BuildParams) -> Option<(usize, usize)> {
        let bins = if prims.len() >= 2 * BIN_CHUNK {
            let merge = |mut a: Bins, b: Bins| {
                for axis in 0..3 {
                    for i in 0..self.bins {
                        a.bounds[axis][i] = a.bounds[axis][i].union(b.bounds[axis][i]);
                        a.counts[axis][i] += b.counts[axis][i];
                    }
                }
                a
            };
            prims.par_chunks(BIN_CHUNK).map(|c| self.fill(c)).reduce_with(merge)?
        } else {
            self.fill(prims)
        };
        let mut best = (f32::INFINITY, None);
        for axis in 0..3 {
            if self.scale[axis] > 0.0 {
                self.sweep(axis, &bins, params, &mut best);
            }
        }
        best.1
    }

    fn sweep(
        &self,
        axis: usize,
        bins: &Bins,
        params: &BuildParams,
        best: &mut (f32, Option<(usize, usize)>),
    ) {
        let (bounds, counts) = (&bins.bounds[axis], &bins.counts[axis]);
        let mut right_cost = [0.0f32; MAX_BINS];
        let (mut acc, mut n) = (Bounds::EMPTY, 0);
        for i in (1..self.bins).rev() {
            acc = acc.union(bounds[i]);
            n += counts[i];
            right_cost[i] = if n > 0 { acc.half_area() * params.blocks(n) } else { f32::INFINITY };
        }
        (acc, n) = (Bounds::EMPTY, 0);
        for i in 1..self.bins {
            acc = acc.union(bounds[i - 1]);
            n += counts[i - 1];
            if n > 0 {
                let cost = acc.half_area() * params.blocks(n) + right_cost[i];
                if cost < best.0 {
                    *best = (cost, Some((axis, i)));
                }
            }
        }
    }
}
