//! The Vulkan backend of Lumbre: device, memory, acceleration structures, ray tracing pipelines.
