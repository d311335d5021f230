//! Both backends over one scene.

use lumbre::{CameraChoice, CameraOptions, LoadOptions};
use lumbre_core::Film;
use lumbre_core::settings::{RenderSettings, View};
use lumbre_cpu::CpuBackend;
use lumbre_scene::{Background, CompiledScene, Environment, Scene};
use lumbre_testkit::paired::{Bounds, Paired};
use lumbre_testkit::{TestGpu, gpu};
use lumbre_vulkan::{SceneOptions, VulkanBackend};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A scene on both devices.
pub(crate) struct Both {
    pub(crate) cpu: CpuBackend,
    pub(crate) vulkan: VulkanBackend,
    _gpu: TestGpu,
}

/// How a picture is compared.
#[derive(Clone, Copy)]
pub(crate) struct Shot {
    /// Columns and rows.
    pub(crate) size: [u32; 2],
    /// Samples of each pixel.
    pub(crate) spp: u32,
    pub(crate) bounds: Bounds,
}

impl Shot {
    /// Two samples of each pixel without textures.
    pub(crate) const PLAIN: Shot = Shot { size: [40, 30], spp: 2, bounds: Bounds::PLAIN };
    /// The same with textures.
    pub(crate) const TEXTURED: Shot = Shot { bounds: Bounds::TEXTURED, ..Shot::PLAIN };

    pub(crate) fn aspect(&self) -> f32 {
        self.size[0] as f32 / self.size[1] as f32
    }
}

impl Both {
    /// `None` where there is no GPU, which has been said then.
    pub(crate) fn new(scene: CompiledScene) -> Option<Self> {
        let gpu = gpu()?;
        let vulkan = VulkanBackend::new(&gpu, &scene, SceneOptions::default()).expect("the scene fits");
        Some(Both { cpu: CpuBackend::new(scene), vulkan, _gpu: gpu })
    }

    /// Renders `spp` samples of each pixel on both, one by one, into films like `empty`.
    pub(crate) fn pairs(&self, view: &View, empty: &Film, spp: u32) -> Vec<(Film, Film)> {
        on_cpu(&self.cpu, view, empty, spp).into_iter().zip(self.on_gpu(view, empty, spp)).collect()
    }

    /// One film for each sample, by the GPU.
    pub(crate) fn on_gpu(&self, view: &View, empty: &Film, spp: u32) -> Vec<Film> {
        let sample = |index: u32| {
            let mut film = empty.clone();
            self.vulkan.render(view, index..index + 1, &mut film, &()).expect("the GPU renders");
            film
        };
        (0..spp).map(sample).map(sound).collect()
    }

    /// Compares a picture, prints its row of the table, and says what is out of bounds.
    pub(crate) fn faults(&self, name: &str, view: &View, shot: &Shot) -> Vec<String> {
        self.faults_in(name, view, &Film::new(shot.size[0], shot.size[1]), shot)
    }

    /// The same in films like `empty`.
    pub(crate) fn faults_in(&self, name: &str, view: &View, empty: &Film, shot: &Shot) -> Vec<String> {
        let began = Instant::now();
        // Made before, so that the time is that of drawing.
        lumbre::Backend::warm_up(&self.vulkan, view).expect("the pipeline is made");
        let made = began.elapsed().as_secs_f32();
        let paired = Paired::new(&self.pairs(view, empty, shot.spp), &shot.bounds);
        println!("{name}: {paired}; {made:.1} + {:.1} s", began.elapsed().as_secs_f32() - made);
        let faults = paired.faults(&shot.bounds);
        faults.into_iter().map(|fault| format!("{name}: {fault}")).collect()
    }
}

/// One film for each sample, by the CPU.
pub(crate) fn on_cpu(backend: &CpuBackend, view: &View, empty: &Film, spp: u32) -> Vec<Film> {
    let sample = |index: u32| {
        let mut film = empty.clone();
        backend.render(view, index..index + 1, &mut film, &());
        film
    };
    (0..spp).map(sample).map(sound).collect()
}

fn sound(film: Film) -> Film {
    assert_eq!(film.non_finite_count(), 0, "{:?}", film.non_finite());
    assert!(film.pixels().iter().all(|p| p.saturated() == 0), "saturated sums");
    film
}

/// A file's scene and the view of one of its cameras. One without light gets a sky, one without a camera is put in view whole.
pub(crate) fn load(path: &Path, camera: &str, aspect: f32) -> (CompiledScene, View) {
    let mut loaded = lumbre::load_scene(path, &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    let mut scene = compile(&loaded.scene);
    if scene.lights.is_empty() {
        loaded.scene.environment =
            Environment { background: Background::Gradient, ..loaded.scene.environment };
        scene = compile(&loaded.scene);
    }
    let choice = match camera {
        "" => CameraChoice::Default,
        name => CameraChoice::Name(name.into()),
    };
    let options = CameraOptions { choice, ..CameraOptions::default() };
    let found = lumbre::find_camera(&loaded.scene, &scene, &options, aspect).expect("a camera");
    (scene, View { camera: found.camera, settings: RenderSettings::default(), frame: 0 })
}

/// The folder of scenes that are not ours; `None`, with a line for each file that is wanted of it, where there is none.
pub(crate) fn shared(files: &[&str]) -> Option<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/scenes");
    let folder = std::env::var_os("LUMBRE_SCENES").map_or_else(beside, PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    files.iter().for_each(|file| println!("skipped: {file}: no folder of shared scenes (LUMBRE_SCENES)"));
    None
}

pub(crate) fn compile(scene: &Scene) -> CompiledScene {
    lumbre::compile(scene).expect("the scene compiles").scene
}

/// Fails with all faults at once, so that one run shows the whole table.
pub(crate) fn assert_none(faults: &[String]) {
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}
