//! What an author writes. Plain data: loaders fill it, programs build it from vectors.

pub mod camera;
pub mod environment;
pub mod ids;
pub mod light;
pub mod material;
pub mod mesh;
pub mod node;
pub mod scene;
pub mod texture;
