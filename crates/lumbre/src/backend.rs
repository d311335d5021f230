//! What draws: one trait, one implementation for each kind of device.

use lumbre_core::Film;
use lumbre_core::control::{Control, Progress};
use lumbre_core::settings::View;
use lumbre_cpu::CpuBackend;
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

/// A scene ready to be rendered on some device.
pub trait Backend: Send + Sync {
    /// The device, for people.
    fn device(&self) -> String;

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

    fn render(&self, view: &View, samples: Range<u32>, film: &mut Film, control: &dyn Control) -> Progress {
        CpuBackend::render(self, view, samples, film, control)
    }
}

/// Prepares a compiled scene for a device.
pub fn prepare(scene: CompiledScene, device: Device) -> Box<dyn Backend> {
    match device {
        Device::Auto | Device::Cpu => Box::new(CpuBackend::new(scene)),
    }
}
