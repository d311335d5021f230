//! The GPU of this machine, for tests: one device that all tests of a program share, with the validation layer where it is installed.

use lumbre_vulkan::{Gpu, Kind, Options, Validation, VulkanError, Wanted};
use std::ops::Deref;
use std::sync::OnceLock;

/// A device; one message of the validation layer fails the test that holds it.
#[derive(Debug)]
pub struct TestGpu(Gpu);

/// The device that tests use: the one that `LUMBRE_TEST_GPU` selects (`gpu:N` or part of a name), or the best. Drivers that compute on
/// the processor count. `None`, with a line that says so, where there is no Vulkan with ray tracing pipelines.
///
/// # Panics
/// If there is none and `LUMBRE_REQUIRE_GPU` is 1, or if the device does not open for another reason.
pub fn gpu() -> Option<TestGpu> {
    static GPU: OnceLock<Result<Gpu, VulkanError>> = OnceLock::new();
    there(GPU.get_or_init(open).clone())
}

/// The same opened once more, for tests that lose it or count its memory.
///
/// # Panics
/// As [`gpu`].
pub fn own_gpu() -> Option<TestGpu> {
    there(open())
}

fn open() -> Result<Gpu, VulkanError> {
    let wanted = std::env::var("LUMBRE_TEST_GPU").map_or(Wanted::Best, |w| w.parse().unwrap());
    Gpu::open(&wanted, Options { validation: Validation::WhereInstalled, ..Options::default() })
}

fn there(opened: Result<Gpu, VulkanError>) -> Option<TestGpu> {
    match opened {
        Ok(gpu) => Some(TestGpu(gpu)),
        Err(error @ (VulkanError::NoLoader(_) | VulkanError::NoDevice(_))) => {
            let required = std::env::var("LUMBRE_REQUIRE_GPU").is_ok_and(|v| v == "1");
            assert!(!required, "LUMBRE_REQUIRE_GPU=1, but: {error}");
            println!("skipped: no Vulkan ray tracing device");
            None
        }
        Err(error) => panic!("{error}"),
    }
}

impl TestGpu {
    /// Whether it is one, not a driver that computes on the processor.
    pub fn is_real(&self) -> bool {
        self.0.adapter().kind != Kind::Cpu
    }
}

impl Deref for TestGpu {
    type Target = Gpu;

    fn deref(&self) -> &Gpu {
        &self.0
    }
}

impl Drop for TestGpu {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            let messages = self.0.messages();
            assert!(messages.is_empty(), "the validation layer says:\n{}", messages.join("\n"));
        }
    }
}
