//! Lumbre, a physically based renderer, as a library: open a scene or build one, prepare it for a device, render samples into a
//! film, read the film.
//!
//! It never prints, exits, installs a logger or panics on what it is given, but where a function says
//! so under "Panics"; its types are `Send` and `Sync`. It needs Rust 1.95.
//!
//! # A picture without any file
//!
//! `examples/embed.rs`, which `cargo run --release -p lumbre --example embed` runs:
//!
//! ```
#![doc = include_str!("../examples/embed.rs")]
//! ```
//!
//! # From file to file
//!
//! ```no_run
//! # #[cfg(feature = "files")]
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! use lumbre::prelude::*;
//!
//! let loaded = lumbre::load_scene("scene.glb", &LoadOptions::default())?;
//! let compiled = lumbre::compile(&loaded.scene)?.scene;
//! let found = lumbre::find_camera(&loaded.scene, &compiled, &CameraOptions::default(), 4.0 / 3.0)?;
//! let view = View { camera: found.camera, settings: RenderSettings::default(), frame: 0 };
//! let backend = lumbre::prepare(compiled, Device::Auto)?;
//! let mut film = Film::new(800, 600);
//! lumbre::render(&*backend, &view, Targets::spp(64), &mut film, &())?;
//! let picture: Vec<u8> = lumbre::output::to_srgb8(&film, Exposure::Auto);
//! # Ok(())
//! # }
//! # #[cfg(not(feature = "files"))]
//! # fn main() {}
//! ```
//!
//! # Features
//!
//! `files` (on by default) reads and writes files: [`load_scene`], [`info()`], [`output`], [`merge`]. Without it there is the
//! renderer alone, with few dependencies. `vulkan` (on by default) draws on GPUs; Vulkan itself is loaded at run time, and a
//! machine without it draws on the CPU.
#![forbid(unsafe_code)]

pub mod backend;
pub mod camera;
pub mod camera_path;
pub mod cancel;
pub mod compare;
#[cfg(feature = "files")]
pub mod edits;
pub mod estimate;
#[cfg(feature = "files")]
pub mod fingerprint;
#[cfg(feature = "files")]
pub mod info;
pub mod light;
pub mod look;
#[cfg(feature = "files")]
pub mod merge;
#[cfg(feature = "files")]
pub mod output;
pub mod planes;
pub mod render;
pub mod session;
pub mod targets;

pub use backend::{
    AccelReport, Backend, Canvas, Developed, Device, DeviceError, DeviceInfo, DeviceKind, Devices, Fallback,
    FrameRenderer, Frames, GpuChoice, GpuOptions, OpenDevice, PassTime, RenderError, Replayed, devices,
    prepare, prepare_cpu, prepare_cpu_with,
};
pub use camera::{
    Aperture, CameraChoice, CameraOptions, Focus, authored_aspect, find_camera, focus_distance,
};
pub use camera_path::{CameraPath, CameraPathError};
pub use cancel::{CancelToken, Watched};
pub use estimate::Estimator;
#[cfg(feature = "files")]
pub use info::{Hint, HintKind, InfoError, SceneInfo, info};
pub use light::{LightKinds, light_kinds};
pub use look::Look;
#[cfg(feature = "files")]
pub use lumbre_io::{LoadOptions, Loaded, load_scene};
pub use lumbre_scene::{CompileError, Compiled, SceneChanges, compile, recompile};
pub use planes::Plane;
pub use render::{Watch, render};
pub use targets::{Ended, Outcome, RenderFailed, SoFar, Targets};

pub use rayon;

pub use lumbre_core as core;
pub use lumbre_cpu as cpu;
#[cfg(feature = "files")]
pub use lumbre_io as io;
pub use lumbre_scene as scene;

/// What most programs need.
pub mod prelude {
    pub use crate::{Backend, CameraChoice, CameraOptions, CancelToken, Device, Look, Outcome, Targets};
    pub use lumbre_core::color::Exposure;
    pub use lumbre_core::control::{Control, Progress};
    pub use lumbre_core::settings::{RenderSettings, View};
    pub use lumbre_core::tone::ToneCurve;
    pub use lumbre_core::{Camera, Film, Rgb};
    #[cfg(feature = "files")]
    pub use lumbre_io::LoadOptions;
    pub use lumbre_scene::Scene;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_may_cross_threads() {
        fn crosses<T: Send + Sync>() {}
        crosses::<lumbre_scene::Scene>();
        crosses::<lumbre_scene::CompiledScene>();
        crosses::<Box<dyn Backend>>();
        crosses::<lumbre_core::Film>();
        crosses::<lumbre_core::settings::View>();
        crosses::<CancelToken>();
        crosses::<Outcome>();
        crosses::<(DeviceError, OpenDevice, Devices, Fallback, RenderFailed)>();
        #[cfg(feature = "files")]
        crosses::<(Loaded, lumbre_io::IoError, info::SceneInfo)>();
    }
}
