//! The shaders of Lumbre: GLSL sources (`glsl/`), their SPIR-V (`spirv/`, written by `cargo xtask shaders`), and the layout of
//! what they share with Rust. No Vulkan call.
//!
//! A shader twin has the file name, the function names, the order of steps and the constants of the Rust file that it repeats.
#![forbid(unsafe_code)]

pub mod camera;
pub mod film;
pub mod layout;
pub mod medium;
pub mod post;
pub mod replay;
pub mod tables;
pub mod view;

/// Ray generation of the path tracer.
pub const PATH_RGEN: &[u8] = include_bytes!("../spirv/path/path.rgen.spv");
/// Closest hit of a path's ray.
pub const RADIANCE_RCHIT: &[u8] = include_bytes!("../spirv/path/radiance.rchit.spv");
/// Any hit of a path's ray, for what is there only in part.
pub const RADIANCE_RAHIT: &[u8] = include_bytes!("../spirv/path/radiance.rahit.spv");
/// Miss of a path's ray.
pub const RADIANCE_RMISS: &[u8] = include_bytes!("../spirv/path/radiance.rmiss.spv");
/// Any hit of a shadow ray, for what may let light through.
pub const SHADOW_RAHIT: &[u8] = include_bytes!("../spirv/path/shadow.rahit.spv");
/// Miss of a shadow ray.
pub const SHADOW_RMISS: &[u8] = include_bytes!("../spirv/path/shadow.rmiss.spv");
/// First pass from a film to a display: luminance of blocks.
pub const POST_BLOCKS: &[u8] = include_bytes!("../spirv/post/blocks.comp.spv");
/// Second pass: exposure.
pub const POST_EXPOSURE: &[u8] = include_bytes!("../spirv/post/exposure.comp.spv");
/// Last pass: lens and tone curve.
pub const POST_DEVELOP: &[u8] = include_bytes!("../spirv/post/develop.comp.spv");
