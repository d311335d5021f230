//! Tests that need a device.

mod device;
mod scenes;

use crate::{Gpu, Options, Validation, VulkanError, Wanted};

/// A device of its own for each test, with the validation layer where it is installed; `None`, with a line that says so, where there
/// is none. `testkit::gpu` is the same for other crates, which see this one built another time.
pub(crate) fn gpu() -> Option<Gpu> {
    let wanted = std::env::var("LUMBRE_TEST_GPU").map_or(Wanted::Best, |w| w.parse().unwrap());
    match Gpu::open(&wanted, Options { validation: Validation::WhereInstalled, ..Options::default() }) {
        Ok(gpu) => Some(gpu),
        Err(error @ (VulkanError::NoLoader(_) | VulkanError::NoDevice(_))) => {
            let required = std::env::var("LUMBRE_REQUIRE_GPU").is_ok_and(|v| v == "1");
            assert!(!required, "LUMBRE_REQUIRE_GPU=1, but: {error}");
            println!("skipped: no Vulkan ray tracing device");
            None
        }
        Err(error) => panic!("{error}"),
    }
}

/// The validation layer has said nothing.
#[track_caller]
pub(crate) fn silent(gpu: &Gpu) {
    let messages = gpu.messages();
    assert!(messages.is_empty(), "the validation layer says:\n{}", messages.join("\n"));
}
