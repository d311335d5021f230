//! Cameras: from a place in the picture to a ray.

use crate::math::{Affine3A, Vec3, tan};
use crate::ray::Ray;
use crate::warp::concentric_disk;

/// A perspective camera with a thin lens, in world space. It looks along -z of its frame, +y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Eye, metres.
    pub origin: Vec3,
    /// To the right of the picture, unit.
    pub right: Vec3,
    /// To its top, unit.
    pub up: Vec3,
    /// Into the scene, unit.
    pub forward: Vec3,
    /// Half the height of the picture at distance 1.
    pub tan_half_fov_y: f32,
    /// Width over height of the picture.
    pub aspect: f32,
    /// Radius of the lens, metres; 0 is a pinhole.
    pub lens_radius: f32,
    /// Distance along `forward` that is sharp, metres.
    pub focus_distance: f32,
}

impl Camera {
    /// A pinhole placed by a rigid (possibly scaled) transform; scale and shear are dropped.
    pub fn from_transform(to_world: Affine3A, yfov: f32, aspect: f32) -> Self {
        let forward = -Vec3::from(to_world.matrix3.z_axis).normalize_or(Vec3::NEG_Z);
        let up = Vec3::from(to_world.matrix3.y_axis);
        Self::looking(Vec3::from(to_world.translation), forward, up, yfov, aspect)
    }

    /// A pinhole at `eye` that looks at `target`; `up` leans the picture.
    pub fn look_at(eye: Vec3, target: Vec3, up: Vec3, yfov: f32, aspect: f32) -> Self {
        Self::looking(eye, (target - eye).normalize_or(Vec3::NEG_Z), up, yfov, aspect)
    }

    fn looking(origin: Vec3, forward: Vec3, up: Vec3, yfov: f32, aspect: f32) -> Self {
        // Looking straight up or down leaves no upright direction: any one will do.
        let right =
            forward.cross(up).try_normalize().unwrap_or_else(|| crate::frame::Frame::from_normal(forward).t);
        Camera {
            origin,
            right,
            up: right.cross(forward),
            forward,
            tan_half_fov_y: tan(0.5 * yfov),
            aspect,
            lens_radius: 0.0,
            focus_distance: 1.0,
        }
    }

    /// The ray through `film` (x to the right, y down, the picture is the unit square) for a point `lens` of the unit
    /// square, mapped to the lens with uniform density.
    #[inline]
    pub fn ray(&self, film: [f32; 2], lens: [f32; 2], time: f32) -> Ray {
        let x = (2.0 * film[0] - 1.0) * self.tan_half_fov_y * self.aspect;
        let y = (1.0 - 2.0 * film[1]) * self.tan_half_fov_y;
        let through = self.forward + self.right * x + self.up * y; // unit depth
        if self.lens_radius <= 0.0 {
            return Ray::new(self.origin, through.normalize(), time);
        }
        let offset = self.lens_point(lens);
        Ray::new(self.origin + offset, (through * self.focus_distance - offset).normalize(), time)
    }

    /// Offset from the lens's centre, world space, uniform over its area.
    #[inline]
    pub fn lens_point(&self, lens: [f32; 2]) -> Vec3 {
        let [x, y] = concentric_disk(lens);
        (self.right * x + self.up * y) * self.lens_radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn picture_is_upright_and_not_mirrored() {
        let c = Camera::look_at(Vec3::new(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y, 1.0, 2.0);
        assert!(c.ray([0.9, 0.5], [0.5; 2], 0.0).dir.x > 0.0, "right of the picture is +x");
        assert!(c.ray([0.5, 0.1], [0.5; 2], 0.0).dir.y > 0.0, "row 0 is the top");
        let edge = c.ray([0.5, 0.0], [0.5; 2], 0.0).dir;
        assert!((crate::math::acos(edge.dot(c.forward)) - 0.5).abs() < 1e-5, "--fov is vertical");
        let t = Camera::from_transform(Affine3A::from_translation(Vec3::new(0.0, 0.0, 5.0)), 1.0, 2.0);
        assert_eq!(t, c);
        let down = Camera::look_at(Vec3::Y, Vec3::ZERO, Vec3::Y, 1.0, 1.0);
        assert!(down.right.is_normalized() && down.up.is_normalized());
    }

    #[test]
    fn lens_rays_meet_at_the_focus() {
        let c = Camera {
            lens_radius: 0.1,
            focus_distance: 3.0,
            ..Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, 1.0, 1.0)
        };
        let p = |lens| {
            let r = c.ray([0.7, 0.2], lens, 0.0);
            r.at(3.0 / -r.dir.z)
        };
        assert!((p([0.1, 0.9]) - p([0.8, 0.3])).length() < 1e-5);
    }
}
