//! Where a thing stands: scaled, then turned, then moved.

use glam::{DMat3, DQuat, DVec3};
use serde_json::{Value, json};

/// Where a node stands: scaled, then turned, then moved.
#[derive(Clone, Copy)]
pub(crate) struct Placement {
    pub(crate) translation: DVec3,
    pub(crate) rotation: DQuat,
    pub(crate) scale: DVec3,
}

impl Placement {
    /// At `translation`, neither turned nor scaled.
    pub(crate) fn at(translation: DVec3) -> Self {
        Self { translation, rotation: DQuat::IDENTITY, scale: DVec3::ONE }
    }

    /// At `translation`, given by its coordinates.
    pub(crate) fn xyz(x: f64, y: f64, z: f64) -> Self {
        Self::at(DVec3::new(x, y, z))
    }

    /// Turned by `degrees` about +y, after what it was turned already.
    pub(crate) fn turned_y(self, degrees: f64) -> Self {
        self.turned(DVec3::Y, degrees)
    }

    /// Turned by `degrees` about a unit `axis`, after what it was turned already.
    pub(crate) fn turned(self, axis: DVec3, degrees: f64) -> Self {
        // Sine and cosine from libm, not from the platform: the file must not depend on it.
        let (s, c) = libm::sincos(degrees.to_radians() / 2.0);
        let [x, y, z] = (axis * s).to_array();
        Self { rotation: DQuat::from_xyzw(x, y, z, c) * self.rotation, ..self }
    }

    /// Scaled by `factor` in all directions.
    pub(crate) fn scaled(self, factor: f64) -> Self {
        self.stretched(DVec3::splat(factor))
    }

    /// Scaled by a factor for each axis.
    pub(crate) fn stretched(self, factors: DVec3) -> Self {
        Self { scale: self.scale * factors, ..self }
    }

    /// At `eye`, -z towards `target`, +y up.
    pub(crate) fn looking(eye: DVec3, target: DVec3) -> Self {
        let back = (eye - target).normalize();
        let right = DVec3::Y.cross(back).normalize();
        let rotation = DQuat::from_mat3(&DMat3::from_cols(right, back.cross(right), back));
        Self { rotation, ..Self::at(eye) }
    }

    /// Writes translation, rotation and scale into a node, leaving out what changes nothing.
    pub(super) fn write(&self, node: &mut Value) {
        if self.translation != DVec3::ZERO {
            node["translation"] = json!(self.translation.to_array());
        }
        if self.rotation != DQuat::IDENTITY {
            node["rotation"] = json!(self.rotation.to_array());
        }
        if self.scale != DVec3::ONE {
            node["scale"] = json!(self.scale.to_array());
        }
    }
}
