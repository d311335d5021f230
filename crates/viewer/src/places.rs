//! Where the things of a scene are: world transforms and boxes of its nodes, for framing, gizmos and the tree. Measuring meshes takes
//! a moment and is done where scenes are loaded; placing them again after an edit is quick.

use crate::navigation::Bounds;
use glam::{Mat4, Vec3};
use lumbre::scene::{NodeId, Scene};
use std::sync::Arc;

/// Boxes of the meshes of a scene, object space.
pub type MeshBounds = Arc<[Option<Bounds>]>;

/// Measures all meshes. Vertices that no triangle uses do not count.
pub fn mesh_bounds(scene: &Scene) -> MeshBounds {
    let used = |p: &lumbre::scene::Primitive| {
        Bounds::around(p.indices.iter().filter_map(|i| p.positions.get(*i as usize).copied()))
    };
    let one =
        |primitives: &[lumbre::scene::Primitive]| primitives.iter().filter_map(used).reduce(Bounds::with);
    scene.meshes.iter().map(|mesh| one(&mesh.primitives)).collect()
}

/// Places of the nodes of a scene; those that no root reaches have none.
#[derive(Clone, Debug, Default)]
pub struct Places {
    worlds: Vec<Option<Mat4>>,
    parents: Vec<Option<NodeId>>,
    boxes: Vec<Option<Bounds>>,
    all: Option<Bounds>,
}

impl Places {
    /// Of a scene whose meshes were measured.
    pub fn of(scene: &Scene, meshes: &[Option<Bounds>]) -> Self {
        let count = scene.nodes.len();
        let mut places = Places {
            worlds: vec![None; count],
            parents: vec![None; count],
            boxes: vec![None; count],
            all: None,
        };
        for (id, world) in scene.world_nodes() {
            places.worlds[id.index()] = Some(world);
            let node = &scene.nodes[id.index()];
            let mesh = node.mesh.and_then(|m| *meshes.get(m.index())?);
            places.boxes[id.index()] = mesh.and_then(|bounds| bounds.transformed(world));
            for child in &node.children {
                if let Some(parent) = places.parents.get_mut(child.index()) {
                    *parent = Some(id);
                }
            }
        }
        places.all = places.boxes.iter().flatten().copied().reduce(Bounds::with);
        places
    }

    /// From the node's space to the world.
    pub fn world(&self, node: NodeId) -> Option<Mat4> {
        *self.worlds.get(node.index())?
    }

    /// From the space that the node's transform leads to, to the world.
    pub fn parent_world(&self, node: NodeId) -> Mat4 {
        self.parent(node).and_then(|p| self.world(p)).unwrap_or(Mat4::IDENTITY)
    }

    /// The node that this one moves with.
    pub fn parent(&self, node: NodeId) -> Option<NodeId> {
        *self.parents.get(node.index())?
    }

    /// The box around what stands at a node and below it.
    pub fn bounds(&self, scene: &Scene, node: NodeId) -> Option<Bounds> {
        let mut stack = vec![node];
        let mut seen = vec![false; self.boxes.len()];
        let mut all = None;
        while let Some(id) = stack.pop() {
            let Some(seen) = seen.get_mut(id.index()) else { continue };
            if std::mem::replace(seen, true) {
                continue;
            }
            let own = self.boxes[id.index()];
            all = [all, own].into_iter().flatten().reduce(Bounds::with);
            stack.extend(scene.nodes.get(id.index()).into_iter().flat_map(|n| &n.children));
        }
        all
    }

    /// Where a node stands.
    pub fn origin(&self, node: NodeId) -> Option<Vec3> {
        self.world(node).map(|world| world.w_axis.truncate())
    }

    /// The box around everything.
    pub fn all(&self) -> Option<Bounds> {
        self.all
    }

    /// Half the diagonal of everything, metres; 1 for an empty scene.
    pub fn radius(&self) -> f32 {
        self.all.map_or(1.0, Bounds::radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre::scene::{Mesh, Node, Primitive};

    /// A triangle of a metre at 5 along x, under a parent that moves it up by 10; its fourth vertex is used by nothing.
    fn scene() -> (Scene, [NodeId; 2]) {
        let mut scene = Scene::default();
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::splat(99.0)];
        let primitive = Primitive { positions, indices: vec![0, 1, 2], ..Primitive::default() };
        let mesh = scene.add_mesh(Mesh { primitives: vec![primitive], ..Mesh::default() });
        let up = Mat4::from_translation(Vec3::Y * 10.0);
        let along = Mat4::from_translation(Vec3::X * 5.0);
        let parent = scene.add_root(Node { transform: up, ..Node::default() });
        let child = NodeId(scene.nodes.len() as u32);
        scene.nodes.push(Node { transform: along, mesh: Some(mesh), ..Node::default() });
        scene.nodes[parent.index()].children.push(child);
        (scene, [parent, child])
    }

    #[test]
    fn nodes_are_placed_with_their_parents() {
        let (scene, [parent, child]) = scene();
        let places = Places::of(&scene, &mesh_bounds(&scene));
        let want = Bounds { min: Vec3::new(5.0, 10.0, 0.0), max: Vec3::new(6.0, 11.0, 0.0) };
        assert_eq!(places.all(), Some(want));
        assert_eq!(places.bounds(&scene, child), Some(want));
        assert_eq!(places.bounds(&scene, parent), Some(want), "with what is below it");
        assert_eq!(places.origin(child), Some(Vec3::new(5.0, 10.0, 0.0)));
        assert_eq!(places.parent(child), Some(parent));
        assert_eq!(places.parent_world(child), scene.nodes[parent.index()].transform);
        assert_eq!(places.parent_world(parent), Mat4::IDENTITY);
        assert!((places.radius() - 0.5f32.sqrt()).abs() < 1e-6);
    }

    #[test]
    fn an_empty_scene_and_a_circle_of_nodes_do_no_harm() {
        let places = Places::of(&Scene::default(), &[]);
        assert_eq!((places.all(), places.radius()), (None, 1.0));
        assert_eq!(places.world(NodeId(3)), None);
        let (mut scene, [parent, child]) = scene();
        scene.nodes[child.index()].children.push(parent);
        let places = Places::of(&scene, &mesh_bounds(&scene));
        assert!(places.bounds(&scene, parent).is_some());
    }
}
