//! Punctual lights (`KHR_lights_punctual`). Emissive surfaces are materials; the sky is the environment.

use lumbre_core::Rgb;

/// Shape of a punctual light; it shines along -z of its node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Equal in every direction; colour × intensity in candela.
    Point,
    /// A cone; colour × intensity in candela.
    Spot {
        /// Angle from the axis at which the falloff begins, radians.
        inner_angle: f32,
        /// Angle from the axis at which it ends, radians.
        outer_angle: f32,
    },
    /// Parallel light; colour × intensity in lux.
    Directional,
}

/// A punctual light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Name; may be empty.
    pub name: String,
    /// Kind.
    pub kind: LightKind,
    /// Colour × intensity, candela or lux by kind.
    pub intensity: Rgb,
}
