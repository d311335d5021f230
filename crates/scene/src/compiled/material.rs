//! Records of materials.

use super::NONE;
use bytemuck::{Pod, Zeroable};
use lumbre_core::Rgb;

/// Bits of [`MaterialRecord::flags`].
pub mod flag {
    /// Both sides are drawn and emit.
    pub const DOUBLE_SIDED: u32 = 1;
    /// Shows its base colour as it is.
    pub const UNLIT: u32 = 2;
    /// Alpha below the cutoff is absent.
    pub const ALPHA_MASK: u32 = 4;
    /// Alpha is the probability of being there.
    pub const ALPHA_BLEND: u32 = 8;
    /// Transmission enters a solid instead of crossing a thin wall.
    pub const SOLID: u32 = 16;
    /// Its emission is not zero everywhere.
    pub const EMISSIVE: u32 = 32;
    /// Catches shadows.
    pub const SHADOW_CATCHER: u32 = 64;
    /// Its gloss is that of an MTL material: `LobesRecord::phong_…`.
    pub const PHONG: u32 = 128;
    /// Its Phong reflectance rises to 1 at grazing angles.
    pub const PHONG_FRESNEL: u32 = 256;
    /// Part of its diffuse light leaves on the other side.
    pub const DIFFUSE_TRANSMISSION: u32 = 512;
    /// Its refraction depends on the wavelength.
    pub const DISPERSION: u32 = 1024;
}

/// How a material uses a texture.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TextureUse {
    /// Which of `textures`, or [`NONE`].
    pub texture: u32,
    /// Which set of coordinates.
    pub uv_set: u32,
    /// Rows of the 2x3 matrix that transforms them.
    pub transform: [[f32; 3]; 2],
}

impl Default for TextureUse {
    fn default() -> Self {
        TextureUse { texture: NONE, uv_set: 0, transform: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] }
    }
}

impl TextureUse {
    /// True when there is no texture.
    #[inline]
    pub fn is_none(&self) -> bool {
        self.texture == NONE
    }
    /// Transformed coordinates.
    #[inline]
    pub fn uv(&self, uv: &[[f32; 2]; 2]) -> [f32; 2] {
        let [u, v] = uv[self.uv_set as usize];
        self.transform.map(|r| r[0] * u + r[1] * v + r[2])
    }
}

/// A material. Fields mean what they mean in [`crate::Material`].
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MaterialRecord {
    /// Base colour.
    pub base_color: Rgb,
    /// Alpha.
    pub alpha: f32,
    /// Emitted radiance.
    pub emission: Rgb,
    /// Alpha cutoff.
    pub alpha_cutoff: f32,
    /// Specular colour.
    pub specular_color: Rgb,
    /// Specular factor.
    pub specular: f32,
    /// Absorption inside a solid, m⁻¹.
    pub absorption: Rgb,
    /// Index of refraction.
    pub ior: f32,
    /// 0 dielectric, 1 metal.
    pub metallic: f32,
    /// Perceptual roughness.
    pub roughness: f32,
    /// Transmission.
    pub transmission: f32,
    /// Factor on the normal map.
    pub normal_scale: f32,
    /// Bits of [`flag`].
    pub flags: u32,
    /// Which of `CompiledScene::lobes`, or [`NONE`] for a material that has only what stands here.
    pub lobes: u32,
    /// sRGB colour, linear alpha.
    pub base_color_texture: TextureUse,
    /// G roughness, B metallic.
    pub metallic_roughness_texture: TextureUse,
    /// Normal map.
    pub normal_texture: TextureUse,
    /// sRGB.
    pub emissive_texture: TextureUse,
    /// A.
    pub specular_texture: TextureUse,
    /// sRGB.
    pub specular_color_texture: TextureUse,
    /// R.
    pub transmission_texture: TextureUse,
}

impl MaterialRecord {
    /// True when this bit is set.
    #[inline]
    pub fn has(&self, flag: u32) -> bool {
        self.flags & flag != 0
    }
    /// True when a ray may miss the surface where it meets the triangle.
    #[inline]
    pub fn has_coverage(&self) -> bool {
        self.has(flag::ALPHA_MASK | flag::ALPHA_BLEND)
    }
    /// True when it stops every ray that meets it.
    #[inline]
    pub fn is_opaque(&self) -> bool {
        !self.has_coverage() && self.transmission == 0.0
    }
    /// True when camera rays do not see its back.
    #[inline]
    pub fn culls_back_faces(&self) -> bool {
        !self.has(flag::DOUBLE_SIDED | flag::DIFFUSE_TRANSMISSION) && self.transmission == 0.0
    }
}

/// What only some materials have. Fields mean what they mean in [`crate::Material`] and its parts; a factor of 0 switches a part off.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LobesRecord {
    /// Coat.
    pub coat: f32,
    /// Its perceptual roughness.
    pub coat_roughness: f32,
    /// Factor on its normal map.
    pub coat_normal_scale: f32,
    /// Perceptual roughness of the sheen.
    pub sheen_roughness: f32,
    /// Its colour; black for none.
    pub sheen_color: Rgb,
    /// Anisotropy.
    pub anisotropy: f32,
    /// Its direction in tangent space, unit.
    pub anisotropy_direction: [f32; 2],
    /// Thin film.
    pub iridescence: f32,
    /// Its index of refraction.
    pub iridescence_ior: f32,
    /// Its thickness where the texture is 0 and 1, nanometres.
    pub iridescence_thickness_nm: [f32; 2],
    /// 20 over the Abbe number.
    pub dispersion: f32,
    /// Roughness of the diffuse base.
    pub diffuse_roughness: f32,
    /// Colour of what the base transmits.
    pub diffuse_transmission_color: Rgb,
    /// Its share.
    pub diffuse_transmission: f32,
    /// Phong reflectance.
    pub phong_specular: Rgb,
    /// Phong exponent; infinite is a mirror.
    pub phong_exponent: f32,
    /// R.
    pub coat_texture: TextureUse,
    /// G.
    pub coat_roughness_texture: TextureUse,
    /// Normal map of the coat.
    pub coat_normal_texture: TextureUse,
    /// sRGB.
    pub sheen_color_texture: TextureUse,
    /// A.
    pub sheen_roughness_texture: TextureUse,
    /// RG direction, B strength.
    pub anisotropy_texture: TextureUse,
    /// R.
    pub iridescence_texture: TextureUse,
    /// G.
    pub iridescence_thickness_texture: TextureUse,
    /// A.
    pub diffuse_transmission_texture: TextureUse,
    /// sRGB.
    pub diffuse_transmission_color_texture: TextureUse,
    /// sRGB.
    pub phong_specular_texture: TextureUse,
}

impl Default for LobesRecord {
    /// Every part switched off.
    fn default() -> Self {
        let none = TextureUse::default();
        LobesRecord {
            anisotropy_direction: [1.0, 0.0],
            coat_texture: none,
            coat_roughness_texture: none,
            coat_normal_texture: none,
            sheen_color_texture: none,
            sheen_roughness_texture: none,
            anisotropy_texture: none,
            iridescence_texture: none,
            iridescence_thickness_texture: none,
            diffuse_transmission_texture: none,
            diffuse_transmission_color_texture: none,
            phong_specular_texture: none,
            ..Zeroable::zeroed()
        }
    }
}
