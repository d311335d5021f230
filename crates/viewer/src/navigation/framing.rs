//! Bringing things into view: all of the scene, or what was picked.

use super::Pose;
use glam::{Mat4, Vec3};
use lumbre::core::Camera;
use lumbre::core::camera::Projection;

/// A box along the axes of the world, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Its smallest corner.
    pub min: Vec3,
    /// Its largest corner.
    pub max: Vec3,
}

impl Bounds {
    /// The box around points; `None` if there are none. Coordinates that are no numbers do not count.
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Option<Bounds> {
        let points = points.into_iter().filter(|p| p.is_finite());
        points.map(|p| Bounds { min: p, max: p }).reduce(Bounds::with)
    }

    /// The box around both.
    pub fn with(self, other: Bounds) -> Bounds {
        Bounds { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The box around this one after a transform.
    pub fn transformed(self, by: Mat4) -> Option<Bounds> {
        let corner = |i: u32| {
            let pick = |bit: u32, low: f32, high: f32| if i >> bit & 1 == 0 { low } else { high };
            let (a, b) = (self.min, self.max);
            by.transform_point3(Vec3::new(pick(0, a.x, b.x), pick(1, a.y, b.y), pick(2, a.z, b.z)))
        };
        Bounds::around((0..8).map(corner))
    }

    /// Its centre.
    pub fn center(self) -> Vec3 {
        0.5 * self.min + 0.5 * self.max
    }

    /// Half its diagonal, at least a tenth of a millimetre: the same as that of a compiled scene.
    pub fn radius(self) -> f32 {
        (0.5 * (self.max - self.min).length()).max(1e-4)
    }
}

/// Moves the camera back or forth so that the ball around a box fills the picture; it looks on in the same direction.
pub fn frame(pose: Pose, bounds: Bounds) -> Pose {
    let (camera, radius) = (pose.camera, bounds.radius());
    let mut framed = camera;
    let reach = match camera.projection {
        Projection::Perspective { tan_half_fov_y } => {
            let half = tan_half_fov_y.atan().min((tan_half_fov_y * camera.aspect).atan());
            radius / half.sin()
        }
        Projection::Orthographic { .. } => {
            framed.projection =
                Projection::Orthographic { half_height: radius / camera.aspect.clamp(1e-3, 1.0) };
            // Far enough that nothing lies behind the eye.
            2.0 * radius
        }
    };
    framed.origin = bounds.center() - camera.forward * reach;
    Pose { camera: framed, reach }
}

/// The whole of a scene without a camera, as `lumbre render` shows it: from its front (+z), a little from the right and from above.
/// `fov` is vertical, radians.
pub fn overview(bounds: Option<Bounds>, fov: f32, aspect: f32) -> Pose {
    let bounds = bounds.unwrap_or(Bounds { min: Vec3::splat(-0.577), max: Vec3::splat(0.577) });
    let ((se, ce), (sa, ca)) = (0.30f32.sin_cos(), 0.45f32.sin_cos());
    let from = bounds.center() + Vec3::new(ce * sa, se, ce * ca);
    let camera = Camera::look_at(from, bounds.center(), Vec3::Y, fov, aspect);
    frame(Pose { camera, reach: 1.0 }, bounds)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::navigation::tests::cameras;

    const BOX: Bounds = Bounds { min: Vec3::new(-1.0, 0.0, 2.0), max: Vec3::new(3.0, 2.0, 6.0) };

    #[test]
    fn a_box_holds_what_it_is_around() {
        assert_eq!(Bounds::around([]), None);
        assert_eq!(Bounds::around([Vec3::NAN]), None);
        assert_eq!(Bounds::around([BOX.max, Vec3::new(f32::INFINITY, 0.0, 0.0), BOX.min]), Some(BOX));
        assert_eq!(BOX.center(), Vec3::new(1.0, 1.0, 4.0));
        assert_eq!(BOX.radius(), 3.0);
        let point = Bounds { min: Vec3::ONE, max: Vec3::ONE };
        assert_eq!(BOX.with(point), Bounds { min: Vec3::new(-1.0, 0.0, 1.0), max: BOX.max });
        let turned = BOX.transformed(Mat4::from_rotation_y(std::f32::consts::FRAC_PI_2)).unwrap();
        assert!((turned.min - Vec3::new(2.0, 0.0, -3.0)).length() < 1e-5, "{turned:?}");
    }

    /// The ball around the box touches the nearer edges of the picture, and no corner is cut off.
    #[test]
    fn what_is_framed_fills_the_picture() {
        for aspect in [0.5, 1.0, 2.0] {
            for camera in cameras() {
                let pose = frame(Pose { camera: Camera { aspect, ..camera }, reach: 1.0 }, BOX);
                let c = &pose.camera;
                assert_eq!(c.forward, camera.forward);
                assert!((pose.pivot() - BOX.center()).length() < 1e-4);
                let shares = match c.projection {
                    Projection::Perspective { tan_half_fov_y: t } => {
                        [t, t * aspect].map(|t| BOX.radius() / (pose.reach * t.atan().sin()))
                    }
                    Projection::Orthographic { half_height: h } => [h, h * aspect].map(|h| BOX.radius() / h),
                };
                assert!((shares[0].max(shares[1]) - 1.0).abs() < 1e-4, "{shares:?}");
            }
        }
    }

    #[test]
    fn an_overview_is_that_of_the_library() {
        let mut scene = lumbre::scene::Scene::default();
        let positions = vec![BOX.min, BOX.max, Vec3::new(BOX.min.x, BOX.max.y, BOX.min.z)];
        let primitive = lumbre::scene::Primitive {
            positions,
            indices: vec![0, 1, 2],
            ..lumbre::scene::Primitive::default()
        };
        let mesh = scene
            .add_mesh(lumbre::scene::Mesh { primitives: vec![primitive], ..lumbre::scene::Mesh::default() });
        scene.add_root(lumbre::scene::Node { mesh: Some(mesh), ..lumbre::scene::Node::default() });
        let compiled = lumbre::compile(&scene).unwrap().scene;
        for aspect in [0.7, 1.6] {
            let found =
                lumbre::find_camera(&scene, &compiled, &lumbre::CameraOptions::default(), aspect).unwrap();
            let ours = overview(Some(BOX), lumbre::camera::DEFAULT_FOV, aspect).camera;
            assert!((ours.origin - found.camera.origin).length() < 1e-4 * BOX.radius());
            assert!((ours.forward - found.camera.forward).length() < 1e-5);
            assert_eq!(ours.projection, found.camera.projection);
        }
    }
}
