//! Light from infinitely far away.

use lumbre_core::Rgb;
use std::sync::Arc;

/// A latitude-longitude map of radiance, row 0 at +y. The centre of the map lies at -z, and longitude grows to the right
/// as seen from inside: +x lies a quarter of the width to the right of the centre.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentMap {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` radiances, row by row; finite and not negative. Clones share them.
    pub pixels: Arc<[Rgb]>,
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

    /// Illuminance of the sun beside the gradient sky, whose mean radiance is 1 and which alone gives the ground nearly 4 lux: on a
    /// clear day the sun gives some four to five times as much as the sky.
    pub const STRENGTH: f32 = 15.0;

    /// Colour of the sun's light: a little warmer than the white of the picture (D65), as through some 30 degrees of air; ours.
    pub const COLOR: Rgb = Rgb::new(1.0, 0.93, 0.82);

    /// The sun that flags and scene files ask for: angles in degrees, and the illuminance in lux on a surface that faces it.
    pub fn daylight(elevation_deg: f32, azimuth_deg: f32, strength: f32) -> Sun {
        Sun {
            elevation: elevation_deg.to_radians(),
            // A whole turn is nothing, exactly.
            azimuth: (azimuth_deg % 360.0).to_radians(),
            irradiance: Sun::COLOR * (strength / Sun::COLOR.luminance()),
            angular_radius: Sun::ANGULAR_RADIUS,
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_strength_of_the_sun_is_its_illuminance() {
        let sun = Sun::daylight(90.0, 360.0, 20.0);
        assert!((sun.irradiance.luminance() - 20.0).abs() < 1e-4);
        assert_eq!(sun.azimuth, 0.0);
        assert!((sun.elevation - std::f32::consts::FRAC_PI_2).abs() < 1e-6);
    }
}
