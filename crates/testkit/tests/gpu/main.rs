//! The GPU draws what the CPU draws.

mod common;
mod paired;
