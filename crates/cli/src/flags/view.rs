//! Flags of `lumbre view`.

use super::device::DeviceArgs;
use super::loading::LoadingArgs;
use super::values::{Size, size};
use clap::Args;
use std::path::PathBuf;

/// Shown below the flags.
pub(crate) const EXAMPLES: &str = "\
The picture is there at once, gets finer while one looks, and begins anew when something moves.
F1 shows all keys. Left drag orbits, right drag looks around, W A S D fly, a click picks.

Examples:
  lumbre view scene.glb
  lumbre view scene.glb --watch
      again and again while another program writes the file
  lumbre view scene.glb --edits scene.edits.json
      as it was left; `lumbre render scene.glb --edits scene.edits.json` draws it

Exit codes:
  0 the window was closed, 2 wrong usage, 65 bad edits, 66 a file cannot be opened, 69 no window can
  be opened here: there is no display, or nothing to draw on it with, 74 the report cannot be written";

/// Flags of `lumbre view`.
#[derive(Args, Debug)]
pub(crate) struct ViewArgs {
    /// Scene to open: glTF 2.0 (.gltf, .glb), Wavefront OBJ (.obj), PLY (.ply) or STL (.stl). Without one, it is opened in the window.
    #[arg(value_name = "SCENE")]
    pub(crate) scene: Option<PathBuf>,

    /// Opens the scene again when its file changes.
    #[arg(long)]
    pub(crate) watch: bool,

    /// Size of the window, in the points of the display. [default: 1280x800]
    #[arg(long, value_name = "WxH", value_parser = size)]
    #[arg(allow_hyphen_values = true)]
    pub(crate) size: Option<Size>,

    /// Writes what the window does to a file, a line of JSON for each step: how long it took, what it shows, and where the controls
    /// are, for programs that drive it.
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) device: DeviceArgs,

    #[command(flatten)]
    pub(crate) loading: LoadingArgs,
}
