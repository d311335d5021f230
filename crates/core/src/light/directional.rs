//! Directional light: parallel rays (`KHR_lights_punctual`).

use super::DeltaSample;
use crate::math::{PI, Vec3, sqr};
use crate::rgb::Spectrum;

/// The same everywhere: `irradiance` in lux on a surface that faces it, travelling along the unit vector `travel`.
#[inline]
pub fn sample(travel: Vec3, irradiance: Spectrum) -> DeltaSample {
    DeltaSample { wi: -travel, distance: f32::INFINITY, irradiance }
}

/// Flux through the disc that the scene's bounding sphere shows.
pub fn power(irradiance: Spectrum, scene_radius: f32) -> Spectrum {
    irradiance * (PI * sqr(scene_radius))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ANALYTIC row 20, second half: 1 lx at 60° gives half a lux.
    #[test]
    fn one_lux_at_sixty_degrees() {
        let travel = Vec3::new(3f32.sqrt() / 2.0, -0.5, 0.0);
        let s = sample(travel, Spectrum::WHITE);
        assert!((s.irradiance.g * s.wi.dot(Vec3::Y) - 0.5).abs() < 1e-6);
    }
}
