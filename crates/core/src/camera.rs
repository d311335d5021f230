//! Cameras: from a place in the picture to a ray.

use crate::math::{Affine3A, Vec3, tan};
use crate::ray::Ray;
use crate::warp::concentric_disk;

/// How a camera projects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// All rays pass the eye.
    Perspective {
        /// Half the height of the picture at distance 1.
        tan_half_fov_y: f32,
    },
    /// All rays are parallel; they begin on the plane through the eye.
    Orthographic {
        /// Half the height of the picture, metres.
        half_height: f32,
    },
}

/// A camera with a thin lens (telecentric where rays are parallel), in world space. It looks along -z of its frame, +y up.
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
    /// How it projects.
    pub projection: Projection,
    /// Width over height of the picture.
    pub aspect: f32,
    /// Radius of the lens, metres; 0 is a pinhole.
    pub lens_radius: f32,
    /// Distance along `forward` that is sharp, metres.
    pub focus_distance: f32,
}

impl Projection {
    /// Perspective with this vertical field of view, radians.
    pub fn perspective(yfov: f32) -> Self {
        Projection::Perspective { tan_half_fov_y: tan(0.5 * yfov) }
    }

    /// The same with a picture `factor` times as high.
    pub fn scaled(self, factor: f32) -> Self {
        match self {
            Projection::Perspective { tan_half_fov_y } => {
                Projection::Perspective { tan_half_fov_y: tan_half_fov_y * factor }
            }
            Projection::Orthographic { half_height } => {
                Projection::Orthographic { half_height: half_height * factor }
            }
        }
    }
}

impl Camera {
    /// A camera without a lens, placed by a rigid (possibly scaled) transform; scale and shear are dropped.
    pub fn from_transform(to_world: Affine3A, projection: Projection, aspect: f32) -> Self {
        let forward = -Vec3::from(to_world.matrix3.z_axis).normalize_or(Vec3::NEG_Z);
        let up = Vec3::from(to_world.matrix3.y_axis);
        Self::looking(Vec3::from(to_world.translation), forward, up, projection, aspect)
    }

    /// A pinhole at `eye` that looks at `target`; `up` leans the picture.
    pub fn look_at(eye: Vec3, target: Vec3, up: Vec3, yfov: f32, aspect: f32) -> Self {
        Self::looking(
            eye,
            (target - eye).normalize_or(Vec3::NEG_Z),
            up,
            Projection::perspective(yfov),
            aspect,
        )
    }

    fn looking(origin: Vec3, forward: Vec3, up: Vec3, projection: Projection, aspect: f32) -> Self {
        // Looking straight up or down leaves no upright direction: any one will do.
        let right =
            forward.cross(up).try_normalize().unwrap_or_else(|| crate::frame::Frame::from_normal(forward).t);
        Camera {
            origin,
            right,
            up: right.cross(forward),
            forward,
            projection,
            aspect,
            lens_radius: 0.0,
            focus_distance: 1.0,
        }
    }

    /// The ray through `film` (x to the right, y down, the picture is the unit square) for a point `lens` of the unit
    /// square, mapped to the lens with uniform density.
    #[inline]
    pub fn ray(&self, film: [f32; 2], lens: [f32; 2], time: f32) -> Ray {
        let (Projection::Perspective { tan_half_fov_y: half }
        | Projection::Orthographic { half_height: half }) = self.projection;
        let x = (2.0 * film[0] - 1.0) * half * self.aspect;
        let y = (1.0 - 2.0 * film[1]) * half;
        // `through` has unit depth.
        let (start, through) = match self.projection {
            Projection::Perspective { .. } => (self.origin, self.forward + self.right * x + self.up * y),
            Projection::Orthographic { .. } => (self.origin + self.right * x + self.up * y, self.forward),
        };
        if self.lens_radius <= 0.0 {
            return Ray::new(start, through.normalize(), time);
        }
        let offset = self.lens_point(lens);
        Ray::new(start + offset, (through - offset / self.focus_distance).normalize(), time)
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
        let place = Affine3A::from_translation(Vec3::new(0.0, 0.0, 5.0));
        let t = Camera::from_transform(place, Projection::perspective(1.0), 2.0);
        assert_eq!(t, c);
        let down = Camera::look_at(Vec3::Y, Vec3::ZERO, Vec3::Y, 1.0, 1.0);
        assert!(down.right.is_normalized() && down.up.is_normalized());
    }

    /// At (1, 2, 3), turned to look along -x; twice as wide as high.
    fn orthographic() -> Camera {
        let turned = Affine3A::from_rotation_y(core::f32::consts::FRAC_PI_2);
        let place = Affine3A::from_translation(Vec3::new(1.0, 2.0, 3.0)) * turned;
        // The scale of its place is not that of the picture.
        let scaled = place * Affine3A::from_scale(Vec3::splat(7.0));
        Camera::from_transform(scaled, Projection::Orthographic { half_height: 0.5 }, 2.0)
    }

    #[test]
    fn orthographic_rays_are_parallel_and_fill_the_picture() {
        let c = orthographic();
        // The picture's right is -z, a width of 2 m, a height of 1 m.
        for (film, origin) in [
            ([0.5, 0.5], [1.0, 2.0, 3.0]),
            ([0.0, 0.0], [1.0, 2.5, 4.0]),
            ([1.0, 0.0], [1.0, 2.5, 2.0]),
            ([0.25, 1.0], [1.0, 1.5, 3.5]),
        ] {
            let r = c.ray(film, [0.3, 0.6], 0.0);
            assert!((r.dir - Vec3::NEG_X).length() < 1e-6, "{film:?} {}", r.dir);
            assert!((r.origin - Vec3::from(origin)).length() < 1e-5, "{film:?} {}", r.origin);
        }
        assert_eq!(c.projection.scaled(3.0), Projection::Orthographic { half_height: 1.5 });
    }

    #[test]
    fn lens_rays_meet_at_the_focus() {
        let perspective = Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, 1.0, 1.0);
        for base in [perspective, orthographic()] {
            let c = Camera { lens_radius: 0.1, focus_distance: 3.0, ..base };
            let film = [0.7, 0.2];
            let pinhole = base.ray(film, [0.5; 2], 0.0);
            let sharp = pinhole.at(3.0 / pinhole.dir.dot(c.forward));
            for lens in [[0.1, 0.9], [0.8, 0.3], [0.02, 0.5]] {
                let r = c.ray(film, lens, 0.0);
                assert!((r.origin - pinhole.origin).length() > 1e-3);
                assert!((r.at(3.0 / r.dir.dot(c.forward)) - sharp).length() < 1e-5);
            }
        }
    }
}
