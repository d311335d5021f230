//! The table of a node: where it stands in the space of its parent, and whether it is drawn. Rotation is in degrees about x, then y, then z of
//! the parent: unlike a quaternion, three angles can be written and understood by hand, and one of them at a time is what a panel turns.

use super::param::{Access, HUGE, Param, field};
use super::value::{Kind, Value};
use glam::{EulerRot, Mat4, Quat, Vec3};
use lumbre_scene::Node;

/// The place of a node.
#[derive(Clone, Debug)]
pub(super) struct Place {
    transform: Mat4,
    rotation: Quat,
    scale: Vec3,
    visible: bool,
}

impl From<&Node> for Place {
    fn from(node: &Node) -> Self {
        let (scale, rotation) = parts(node.transform);
        Place { transform: node.transform, rotation, scale, visible: node.visible }
    }
}

impl Place {
    pub(super) fn put(self, node: &mut Node) {
        (node.transform, node.visible) = (self.transform, self.visible);
    }

    /// Makes rotation and scale anew. A shear, which only such nodes can have that came as a matrix, is lost.
    fn turn(&mut self, rotation: Quat, scale: Vec3) {
        (self.rotation, self.scale) = (rotation, scale);
        let to = self.transform.w_axis.truncate();
        self.transform = Mat4::from_scale_rotation_translation(scale, rotation, to);
    }
}

/// Scale and rotation of a transform. What has no size in some direction is taken as not turned.
pub(super) fn parts(transform: Mat4) -> (Vec3, Quat) {
    let (scale, rotation, _) = transform.to_scale_rotation_translation();
    if rotation.is_finite() { (scale, rotation) } else { (scale, Quat::IDENTITY) }
}

/// Rotation by three angles in degrees.
fn quaternion(degrees: Vec3) -> Quat {
    let [x, y, z] = degrees.to_array().map(f32::to_radians);
    Quat::from_euler(EulerRot::ZYX, z, y, x)
}

/// The three angles in degrees of a rotation.
pub(super) fn degrees(rotation: Quat) -> Vec3 {
    let (z, y, x) = rotation.to_euler(EulerRot::ZYX);
    Vec3::new(x, y, z).map(f32::to_degrees)
}

type One = Param<Place>;

/// All parameters of a node.
pub(super) const PLACE: &[One] = &[
    One::new(
        "translation",
        "Place",
        Kind::Vector { unit: "m", range: [-HUGE, HUGE] },
        Access {
            get: |p| Value::Vector(p.transform.w_axis.truncate()),
            set: |p, v| p.transform.w_axis = v.vector().extend(1.0),
        },
    ),
    One::new(
        "rotation",
        "Rotation",
        Kind::Vector { unit: "°", range: [-3600.0, 3600.0] },
        Access {
            get: |p| Value::Vector(degrees(p.rotation)),
            set: |p, v| p.turn(quaternion(v.vector()), p.scale),
        },
    ),
    One::new(
        "scale",
        "Scale",
        Kind::Vector { unit: "", range: [-1e6, 1e6] },
        Access { get: |p| Value::Vector(p.scale), set: |p, v| p.turn(p.rotation, v.vector()) },
    ),
    One::new("visible", "Visible", Kind::Flag, field!(flag visible)),
];
