//! Materials in glTF's terms: metallic-roughness and the extensions this version draws.

use crate::TextureId;
use lumbre_core::Rgb;

/// `KHR_texture_transform`: uv' = translate · rotate · scale · uv.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureTransform {
    /// Offset in uv units.
    pub offset: [f32; 2],
    /// Rotation about the origin, radians, counter-clockwise as the extension defines it.
    pub rotation: f32,
    /// Scale.
    pub scale: [f32; 2],
}

impl Default for TextureTransform {
    fn default() -> Self {
        TextureTransform { offset: [0.0; 2], rotation: 0.0, scale: [1.0; 2] }
    }
}

/// Use of a texture by a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureRef {
    /// Which texture.
    pub texture: TextureId,
    /// Which set of texture coordinates: 0 or 1.
    pub uv_set: u32,
    /// Transform of the coordinates.
    pub transform: TextureTransform,
}

impl From<TextureId> for TextureRef {
    fn from(texture: TextureId) -> Self {
        TextureRef { texture, uv_set: 0, transform: TextureTransform::default() }
    }
}

/// What the alpha of a material means.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum AlphaMode {
    /// Alpha is ignored.
    #[default]
    Opaque,
    /// There where alpha is at least the cutoff, absent elsewhere.
    Mask {
        /// The cutoff.
        cutoff: f32,
    },
    /// Alpha is the probability that a ray finds the surface.
    Blend,
}

/// `KHR_materials_volume`: the inside of a transmissive material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Volume {
    /// Thickness, metres. 0 means a thin wall; anything more a solid bounded by the mesh, through which rays really travel.
    pub thickness: f32,
    /// Colour that white light has after `attenuation_distance`.
    pub attenuation_color: Rgb,
    /// Metres; infinite means no absorption.
    pub attenuation_distance: f32,
}

/// `KHR_materials_clearcoat`: a clear varnish of index 1.5 over everything else.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearcoat {
    /// Strength, 0 to 1.
    pub factor: f32,
    /// Linear; its red multiplies it.
    pub texture: Option<TextureRef>,
    /// Perceptual roughness, 0 to 1.
    pub roughness: f32,
    /// Linear; its green multiplies it.
    pub roughness_texture: Option<TextureRef>,
    /// Normal map of the coat alone; without it the coat follows the geometry, not the normal map beneath.
    pub normal_texture: Option<TextureRef>,
    /// Factor on its x and y.
    pub normal_scale: f32,
}

/// `KHR_materials_sheen`: fibres that shine at grazing angles, under the coat and over the rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheen {
    /// Linear colour; black is no sheen.
    pub color: Rgb,
    /// sRGB; multiplies it.
    pub color_texture: Option<TextureRef>,
    /// Perceptual roughness, 0 to 1.
    pub roughness: f32,
    /// Linear; its alpha multiplies it.
    pub roughness_texture: Option<TextureRef>,
}

/// `KHR_materials_anisotropy`: microfacets wider along one direction of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anisotropy {
    /// 0 to 1.
    pub strength: f32,
    /// Direction of the widening: angle from the tangent, radians, counter-clockwise.
    pub rotation: f32,
    /// Linear; red and green are a direction in tangent space (0..1 for -1..1), blue multiplies the strength.
    pub texture: Option<TextureRef>,
}

/// `KHR_materials_iridescence`: a film as thin as a wavelength over the base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iridescence {
    /// Strength, 0 to 1.
    pub factor: f32,
    /// Linear; its red multiplies it.
    pub texture: Option<TextureRef>,
    /// Index of refraction of the film.
    pub ior: f32,
    /// Thickness where the texture is 0, nanometres.
    pub thickness_min_nm: f32,
    /// Thickness where it is 1, and where there is none, nanometres.
    pub thickness_max_nm: f32,
    /// Linear; its green chooses between them.
    pub thickness_texture: Option<TextureRef>,
}

/// `KHR_materials_diffuse_transmission`: a share of the diffuse base that leaves on the other side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffuseTransmission {
    /// The share, 0 to 1.
    pub factor: f32,
    /// Linear; its alpha multiplies it.
    pub texture: Option<TextureRef>,
    /// Linear colour of what passes.
    pub color: Rgb,
    /// sRGB; multiplies it.
    pub color_texture: Option<TextureRef>,
}

/// The glossy part of an MTL material. It takes the place of the dielectric's reflection, over a diffuse base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong {
    /// Linear reflectance at normal incidence.
    pub specular: Rgb,
    /// sRGB; multiplies it.
    pub specular_texture: Option<TextureRef>,
    /// Exponent of the cosine; infinite is a mirror.
    pub exponent: f32,
    /// The reflectance rises to 1 at grazing angles (Schlick).
    pub fresnel: bool,
}

/// A surface. The defaults are glTF's, but for `metallic`, which is 0 here (loaders of glTF set 1).
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name; may be empty.
    pub name: String,
    /// Linear base colour.
    pub base_color: Rgb,
    /// Alpha, 0 to 1.
    pub alpha: f32,
    /// sRGB colour and linear alpha that multiply them.
    pub base_color_texture: Option<TextureRef>,
    /// 0 dielectric, 1 metal.
    pub metallic: f32,
    /// Perceptual roughness, 0 to 1; α is its square.
    pub roughness: f32,
    /// Linear; green multiplies roughness, blue metallic.
    pub metallic_roughness_texture: Option<TextureRef>,
    /// Tangent-space normal map, linear.
    pub normal_texture: Option<TextureRef>,
    /// Factor on its x and y.
    pub normal_scale: f32,
    /// Emitted radiance, W·sr⁻¹·m⁻² in glTF's scale (nits); `KHR_materials_emissive_strength` is already in it.
    pub emission: Rgb,
    /// sRGB; multiplies it.
    pub emissive_texture: Option<TextureRef>,
    /// What alpha means.
    pub alpha_mode: AlphaMode,
    /// Both sides are drawn and emit. Otherwise the back is invisible to camera rays and emits nothing.
    pub double_sided: bool,
    /// `KHR_materials_unlit`: shows its base colour as it is.
    pub unlit: bool,
    /// Index of refraction, at least 1 (0 is `KHR_materials_ior`'s way of asking for full reflection).
    pub ior: f32,
    /// `KHR_materials_specular` factor.
    pub specular: f32,
    /// Linear; its alpha multiplies it.
    pub specular_texture: Option<TextureRef>,
    /// Linear colour of the dielectric's reflection at normal incidence.
    pub specular_color: Rgb,
    /// sRGB; multiplies it.
    pub specular_color_texture: Option<TextureRef>,
    /// `KHR_materials_transmission` factor.
    pub transmission: f32,
    /// Linear; its red multiplies it.
    pub transmission_texture: Option<TextureRef>,
    /// `KHR_materials_volume`; `None` is a thin wall.
    pub volume: Option<Volume>,
    /// `KHR_materials_dispersion`: 20 over the Abbe number; 0 refracts all colours alike.
    pub dispersion: f32,
    /// Roughness of the diffuse base, 0 to 1 (Oren-Nayar); the green of `metallic_roughness_texture` multiplies it. 0 is Lambert.
    pub diffuse_roughness: f32,
    /// Light that leaves the diffuse base on the other side.
    pub diffuse_transmission: Option<DiffuseTransmission>,
    /// Stretched microfacets.
    pub anisotropy: Option<Anisotropy>,
    /// A thin film.
    pub iridescence: Option<Iridescence>,
    /// Fibres.
    pub sheen: Option<Sheen>,
    /// Varnish.
    pub clearcoat: Option<Clearcoat>,
    /// The gloss of an MTL material.
    pub phong: Option<Phong>,
    /// Shows what is behind it, darkened by the shadows that fall on it, to camera rays; a plain surface to all others.
    pub shadow_catcher: bool,
}

impl Default for Material {
    fn default() -> Self {
        Material {
            name: String::new(),
            base_color: Rgb::WHITE,
            alpha: 1.0,
            base_color_texture: None,
            metallic: 0.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            normal_texture: None,
            normal_scale: 1.0,
            emission: Rgb::BLACK,
            emissive_texture: None,
            alpha_mode: AlphaMode::Opaque,
            double_sided: false,
            unlit: false,
            ior: 1.5,
            specular: 1.0,
            specular_texture: None,
            specular_color: Rgb::WHITE,
            specular_color_texture: None,
            transmission: 0.0,
            transmission_texture: None,
            volume: None,
            dispersion: 0.0,
            diffuse_roughness: 0.0,
            diffuse_transmission: None,
            anisotropy: None,
            iridescence: None,
            sheen: None,
            clearcoat: None,
            phong: None,
            shadow_catcher: false,
        }
    }
}

impl Material {
    /// A two-sided Lambert surface.
    pub fn diffuse(albedo: Rgb) -> Self {
        Material { base_color: albedo, specular: 0.0, double_sided: true, ..Material::default() }
    }
    /// A two-sided metal of this colour and roughness; roughness 0 is a mirror.
    pub fn metal(color: Rgb, roughness: f32) -> Self {
        Material { base_color: color, metallic: 1.0, roughness, double_sided: true, ..Material::default() }
    }
    /// Clear solid glass.
    pub fn glass(ior: f32, roughness: f32) -> Self {
        let volume =
            Volume { thickness: 1.0, attenuation_color: Rgb::WHITE, attenuation_distance: f32::INFINITY };
        Material { transmission: 1.0, roughness, ior, volume: Some(volume), ..Material::default() }
    }
    /// A black surface that emits this radiance; two-sided if asked.
    pub fn emitter(radiance: Rgb, double_sided: bool) -> Self {
        Material {
            base_color: Rgb::BLACK,
            specular: 0.0,
            emission: radiance,
            double_sided,
            ..Material::default()
        }
    }
}
