//! Radiance measured by rendering, with its standard error.

use crate::paired::{Bounds, Paired};
use crate::{TestGpu, gpu};
use glam::Vec3;
use lumbre::Backend;
use lumbre_core::film::Film;
use lumbre_core::filter::FilterKind;
use lumbre_core::sampler::SamplerKind;
use lumbre_core::settings::{RenderSettings, View};
use lumbre_core::{Camera, Rgb};
use lumbre_cpu::CpuBackend;
use lumbre_scene::{CompiledScene, Scene, compile};
use lumbre_vulkan::{SceneOptions, VulkanBackend};
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Luminance with the standard error of its mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Mean.
    pub mean: f64,
    /// Standard error of the mean, from the spread of the camera samples.
    pub error: f64,
}

impl Estimate {
    /// Distance from a value in standard errors. `geometry` is the relative error that the shapes themselves make, such as a
    /// sphere made of triangles; it adds to the spread, as does the rounding of single precision.
    pub fn z(&self, expected: f64, geometry: f64) -> f64 {
        let systematic = (geometry + 1e-6) * expected.abs();
        (self.mean - expected).abs() / (self.error * self.error + systematic * systematic).sqrt()
    }

    /// # Panics
    /// Unless the estimate agrees with `expected` within 0.3 % and 4.5 standard errors.
    pub fn assert_is(&self, expected: f64, geometry: f64, what: &str) {
        let relative = (self.mean / expected - 1.0).abs();
        let z = self.z(expected, geometry);
        assert!(
            relative <= 0.003 && z < 4.5,
            "{what}: {:.6} ± {:.6}, expected {expected:.6} (off by {:.3} %, z = {z:.2})",
            self.mean,
            self.error,
            100.0 * relative
        );
    }
}

/// A pinhole that looks from `eye` at `target` through a square of half-angle `half_angle` radians.
pub fn pinhole(eye: Vec3, target: Vec3, half_angle: f32) -> Camera {
    let up = if (target - eye).normalize().y.abs() > 0.99 { Vec3::Z } else { Vec3::Y };
    Camera::look_at(eye, target, up, 2.0 * half_angle, 1.0)
}

/// Settings for closed forms: independent samples, box filter, no roulette, no limit of depth.
pub fn analytic_settings() -> RenderSettings {
    RenderSettings {
        max_depth: None,
        roulette: None,
        sampler: SamplerKind::Independent,
        seed: 1,
        filter: FilterKind::Box,
        ..RenderSettings::default()
    }
}

/// Renders `side` x `side` pixels.
///
/// # Panics
/// If the device fails, or a sample is not finite.
pub fn film(backend: &dyn Backend, camera: Camera, settings: RenderSettings, side: u32, spp: u32) -> Film {
    let mut film = Film::new(side, side);
    add_samples(backend, &View { camera, settings, frame: 0 }, 0..spp, &mut film);
    film
}

fn add_samples(backend: &dyn Backend, view: &View, samples: Range<u32>, film: &mut Film) {
    backend.render(view, samples, film, &()).unwrap_or_else(|e| panic!("{e}"));
    assert_sound(film);
}

fn assert_sound(film: &Film) {
    assert_eq!(film.non_finite_count(), 0, "samples that are not finite: {:?}", film.non_finite());
    assert!(film.pixels().iter().all(|p| p.saturated() == 0), "saturated sums");
}

/// Mean over all pixels of a film, with its error.
pub fn mean(film: &Film) -> Estimate {
    let n = film.pixels().len() as f64;
    let sum: f64 = film.pixels().iter().map(|p| f64::from(p.radiance().luminance())).sum();
    let variance: f64 = film.pixels().iter().map(|p| f64::from(p.error()).powi(2)).sum();
    Estimate { mean: sum / n, error: variance.sqrt() / n }
}

/// Compiles a scene for the CPU.
///
/// # Panics
/// If it does not compile.
pub fn prepare(scene: &Scene) -> CpuBackend {
    CpuBackend::new(compile(scene).expect("a test scene compiles").scene)
}

/// Mean radiance that a narrow camera sees: samples are added until the standard error is 0.07 % of the mean, so that a bound of
/// 0.3 % lies four errors away, or there are eight million.
///
/// # Panics
/// As [`film`].
pub fn radiance(backend: &dyn Backend, camera: Camera, settings: RenderSettings) -> Estimate {
    radiance_by(backend, camera, settings, 64)
}

/// The same, looking whether it is enough after every `pass` samples of each pixel.
fn radiance_by(backend: &dyn Backend, camera: Camera, settings: RenderSettings, pass: u32) -> Estimate {
    const MOST: u32 = 1 << 15;
    let view = View { camera, settings, frame: 0 };
    let mut film = Film::new(SIDE, SIDE);
    let mut taken = 0;
    loop {
        add_samples(backend, &view, taken..taken + pass, &mut film);
        taken += pass;
        let estimate = mean(&film);
        if estimate.error <= 7e-4 * estimate.mean || taken >= MOST {
            return estimate;
        }
    }
}

/// Rows and columns of the picture whose mean is taken.
const SIDE: u32 = 16;

/// A scene on the CPU, and on the GPU where there is one.
pub struct OnAll {
    cpu: CpuBackend,
    gpu: Option<(VulkanBackend, TestGpu)>,
}

impl OnAll {
    /// Prepares a scene.
    ///
    /// # Panics
    /// If it does not compile, or does not fit on the GPU.
    pub fn new(scene: &Scene) -> Self {
        let cpu = prepare(scene);
        let gpu = gpu().map(|gpu| {
            let backend = VulkanBackend::new(&gpu, cpu.scene(), SceneOptions::default());
            (backend.expect("a test scene fits"), gpu)
        });
        OnAll { cpu, gpu }
    }

    /// The mean radiance that a narrow camera sees is known: on the CPU and on a GPU within 0.3 % and 4.5 standard errors. A driver that
    /// computes on the processor takes long: there a picture is compared with the CPU's, sample by sample, unless one of the same
    /// materials and kinds of lights was.
    ///
    /// # Panics
    /// If it is another, or the two differ.
    pub fn assert_radiance(
        &self,
        camera: Camera,
        settings: RenderSettings,
        expected: f64,
        geometry: f64,
        what: &str,
    ) {
        radiance(&self.cpu, camera, settings).assert_is(expected, geometry, what);
        match &self.gpu {
            Some((backend, gpu)) if gpu.is_real() => {
                let seen = radiance_by(backend, camera, settings, 2048);
                seen.assert_is(expected, geometry, &format!("{what}, on the GPU"));
            }
            Some((backend, _)) if is_new(self.cpu.scene()) => {
                assert_paired(&self.cpu, backend, camera, settings, what);
            }
            _ => {}
        }
    }
}

/// Whether no scene of the same materials and kinds of lights was asked about in this program.
fn is_new(scene: &CompiledScene) -> bool {
    static SEEN: Mutex<BTreeSet<Vec<u8>>> = Mutex::new(BTreeSet::new());
    let kinds: BTreeSet<u32> = scene.lights.iter().map(|l| l.kind).collect();
    let mut key: Vec<u8> = kinds.into_iter().flat_map(u32::to_le_bytes).collect();
    let surfaces = scene.sections().into_iter().filter(|(name, _)| ["materials", "lobes"].contains(name));
    surfaces.for_each(|(_, bytes)| key.extend(bytes));
    SEEN.lock().unwrap_or_else(PoisonError::into_inner).insert(key)
}

fn assert_paired(
    cpu: &CpuBackend,
    gpu: &VulkanBackend,
    camera: Camera,
    settings: RenderSettings,
    what: &str,
) {
    const SPP: u32 = 2;
    let view = View { camera, settings, frame: 0 };
    let one = |backend: &dyn Backend, sample: u32| {
        let mut film = Film::new(SIDE, SIDE);
        add_samples(backend, &view, sample..sample + 1, &mut film);
        film
    };
    let pairs: Vec<(Film, Film)> = (0..SPP).map(|i| (one(cpu, i), one(gpu, i))).collect();
    let bounds = Bounds::PLAIN.with_triangles_of(cpu.scene().radius());
    let paired = Paired::new(&pairs, &bounds);
    println!("{what}: {paired}");
    let faults = paired.faults(&bounds);
    assert!(faults.is_empty(), "{what}: {}", faults.join("; "));
}

/// A grey of this value.
pub fn grey(v: f32) -> Rgb {
    Rgb::splat(v)
}
