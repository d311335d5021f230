//! What a material says at one point: the parameters of [`super::Bsdf`].

use super::lambert::DiffuseSampling;
use crate::math::Vec3;
use crate::rgb::Spectrum;

/// The values of a material at one point. Factors are clamped to [0, 1]; NaN counts as 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfParams {
    /// Diffuse albedo, metal reflectance at normal incidence, tint of what is transmitted.
    pub base_color: Spectrum,
    /// 0 dielectric, 1 metal.
    pub metallic: f32,
    /// Perceptual: α = roughness².
    pub roughness: f32,
    /// Index of refraction for the reflection of the opaque base and for thin walls; 0 stands for infinite.
    pub ior: f32,
    /// Strength of the opaque base's reflection; 0 leaves exact Lambert.
    pub specular: f32,
    /// Tint of the opaque base's reflection at normal incidence, may exceed 1.
    pub specular_color: Spectrum,
    /// Share of the base that is replaced by transmission.
    pub transmission: f32,
    /// Thin wall rather than the boundary of a solid.
    pub thin: bool,
    /// For solids: index on the far side over index on the side of the ray.
    pub eta: f32,
    /// For solids: the ray comes from inside. Sheen and coat lie on the outside.
    pub inside: bool,
    /// For solids that disperse: the index ratio by which Fresnel's law shares the light out, where that is not `eta`. Both are at
    /// least 1 then.
    pub eta_fresnel: Option<f32>,
    /// How diffuse directions are drawn.
    pub diffuse_sampling: DiffuseSampling,
    /// Roughness of the diffuse base; 0 is Lambert.
    pub diffuse_roughness: f32,
    /// Share of the diffuse base that leaves on the other side.
    pub diffuse_transmission: f32,
    /// Colour of that share.
    pub diffuse_transmission_color: Spectrum,
    /// Stretches the microfacets along the local x axis (KHR_materials_anisotropy).
    pub anisotropy: f32,
    /// A thin film on the metal, the base and the transmissive interface.
    pub film: Option<FilmParams>,
    /// The gloss of an MTL material, in place of the base's dielectric interface.
    pub gloss: Option<GlossParams>,
    /// Fibres over all of the above.
    pub sheen: Option<SheenParams>,
    /// Varnish over the sheen.
    pub coat: Option<CoatParams>,
}

/// A thin film (KHR_materials_iridescence).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmParams {
    /// Share of the interface that the film covers.
    pub factor: f32,
    /// Its index of refraction.
    pub ior: f32,
    /// Its thickness, nanometres.
    pub thickness_nm: f32,
}

/// An energy-normalised Phong lobe or a mirror over the diffuse base (MTL).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlossParams {
    /// Reflectance at normal incidence.
    pub specular: Spectrum,
    /// Exponent of the cosine; infinite is a mirror.
    pub exponent: f32,
    /// The reflectance rises to 1 at grazing angles (Schlick).
    pub fresnel: bool,
}

/// Fibres (KHR_materials_sheen).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheenParams {
    /// Colour.
    pub color: Spectrum,
    /// Perceptual roughness.
    pub roughness: f32,
}

/// Varnish of index 1.5 (KHR_materials_clearcoat).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoatParams {
    /// Strength.
    pub factor: f32,
    /// Perceptual roughness.
    pub roughness: f32,
    /// Its own normal in the local frame of the surface, unit; +z without a normal map of its own.
    pub normal: Vec3,
}

impl BsdfParams {
    /// True when the opaque base is Lambert's with nothing over it.
    #[inline]
    pub(super) fn is_plain_lambert(&self) -> bool {
        self.specular <= 0.0
            && self.diffuse_roughness <= 0.0
            && self.diffuse_transmission <= 0.0
            && self.gloss.is_none()
    }
}

impl Default for BsdfParams {
    /// A rough white dielectric with index 1.5, opaque.
    fn default() -> Self {
        BsdfParams {
            base_color: Spectrum::WHITE,
            metallic: 0.0,
            roughness: 1.0,
            ior: 1.5,
            specular: 1.0,
            specular_color: Spectrum::WHITE,
            transmission: 0.0,
            thin: true,
            eta: 1.5,
            inside: false,
            eta_fresnel: None,
            diffuse_sampling: DiffuseSampling::Cosine,
            diffuse_roughness: 0.0,
            diffuse_transmission: 0.0,
            diffuse_transmission_color: Spectrum::WHITE,
            anisotropy: 0.0,
            film: None,
            gloss: None,
            sheen: None,
            coat: None,
        }
    }
}
