//! What draws: one trait, one implementation for each kind of device, and which device is taken.
//!
//! [`device`] says what can be asked for, [`list`] what there is, [`open`] brings the two together, and [`fallback`] goes on
//! where a device fails.

pub mod canvas;
pub mod device;
pub mod fallback;
pub mod frames;
pub mod hybrid;
pub mod list;
pub mod open;
#[cfg_attr(not(feature = "vulkan"), path = "without_vulkan.rs")]
mod vulkan;

pub use canvas::{Canvas, Developed};
pub use device::{Device, DeviceError, GpuChoice};
pub use fallback::Fallback;
pub use hybrid::FrameRenderer;
pub use list::{DeviceInfo, DeviceKind, Devices, devices};
pub use lumbre_core::measure::{AccelReport, Frames, PassTime, Replayed};
pub use open::{GpuOptions, OpenDevice};

use lumbre_core::Film;
use lumbre_core::control::{Control, Progress};
use lumbre_core::settings::View;
use lumbre_cpu::bvh::SimdLevel;
use lumbre_cpu::{CpuBackend, CpuOptions};
use lumbre_scene::{CompiledScene, SceneChanges};
use std::ops::Range;

/// A device failed while it rendered: it was lost, or its memory ran out.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{device}: {reason}")]
pub struct RenderError {
    /// The device, for people.
    pub device: String,
    /// What happened, in one line.
    pub reason: String,
}

/// A scene ready to be rendered on some device.
pub trait Backend: Send + Sync {
    /// The device, for people.
    fn device(&self) -> String;

    /// Bytes that its acceleration structures hold.
    fn memory(&self) -> u64;

    /// Adds the samples of a range to every pixel of a film that has the size of the picture. A sample is a pure function of
    /// view, pixel and index, so ranges may come in any order and from anywhere. Stops soon after it is cancelled; pixels may
    /// then differ in their sample counts.
    ///
    /// # Errors
    /// If the device fails. The film is then as it was before the call: what the range brought until then is thrown away whole,
    /// so that the same range can be asked for again, here after [`recover`](Self::recover) or of another backend.
    fn render(
        &self,
        view: &View,
        samples: Range<u32>,
        film: &mut Film,
        control: &dyn Control,
    ) -> Result<Progress, RenderError>;

    /// Takes an edited scene, which differs from the present one in `changes` ([`lumbre_scene::recompile`]); what it then draws is what
    /// a backend that was prepared for that scene would draw. What did not change is left as it is, most of all where the
    /// device was asked for that ([`OpenDevice::editable`]). Here, for backends that cannot: an error.
    ///
    /// # Errors
    /// If the device fails. Then nothing can be rendered before another update succeeds, or after [`recover`](Self::recover), with the edited
    /// scene.
    fn update(&mut self, _scene: CompiledScene, _changes: SceneChanges) -> Result<(), RenderError> {
        Err(RenderError { device: self.device(), reason: "its scene cannot be edited".into() })
    }

    /// Does what the first render of a view does once, such as making pipelines for its settings, so that renders are as fast as they
    /// will be and can be timed.
    ///
    /// # Errors
    /// If the device fails.
    fn warm_up(&self, _view: &View) -> Result<(), RenderError> {
        Ok(())
    }

    /// Gets ready to go on after an error of [`render`](Self::render), on another device if there is one, and returns what to
    /// tell people, in one line.
    ///
    /// # Errors
    /// `error` itself where there is no way on, as with most backends.
    fn recover(&self, error: RenderError) -> Result<String, RenderError> {
        Err(error)
    }

    /// What the passes of the device took since the scene was prepared, by its own clock; empty where it has none.
    fn pass_times(&self) -> Vec<PassTime> {
        Vec::new()
    }

    /// What a validation layer ([`GpuOptions::validation`]) has found so far, the oldest first; `None` where none listens.
    fn complaints(&self) -> Option<Vec<String>> {
        None
    }

    /// What there is of acceleration structures and what making them took; `None` where the device does not say.
    fn accel(&self) -> Option<AccelReport> {
        None
    }

    /// Draws `count` frames as an interactive program does, for measurements: each adds `spp` samples of every pixel to sums that
    /// stay on the device, from sample 0 on, and nothing is read back but counters. Here, for devices whose memory is that of the
    /// program: plain renders.
    ///
    /// # Errors
    /// If the device fails.
    fn frames(&self, view: &View, size: [u32; 2], spp: u32, count: u32) -> Result<Frames, RenderError> {
        frames::by_renders(self, view, size, spp, count)
    }

    /// Sums of a picture that people look at while it grows. Here, for devices whose memory is that of the program: a film, and plain
    /// renders.
    ///
    /// # Errors
    /// If the device fails.
    fn canvas(&self) -> Result<Box<dyn Canvas + '_>, RenderError> {
        Ok(Box::new(canvas::HostCanvas::new(self)))
    }

    /// Draws hybrid frames. Here, for devices that do not: an error.
    ///
    /// # Errors
    /// If the device cannot, or fails.
    fn frame_renderer(&self) -> Result<Box<dyn FrameRenderer + '_>, RenderError> {
        let reason = "it draws no hybrid frames: they are rasterised, which takes a GPU".into();
        Err(RenderError { device: self.device(), reason })
    }

    /// Collects the rays of a frame of one sample a pixel and traces them again by themselves, so many times, for measurements; `None`
    /// where the device does not know its rays apart from its shading.
    ///
    /// # Errors
    /// If the device fails, or the picture has more pixels than it follows at a time.
    fn replayed(&self, _view: &View, _size: [u32; 2], _runs: u32) -> Result<Option<Replayed>, RenderError> {
        Ok(None)
    }
}

impl Backend for CpuBackend {
    fn device(&self) -> String {
        cpu_name(self.accel().level())
    }

    fn memory(&self) -> u64 {
        self.accel().memory() as u64
    }

    fn render(
        &self,
        view: &View,
        samples: Range<u32>,
        film: &mut Film,
        control: &dyn Control,
    ) -> Result<Progress, RenderError> {
        Ok(CpuBackend::render(self, view, samples, film, control))
    }

    fn update(&mut self, scene: CompiledScene, changes: SceneChanges) -> Result<(), RenderError> {
        CpuBackend::update(self, scene, changes);
        Ok(())
    }
}

/// The CPU with its instruction set and the threads of the pool that asks.
fn cpu_name(level: SimdLevel) -> String {
    let threads = rayon::current_num_threads();
    let plural = if threads == 1 { "" } else { "s" };
    format!("CPU ({}, {threads} thread{plural})", level.name())
}

/// Prepares a compiled scene for a device. [`Device::open`] does the same in two steps, the first of which needs no scene.
///
/// # Errors
/// If the device cannot be had, or the scene does not fit into its memory; [`Device::Auto`] then takes the CPU. If the
/// environment variable `LUMBRE_SIMD`, which may lower the SIMD level of the CPU, holds no known level.
pub fn prepare(scene: CompiledScene, device: Device) -> Result<Box<dyn Backend>, DeviceError> {
    Ok(device.open(&GpuOptions::default())?.prepare(scene)?.backend)
}

/// Prepares a compiled scene for the CPU, which can do more than any [`Backend`]: take one sample again, step by step.
///
/// # Errors
/// If the environment variable `LUMBRE_SIMD` holds no known level.
pub fn prepare_cpu(scene: CompiledScene) -> Result<CpuBackend, DeviceError> {
    prepare_cpu_with(scene, CpuOptions::default())
}

/// The same, as `options` ask.
///
/// # Errors
/// As [`prepare_cpu`].
pub fn prepare_cpu_with(scene: CompiledScene, options: CpuOptions) -> Result<CpuBackend, DeviceError> {
    let level = SimdLevel::detect()?;
    Ok(CpuBackend::with_options(scene, options).with_level(level))
}
