//! The Vulkan backend of Lumbre: device, memory, acceleration structures, ray tracing pipelines.
//!
//! Vulkan is loaded at run time: a machine without it gets an error value. Everything that a [`Gpu`] makes holds on to it and is freed
//! when dropped. What can fail on a machine of a user (no driver, too little memory, a lost device) is a [`VulkanError`], never a panic.
//!
//! SPIR-V handed to this crate is trusted: it is that of `lumbre-shaders`, checked by `spirv-val` in its tests.

mod accel;
mod adapters;
mod buffer;
mod cache;
mod commands;
mod compute;
mod descriptors;
mod error;
mod features;
mod gpu;
mod hybrid;
mod image;
mod instance;
mod kernel;
mod memory;
mod path;
mod pipeline;
mod post;
mod raster;
mod ray_pipeline;
mod replay;
mod sbt;
mod scene;
mod specialisation;
mod statistics;
#[cfg(test)]
mod tests;
mod timer;
mod upload;

pub use adapters::{Adapter, Kind, Wanted, adapters};
pub use buffer::{Buffer, Purpose};
pub use cache::PipelineCache;
pub use commands::{Commands, Pending};
pub use error::VulkanError;
pub use features::Features;
pub use gpu::{Gpu, Options};
pub use hybrid::Hybrid;
pub use instance::Validation;
pub use kernel::Kernel;
pub use lumbre_shaders::post::PostLook;
pub use memory::MemoryUse;
pub use path::{Canvas, OwnRays, RayBatch, VulkanBackend};
pub use post::Post;
pub use ray_pipeline::{HitShaders, RayPipeline, RayShaders};
pub use replay::Replay;
pub use scene::{SceneOnGpu, SceneOptions};
pub use specialisation::Specialisation;
pub use statistics::ShaderStatistics;
pub use timer::Timer;
pub use upload::Upload;
