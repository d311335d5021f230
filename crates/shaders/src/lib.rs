//! The shaders of Lumbre: GLSL sources (`glsl/`), their SPIR-V (`spirv/`, written by `cargo xtask shaders`), and the layout of
//! what they share with Rust. No Vulkan call.
//!
//! A shader twin has the file name, the function names, the order of steps and the constants of the Rust file that it repeats.
#![forbid(unsafe_code)]

pub mod camera;
pub mod film;
pub mod layout;
pub mod medium;
pub mod replay;
pub mod tables;
pub mod view;
