//! `KHR_materials_pbrSpecularGlossiness` (Khronos Group 2018, archived): a diffuse base under an interface whose
//! reflectance at normal incidence is given, in the terms of the metallic-roughness model.
//!
//! An index of 0 stands for a reflectance of 1 (`KHR_materials_ior`), so that the specular colour alone is f0. The
//! extension's factor 1 - max(specular) on the diffuse colour is what our interface leaves to its base anyway. Glossiness
//! is the alpha of a texture, roughness must be green: that texture is made once its image is decoded.

use super::super::textures::TextureTable;
use super::Loader;
use crate::{Bound, IoError, Limits};
use lumbre_core::Rgb;
use lumbre_scene::{Image, ImageId, Material, TextureId};
use rayon::prelude::*;
use std::collections::HashMap;
use std::path::Path;

/// Textures of roughness to be made from others whose alpha is glossiness.
#[derive(Default)]
pub(in super::super) struct Glossy {
    /// Each texture to be made, which shows the image of the other until then, with the factor on the glossiness.
    textures: Vec<(TextureId, f32)>,
    /// Those that were asked for, by the other's id and the bits of the factor.
    ids: HashMap<(TextureId, u32), TextureId>,
}

impl Loader<'_, '_> {
    /// Replaces what metallic-roughness, index and specular said, if the material has the extension.
    pub(super) fn specular_glossiness(&mut self, m: &mut Material) -> Result<(), IoError> {
        let Some(e) = self.extension("KHR_materials_pbrSpecularGlossiness")? else { return Ok(()) };
        let [r, g, b, a] = e.numbers("diffuseFactor", [1.0; 4])?;
        m.base_color = self.unit_color(Rgb::new(r, g, b), e.place());
        m.alpha = self.unit(a, e.place());
        m.base_color_texture = self.extension_texture(&e, "diffuseTexture")?;
        (m.metallic, m.ior) = (0.0, 0.0);
        (m.specular, m.specular_texture) = (1.0, None);
        m.specular_color = self.unit_color(e.color("specularFactor", Rgb::WHITE)?, e.place());
        m.specular_color_texture = self.extension_texture(&e, "specularGlossinessTexture")?;
        let glossiness = self.unit(e.number("glossinessFactor", 1.0)?, e.place());
        m.metallic_roughness_texture = None;
        m.roughness = 1.0 - glossiness;
        // Without glossiness its texture says nothing.
        if let Some(mut texture) = m.specular_color_texture.filter(|_| glossiness > 0.0) {
            texture.texture = self.table.glossy(texture.texture, glossiness);
            m.metallic_roughness_texture = Some(texture);
            m.roughness = 1.0;
        }
        Ok(())
    }
}

impl TextureTable {
    /// A texture whose green will be 1 - `factor` · the alpha of `source`.
    fn glossy(&mut self, source: TextureId, factor: f32) -> TextureId {
        *self.glossy.ids.entry((source, factor.to_bits())).or_insert_with(|| {
            let texture = TextureId(self.textures.len() as u32);
            self.textures.push(self.textures[source.index()]);
            self.glossy.textures.push((texture, factor));
            texture
        })
    }

    /// Makes the images of roughness and appends them to the decoded `images`.
    pub(in super::super) fn make_roughness(
        &mut self,
        images: &mut Vec<Image>,
        path: &Path,
        limits: &Limits,
    ) -> Result<(), IoError> {
        let mut room = limits.room(Bound::TotalImageBytes);
        room.take(path, "/images", images.iter().map(|i| i.rgba8.len() as u64).sum())?;
        let mut made: HashMap<(ImageId, u32), ImageId> = HashMap::new();
        let mut jobs = Vec::new();
        for &(texture, factor) in &self.glossy.textures {
            let texture = &mut self.textures[texture.index()];
            let source = texture.image;
            let next = ImageId((images.len() + jobs.len()) as u32);
            texture.image = *made.entry((source, factor.to_bits())).or_insert(next);
            if texture.image == next {
                room.take(path, "/images", images[source.index()].rgba8.len() as u64)?;
                jobs.push((source, factor));
            }
        }
        let roughness: Vec<Image> =
            jobs.into_par_iter().map(|(source, factor)| roughness(&images[source.index()], factor)).collect();
        images.extend(roughness);
        Ok(())
    }
}

/// The image of roughness (green) of one of glossiness (alpha); the rest is white.
fn roughness(glossy: &Image, factor: f32) -> Image {
    let mut rgba8 = vec![255; glossy.rgba8.len()];
    for (out, texel) in rgba8.chunks_exact_mut(4).zip(glossy.rgba8.chunks_exact(4)) {
        out[1] = (255.0 - factor * f32::from(texel[3])).round() as u8;
    }
    Image { name: format!("{} (roughness)", glossy.name), width: glossy.width, height: glossy.height, rgba8 }
}
