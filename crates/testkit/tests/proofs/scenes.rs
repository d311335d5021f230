//! Scenes of files, ready to be rendered.

use lumbre::{CameraOptions, LoadOptions};
use lumbre_core::settings::{RenderSettings, View};
use lumbre_cpu::CpuBackend;
use std::path::{Path, PathBuf};

/// A scene with the view of its camera.
pub(crate) struct Ready {
    pub(crate) backend: CpuBackend,
    pub(crate) view: View,
}

/// A file of `assets/scenes`.
pub(crate) fn asset(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes").join(name)
}

/// Opens a scene, for a picture of this aspect, with default settings.
pub(crate) fn open(path: &Path, aspect: f32) -> Ready {
    let loaded = lumbre::load_scene(path, &LoadOptions::default()).expect("the scene opens");
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let scene = lumbre::compile(&loaded.scene).expect("the scene compiles").scene;
    let found =
        lumbre::find_camera(&loaded.scene, &scene, &CameraOptions::default(), aspect).expect("a camera");
    assert!(!found.framed, "the scene has a camera");
    let view = View { camera: found.camera, settings: RenderSettings::default(), frame: 0 };
    Ready { backend: CpuBackend::new(scene), view }
}

/// Our own Cornell box: textures, glass, metal, an area light.
pub(crate) fn cornell() -> Ready {
    open(&asset("cornell.glb"), 4.0 / 3.0)
}
