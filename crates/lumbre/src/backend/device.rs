//! Which device is asked for: `auto`, `cpu`, `gpu`, `gpu:N` or a part of a GPU's name.

use lumbre_cpu::bvh::UnknownSimdLevel;
use std::fmt;
use std::str::FromStr;

/// Where to render.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub enum Device {
    /// The best GPU that can trace rays, or the CPU where there is none or it fails.
    #[default]
    Auto,
    /// All processors of this machine, or those of the rayon pool that calls.
    Cpu,
    /// A GPU, by Vulkan, and nothing else.
    Gpu(GpuChoice),
}

/// Which GPU.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub enum GpuChoice {
    /// The best one that can trace rays: a card of its own before one in the processor before a driver that runs on the CPU; among
    /// equals that with the most memory.
    #[default]
    Best,
    /// By its place in the list of [`devices`](crate::devices), the best first, from 0.
    Index(usize),
    /// The first whose name is this, or the best whose name holds it; case does not matter.
    Name(String),
}

/// A device cannot be used as it is asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DeviceError {
    /// The environment variable `LUMBRE_SIMD` holds no known level.
    #[error(transparent)]
    SimdLevel(#[from] UnknownSimdLevel),
    /// The GPU that is asked for cannot be had: no driver, no such GPU, one without ray tracing, too little memory.
    #[error("no GPU for `{asked}`: {reason}")]
    Unavailable {
        /// As it was asked for.
        asked: Device,
        /// Why not, in one line.
        reason: String,
    },
}

/// A text names no device.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoSuchDevice {
    /// It is empty.
    #[error("expected auto, cpu, gpu, gpu:N or the name of a GPU")]
    Empty,
    /// What follows `gpu:` is no number.
    #[error("{0:?} is not the number of a GPU, from 0; `lumbre devices` lists them")]
    Number(String),
}

impl FromStr for Device {
    type Err = NoSuchDevice;

    fn from_str(text: &str) -> Result<Self, NoSuchDevice> {
        Ok(match (text, text.strip_prefix("gpu:")) {
            ("", _) => return Err(NoSuchDevice::Empty),
            ("auto", _) => Device::Auto,
            ("cpu", _) => Device::Cpu,
            ("gpu", _) => Device::Gpu(GpuChoice::Best),
            (_, Some(number)) => match number.parse() {
                Ok(index) => Device::Gpu(GpuChoice::Index(index)),
                Err(_) => return Err(NoSuchDevice::Number(number.into())),
            },
            (name, None) => Device::Gpu(GpuChoice::Name(name.into())),
        })
    }
}

/// As [`FromStr`] reads it.
impl fmt::Display for Device {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Device::Auto => f.write_str("auto"),
            Device::Cpu => f.write_str("cpu"),
            Device::Gpu(GpuChoice::Best) => f.write_str("gpu"),
            Device::Gpu(GpuChoice::Index(index)) => write!(f, "gpu:{index}"),
            Device::Gpu(GpuChoice::Name(name)) => f.write_str(name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_names_a_device_and_is_its_name() {
        let named = Device::Gpu(GpuChoice::Name("GeForce RTX 2060".into()));
        for (text, device) in [
            ("auto", Device::Auto),
            ("cpu", Device::Cpu),
            ("gpu", Device::Gpu(GpuChoice::Best)),
            ("gpu:3", Device::Gpu(GpuChoice::Index(3))),
            ("GeForce RTX 2060", named),
        ] {
            assert_eq!(text.parse(), Ok(device.clone()));
            assert_eq!(device.to_string(), text);
        }
        assert_eq!("".parse::<Device>(), Err(NoSuchDevice::Empty));
        for wrong in ["gpu:", "gpu:x", "gpu:-1"] {
            let error = wrong.parse::<Device>().unwrap_err();
            assert!(matches!(&error, NoSuchDevice::Number(n) if wrong.ends_with(n.as_str())), "{error}");
        }
    }
}
