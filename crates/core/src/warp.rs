//! Maps from the unit square to directions and areas, with their densities.

use crate::math::{INV_PI, ONE_MINUS_EPSILON, PI, Vec3, safe_sqrt, sin_cos};

/// Concentric map of the unit square to the unit disk, area preserving; density 1/π.
/// Shirley and Chiu 1997.
#[inline]
pub fn concentric_disk(u: [f32; 2]) -> [f32; 2] {
    let (x, y) = (2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0);
    if x == 0.0 && y == 0.0 {
        return [0.0, 0.0];
    }
    let (r, phi) =
        if x.abs() > y.abs() { (x, PI / 4.0 * (y / x)) } else { (y, PI / 2.0 - PI / 4.0 * (x / y)) };
    let (s, c) = sin_cos(phi);
    [r * c, r * s]
}

/// Cosine-weighted direction about +z by Malley's method: a point of the disk, lifted.
#[inline]
pub fn cosine_hemisphere(u: [f32; 2]) -> Vec3 {
    let [x, y] = concentric_disk(u);
    Vec3::new(x, y, safe_sqrt(1.0 - x * x - y * y))
}

/// Density of [`cosine_hemisphere`], sr⁻¹.
#[inline]
pub fn cosine_hemisphere_pdf(cos_theta: f32) -> f32 {
    cos_theta.max(0.0) * INV_PI
}

/// Uniform direction about +z.
#[inline]
pub fn uniform_hemisphere(u: [f32; 2]) -> Vec3 {
    let z = 1.0 - u[0];
    let r = safe_sqrt(1.0 - z * z);
    let (s, c) = sin_cos(2.0 * PI * u[1]);
    Vec3::new(r * c, r * s, z)
}

/// Density of [`uniform_hemisphere`], sr⁻¹.
pub const UNIFORM_HEMISPHERE_PDF: f32 = 0.5 * INV_PI;

/// Uniform direction on the sphere.
#[inline]
pub fn uniform_sphere(u: [f32; 2]) -> Vec3 {
    let z = 1.0 - 2.0 * u[0];
    let r = safe_sqrt(1.0 - z * z);
    let (s, c) = sin_cos(2.0 * PI * u[1]);
    Vec3::new(r * c, r * s, z)
}

/// Uniform direction in the cone of half-angle θmax about +z, given 1 - cos θmax (exact for small cones).
#[inline]
pub fn uniform_cone(u: [f32; 2], one_minus_cos_max: f32) -> Vec3 {
    // The disk's radius² is uniform, so it stands in for u: concentric, so that stratification survives.
    let [x, y] = concentric_disk(u);
    let r2 = x * x + y * y;
    let h = r2 * one_minus_cos_max; // 1 - cos θ
    let scale = safe_sqrt(one_minus_cos_max * (2.0 - h)); // sin θ / r
    Vec3::new(x * scale, y * scale, 1.0 - h)
}

/// Density of [`uniform_cone`], sr⁻¹.
#[inline]
pub fn uniform_cone_pdf(one_minus_cos_max: f32) -> f32 {
    0.5 * INV_PI / one_minus_cos_max
}

/// Barycentric coordinates (b1, b2) uniform over a triangle, with low distortion.
/// Heitz 2019, "A Low-Distortion Map Between Triangle and Square".
#[inline]
pub fn uniform_triangle(u: [f32; 2]) -> [f32; 2] {
    let (mut b1, mut b2);
    if u[1] > u[0] {
        b1 = u[0] * 0.5;
        b2 = u[1] - b1;
    } else {
        b2 = u[1] * 0.5;
        b1 = u[0] - b2;
    }
    b1 = b1.clamp(0.0, ONE_MINUS_EPSILON);
    b2 = b2.clamp(0.0, 1.0 - b1);
    [b1, b2]
}
