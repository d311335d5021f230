//! What is looked at: scenes, each with its cameras.

use crate::console;
use crate::exit::{Code, Failure};
use crate::flags::bench::BenchArgs;
use crate::flags::values::file_name;
use crate::lit::{self, Lit};
use lumbre::core::math::Vec3;
use lumbre::core::settings::{RenderSettings, View};
use lumbre::scene::{CompiledScene, Scene};
use lumbre::{CameraChoice, CameraOptions};
use std::env;
use std::path::{Path, PathBuf};

/// Our own scene with an exterior and an interior.
const POOL: &str = "assets/scenes/pool.glb";
/// Sponza in the folder of scenes by others.
const SPONZA: &str = "sponza/glTF/Sponza.gltf";
/// Where that folder is.
const SCENES: &str = "LUMBRE_SCENES";

/// A scene that is ready to be brought to a device.
pub(super) struct Place {
    /// Its file.
    pub(super) name: String,
    scene: Scene,
    /// Until it is brought to a device.
    pub(super) compiled: CompiledScene,
    cameras: Vec<(String, CameraOptions)>,
}

/// A camera of a place.
#[derive(Clone, Copy)]
pub(super) struct Eye<'a> {
    place: &'a Scene,
    compiled: &'a CompiledScene,
    pub(super) name: &'a str,
    options: &'a CameraOptions,
}

/// The scenes that are asked for, or those that are found.
pub(super) fn scenes(args: &BenchArgs) -> Result<Vec<PathBuf>, Failure> {
    if !args.scenes.is_empty() {
        return Ok(args.scenes.clone());
    }
    let pool = PathBuf::from(POOL);
    if !pool.is_file() {
        let message = format!("{POOL} is not here; name a scene, or run this in the folder of the sources");
        return Err(Failure::new(Code::CannotOpen, message));
    }
    let shared = env::var_os(SCENES).map_or_else(|| PathBuf::from("../shared/scenes"), PathBuf::from);
    let sponza = shared.join(SPONZA);
    if !sponza.is_file() {
        console::note(format_args!(
            "no Sponza: {} is not there ({SCENES} names the folder)",
            sponza.display()
        ));
        return Ok(vec![pool]);
    }
    Ok(vec![pool, sponza])
}

impl Place {
    /// Loads and compiles a scene.
    pub(super) fn open(path: &Path, args: &BenchArgs) -> Result<Self, Failure> {
        Self::of(path, lit::load(path, &args.loading, &args.light)?, args)
    }

    /// Compiles a scene that was loaded.
    pub(super) fn of(path: &Path, lit: Lit, args: &BenchArgs) -> Result<Self, Failure> {
        let cameras = cameras(path, args, &lumbre::camera::camera_names(&lit.scene));
        for (_, options) in &cameras {
            lumbre::authored_aspect(&lit.scene, &options.choice).map_err(Failure::usage)?;
        }
        let compiled = lumbre::compile(&lit.scene)?;
        compiled.notes.iter().for_each(console::warning);
        Ok(Place { name: file_name(path), scene: lit.scene, compiled: compiled.scene, cameras })
    }

    /// Its cameras.
    pub(super) fn eyes(&self) -> impl Iterator<Item = Eye<'_>> {
        self.cameras.iter().map(|(name, options)| Eye {
            place: &self.scene,
            compiled: &self.compiled,
            name,
            options,
        })
    }
}

impl<'a> Eye<'a> {
    /// The scene that it looks at.
    pub(super) fn scene(&self) -> &'a Scene {
        self.place
    }

    /// What it sees in a picture of this size.
    pub(super) fn view(&self, size: [u32; 2], settings: RenderSettings) -> Result<View, Failure> {
        let aspect = size[0] as f32 / size[1] as f32;
        let found = lumbre::find_camera(self.place, self.compiled, self.options, aspect);
        Ok(View { camera: found.map_err(Failure::usage)?.camera, settings, frame: 0 })
    }
}

/// Names of cameras and how to find them.
fn cameras(path: &Path, args: &BenchArgs, names: &[String]) -> Vec<(String, CameraOptions)> {
    let given = CameraOptions {
        look_from: args.look_from,
        look_at: args.look_at,
        fov: args.fov.map(f32::to_radians),
        ..CameraOptions::default()
    };
    let edited = args.loading.edited.camera_options();
    let with = |name: &str, choice| (name.to_owned(), CameraOptions { choice, ..given.clone() });
    if !args.camera.is_empty() {
        let choice =
            |n: &String| n.parse().map_or_else(|_| CameraChoice::Name(n.clone()), CameraChoice::Index);
        return args.camera.iter().map(|n| with(n, choice(n))).collect();
    }
    let moved = args.look_from.is_some() || args.look_at.is_some();
    if moved {
        return vec![with("of the flags", CameraChoice::Default)];
    }
    if edited != CameraOptions::default() {
        return vec![("of the edits".into(), CameraOptions { fov: given.fov.or(edited.fov), ..edited })];
    }
    if path.ends_with(SPONZA) {
        // It has no camera: along the nave, at the height of a man's eyes.
        let nave = CameraOptions {
            look_from: Some(Vec3::new(-9.5, 1.7, -0.4)),
            look_at: Some(Vec3::new(9.0, 4.0, 0.0)),
            fov: Some(args.fov.unwrap_or(60.0).to_radians()),
            ..CameraOptions::default()
        };
        return vec![("nave".into(), nave)];
    }
    match names {
        [] => vec![with("all in view", CameraChoice::Default)],
        names => names.iter().enumerate().map(|(i, n)| with(n, CameraChoice::Index(i))).collect(),
    }
}
