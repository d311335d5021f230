//! Scenes in two forms. [`Scene`] is what an author writes: meshes, materials, textures, lights, cameras, nodes.
//! [`CompiledScene`] is what backends read: flat `#[repr(C)]` arrays made from it by `compile`.
//!
//! Units are metres, seconds and radians; +y is up, right-handed, cameras look along -z (as in glTF).
#![forbid(unsafe_code)]

pub mod authored;
pub mod compile;
pub mod compiled;

pub use authored::camera::{Camera, Projection};
pub use authored::environment::{Background, Environment, EnvironmentMap, Sun};
pub use authored::ids::*;
pub use authored::light::{Light, LightKind};
pub use authored::material::{
    AlphaMode, Anisotropy, Clearcoat, DiffuseTransmission, Iridescence, Material, Phong, Sheen, TextureRef,
    TextureTransform, Volume,
};
pub use authored::mesh::{Mesh, Primitive};
pub use authored::node::Node;
pub use authored::scene::{PlacedNode, Scene};
pub use authored::texture::{Filter, Image, Texture, Wrap};
pub use compile::{CompileError, Compiled, compile, recompile};
pub use compiled::CompiledScene;
pub use compiled::changes::{Part, SceneChanges};
