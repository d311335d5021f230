//! A ray and a triangle on the host, one by one: for what is asked seldom, where a backend's own structures cannot be asked. In double
//! precision, so that it needs no care.

use glam::DVec3;

/// Distance to a triangle, in lengths of `dir`, and whether the ray comes from the side from which it winds counter-clockwise; `None` where
/// it misses. Möller and Trumbore 1997.
pub fn intersect([p0, p1, p2]: [DVec3; 3], origin: DVec3, dir: DVec3) -> Option<(f64, bool)> {
    let (e1, e2) = (p1 - p0, p2 - p0);
    let p = dir.cross(e2);
    let det = e1.dot(p);
    let inv = 1.0 / det;
    let to = origin - p0;
    let (b1, q) = (to.dot(p) * inv, to.cross(e1));
    let (b2, t) = (dir.dot(q) * inv, e2.dot(q) * inv);
    // A ray in the plane of the triangle has a determinant of 0 and no finite distance.
    (b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0 && t > 0.0 && t.is_finite()).then_some((t, det > 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_are_crossed_on_their_sides() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let from = |z: f64| DVec3::new(0.25, 0.25, z);
        assert_eq!(intersect(corners, from(2.0), -DVec3::Z), Some((2.0, true)));
        assert_eq!(intersect(corners, from(-2.0), DVec3::Z), Some((2.0, false)));
        assert_eq!(intersect(corners, from(-2.0), 4.0 * DVec3::Z), Some((0.5, false)));
        assert_eq!(intersect(corners, from(2.0), DVec3::Z), None);
        assert_eq!(intersect(corners, DVec3::new(0.8, 0.8, 1.0), -DVec3::Z), None);
        assert_eq!(intersect(corners, from(1.0), DVec3::X), None);
    }
}
