//! The node graph, and the scene of it that is shown.

use super::cameras;
use super::document::Document;
use super::json::Object;
use super::lights;
use crate::warnings::Warnings;
use crate::{Bound, IoError, SceneChoice};
use glam::{Mat4, Quat, Vec3, Vec4};
use lumbre_scene::{Camera, CameraId, LightId, MeshId, Node, NodeId};

/// Extension that hides nodes and what hangs from them.
const VISIBILITY: &str = "KHR_node_visibility";

/// What `load` finds.
pub(super) struct Graph {
    pub(super) nodes: Vec<Node>,
    pub(super) roots: Vec<NodeId>,
    pub(super) cameras: Vec<Camera>,
    /// The scene that is shown, where the file has any.
    pub(super) scene: Option<usize>,
}

/// Reads nodes, cameras and the scene to show. Node `i` of the file becomes node `i` of the scene.
pub(super) fn load(
    doc: &Document,
    light_count: usize,
    choice: &SceneChoice,
    warnings: &mut Warnings,
) -> Result<Graph, IoError> {
    let mut cameras = cameras::load_all(doc, warnings)?;
    let mut nodes = Vec::with_capacity(doc.root.nodes.len());
    for i in 0..doc.root.nodes.len() {
        nodes.push(load_node(doc, i, light_count, warnings)?);
    }
    let instances = nodes.iter().filter(|n| n.mesh.is_some()).count() as u64;
    doc.limits.hold(Bound::Instances, doc.path, "/nodes", instances)?;
    let parentless = check_trees(doc, &nodes)?;
    let (scene, roots) = load_roots(doc, parentless, choice, warnings)?;
    // Most cameras are named by their node only.
    for node in &nodes {
        if let Some(camera) = node.camera.and_then(|c| cameras.get_mut(c.index()))
            && camera.name.is_empty()
        {
            camera.name.clone_from(&node.name);
        }
    }
    Ok(Graph { nodes, roots, cameras, scene })
}

fn load_node(
    doc: &Document,
    index: usize,
    light_count: usize,
    warnings: &mut Warnings,
) -> Result<Node, IoError> {
    let json = &doc.root.nodes[index];
    let place = format!("/nodes/{index}");
    let mut node = Node {
        name: json.name.clone().unwrap_or_default(),
        transform: transform(doc, json, &place, warnings)?,
        ..Node::default()
    };
    for child in json.children.iter().flatten() {
        doc.item(&doc.root.nodes, child.value(), "node", &|| format!("{place}/children"))?;
        node.children.push(NodeId(child.value() as u32));
    }
    if let Some(mesh) = json.mesh {
        doc.item(&doc.root.meshes, mesh.value(), "mesh", &|| format!("{place}/mesh"))?;
        node.mesh = Some(MeshId(mesh.value() as u32));
    }
    if let Some(camera) = json.camera {
        doc.item(&doc.root.cameras, camera.value(), "camera", &|| format!("{place}/camera"))?;
        node.camera = Some(CameraId(camera.value() as u32));
    }
    let extension = |name: &str| {
        let value = json.extensions.as_ref().and_then(|e| e.others.get(name));
        Object::new(doc, value, || format!("{place}/extensions/{name}"))
    };
    if let Some(visibility) = extension(VISIBILITY)? {
        node.visible = visibility.truth("visible", true)?;
    }
    if let Some(light) = extension(lights::NAME)?.map(|o| o.index("light")).transpose()?.flatten() {
        if light >= light_count {
            let why = format!("refers to light {light}, but there are {light_count}");
            return Err(doc.error(place, why));
        }
        node.light = Some(LightId(light as u32));
    }
    Ok(node)
}

/// The node's transform: its matrix, or translation · rotation · scale.
fn transform(
    doc: &Document,
    json: &gltf::json::Node,
    place: &str,
    warnings: &mut Warnings,
) -> Result<Mat4, IoError> {
    let mut matrix = match json.matrix {
        Some(m) => Mat4::from_cols_array(&m),
        None => {
            let turned = json.rotation.map_or([0.0, 0.0, 0.0, 1.0], |r| r.0);
            let rotation = rotation(turned, place, warnings);
            let scale = json.scale.map_or(Vec3::ONE, Vec3::from);
            let translation = json.translation.map_or(Vec3::ZERO, Vec3::from);
            Mat4::from_scale_rotation_translation(scale, rotation, translation)
        }
    };
    if !matrix.is_finite() {
        return Err(doc.error(place, "its transform is not finite"));
    }
    if matrix.row(3) != Vec4::W {
        warnings.add(place, "a projective matrix is not supported; its last row is ignored");
        matrix.x_axis.w = 0.0;
        matrix.y_axis.w = 0.0;
        matrix.z_axis.w = 0.0;
        matrix.w_axis.w = 1.0;
    }
    Ok(matrix)
}

/// The rotation that a quaternion (x, y, z, w) of any length means.
pub(super) fn rotation([x, y, z, w]: [f32; 4], place: &str, warnings: &mut Warnings) -> Quat {
    let length = Vec4::new(x, y, z, w).length();
    if length > 1e-6 && length.is_finite() {
        return Quat::from_xyzw(x / length, y / length, z / length, w / length);
    }
    warnings.add(place, "a rotation that is no quaternion is ignored");
    Quat::IDENTITY
}

/// Checks that the nodes form trees (glTF 2.0, 3.5.2); returns those without a parent.
fn check_trees(doc: &Document, nodes: &[Node]) -> Result<Vec<NodeId>, IoError> {
    let mut parent = vec![None; nodes.len()];
    for (i, node) in nodes.iter().enumerate() {
        for child in &node.children {
            if let Some(other) = parent[child.index()].replace(i) {
                let why = format!("has two parents, nodes {other} and {i}; nodes must form trees");
                return Err(doc.error(format!("/nodes/{}", child.0), why));
            }
        }
    }
    let roots: Vec<NodeId> =
        (0..nodes.len() as u32).map(NodeId).filter(|n| parent[n.index()].is_none()).collect();
    // With one parent each, what no root reaches runs in circles.
    let mut reached = vec![false; nodes.len()];
    let mut stack: Vec<(NodeId, u64)> = roots.iter().map(|&root| (root, 1)).collect();
    while let Some((id, depth)) = stack.pop() {
        doc.limits.hold(Bound::NodeDepth, doc.path, &format!("/nodes/{}", id.0), depth)?;
        reached[id.index()] = true;
        stack.extend(nodes[id.index()].children.iter().map(|&child| (child, depth + 1)));
    }
    match reached.iter().position(|r| !r) {
        Some(i) => Err(doc.error(format!("/nodes/{i}"), "is its own ancestor; nodes must form trees")),
        None => Ok(roots),
    }
}

/// The index of the scene to show and its nodes: those of the chosen scene. The default is the one that the file names, else its first, else all nodes
/// without a parent.
fn load_roots(
    doc: &Document,
    parentless: Vec<NodeId>,
    choice: &SceneChoice,
    warnings: &mut Warnings,
) -> Result<(Option<usize>, Vec<NodeId>), IoError> {
    let scenes = &doc.root.scenes;
    let index = match (choice, doc.root.scene) {
        (SceneChoice::Default, Some(i)) => i.value(),
        (SceneChoice::Default, None) if scenes.is_empty() => return Ok((None, parentless)),
        (SceneChoice::Default, None) => 0,
        _ => chosen_scene(doc, choice)?,
    };
    let scene = doc.item(scenes, index, "scene", &|| "/scene".into())?;
    if scenes.len() > 1 && *choice == SceneChoice::Default {
        warnings.add("/scenes", format!("there are {}; scene {index} is shown", scenes.len()));
    }
    let mut roots = Vec::with_capacity(scene.nodes.len());
    let mut listed = vec![false; doc.root.nodes.len()];
    for node in &scene.nodes {
        let at = || format!("/scenes/{index}/nodes");
        doc.item(&doc.root.nodes, node.value(), "node", &at)?;
        if !std::mem::replace(&mut listed[node.value()], true) {
            roots.push(NodeId(node.value() as u32));
        }
    }
    Ok((Some(index), roots))
}

/// The index of the scene that the caller asked for.
fn chosen_scene(doc: &Document, choice: &SceneChoice) -> Result<usize, IoError> {
    let scenes = &doc.root.scenes;
    let (found, wanted) = match choice {
        SceneChoice::Default => (None, String::new()),
        SceneChoice::Index(i) => (Some(*i).filter(|i| *i < scenes.len()), i.to_string()),
        SceneChoice::Name(name) => {
            (scenes.iter().position(|s| s.name.as_ref() == Some(name)), format!("{name:?}"))
        }
    };
    found.ok_or_else(|| {
        let name = |(i, s): (usize, &gltf::json::Scene)| s.name.clone().unwrap_or_else(|| i.to_string());
        let names: Vec<String> = scenes.iter().enumerate().map(name).collect();
        IoError::not_there(doc.path, "scene", wanted, &names)
    })
}
