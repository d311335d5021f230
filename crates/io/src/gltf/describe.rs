//! What a glTF says of itself.

use super::container;
use super::document::Document;
use super::extensions::GLTF_EXTENSIONS;
use super::variants;
use crate::describe::{Description, UsedExtension};
use crate::warnings::Warnings;
use crate::{IoError, LoadOptions};
use std::path::Path;

/// Reads the JSON alone.
pub(crate) fn describe(path: &Path, bytes: &[u8], options: &LoadOptions) -> Result<Description, IoError> {
    let binary = bytes.starts_with(b"glTF");
    let json = if binary { container::split(path, bytes, &mut Warnings::default())?.json } else { bytes };
    let doc = Document::parse(path, json, &options.limits)?;
    let root = &doc.root;
    let name = |name: &Option<String>| name.clone().unwrap_or_default();
    let primitives = root.meshes.iter().flat_map(|m| &m.primitives);
    Ok(Description {
        format: if binary { "glTF 2.0, binary" } else { "glTF 2.0" },
        file_bytes: bytes.len() as u64,
        generator: root.asset.generator.clone(),
        extensions: extensions(&doc),
        scenes: root.scenes.iter().map(|s| name(&s.name)).collect(),
        default_scene: root.scene.map_or(0, |i| i.value()),
        variants: variants::names(&doc)?,
        lists: vec![
            ("nodes", root.nodes.len()),
            ("meshes", root.meshes.len()),
            ("primitives", primitives.count()),
            ("materials", root.materials.len()),
            ("textures", root.textures.len()),
            ("images", root.images.len()),
            ("cameras", root.cameras.len()),
            ("skins", root.skins.len()),
            ("animations", root.animations.len()),
        ],
    })
}

/// Required ones first; each once.
fn extensions(doc: &Document) -> Vec<UsedExtension> {
    let required = doc.root.extensions_required.iter().map(|name| (name, true));
    let used = doc.root.extensions_used.iter().map(|name| (name, false));
    let mut seen = std::collections::HashSet::new();
    let all = required.chain(used).filter(|(name, _)| seen.insert(*name));
    let one = |(name, required): (&String, bool)| UsedExtension {
        name: name.clone(),
        required,
        support: GLTF_EXTENSIONS.iter().find(|e| e.name == name).map(|e| e.support),
    };
    all.map(one).collect()
}
