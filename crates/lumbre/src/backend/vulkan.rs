//! The GPUs, by `lumbre-vulkan`: its adapters, handles and errors in this crate's terms.

use super::{
    AccelReport, Backend, Canvas, Developed, Device, DeviceInfo, DeviceKind, FrameRenderer, Frames,
    GpuChoice, GpuOptions, PassTime, RenderError, Replayed,
};
use crate::look::Look;
use lumbre_core::Film;
use lumbre_core::control::{Control, Progress};
use lumbre_core::hybrid::{FrameDone, FrameView, PixelPlanes};
use lumbre_core::settings::View;
use lumbre_scene::{CompiledScene, SceneChanges};
use lumbre_vulkan::{
    Adapter, Kind, Options, PostLook, SceneOptions, Validation, VulkanBackend, VulkanError, Wanted,
};
use std::ops::Range;

pub(super) use lumbre_vulkan::Gpu;

/// For tests: a driver that runs on the CPU counts as a GPU.
const SOFTWARE: &str = "LUMBRE_TEST_SOFTWARE_GPU";

/// The GPUs, the best first.
///
/// # Errors
/// Why there are none, in one line.
pub(super) fn adapters() -> Result<Vec<DeviceInfo>, String> {
    match lumbre_vulkan::adapters() {
        Ok(found) => Ok(found.into_iter().map(info).collect()),
        Err(VulkanError::NoDevice(_)) => Err("Vulkan finds no driver".into()),
        Err(e) => Err(e.to_string()),
    }
}

fn info(a: Adapter) -> DeviceInfo {
    let kind = match a.kind {
        Kind::Cpu if std::env::var_os(SOFTWARE).is_some() => DeviceKind::OtherGpu,
        Kind::Discrete => DeviceKind::DiscreteGpu,
        Kind::Integrated => DeviceKind::IntegratedGpu,
        Kind::Virtual => DeviceKind::VirtualGpu,
        Kind::Other => DeviceKind::OtherGpu,
        Kind::Cpu => DeviceKind::Software,
    };
    let [major, minor, patch] = a.vulkan;
    let driver = [a.driver, a.driver_version, format!("(Vulkan {major}.{minor}.{patch})")];
    let driver: Vec<String> = driver.into_iter().filter(|part| !part.is_empty()).collect();
    DeviceInfo {
        device: Device::Gpu(GpuChoice::Index(a.index)),
        kind,
        name: a.name,
        driver: Some(driver.join(" ")),
        memory: (a.memory > 0).then_some(a.memory),
        lacks: a.missing,
    }
}

/// Opens one of the adapters, and says what is to be told of it.
///
/// # Errors
/// Why it cannot be opened, in one line.
pub(super) fn open(device: &Device, options: &GpuOptions) -> Result<(Gpu, Vec<String>), String> {
    let wanted = match device {
        Device::Gpu(GpuChoice::Index(index)) => Wanted::Number(*index),
        Device::Gpu(GpuChoice::Name(name)) => Wanted::Named(name.clone()),
        _ => Wanted::Best,
    };
    let with = |validation| Gpu::open(&wanted, Options { validation, ..Options::default() });
    let opened = match with(if options.validation { Validation::On } else { Validation::Off }) {
        Err(e @ VulkanError::NoValidation) => {
            let note = format!("nothing is validated: {e}");
            with(Validation::Off).map(|gpu| (gpu, vec![note]))
        }
        other => other.map(|gpu| (gpu, Vec::new())),
    };
    opened.map_err(|e| e.to_string())
}

/// Brings a scene to a GPU; `merge`: meshes that stand in the world once share acceleration structures.
///
/// # Errors
/// If it fails or has too little memory, in one line.
pub(super) fn prepare(gpu: &Gpu, scene: &CompiledScene, merge: bool) -> Result<Box<dyn Backend>, String> {
    let backend = VulkanBackend::new(gpu, scene, SceneOptions { merge, ..SceneOptions::default() });
    Ok(Box::new(backend.map_err(|e| e.to_string())?))
}

impl Backend for VulkanBackend {
    fn device(&self) -> String {
        self.gpu().adapter().name.clone()
    }

    fn memory(&self) -> u64 {
        VulkanBackend::accel(self).bytes + VulkanBackend::accel(self).top_bytes
    }

    fn render(
        &self,
        view: &View,
        samples: Range<u32>,
        film: &mut Film,
        control: &dyn Control,
    ) -> Result<Progress, RenderError> {
        VulkanBackend::render(self, view, samples, film, control).map_err(|e| failed(self, &e))
    }

    fn update(&mut self, scene: CompiledScene, changes: SceneChanges) -> Result<(), RenderError> {
        VulkanBackend::update(self, &scene, changes).map_err(|e| failed(self, &e))
    }

    fn warm_up(&self, view: &View) -> Result<(), RenderError> {
        VulkanBackend::warm_up(self, &view.settings).map_err(|e| failed(self, &e))
    }

    fn pass_times(&self) -> Vec<PassTime> {
        VulkanBackend::pass_times(self)
    }

    fn accel(&self) -> Option<AccelReport> {
        Some(*VulkanBackend::accel(self))
    }

    fn complaints(&self) -> Option<Vec<String>> {
        self.gpu().validates().then(|| self.gpu().messages())
    }

    fn frames(&self, view: &View, size: [u32; 2], spp: u32, count: u32) -> Result<Frames, RenderError> {
        VulkanBackend::frames(self, view, size, spp, count).map_err(|e| failed(self, &e))
    }

    fn canvas(&self) -> Result<Box<dyn Canvas + '_>, RenderError> {
        let canvas = VulkanBackend::canvas(self).map_err(|e| failed(self, &e))?;
        Ok(Box::new(OnGpu { backend: self, canvas }))
    }

    fn frame_renderer(&self) -> Result<Box<dyn FrameRenderer + '_>, RenderError> {
        let renderer = self.hybrid().map_err(|e| failed(self, &e))?;
        Ok(Box::new(FramesOnGpu { backend: self, renderer }))
    }

    fn replayed(&self, view: &View, size: [u32; 2], runs: u32) -> Result<Option<Replayed>, RenderError> {
        VulkanBackend::replayed(self, view, size, runs).map(Some).map_err(|e| failed(self, &e))
    }
}

/// Sums on a GPU.
struct OnGpu<'a> {
    backend: &'a VulkanBackend,
    canvas: lumbre_vulkan::Canvas<'a>,
}

impl Canvas for OnGpu<'_> {
    fn clear(&mut self, size: [u32; 2]) -> Result<(), RenderError> {
        self.canvas.clear(size).map_err(|e| failed(self.backend, &e))
    }

    fn add(
        &mut self,
        view: &View,
        samples: Range<u32>,
        control: &dyn Control,
    ) -> Result<Progress, RenderError> {
        self.canvas.add(view, samples, control).map_err(|e| failed(self.backend, &e))
    }

    fn film(&mut self) -> Result<&Film, RenderError> {
        self.canvas.film().map_err(|e| failed(self.backend, &e))
    }

    fn develop(&mut self, look: &Look, offset: f32, ease: f32) -> Result<Option<Developed>, RenderError> {
        let Look { exposure, tone, vignette, aberration, transparent } = *look;
        let look = PostLook { exposure, offset, ease, tone, vignette, aberration, transparent };
        let (rgba, factor) = self.canvas.develop(&look).map_err(|e| failed(self.backend, &e))?;
        Ok(Some(Developed { rgba, factor }))
    }

    fn bytes(&self) -> u64 {
        self.canvas.bytes()
    }
}

/// Hybrid frames on a GPU.
struct FramesOnGpu<'a> {
    backend: &'a VulkanBackend,
    renderer: lumbre_vulkan::Hybrid<'a>,
}

impl FrameRenderer for FramesOnGpu<'_> {
    fn next(&mut self, shot: &FrameView<'_>) -> Result<Option<FrameDone>, RenderError> {
        self.renderer.next(shot).map_err(|e| failed(self.backend, &e))
    }

    fn finish(&mut self) -> Result<Option<FrameDone>, RenderError> {
        self.renderer.finish().map_err(|e| failed(self.backend, &e))
    }

    fn planes(&mut self) -> Result<Vec<PixelPlanes>, RenderError> {
        self.renderer.planes().map_err(|e| failed(self.backend, &e))
    }

    fn film(&mut self) -> Result<&Film, RenderError> {
        self.renderer.film().map_err(|e| failed(self.backend, &e))
    }
}

fn failed(backend: &VulkanBackend, error: &VulkanError) -> RenderError {
    RenderError { device: Backend::device(backend), reason: error.to_string() }
}
