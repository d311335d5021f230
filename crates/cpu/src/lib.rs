//! The CPU backend.
pub mod bvh;
