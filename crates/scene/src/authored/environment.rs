//! Light from infinitely far away.

use lumbre_core::Rgb;

/// A latitude-longitude map of radiance, row 0 at +y. The centre of the map lies at -z, and longitude grows to the right
/// as seen from inside: +x lies a quarter of the width to the right of the centre.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentMap {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` radiances, row by row; finite and not negative.
    pub pixels: Vec<Rgb>,
}

/// What a ray sees that hits nothing.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum Background {
    /// Nothing.
    #[default]
    Black,
    /// The same radiance from everywhere.
    Constant(Rgb),
    /// A plain sky: bright horizon, blue zenith, dull ground.
    Gradient,
    /// A measured or painted map.
    Map(EnvironmentMap),
}

/// A distant disc of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Angle above the horizon, radians.
    pub elevation: f32,
    /// Angle from -z towards +x, radians.
    pub azimuth: f32,
    /// Irradiance on a surface that faces it (lux, in glTF's scale).
    pub irradiance: Rgb,
    /// Half of the disc's angular diameter, radians.
    pub angular_radius: f32,
}

impl Sun {
    /// Half the mean angular diameter of the sun as seen from Earth (0.533°), radians.
    pub const ANGULAR_RADIUS: f32 = 0.004_651;
}

/// All light from far away.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// What fills the sky.
    pub background: Background,
    /// Turns the map about +y, radians; positive moves its content towards +x (to the right, as seen from inside).
    pub rotation: f32,
    /// Factor on the background; 1 leaves it as it is.
    pub strength: f32,
    /// The sun, if any.
    pub sun: Option<Sun>,
}

impl Default for Environment {
    fn default() -> Self {
        Environment { background: Background::Black, rotation: 0.0, strength: 1.0, sun: None }
    }
}
