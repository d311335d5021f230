//! Textures of a scene on the device: images that it filters, and texels in a buffer where shaders filter by hand.

use crate::buffer::Buffer;
use crate::error::VulkanError;
use crate::gpu::Limits;
use crate::image::{Image, Sampler};
use crate::upload::Upload;
use ash::vk;
use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::texture::{TextureRecord, wrap};
use lumbre_shaders::layout::TextureTable;
use std::collections::BTreeMap;

/// What an element of the arrays of textures is.
#[derive(Clone, Copy)]
pub(crate) struct Sampled {
    pub(crate) srgb: vk::ImageView,
    pub(crate) linear: vk::ImageView,
    pub(crate) sampler: vk::Sampler,
}

/// The textures of a scene.
pub(crate) struct Textures {
    _images: Vec<Image>,
    _samplers: Vec<Sampler>,
    _texels: Vec<Buffer>,
    /// One for each texture.
    pub(crate) sampled: Vec<Sampled>,
    /// One for each texture.
    pub(crate) tables: Vec<TextureTable>,
}

/// Where the texels of a texture lie in the scene: first and size. Textures that differ only in their samplers share them.
type Place = (u32, u32, u32);

fn place(t: &TextureRecord) -> Place {
    (t.first_texel, t.width, t.height)
}

fn texels<'a>(scene: &'a CompiledScene, &(first, width, height): &Place) -> &'a [u32] {
    &scene.texels[first as usize..][..width as usize * height as usize]
}

impl Textures {
    /// Copies them to the device.
    ///
    /// # Errors
    /// If they are too many or too large for it, memory is out, or the device is lost.
    pub(crate) fn new(upload: &mut Upload, scene: &CompiledScene) -> Result<Self, VulkanError> {
        check(&upload.gpu().0.limits, scene)?;
        let mut all = Textures {
            _images: Vec::new(),
            _samplers: Vec::new(),
            _texels: Vec::new(),
            sampled: Vec::new(),
            tables: Vec::new(),
        };
        all.add_images(upload, scene)?;
        all.add_tables(upload, scene)?;
        Ok(all)
    }

    fn add_images(&mut self, upload: &mut Upload, scene: &CompiledScene) -> Result<(), VulkanError> {
        let gpu = upload.gpu().clone();
        let mut images = BTreeMap::<Place, usize>::new();
        let mut samplers = BTreeMap::<[u32; 3], usize>::new();
        for (id, t) in scene.textures.iter().enumerate() {
            let at = place(t);
            if let std::collections::btree_map::Entry::Vacant(free) = images.entry(at) {
                free.insert(self._images.len());
                let name = format!("texture {id}");
                self._images.push(Image::new(upload, &name, [t.width, t.height], texels(scene, &at))?);
            }
            let kind = [t.wrap_s, t.wrap_t, t.nearest];
            if let std::collections::btree_map::Entry::Vacant(free) = samplers.entry(kind) {
                free.insert(self._samplers.len());
                let filter = if t.nearest == 1 { vk::Filter::NEAREST } else { vk::Filter::LINEAR };
                self._samplers.push(Sampler::new(&gpu, [mode(t.wrap_s), mode(t.wrap_t)], filter)?);
            }
            let image = &self._images[images[&at]];
            let sampler = self._samplers[samplers[&kind]].raw;
            self.sampled.push(Sampled { srgb: image.srgb, linear: image.linear, sampler });
        }
        Ok(())
    }

    /// Tables of all, and texels of those that decide alpha.
    fn add_tables(&mut self, upload: &mut Upload, scene: &CompiledScene) -> Result<(), VulkanError> {
        let by_hand = deciding_alpha(scene);
        let mut addresses = BTreeMap::<Place, u64>::new();
        for (t, by_hand) in scene.textures.iter().zip(by_hand) {
            let at = place(t);
            if by_hand && !addresses.contains_key(&at) {
                let content = bytemuck::cast_slice(texels(scene, &at));
                let buffer = Buffer::with_content(upload, "texels", content)?;
                addresses.insert(at, buffer.address());
                self._texels.push(buffer);
            }
            self.tables.push(TextureTable {
                texels: if by_hand { addresses[&at] } else { 0 },
                width: t.width,
                height: t.height,
                wrap_s: t.wrap_s,
                wrap_t: t.wrap_t,
                nearest: t.nearest,
                unused: 0,
            });
        }
        Ok(())
    }
}

/// Whether the device takes so many textures, and such large ones.
fn check(limits: &Limits, scene: &CompiledScene) -> Result<(), VulkanError> {
    let refuse = |what: &str, needed, limit: u32| {
        let (needed, limit) = (needed, u64::from(limit));
        if needed <= limit {
            Ok(())
        } else {
            Err(VulkanError::TooLarge { what: what.to_owned(), needed, limit })
        }
    };
    // Each is there twice: read as sRGB and as linear values.
    refuse("textures", scene.textures.len() as u64, limits.max_sampled_images / 2)?;
    let side = scene.textures.iter().map(|t| t.width.max(t.height)).max().unwrap_or(0);
    refuse("the side of a texture (texels)", side.into(), limits.max_image_side)
}

/// For each texture whether the visibility of a surface depends on it.
fn deciding_alpha(scene: &CompiledScene) -> Vec<bool> {
    let mut decides = vec![false; scene.textures.len()];
    for material in scene.materials.iter().filter(|m| m.has_coverage()) {
        if let Some(d) = decides.get_mut(material.base_color_texture.texture as usize) {
            *d = true;
        }
    }
    decides
}

fn mode(raw: u32) -> vk::SamplerAddressMode {
    match raw {
        wrap::MIRRORED_REPEAT => vk::SamplerAddressMode::MIRRORED_REPEAT,
        wrap::CLAMP_TO_EDGE => vk::SamplerAddressMode::CLAMP_TO_EDGE,
        _ => vk::SamplerAddressMode::REPEAT,
    }
}
