//! Scenes of files, ready to be rendered.

use lumbre::{CameraOptions, LoadOptions};
use lumbre_core::film::Film;
use lumbre_core::settings::{RenderSettings, View};
use lumbre_cpu::CpuBackend;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A scene with the view of its camera.
#[derive(Debug)]
pub struct Ready {
    /// The scene.
    pub backend: CpuBackend,
    /// Its camera, with default settings.
    pub view: View,
}

/// A file of `assets/scenes`.
pub fn asset(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes").join(name)
}

/// Folder of the references and scenes shared with other renderers: `peers` beside the folder that `LUMBRE_SCENES` names, or
/// beside `shared/scenes` next to the workspace. `None` where there is none.
pub fn peers() -> Option<PathBuf> {
    let scenes = std::env::var_os("LUMBRE_SCENES")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/scenes"), PathBuf::from);
    let peers = scenes.parent()?.join("peers");
    peers.join("ref").is_dir().then_some(peers)
}

/// Opens a scene for a picture of this aspect.
///
/// # Panics
/// If it does not open without a warning, does not compile, or has no camera.
pub fn open(path: &Path, aspect: f32) -> Ready {
    let loaded = lumbre::load_scene(path, &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let scene = lumbre::compile(&loaded.scene).expect("the scene compiles").scene;
    let found =
        lumbre::find_camera(&loaded.scene, &scene, &CameraOptions::default(), aspect).expect("a camera");
    assert!(!found.framed, "{}: the scene has a camera", path.display());
    let view = View { camera: found.camera, settings: RenderSettings::default(), frame: 0 };
    Ready { backend: CpuBackend::new(scene), view }
}

impl Ready {
    /// Renders a range of samples.
    ///
    /// # Panics
    /// If a sample is not finite.
    pub fn film(&self, [width, height]: [u32; 2], samples: Range<u32>) -> Film {
        let mut film = Film::new(width, height);
        self.backend.render(&self.view, samples, &mut film, &());
        assert_eq!(film.non_finite_count(), 0, "samples that are not finite: {:?}", film.non_finite());
        film
    }
}
