//! Renders whose device fails on the way, with the CPU in the place of a GPU.

use super::job::{Job, Prepared};
use super::{outputs, scene};
use crate::exit::{Code, Failure};
use crate::flags::{Cli, Command};
use clap::Parser;
use lumbre::core::control::Control;
use lumbre::fingerprint::SceneHash;
use lumbre::io::{Limits, read_exr};
use lumbre::prelude::*;
use lumbre::scene::CompiledScene;
use lumbre::{Fallback, RenderError};
use std::ops::Range;
use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Instant;

const SMOOTH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/scenes/smooth.gltf");
const SPP: u32 = 24;

/// Is lost after some passes.
struct Flaky(lumbre::cpu::CpuBackend, AtomicU32);

impl Backend for Flaky {
    fn device(&self) -> String {
        "Flaky 1".into()
    }
    fn memory(&self) -> u64 {
        0
    }
    fn render(
        &self,
        view: &View,
        samples: Range<u32>,
        film: &mut Film,
        control: &dyn Control,
    ) -> Result<Progress, RenderError> {
        let left = self.1.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |n| n.checked_sub(1));
        left.map_err(|_| RenderError { device: self.device(), reason: "the device is lost".into() })?;
        Ok(self.0.render(view, samples, film, control))
    }
}

/// Renders into `dir/a.exr` on a backend made of the compiled scene.
fn run(dir: &Path, backend: impl FnOnce(CompiledScene) -> Box<dyn Backend>) -> Result<Code, Failure> {
    let out = dir.join("a.exr").display().to_string();
    let spp = SPP.to_string();
    let words = ["lumbre", "render", SMOOTH, "--size", "8x6", "--spp", &spp, "--progress", "off", "-o", &out];
    let Ok(Cli { command: Command::Render(args) }) = Cli::try_parse_from(words) else { panic!("flags") };
    let opened = scene::open(&args, &args.camera.options(&args.loading.edited)?)?;
    let view = View { camera: opened.camera, settings: args.settings(), frame: 0 };
    let job = Job {
        args: &args,
        outputs: outputs::check(&args)?,
        view,
        size: opened.size,
        part: args.camera.part(opened.size)?,
        scene: Some(SceneHash::new(&opened.compiled)),
        sky_added: opened.sky_added,
        began: Instant::now(),
    };
    let backend = backend(opened.compiled);
    let prepared = Prepared { backend: &*backend, load_seconds: 0.0, build_seconds: 0.0, scene_bytes: 0 };
    job.picture(&prepared, &CancelToken::new())
}

fn flaky(scene: CompiledScene, passes: u32) -> Box<dyn Backend> {
    Box::new(Flaky(lumbre::prepare_cpu(scene).unwrap(), AtomicU32::new(passes)))
}

fn file(dir: &Path) -> Vec<u8> {
    std::fs::read(dir.join("a.exr")).unwrap()
}

#[test]
fn a_gpu_that_fails_leaves_an_even_picture_and_69() {
    let dir = tempfile::tempdir().unwrap();
    let failure = run(dir.path(), |s| flaky(s, 3)).unwrap_err();
    assert_eq!(failure.code, Code::Unavailable);
    let says = "Flaky 1: the device is lost: the picture so far is written, ";
    let spp = failure.message.strip_prefix(says).and_then(|m| m.strip_suffix(" samples per pixel"));
    let spp: f32 = spp.unwrap_or_else(|| panic!("{}", failure.message)).parse().unwrap();
    let image = read_exr(dir.path().join("a.exr"), &Limits::default()).unwrap();
    let samples = image.layers.iter().find(|l| l.name == "samples").unwrap().channel("Y").unwrap();
    assert!(spp >= 3.0 && samples.iter().all(|s| *s == spp), "{spp}: {samples:?}");
    assert!(image.metadata.iter().any(|(n, _)| n == "lumbre.interrupted"));
}

#[test]
fn one_that_fails_at_once_leaves_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let failure = run(dir.path(), |s| flaky(s, 0)).unwrap_err();
    assert_eq!(failure.code, Code::Unavailable);
    assert!(failure.message.ends_with("before the first sample: nothing is written"), "{}", failure.message);
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 0);
}

#[test]
fn with_another_device_the_file_is_the_same() {
    let (one, two) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let cpu = |s: CompiledScene| -> Box<dyn Backend> { Box::new(lumbre::prepare_cpu(s).unwrap()) };
    assert_eq!(run(one.path(), cpu).unwrap(), Code::Done);
    let both = |s: CompiledScene| -> Box<dyn Backend> {
        Box::new(Fallback::new(flaky(s.clone(), 2), s, |s| Ok(Box::new(lumbre::prepare_cpu(s)?))))
    };
    assert_eq!(run(two.path(), both).unwrap(), Code::Done);
    assert!(file(one.path()) == file(two.path()));
}
