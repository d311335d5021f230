//! What can go wrong with a GPU, one line each.

use ash::vk;

/// Why the GPU could not do it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum VulkanError {
    /// Vulkan is not installed.
    #[error("no Vulkan: {0}")]
    NoLoader(String),
    /// No adapter can do what is needed; what each lacks.
    #[error("no GPU with Vulkan ray tracing{}", listed(.0))]
    NoDevice(Vec<String>),
    /// No adapter has that number or name.
    #[error("no GPU called {wanted}{}", listed(.found))]
    NoSuchDevice {
        /// What was asked for.
        wanted: String,
        /// Names of the adapters that are there.
        found: Vec<String>,
    },
    /// The adapter asked for lacks something.
    #[error("{device} lacks {}", .what.join(", "))]
    Missing {
        /// Its name.
        device: String,
        /// Extensions and features.
        what: Vec<String>,
    },
    /// A layer that was asked for is not installed.
    #[error("the validation layer VK_LAYER_KHRONOS_validation is not installed")]
    NoValidation,
    /// Memory of the device is out.
    #[error("not enough GPU memory for {what}: {} needed, {} available", bytes(*.needed), bytes(*.available))]
    OutOfMemory {
        /// What it was for.
        what: String,
        /// Bytes.
        needed: u64,
        /// Bytes.
        available: u64,
    },
    /// More than the device can address in one piece.
    #[error("{what}: {needed} is more than the {limit} that this GPU can take")]
    TooLarge {
        /// What is too large.
        what: String,
        /// How large it is.
        needed: u64,
        /// How large it may be.
        limit: u64,
    },
    /// The device was reset, removed or crashed.
    #[error("the GPU was lost (driver reset or crash)")]
    DeviceLost,
    /// The device did not finish in time; it counts as lost.
    #[error("the GPU did not finish {what} within {seconds} s")]
    Hang {
        /// What it was doing.
        what: &'static str,
        /// How long it was waited for.
        seconds: u64,
    },
    /// A call failed for a reason of its own.
    #[error("Vulkan: {call} failed: {result}")]
    Call {
        /// Which call.
        call: &'static str,
        /// What it answered.
        result: vk::Result,
    },
}

impl VulkanError {
    /// The device is of no use any more.
    pub fn is_lost(&self) -> bool {
        matches!(self, VulkanError::DeviceLost | VulkanError::Hang { .. })
    }
}

fn listed(names: &[String]) -> String {
    if names.is_empty() { String::new() } else { format!(" ({})", names.join("; ")) }
}

/// A number of bytes as people read it.
fn bytes(n: u64) -> String {
    const KIB: f64 = 1024.0;
    match n as f64 {
        n if n < KIB * KIB => format!("{:.1} KiB", n / KIB),
        n if n < KIB * KIB * KIB => format!("{:.1} MiB", n / (KIB * KIB)),
        n => format!("{:.2} GiB", n / (KIB * KIB * KIB)),
    }
}

/// Names the call that failed.
pub(crate) trait Called<T> {
    /// `DEVICE_LOST` and its like keep their own kind.
    fn called(self, call: &'static str) -> Result<T, VulkanError>;
}

impl<T> Called<T> for Result<T, vk::Result> {
    fn called(self, call: &'static str) -> Result<T, VulkanError> {
        self.map_err(|result| match result {
            vk::Result::ERROR_DEVICE_LOST => VulkanError::DeviceLost,
            _ => VulkanError::Call { call, result },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_error_is_one_clear_line() {
        let text = |e: VulkanError| {
            let line = e.to_string();
            assert!(!line.contains('\n'));
            line
        };
        let none = VulkanError::NoDevice(vec!["A lacks x".to_owned(), "B lacks y".to_owned()]);
        assert_eq!(text(none), "no GPU with Vulkan ray tracing (A lacks x; B lacks y)");
        assert_eq!(text(VulkanError::NoDevice(Vec::new())), "no GPU with Vulkan ray tracing");
        let memory =
            VulkanError::OutOfMemory { what: "the mesh".into(), needed: 3 << 30, available: 5 << 19 };
        assert_eq!(text(memory), "not enough GPU memory for the mesh: 3.00 GiB needed, 2.5 MiB available");
        let missing = VulkanError::Missing { device: "A".into(), what: vec!["x".into(), "y".into()] };
        assert_eq!(text(missing), "A lacks x, y");
        let call = Err::<(), _>(vk::Result::ERROR_FORMAT_NOT_SUPPORTED).called("vkCreateImage");
        assert_eq!(
            text(call.unwrap_err()),
            "Vulkan: vkCreateImage failed: Requested format is not supported on this device"
        );
        assert!(Err::<(), _>(vk::Result::ERROR_DEVICE_LOST).called("vkQueueSubmit").unwrap_err().is_lost());
    }
}
