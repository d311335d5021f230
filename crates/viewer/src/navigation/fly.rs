//! Flying: keys that are held move the eye through the scene.

use super::Pose;
use glam::Vec3;

/// What the keys ask for: shares of full speed, -1 to 1, along the camera's right, the world's up and the camera's forward.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Flight {
    /// To the right, up (+y of the world), forward.
    pub direction: Vec3,
    /// Faster (shift).
    pub fast: bool,
    /// Slower (alt).
    pub slow: bool,
}

/// Radii of the scene a second at the speed 1.
const SPEED: f32 = 0.35;
/// What shift and alt do to it.
const FAST: f32 = 4.0;
/// Longest step in time, seconds: after a pause nobody wants to be elsewhere.
const LONGEST: f32 = 0.1;

impl Flight {
    /// Whether any key is held.
    pub fn moves(&self) -> bool {
        self.direction != Vec3::ZERO
    }
}

/// Moves the eye for `seconds`. `speed` is the person's own factor, `radius` that of the scene.
pub fn fly(mut pose: Pose, flight: &Flight, speed: f32, radius: f32, seconds: f32) -> Pose {
    let camera = &mut pose.camera;
    let Vec3 { x, y, z } = flight.direction;
    let towards = (camera.right * x + Vec3::Y * y + camera.forward * z).normalize_or_zero();
    let gear = match (flight.fast, flight.slow) {
        (true, false) => FAST,
        (false, true) => 1.0 / FAST,
        _ => 1.0,
    };
    camera.origin += towards * (SPEED * speed * gear * radius * seconds.clamp(0.0, LONGEST));
    pose
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::navigation::tests::cameras;

    fn flown(flight: Flight, seconds: f32) -> Vec<(Pose, Pose)> {
        let poses = cameras().into_iter().map(|camera| Pose { camera, reach: 1.0 });
        poses.map(|pose| (pose, fly(pose, &flight, 1.0, 10.0, seconds))).collect()
    }

    #[test]
    fn keys_move_along_the_camera_and_the_worlds_up() {
        let along = |direction| Flight { direction, ..Flight::default() };
        for (direction, axis) in [(Vec3::X, 0), (Vec3::Y, 1), (Vec3::Z, 2)] {
            for (from, to) in flown(along(direction), 0.05) {
                let axis = [from.camera.right, Vec3::Y, from.camera.forward][axis];
                let way = to.camera.origin - from.camera.origin;
                assert!((way - axis * (0.05 * SPEED * 10.0)).length() < 1e-4, "{way}");
                assert_eq!(to.camera.forward, from.camera.forward);
            }
        }
    }

    #[test]
    fn speed_does_not_grow_along_diagonals_nor_after_a_pause() {
        let both = Flight { direction: Vec3::new(1.0, 0.0, 1.0), ..Flight::default() };
        for (from, to) in flown(both, 100.0) {
            let way = (to.camera.origin - from.camera.origin).length();
            assert!((way - LONGEST * SPEED * 10.0).abs() < 1e-3, "{way}");
        }
    }

    #[test]
    fn shift_is_faster_and_alt_slower() {
        let flight = Flight { direction: Vec3::Z, ..Flight::default() };
        let way = |flight| {
            let (from, to) = flown(flight, 0.05)[0];
            (to.camera.origin - from.camera.origin).length()
        };
        let plain = way(flight);
        assert!((way(Flight { fast: true, ..flight }) - FAST * plain).abs() < 1e-4);
        assert!((way(Flight { slow: true, ..flight }) - plain / FAST).abs() < 1e-4);
        assert!(!Flight::default().moves() && flight.moves());
    }
}
