//! What a traversal needs of a ray: slabs widened so that no box is ever missed, and the shear of the triangle test.
//!
//! # Why no hit is ever culled
//! Let `u = 2^-24` be half the spacing of floats at 1, `R` the largest coordinate distance from the origin to a corner of
//! the tree's box, and a triangle *hit* if [`super::triangle`] says so, at the `t` it says. That test treats the triangle
//! as if its vertices were moved by at most `6 u R` along the two minor axes of the ray (rounding of `v - o`, of the
//! shear and of its product), and its `t` differs from the exact one by at most `4 u R / |d_max|`. So along each axis the
//! point of the ray at `t` lies within `10 u R` of a point of the triangle, which lies in every box around it.
//!
//! A slab distance is computed as `p * r - c`, `r = 1 / d`, with or without a fused product. Its rounding is that of a
//! plane moved by at most `3 u R + 3 u |o|`. Moving the planes outwards by `16 u R + 4 u |o|` therefore makes the interval
//! of each box contain the `t` of every hit inside, and `near <= t` and `t <= far` hold exactly as computed. This is the
//! robust traversal of Ize 2013 ("Robust BVH Ray Traversal", JCGT 2(2)) with the margin in space rather than in `t`, so
//! that it also covers the rounding of the triangle test. It costs no instruction: it is part of `c`.
//!
//! A direction component below `2^-32` of the largest one is replaced by that bound, which moves the ray by less than
//! `2^-30 R` inside the box: no zero, infinity or NaN arises. The bounds of the domain below keep all of this from
//! overflowing.

use super::bounds::Bounds;
use glam::Vec3;

/// Largest magnitude of a coordinate, 2^60 m (about 120 light years): beyond, products of the triangle test overflow.
pub(super) const MAX_COORDINATE: f32 = (1u64 << 60) as f32;
/// Length of the direction's largest component: rays in object space are not unit.
const DIR_RANGE: std::ops::RangeInclusive<f32> = 1.0 / (1u64 << 32) as f32..=(1u64 << 32) as f32;
/// Components are not taken smaller than this part of the largest one.
const MIN_SLOPE: f32 = 1.0 / (1u64 << 32) as f32;
/// `16 u`.
const PAD_RADIUS: f32 = 1.0 / (1u64 << 20) as f32;
/// `4 u`.
const PAD_ORIGIN: f32 = 1.0 / (1u64 << 22) as f32;
/// Covers rounding towards zero of the tiniest scenes.
const PAD_MIN: f32 = 1e-30;

/// A ray made ready for one tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct TravRay {
    pub(super) origin: [f32; 3],
    /// Reciprocal direction.
    pub(super) rdir: [f32; 3],
    /// `origin * rdir`, plus the margin for the near planes.
    pub(super) near: [f32; 3],
    /// `origin * rdir`, less the margin for the far planes.
    pub(super) far: [f32; 3],
    /// Rows of the near planes in [`super::wide::Planes`]; the far ones are these with the lowest bit flipped.
    pub(super) near_row: [usize; 3],
    /// Never negative.
    pub(super) t_min: f32,
    /// Axes of the sheared frame; the last is the one along which the direction is longest.
    pub(super) axes: [usize; 3],
    /// Shear along the first two axes, and reciprocal of the direction along the last.
    pub(super) shear: [f32; 3],
}

impl TravRay {
    /// `None` if the ray lies outside of the domain (not finite, zero direction, beyond [`MAX_COORDINATE`]): it hits nothing.
    /// `margin` is added to the margin of the boxes.
    #[inline(always)]
    pub(super) fn new(origin: Vec3, dir: Vec3, t_min: f32, bounds: &Bounds, margin: f32) -> Option<TravRay> {
        let abs = dir.abs();
        let longest = abs.max_element();
        let far_off = origin.abs().max_element();
        if !(dir.is_finite()
            && origin.is_finite()
            && DIR_RANGE.contains(&longest)
            && far_off <= MAX_COORDINATE)
        {
            return None;
        }
        let reach = (bounds.lo.truncate() - origin).abs().max((bounds.hi.truncate() - origin).abs());
        let pad = PAD_RADIUS * reach.max_element() + PAD_ORIGIN * far_off + PAD_MIN + margin;
        let slope = abs.max(Vec3::splat(MIN_SLOPE * longest)).copysign(dir);
        let rdir = slope.recip();
        let c = origin * rdir;
        let pad_t = rdir.abs() * pad;
        let z = if abs.x == longest {
            0
        } else if abs.y == longest {
            1
        } else {
            2
        };
        let (x, y) = ((1 << z) & 3, (1 << ((1 << z) & 3)) & 3);
        let row = |axis: usize| 2 * axis + dir[axis].is_sign_negative() as usize;
        Some(TravRay {
            origin: origin.to_array(),
            rdir: rdir.to_array(),
            near: (c + pad_t).to_array(),
            far: (c - pad_t).to_array(),
            near_row: [row(0), row(1), row(2)],
            t_min: t_min.max(0.0) + 0.0,
            axes: [x, y, z],
            shear: [dir[x] / dir[z], dir[y] / dir[z], 1.0 / dir[z]],
        })
    }
}
