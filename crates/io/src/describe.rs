//! What a scene file says of itself, without what it holds: told even of a file that cannot be drawn.

use crate::gltf::Support;
use crate::{IoError, LoadOptions, files};
use std::path::Path;

/// A scene file by its head. Text stands as the file has it; [`one_line`](crate::one_line) makes it fit for a terminal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Description {
    /// The format, for people.
    pub format: &'static str,
    /// Bytes of the file, without those that it names.
    pub file_bytes: u64,
    /// The program that wrote it, if it says.
    pub generator: Option<String>,
    /// Extensions it uses, those that it requires first.
    pub extensions: Vec<UsedExtension>,
    /// Names of its scenes, empty where one has none. glTF alone has several.
    pub scenes: Vec<String>,
    /// The scene that is shown unless another is asked for.
    pub default_scene: usize,
    /// Names of the variants of its materials.
    pub variants: Vec<String>,
    /// What the file lists, in the words of its format, and how many of each: nodes, meshes, skins…
    pub lists: Vec<(&'static str, usize)>,
}

impl Description {
    /// Of a format whose files say nothing of themselves.
    pub(crate) fn plain(format: &'static str, bytes: &[u8]) -> Self {
        Description {
            format,
            file_bytes: bytes.len() as u64,
            generator: None,
            extensions: Vec::new(),
            scenes: Vec::new(),
            default_scene: 0,
            variants: Vec::new(),
            lists: Vec::new(),
        }
    }
}

/// An extension that a file uses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UsedExtension {
    /// Its name.
    pub name: String,
    /// The file cannot be drawn without it.
    pub required: bool,
    /// How much of it is read; `None`: nothing.
    pub support: Option<Support>,
}

/// Reads what a scene file says of itself. Files that it names are not opened.
///
/// # Errors
/// `CannotOpen` if the file cannot be read; `BadData` if it is of no known format, its head is damaged, or it exceeds a
/// limit.
pub fn describe_scene(path: impl AsRef<Path>, options: &LoadOptions) -> Result<Description, IoError> {
    let path = path.as_ref();
    let bytes = files::read_file(path, options.limits.max_file_bytes)?;
    crate::open::format_of(path, &bytes)?.describe(path, &bytes, options)
}
