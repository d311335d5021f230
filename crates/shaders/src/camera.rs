//! A camera as shaders read it. Twin: `glsl/camera.glsl`.

use bytemuck::{Pod, Zeroable};
use lumbre_core::camera::{Camera, Projection};

/// Values of [`CameraRecord::projection`].
pub mod projection {
    /// All rays pass the eye.
    pub const PERSPECTIVE: u32 = 0;
    /// All rays are parallel.
    pub const ORTHOGRAPHIC: u32 = 1;
}

/// A camera with a thin lens, in world space.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct CameraRecord {
    /// Eye, metres.
    pub origin: [f32; 3],
    /// To the right of the picture, unit.
    pub right: [f32; 3],
    /// To its top, unit.
    pub up: [f32; 3],
    /// Into the scene, unit.
    pub forward: [f32; 3],
    /// One of [`projection`].
    pub projection: u32,
    /// Half the height of the picture: at distance 1 where rays pass the eye, metres where they are parallel.
    pub half_height: f32,
    /// Width over height of the picture.
    pub aspect: f32,
    /// Radius of the lens, metres; 0 is a pinhole.
    pub lens_radius: f32,
    /// Distance along `forward` that is sharp, metres.
    pub focus_distance: f32,
}

impl From<&Camera> for CameraRecord {
    fn from(camera: &Camera) -> Self {
        let (projection, half_height) = match camera.projection {
            Projection::Perspective { tan_half_fov_y } => (projection::PERSPECTIVE, tan_half_fov_y),
            Projection::Orthographic { half_height } => (projection::ORTHOGRAPHIC, half_height),
        };
        CameraRecord {
            origin: camera.origin.to_array(),
            right: camera.right.to_array(),
            up: camera.up.to_array(),
            forward: camera.forward.to_array(),
            projection,
            half_height,
            aspect: camera.aspect,
            lens_radius: camera.lens_radius,
            focus_distance: camera.focus_distance,
        }
    }
}
