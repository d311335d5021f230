//! The whole of what an author writes.

use crate::{Camera, Environment, Image, Light, Material, Mesh, Node, NodeId, Texture};
use glam::Mat4;
use std::sync::Arc;

/// A scene. Ids index its vectors; `compile` checks them.
///
/// What is large is shared by clones: a clone costs as much as nodes and materials do. [`crate::recompile`] takes what is shared for
/// unchanged, so whoever edits a scene clones it and leaves meshes and images alone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Name or path, for messages.
    pub name: String,
    /// Meshes; to be changed through [`Arc::make_mut`].
    pub meshes: Arc<Vec<Mesh>>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Textures.
    pub textures: Vec<Texture>,
    /// Images; to be changed through [`Arc::make_mut`].
    pub images: Arc<Vec<Image>>,
    /// Punctual lights.
    pub lights: Vec<Light>,
    /// Cameras.
    pub cameras: Vec<Camera>,
    /// All nodes; those that no root reaches are not drawn.
    pub nodes: Vec<Node>,
    /// Nodes without a parent.
    pub roots: Vec<NodeId>,
    /// Light from far away.
    pub environment: Environment,
}

/// A node that a root reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedNode {
    /// Which.
    pub id: NodeId,
    /// Its transform to world space.
    pub to_world: Mat4,
    /// Neither it nor an ancestor is hidden.
    pub visible: bool,
}

impl Scene {
    /// Adds a mesh and returns its id.
    pub fn add_mesh(&mut self, mesh: Mesh) -> crate::MeshId {
        let meshes = Arc::make_mut(&mut self.meshes);
        meshes.push(mesh);
        crate::MeshId(meshes.len() as u32 - 1)
    }
    /// Adds an image and returns its id.
    pub fn add_image(&mut self, image: Image) -> crate::ImageId {
        let images = Arc::make_mut(&mut self.images);
        images.push(image);
        crate::ImageId(images.len() as u32 - 1)
    }
    /// Adds a material and returns its id.
    pub fn add_material(&mut self, material: Material) -> crate::MaterialId {
        self.materials.push(material);
        crate::MaterialId(self.materials.len() as u32 - 1)
    }
    /// Adds a root node and returns its id.
    pub fn add_root(&mut self, node: Node) -> NodeId {
        let id = NodeId(self.nodes.len() as u32);
        self.nodes.push(node);
        self.roots.push(id);
        id
    }

    /// Nodes reached from the roots with their transforms to world space, depth first, parents before children; hidden ones too.
    /// A node that is its own ancestor, or has two parents, is visited once.
    pub fn world_nodes(&self) -> Vec<(NodeId, Mat4)> {
        self.placed_nodes().into_iter().map(|n| (n.id, n.to_world)).collect()
    }

    /// The same, with whether each is visible: it and all its ancestors.
    pub fn placed_nodes(&self) -> Vec<PlacedNode> {
        let mut seen = vec![false; self.nodes.len()];
        let mut out = Vec::with_capacity(self.nodes.len());
        let mut stack: Vec<(NodeId, Mat4, bool)> =
            self.roots.iter().rev().map(|&r| (r, Mat4::IDENTITY, true)).collect();
        while let Some((id, parent, visible)) = stack.pop() {
            let Some(node) = self.nodes.get(id.index()) else { continue };
            if std::mem::replace(&mut seen[id.index()], true) {
                continue;
            }
            let (to_world, visible) = (parent * node.transform, visible && node.visible);
            out.push(PlacedNode { id, to_world, visible });
            stack.extend(node.children.iter().rev().map(|&c| (c, to_world, visible)));
        }
        out
    }
}
