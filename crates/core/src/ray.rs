//! Rays, and how their origins leave a surface.

use crate::math::Vec3;

/// A ray segment. `dir` need not be unit in object space; `t` is in units of `dir`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin, metres.
    pub origin: Vec3,
    /// Direction; unit in world space.
    pub dir: Vec3,
    /// Nearest distance that counts.
    pub t_min: f32,
    /// Farthest distance that counts.
    pub t_max: f32,
    /// Moment in the shutter interval, 0 to 1.
    pub time: f32,
}

impl Ray {
    /// A ray without an end.
    #[inline]
    pub fn new(origin: Vec3, dir: Vec3, time: f32) -> Self {
        Ray { origin, dir, t_min: 0.0, t_max: f32::INFINITY, time }
    }
    /// The point at distance `t`.
    #[inline]
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.dir * t
    }
}

/// Share of a triangle's extent by which rays start off it: the error of a hit's distance is a few units in the last place of
/// the distances of its vertices, whatever the distance of the hit itself.
const EXTENT_SCALE: f32 = 1.0 / 1_048_576.0;

/// Moves `p` off its surface to the side that `towards` points to: by a few units in the last place of `p`, so that the step
/// fits every scale, and by a millionth of the triangle's size. `ng` is the geometric normal, `extent` the largest distance
/// from `p` to a vertex of its triangle (along an axis is near enough), metres.
///
/// Wächter and Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems, ch. 6; the share of the
/// extent is ours, for triangles much larger than their distance.
#[inline]
pub fn offset_ray_origin(p: Vec3, ng: Vec3, towards: Vec3, extent: f32) -> Vec3 {
    const ORIGIN: f32 = 1.0 / 32.0;
    const FLOAT_SCALE: f32 = 1.0 / 65536.0;
    const INT_SCALE: f32 = 256.0;
    let n = if ng.dot(towards) < 0.0 { -ng } else { ng };
    let p = p + n * (extent * EXTENT_SCALE);
    let step = |p: f32, n: f32| {
        if p.abs() < ORIGIN {
            return p + FLOAT_SCALE * n;
        }
        let i = (INT_SCALE * n) as i32;
        f32::from_bits((p.to_bits() as i32).wrapping_add(if p < 0.0 { -i } else { i }) as u32)
    };
    Vec3::new(step(p.x, n.x), step(p.y, n.y), step(p.z, n.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offset_moves_to_the_asked_side_at_every_scale() {
        for scale in [1e-3f32, 1.0, 1e3, 1e6] {
            let n = Vec3::new(0.48, -0.6, 0.64);
            let p = Vec3::new(0.7, -1.3, 0.2) * scale;
            assert!((offset_ray_origin(p, n, n, 0.0) - p).dot(n) > 0.0);
            assert!((offset_ray_origin(p, n, -n, 0.0) - p).dot(n) < 0.0);
            assert!((offset_ray_origin(p, n, n, scale) - p).length() < 1e-4 * scale.max(1.0));
        }
    }
}
