//! Twin tests: shader functions against the Rust functions that they repeat, on the same inputs.
//!
//! A kernel of `crates/shaders/glsl/twins` evaluates the shader's side; each file here is named after the kernel and evaluates
//! Rust's. Each has a sibling that shows that it fails when one side is disturbed. Most run twice ([`each_way`]), so that a driver that rounds
//! correctly shows what cards that round as Vulkan allows would.

mod bsdf;
mod camera;
mod columns;
mod environment;
mod film;
mod fresnel;
mod hash;
mod lights;
mod math;
mod medium;
mod microfacet;
mod post;
mod sampler;
mod tone;
mod warp;
mod wavelength;

use bytemuck::Pod;
use lumbre_vulkan::Specialisation;
use std::cell::Cell;

/// SPIR-V of a kernel.
macro_rules! kernel {
    ($name:literal) => {
        include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/../shaders/spirv/twins/", $name, ".comp.spv"))
    };
}
pub(crate) use kernel;

thread_local! {
    /// Kernels of this thread's test run as imprecisely as Vulkan allows.
    static LEAST_PRECISE: Cell<bool> = const { Cell::new(false) };
}

/// Runs a test as the device computes, and as imprecisely as a device may ([`lumbre_testkit::inexact`]): the latter where the device is a
/// driver that computes exactly, on the processor, since what a card does would add to it.
pub(crate) fn each_way(test: impl Fn()) {
    let exact = lumbre_testkit::gpu().is_some_and(|gpu| !gpu.is_real());
    for least in [false, true].into_iter().take(1 + usize::from(exact)) {
        LEAST_PRECISE.set(least);
        test();
    }
    LEAST_PRECISE.set(false);
}

/// What a kernel says to the inputs; `None` where there is no device. `tables` is what the kernel reads as `push.tables`.
pub(crate) fn evaluate<I: Pod, O: Pod>(spirv: &[u8], tables: &[u8], inputs: &[I]) -> Option<Vec<O>> {
    evaluate_with(spirv, tables, &Specialisation::new(), inputs)
}

/// The same with specialisation constants.
pub(crate) fn evaluate_with<I: Pod, O: Pod>(
    spirv: &[u8],
    tables: &[u8],
    constants: &Specialisation,
    inputs: &[I],
) -> Option<Vec<O>> {
    let gpu = lumbre_testkit::gpu()?;
    let least = LEAST_PRECISE.get().then(|| lumbre_testkit::inexact::inexact(spirv));
    let spirv = least.as_deref().unwrap_or(spirv);
    let kernel = gpu.kernel(spirv, tables, constants).unwrap_or_else(|e| panic!("{e}"));
    Some(kernel.run(inputs).unwrap_or_else(|e| panic!("{e}")))
}
