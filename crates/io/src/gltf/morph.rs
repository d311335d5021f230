//! Morph targets (glTF 2.0, 3.7.2.2) in the shape that they have at rest: the weights of the node, else those of the mesh.

use super::accessor::Accessors;
use super::document::Document;
use crate::IoError;
use glam::Vec3;
use gltf::json::Index;
use gltf::json::accessor::Accessor;
use gltf::json::mesh::Primitive as JsonPrimitive;
use lumbre_scene::{MeshId, Node, Primitive};
use std::collections::HashMap;

/// A mesh of the file with the weights of its targets.
pub(super) struct Shape {
    /// Which of the file's meshes.
    pub(super) mesh: usize,
    weights: Vec<f32>,
}

impl Shape {
    /// The targets of a primitive of this shape that count, each with its weight.
    pub(super) fn targets<'s>(
        &'s self,
        json: &'s JsonPrimitive,
    ) -> impl Iterator<Item = (usize, &'s gltf::json::mesh::MorphTarget, f32)> {
        let targets = json.targets.iter().flatten().enumerate().zip(&self.weights);
        targets.map(|((i, target), w)| (i, target, *w)).filter(|(_, _, w)| *w != 0.0)
    }
}

/// The shapes in which the nodes show the meshes. Shape `i` is of mesh `i`; where nodes morph one mesh in several ways, more
/// shapes follow, and those nodes show them.
pub(super) fn shapes(doc: &Document, nodes: &mut [Node]) -> Vec<Shape> {
    // Weights without a target are not looked at, so that many nodes may share a long list of them.
    let targets = |m: usize| {
        let primitives = &doc.root.meshes[m].primitives;
        primitives.iter().map(|p| p.targets.as_ref().map_or(0, Vec::len)).max().unwrap_or(0)
    };
    let cut = |m: usize, weights: &[f32]| weights[..weights.len().min(targets(m))].to_vec();
    let own = |m: usize| cut(m, doc.root.meshes[m].weights.as_deref().unwrap_or_default());
    let mut shapes: Vec<_> =
        (0..doc.root.meshes.len()).map(|mesh| Shape { mesh, weights: own(mesh) }).collect();
    // Which of them are shown by no node yet, and the others by their weights.
    let mut known: HashMap<(usize, Vec<u32>), usize> = HashMap::new();
    let mut unmorphed: HashMap<usize, usize> = HashMap::new();
    let mut taken = vec![false; shapes.len()];
    for (node, json) in nodes.iter_mut().zip(&doc.root.nodes) {
        let Some(mesh) = node.mesh.map(MeshId::index) else { continue };
        if !doc.root.meshes[mesh].primitives.iter().any(|p| p.targets.is_some()) {
            continue;
        }
        if let (None, Some(&shape)) = (&json.weights, unmorphed.get(&mesh)) {
            node.mesh = Some(MeshId(shape as u32));
            continue;
        }
        let weights = json.weights.as_deref().map_or_else(|| own(mesh), |w| cut(mesh, w));
        let bits = weights.iter().map(|w| w.to_bits()).collect();
        let shape = *known.entry((mesh, bits)).or_insert_with(|| {
            let shape = Shape { mesh, weights };
            if !std::mem::replace(&mut taken[mesh], true) {
                shapes[mesh] = shape;
                return mesh;
            }
            shapes.push(shape);
            shapes.len() - 1
        });
        if json.weights.is_none() {
            unmorphed.insert(mesh, shape);
        }
        node.mesh = Some(MeshId(shape as u32));
    }
    shapes
}

/// Which vertices of a primitive are wanted: all of `count`, or those in `select`.
pub(super) struct Wanted<'a> {
    pub(super) count: usize,
    pub(super) select: Option<&'a [u32]>,
}

/// Moves the vertices of a primitive that stands at `place`.
pub(super) fn apply(
    accessors: &Accessors,
    (shape, json): (&Shape, &JsonPrimitive),
    place: &str,
    wanted: &Wanted,
    primitive: &mut Primitive,
) -> Result<(), IoError> {
    let mut any = false;
    for (i, target, weight) in shape.targets(json) {
        any = true;
        let read = |accessor: Option<Index<Accessor>>, name: &str| {
            let at = || format!("{place}/targets/{i}/{name}");
            accessor.map_or(Ok(Vec::new()), |a| displacements(accessors, a.value(), wanted, &at))
        };
        for (p, d) in primitive.positions.iter_mut().zip(read(target.positions, "POSITION")?) {
            *p += weight * Vec3::from(d);
        }
        for (n, d) in primitive.normals.iter_mut().zip(read(target.normals, "NORMAL")?) {
            *n += weight * Vec3::from(d);
        }
        for (t, d) in primitive.tangents.iter_mut().zip(read(target.tangents, "TANGENT")?) {
            *t += (weight * Vec3::from(d)).extend(0.0);
        }
    }
    if any && primitive.positions.iter().any(|p| !p.is_finite()) {
        return Err(accessors.doc.error(place, "its morph targets lead to no positions"));
    }
    Ok(())
}

/// What a target adds to an attribute of the wanted vertices.
fn displacements(
    accessors: &Accessors,
    index: usize,
    wanted: &Wanted,
    place: &dyn Fn() -> String,
) -> Result<Vec<[f32; 3]>, IoError> {
    let have = accessors.count(index, place)?;
    if have != wanted.count as u64 {
        let why = format!("has {have} elements, but POSITION has {}", wanted.count);
        return Err(accessors.doc.error(place(), why));
    }
    accessors.floats(index, &[3], wanted.select, place)
}
