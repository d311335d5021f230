//! Files to scenes and images, images to files. The only crate that opens files.
//!
//! Every file is taken for hostile: sizes are checked against [`Limits`] before memory is taken, names inside a scene
//! cannot lead out of its folder, and whatever is wrong ends in one [`IoError`] that names the file and the place.
#![forbid(unsafe_code)]

mod describe;
mod error;
mod files;
mod gltf;
mod guard;
mod image;
mod limits;
mod obj;
mod open;
mod ply;
mod polygon;
mod resolver;
mod stl;
mod warnings;

pub use describe::{Description, UsedExtension, describe_scene};
pub use error::{ErrorKind, IoError, one_line};
pub use files::{check_writable, read_text, write_text};
pub use gltf::{GLTF_EXTENSIONS, GltfExtension, Support};
pub use guard::decoder_is_running;
pub use image::exr::{ExrImage, ExrLayer, ExrWindow, write_exr};
pub use image::exr_read::read_exr;
pub use image::png::write_png;
pub use image::save::{DisplayImage, Picture, STANDARD_OUTPUT};
pub use image::{LinearImage, LoadedEnvironment, Range, read_environment, read_linear_image, read_picture};
pub use limits::{Bound, Limits};
pub use open::{LoadOptions, Loaded, SCENE_FORMATS, SceneChoice, load_scene};
