//! The devices of this machine, and which of them is taken.

use super::{Device, GpuChoice, cpu_name, vulkan};
use lumbre_cpu::bvh::SimdLevel;

/// Kinds of devices, those that are taken first before the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DeviceKind {
    /// A card of its own.
    DiscreteGpu,
    /// In the processor.
    IntegratedGpu,
    /// Of a virtual machine.
    VirtualGpu,
    /// A kind that Vulkan has no name for.
    OtherGpu,
    /// A Vulkan driver that runs on the CPU, slower than [`Cpu`](Self::Cpu): taken only when it is asked for.
    Software,
    /// The processors.
    Cpu,
}

/// A device of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeviceInfo {
    /// What asks for this one.
    pub device: Device,
    /// Its kind.
    pub kind: DeviceKind,
    /// Its name.
    pub name: String,
    /// Name and version of its driver; `None` for the CPU.
    pub driver: Option<String>,
    /// Bytes of memory of its own; `None` where it has that of the machine.
    pub memory: Option<u64>,
    /// What it lacks to draw, in words; empty: nothing.
    pub lacks: Vec<String>,
}

/// The devices of this machine, the CPU first, then all that Vulkan lists, the best first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Devices {
    /// The devices; never empty.
    pub list: Vec<DeviceInfo>,
    /// Why Vulkan lists none, in one line.
    pub problem: Option<String>,
}

/// Looks for the devices of this machine. A driver that fails is a [`problem`](Devices::problem), not an error.
pub fn devices() -> Devices {
    let level = SimdLevel::detect().unwrap_or(SimdLevel::Portable);
    let (kind, name) = (DeviceKind::Cpu, cpu_name(level));
    let cpu = DeviceInfo { device: Device::Cpu, kind, name, driver: None, memory: None, lacks: Vec::new() };
    let (gpus, problem) = match vulkan::adapters() {
        Ok(gpus) if gpus.is_empty() => (gpus, Some("Vulkan lists no device".into())),
        Ok(gpus) => (gpus, None),
        Err(problem) => (Vec::new(), Some(problem)),
    };
    Devices { list: std::iter::once(cpu).chain(gpus).collect(), problem }
}

impl Devices {
    /// Which one of the list a choice takes, and why, in a few words.
    ///
    /// # Errors
    /// Why none, in one line; never for [`Device::Auto`] and [`Device::Cpu`].
    pub fn choose(&self, device: &Device) -> Result<(usize, String), String> {
        match device {
            Device::Cpu => Ok((self.cpu(), AS_ASKED.into())),
            Device::Auto => Ok(self.auto()),
            Device::Gpu(choice) => self.gpu(choice).map(|i| (i, AS_ASKED.into())),
        }
    }

    fn cpu(&self) -> usize {
        self.list.iter().position(|d| d.kind == DeviceKind::Cpu).unwrap_or(0)
    }

    /// Places of the GPUs, by rank.
    fn ranked(&self) -> Vec<usize> {
        let mut gpus: Vec<usize> =
            (0..self.list.len()).filter(|i| self.list[*i].kind != DeviceKind::Cpu).collect();
        let rank = |i: &usize| {
            let d = &self.list[*i];
            (!d.lacks.is_empty(), d.kind, std::cmp::Reverse(d.memory))
        };
        gpus.sort_by_key(rank);
        gpus
    }

    fn auto(&self) -> (usize, String) {
        let best = self.ranked().first().map(|i| (*i, &self.list[*i]));
        match best {
            None => (self.cpu(), format!("auto: {}", self.no_gpu())),
            Some((_, d)) if !d.lacks.is_empty() => (self.cpu(), format!("auto: {}", lacking(d))),
            Some((_, d)) if d.kind == DeviceKind::Software => {
                (self.cpu(), format!("auto: no GPU, {} runs on the CPU too and is slower", d.name))
            }
            Some((i, _)) => (i, "auto: the best GPU that traces rays".into()),
        }
    }

    fn gpu(&self, choice: &GpuChoice) -> Result<usize, String> {
        let ranked = self.ranked();
        if ranked.is_empty() {
            return Err(self.no_gpu());
        }
        let found = match choice {
            GpuChoice::Best => ranked.first().copied(),
            GpuChoice::Index(_) => {
                let asked = Device::Gpu(choice.clone());
                ranked.into_iter().find(|i| self.list[*i].device == asked)
            }
            GpuChoice::Name(part) => {
                let part = part.to_lowercase();
                let name = |i: &usize| self.list[*i].name.to_lowercase();
                let exact = ranked.iter().copied().find(|i| name(i) == part);
                exact.or_else(|| ranked.into_iter().find(|i| name(i).contains(&part)))
            }
        };
        let i = found.ok_or_else(|| format!("there is none; there are {}", self.names()))?;
        if self.list[i].lacks.is_empty() { Ok(i) } else { Err(lacking(&self.list[i])) }
    }

    fn no_gpu(&self) -> String {
        self.problem.clone().unwrap_or_else(|| "Vulkan lists no device".into())
    }

    /// `gpu:0 (…), gpu:1 (…)`.
    fn names(&self) -> String {
        let gpus = self.list.iter().filter(|d| d.kind != DeviceKind::Cpu);
        gpus.map(|d| format!("{} ({})", d.device, d.name)).collect::<Vec<_>>().join(", ")
    }
}

const AS_ASKED: &str = "as --device asks";

fn lacking(d: &DeviceInfo) -> String {
    format!("{} lacks {}", d.name, d.lacks.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gpu(index: usize, kind: DeviceKind, name: &str, gib: u64, lacks: &[&str]) -> DeviceInfo {
        DeviceInfo {
            device: Device::Gpu(GpuChoice::Index(index)),
            kind,
            name: name.into(),
            driver: Some("a driver 1.0".into()),
            memory: Some(gib << 30),
            lacks: lacks.iter().map(ToString::to_string).collect(),
        }
    }

    fn machine(gpus: Vec<DeviceInfo>) -> Devices {
        let mut devices = devices();
        devices.list.truncate(1);
        let problem = gpus.is_empty().then(|| "no driver".into());
        devices.list.extend(gpus);
        Devices { problem, ..devices }
    }

    fn all() -> Devices {
        use DeviceKind::{DiscreteGpu, IntegratedGpu, Software};
        machine(vec![
            gpu(0, Software, "llvmpipe (LLVM 15)", 64, &[]),
            gpu(1, DiscreteGpu, "Old 9000", 48, &["ray tracing pipelines", "shaderInt64"]),
            gpu(2, IntegratedGpu, "Iris", 32, &[]),
            gpu(3, DiscreteGpu, "GeForce RTX 2060", 6, &[]),
            gpu(4, DiscreteGpu, "GeForce RTX 2060 SUPER", 8, &[]),
        ])
    }

    fn taken(devices: &Devices, text: &str) -> Result<String, String> {
        let (i, why) = devices.choose(&text.parse().unwrap())?;
        Ok(format!("{}: {why}", devices.list[i].device))
    }

    #[test]
    fn the_best_that_can_is_taken() {
        let all = all();
        assert_eq!(taken(&all, "auto").unwrap(), "gpu:4: auto: the best GPU that traces rays");
        for (asked, device) in [
            ("cpu", "cpu"),
            ("gpu", "gpu:4"),
            ("gpu:2", "gpu:2"),
            ("gpu:0", "gpu:0"),
            ("LLVMpipe", "gpu:0"),
            ("geforce", "gpu:4"),
            ("geforce rtx 2060", "gpu:3"),
        ] {
            assert_eq!(taken(&all, asked).unwrap(), format!("{device}: as --device asks"), "{asked}");
        }
        let said = taken(&all, "gpu:1").unwrap_err();
        assert_eq!(said, "Old 9000 lacks ray tracing pipelines, shaderInt64");
        for nothing in ["gpu:5", "voodoo"] {
            let said = taken(&all, nothing).unwrap_err();
            assert!(said.starts_with("there is none; there are gpu:0 (llvmpipe"), "{said}");
        }
    }

    #[test]
    fn where_no_gpu_can_auto_says_why_and_gpu_fails() {
        let only = |i: usize| machine(vec![all().list[1 + i].clone()]);
        let software = only(0);
        let said = taken(&software, "auto").unwrap();
        assert!(said.starts_with("cpu: auto: no GPU, llvmpipe"), "{said}");
        assert_eq!(taken(&software, "gpu").unwrap(), "gpu:0: as --device asks");
        let old = only(1);
        assert!(taken(&old, "auto").unwrap().starts_with("cpu: auto: Old 9000 lacks ray tracing"));
        assert!(taken(&old, "gpu").unwrap_err().starts_with("Old 9000 lacks"));
        let none = machine(Vec::new());
        assert_eq!(taken(&none, "auto").unwrap(), "cpu: auto: no driver");
        for asked in ["gpu", "gpu:0", "llvmpipe"] {
            assert_eq!(taken(&none, asked).unwrap_err(), "no driver");
        }
    }

    #[test]
    fn this_machine_has_a_cpu() {
        let devices = devices();
        assert_eq!(devices.list[0].device, Device::Cpu);
        assert!(devices.list.len() > 1 || devices.problem.is_some());
        let gpus = devices.list[1..].iter().enumerate();
        gpus.for_each(|(i, d)| assert_eq!(d.device, Device::Gpu(GpuChoice::Index(i))));
    }
}
