//! Reading and writing files, in one program: linking is most of what a small test costs.

mod common;
mod compressed;
mod gltf_environment;
mod gltf_errors;
mod gltf_geometry;
mod gltf_instances;
mod gltf_lobes;
mod gltf_materials;
mod gltf_morph;
mod image_kinds;
mod images;
mod obj_geometry;
mod obj_materials;
mod obj_paths;
mod ply_and_stl;
mod save;
mod scenes;
