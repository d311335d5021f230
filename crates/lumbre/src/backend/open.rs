//! From what is asked for to a device that is there, before there is a scene, and from there to a backend.

use super::vulkan::{self, Gpu};
use super::{Backend, Device, DeviceError, Fallback, RenderError, cpu_name, devices, prepare_cpu};
use lumbre_core::Film;
use lumbre_core::control::{Control, Progress};
use lumbre_core::settings::View;
use lumbre_cpu::bvh::SimdLevel;
use lumbre_scene::CompiledScene;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

/// How a GPU is used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GpuOptions {
    /// Vulkan's validation layer looks over every call: slow, for those who change the backend.
    pub validation: bool,
    /// For tests: the GPU counts as lost after so many renders.
    pub lose_after: Option<u32>,
}

/// A device that can be used.
pub struct OpenDevice {
    kind: Kind,
    name: String,
    why: String,
    notes: Vec<String>,
    asked: Device,
    options: GpuOptions,
}

enum Kind {
    Cpu,
    Gpu(Gpu),
}

/// A scene on a device.
pub struct Prepared {
    /// It.
    pub backend: Box<dyn Backend>,
    /// Why it is not the device that was opened, in one line.
    pub note: Option<String>,
}

impl Device {
    /// Opens the device, before there is a scene.
    ///
    /// # Errors
    /// If it cannot be had. [`Device::Auto`] then takes the CPU and fails only with the environment variable `LUMBRE_SIMD`.
    pub fn open(&self, options: &GpuOptions) -> Result<OpenDevice, DeviceError> {
        // A wrong variable is an error wherever the work is done.
        let level = SimdLevel::detect()?;
        let asked = self.clone();
        let cpu = |why: String| OpenDevice {
            kind: Kind::Cpu,
            name: cpu_name(level),
            why,
            notes: Vec::new(),
            asked: self.clone(),
            options: *options,
        };
        if *self == Device::Cpu {
            return Ok(cpu("as --device asks".into()));
        }
        let devices = devices();
        let unavailable = |reason: String| DeviceError::Unavailable { asked: self.clone(), reason };
        let (place, why) = devices.choose(self).map_err(unavailable)?;
        let taken = &devices.list[place];
        if taken.device == Device::Cpu {
            return Ok(cpu(why));
        }
        match vulkan::open(&taken.device, options) {
            Ok((gpu, notes)) => {
                let (kind, name, options) = (Kind::Gpu(gpu), taken.name.clone(), *options);
                Ok(OpenDevice { kind, name, why, notes, asked, options })
            }
            Err(reason) if *self == Device::Auto => Ok(cpu(format!("auto: {}: {reason}", taken.name))),
            Err(reason) => Err(unavailable(format!("{}: {reason}", taken.name))),
        }
    }
}

impl OpenDevice {
    /// The device, for people.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Why this one, in a few words.
    pub fn why(&self) -> &str {
        &self.why
    }

    /// What else is to be told of it, a line each: that the validation layer is not installed.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Whether it is a GPU.
    pub fn is_gpu(&self) -> bool {
        matches!(self.kind, Kind::Gpu(_))
    }

    /// Brings a scene to it. A GPU that [`Device::Auto`] chose is backed by the CPU ([`Fallback`]), for which the scene is kept.
    ///
    /// # Errors
    /// If the GPU that was asked for fails, or has too little memory for the scene.
    pub fn prepare(self, scene: CompiledScene) -> Result<Prepared, DeviceError> {
        let Kind::Gpu(gpu) = self.kind else { return on_cpu(scene, None) };
        let first = vulkan::prepare(gpu, &scene);
        match (first, self.asked) {
            (Ok(first), asked) => {
                let first = losing(first, self.options.lose_after);
                let backend: Box<dyn Backend> = match asked {
                    Device::Auto => Box::new(Fallback::new(first, move || Ok(Box::new(prepare_cpu(scene)?)))),
                    _ => first,
                };
                Ok(Prepared { backend, note: None })
            }
            (Err(reason), Device::Auto) => on_cpu(scene, Some(format!("{}: {reason}", self.name))),
            (Err(reason), asked) => {
                Err(DeviceError::Unavailable { asked, reason: format!("{}: {reason}", self.name) })
            }
        }
    }
}

fn on_cpu(scene: CompiledScene, failed: Option<String>) -> Result<Prepared, DeviceError> {
    let backend: Box<dyn Backend> = Box::new(prepare_cpu(scene)?);
    let note = failed.map(|reason| format!("{reason}; taking the {}", backend.device()));
    Ok(Prepared { backend, note })
}

/// Makes a backend fail after some renders.
fn losing(inner: Box<dyn Backend>, after: Option<u32>) -> Box<dyn Backend> {
    match after {
        None => inner,
        Some(renders) => Box::new(Losing { inner, left: AtomicU32::new(renders) }),
    }
}

/// A device that is lost after some renders.
struct Losing {
    inner: Box<dyn Backend>,
    left: AtomicU32,
}

impl Backend for Losing {
    fn device(&self) -> String {
        self.inner.device()
    }

    fn memory(&self) -> u64 {
        self.inner.memory()
    }

    fn render(
        &self,
        view: &View,
        samples: Range<u32>,
        film: &mut Film,
        control: &dyn Control,
    ) -> Result<Progress, RenderError> {
        let one_less = |left: u32| left.checked_sub(1);
        match self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, one_less) {
            Ok(_) => self.inner.render(view, samples, film, control),
            Err(_) => Err(RenderError { device: self.device(), reason: "lost, as a test asks".into() }),
        }
    }

    fn pass_times(&self) -> Vec<super::PassTime> {
        self.inner.pass_times()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{GpuChoice, Targets, render};
    use lumbre_core::Camera;
    use lumbre_core::settings::RenderSettings;
    use lumbre_scene::{Scene, compile};

    fn empty() -> CompiledScene {
        compile(&Scene::default()).unwrap().scene
    }

    #[test]
    fn the_cpu_is_always_there() {
        let open = Device::Cpu.open(&GpuOptions::default()).unwrap();
        assert!(!open.is_gpu() && open.notes().is_empty());
        assert_eq!(open.why(), "as --device asks");
        let name = open.name().to_owned();
        let prepared = open.prepare(empty()).unwrap();
        assert_eq!((prepared.backend.device(), prepared.note), (name.clone(), None));
        assert!(name.starts_with("CPU (") && name.contains(SimdLevel::detect().unwrap().name()), "{name}");
    }

    #[test]
    fn auto_is_always_there_too() {
        let open = Device::Auto.open(&GpuOptions::default()).unwrap();
        assert!(open.why().starts_with("auto: "), "{}", open.why());
        assert!(open.is_gpu() || open.name().starts_with("CPU ("));
    }

    #[test]
    fn a_gpu_that_is_not_there_is_an_error_that_says_so() {
        let asked = Device::Gpu(GpuChoice::Name("Voodoo 2".into()));
        let Err(error) = asked.open(&GpuOptions::default()) else { panic!("a Voodoo 2 in this machine") };
        assert!(error.to_string().starts_with("no GPU for `Voodoo 2`: "), "{error}");
    }

    #[test]
    fn a_device_is_lost_when_a_test_asks_for_it() {
        let cpu = || on_cpu(empty(), None).unwrap().backend;
        let camera = Camera::look_at(glam::Vec3::ZERO, glam::Vec3::Z, glam::Vec3::Y, 1.0, 1.0);
        let view = View { camera, settings: RenderSettings::default(), frame: 0 };
        let spp = |backend: Box<dyn Backend>| {
            render(&*backend, &view, Targets::spp(8), &mut Film::new(2, 2), &())
                .map(|o| o.spp)
                .map_err(|e| (e.outcome.spp, e.error.reason))
        };
        assert_eq!(spp(losing(cpu(), None)), Ok(8));
        assert_eq!(spp(losing(cpu(), Some(1000))), Ok(8));
        assert_eq!(spp(losing(cpu(), Some(2))), Err((2, "lost, as a test asks".into())));
    }
}
