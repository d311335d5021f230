//! The CPU backend of Lumbre: a wide SIMD BVH, the path tracer, and the tiles it works in.
//!
//! `unsafe` lives in the SIMD kernels of [`bvh`] and nowhere else.
#![deny(unsafe_code)]

pub mod accel;
pub mod backend;
#[allow(unsafe_code, reason = "SIMD kernels and the dispatch to them")]
pub mod bvh;
mod catcher;
pub mod interaction;
pub mod light_sampling;
mod lobes;
pub mod observer;
pub mod path;
pub mod shadow;
pub mod surface;
pub mod tracer;

pub use accel::CpuOptions;
pub use backend::CpuBackend;
