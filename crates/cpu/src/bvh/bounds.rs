//! Axis-aligned boxes as the builder uses them: two four-lane vectors, of which the fourth lane means nothing.

use glam::{Vec3, Vec4};

/// A box, empty when a minimum lies above its maximum.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) lo: Vec4,
    pub(super) hi: Vec4,
}

impl Bounds {
    /// The box that holds nothing: the neutral element of [`Bounds::union`].
    pub(super) const EMPTY: Bounds = Bounds { lo: Vec4::INFINITY, hi: Vec4::NEG_INFINITY };

    /// The box spanned by two corners.
    #[inline]
    pub(super) fn new(lo: Vec3, hi: Vec3) -> Self {
        Bounds { lo: lo.extend(0.0), hi: hi.extend(0.0) }
    }

    /// The smallest box around both.
    #[inline]
    pub(super) fn union(self, other: Bounds) -> Bounds {
        Bounds { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// The smallest box around this one and a point.
    #[inline]
    pub(super) fn with_point(self, p: Vec4) -> Bounds {
        Bounds { lo: self.lo.min(p), hi: self.hi.max(p) }
    }

    /// Half the surface area; not meant for empty boxes.
    #[inline]
    pub(super) fn half_area(self) -> f32 {
        let d = self.hi - self.lo;
        d.x * d.y + d.y * d.z + d.z * d.x
    }
}
