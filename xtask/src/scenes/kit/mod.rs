//! What the generators of scenes are made from: meshes and shapes, pictures and noise, materials, and a writer of glTF. All
//! arithmetic is `f64` with the transcendental functions of `libm`, so that every machine makes the same bytes.

#[cfg(test)]
mod census;
mod glb;
mod material;
mod mesh;
mod noise;
mod picture;
mod placement;
mod png;
mod shapes;
mod solids;
mod text;

#[cfg(test)]
pub(crate) use census::Census;
pub(crate) use glb::{Document, Geometry};
pub(crate) use material::{Material, Texture};
pub(crate) use mesh::Mesh;
#[cfg(test)]
pub(crate) use mesh::checks;
pub(crate) use noise::{Noise, hash01};
pub(crate) use picture::{Grey, Picture, mix, smoothstep, srgb};
pub(crate) use placement::Placement;
pub(crate) use png::chunk as png_chunk;
pub(crate) use shapes::{faceted, icosphere, rectangle, revolve, rounded_box, trefoil};
pub(crate) use solids::{bevel_box, extrude, extrude_beveled, lathe, round_path, tube};
pub(crate) use text::lettering;
