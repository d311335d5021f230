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
        !self.has(flag::DOUBLE_SIDED) && self.transmission == 0.0
    }
}
