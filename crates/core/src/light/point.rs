//! Point light: the same intensity in every direction (`KHR_lights_punctual`).

use super::DeltaSample;
use crate::math::{PI, Vec3};
use crate::rgb::Spectrum;

/// Irradiance `intensity / d²` at `p`; `intensity` in candela. `None` at the light itself.
#[inline]
pub fn sample(position: Vec3, intensity: Spectrum, p: Vec3) -> Option<DeltaSample> {
    let to = position - p;
    let d2 = to.length_squared();
    if !(d2 > 0.0 && d2.is_finite()) {
        return None;
    }
    let distance = d2.sqrt();
    Some(DeltaSample { wi: to / distance, distance, irradiance: intensity * (1.0 / d2) })
}

/// Flux: 4π I.
pub fn power(intensity: Spectrum) -> Spectrum {
    intensity * (4.0 * PI)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ANALYTIC row 20, first half.
    #[test]
    fn hundred_candela_at_two_metres() {
        let s = sample(Vec3::new(0.0, 2.0, 0.0), Spectrum::splat(100.0), Vec3::ZERO).unwrap();
        assert_eq!((s.irradiance.g, s.distance, s.wi), (25.0, 2.0, Vec3::Y));
        assert!(sample(Vec3::ONE, Spectrum::WHITE, Vec3::ONE).is_none());
    }
}
