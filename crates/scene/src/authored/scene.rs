//! The whole of what an author writes.

use crate::{Camera, Environment, Image, Light, Material, Mesh, Node, NodeId, Texture};
use glam::Mat4;

/// A scene. Ids index its vectors; `compile` checks them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Name or path, for messages.
    pub name: String,
    /// Meshes.
    pub meshes: Vec<Mesh>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Textures.
    pub textures: Vec<Texture>,
    /// Images.
    pub images: Vec<Image>,
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

impl Scene {
    /// Adds a mesh and returns its id.
    pub fn add_mesh(&mut self, mesh: Mesh) -> crate::MeshId {
        self.meshes.push(mesh);
        crate::MeshId(self.meshes.len() as u32 - 1)
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

    /// Nodes reached from the roots with their transforms to world space, depth first, parents before children.
    /// A node that is its own ancestor, or has two parents, is visited once.
    pub fn world_nodes(&self) -> Vec<(NodeId, Mat4)> {
        let mut seen = vec![false; self.nodes.len()];
        let mut out = Vec::with_capacity(self.nodes.len());
        let mut stack: Vec<(NodeId, Mat4)> = self.roots.iter().rev().map(|&r| (r, Mat4::IDENTITY)).collect();
        while let Some((id, parent)) = stack.pop() {
            let Some(node) = self.nodes.get(id.index()) else { continue };
            if std::mem::replace(&mut seen[id.index()], true) {
                continue;
            }
            let world = parent * node.transform;
            out.push((id, world));
            stack.extend(node.children.iter().rev().map(|&c| (c, world)));
        }
        out
    }
}
