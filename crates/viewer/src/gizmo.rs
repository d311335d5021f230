//! Three arrows at what is picked; dragging one moves it along that axis of the world. Pure geometry: drawing is the picture's.

use glam::{Vec2, Vec3};
use lumbre::core::Camera;
use lumbre::core::camera::Projection;

/// Length of an arrow, points.
const LENGTH: f32 = 90.0;
/// How near the mouse must be to take one, points.
const NEAR: f32 = 8.0;

/// The axes, in the order of their numbers.
pub const AXES: [Vec3; 3] = [Vec3::X, Vec3::Y, Vec3::Z];

/// A camera over a picture of this size in points, y down.
#[derive(Clone, Copy, Debug)]
pub struct Screen {
    /// The camera, with the aspect of the picture.
    pub camera: Camera,
    /// Width and height, points.
    pub size: Vec2,
}

impl Screen {
    /// Where a point is in the picture, points from its top left corner; `None` behind the eye.
    pub fn place(&self, point: Vec3) -> Option<Vec2> {
        let camera = &self.camera;
        let to = point - camera.origin;
        let depth = to.dot(camera.forward);
        let half = match camera.projection {
            Projection::Perspective { .. } if depth <= 1e-6 => return None,
            Projection::Perspective { tan_half_fov_y } => tan_half_fov_y * depth,
            Projection::Orthographic { half_height } => half_height,
        };
        let at = Vec2::new(to.dot(camera.right) / (half * camera.aspect), -to.dot(camera.up) / half);
        Some((at * 0.5 + 0.5) * self.size)
    }

    /// Metres that a point of the picture measures at a place of the world.
    fn metres_per_point(&self, place: Vec3) -> f32 {
        let depth = (place - self.camera.origin).dot(self.camera.forward).max(1e-6);
        let half = match self.camera.projection {
            Projection::Perspective { tan_half_fov_y } => tan_half_fov_y * depth,
            Projection::Orthographic { half_height } => half_height,
        };
        2.0 * half / self.size.y.max(1.0)
    }

    /// Beginnings and ends of the arrows at a place; an arrow that points at the eye, or that cannot be seen, is left out.
    pub fn arrows(&self, origin: Vec3) -> [Option<[Vec2; 2]>; 3] {
        let length = LENGTH * self.metres_per_point(origin);
        AXES.map(|axis| {
            let ends = [self.place(origin)?, self.place(origin + axis * length)?];
            (ends[0].distance(ends[1]) > NEAR).then_some(ends)
        })
    }

    /// The arrow under the mouse.
    pub fn arrow_at(&self, origin: Vec3, mouse: Vec2) -> Option<usize> {
        let distances =
            self.arrows(origin).map(|ends| ends.map_or(f32::INFINITY, |ends| to_segment(mouse, ends)));
        let nearest = (0..3).min_by(|a, b| distances[*a].total_cmp(&distances[*b]))?;
        (distances[nearest] <= NEAR).then_some(nearest)
    }

    /// How far along an axis through `origin` a drag of the mouse leads, metres: from the point of the axis that is nearest to what
    /// was under the mouse to that for what is under it now. 0 where the axis points at the eye.
    pub fn dragged(&self, origin: Vec3, axis: usize, from: Vec2, to: Vec2) -> f32 {
        let along = |mouse: Vec2| {
            let film = (mouse / self.size).to_array();
            let ray = Camera { lens_radius: 0.0, ..self.camera }.ray(film, [0.5; 2], 0.0);
            let (axis, away) = (AXES[axis], ray.origin - origin);
            // The point of one line that is nearest to another.
            let cosine = axis.dot(ray.dir);
            let sine2 = 1.0 - cosine * cosine;
            (sine2 > 1e-4).then(|| (away.dot(axis) - cosine * away.dot(ray.dir)) / sine2)
        };
        match (along(from), along(to)) {
            (Some(from), Some(to)) => to - from,
            _ => 0.0,
        }
    }
}

fn to_segment(point: Vec2, [a, b]: [Vec2; 2]) -> f32 {
    let along = ((point - a).dot(b - a) / (b - a).length_squared().max(1e-12)).clamp(0.0, 1.0);
    point.distance(a + (b - a) * along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::navigation::tests::cameras;

    fn screens() -> Vec<Screen> {
        let of = |camera: Camera| Screen { camera, size: Vec2::new(600.0, 600.0 / camera.aspect) };
        cameras().into_iter().map(of).collect()
    }

    #[test]
    fn places_are_where_the_cameras_rays_go() {
        for screen in screens() {
            for film in [[0.5, 0.5], [0.1, 0.8], [0.9, 0.2]] {
                let point = screen.camera.ray(film, [0.5; 2], 0.0).at(3.0);
                let place = screen.place(point).unwrap() / screen.size;
                assert!((place - Vec2::from(film)).length() < 1e-4, "{place} {film:?}");
            }
        }
        let perspective = screens()[0];
        assert_eq!(perspective.place(Vec3::Z), None, "behind the eye");
    }

    #[test]
    fn arrows_are_as_long_at_any_distance() {
        let screen = screens()[0];
        for distance in [0.1, 1.0, 100.0] {
            let arrows = screen.arrows(Vec3::NEG_Z * distance);
            let [a, b] = arrows[0].unwrap();
            assert!((a.distance(b) - LENGTH).abs() < 0.5, "{a} {b}");
            assert!(arrows[2].is_none(), "it points at the eye");
        }
    }

    #[test]
    fn the_arrow_under_the_mouse_is_taken() {
        let (screen, origin) = (screens()[1], Vec3::new(0.0, 0.5, -1.0));
        for axis in 0..3 {
            let [a, b] = screen.arrows(origin)[axis].unwrap();
            assert_eq!(screen.arrow_at(origin, a.lerp(b, 0.8)), Some(axis));
        }
        assert_eq!(screen.arrow_at(origin, Vec2::ZERO), None);
    }

    #[test]
    fn a_drag_moves_as_far_as_the_mouse() {
        for screen in screens() {
            let origin = screen.camera.origin + screen.camera.forward * 3.0 + screen.camera.right * 0.2;
            for (i, axis) in AXES.iter().enumerate() {
                if screen.arrows(origin)[i].is_none() {
                    continue;
                }
                let from = screen.place(origin + 0.1 * axis).unwrap();
                let to = screen.place(origin + 0.4 * axis).unwrap();
                let way = screen.dragged(origin, i, from, to);
                assert!((way - 0.3).abs() < 2e-3, "{way} along {axis}");
            }
        }
        let screen = screens()[0];
        assert_eq!(screen.dragged(Vec3::NEG_Z, 2, screen.size * 0.5, screen.size * 0.5), 0.0);
    }
}
