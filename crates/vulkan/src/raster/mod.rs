//! Rasterisation: what the camera of a hybrid frame sees, as numbers of triangles. Draws have neither vertex nor index buffers; shaders read by
//! address what rays meet.

mod draws;
mod pipeline;
mod target;

pub(crate) use draws::{Draws, Face};
pub(crate) use pipeline::RasterPipeline;
pub(crate) use target::Target;
