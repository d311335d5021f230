//! Opens a scene, whatever its format.

use crate::describe::Description;
use crate::{IoError, Limits, files, gltf, obj, ply, stl};
use lumbre_scene::Scene;
use std::path::{Path, PathBuf};

/// How to load.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// Bounds on what the file may ask for.
    pub limits: Limits,
    /// Which of the file's scenes.
    pub scene: SceneChoice,
    /// Which set of materials (`KHR_materials_variants`), by name; `None`: the materials that stand without one.
    pub variant: Option<String>,
    /// Folders beside that of the scene from which files that it names may be read.
    pub asset_dirs: Vec<PathBuf>,
}

/// Which scene of a file that holds several.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum SceneChoice {
    /// The one that the file names as such, else its first.
    #[default]
    Default,
    /// By its place in the file, from 0.
    Index(usize),
    /// By its name; the first one of that name.
    Name(String),
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
/// what is not supported, or exceeds a limit; `BadChoice` if the options name what it does not have.
pub fn load_scene(path: impl AsRef<Path>, options: &LoadOptions) -> Result<Loaded, IoError> {
    let path = path.as_ref();
    let bytes = files::read_file(path, options.limits.max_file_bytes)?;
    let format = format_of(path, &bytes)?;
    format.check_choices(path, options)?;
    match format {
        Format::Glb => gltf::load_glb(path, bytes, options),
        Format::Gltf => gltf::load_json(path, &bytes, options),
        Format::Obj => obj::load(path, &bytes, options),
        Format::Ply => ply::load(path, &bytes, options),
        Format::Stl => stl::load(path, &bytes, options),
    }
}

/// A format of scenes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Glb,
    Gltf,
    Obj,
    Ply,
    Stl,
}

impl Format {
    /// Refuses to choose among what only glTF has.
    fn check_choices(self, path: &Path, options: &LoadOptions) -> Result<(), IoError> {
        if matches!(self, Format::Glb | Format::Gltf) {
            return Ok(());
        }
        let scene = match &options.scene {
            SceneChoice::Default => None,
            SceneChoice::Index(i) => Some(("scene", i.to_string())),
            SceneChoice::Name(name) => Some(("scene", format!("{name:?}"))),
        };
        let variant = options.variant.as_ref().map(|name| ("variant", format!("{name:?}")));
        match scene.or(variant) {
            Some((what, wanted)) => Err(IoError::not_there(path, what, wanted, &[])),
            None => Ok(()),
        }
    }

    /// What a file of this format says of itself.
    pub(crate) fn describe(
        self,
        path: &Path,
        bytes: &[u8],
        options: &LoadOptions,
    ) -> Result<Description, IoError> {
        match self {
            Format::Glb | Format::Gltf => gltf::describe(path, bytes, options),
            Format::Obj => Ok(Description::plain("Wavefront OBJ", bytes)),
            Format::Ply => Ok(Description::plain("Stanford PLY", bytes)),
            Format::Stl => Ok(Description::plain("STL", bytes)),
        }
    }
}

/// The format of a file, by its first bytes, then by its extension.
pub(crate) fn format_of(path: &Path, bytes: &[u8]) -> Result<Format, IoError> {
    if bytes.starts_with(b"glTF") {
        return Ok(Format::Glb);
    }
    if ply::is_ply(bytes) {
        return Ok(Format::Ply);
    }
    let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    match extension.as_str() {
        "gltf" => Ok(Format::Gltf),
        "obj" => Ok(Format::Obj),
        "ply" => Ok(Format::Ply),
        "stl" => Ok(Format::Stl),
        "glb" => Err(IoError::data(path, "byte 0", "not a binary glTF: it does not begin with `glTF`")),
        _ => Err(IoError::unsupported(
            path,
            "",
            format!("scenes of the kind .{extension}; what opens: {SCENE_FORMATS}"),
        )),
    }
}
