//! Radiance measured by rendering, with its standard error.

use glam::Vec3;
use lumbre_core::film::Film;
use lumbre_core::filter::FilterKind;
use lumbre_core::sampler::SamplerKind;
use lumbre_core::settings::{RenderSettings, View};
use lumbre_core::{Camera, Rgb};
use lumbre_cpu::CpuBackend;
use lumbre_scene::{Scene, compile};

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
pub fn film(backend: &CpuBackend, camera: Camera, settings: RenderSettings, side: u32, spp: u32) -> Film {
    let mut film = Film::new(side, side);
    backend.render(&View { camera, settings, frame: 0 }, 0..spp, &mut film, &());
    assert_sound(&film);
    film
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
pub fn radiance(backend: &CpuBackend, camera: Camera, settings: RenderSettings) -> Estimate {
    const SIDE: u32 = 16;
    const PASS: u32 = 64;
    const MOST: u32 = 1 << 15;
    let mut film = Film::new(SIDE, SIDE);
    let mut taken = 0;
    loop {
        let view = View { camera, settings, frame: 0 };
        backend.render(&view, taken..taken + PASS, &mut film, &());
        taken += PASS;
        assert_sound(&film);
        let estimate = mean(&film);
        if estimate.error <= 7e-4 * estimate.mean || taken >= MOST {
            return estimate;
        }
    }
}

/// A grey of this value.
pub fn grey(v: f32) -> Rgb {
    Rgb::splat(v)
}
