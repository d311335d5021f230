//! From what is asked for to a device that is there, before there is a scene, and from there to a backend.

use super::vulkan::{self, Gpu};
use super::{Backend, Device, DeviceError, Fallback, GpuChoice, cpu_name, devices, prepare_cpu_with};
use lumbre_cpu::CpuOptions;
use lumbre_cpu::bvh::SimdLevel;
use lumbre_scene::CompiledScene;

/// How a GPU is used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GpuOptions {
    /// Vulkan's validation layer looks over every call: slow, for those who change the backend.
    pub validation: bool,
}

/// A device that can be used.
pub struct OpenDevice {
    kind: Kind,
    name: String,
    why: String,
    notes: Vec<String>,
    asked: Device,
    editable: bool,
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
            editable: false,
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
                let (kind, name) = (Kind::Gpu(gpu), taken.name.clone());
                Ok(OpenDevice { kind, name, why, notes, asked, editable: false })
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

    /// The same, and no other device goes on where it fails.
    pub fn alone(self) -> Self {
        match self.asked {
            Device::Auto if self.is_gpu() => OpenDevice { asked: Device::Gpu(GpuChoice::Best), ..self },
            _ => self,
        }
    }

    /// The same, for scenes that will be edited: each mesh gets acceleration structures of its own, so that [`Backend::update`] need not
    /// build much anew. Rays take longer where many meshes overlap.
    pub fn editable(self) -> Self {
        OpenDevice { editable: true, ..self }
    }

    /// Brings a scene to it. A GPU that [`Device::Auto`] chose is backed by the CPU ([`Fallback`]), for which the scene is kept.
    ///
    /// # Errors
    /// If the GPU that was asked for fails, or has too little memory for the scene.
    pub fn prepare(self, scene: CompiledScene) -> Result<Prepared, DeviceError> {
        let options = CpuOptions { merge: !self.editable };
        let Kind::Gpu(gpu) = self.kind else { return on_cpu(scene, options, None) };
        let first = vulkan::prepare(&gpu, &scene, !self.editable);
        match (first, self.asked) {
            (Ok(first), asked) => {
                let backend: Box<dyn Backend> = match asked {
                    Device::Auto => Box::new(Fallback::new(first, scene, move |scene| {
                        Ok(Box::new(prepare_cpu_with(scene, options)?))
                    })),
                    _ => first,
                };
                Ok(Prepared { backend, note: None })
            }
            (Err(reason), Device::Auto) => on_cpu(scene, options, Some(format!("{}: {reason}", self.name))),
            (Err(reason), asked) => {
                Err(DeviceError::Unavailable { asked, reason: format!("{}: {reason}", self.name) })
            }
        }
    }
}

fn on_cpu(
    scene: CompiledScene,
    options: CpuOptions,
    failed: Option<String>,
) -> Result<Prepared, DeviceError> {
    let backend: Box<dyn Backend> = Box::new(prepare_cpu_with(scene, options)?);
    let note = failed.map(|reason| format!("{reason}; taking the {}", backend.device()));
    Ok(Prepared { backend, note })
}

#[cfg(test)]
mod tests {
    use super::*;
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
}
