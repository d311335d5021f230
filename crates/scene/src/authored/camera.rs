//! Cameras as an author writes them; the node that holds one places it.

use glam::{Mat4, Vec3};

/// How the camera projects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Pinhole or thin lens.
    Perspective {
        /// Vertical field of view, radians, in (0, π).
        yfov: f32,
        /// Width over height as the author framed it; `None`: that of the picture.
        aspect: Option<f32>,
    },
    /// Parallel rays.
    Orthographic {
        /// Half the width of the view, metres, positive. The scale of the node does not change it.
        xmag: f32,
        /// Half its height, metres, positive.
        ymag: f32,
    },
}

/// A camera. It looks along -z of its node, +y up.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Name; may be empty.
    pub name: String,
    /// Projection.
    pub projection: Projection,
    /// Radius of the lens, metres; 0 for none: all is sharp.
    pub lens_radius: f32,
    /// Distance along -z that is sharp, metres.
    pub focus_distance: f32,
}

impl Camera {
    /// A pinhole with this vertical field of view in radians.
    pub fn perspective(yfov: f32) -> Self {
        Camera {
            name: String::new(),
            projection: Projection::Perspective { yfov, aspect: None },
            lens_radius: 0.0,
            focus_distance: 1.0,
        }
    }

    /// The transform of a node whose camera stands at `eye` and looks at `target`, +y up in the picture.
    pub fn looking(eye: Vec3, target: Vec3) -> Mat4 {
        let camera = lumbre_core::Camera::look_at(eye, target, Vec3::Y, 1.0, 1.0);
        Mat4::from_cols(
            camera.right.extend(0.0),
            camera.up.extend(0.0),
            -camera.forward.extend(0.0),
            eye.extend(1.0),
        )
    }
}
