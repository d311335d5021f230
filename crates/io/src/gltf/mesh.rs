//! Meshes, on all cores.

use super::accessor::Accessors;
use super::draco;
use super::morph::Shape;
use super::primitive;
use crate::warnings::Warnings;
use crate::{Bound, IoError};
use gltf::json::mesh::{Mode, Semantic};
use gltf::json::validation::Checked;
use lumbre_scene::{Mesh, Primitive};
use rayon::prelude::*;

/// Reads every mesh. Shape `i` becomes mesh `i` of the scene, so that nodes may share it.
pub(super) fn load_all(accessors: &Accessors, shapes: &[Shape]) -> Result<(Vec<Mesh>, Warnings), IoError> {
    check_budget(accessors, shapes)?;
    let meshes = &accessors.doc.root.meshes;
    let jobs: Vec<_> = shapes
        .iter()
        .enumerate()
        .flat_map(|(s, shape)| (0..meshes[shape.mesh].primitives.len()).map(move |p| (s, p)))
        .collect();
    // Results are gathered before the first error is looked for, so that it is always the same one.
    let parts: Vec<Result<(Option<Primitive>, Warnings), IoError>> = jobs
        .par_iter()
        .map(|&(s, p)| {
            let mut warnings = Warnings::default();
            let shape = &shapes[s];
            let place = format!("/meshes/{}/primitives/{p}", shape.mesh);
            let json = &meshes[shape.mesh].primitives[p];
            let part = primitive::load(accessors, json, shape, &place, &mut warnings)?;
            Ok((part, warnings))
        })
        .collect();
    let mut warnings = Warnings::default();
    let named = |mesh: &gltf::json::Mesh| Mesh {
        name: mesh.name.clone().unwrap_or_default(),
        primitives: Vec::with_capacity(mesh.primitives.len()),
    };
    let mut out: Vec<Mesh> = shapes.iter().map(|s| named(&meshes[s.mesh])).collect();
    for ((s, _), part) in jobs.into_iter().zip(parts) {
        let (primitive, said) = part?;
        warnings.append(said);
        out[s].primitives.extend(primitive);
    }
    Ok((out, warnings))
}

/// Adds up what the meshes claim to hold before any of it is read: many primitives may share one accessor, so that a small
/// file can ask for much.
fn check_budget(accessors: &Accessors, shapes: &[Shape]) -> Result<(), IoError> {
    let doc = accessors.doc;
    let (mut vertices, mut triangles) = (0u64, 0u64);
    for shape in shapes {
        for (p, primitive) in doc.root.meshes[shape.mesh].primitives.iter().enumerate() {
            let place = || format!("/meshes/{}/primitives/{p}", shape.mesh);
            let Some(position) = primitive.attributes.get(&Checked::Valid(Semantic::Positions)) else {
                continue;
            };
            let count = accessors.count(position.value(), &place)?;
            let used = match primitive.indices {
                Some(i) => accessors.count(i.value(), &place)?,
                None => count,
            };
            // Each morph target that counts is read like further vertices.
            let sets = 1 + shape.targets(primitive).count() as u64;
            // What is sparse or compressed is read whole, however little of it is used.
            let whole = accessors.has_sparse(primitive) || draco::is_used(primitive);
            let read = if whole { count } else { count.min(used) };
            vertices = vertices.saturating_add(read.saturating_mul(sets));
            let strip = matches!(primitive.mode, Checked::Valid(Mode::TriangleStrip | Mode::TriangleFan));
            triangles = triangles.saturating_add(if strip { used } else { used / 3 });
            doc.limits.hold(Bound::Vertices, doc.path, &place(), vertices)?;
            doc.limits.hold(Bound::Triangles, doc.path, &place(), triangles)?;
        }
    }
    Ok(())
}
