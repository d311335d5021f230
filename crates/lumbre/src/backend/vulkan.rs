//! The GPUs, by `lumbre-vulkan`: its adapters, handles and errors in this crate's terms.

use super::{Backend, Device, DeviceInfo, DeviceKind, GpuChoice, GpuOptions};
use lumbre_scene::CompiledScene;
use lumbre_vulkan::{Adapter, Kind, Options, Validation, VulkanError, Wanted};

pub(super) use lumbre_vulkan::Gpu;

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

/// Brings a scene to a GPU.
///
/// # Errors
/// If it fails or has too little memory, in one line.
pub(super) fn prepare(gpu: Gpu, _scene: &CompiledScene) -> Result<Box<dyn Backend>, String> {
    Err(format!("this version cannot draw on {} yet", gpu.adapter().name))
}
