//! Opens a scene, whatever its format.

use crate::{IoError, Limits, files, gltf, obj, ply, stl};
use lumbre_scene::Scene;
use std::path::{Path, PathBuf};

/// How to load.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// Bounds on what the file may ask for.
    pub limits: Limits,
    /// Folders beside that of the scene from which files that it names may be read.
    pub asset_dirs: Vec<PathBuf>,
}

/// A scene, and what there is to say about how it was read.
#[derive(Debug)]
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// One line each, without the file's name; empty if all was understood.
    pub warnings: Vec<String>,
}

/// What [`load_scene`] opens, for messages.
pub const SCENE_FORMATS: &str = "glTF 2.0 (.gltf, .glb), Wavefront OBJ (.obj), PLY (.ply), STL (.stl)";

/// Loads a scene. The format is told by the first bytes, then by the extension.
///
/// # Errors
/// `CannotOpen` if the file or one that it names cannot be read; `BadData` if it is no scene, is damaged, requires
/// what is not supported, or exceeds a limit.
pub fn load_scene(path: impl AsRef<Path>, options: &LoadOptions) -> Result<Loaded, IoError> {
    let path = path.as_ref();
    let bytes = files::read_file(path, options.limits.max_file_bytes)?;
    let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    if bytes.starts_with(b"glTF") {
        return gltf::load_glb(path, bytes, options);
    }
    if ply::is_ply(&bytes) {
        return ply::load(path, &bytes, options);
    }
    match extension.as_str() {
        "gltf" => gltf::load_json(path, &bytes, options),
        "obj" => obj::load(path, &bytes, options),
        "ply" => ply::load(path, &bytes, options),
        "stl" => stl::load(path, &bytes, options),
        "glb" => Err(IoError::data(path, "byte 0", "not a binary glTF: it does not begin with `glTF`")),
        _ => Err(IoError::unsupported(
            path,
            "",
            format!("scenes of the kind .{extension}; what opens: {SCENE_FORMATS}"),
        )),
    }
}
