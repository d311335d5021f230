//! The path tracer: a scene on a GPU, rendered into films.

mod backend;
mod code;
mod film;
mod media;
mod passes;
mod slices;
mod variant;

pub use backend::{Canvas, OwnRays, RayBatch, VulkanBackend};
