//! Spot light with the falloff that `KHR_lights_punctual` recommends: the square of a linear ramp in the cosine.

use super::{DeltaSample, point};
use crate::math::{PI, Vec3};
use crate::rgb::Spectrum;

/// A cone of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Unit axis, the way the light travels.
    pub axis: Vec3,
    /// Cosine of the angle at which the falloff begins.
    pub cos_inner: f32,
    /// Cosine of the angle at which it ends.
    pub cos_outer: f32,
}

impl Cone {
    /// Share of the intensity at a cosine from the axis, 0 to 1.
    #[inline]
    pub fn falloff(&self, cos_angle: f32) -> f32 {
        let ramp = (cos_angle - self.cos_outer) / (self.cos_inner - self.cos_outer).max(0.001);
        let ramp = ramp.clamp(0.0, 1.0);
        ramp * ramp
    }

    /// ∫ falloff dω, sr: the ramp's square integrates to a third over the rim.
    pub fn solid_angle(&self) -> f32 {
        let rim = (self.cos_inner - self.cos_outer).max(0.001);
        let top = (self.cos_outer + rim).min(1.0);
        let share = (top - self.cos_outer) / rim;
        2.0 * PI * ((1.0 - top).max(0.0) + rim * share * share * share / 3.0)
    }
}

/// Irradiance at `p`; `None` outside the cone.
#[inline]
pub fn sample(position: Vec3, intensity: Spectrum, cone: &Cone, p: Vec3) -> Option<DeltaSample> {
    let s = point::sample(position, intensity, p)?;
    let falloff = cone.falloff(-s.wi.dot(cone.axis));
    (falloff > 0.0).then(|| DeltaSample { irradiance: s.irradiance * falloff, ..s })
}

/// Flux.
pub fn power(intensity: Spectrum, cone: &Cone) -> Spectrum {
    intensity * cone.solid_angle()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn falloff_ends_where_it_should_and_integrates_to_its_solid_angle() {
        let cone = Cone { axis: Vec3::NEG_Y, cos_inner: 0.9, cos_outer: 0.6 };
        assert_eq!((cone.falloff(0.95), cone.falloff(0.5)), (1.0, 0.0));
        assert!((cone.falloff(0.75) - 0.25).abs() < 1e-6);
        let n = 10_000;
        let sum: f32 = (0..n).map(|i| cone.falloff((i as f32 + 0.5) / n as f32)).sum();
        assert!((sum / n as f32 * 2.0 * PI / cone.solid_angle() - 1.0).abs() < 1e-3);
        assert!(sample(Vec3::Y, Spectrum::WHITE, &cone, Vec3::ZERO).is_some());
        assert!(sample(Vec3::Y, Spectrum::WHITE, &cone, Vec3::new(0.0, 2.0, 0.0)).is_none());
    }
}
