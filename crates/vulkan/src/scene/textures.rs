//! Textures of a scene on the device: images, and texels in a buffer where they decide what rays find.

use crate::buffer::Buffer;
use crate::error::VulkanError;
use crate::gpu::Limits;
use crate::image::Image;
use crate::upload::Upload;
use ash::vk;
use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::texture::TextureRecord;
use lumbre_shaders::layout::TextureTable;
use std::collections::BTreeMap;

/// The textures of a scene.
pub(crate) struct Textures {
    _images: Vec<Image>,
    /// Texels in buffers.
    texels: BTreeMap<Place, Buffer>,
    places: Vec<Place>,
    /// One for each texture.
    pub(crate) views: Vec<vk::ImageView>,
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
            texels: BTreeMap::new(),
            places: scene.textures.iter().map(place).collect(),
            views: Vec::new(),
            tables: Vec::new(),
        };
        all.add_images(upload, scene)?;
        all.update(upload, scene)?;
        Ok(all)
    }

    /// Whether these textures are of the same images.
    pub(crate) fn has_places_of(&self, textures: &[TextureRecord]) -> bool {
        self.places.iter().copied().eq(textures.iter().map(place))
    }

    fn add_images(&mut self, upload: &mut Upload, scene: &CompiledScene) -> Result<(), VulkanError> {
        let mut images = BTreeMap::<Place, usize>::new();
        for (id, t) in scene.textures.iter().enumerate() {
            let at = place(t);
            if let std::collections::btree_map::Entry::Vacant(free) = images.entry(at) {
                free.insert(self._images.len());
                let name = format!("texture {id}");
                self._images.push(Image::texture(upload, &name, [t.width, t.height], texels(scene, &at))?);
            }
            self.views.push(self._images[images[&at]].view);
        }
        Ok(())
    }

    /// Makes the tables of all for these materials and samplers, and brings there the texels that begin to decide alpha; whether that
    /// changed a table.
    ///
    /// # Errors
    /// If memory is out, or the device is lost.
    pub(crate) fn update(&mut self, upload: &mut Upload, scene: &CompiledScene) -> Result<bool, VulkanError> {
        let mut tables = Vec::with_capacity(scene.textures.len());
        for (t, by_hand) in scene.textures.iter().zip(deciding_alpha(scene)) {
            let at = place(t);
            if by_hand && !self.texels.contains_key(&at) {
                let content = bytemuck::cast_slice(texels(scene, &at));
                self.texels.insert(at, Buffer::with_content(upload, "texels", content)?);
            }
            tables.push(TextureTable {
                texels: if by_hand { self.texels[&at].address() } else { 0 },
                width: t.width,
                height: t.height,
                wrap_s: t.wrap_s,
                wrap_t: t.wrap_t,
                nearest: t.nearest,
                unused: 0,
            });
        }
        let before: &[u8] = bytemuck::cast_slice(&self.tables);
        let changed = before != bytemuck::cast_slice::<_, u8>(&tables);
        self.tables = tables;
        Ok(changed)
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
    refuse("textures", scene.textures.len() as u64, limits.max_sampled_images)?;
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
