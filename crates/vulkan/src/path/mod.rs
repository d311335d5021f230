//! The path tracer: a scene on a GPU, rendered into films.

mod backend;
pub(crate) mod code;
pub(crate) mod film;
mod media;
mod passes;
mod slices;
pub(crate) mod variant;

pub use backend::{Canvas, OwnRays, RayBatch, VulkanBackend};
