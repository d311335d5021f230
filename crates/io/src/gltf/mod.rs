//! glTF 2.0 (Khronos Group 2021) to [`Scene`]. The `gltf` crate gives the JSON types only; its validator and importer are
//! not used, because they panic on some wrong indices and follow paths out of the scene's folder.
//!
//! Extensions are read from the raw JSON (`json.rs`), all in the same way; `extensions.rs` lists them. Left out: skins
//! and animations (rest pose, with a warning), points and lines.

mod accessor;
mod buffers;
mod cameras;
mod container;
mod describe;
mod document;
mod draco;
mod environment;
mod extensions;
mod images;
mod instancing;
mod json;
mod lights;
mod material;
mod mesh;
mod meshopt;
mod morph;
mod nodes;
mod prescan;
mod primitive;
mod textures;
mod variants;

pub(crate) use describe::describe;

use crate::resolver::Resolver;
use crate::warnings::Warnings;
use crate::{IoError, LoadOptions, Loaded};
use accessor::Accessors;
use buffers::Buffers;
use document::Document;
pub use extensions::{GLTF_EXTENSIONS, GltfExtension, Support};
use lumbre_scene::Scene;
use std::path::Path;
use textures::TextureTable;

/// Loads a binary glTF from its bytes; `path` is where they came from.
pub(crate) fn load_glb(path: &Path, bytes: Vec<u8>, options: &LoadOptions) -> Result<Loaded, IoError> {
    let mut warnings = Warnings::default();
    let parts = container::split(path, &bytes, &mut warnings)?;
    load(path, parts.json, parts.bin, options, warnings)
}

/// Loads a glTF from its JSON text.
pub(crate) fn load_json(path: &Path, bytes: &[u8], options: &LoadOptions) -> Result<Loaded, IoError> {
    load(path, bytes, None, options, Warnings::default())
}

fn load(
    path: &Path,
    json: &[u8],
    bin: Option<&[u8]>,
    options: &LoadOptions,
    mut warnings: Warnings,
) -> Result<Loaded, IoError> {
    let mut doc = Document::parse(path, json, &options.limits)?;
    extensions::check(&doc, &mut warnings)?;
    if let Some(variant) = &options.variant {
        variants::choose(&mut doc, variant)?;
    }
    doc.warn_of_motion(&mut warnings);
    let resolver = Resolver::new(path, options)?;
    let buffers = Buffers::load(&doc, &resolver, bin)?;

    // What is small comes first, in order; it says which images are needed.
    let mut table = TextureTable::default();
    let materials = material::load_all(&doc, &mut table, &mut warnings)?;
    let lights = lights::load_all(&doc, &mut warnings)?;
    let mut graph = nodes::load(&doc, lights.len(), &options.scene, &mut warnings)?;
    let environment = environment::load(&doc, graph.scene, &mut warnings)?;
    let shapes = morph::shapes(&doc, &mut graph.nodes);
    let accessors = Accessors { doc: &doc, buffers: &buffers };
    instancing::expand(&accessors, &mut graph.nodes, &mut warnings)?;

    // Then what is large, on all cores.
    let (images, meshes) = rayon::join(
        || images::load_all(&doc, &buffers, &resolver, table.images()),
        || mesh::load_all(&accessors, &shapes),
    );
    let (meshes, mesh_warnings) = meshes?;
    let mut images = images?;
    table.make_roughness(&mut images, path, &options.limits)?;
    warnings.append(mesh_warnings);

    let scene = Scene {
        name: path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default(),
        meshes: meshes.into(),
        materials,
        textures: table.textures,
        images: images.into(),
        lights,
        cameras: graph.cameras,
        nodes: graph.nodes,
        roots: graph.roots,
        environment,
    };
    Ok(Loaded { scene, warnings: warnings.into_lines() })
}
