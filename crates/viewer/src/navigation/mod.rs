//! Moving the camera: pure functions from a [`Camera`] to a [`Camera`], so that nothing has to be kept in step with anything.
//!
//! The world is right-handed with +y up, the camera looks along `forward`; yaw turns to the left about +y (counter-clockwise seen
//! from above), pitch lifts the direction of view. Angles are radians, lengths metres. The *reach* is the distance along `forward`
//! of what is being looked at: orbits turn about that point, pans and dollies are measured by it.

mod fly;
mod framing;
mod orbit;

pub use fly::{Flight, fly};
pub use framing::{Bounds, frame, overview};
pub use orbit::{dolly, look, orbit, pan, zoom};

use glam::{Mat3, Vec3};
use lumbre::core::Camera;

/// A camera, and how far from it what it looks at is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The camera.
    pub camera: Camera,
    /// Distance along `forward` of what is looked at, metres, positive.
    pub reach: f32,
}

impl Pose {
    /// The point that orbits turn about.
    pub fn pivot(&self) -> Vec3 {
        self.camera.origin + self.camera.forward * self.reach
    }
}

/// How close to straight up or down a turn may bring the view, radians.
const POLE: f32 = 0.01;

/// The turn of a yaw and a pitch for a camera: about +y, and about the level axis to its right. The direction of view stops short
/// of straight up and down, where there would be no upright picture; a roll stays.
fn turn(camera: &Camera, yaw: f32, pitch: f32) -> Mat3 {
    let level = camera.forward.cross(Vec3::Y).try_normalize().unwrap_or(camera.right);
    let elevation = camera.forward.y.clamp(-1.0, 1.0).asin();
    let most = std::f32::consts::FRAC_PI_2 - POLE;
    // A camera that its author pointed straight down may stay so.
    let (low, high) = ((-most).min(elevation), most.max(elevation));
    let pitch = (elevation + pitch).clamp(low, high) - elevation;
    Mat3::from_rotation_y(yaw) * Mat3::from_axis_angle(level, pitch)
}

/// The camera with its axes turned, orthonormal again whatever rounding did.
fn turned(camera: &Camera, by: Mat3) -> Camera {
    let forward = (by * camera.forward).normalize_or(camera.forward);
    let right = (by * camera.right).reject_from_normalized(forward).normalize_or(camera.right);
    Camera { forward, right, up: right.cross(forward), ..*camera }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use lumbre::core::camera::Projection;

    /// Cameras that differ in all that matters: level, tilted, rolled, parallel, straight down.
    pub(crate) fn cameras() -> Vec<Camera> {
        let at = |eye, target, up| Camera::look_at(eye, target, up, 0.8, 1.5);
        let tilted = at(Vec3::new(3.0, 2.0, 1.0), Vec3::new(0.0, 0.5, -1.0), Vec3::Y);
        vec![
            at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y),
            tilted,
            at(Vec3::new(-2.0, -1.0, 4.0), Vec3::ZERO, Vec3::new(0.4, 1.0, 0.2)),
            Camera { projection: Projection::Orthographic { half_height: 2.0 }, ..tilted },
            at(Vec3::new(0.0, 5.0, 0.0), Vec3::ZERO, Vec3::NEG_Z),
        ]
    }

    /// Axes are unit and at right angles, and the picture is not mirrored.
    pub(crate) fn assert_orthonormal(c: &Camera) {
        for (a, b, dot) in [
            (c.right, c.right, 1.0),
            (c.up, c.up, 1.0),
            (c.forward, c.forward, 1.0),
            (c.right, c.up, 0.0),
            (c.up, c.forward, 0.0),
            (c.forward, c.right, 0.0),
        ] {
            assert!((a.dot(b) - dot).abs() < 1e-5, "{c:?}");
        }
        assert!((c.right.cross(c.up) + c.forward).length() < 1e-5, "{c:?}");
    }

    #[test]
    fn a_thousand_turns_leave_the_axes_orthonormal() {
        for start in cameras() {
            let mut camera = start;
            for i in 0..1000 {
                camera = turned(&camera, turn(&camera, 0.1, if i % 2 == 0 { 0.05 } else { -0.05 }));
            }
            assert_orthonormal(&camera);
        }
    }

    #[test]
    fn no_turn_goes_over_the_pole() {
        for start in cameras() {
            for pitch in [0.3, -0.3] {
                let mut camera = start;
                for _ in 0..40 {
                    camera = turned(&camera, turn(&camera, 0.0, pitch));
                    assert_orthonormal(&camera);
                }
                let up = camera.up.dot(Vec3::Y);
                assert!(up > -1e-3 || start.up.dot(Vec3::Y) < 0.0, "{camera:?} stands on its head");
            }
        }
    }
}
