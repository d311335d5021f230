//! The GPU against the CPU: hits, then whole paths.

mod built;
mod canvas;
mod common;
mod hits;
mod hybrid;
mod own_rays;
mod paired;
mod planted;
mod running;
mod scenes;
mod textures;
mod updates;
