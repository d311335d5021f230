//! The scene graph.

use crate::{CameraId, LightId, MeshId, NodeId};
use glam::Mat4;

/// A place in the scene, and what stands there.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Name; may be empty.
    pub name: String,
    /// Affine transform to the parent's space.
    pub transform: Mat4,
    /// Nodes that move with this one.
    pub children: Vec<NodeId>,
    /// Mesh drawn here.
    pub mesh: Option<MeshId>,
    /// Camera placed here.
    pub camera: Option<CameraId>,
    /// Light placed here.
    pub light: Option<LightId>,
    /// Otherwise what stands here and on the nodes below is not drawn and gives no light (`KHR_node_visibility`). The bounds of the
    /// scene stay as they are, so that nothing else changes where a thing is hidden and shown again.
    pub visible: bool,
}

impl Default for Node {
    fn default() -> Self {
        Node {
            name: String::new(),
            transform: Mat4::IDENTITY,
            children: Vec::new(),
            mesh: None,
            camera: None,
            light: None,
            visible: true,
        }
    }
}
