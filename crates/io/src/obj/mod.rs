//! Wavefront OBJ with its MTL materials (Wavefront Technologies 1995) to [`Scene`].
//!
//! The parser is our own: the file is cut into pieces that all cores read at once, which the crates for OBJ do not do, and what
//! a piece says is put together afterwards (`chunk.rs`, `whole.rs`). Numbers are read by the standard library, correctly
//! rounded. docs/performance.md has what that takes.
//!
//! Left out, each with a note: points and lines, free-form curves and surfaces, `call` and `csh`. An OBJ has no camera and no
//! unit; one unit is taken as a metre. Its only lights are surfaces with Ke.

mod chunk;
mod faces;
mod library;
mod map;
mod material;
mod mtl;
mod normals;
mod parts;
mod pictures;
mod texels;
mod text;
mod textures;
mod whole;

use crate::resolver::Resolver;
use crate::warnings::Warnings;
use crate::{IoError, LoadOptions, Loaded};
use library::{Entry, Libraries};
use lumbre_scene::{Material, MaterialId, Mesh, Node, Scene};
pub(crate) use material::stand_in;
use parts::Segments;
use pictures::Pictures;
use std::path::Path;
use textures::Textures;
use whole::Whole;
pub(crate) use whole::linearise;

/// Loads an OBJ from its bytes; `path` is where they came from.
pub(crate) fn load(path: &Path, bytes: &[u8], options: &LoadOptions) -> Result<Loaded, IoError> {
    let mut warnings = Warnings::default();
    let mut whole = Whole::read(path, bytes, &options.limits, &mut warnings)?;
    let mut triangles = faces::triangulate(path, &whole, &mut warnings)?;
    if triangles.iter().all(|t| t.corners.is_empty()) {
        if whole.positions.is_empty() {
            return Err(IoError::data(path, "", "not a Wavefront OBJ: it has neither vertices nor faces"));
        }
        warnings.add("", "it has no faces: there is nothing to draw");
    }
    let segments = Segments::new(&whole, &triangles, &mut warnings);
    normals::smooth(&whole.positions, &mut whole.normals, &mut triangles, &segments.list);

    let resolver = Resolver::new(path, options)?;
    let libraries = Libraries::load(&resolver, &whole.libraries, &options.limits, &mut warnings);
    let table = MaterialTable::new(&libraries, &segments, &whole, &mut warnings);
    let (ids, otherwise) = table.ids();
    let used: Vec<&Entry> = table.sources.iter().filter_map(|s| s.as_ref().ok().copied()).collect();
    let ((pictures, picture_warnings), meshes) = rayon::join(
        || {
            let mut warnings = Warnings::default();
            let pictures = Pictures::load(&resolver, &libraries, &used, &options.limits, &mut warnings);
            (pictures, warnings)
        },
        || segments.meshes(&whole, &triangles, &ids, otherwise),
    );
    warnings.append(picture_warnings);
    let mut textures = Textures::new(pictures, path);
    let materials = table.materials(&libraries, &mut textures);
    let (textures, images, texture_warnings) = textures.finish();
    warnings.append(texture_warnings);
    let images = images.into();
    let mut scene = Scene { name: scene_name(path), materials, textures, images, ..Scene::default() };
    add_meshes(&mut scene, meshes, path);
    Ok(Loaded { scene, warnings: warnings.into_lines() })
}

/// Which materials the scene has: those that faces name, and one for faces that name none.
struct MaterialTable<'a> {
    /// From a library, or the name of one that is in none.
    sources: Vec<Result<&'a Entry, String>>,
    /// Index of the one for faces without.
    otherwise: Option<usize>,
    /// Vertices have colours.
    colored: bool,
}

impl<'a> MaterialTable<'a> {
    fn new(libraries: &'a Libraries, segments: &Segments, whole: &Whole, warnings: &mut Warnings) -> Self {
        if whole.libraries.is_empty() && !segments.materials.is_empty() {
            warnings.add("", "it names materials but no library of them; they are grey");
        }
        let mut sources: Vec<Result<&Entry, String>> = Vec::with_capacity(segments.materials.len() + 1);
        for name in &segments.materials {
            let entry = libraries.get(name);
            if entry.is_none() && !libraries.files.is_empty() {
                warnings.add("", format!("no library has the material {}; it is grey", quoted(name)));
            }
            sources.push(entry.ok_or_else(|| name.clone()));
        }
        let mut otherwise = None;
        if segments.any_without_material() {
            // A file that names a library but no material of it can mean only its only one.
            let only = match &libraries.entries[..] {
                [only] if segments.materials.is_empty() => {
                    let name = quoted(&only.mtl.name);
                    let what = format!("no material is chosen; all faces get the library's only one, {name}");
                    warnings.add("", what);
                    Some(only)
                }
                _ => None,
            };
            otherwise = Some(sources.len());
            sources.push(only.ok_or_else(String::new));
        }
        MaterialTable { sources, otherwise, colored: !whole.colors.is_empty() }
    }

    /// Ids of the materials that faces name, and of that for faces that name none.
    fn ids(&self) -> (Vec<MaterialId>, Option<MaterialId>) {
        let id = |i: usize| MaterialId(i as u32);
        ((0..self.sources.len()).map(id).collect(), self.otherwise.map(id))
    }

    fn materials(&self, libraries: &Libraries, textures: &mut Textures) -> Vec<Material> {
        let mut load = |source: &Result<&Entry, String>| match source {
            Ok(entry) => {
                textures.place = format!("{}: line {}", libraries.files[entry.file].name, entry.mtl.line);
                material::load(entry, textures)
            }
            Err(name) => stand_in(name, self.colored),
        };
        self.sources.iter().map(&mut load).collect()
    }
}

/// A name for a message, cut short.
fn quoted(name: &str) -> String {
    format!("{:?}", name.chars().take(80).collect::<String>())
}

/// The name of a scene: that of its file.
pub(crate) fn scene_name(path: &Path) -> String {
    path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default()
}

/// Puts each mesh where it is, in a node of its own. One without a name gets that of the file.
pub(crate) fn add_meshes(scene: &mut Scene, meshes: Vec<Mesh>, path: &Path) {
    for mut mesh in meshes {
        if mesh.name.is_empty() {
            mesh.name = path.file_stem().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        }
        let name = mesh.name.clone();
        let mesh = Some(scene.add_mesh(mesh));
        scene.add_root(Node { name, mesh, ..Node::default() });
    }
}
