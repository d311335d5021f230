//! Lumbre, a physically based renderer, as a library: open a scene or build one, prepare it for a device, render samples into a
//! film, read the film.
//!
//! ```no_run
//! use lumbre::prelude::*;
//!
//! let loaded = lumbre::load_scene("scene.glb", &LoadOptions::default())?;
//! let compiled = lumbre::compile(&loaded.scene)?.scene;
//! let found = lumbre::find_camera(&loaded.scene, &compiled, &CameraOptions::default(), 4.0 / 3.0)?;
//! let view = View { camera: found.camera, settings: RenderSettings::default(), frame: 0 };
//! let backend = lumbre::prepare(compiled, Device::Auto)?;
//! let mut film = Film::new(800, 600);
//! lumbre::render(&*backend, &view, 0..64, &mut film, &());
//! let picture: Vec<u8> = lumbre::output::to_srgb8(&film, Exposure::Auto);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

pub mod backend;
pub mod camera;
pub mod cancel;
pub mod compare;
pub mod info;
pub mod light;
pub mod output;
pub mod render;

pub use backend::{Backend, Device, DeviceError, prepare, prepare_cpu};
pub use camera::{
    Aperture, CameraChoice, CameraOptions, Focus, authored_aspect, find_camera, focus_distance,
};
pub use cancel::{CancelToken, Watched};
pub use info::{Hint, HintKind, InfoError, SceneInfo, info};
pub use light::{LightKinds, light_kinds};
pub use lumbre_io::{LoadOptions, Loaded, load_scene};
pub use lumbre_scene::{CompileError, Compiled, compile};
pub use render::render;

pub use lumbre_core as core;
pub use lumbre_cpu as cpu;
pub use lumbre_io as io;
pub use lumbre_scene as scene;

/// What most programs need.
pub mod prelude {
    pub use crate::{Backend, CameraChoice, CameraOptions, CancelToken, Device, LoadOptions};
    pub use lumbre_core::color::Exposure;
    pub use lumbre_core::control::{Control, Progress};
    pub use lumbre_core::settings::{RenderSettings, View};
    pub use lumbre_core::{Camera, Film, Rgb};
    pub use lumbre_scene::Scene;
}
