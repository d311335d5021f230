//! Flags of `lumbre info`.

use super::loading::LoadingArgs;
use super::values::{Size, size};
use clap::Args;
use std::path::PathBuf;

/// Shown below the flags.
pub(crate) const EXAMPLES: &str = "\
Hints say why a picture might come out black or not as meant: no light, a camera that looks
elsewhere or stands inside a mesh, surfaces seen from behind, textures without coordinates.
To find them the scene is compiled, and rays are sent from its cameras and lamps.

Examples:
  lumbre info scene.glb
  lumbre info scene.gltf --size 3840x2160
      how much memory a picture of that size takes
  lumbre info scene.glb --json | jq '.hints[].kind'
      for programs; all lists in full

Exit codes:
  0 done (with hints or without), 2 wrong usage, 65 bad data, or a required extension that is
  not supported (what can be said without opening the rest is printed all the same), 66 a file
  cannot be opened, 74 cannot write";

/// Flags of `lumbre info`.
#[derive(Args, Debug)]
pub(crate) struct InfoArgs {
    /// Scene to open, as for `lumbre render`.
    #[arg(value_name = "SCENE")]
    pub(crate) scene: PathBuf,

    /// Size of the picture whose memory is predicted.
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "1280x720")]
    #[arg(allow_hyphen_values = true)]
    pub(crate) size: Size,

    /// Prints one JSON object; lengths in metres, angles in radians, memory in bytes.
    #[arg(long)]
    pub(crate) json: bool,

    #[command(flatten)]
    pub(crate) loading: LoadingArgs,
}
