//! `EXT_mesh_gpu_instancing` (Khronos Group 2022): one node draws its mesh at many places, which accessors list. Each place
//! becomes a child of the node; all of them share the mesh.

use super::accessor::Accessors;
use super::json::Object;
use super::nodes::rotation;
use crate::warnings::Warnings;
use crate::{Bound, IoError};
use glam::{Mat4, Vec3};
use lumbre_scene::{MeshId, Node, NodeId};

const NAME: &str = "EXT_mesh_gpu_instancing";

/// Adds the instances behind the nodes of the file.
pub(super) fn expand(
    accessors: &Accessors,
    nodes: &mut Vec<Node>,
    warnings: &mut Warnings,
) -> Result<(), IoError> {
    let doc = accessors.doc;
    let mut room = doc.limits.room(Bound::Instances);
    room.take(doc.path, "/nodes", nodes.iter().filter(|n| n.mesh.is_some()).count() as u64)?;
    for (i, json) in doc.root.nodes.iter().enumerate() {
        let value = json.extensions.as_ref().and_then(|e| e.others.get(NAME));
        let place = || format!("/nodes/{i}/extensions/{NAME}");
        let Some(extension) = Object::new(doc, value, place)? else { continue };
        let Some(mesh) = nodes[i].mesh.take() else {
            warnings.add(extension.place(), "instances of a node without a mesh are ignored");
            continue;
        };
        let Some(attributes) = Attributes::find(accessors, &extension)? else {
            warnings.add(extension.place(), "instances without attributes: the mesh is drawn once");
            nodes[i].mesh = Some(mesh);
            continue;
        };
        // Checked before anything is made as long as it.
        room.take(doc.path, extension.place(), attributes.count)?;
        let first = nodes.len();
        attributes.add_nodes(mesh, nodes, warnings)?;
        if u32::try_from(nodes.len()).is_err() {
            return Err(doc.error(extension.place(), "makes more nodes than can be counted"));
        }
        let new = first as u32..nodes.len() as u32;
        nodes[i].children.extend(new.map(NodeId));
    }
    Ok(())
}

/// The accessors of one node's instances.
struct Attributes<'a> {
    accessors: &'a Accessors<'a>,
    object: Object<'a>,
    count: u64,
}

impl<'a> Attributes<'a> {
    /// Finds them and checks that all have the same count; `None` if there are none that say where the instances are.
    fn find(accessors: &'a Accessors<'a>, extension: &Object<'a>) -> Result<Option<Self>, IoError> {
        let Some(object) = extension.object("attributes")? else { return Ok(None) };
        let mut count = None;
        for name in ["TRANSLATION", "ROTATION", "SCALE"] {
            let Some(index) = object.index(name)? else { continue };
            let here = || format!("{}/{name}", object.place());
            let have = accessors.count(index, &here)?;
            let all = *count.get_or_insert(have);
            if have != all {
                let why = format!("has {have} elements, but another attribute has {all}");
                return Err(accessors.doc.error(here(), why));
            }
        }
        Ok(count.map(|count| Attributes { accessors, object, count }))
    }

    fn read<const N: usize>(&self, name: &str) -> Result<Option<Vec<[f32; N]>>, IoError> {
        let Some(index) = self.object.index(name)? else { return Ok(None) };
        let here = || format!("{}/{name}", self.object.place());
        self.accessors.floats(index, &[N], None, &here).map(Some)
    }

    fn add_nodes(&self, mesh: MeshId, nodes: &mut Vec<Node>, warnings: &mut Warnings) -> Result<(), IoError> {
        let (translations, scales) = (self.read::<3>("TRANSLATION")?, self.read::<3>("SCALE")?);
        let rotations = self.read::<4>("ROTATION")?;
        nodes.reserve(self.count as usize);
        for i in 0..self.count as usize {
            let scale = scales.as_ref().map_or(Vec3::ONE, |s| s[i].into());
            let translation = translations.as_ref().map_or(Vec3::ZERO, |t| t[i].into());
            let turned = rotations.as_ref().map_or([0.0, 0.0, 0.0, 1.0], |r| r[i]);
            let rotation = rotation(turned, self.object.place(), warnings);
            let transform = Mat4::from_scale_rotation_translation(scale, rotation, translation);
            if !transform.is_finite() {
                let why = format!("the transform of instance {i} is not finite");
                return Err(self.accessors.doc.error(self.object.place(), why));
            }
            nodes.push(Node { transform, mesh: Some(mesh), ..Node::default() });
        }
        Ok(())
    }
}
