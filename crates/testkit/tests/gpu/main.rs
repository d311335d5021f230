//! The GPU against the CPU.

mod hits;
