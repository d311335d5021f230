//! The public library of Lumbre, a physically based renderer.
#![forbid(unsafe_code)]

pub mod compare;
