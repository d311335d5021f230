//! Ways that a camera takes: a text with a line for each place.
//!
//! ```text
//! # eye X,Y,Z    looks at X,Y,Z    vertical field of view, degrees (that of the line before, where none stands)
//! -3,1.6,4       0,1,0             45
//! 0,1.6,5        0,1,0
//! 3,1.2,4        0,1,-1            30
//! ```
//!
//! The camera passes all places, the time from one to the next always the same, on a curve without corners (Catmull and Rom 1974).

use glam::Vec3;
use lumbre_core::Camera;

/// Most places of a path.
const MOST_KEYS: usize = 10_000;

/// A place of the path.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Key {
    eye: Vec3,
    target: Vec3,
    /// Vertical field of view, radians; `None`: that of the camera that takes the path.
    yfov: Option<f32>,
}

/// A way that a camera takes.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraPath {
    keys: Vec<Key>,
}

/// What is wrong with a text, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {reason}")]
pub struct CameraPathError {
    /// From 1.
    pub line: usize,
    /// What is wrong.
    pub reason: String,
}

impl CameraPath {
    /// Reads a text.
    ///
    /// # Errors
    /// The first line that is none, or that there are fewer than two or more than 10 000 places.
    pub fn parse(text: &str) -> Result<Self, CameraPathError> {
        let mut keys: Vec<Key> = Vec::new();
        let mut last = 1;
        for (i, line) in text.lines().enumerate() {
            last = i + 1;
            let content = line.split('#').next().unwrap_or_default().trim();
            if content.is_empty() {
                continue;
            }
            let wrong = |reason: String| CameraPathError { line: i + 1, reason };
            if keys.len() == MOST_KEYS {
                return Err(wrong(format!("more than {MOST_KEYS} places")));
            }
            let before = keys.last().and_then(|k| k.yfov);
            keys.push(key(content, before).map_err(wrong)?);
        }
        match keys.len() {
            0 | 1 => Err(CameraPathError { line: last, reason: "a path has two places at least".to_owned() }),
            _ => Ok(CameraPath { keys }),
        }
    }

    /// The camera at a share of the way, 0 to 1; what is not said of it is as `base` has it.
    pub fn at(&self, share: f32, base: &Camera) -> Camera {
        let last = self.keys.len() - 1;
        let place = share.clamp(0.0, 1.0) * last as f32;
        let first = (place as usize).min(last - 1);
        let t = place - first as f32;
        // The ends go on straight.
        let around = |of: fn(&Key) -> Vec3| -> Vec3 {
            let at = |i: usize| of(&self.keys[i]);
            let [b, c] = [at(first), at(first + 1)];
            let a = if first > 0 { at(first - 1) } else { 2.0 * b - c };
            let d = if first + 1 < last { at(first + 2) } else { 2.0 * c - b };
            catmull_rom([a, b, c, d], t)
        };
        let (eye, target) = (around(|k| k.eye), around(|k| k.target));
        let yfov = match (self.keys[first].yfov, self.keys[first + 1].yfov) {
            (Some(from), Some(to)) => Some(from + (to - from) * t),
            (from, to) => from.or(to),
        };
        let looking = Camera::look_at(eye, target, Vec3::Y, yfov.unwrap_or(1.0), base.aspect);
        let projection = if yfov.is_some() { looking.projection } else { base.projection };
        Camera { projection, lens_radius: base.lens_radius, focus_distance: base.focus_distance, ..looking }
    }
}

fn key(line: &str, yfov: Option<f32>) -> Result<Key, String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let (eye, target, fov) = match words[..] {
        [eye, target] => (eye, target, None),
        [eye, target, fov] => (eye, target, Some(fov)),
        _ => {
            return Err("expected X,Y,Z of the eye, X,Y,Z of what it looks at, and degrees if any".to_owned());
        }
    };
    let (eye, target) = (point(eye)?, point(target)?);
    if eye == target {
        return Err("eye and target are the same point: there is no direction".to_owned());
    }
    let yfov = match fov {
        None => yfov,
        Some(text) => match text.parse::<f32>() {
            Ok(degrees) if (0.001..=179.9).contains(&degrees) => Some(degrees.to_radians()),
            _ => return Err(format!("`{text}` is no field of view: degrees between 0 and 180")),
        },
    };
    Ok(Key { eye, target, yfov })
}

fn point(text: &str) -> Result<Vec3, String> {
    let numbers: Option<Vec<f32>> =
        text.split(',').map(|n| n.parse().ok().filter(|v: &f32| v.is_finite())).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) => Ok(Vec3::new(x, y, z)),
        _ => Err(format!("`{text}` is no point: expected three numbers X,Y,Z")),
    }
}

/// From the second point to the third.
fn catmull_rom([a, b, c, d]: [Vec3; 4], t: f32) -> Vec3 {
    let (t2, t3) = (t * t, t * t * t);
    0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t2 + (3.0 * b - a - 3.0 * c + d) * t3)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn base() -> Camera {
        Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, 0.9, 1.5)
    }

    #[test]
    fn places_are_passed_and_a_line_is_straight() {
        let path = CameraPath::parse("# a walk\n0,1,0 0,1,-9 40\n\n2,1,0  2,1,-9 # aside\n4,1,0 4,1,-9 60\n")
            .unwrap();
        for (share, x, degrees) in
            [(0.0, 0.0, 40.0f32), (0.25, 1.0, 40.0), (0.5, 2.0, 40.0), (1.0, 4.0, 60.0)]
        {
            let camera = path.at(share, &base());
            assert!((camera.origin - Vec3::new(x, 1.0, 0.0)).length() < 1e-5, "{share}: {:?}", camera.origin);
            assert!((camera.forward - Vec3::NEG_Z).length() < 1e-5 && camera.aspect == 1.5);
            let expected = lumbre_core::camera::Projection::perspective(degrees.to_radians());
            assert_eq!(format!("{:.4?}", camera.projection), format!("{expected:.4?}"), "{share}");
        }
        // Where nothing is said, the lens is the camera's own.
        let path = CameraPath::parse("0,0,0 0,0,-1\n0,0,1 0,0,-1").unwrap();
        assert_eq!(path.at(0.3, &base()).projection, base().projection);
    }

    #[test]
    fn curves_have_no_corners() {
        let path = CameraPath::parse("0,0,0 0,0,-9\n1,2,0 0,0,-9\n4,2,0 0,0,-9\n5,0,1 0,0,-9").unwrap();
        let eye = |share: f32| path.at(share, &base()).origin;
        for key in [1.0f32 / 3.0, 2.0 / 3.0] {
            let (before, after) = (eye(key) - eye(key - 1e-3), eye(key + 1e-3) - eye(key));
            assert!((before - after).length() < 0.05 * before.length(), "{before} {after}");
        }
    }

    #[test]
    fn what_is_wrong_has_its_line() {
        let wrong = |text| CameraPath::parse(text).unwrap_err();
        assert_eq!(wrong("0,0,0 0,0,-1\n1,2 0,0,0").line, 2);
        assert_eq!(wrong("\n\n1,2,3 1,2,3").line, 3);
        assert_eq!(wrong("0,0,0 0,0,1 200").line, 1);
        for few in ["", "# nothing\n", "0,0,0 0,0,1"] {
            assert!(wrong(few).reason.contains("two places"), "{few}");
        }
        assert!(wrong("0,0,nan 0,0,1\n").reason.contains("0,0,nan"));
    }
}
