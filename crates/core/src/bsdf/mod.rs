//! Scattering at a surface. One file per model; the local frame has the shading normal at +z.
//!
//! `wo` points to the camera side, `wi` is the sampled side. Both are unit and point away from the surface. The side the ray came
//! from is always +z: callers turn the frame. [`Bsdf`] is the closed form integrators use: the weighted mixture of glTF's
//! metallic-roughness model with transmission, under layers of sheen and varnish.
//!
//! | model | file | choice of direction |
//! |---|---|---|
//! | diffuse | [`lambert`] | cosine |
//! | rough diffuse | [`oren_nayar`] | cosine about the normal and towards the viewer |
//! | diffuse base, both sides | [`diffuse`] | those two, and the cosine on the other side |
//! | gloss of MTL | [`phong`] | power of the cosine about the mirror direction + the base's |
//! | metal | [`metal`] | visible normals + compensation |
//! | opaque dielectric | [`dielectric_base`] | visible normals + cosine |
//! | boundary of a solid | [`dielectric`] | visible normals, Fresnel |
//! | thin wall | [`thin`] | visible normals + compensation, Fresnel |
//! | sheen | [`sheen`] | fitted heights and azimuths |
//! | coat | [`coat`] | visible normals |
//!
//! Two things are shared by the models with facets: anisotropy ([`crate::microfacet`], [`aniso_albedo`]) and the thin film
//! ([`thin_film`]), which replaces the reflectance of a facet.

pub mod albedo;
mod albedo_data;
pub mod aniso_albedo;
#[allow(clippy::approx_constant, reason = "a table meets a constant by chance")]
mod aniso_albedo_deficit;
mod aniso_albedo_schlick;
pub mod coat;
pub mod compensation;
pub mod dielectric;
pub mod dielectric_base;
pub mod diffuse;
pub mod interface;
pub mod lambert;
pub mod layered;
pub mod metal;
pub mod mixture;
pub mod oren_nayar;
mod params;
pub mod phong;
pub mod sheen;
mod sheen_data;
pub mod thin;
pub mod thin_film;

pub use lambert::DiffuseSampling;
pub use layered::Bsdf;
pub use params::{BsdfParams, CoatParams, FilmParams, GlossParams, SheenParams};

use crate::math::Vec3;
use crate::rgb::Spectrum;

/// Which way light is followed: radiance from the camera, or importance-carrying light paths from the lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransportMode {
    /// Paths start at the camera and carry radiance: refraction scales it by (ηi/ηt)².
    Radiance,
    /// Paths start at a light.
    Importance,
}

/// What kind of scattering a sample took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lobe {
    /// Reflection spread over the hemisphere.
    DiffuseReflection,
    /// Diffuse light that leaves on the other side.
    DiffuseTransmission,
    /// Reflection by a rough interface.
    GlossyReflection,
    /// Perfect mirror direction.
    SpecularReflection,
    /// Refraction by a rough interface.
    GlossyTransmission,
    /// Perfect refraction by the smooth boundary of a solid.
    SpecularTransmission,
    /// Straight on through a smooth thin wall: the direction does not change.
    ThinTransmission,
}

impl Lobe {
    /// True for directions chosen from a finite set; `eval` and `pdf` leave these out.
    #[inline]
    pub fn is_delta(self) -> bool {
        matches!(self, Lobe::SpecularReflection | Lobe::SpecularTransmission | Lobe::ThinTransmission)
    }
    /// True when `wi` leaves on the other side of the surface.
    #[inline]
    pub fn is_transmission(self) -> bool {
        matches!(
            self,
            Lobe::DiffuseTransmission
                | Lobe::GlossyTransmission
                | Lobe::SpecularTransmission
                | Lobe::ThinTransmission
        )
    }
}

/// Clamps to [0, 1]; NaN becomes 0.
#[inline]
fn unit_interval(x: f32) -> f32 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

/// A direction drawn by [`Bsdf::sample`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// Local direction, unit.
    pub wi: Vec3,
    /// f · |cos θi| / pdf. For delta lobes the lobe's weight over the probability of having chosen it.
    pub weight: Spectrum,
    /// Density in sr⁻¹, all smooth lobes together. For delta lobes the probability of the choice.
    pub pdf: f32,
    /// The lobe chosen.
    pub lobe: Lobe,
    /// (ηi/ηt)² scaling already inside `weight`: 1 for reflection; roulette divides it out.
    pub eta_scale: f32,
}

impl BsdfSample {
    #[inline]
    fn new(wi: Vec3, weight: Spectrum, pdf: f32, lobe: Lobe) -> Self {
        BsdfSample { wi, weight, pdf, lobe, eta_scale: 1.0 }
    }

    /// From f · |cos θi| and a density; `None` where the density vanishes.
    #[inline]
    fn smooth(wi: Vec3, f: Spectrum, pdf: f32, lobe: Lobe) -> Option<Self> {
        (pdf > 0.0).then(|| BsdfSample::new(wi, f / pdf, pdf, lobe))
    }

    /// From the weight of a delta lobe and the probability of having chosen it.
    #[inline]
    fn delta(wi: Vec3, value: Spectrum, prob: f32, lobe: Lobe) -> Self {
        BsdfSample::new(wi, value / prob, prob, lobe)
    }
}
