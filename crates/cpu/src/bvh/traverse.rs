//! The traversal of a wide tree, front to back, with a stack of nodes yet to visit that is culled by distance.
//!
//! One walk serves both tree levels and both kinds of query; it is inlined into functions compiled for each SIMD level.

use super::simd::{Near, Simd, prefetch};
use super::wide::{Child, STACK, WideNode};
use std::mem::MaybeUninit;

/// Nodes yet to visit. An entry holds the bits of the entry distance above the child: distances are never negative, so
/// that entries compare as they do.
struct Stack {
    entries: [MaybeUninit<u64>; STACK],
    len: usize,
}

#[inline(always)]
fn entry(distance: f32, child: Child) -> u64 {
    u64::from(distance.to_bits()) << 32 | u64::from(child.0)
}

impl Stack {
    #[inline(always)]
    fn new() -> Self {
        Stack { entries: [const { MaybeUninit::uninit() }; STACK], len: 0 }
    }

    #[inline(always)]
    fn push(&mut self, e: u64) {
        debug_assert!(self.len < STACK);
        // SAFETY: `STACK` bounds what a walk can leave behind (see there), and trees are built no deeper than it assumes.
        unsafe { self.entries.get_unchecked_mut(self.len) }.write(e);
        self.len += 1;
    }

    /// The last entry that begins no farther than `t_best`.
    #[inline(always)]
    fn pop(&mut self, t_best: f32) -> Option<Child> {
        while self.len > 0 {
            self.len -= 1;
            // SAFETY: below `len` all entries were written.
            let e = unsafe { self.entries.get_unchecked(self.len).assume_init() };
            if f32::from_bits((e >> 32) as u32) <= t_best {
                return Some(Child(e as u32));
            }
        }
        None
    }

    /// Sorts the entries from `base` on, the nearest last.
    #[inline(always)]
    fn sort_from(&mut self, base: usize) {
        // SAFETY: below `len` all entries were written, and `u64` has the layout of `MaybeUninit<u64>`.
        let top = unsafe {
            std::slice::from_raw_parts_mut(self.entries.as_mut_ptr().add(base).cast::<u64>(), self.len - base)
        };
        for i in 1..top.len() {
            let e = top[i];
            let mut j = i;
            while j > 0 && top[j - 1] < e {
                top[j] = top[j - 1];
                j -= 1;
            }
            top[j] = e;
        }
    }
}

/// What to do at a leaf. Not a closure: those cannot be forced inline, and outside of the functions compiled for a SIMD
/// level its kernels would be calls.
pub(super) trait Leaf {
    /// Where the data of a leaf lies, to have it brought into the cache early.
    fn address(&self, child: Child) -> *const u8;

    /// May lower `t_best`, the distance up to which hits count; true ends the walk.
    ///
    /// # Safety
    /// `child` is a leaf of the tree that the implementation knows, and the processor supports its SIMD level.
    unsafe fn visit(&mut self, child: Child, t_best: &mut f32) -> bool;
}

/// Where an inner node lies.
#[inline(always)]
fn address(nodes: &[WideNode], child: Child) -> *const u8 {
    nodes.as_ptr().wrapping_add(child.0 as usize).cast()
}

/// Visits the leaves that the ray may enter up to `t_best`, the nearest boxes first, until one returns true. With `ANY` the
/// order is not kept up: it does not pay if the first hit ends the walk.
///
/// # Safety
/// The processor must support `S`; `nodes` and `root` must come from one call of [`super::wide::collapse`].
#[inline(always)]
pub(super) unsafe fn walk<S: Simd, const ANY: bool>(
    nodes: &[WideNode],
    root: Child,
    ray: &S::Ray,
    t_best: &mut f32,
    leaf: &mut impl Leaf,
) {
    let mut stack = Stack::new();
    let mut near = Near([0.0; 8]);
    let mut current = root;
    loop {
        // Descend to a leaf.
        while !current.is_leaf() {
            debug_assert!((current.0 as usize) < nodes.len());
            // SAFETY: inner children index the nodes of their tree; the caller vouches for the level.
            let node = unsafe { nodes.get_unchecked(current.0 as usize) };
            let mut mask = unsafe { S::boxes(node, ray, *t_best, &mut near) };
            if mask == 0 {
                match stack.pop(*t_best) {
                    Some(child) => current = child,
                    None => return,
                }
                continue;
            }
            let mut take = || {
                let lane = mask.trailing_zeros() as usize & 7;
                mask &= mask - 1;
                let child = node.children[lane];
                prefetch(if child.is_leaf() { leaf.address(child) } else { address(nodes, child) });
                (entry(near.0[lane], child), mask)
            };
            let (first, rest) = take();
            if rest == 0 {
                current = Child(first as u32);
                continue;
            }
            let (second, mut rest) = take();
            if rest == 0 {
                let (closer, farther) = if first <= second { (first, second) } else { (second, first) };
                stack.push(farther);
                current = Child(closer as u32);
                continue;
            }
            let base = stack.len;
            stack.push(first);
            stack.push(second);
            while rest != 0 {
                let next;
                (next, rest) = take();
                stack.push(next);
            }
            if !ANY {
                stack.sort_from(base);
            }
            stack.len -= 1;
            // SAFETY: just pushed.
            current = Child(unsafe { stack.entries.get_unchecked(stack.len).assume_init() } as u32);
        }
        // SAFETY: a leaf of this tree; the caller vouches for the level.
        if unsafe { leaf.visit(current, t_best) } {
            return;
        }
        match stack.pop(*t_best) {
            Some(child) => current = child,
            None => return,
        }
    }
}
