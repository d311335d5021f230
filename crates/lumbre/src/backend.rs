//! What draws: one trait, one implementation for each kind of device.

use lumbre_core::Film;
use lumbre_core::control::{Control, Progress};
use lumbre_core::settings::View;
use lumbre_cpu::CpuBackend;
use lumbre_cpu::bvh::{SimdLevel, UnknownSimdLevel};
use lumbre_scene::CompiledScene;
use std::ops::Range;

/// Where to render.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Device {
    /// The best there is; today the CPU.
    #[default]
    Auto,
    /// All processors of this machine, or those of the rayon pool that calls.
    Cpu,
}

/// A device cannot be used as it is asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DeviceError {
    /// The environment variable `LUMBRE_SIMD` holds no known level.
    #[error(transparent)]
    SimdLevel(#[from] UnknownSimdLevel),
}

impl Device {
    /// Whether the device can be used: what [`prepare`] would find, but before there is a scene.
    ///
    /// # Errors
    /// As [`prepare`].
    pub fn check(self) -> Result<(), DeviceError> {
        match self {
            Device::Auto | Device::Cpu => Ok(SimdLevel::detect().map(drop)?),
        }
    }
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
    fn render(&self, view: &View, samples: Range<u32>, film: &mut Film, control: &dyn Control) -> Progress;
}

impl Backend for CpuBackend {
    fn device(&self) -> String {
        let threads = rayon::current_num_threads();
        let plural = if threads == 1 { "" } else { "s" };
        format!("CPU ({}, {threads} thread{plural})", self.accel().level().name())
    }

    fn memory(&self) -> u64 {
        self.accel().memory() as u64
    }

    fn render(&self, view: &View, samples: Range<u32>, film: &mut Film, control: &dyn Control) -> Progress {
        CpuBackend::render(self, view, samples, film, control)
    }
}

/// Prepares a compiled scene for a device.
///
/// # Errors
/// If the environment variable `LUMBRE_SIMD`, which may lower the SIMD level of the CPU, holds no known level.
pub fn prepare(scene: CompiledScene, device: Device) -> Result<Box<dyn Backend>, DeviceError> {
    match device {
        Device::Auto | Device::Cpu => Ok(Box::new(prepare_cpu(scene)?)),
    }
}

/// Prepares a compiled scene for the CPU, which can do more than any [`Backend`]: take one sample again, step by step.
///
/// # Errors
/// As [`prepare`].
pub fn prepare_cpu(scene: CompiledScene) -> Result<CpuBackend, DeviceError> {
    let level = SimdLevel::detect()?;
    Ok(CpuBackend::new(scene).with_level(level))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_scene::{Scene, compile};

    #[test]
    fn every_device_says_what_it_is() {
        for device in [Device::Auto, Device::Cpu] {
            device.check().unwrap();
            let scene = compile(&Scene::default()).unwrap().scene;
            let said = prepare(scene, device).unwrap().device();
            assert!(
                said.starts_with("CPU (") && said.contains(SimdLevel::detect().unwrap().name()),
                "{said}"
            );
        }
    }
}
