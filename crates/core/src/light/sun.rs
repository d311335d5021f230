//! The sun: a disc of constant radiance, infinitely far away.

use crate::frame::Frame;
use crate::math::{PI, Vec3, sin_cos, sqr};
use crate::rgb::Spectrum;
use crate::warp::{uniform_cone, uniform_cone_pdf};

/// A distant disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunDisc {
    /// Unit direction to its centre.
    pub direction: Vec3,
    /// 1 - cos of its angular radius.
    pub one_minus_cos: f32,
    /// Its radiance.
    pub radiance: Spectrum,
}

impl SunDisc {
    /// Smallest angular radius, radians: a smaller disc has a density that single precision cannot tell from a point's.
    pub const MIN_ANGULAR_RADIUS: f32 = 1e-4;

    /// A disc that gives `irradiance` on a surface facing it: E = π sin²α L. Its angular radius is brought into
    /// [`SunDisc::MIN_ANGULAR_RADIUS`] to π/2.
    pub fn new(direction: Vec3, angular_radius: f32, irradiance: Spectrum) -> Self {
        let angular_radius = angular_radius.clamp(Self::MIN_ANGULAR_RADIUS, 0.5 * PI);
        let (s, _) = sin_cos(angular_radius);
        let (half, _) = sin_cos(0.5 * angular_radius);
        SunDisc { direction, one_minus_cos: 2.0 * sqr(half), radiance: irradiance * (1.0 / (PI * sqr(s))) }
    }

    /// Direction of elevation and azimuth, radians: azimuth 0 is -z, growing towards +x.
    pub fn direction_of(elevation: f32, azimuth: f32) -> Vec3 {
        let ((se, ce), (sa, ca)) = (sin_cos(elevation), sin_cos(azimuth));
        Vec3::new(ce * sa, se, -ce * ca)
    }

    /// A uniform direction on the disc.
    #[inline]
    pub fn sample(&self, u: [f32; 2]) -> Vec3 {
        Frame::from_normal(self.direction).to_world(uniform_cone(u, self.one_minus_cos))
    }

    /// Density of [`SunDisc::sample`] at `wi`, sr⁻¹; 0 off the disc.
    #[inline]
    pub fn pdf(&self, wi: Vec3) -> f32 {
        if self.contains(wi) { uniform_cone_pdf(self.one_minus_cos) } else { 0.0 }
    }

    /// True on the disc. 1 - cos as |wi - d|²/2, exact for the small angles that count here.
    #[inline]
    pub fn contains(&self, wi: Vec3) -> bool {
        0.5 * (wi - self.direction).length_squared() <= self.one_minus_cos
    }

    /// Flux through the disc that the scene's bounding sphere shows.
    pub fn power(&self, scene_radius: f32) -> Spectrum {
        self.radiance * (2.0 * PI * self.one_minus_cos * PI * sqr(scene_radius))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_lie_on_the_disc_and_give_its_irradiance() {
        let d = SunDisc::direction_of(0.7, 0.4);
        assert!(d.x > 0.0 && d.y > 0.0 && d.z < 0.0 && (d.length() - 1.0).abs() < 1e-6);
        for radius in [0.004_651f32, 0.3] {
            let sun = SunDisc::new(d, radius, Spectrum::splat(5.0));
            let n = 64;
            let mut e = 0.0;
            for i in 0..n * n {
                let u = [((i % n) as f32 + 0.5) / n as f32, ((i / n) as f32 + 0.5) / n as f32];
                let wi = sun.sample(u);
                // The rim itself may round to either side.
                assert!(0.5 * (wi - d).length_squared() <= sun.one_minus_cos * 1.001);
                e += sun.radiance.g * wi.dot(d) / uniform_cone_pdf(sun.one_minus_cos) / (n * n) as f32;
            }
            assert!((e / 5.0 - 1.0).abs() < 1e-3, "{radius}: {e}");
        }
    }
}
