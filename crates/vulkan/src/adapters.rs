//! The adapters of this machine: what they are, what they lack, and which one is meant.

use crate::error::{Called, VulkanError};
use crate::features::{Features, Offer};
use crate::instance::{Instance, Validation};
use ash::vk;
use std::cmp::Reverse;
use std::convert::Infallible;
use std::str::FromStr;

/// What kind of thing an adapter is, best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A card.
    Discrete,
    /// Part of the processor.
    Integrated,
    /// Part of a virtual machine.
    Virtual,
    /// Something else.
    Other,
    /// A driver that computes on the processor; our own CPU backend is much faster.
    Cpu,
}

impl std::fmt::Display for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Kind::Discrete => "discrete",
            Kind::Integrated => "integrated",
            Kind::Virtual => "virtual",
            Kind::Other => "other",
            Kind::Cpu => "CPU",
        })
    }
}

/// One adapter, and whether it will do.
#[derive(Clone, Debug)]
pub struct Adapter {
    /// Its number in the list, as `gpu:N` means it.
    pub index: usize,
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: Kind,
    /// Name of its driver.
    pub driver: String,
    /// Version of the driver, as the driver writes it.
    pub driver_version: String,
    /// Version of Vulkan, major and minor and patch.
    pub vulkan: [u32; 3],
    /// Memory of its own, bytes: its largest device-local heap.
    pub memory: u64,
    /// Names of the extensions and features that it lacks; empty: it will do.
    pub missing: Vec<String>,
    /// What it has beyond that.
    pub features: Features,
    /// Names of what it lacks for hybrid frames; empty: it draws them.
    pub lacks_for_hybrid: Vec<String>,
    pub(crate) raw: vk::PhysicalDevice,
    pub(crate) queue_family: u32,
    /// Bits of the clock of its queue; 0: it has none.
    pub(crate) clock_bits: u32,
}

/// Which adapter is meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// The best that will do, but no driver that computes on the processor.
    Auto,
    /// The best that will do.
    Best,
    /// That of this number in the list.
    Number(usize),
    /// The best whose name contains this, in any case.
    Named(String),
}

impl FromStr for Wanted {
    type Err = Infallible;

    /// `auto`, `gpu`, `gpu:N`, or part of a name.
    fn from_str(text: &str) -> Result<Self, Infallible> {
        let number = || text.strip_prefix("gpu:")?.parse().ok();
        Ok(match text {
            "auto" => Wanted::Auto,
            "gpu" => Wanted::Best,
            _ => number().map_or_else(|| Wanted::Named(text.to_owned()), Wanted::Number),
        })
    }
}

/// All adapters, best first: those that will do, then by kind, then by memory.
///
/// # Errors
/// If there is no Vulkan.
pub fn adapters() -> Result<Vec<Adapter>, VulkanError> {
    list(&Instance::get(Validation::Off)?.raw)
}

/// All adapters of an instance, best first.
pub(crate) fn list(instance: &ash::Instance) -> Result<Vec<Adapter>, VulkanError> {
    // SAFETY: a live instance.
    let devices = unsafe { instance.enumerate_physical_devices() }.called("vkEnumeratePhysicalDevices")?;
    let mut found: Vec<Adapter> = devices.into_iter().map(|d| describe(instance, d)).collect();
    rank(&mut found);
    Ok(found)
}

/// Puts the best first and numbers them.
fn rank(adapters: &mut [Adapter]) {
    adapters.sort_by_key(|a| (!a.missing.is_empty(), a.kind, Reverse(a.memory)));
    adapters.iter_mut().enumerate().for_each(|(i, a)| a.index = i);
}

/// The one that is meant, of a list with the best first.
///
/// # Errors
/// If there is none, or if it lacks something.
pub(crate) fn choose<'a>(adapters: &'a [Adapter], wanted: &Wanted) -> Result<&'a Adapter, VulkanError> {
    let will_do = |a: &&Adapter| a.missing.is_empty();
    let none = || VulkanError::NoDevice(adapters.iter().map(Adapter::verdict).collect());
    let no_such = |name: String| VulkanError::NoSuchDevice {
        wanted: name,
        found: adapters.iter().map(|a| a.name.clone()).collect(),
    };
    let chosen = match wanted {
        Wanted::Auto => adapters.iter().filter(will_do).find(|a| a.kind != Kind::Cpu).ok_or_else(none)?,
        Wanted::Best => adapters.iter().find(will_do).ok_or_else(none)?,
        Wanted::Number(n) => adapters.get(*n).ok_or_else(|| no_such(format!("gpu:{n}")))?,
        Wanted::Named(part) => {
            let part = part.to_lowercase();
            let mut fits = adapters.iter().filter(|a| a.name.to_lowercase().contains(&part));
            fits.next().ok_or_else(|| no_such(part.clone()))?
        }
    };
    if chosen.missing.is_empty() {
        return Ok(chosen);
    }
    Err(VulkanError::Missing { device: chosen.name.clone(), what: chosen.missing.clone() })
}

impl Adapter {
    /// Why `auto` does not take it, if it does not.
    fn verdict(&self) -> String {
        match &self.missing[..] {
            [] if self.kind == Kind::Cpu => format!("{} computes on the processor", self.name),
            [] => self.name.clone(),
            missing => format!("{} lacks {}", self.name, missing.join(", ")),
        }
    }
}

/// Cannot fail: one adapter that does not answer must not hide the others.
fn describe(instance: &ash::Instance, raw: vk::PhysicalDevice) -> Adapter {
    // SAFETY: a device of this live instance, here and below; structures of Vulkan 1.2 are only asked for where it is there.
    let basic = unsafe { instance.get_physical_device_properties(raw) };
    let version = basic.api_version;
    let vulkan =
        [vk::api_version_major(version), vk::api_version_minor(version), vk::api_version_patch(version)];
    let mut adapter = Adapter {
        index: 0,
        name: text(basic.device_name_as_c_str()),
        kind: kind(basic.device_type),
        driver: String::new(),
        driver_version: basic.driver_version.to_string(),
        vulkan,
        memory: own_memory(&unsafe { instance.get_physical_device_memory_properties(raw) }),
        missing: vec!["Vulkan 1.2".to_owned()],
        features: Features::default(),
        lacks_for_hybrid: vec!["Vulkan 1.2".to_owned()],
        raw,
        queue_family: 0,
        clock_bits: 0,
    };
    if version < vk::API_VERSION_1_2 {
        return adapter;
    }
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut all = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
    unsafe { instance.get_physical_device_properties2(raw, &mut all) };
    adapter.driver = text(driver.driver_name_as_c_str());
    adapter.driver_version = text(driver.driver_info_as_c_str());

    let extensions = unsafe { instance.enumerate_device_extension_properties(raw) };
    let extensions = match extensions.called("vkEnumerateDeviceExtensionProperties") {
        Ok(extensions) => extensions,
        Err(error) => {
            adapter.missing = vec![format!("a list of its extensions ({error})")];
            return adapter;
        }
    };
    let offer = Offer::of(instance, raw, extensions);
    let families = unsafe { instance.get_physical_device_queue_family_properties(raw) };
    adapter.missing = offer.missing();
    match queue_family(&families) {
        Some((family, graphics)) => {
            adapter.queue_family = family;
            adapter.clock_bits = families[family as usize].timestamp_valid_bits;
            adapter.features = offer.features(graphics);
            adapter.lacks_for_hybrid = offer.lacks_for_hybrid(graphics);
        }
        None => adapter.missing.push("a queue for compute".to_owned()),
    }
    adapter
}

/// A family of queues that computes, best one that draws too, and whether it does.
fn queue_family(families: &[vk::QueueFamilyProperties]) -> Option<(u32, bool)> {
    let with = |flags| families.iter().position(|f| f.queue_flags.contains(flags)).map(|i| i as u32);
    let both = with(vk::QueueFlags::COMPUTE | vk::QueueFlags::GRAPHICS).map(|i| (i, true));
    both.or_else(|| with(vk::QueueFlags::COMPUTE).map(|i| (i, false)))
}

/// The largest heap of the device's own memory.
fn own_memory(properties: &vk::PhysicalDeviceMemoryProperties) -> u64 {
    let heaps = properties.memory_heaps_as_slice().iter();
    heaps.filter(|h| h.flags.contains(vk::MemoryHeapFlags::DEVICE_LOCAL)).map(|h| h.size).max().unwrap_or(0)
}

fn kind(raw: vk::PhysicalDeviceType) -> Kind {
    match raw {
        vk::PhysicalDeviceType::DISCRETE_GPU => Kind::Discrete,
        vk::PhysicalDeviceType::INTEGRATED_GPU => Kind::Integrated,
        vk::PhysicalDeviceType::VIRTUAL_GPU => Kind::Virtual,
        vk::PhysicalDeviceType::CPU => Kind::Cpu,
        _ => Kind::Other,
    }
}

fn text(name: Result<&std::ffi::CStr, impl std::error::Error>) -> String {
    name.map_or_else(|_| String::new(), |n| n.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn adapter(name: &str, kind: Kind, memory: u64, missing: &[&str]) -> Adapter {
        Adapter {
            index: 0,
            name: name.to_owned(),
            kind,
            driver: String::new(),
            driver_version: String::new(),
            vulkan: [1, 3, 0],
            memory,
            missing: missing.iter().map(|&m| m.to_owned()).collect(),
            features: Features::default(),
            lacks_for_hybrid: Vec::new(),
            raw: vk::PhysicalDevice::null(),
            queue_family: 0,
            clock_bits: 0,
        }
    }

    fn machine() -> Vec<Adapter> {
        let mut all = vec![
            adapter("llvmpipe", Kind::Cpu, 100, &[]),
            adapter("Old Card", Kind::Discrete, 90, &["VK_KHR_ray_tracing_pipeline"]),
            adapter("Chip", Kind::Integrated, 80, &[]),
            adapter("Card A 8", Kind::Discrete, 8, &[]),
            adapter("Card B 16", Kind::Discrete, 16, &[]),
        ];
        rank(&mut all);
        all
    }

    #[test]
    fn the_best_comes_first() {
        let all = machine();
        let names: Vec<&str> = all.iter().map(|a| a.name.as_str()).collect();
        assert_eq!(names, ["Card B 16", "Card A 8", "Chip", "llvmpipe", "Old Card"]);
        assert!(all.iter().enumerate().all(|(i, a)| a.index == i));
    }

    #[test]
    fn selectors_are_parsed() {
        let parse = |s: &str| s.parse::<Wanted>().unwrap();
        assert_eq!(parse("auto"), Wanted::Auto);
        assert_eq!(parse("gpu"), Wanted::Best);
        assert_eq!(parse("gpu:2"), Wanted::Number(2));
        assert_eq!(parse("RTX"), Wanted::Named("RTX".to_owned()));
        assert_eq!(parse("gpu:x"), Wanted::Named("gpu:x".to_owned()));
    }

    #[test]
    fn what_is_meant_is_found() {
        let all = machine();
        let name = |w: &str| choose(&all, &w.parse().unwrap()).map(|a| a.name.clone());
        assert_eq!(name("auto").unwrap(), "Card B 16");
        assert_eq!(name("gpu").unwrap(), "Card B 16");
        assert_eq!(name("gpu:1").unwrap(), "Card A 8");
        assert_eq!(name("card a").unwrap(), "Card A 8");
        assert_eq!(name("LLVM").unwrap(), "llvmpipe");
        assert!(matches!(name("gpu:9"), Err(VulkanError::NoSuchDevice { .. })));
        assert!(matches!(name("nothing"), Err(VulkanError::NoSuchDevice { .. })));
        let missing = name("old").unwrap_err().to_string();
        assert_eq!(missing, "Old Card lacks VK_KHR_ray_tracing_pipeline");
    }

    /// `auto` never takes a driver that computes on the processor; `gpu` does where there is no other.
    #[test]
    fn a_processor_is_no_gpu_for_auto() {
        let all = [adapter("llvmpipe", Kind::Cpu, 100, &[])];
        assert_eq!(choose(&all, &Wanted::Best).unwrap().name, "llvmpipe");
        let error = choose(&all, &Wanted::Auto).unwrap_err().to_string();
        assert_eq!(error, "no GPU with Vulkan ray tracing (llvmpipe computes on the processor)");
        assert!(choose(&[], &Wanted::Best).is_err());
    }
}
