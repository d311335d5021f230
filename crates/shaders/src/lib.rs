//! The shaders of Lumbre: GLSL sources (`glsl/`), their SPIR-V (`spirv/`, written by `cargo xtask shaders`), and the layout of
//! what they share with Rust. No Vulkan call.
//!
//! A shader twin has the file name, the function names, the order of steps and the constants of the Rust file that it repeats.
#![forbid(unsafe_code)]

pub mod camera;
pub mod film;
pub mod hybrid;
pub mod layout;
pub mod medium;
pub mod post;
pub mod replay;
pub mod tables;
pub mod view;

/// Passes of the path tracer, in the order in which a sample goes through them.
pub mod passes {
    /// Camera rays.
    pub const GENERATE: &[u8] = include_bytes!("../spirv/path/generate.comp.spv");
    /// Lengths of lists.
    pub const ADVANCE: &[u8] = include_bytes!("../spirv/path/advance.comp.spv");
    /// Closest surfaces.
    pub const TRACE: &[u8] = include_bytes!("../spirv/path/trace.rgen.spv");
    /// Surfaces, lights, directions.
    pub const SHADE: &[u8] = include_bytes!("../spirv/path/shade.comp.spv");
    /// Shadow rays.
    pub const SHADOW: &[u8] = include_bytes!("../spirv/path/shadow.rgen.spv");
    /// Shadow rays through what lets light through.
    pub const GLASS: &[u8] = include_bytes!("../spirv/path/glass.rgen.spv");
    /// Shadow catchers.
    pub const CATCH: &[u8] = include_bytes!("../spirv/path/catch.rgen.spv");
    /// Finished samples, to the film.
    pub const GATHER: &[u8] = include_bytes!("../spirv/path/gather.comp.spv");
}

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
