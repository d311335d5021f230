//! Textures as the materials ask for them: pictures as they are, or made from several.

use super::map::{Channel, Map};
use super::pictures::Pictures;
use super::texels::{common_size, is_normal_map, normals_from_heights, rough_metal, with_coverage};
use crate::warnings::Warnings;
use lumbre_scene::{Filter, Image, ImageId, Texture, TextureId, TextureRef, TextureTransform, Wrap};
use std::collections::HashMap;
use std::path::Path;

/// What an image is made of; pictures by their index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Recipe {
    Plain(usize),
    Coverage(Option<usize>, usize, Option<Channel>),
    RoughMetal(Option<(usize, Channel)>, Option<(usize, Channel)>),
    Heights(usize, Channel),
}

impl Recipe {
    fn pictures(self) -> impl Iterator<Item = usize> {
        let [a, b] = match self {
            Recipe::Plain(p) | Recipe::Heights(p, _) => [Some(p), None],
            Recipe::Coverage(color, alpha, _) => [color, Some(alpha)],
            Recipe::RoughMetal(rough, metal) => [rough.map(|r| r.0), metal.map(|m| m.0)],
        };
        a.into_iter().chain(b)
    }
}

/// Collects the textures of all materials.
pub(super) struct Textures<'a> {
    pictures: Pictures,
    /// `None`: a picture as it is, put in at the end.
    images: Vec<(Recipe, Option<Image>)>,
    /// `None`: there was no room for it.
    image_ids: HashMap<Recipe, Option<ImageId>>,
    textures: Vec<Texture>,
    texture_ids: HashMap<(ImageId, bool), TextureId>,
    /// The scene, for messages.
    path: &'a Path,
    /// Where the material stands that is being made.
    pub(super) place: String,
    warnings: Warnings,
}

/// A normal map of a material.
pub(super) struct NormalMap {
    pub(super) texture: TextureRef,
    pub(super) strength: f32,
}

impl<'a> Textures<'a> {
    pub(super) fn new(pictures: Pictures, path: &'a Path) -> Self {
        Textures {
            pictures,
            images: Vec::new(),
            image_ids: HashMap::new(),
            textures: Vec::new(),
            texture_ids: HashMap::new(),
            path,
            place: String::new(),
            warnings: Warnings::default(),
        }
    }

    /// Notes something about the material that is being made.
    pub(super) fn warn(&mut self, what: impl ToString) {
        self.warnings.add(&self.place, what);
    }

    /// Takes away a map whose picture could not be read.
    pub(super) fn forget_missing(&self, file: usize, map: &mut Option<Map>) {
        if map.as_ref().is_some_and(|m| self.pictures.get(file, m).is_none()) {
            *map = None;
        }
    }

    /// The map's picture as it is.
    pub(super) fn plain(&mut self, file: usize, map: &Option<Map>) -> Option<TextureRef> {
        let map = map.as_ref()?;
        let picture = self.pictures.get(file, map)?;
        self.reference(Recipe::Plain(picture), map)
    }

    /// Colour with coverage: the picture of `color` and its alpha times that of `alpha`. The second is whether any of it is less than
    /// opaque.
    pub(super) fn color_and_coverage(
        &mut self,
        file: usize,
        color: &Option<Map>,
        alpha: &Option<Map>,
    ) -> (Option<TextureRef>, bool) {
        let find =
            |map: &Option<Map>| map.as_ref().and_then(|m| Some((m.clone(), self.pictures.get(file, m)?)));
        match (find(color), find(alpha)) {
            (None, None) => (None, false),
            (Some((map, picture)), None) => {
                let covers = self.pictures.list[picture].has_alpha;
                (self.reference(Recipe::Plain(picture), &map), covers)
            }
            (color, Some((alpha_map, alpha))) => {
                let map = color.as_ref().map_or(&alpha_map, |(m, _)| m);
                self.warn_of_other_placement(map, &alpha_map, "map_d");
                let recipe = Recipe::Coverage(color.as_ref().map(|c| c.1), alpha, alpha_map.channel);
                (self.reference(recipe, map), true)
            }
        }
    }

    /// Roughness and metallic in one.
    pub(super) fn rough_metal(
        &mut self,
        file: usize,
        rough: &Option<Map>,
        metal: &Option<Map>,
    ) -> Option<TextureRef> {
        let find = |map: &Option<Map>| {
            let map = map.as_ref()?;
            let picture = self.pictures.get(file, map)?;
            Some((map.clone(), (picture, map.channel.unwrap_or(Channel::Luminance))))
        };
        let (rough, metal) = (find(rough), find(metal));
        let map = rough.as_ref().or(metal.as_ref()).map(|(m, _)| m)?;
        if let Some((other, _)) = &metal {
            self.warn_of_other_placement(map, other, "map_Pm");
        }
        let recipe = Recipe::RoughMetal(rough.as_ref().map(|r| r.1), metal.as_ref().map(|m| m.1));
        self.reference(recipe, map)
    }

    /// A normal map from `norm`, or else from the heights of `bump`.
    pub(super) fn normals(
        &mut self,
        file: usize,
        norm: &Option<Map>,
        bump: &Option<Map>,
    ) -> Option<NormalMap> {
        if let (Some(map), Some(texture)) = (norm, self.plain(file, norm)) {
            return Some(NormalMap { texture, strength: map.strength });
        }
        let map = bump.as_ref()?;
        let picture = self.pictures.get(file, map)?;
        let recipe = if map.channel.is_none() && is_normal_map(&self.pictures.list[picture].image) {
            Recipe::Plain(picture)
        } else {
            Recipe::Heights(picture, map.channel.unwrap_or(Channel::Luminance))
        };
        Some(NormalMap { texture: self.reference(recipe, map)?, strength: map.strength })
    }

    fn warn_of_other_placement(&mut self, map: &Map, other: &Map, what: &str) {
        let placement = |m: &Map| (m.scale, m.offset, m.clamp);
        if placement(map) != placement(other) {
            self.warn(format!("{what} is placed by the options of the map it is joined with"));
        }
    }

    /// The use of an image, placed by the options of a map. MTL's v points up: v' = s v + o becomes 1 - v' = s (1 - v) + (1 - s - o).
    fn reference(&mut self, recipe: Recipe, map: &Map) -> Option<TextureRef> {
        let image = self.image(recipe)?;
        let wrap = if map.clamp { Wrap::ClampToEdge } else { Wrap::Repeat };
        let texture = *self.texture_ids.entry((image, map.clamp)).or_insert_with(|| {
            self.textures.push(Texture { image, wrap_s: wrap, wrap_t: wrap, filter: Filter::Linear });
            TextureId(self.textures.len() as u32 - 1)
        });
        let ([su, sv], [ou, ov]) = (map.scale, map.offset);
        let transform = TextureTransform { offset: [ou, 1.0 - sv - ov], rotation: 0.0, scale: [su, sv] };
        Some(TextureRef { texture, uv_set: 0, transform })
    }

    fn image(&mut self, recipe: Recipe) -> Option<ImageId> {
        if let Some(&known) = self.image_ids.get(&recipe) {
            return known;
        }
        let made = self.make(recipe);
        let id = made.map(|image| {
            self.images.push((recipe, image));
            ImageId(self.images.len() as u32 - 1)
        });
        self.image_ids.insert(recipe, id);
        id
    }

    /// `None`: there is no room for it. `Some(None)`: it is a picture as it is.
    fn make(&mut self, recipe: Recipe) -> Option<Option<Image>> {
        let (width, height) = common_size(recipe.pictures().map(|p| &self.pictures.list[p].image));
        let bytes = u64::from(width) * u64::from(height) * 4;
        let is_new = !matches!(recipe, Recipe::Plain(_));
        if let Err(e) = self.pictures.room.take(self.path, "", if is_new { bytes } else { 0 }) {
            self.warn(format!("{e}; a texture made from several is left out"));
            return None;
        }
        let picture = |p: usize| &self.pictures.list[p].image;
        let part = |p: Option<(usize, Channel)>| p.map(|(p, channel)| (picture(p), channel));
        Some(match recipe {
            Recipe::Plain(_) => None,
            Recipe::Coverage(color, alpha, channel) => {
                Some(with_coverage(color.map(picture), picture(alpha), channel))
            }
            Recipe::RoughMetal(rough, metal) => Some(rough_metal(part(rough), part(metal))),
            Recipe::Heights(p, channel) => Some(normals_from_heights(picture(p), channel)),
        })
    }

    /// Textures and images, in the order of their ids.
    pub(super) fn finish(self) -> (Vec<Texture>, Vec<Image>, Warnings) {
        let mut pictures: Vec<Option<Image>> =
            self.pictures.list.into_iter().map(|p| Some(p.image)).collect();
        let images = self.images.into_iter().map(|(recipe, made)| match (made, recipe) {
            (Some(image), _) => image,
            // Each picture has one image of its own.
            (None, recipe) => {
                let picture = recipe.pictures().next().and_then(|p| pictures[p].take());
                picture.unwrap_or(Image { name: String::new(), width: 1, height: 1, rgba8: vec![u8::MAX; 4] })
            }
        });
        (self.textures, images.collect(), self.warnings)
    }
}
