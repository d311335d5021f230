//! The interface over the diffuse base of an opaque dielectric: what it reflects, and what it leaves to the base.
//!
//! Plain, it reflects f0 + (f90 - f0)(1 - wo·m)⁵ (glTF appendix B, KHR_materials_specular), so its albedo E is known exactly
//! from two tables ([`super::albedo`], [`super::aniso_albedo`]). A thin film ([`super::thin_film`]) follows no such law: over a rough
//! interface its albedo is taken as that of reflectance 1 times the mean over five visible facets, plus a margin, so that with the
//! base beneath it nothing gains light. A white base under a film of index 1.2 to 2.4 and up to 1200 nm returns between 0.92 and 1.005 in the
//! band of which the film reflects most (smooth: 0.995 to 1.003; tested: testkit `bsdf/films`).

use super::albedo::Directional;
use super::compensation::Rough;
use super::thin_film::{self, ThinFilm};
use crate::fresnel::{SCHLICK_AVERAGE, schlick};
use crate::math::{PI, Vec3, sin_cos};
use crate::microfacet::{Ggx, reflect};
use crate::rgb::Spectrum;

/// Azimuths over which a film on an anisotropic interface is averaged, in a quarter turn.
const AZIMUTHS: u32 = 4;

/// A dielectric interface, smooth or rough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interface {
    f0: Spectrum,
    f90: f32,
    /// Largest band of `f0`.
    f0_max: f32,
    /// Mean of `f0` over the bands.
    f0_mean: f32,
    film: Option<ThinFilm>,
    rough: Option<Rough>,
}

/// Points of the unit square, a lattice, at which visible facets are drawn to average a film.
const FACETS: [[f32; 2]; 5] = [[0.1, 0.1], [0.3, 0.5], [0.5, 0.9], [0.7, 0.3], [0.9, 0.7]];

/// Added to the mean over [`FACETS`]: what it lacks at most, and a little.
const MARGIN: f32 = 0.015;

/// How the light of one direction is shared out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shares {
    /// Reflected by the interface, mean over the bands: for choosing the lobe.
    pub reflected: f32,
    /// Left to what lies beneath: 1 less the largest band of the albedo.
    pub passed: f32,
}

impl Interface {
    /// Nothing there.
    pub const NONE: Interface =
        Interface { f0: Spectrum::BLACK, f90: 0.0, f0_max: 0.0, f0_mean: 0.0, film: None, rough: None };

    /// `f0` at normal incidence, in [0, 1], before `strength`, which scales everything and is the reflectance at grazing incidence; `film` over
    /// `f0`; `rough` is `None` for a smooth interface.
    #[inline]
    pub fn new(f0: Spectrum, strength: f32, film: Option<ThinFilm>, rough: Option<Rough>) -> Self {
        let f0 = f0 * strength;
        Interface { f0, f90: strength, f0_max: f0.max_component(), f0_mean: f0.average(), film, rough }
    }

    /// True when it is not there.
    #[inline]
    pub fn is_none(&self) -> bool {
        self.f90 == 0.0
    }

    /// The microfacets, unless it is smooth.
    #[inline]
    pub fn rough(&self) -> Option<&Rough> {
        self.rough.as_ref()
    }

    /// Reflectance at one facet.
    #[inline]
    pub fn reflectance(&self, cos: f32) -> Spectrum {
        let plain = schlick(self.f0, self.f90, cos);
        match &self.film {
            None => plain,
            // The strength counts for plain and filmed alike.
            Some(film) => film.reflectance(plain / self.f90, cos) * self.f90,
        }
    }

    /// How it shares out the light towards `w`, on either side.
    #[inline]
    pub fn shares(&self, w: Vec3) -> Shares {
        let at = match &self.rough {
            Some(rough) => rough.albedo.directional(w),
            None => Directional::smooth(w.z.abs()),
        };
        match &self.film {
            None => Shares {
                reflected: at.reflected(self.f0_mean, self.f90),
                passed: at.passed(self.f0_max, self.f90),
            },
            Some(_) => self.shares_of_film(at, w),
        }
    }

    #[inline(never)]
    fn shares_of_film(&self, at: Directional, w: Vec3) -> Shares {
        let w = Vec3::new(w.x, w.y, w.z.abs());
        let (f, most) = match &self.rough {
            None => {
                let f = self.reflectance(w.z);
                (f, f.max_component())
            }
            Some(rough) => {
                let f = self.mean_over_facets(&rough.ggx, w);
                (f, (f.max_component() + MARGIN).min(1.0))
            }
        };
        let kept = 1.0 - at.deficit;
        Shares { reflected: kept * f.average(), passed: at.deficit + kept * (1.0 - most) }
    }

    /// Reflectance at visible facets, by what each reflects.
    fn mean_over_facets(&self, ggx: &Ggx, w: Vec3) -> Spectrum {
        let (mut sum, mut weights) = (Spectrum::BLACK, 0.0);
        for u in FACETS {
            let m = ggx.sample_visible_normal(w, u);
            let wi = reflect(w, m);
            if wi.z > 0.0 {
                // G2/G1, Heitz 2018.
                let weight = wi.z * (w.z + ggx.stretched_length(w)) * 2.0 * ggx.visibility(w, wi);
                sum += self.reflectance(w.dot(m)) * weight;
                weights += weight;
            }
        }
        if weights > 0.0 { sum / weights } else { self.reflectance(w.z) }
    }

    /// What it passes, averaged over the hemisphere with the cosine.
    #[inline]
    pub fn average_passed(&self) -> f32 {
        match &self.film {
            None => self.average().passed(self.f0_max, self.f90),
            Some(_) => self.average_passed_by_film(),
        }
    }

    #[inline(never)]
    fn average_passed_by_film(&self) -> f32 {
        let azimuths = if self.rough.is_some_and(|rough| rough.ggx.is_anisotropic()) { AZIMUTHS } else { 1 };
        let mut sum = 0.0;
        for (cos, weight) in thin_film::AVERAGE {
            let sin = (1.0 - cos * cos).sqrt();
            for k in 0..azimuths {
                let (s, c) = sin_cos(0.5 * PI * (k as f32 + 0.5) / azimuths as f32);
                sum += weight / azimuths as f32 * self.shares(Vec3::new(sin * c, sin * s, cos)).passed;
            }
        }
        sum
    }

    /// Hemispherical albedo.
    pub fn albedo(&self) -> Spectrum {
        let average = self.average();
        match &self.film {
            None => self.f0.map(|f0| average.reflected(f0, self.f90)),
            Some(_) => thin_film::average(|cos| self.reflectance(cos)) * (1.0 - average.deficit),
        }
    }

    #[inline]
    fn average(&self) -> Directional {
        match &self.rough {
            Some(rough) => rough.albedo.average(),
            None => Directional { deficit: 0.0, schlick: SCHLICK_AVERAGE },
        }
    }
}
