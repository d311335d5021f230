//! The GGX distribution of microfacet normals with Smith's masking and shadowing.
//!
//! Sources: Walter et al. 2007 (distribution), Heitz 2014 (anisotropic form, height-correlated masking and shadowing),
//! Heitz 2018 and Dupuy and Benyoub 2023 (sampling the visible normals by a spherical cap). Directions are local, the
//! macroscopic normal at +z. Everything is written so that nothing is divided by a grazing cosine.

use crate::math::{INV_PI, Vec3};
use crate::warp::uniform_cone;

/// Below this width a surface counts as perfectly smooth.
pub const ALPHA_SMOOTH: f32 = 1e-3;

/// A GGX distribution. Both widths at least [`ALPHA_SMOOTH`]; equal ones are the isotropic case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx {
    /// Width along local x.
    pub alpha_x: f32,
    /// Width along local y.
    pub alpha_y: f32,
}

impl Ggx {
    /// The same width in all directions.
    #[inline]
    pub fn isotropic(alpha: f32) -> Self {
        Ggx { alpha_x: alpha, alpha_y: alpha }
    }

    /// `alpha` along y, widened along x by `strength` in (0, 1] towards 1 by its square (KHR_materials_anisotropy). Perfectly smooth only where
    /// both are: then `alpha_x` is below [`ALPHA_SMOOTH`]; a smaller `alpha` beside a rough axis counts as that.
    #[inline]
    pub fn stretched(alpha: f32, strength: f32) -> Self {
        let strength = strength.min(1.0);
        Ggx { alpha_x: alpha + (1.0 - alpha) * strength * strength, alpha_y: alpha.max(ALPHA_SMOOTH) }
    }

    /// True when the widths differ.
    #[inline]
    pub fn is_anisotropic(&self) -> bool {
        self.alpha_x != self.alpha_y
    }

    /// Density of normals D(m) per solid angle and area of the macroscopic surface; `m.z >= 0`. Heitz 2014.
    #[inline]
    pub fn d(&self, m: Vec3) -> f32 {
        let (x, y) = (m.x / self.alpha_x, m.y / self.alpha_y);
        let k = x * x + y * y + m.z * m.z;
        INV_PI / (self.alpha_x * self.alpha_y * k * k)
    }

    /// Length of `w` in the space where the roughness is 1: |cos θ| (1 + 2Λ). Λ is Smith's auxiliary function, Heitz 2014.
    #[inline]
    pub fn stretched_length(&self, w: Vec3) -> f32 {
        let (x, y) = (self.alpha_x * w.x, self.alpha_y * w.y);
        (x * x + y * y + w.z * w.z).sqrt()
    }

    /// Masking G1(w) over |cos θ|: 2 / (|cos θ| + stretched length).
    #[inline]
    pub fn g1_over_cos(&self, w: Vec3) -> f32 {
        2.0 / (w.z.abs() + self.stretched_length(w))
    }

    /// Masking G1(w): the part of the microfacets turned towards `w` that is seen. Heitz 2014.
    #[inline]
    pub fn g1(&self, w: Vec3) -> f32 {
        w.z.abs() * self.g1_over_cos(w)
    }

    /// Height-correlated masking and shadowing of two directions on the same side, over 4 cos θo cos θi. Heitz 2014.
    #[inline]
    pub fn visibility(&self, wo: Vec3, wi: Vec3) -> f32 {
        0.5 / (wi.z * self.stretched_length(wo) + wo.z * self.stretched_length(wi))
    }

    /// A normal seen from `wo` (`wo.z >= 0`), with density [`Ggx::pdf_visible_normal`]. Dupuy and Benyoub 2023; the cap is
    /// filled by a concentric map so that stratified numbers stay stratified.
    #[inline]
    pub fn sample_visible_normal(&self, wo: Vec3, u: [f32; 2]) -> Vec3 {
        let w = Vec3::new(self.alpha_x * wo.x, self.alpha_y * wo.y, wo.z).normalize();
        let h = uniform_cone(u, 1.0 + w.z) + w;
        Vec3::new(self.alpha_x * h.x, self.alpha_y * h.y, h.z.max(1e-9)).normalize()
    }

    /// Density of visible normals, sr⁻¹ around `m`: G1(wo) max(0, wo·m) D(m) / cos θo. Heitz 2014.
    #[inline]
    pub fn pdf_visible_normal(&self, wo: Vec3, m: Vec3) -> f32 {
        self.g1_over_cos(wo) * wo.dot(m).max(0.0) * self.d(m)
    }

    /// Mirror reflection at microfacets with reflectance 1: f · cos θi, and the density of `wi` when the normal is drawn by
    /// [`Ggx::sample_visible_normal`]. `m` is the unit half vector; both directions above the surface.
    #[inline]
    pub fn reflection(&self, wo: Vec3, wi: Vec3, m: Vec3) -> (f32, f32) {
        let d = self.d(m);
        // d ωm / d ωi = 1 / (4 wo·m): Walter et al. 2007, eq. 14.
        let pdf = 0.25 * d * self.g1_over_cos(wo);
        (d * self.visibility(wo, wi) * wi.z, pdf)
    }
}

/// The mirror image of `wo` about the unit normal `m`.
#[inline]
pub fn reflect(wo: Vec3, m: Vec3) -> Vec3 {
    m * (2.0 * wo.dot(m)) - wo
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{PI, sin_cos};

    fn dir(cos: f32, phi: f32) -> Vec3 {
        let s = (1.0 - cos * cos).max(0.0).sqrt();
        let (sp, cp) = sin_cos(phi);
        Vec3::new(s * cp, s * sp, cos)
    }

    #[test]
    fn closed_forms() {
        let g = Ggx::isotropic(0.5);
        assert!((g.d(Vec3::Z) - 1.2732).abs() < 1e-4);
        assert!((g.g1(dir(0.5, 0.3)) - 0.8610).abs() < 1e-4);
    }

    /// The visible normals fill the whole view: their density integrates to 1 (the weak white furnace), also when anisotropic.
    #[test]
    fn weak_furnace() {
        for (g, cos) in [
            (Ggx::isotropic(1.0), 0.3),
            (Ggx::isotropic(0.5), 0.5),
            (Ggx::isotropic(0.1), 0.9),
            (Ggx { alpha_x: 0.2, alpha_y: 0.7 }, 0.4),
        ] {
            let wo = dir(cos, 0.7);
            let (n_z, n_phi) = (2000, 500);
            let mut sum = 0.0f64;
            for i in 0..n_z {
                // z = 1 - s² puts points where narrow lobes need them.
                let s = (i as f32 + 0.5) / n_z as f32;
                for j in 0..n_phi {
                    let m = dir(1.0 - s * s, 2.0 * PI * (j as f32 + 0.5) / n_phi as f32);
                    sum += f64::from(g.pdf_visible_normal(wo, m) * 2.0 * s);
                }
            }
            let integral = sum * 2.0 * std::f64::consts::PI / f64::from(n_z * n_phi);
            assert!((integral - 1.0).abs() < 1e-3, "{g:?} at {cos}: {integral}");
        }
    }

    /// Albedo for reflectance 1 by drawing visible normals, against the published closed table.
    #[test]
    fn single_scattering_albedo() {
        let rows = [
            (1.0, [0.3069, 0.3645, 0.4507, 0.5976, 0.7602]),
            (0.5, [0.6879, 0.6821, 0.6983, 0.7652, 0.8601]),
        ];
        for (alpha, want) in rows {
            let g = Ggx::isotropic(alpha);
            for (cos, want) in [1.0, 0.75, 0.5, 0.25, 0.1].into_iter().zip(want) {
                let wo = dir(cos, 0.0);
                let n = 500;
                let mut sum = 0.0f64;
                for k in 0..n * n {
                    let u = [(k % n) as f32 + 0.5, (k / n) as f32 + 0.5].map(|v| v / n as f32);
                    let m = g.sample_visible_normal(wo, u);
                    let wi = reflect(wo, m);
                    if wi.z > 0.0 {
                        let (f, pdf) = g.reflection(wo, wi, m);
                        sum += f64::from(f / pdf);
                    }
                }
                let e = sum / f64::from(n * n);
                assert!((e - want).abs() < 3e-4, "alpha {alpha} mu {cos}: {e} against {want}");
            }
        }
    }
}
