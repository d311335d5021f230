//! The GPU against the CPU: hits, then whole paths.

mod common;
mod hits;
mod paired;
mod textures;
