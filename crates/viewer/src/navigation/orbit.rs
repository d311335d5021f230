//! What a mouse does: turning about what is looked at, looking around, shifting, coming closer.

use super::{Pose, turn, turned};
use lumbre::core::camera::Projection;

/// Factor on the distance of one step of the wheel.
const STEP: f32 = 0.88;

/// Turns the camera about what it looks at. What is looked at stays where it is in the picture.
pub fn orbit(pose: Pose, yaw: f32, pitch: f32) -> Pose {
    let pivot = pose.pivot();
    let mut camera = turned(&pose.camera, turn(&pose.camera, yaw, pitch));
    camera.origin = pivot - camera.forward * pose.reach;
    Pose { camera, ..pose }
}

/// Turns the head: the eye stays.
pub fn look(pose: Pose, yaw: f32, pitch: f32) -> Pose {
    Pose { camera: turned(&pose.camera, turn(&pose.camera, yaw, pitch)), ..pose }
}

/// Shifts the camera so that what is looked at follows the mouse: `right` and `down` are shares of the picture's height.
pub fn pan(mut pose: Pose, right: f32, down: f32) -> Pose {
    let height = match pose.camera.projection {
        Projection::Perspective { tan_half_fov_y } => 2.0 * tan_half_fov_y * pose.reach,
        Projection::Orthographic { half_height } => 2.0 * half_height,
    };
    let camera = &mut pose.camera;
    camera.origin += (camera.up * down - camera.right * right) * height;
    pose
}

/// Comes closer by so many steps of the wheel (negative: goes back). Each makes the distance to what is looked at, or with parallel
/// rays the picture, smaller by the same factor; near it the steps become no shorter than a share of `radius`, that of the
/// scene, so that one can pass through.
pub fn dolly(mut pose: Pose, steps: f32, radius: f32) -> Pose {
    let factor = STEP.powf(steps);
    if let Projection::Orthographic { .. } = pose.camera.projection {
        pose.camera.projection = pose.camera.projection.scaled(factor);
        return pose;
    }
    let shortest = radius * SHORTEST_STEP * steps.abs();
    let way = pose.reach * (1.0 - factor);
    let way = if steps > 0.0 { way.max(shortest) } else { way.min(-shortest) };
    pose.camera.origin += pose.camera.forward * way;
    pose.reach = (pose.reach - way).max(radius * SHORTEST_REACH);
    pose
}

/// Shortest step of the wheel, in radii of the scene.
const SHORTEST_STEP: f32 = 0.004;
/// Shortest distance to what is looked at, in radii of the scene.
const SHORTEST_REACH: f32 = 0.01;

/// Narrows the view by so many steps (negative: widens it); the eye stays. Between 2 and 150 degrees.
pub fn zoom(mut pose: Pose, steps: f32) -> Pose {
    let projection = pose.camera.projection.scaled(STEP.powf(steps));
    pose.camera.projection = match projection {
        Projection::Perspective { tan_half_fov_y } => Projection::Perspective {
            tan_half_fov_y: tan_half_fov_y.clamp(1.0f32.to_radians().tan(), 75.0f32.to_radians().tan()),
        },
        parallel => parallel,
    };
    pose
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::navigation::tests::{assert_orthonormal, cameras};
    use glam::Vec3;
    use lumbre::core::Camera;

    fn poses() -> Vec<Pose> {
        cameras().into_iter().map(|camera| Pose { camera, reach: 2.5 }).collect()
    }

    /// Where a point is in the picture, the unit square with y down, by the camera's own rays turned round.
    fn seen(camera: &Camera, point: Vec3) -> [f32; 2] {
        let to = point - camera.origin;
        let (half, depth) = match camera.projection {
            Projection::Perspective { tan_half_fov_y } => (tan_half_fov_y, to.dot(camera.forward)),
            Projection::Orthographic { half_height } => (half_height, 1.0),
        };
        let x = to.dot(camera.right) / (depth * half * camera.aspect);
        let y = to.dot(camera.up) / (depth * half);
        [0.5 + 0.5 * x, 0.5 - 0.5 * y]
    }

    #[test]
    fn an_orbit_keeps_what_it_turns_about() {
        for pose in poses() {
            let there = orbit(pose, 0.7, 0.1);
            assert!((there.pivot() - pose.pivot()).length() < 1e-4);
            assert!((there.camera.origin - pose.camera.origin).length() > 0.1);
            assert_orthonormal(&there.camera);
            let back = orbit(orbit(pose, 0.3, 0.0), -0.3, 0.0);
            assert!((back.camera.origin - pose.camera.origin).length() < 1e-4);
            assert!((back.camera.up - pose.camera.up).length() < 1e-4);
        }
    }

    #[test]
    fn yaw_turns_to_the_left_and_pitch_lifts() {
        let level = poses()[0];
        assert!(look(level, 0.2, 0.0).camera.forward.x < 0.0);
        assert!(look(level, 0.0, 0.2).camera.forward.y > 0.0);
        // Seen from the right, after an orbit to the right.
        assert!(orbit(level, 0.2, 0.0).camera.origin.x > 0.0);
        assert!(orbit(level, 0.0, -0.2).camera.origin.y > 0.0);
        assert_eq!(look(level, 0.2, 0.1).camera.origin, level.camera.origin);
    }

    #[test]
    fn what_is_looked_at_follows_the_mouse_that_pans() {
        for pose in poses() {
            let there = pan(pose, 0.25, 0.1);
            let [x, y] = seen(&there.camera, pose.pivot());
            assert!((x - (0.5 + 0.25 / pose.camera.aspect)).abs() < 1e-5, "{x}");
            assert!((y - 0.6).abs() < 1e-5, "{y}");
        }
    }

    #[test]
    fn a_dolly_comes_closer_and_goes_back() {
        for pose in poses() {
            let near = dolly(pose, 3.0, 1.0);
            match pose.camera.projection {
                Projection::Perspective { .. } => {
                    assert!((near.pivot() - pose.pivot()).length() < 1e-4);
                    assert!((near.reach - 2.5 * STEP.powi(3)).abs() < 1e-4);
                }
                parallel => assert_eq!(near.camera.projection, parallel.scaled(STEP.powi(3))),
            }
            let back = dolly(near, -3.0, 1.0);
            assert!((back.camera.origin - pose.camera.origin).length() < 1e-4);
        }
        // One passes through what is looked at.
        let mut pose = poses()[0];
        for _ in 0..1000 {
            pose = dolly(pose, 1.0, 1.0);
        }
        assert!(pose.camera.origin.z < -3.0 && pose.reach > 0.0, "{pose:?}");
    }

    #[test]
    fn zoom_stays_within_what_can_be_drawn() {
        let tan = |pose: Pose| match pose.camera.projection {
            Projection::Perspective { tan_half_fov_y } => tan_half_fov_y,
            Projection::Orthographic { half_height } => half_height,
        };
        let pose = poses()[0];
        assert!(tan(zoom(pose, 1.0)) < tan(pose));
        assert!((tan(zoom(pose, 1000.0)).atan().to_degrees() - 1.0).abs() < 1e-3);
        assert!((tan(zoom(pose, -1000.0)).atan().to_degrees() - 75.0).abs() < 1e-3);
        assert_eq!(zoom(pose, 2.0).camera.origin, pose.camera.origin);
    }
}
