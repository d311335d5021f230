//! Triangle light: one triangle of an emissive surface, in world space.

use crate::math::{PI, Vec3};
use crate::rgb::Spectrum;
use crate::warp::uniform_triangle;

/// Geometry of an emissive triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleLight {
    /// First vertex.
    pub p0: Vec3,
    /// Second vertex less the first.
    pub e1: Vec3,
    /// Third vertex less the first.
    pub e2: Vec3,
}

/// A point drawn on a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleSample {
    /// The point, world space.
    pub point: Vec3,
    /// Barycentric coordinates of the second and third vertex.
    pub barycentrics: [f32; 2],
    /// Unit direction from the shading point.
    pub wi: Vec3,
    /// Distance, metres.
    pub distance: f32,
    /// Density, sr⁻¹.
    pub pdf_solid_angle: f32,
}

impl TriangleLight {
    /// Unit normal by winding times twice the area.
    #[inline]
    pub fn scaled_normal(&self) -> Vec3 {
        self.e1.cross(self.e2)
    }

    /// Area, m².
    pub fn area(&self) -> f32 {
        0.5 * self.scaled_normal().length()
    }

    /// A uniform point of the triangle as seen from `p`; `None` where it is seen edge-on or touches `p`.
    #[inline]
    pub fn sample(&self, p: Vec3, u: [f32; 2]) -> Option<TriangleSample> {
        let [b1, b2] = uniform_triangle(u);
        let point = self.p0 + self.e1 * b1 + self.e2 * b2;
        let to = point - p;
        let d2 = to.length_squared();
        let distance = d2.sqrt();
        let wi = to / distance;
        let pdf_solid_angle = self.pdf_solid_angle(wi, d2);
        (pdf_solid_angle.is_finite() && distance > 0.0).then_some(TriangleSample {
            point,
            barycentrics: [b1, b2],
            wi,
            distance,
            pdf_solid_angle,
        })
    }

    /// Density of [`TriangleLight::sample`] for a point of it seen in direction `wi` at squared distance `d2`:
    /// d² / (A |cos|), infinite edge-on.
    #[inline]
    pub fn pdf_solid_angle(&self, wi: Vec3, d2: f32) -> f32 {
        // The scaled normal has length 2A, so its dot product is 2A cos.
        2.0 * d2 / self.scaled_normal().dot(wi).abs()
    }

    /// Flux of a triangle of this mean radiance: π A L for each side that emits.
    pub fn power(&self, radiance: Spectrum, sides: f32) -> Spectrum {
        radiance * (PI * self.area() * sides)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ANALYTIC row 11: irradiance of a 2x2 rectangle at height 1, and row 17: its solid angle, by stratified sums.
    #[test]
    fn rectangle_irradiance_and_solid_angle() {
        let corner = |x: f32, z: f32| Vec3::new(x, 1.0, z);
        let halves = [
            TriangleLight { p0: corner(-1.0, -1.0), e1: Vec3::X * 2.0, e2: Vec3::new(2.0, 0.0, 2.0) },
            TriangleLight { p0: corner(-1.0, -1.0), e1: Vec3::new(2.0, 0.0, 2.0), e2: Vec3::Z * 2.0 },
        ];
        let (mut e, mut omega) = (0.0f64, 0.0f64);
        let n = 256;
        for t in &halves {
            for i in 0..n * n {
                let u = [((i % n) as f32 + 0.5) / n as f32, ((i / n) as f32 + 0.5) / n as f32];
                let s = t.sample(Vec3::ZERO, u).unwrap();
                e += f64::from(s.wi.y / s.pdf_solid_angle) / f64::from(n * n);
                omega += f64::from(1.0 / s.pdf_solid_angle) / f64::from(n * n);
            }
        }
        assert!((e - 1.7408).abs() < 2e-4, "{e}");
        assert!((omega - 2.0944).abs() < 2e-4, "{omega}");
    }
}
