//! The collapse of a binary tree into nodes of eight children that minimises the surface area cost: dynamic programming
//! over "this subtree as a forest of at most i roots" (Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal
//! on GPUs Through Compressed Wide BVHs", section 3.1), here for a SIMD width of eight on the CPU.

use super::binary::BinaryNode;

/// Children of a wide node.
pub(super) const WIDTH: usize = 8;

/// The cheapest ways to hang a subtree into a wide node.
///
/// `cost[i - 1]` is the cost as at most `i` children, for `i` in 1..=7; one visit of a wide node with half area 1 costs 1.
#[derive(Clone, Copy, Default)]
pub(super) struct Forest {
    cost: [f32; WIDTH - 1],
    /// `split[i - 1]`: how many of the `i` children go to the left subtree, or 0 if fewer than `i` children are cheaper.
    /// `split[7]` is the distribution of the eight children if the subtree becomes a wide node itself.
    split: [u8; WIDTH],
    /// As one child: a leaf rather than a wide node.
    leaf: bool,
}

impl Forest {
    /// A subtree that cannot be divided.
    pub(super) fn leaf(cost: f32) -> Forest {
        Forest { cost: [cost; WIDTH - 1], split: [0; WIDTH], leaf: true }
    }

    /// A subtree of two halves with half area `area`; `leaf_cost` is infinite where a leaf is not allowed.
    pub(super) fn merge(left: &Forest, right: &Forest, area: f32, leaf_cost: f32) -> Forest {
        let mut forest = Forest::default();
        let distribute = |children: usize| {
            let mut best = (f32::INFINITY, 1);
            for l in 1..children {
                let cost = left.cost[l - 1] + right.cost[children - l - 1];
                if cost < best.0 {
                    best = (cost, l as u8);
                }
            }
            best
        };
        let (inner, split) = distribute(WIDTH);
        let node_cost = inner + area;
        forest.leaf = leaf_cost <= node_cost && leaf_cost < f32::INFINITY;
        forest.cost[0] = leaf_cost.min(node_cost);
        forest.split[WIDTH - 1] = split;
        for children in 2..WIDTH {
            let (cost, split) = distribute(children);
            let fewer = forest.cost[children - 2];
            let better = cost < fewer;
            forest.cost[children - 1] = if better { cost } else { fewer };
            forest.split[children - 1] = if better { split } else { 0 };
        }
        forest
    }

    /// Whether the subtree, as one child, is a leaf.
    pub(super) fn is_leaf(&self) -> bool {
        self.leaf
    }
}

/// The children of the wide node that stands for the inner binary node `node`: indices of binary nodes.
pub(super) struct Children {
    pub(super) nodes: [u32; WIDTH],
    pub(super) count: usize,
}

impl Children {
    /// Follows the decisions stored in the tree.
    pub(super) fn of(nodes: &[BinaryNode], node: u32) -> Children {
        let mut out = Children { nodes: [0; WIDTH], count: 0 };
        let n = &nodes[node as usize];
        let left = n.forest.split[WIDTH - 1] as usize;
        out.gather(nodes, node + 1, left);
        out.gather(nodes, node + n.right, WIDTH - left);
        out
    }

    fn gather(&mut self, nodes: &[BinaryNode], node: u32, children: usize) {
        let n = &nodes[node as usize];
        // A forest of `children` roots that is no better than one of fewer falls back to that one.
        let used = (2..=children.min(WIDTH - 1)).rev().find(|&i| n.forest.split[i - 1] != 0);
        match used {
            Some(used) => {
                let left = n.forest.split[used - 1] as usize;
                self.gather(nodes, node + 1, left);
                self.gather(nodes, node + n.right, used - left);
            }
            None => {
                self.nodes[self.count] = node;
                self.count += 1;
            }
        }
    }
}
