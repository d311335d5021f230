//! The Vulkan backend of Lumbre: device, memory, acceleration structures, ray tracing pipelines.
//!
//! Vulkan is loaded at run time: a machine without it gets an error value. Everything that a [`Gpu`] makes holds on to it and is freed
//! when dropped. What can fail on a machine of a user (no driver, too little memory, a lost device) is a [`VulkanError`], never a panic.
//!
//! SPIR-V handed to this crate is trusted: it is that of `lumbre-shaders`, checked by `spirv-val` in its tests.

mod adapters;
mod buffer;
mod commands;
mod compute;
mod error;
mod features;
mod gpu;
mod instance;
mod kernel;
mod memory;
mod pipeline;
mod post;
mod specialisation;
#[cfg(test)]
mod tests;
mod upload;

pub use adapters::{Adapter, Kind, Wanted, adapters};
pub use buffer::{Buffer, Purpose};
pub use commands::{Commands, Pending};
pub use error::VulkanError;
pub use features::Features;
pub use gpu::{Gpu, Options};
pub use instance::Validation;
pub use kernel::Kernel;
pub use memory::MemoryUse;
pub use post::Post;
pub use specialisation::Specialisation;
pub use upload::Upload;
