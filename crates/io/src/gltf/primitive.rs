//! One primitive of a mesh: attributes and indices to a triangle list.

use super::accessor::Accessors;
use super::draco::{self, Claims, DracoMesh};
use super::morph::{self, Shape, Wanted};
use crate::IoError;
use crate::warnings::Warnings;
use glam::{Vec2, Vec3, Vec4};
use gltf::json::mesh::{Mode, Semantic};
use gltf::json::validation::Checked;
use lumbre_scene::{MaterialId, Primitive};
use std::collections::HashMap;

/// Reads a primitive of a shape that stands at `place`; `None` if it has no triangles.
pub(super) fn load(
    accessors: &Accessors,
    json: &gltf::json::mesh::Primitive,
    shape: &Shape,
    place: &str,
    warnings: &mut Warnings,
) -> Result<Option<Primitive>, IoError> {
    let mut reader = Reader { accessors, json, place, draco: None };
    let Checked::Valid(mode) = json.mode else {
        return Err(accessors.doc.error(format!("{place}/mode"), "is none of glTF's modes"));
    };
    if matches!(mode, Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
        warnings.add(place, "points and lines are not supported and are skipped");
        return Ok(None);
    }
    let Some(position) = reader.attribute(Semantic::Positions) else {
        warnings.add(place, "a primitive without positions is skipped");
        return Ok(None);
    };
    reader.decompress(mode, position)?;
    let count = reader.vertex_count(position)?;
    // Draco lists triangles, whatever they were.
    let mode = if reader.draco.is_some() { Mode::Triangles } else { mode };
    let mut indices = triangle_list(mode, reader.corners(count)?, place, warnings);
    if indices.is_empty() {
        warnings.add(place, "a primitive without triangles is skipped");
        return Ok(None);
    }
    // Several primitives may share one large set of vertices: each keeps those that it uses.
    let used = (indices.len() < count).then(|| compact(&mut indices, count));
    let mut primitive = reader.attributes(position, used.as_deref())?;
    primitive.indices = indices;
    let wanted = Wanted { count, select: used.as_deref() };
    morph::apply(accessors, (shape, json), place, &wanted, &mut primitive)?;
    if let Some(material) = json.material {
        let here = || format!("{place}/material");
        accessors.doc.item(&accessors.doc.root.materials, material.value(), "material", &here)?;
        primitive.material = Some(MaterialId(material.value() as u32));
    }
    mend(&mut primitive, place, warnings);
    Ok(Some(primitive))
}

struct Reader<'a> {
    accessors: &'a Accessors<'a>,
    json: &'a gltf::json::mesh::Primitive,
    place: &'a str,
    /// What a compressed primitive holds.
    draco: Option<DracoMesh<'a>>,
}

impl Reader<'_> {
    fn attribute(&self, semantic: Semantic) -> Option<usize> {
        self.json.attributes.get(&Checked::Valid(semantic)).map(|i| i.value())
    }

    /// Decodes a compressed primitive. Where its accessors have the same data uncompressed, that is read.
    fn decompress(&mut self, mode: Mode, position: usize) -> Result<(), IoError> {
        if !draco::is_used(self.json) || self.accessors.has_data(position) {
            return Ok(());
        }
        let vertices = self.accessors.count(position, &|| format!("{}/attributes/POSITION", self.place))?;
        let corners = match self.json.indices {
            Some(i) => self.accessors.count(i.value(), &|| format!("{}/indices", self.place))?,
            None => vertices,
        };
        let claims = Claims { vertices, corners, mode };
        self.draco = DracoMesh::load(self.accessors, self.json, self.place, &claims)?;
        Ok(())
    }

    /// The number of vertices, which all attributes must share.
    fn vertex_count(&self, position: usize) -> Result<usize, IoError> {
        let here = || format!("{}/attributes", self.place);
        // Checked before anything is made as long as it.
        let at = || format!("{}/POSITION", here());
        let count = match self.draco {
            // It holds as many as the accessor says.
            Some(_) => self.accessors.count(position, &at)? as usize,
            None => self.accessors.checked_count(position, &at)?,
        };
        for (semantic, index) in &self.json.attributes {
            let other = self.accessors.count(index.value(), &here)?;
            if other != count as u64 {
                let name = semantic.to_string();
                let why = format!("has {other} elements, but POSITION has {count}");
                return Err(self.accessors.doc.error(format!("{}/{name}", here()), why));
            }
        }
        // Indices are 32 bits wide, and the largest value is not a vertex (glTF 2.0, 3.7.2.1).
        if count >= u32::MAX as usize {
            return Err(self.accessors.doc.error(here(), format!("{count} vertices are too many")));
        }
        Ok(count)
    }

    /// The vertex of every corner, in the order of the file, each checked.
    fn corners(&self, vertices: usize) -> Result<Vec<u32>, IoError> {
        let here = || format!("{}/indices", self.place);
        let corners = match (&self.draco, self.json.indices) {
            (Some(draco), _) => draco.corners(),
            (None, Some(indices)) => self.accessors.integers(indices.value(), &here)?,
            (None, None) => return Ok((0..vertices as u32).collect()),
        };
        if let Some(at) = corners.iter().position(|&v| v as usize >= vertices) {
            let why = format!("element {at} is {}, but there are {vertices} vertices", corners[at]);
            let list = self.json.indices.filter(|_| self.draco.is_none());
            let place = list.map_or_else(here, |i| format!("/accessors/{}", i.value()));
            return Err(self.accessors.doc.error(place, why));
        }
        Ok(corners)
    }

    fn floats<const N: usize>(
        &self,
        semantic: Semantic,
        lanes: &[usize],
        select: Option<&[u32]>,
    ) -> Result<Vec<[f32; N]>, IoError> {
        let Some(index) = self.attribute(semantic.clone()) else { return Ok(Vec::new()) };
        let here = || format!("{}/attributes/{}", self.place, semantic.to_string());
        if let Some(draco) = &self.draco {
            let normalized = self.accessors.normalized(index, &here)?;
            if let Some(values) = draco.floats(&semantic, normalized, lanes, select)? {
                return Ok(values);
            }
            // What the stream leaves out lies in the accessor; positions would be zeros there.
            if semantic == Semantic::Positions {
                return Err(self.accessors.doc.error(here(), "is not in the compressed data"));
            }
        }
        self.accessors.floats(index, lanes, select, &here)
    }

    /// All attributes of the vertices in `select`, or of all.
    fn attributes(&self, position: usize, select: Option<&[u32]>) -> Result<Primitive, IoError> {
        let positions: Vec<Vec3> = vectors(self.floats(Semantic::Positions, &[3], select)?);
        if let Some(at) = positions.iter().position(|p| !p.is_finite()) {
            let vertex = select.map_or(at, |s| s[at] as usize);
            let why = format!("element {vertex} is {}, which is no position", positions[at]);
            return Err(self.accessors.doc.error(format!("/accessors/{position}"), why));
        }
        Ok(Primitive {
            positions,
            normals: vectors(self.floats::<3>(Semantic::Normals, &[3], select)?),
            tangents: vectors(self.floats::<4>(Semantic::Tangents, &[4], select)?),
            uv0: vectors(self.floats::<2>(Semantic::TexCoords(0), &[2], select)?),
            uv1: vectors(self.floats::<2>(Semantic::TexCoords(1), &[2], select)?),
            colors: vectors(self.floats::<4>(Semantic::Colors(0), &[3, 4], select)?),
            indices: Vec::new(),
            material: None,
        })
    }
}

fn vectors<const N: usize, V: From<[f32; N]>>(list: Vec<[f32; N]>) -> Vec<V> {
    list.into_iter().map(V::from).collect()
}

/// Strips and fans to a list (glTF 2.0, 3.7.2.1); the winding of every triangle is kept.
fn triangle_list(mode: Mode, corners: Vec<u32>, place: &str, warnings: &mut Warnings) -> Vec<u32> {
    let at = |i: usize| corners[i];
    let triangles = corners.len().saturating_sub(2);
    match mode {
        Mode::TriangleStrip => {
            (0..triangles).flat_map(|i| [at(i), at(i + 1 + i % 2), at(i + 2 - i % 2)]).collect()
        }
        Mode::TriangleFan => (0..triangles).flat_map(|i| [at(i + 1), at(i + 2), at(0)]).collect(),
        _ => {
            let mut corners = corners;
            if !corners.len().is_multiple_of(3) {
                warnings.add(place, "corners that do not fill a triangle are ignored");
                corners.truncate(corners.len() / 3 * 3);
            }
            corners
        }
    }
}

/// Renumbers the vertices in the order of their first use; returns the old number of each. Where few of many are used, the
/// cost is that of the used ones: many primitives may share one accessor.
fn compact(indices: &mut [u32], count: usize) -> Vec<u32> {
    const FEW: usize = 8;
    let mut old_of_new = Vec::new();
    let mut fresh = |old: u32| {
        old_of_new.push(old);
        old_of_new.len() as u32 - 1
    };
    if indices.len() < count / FEW {
        let mut new_of_old = HashMap::new();
        for index in indices {
            *index = *new_of_old.entry(*index).or_insert_with_key(|old| fresh(*old));
        }
    } else {
        let mut new_of_old = vec![u32::MAX; count];
        for index in indices {
            let new = &mut new_of_old[*index as usize];
            if *new == u32::MAX {
                *new = fresh(*index);
            }
            *index = *new;
        }
    }
    old_of_new
}

/// Makes the attributes what `Primitive` promises: unit normals and tangents, finite numbers.
fn mend(p: &mut Primitive, place: &str, warnings: &mut Warnings) {
    let unit = |v: Vec3| v.try_normalize();
    if p.normals.iter().any(|&n| unit(n).is_none()) {
        warnings.add(place, "normals without a direction are replaced by those of the triangles around");
        let geometric = geometric_normals(p);
        for (n, g) in p.normals.iter_mut().zip(geometric) {
            if unit(*n).is_none() {
                *n = g;
            }
        }
    }
    for n in &mut p.normals {
        *n = unit(*n).unwrap_or(Vec3::Z);
    }
    if p.tangents.iter().any(|&t| unit(t.truncate()).is_none()) {
        warnings.add(place, "tangents without a direction: all of the primitive's are made anew");
        p.tangents.clear();
    }
    for t in &mut p.tangents {
        let sign = if t.w < 0.0 { -1.0 } else { 1.0 };
        *t = unit(t.truncate()).unwrap_or(Vec3::X).extend(sign);
    }
    for uv in [&mut p.uv0, &mut p.uv1] {
        if uv.iter().any(|c| !c.is_finite()) {
            warnings.add(place, "texture coordinates that are no numbers are set to 0");
            uv.iter_mut().filter(|c| !c.is_finite()).for_each(|c| *c = Vec2::ZERO);
        }
    }
    let valid = |c: &Vec4| c.is_finite() && c.min_element() >= 0.0 && c.w <= 1.0;
    if !p.colors.iter().all(valid) {
        warnings.add(place, "vertex colours out of range are clamped");
        let clamp = |v: f32, most: f32| if v.is_finite() { v.clamp(0.0, most) } else { 0.0 };
        for c in p.colors.iter_mut().filter(|c| !valid(c)) {
            let [r, g, b] = [c.x, c.y, c.z].map(|v| clamp(v, f32::MAX));
            *c = Vec4::new(r, g, b, clamp(c.w, 1.0));
        }
    }
}

/// At each vertex the direction of the sum of the area vectors of its triangles; +z where that is none.
fn geometric_normals(p: &Primitive) -> Vec<Vec3> {
    let mut sums = vec![Vec3::ZERO; p.positions.len()];
    for t in p.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| p.positions[t[k] as usize]);
        let area = (b - a).cross(c - a);
        t.iter().for_each(|&v| sums[v as usize] += area);
    }
    sums.into_iter().map(|s| s.try_normalize().unwrap_or(Vec3::Z)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_keep_their_winding() {
        let list = |mode| triangle_list(mode, vec![10, 11, 12, 13, 14], "", &mut Warnings::default());
        assert_eq!(list(Mode::TriangleStrip), [10, 11, 12, 11, 13, 12, 12, 13, 14]);
        assert_eq!(list(Mode::TriangleFan), [11, 12, 10, 12, 13, 10, 13, 14, 10]);
        assert_eq!(list(Mode::Triangles), [10, 11, 12]);
    }

    #[test]
    fn unused_vertices_are_dropped() {
        // The second is more than could be listed one by one in a test.
        for count in [10, u32::MAX as usize - 1] {
            let mut indices = vec![7, 3, 7, 9, 3, 7];
            assert_eq!(compact(&mut indices, count), [7, 3, 9], "{count}");
            assert_eq!(indices, [0, 1, 0, 2, 1, 0]);
        }
    }

    #[test]
    fn wrong_attributes_are_mended() {
        let mut p = Primitive {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::ZERO, Vec3::splat(f32::NAN), Vec3::new(0.0, 0.0, 3.0)],
            tangents: vec![Vec4::new(2.0, 0.0, 0.0, -0.5); 3],
            uv0: vec![Vec2::new(f32::NAN, 1.0), Vec2::ONE, Vec2::ONE],
            colors: vec![Vec4::new(-1.0, 2.0, f32::INFINITY, 7.0), Vec4::ONE, Vec4::ONE],
            indices: vec![0, 1, 2],
            ..Primitive::default()
        };
        let mut warnings = Warnings::default();
        mend(&mut p, "/p", &mut warnings);
        assert_eq!(p.normals, [Vec3::Z; 3]);
        assert_eq!(p.tangents, [Vec4::new(1.0, 0.0, 0.0, -1.0); 3]);
        assert_eq!(p.uv0[0], Vec2::ZERO);
        assert_eq!(p.colors[0], Vec4::new(0.0, 2.0, 0.0, 1.0));
        assert_eq!(warnings.into_lines().len(), 3);
    }
}
