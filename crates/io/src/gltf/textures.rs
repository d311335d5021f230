//! Textures and their samplers. Only what a material uses is kept, so that images of no use are never decoded.

use super::document::Document;
use super::json::Object;
use super::material::Glossy;
use crate::IoError;
use crate::warnings::Warnings;
use gltf::json::Value;
use gltf::json::texture::{MagFilter, WrappingMode};
use gltf::json::validation::Checked;
use lumbre_scene::{Filter, ImageId, Texture, TextureId, TextureRef, TextureTransform, Wrap};
use std::collections::HashMap;

/// Textures in use, in the order of their first use.
#[derive(Default)]
pub(super) struct TextureTable {
    pub(super) textures: Vec<Texture>,
    /// glTF's index of each image in use.
    images: Vec<usize>,
    texture_ids: HashMap<usize, TextureId>,
    image_ids: HashMap<usize, ImageId>,
    /// Textures of roughness, made from others once the images are decoded.
    pub(super) glossy: Glossy,
}

/// How a material names a texture.
pub(super) struct TextureInfo<'a> {
    pub(super) index: usize,
    pub(super) tex_coord: usize,
    /// The value of `KHR_texture_transform`.
    pub(super) transform: Option<&'a Value>,
}

impl TextureTable {
    /// glTF's indices of the images in use; position `i` is `ImageId(i)`.
    pub(super) fn images(&self) -> &[usize] {
        &self.images
    }

    /// The use of a texture that stands at `place`.
    pub(super) fn reference(
        &mut self,
        doc: &Document,
        info: TextureInfo,
        place: &str,
        warnings: &mut Warnings,
    ) -> Result<TextureRef, IoError> {
        let texture = self.texture(doc, info.index, place)?;
        let mut set = info.tex_coord;
        let mut transform = TextureTransform::default();
        let at = || format!("{place}/extensions/KHR_texture_transform");
        if let Some(t) = Object::new(doc, info.transform, at)? {
            transform = TextureTransform {
                offset: t.numbers("offset", [0.0; 2])?,
                rotation: t.number("rotation", 0.0)?,
                scale: t.numbers("scale", [1.0; 2])?,
            };
            set = t.index("texCoord")?.unwrap_or(set);
        }
        if set > 1 {
            warnings
                .add(place, "texture coordinates beyond the second set are not supported; the first is used");
            set = 0;
        }
        Ok(TextureRef { texture, uv_set: set as u32, transform })
    }

    fn texture(&mut self, doc: &Document, index: usize, place: &str) -> Result<TextureId, IoError> {
        if let Some(&id) = self.texture_ids.get(&index) {
            return Ok(id);
        }
        let here = || format!("/textures/{index}");
        let json = doc.item(&doc.root.textures, index, "texture", &|| format!("{place}/index"))?;
        let source = source(doc, json, &here())?;
        let images = &mut self.images;
        let image = *self.image_ids.entry(source).or_insert_with(|| {
            images.push(source);
            ImageId(images.len() as u32 - 1)
        });
        let mut texture =
            Texture { image, wrap_s: Wrap::Repeat, wrap_t: Wrap::Repeat, filter: Filter::Linear };
        if let Some(sampler) = json.sampler {
            let at = || format!("/textures/{index}/sampler");
            let s = doc.item(&doc.root.samplers, sampler.value(), "sampler", &at)?;
            let here = format!("/samplers/{}", sampler.value());
            texture.wrap_s = wrap(doc, s.wrap_s, &here)?;
            texture.wrap_t = wrap(doc, s.wrap_t, &here)?;
            texture.filter = match s.mag_filter {
                Some(Checked::Valid(MagFilter::Nearest)) => Filter::Nearest,
                _ => Filter::Linear,
            };
        }
        let id = TextureId(self.textures.len() as u32);
        self.textures.push(texture);
        self.texture_ids.insert(index, id);
        Ok(id)
    }
}

/// The image of the texture that stands at `place`. Extensions name it first: what they leave in `source` is for loaders
/// without them.
fn source(doc: &Document, json: &gltf::json::Texture, place: &str) -> Result<usize, IoError> {
    let extensions = json.extensions.as_ref().map(|e| &e.others);
    let mut found = None;
    for name in ["EXT_texture_webp", "KHR_texture_basisu"] {
        let here = format!("{place}/extensions/{name}");
        let object = Object::new(doc, extensions.and_then(|e| e.get(name)), || here.clone())?;
        let source = object.map(|o| o.index("source")).transpose()?.flatten();
        found = found.or(source.map(|s| (s, format!("{here}/source"))));
    }
    let (source, here) = match found {
        Some(found) => found,
        // The JSON types write an absent source as the largest index.
        None if json.source.value() == u32::MAX as usize => {
            let formats: Vec<_> = extensions.into_iter().flat_map(|e| e.keys().map(String::as_str)).collect();
            return Err(match formats.is_empty() {
                true => doc.error(place, "has no source"),
                false => doc.unsupported(place, format!("the extension {}", formats.join(", "))),
            });
        }
        None => (json.source.value(), format!("{place}/source")),
    };
    doc.item(&doc.root.images, source, "image", &|| here.clone())?;
    Ok(source)
}

fn wrap(doc: &Document, mode: Checked<WrappingMode>, place: &str) -> Result<Wrap, IoError> {
    match mode {
        Checked::Valid(WrappingMode::Repeat) => Ok(Wrap::Repeat),
        Checked::Valid(WrappingMode::MirroredRepeat) => Ok(Wrap::MirroredRepeat),
        Checked::Valid(WrappingMode::ClampToEdge) => Ok(Wrap::ClampToEdge),
        Checked::Invalid => Err(doc.error(place, "its wrapping mode is none of glTF's")),
    }
}
