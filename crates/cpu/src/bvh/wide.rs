//! The wide tree as it is traversed: nodes of eight boxes in structure-of-arrays form.

use super::binary::{BinaryNode, BinaryTree, MAX_DEPTH};
use super::collapse::{Children, WIDTH};

/// Traversal stacks hold this many entries. A node on a path to a leaf leaves at most seven siblings behind, and no path is
/// longer than the binary tree is deep, so that the stack can never overflow. One more for the eighth child of a store
/// that writes all lanes.
pub(super) const STACK: usize = (WIDTH - 1) * (MAX_DEPTH + 1) + WIDTH;

/// A child: an inner node, a leaf, or nothing.
///
/// Bit 31 marks a leaf. In leaves of a mesh bits 28..31 are the number of packets less one and the rest is the first packet;
/// in leaves over instances the low 31 bits are the instance. Inner nodes are their index.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(transparent)]
pub(super) struct Child(pub(super) u32);

impl Child {
    pub(super) const LEAF: u32 = 1 << 31;
    /// Most packets in a leaf.
    pub(super) const MAX_PACKETS: usize = 8;
    /// Most packets in a tree.
    pub(super) const PACKET_LIMIT: usize = 1 << 28;

    pub(super) fn inner(node: usize) -> Child {
        assert!(node < Self::LEAF as usize);
        Child(node as u32)
    }

    pub(super) fn packets(first: usize, count: usize) -> Child {
        assert!(first + count <= Self::PACKET_LIMIT && (1..=Self::MAX_PACKETS).contains(&count));
        Child(Self::LEAF | ((count - 1) as u32) << 28 | first as u32)
    }

    pub(super) fn instance(index: u32) -> Child {
        assert!(index < Self::LEAF);
        Child(Self::LEAF | index)
    }

    #[inline(always)]
    pub(super) fn is_leaf(self) -> bool {
        self.0 & Self::LEAF != 0
    }

    /// First packet and number of packets of a leaf of a mesh.
    #[inline(always)]
    pub(super) fn packet_range(self) -> (usize, usize) {
        ((self.0 & 0x0fff_ffff) as usize, ((self.0 >> 28 & 7) + 1) as usize)
    }

    /// The instance of a leaf over instances.
    #[inline(always)]
    pub(super) fn instance_index(self) -> u32 {
        self.0 & !Self::LEAF
    }
}

/// Rows of [`WideNode::planes`]: the lower planes along x, y, z are rows 0, 2, 4; the upper ones follow each.
pub(super) type Planes = [[f32; WIDTH]; 6];

/// Eight children and their boxes. Unused lanes have boxes turned inside out (+inf to -inf), which no ray enters.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct WideNode {
    pub(super) planes: Planes,
    pub(super) children: [Child; WIDTH],
}

impl WideNode {
    const EMPTY: WideNode = WideNode {
        planes: [
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
        ],
        children: [Child(Child::LEAF); WIDTH],
    };

    fn set(&mut self, lane: usize, node: &BinaryNode) {
        for axis in 0..3 {
            self.planes[2 * axis][lane] = node.lo[axis];
            self.planes[2 * axis + 1][lane] = node.hi[axis];
        }
    }
}

/// Collapses `tree`. `make_leaf` is called once per leaf, in depth-first order, with its range of primitives. Returns the
/// nodes and the root, which is a leaf if the tree is no larger than that.
pub(super) fn collapse(
    tree: &BinaryTree,
    make_leaf: impl FnMut(u32, u32) -> Child,
) -> (Vec<WideNode>, Child) {
    let mut emit = Emit { tree, make_leaf, nodes: Vec::new() };
    let root = emit.child(0, 0);
    (emit.nodes, root)
}

struct Emit<'a, F> {
    tree: &'a BinaryTree,
    make_leaf: F,
    nodes: Vec<WideNode>,
}

impl<F: FnMut(u32, u32) -> Child> Emit<'_, F> {
    fn child(&mut self, node: u32, depth: usize) -> Child {
        assert!(depth <= MAX_DEPTH, "depth {depth}");
        let n = &self.tree.nodes[node as usize];
        if n.forest.is_leaf() {
            return (self.make_leaf)(n.first, n.count);
        }
        let at = self.nodes.len();
        self.nodes.push(WideNode::EMPTY);
        let children = Children::of(&self.tree.nodes, node);
        for (lane, &c) in children.nodes[..children.count].iter().enumerate() {
            let child = self.child(c, depth + 1);
            self.nodes[at].set(lane, &self.tree.nodes[c as usize]);
            self.nodes[at].children[lane] = child;
        }
        Child::inner(at)
    }
}
