//! Triangles to the meshes of a scene: one for each object, with a primitive for each of its materials.

use super::chunk::State;
use super::faces::{Corner, NONE, Triangles};
use super::whole::Whole;
use crate::warnings::Warnings;
use glam::Vec2;
use lumbre_scene::{MaterialId, Mesh, Primitive};
use rayon::prelude::*;
use std::collections::HashMap;
use std::ops::Range;

/// Objects that are kept apart. Each costs more memory than the line that begins it.
const MOST_OBJECTS: usize = 1 << 16;

/// Triangles of one piece of the file that share all states.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Segment {
    pub(super) piece: usize,
    /// Of the piece's triangles; not empty.
    pub(super) range: Range<usize>,
    /// Index of the object.
    object: usize,
    /// Index into [`Segments::materials`]; `None`: no material was named.
    material: Option<usize>,
    /// 0: flat.
    pub(super) smoothing: u32,
}

/// The triangles of a file in order.
#[derive(Default)]
pub(super) struct Segments {
    pub(super) list: Vec<Segment>,
    /// Names of the objects.
    objects: Vec<String>,
    /// Names of the materials in use, in the order of their first use.
    pub(super) materials: Vec<String>,
}

impl Segments {
    /// Follows the states of the file. Objects are those that `o` names, or if there are none those of `g`.
    pub(super) fn new(whole: &Whole, triangles: &[Triangles], warnings: &mut Warnings) -> Self {
        let states = || whole.pieces.iter().flat_map(|p| p.states.iter().map(|(_, state)| state));
        let by_object = states().any(|s| matches!(s, State::Object(_)));
        let mut out = Segments::default();
        let (mut object_ids, mut material_ids) = (HashMap::new(), HashMap::new());
        let unnamed = out.intern_object(&mut object_ids, "");
        let mut current = Segment { piece: 0, range: 0..0, object: unnamed, material: None, smoothing: 0 };
        for (piece, (faces, triangles)) in whole.pieces.iter().zip(triangles).enumerate() {
            current = Segment { piece, range: 0..0, ..current };
            for ((_, state), &start) in faces.states.iter().zip(&triangles.starts) {
                out.close(&mut current, start as usize);
                match state {
                    State::Object(name) if by_object => {
                        current.object = out.intern_object(&mut object_ids, name)
                    }
                    State::Group(name) if !by_object => {
                        current.object = out.intern_object(&mut object_ids, name)
                    }
                    State::Object(_) | State::Group(_) => {}
                    State::Material(name) if name.is_empty() => current.material = None,
                    State::Material(name) => {
                        let fresh = out.materials.len();
                        let id = *material_ids.entry(name.as_str()).or_insert(fresh);
                        if id == fresh {
                            out.materials.push(name.clone());
                        }
                        current.material = Some(id);
                    }
                    State::Smoothing(group) => current.smoothing = *group,
                }
            }
            out.close(&mut current, triangles.corners.len());
            current.range = 0..0;
        }
        if object_ids.len() > MOST_OBJECTS {
            warnings.add("", format!("more than {MOST_OBJECTS} objects: they become one"));
            out.list.iter_mut().for_each(|s| s.object = unnamed);
        }
        out
    }

    fn intern_object<'n>(&mut self, ids: &mut HashMap<&'n str, usize>, name: &'n str) -> usize {
        let fresh = self.objects.len();
        let id = *ids.entry(name).or_insert(fresh);
        if id == fresh {
            self.objects.push(name.into());
        }
        id
    }

    /// Ends the current segment before triangle `end` of its piece and begins the next there.
    fn close(&mut self, current: &mut Segment, end: usize) {
        let begin = current.range.start;
        if end > begin {
            self.list.push(Segment { range: begin..end, ..current.clone() });
        }
        current.range = end..end;
    }

    /// Whether some faces came before any material was named.
    pub(super) fn any_without_material(&self) -> bool {
        self.list.iter().any(|s| s.material.is_none())
    }

    /// The meshes. `ids` has the scene's material for each of `materials`, `otherwise` is for faces without.
    pub(super) fn meshes(
        self,
        whole: &Whole,
        triangles: &[Triangles],
        ids: &[MaterialId],
        otherwise: Option<MaterialId>,
    ) -> Vec<Mesh> {
        // Parts in the order of their first triangle.
        let mut parts: Vec<Part> = Vec::new();
        let mut part_ids = HashMap::new();
        for segment in &self.list {
            let material = segment.material.map_or(otherwise, |m| Some(ids[m]));
            let part = *part_ids.entry((segment.object, material)).or_insert(parts.len());
            if part == parts.len() {
                parts.push(Part { object: segment.object, material, segments: Vec::new() });
            }
            parts[part].segments.push(segment);
        }
        let primitives: Vec<Vec<Primitive>> =
            parts.par_iter().map(|part| part.primitives(whole, triangles)).collect();
        let named = |name: &String| Mesh { name: name.clone(), primitives: Vec::new() };
        let mut meshes: Vec<Mesh> = self.objects.iter().map(named).collect();
        for (part, primitives) in parts.iter().zip(primitives) {
            meshes[part.object].primitives.extend(primitives);
        }
        meshes.retain(|m| !m.primitives.is_empty());
        meshes
    }
}

/// Triangles of one object and one material.
struct Part<'s> {
    object: usize,
    material: Option<MaterialId>,
    segments: Vec<&'s Segment>,
}

impl Part<'_> {
    /// One primitive for triangles with normals, one for flat ones: attributes are for all vertices of a primitive or for none.
    fn primitives(&self, whole: &Whole, triangles: &[Triangles]) -> Vec<Primitive> {
        let each = || self.segments.iter().flat_map(|s| triangles[s.piece].corners[s.range.clone()].iter());
        let shaded = each().filter(|t| t[0][2] != NONE).count();
        let flat = each().count() - shaded;
        let of = |count: usize, has_normals: bool| {
            if count == 0 {
                return None;
            }
            let chosen = || each().filter(|t| (t[0][2] != NONE) == has_normals);
            let textured = chosen().any(|t| t.iter().any(|c| c[1] != NONE));
            let (low, high) = chosen().flatten().fold((NONE, 0), |(l, h), c| (l.min(c[0]), h.max(c[0])));
            let mut builder = Builder::new(whole, (low, high), 3 * count, textured, has_normals);
            chosen().for_each(|t| builder.add(t));
            builder.primitive.material = self.material;
            Some(builder.primitive)
        };
        [of(shaded, true), of(flat, false)].into_iter().flatten().collect()
    }
}

/// How many vertices at one place are looked through for one that is the same. Beyond it a vertex may be there twice, which
/// costs memory and changes nothing.
const MOST_COMPARED: usize = 16;

/// Gathers the vertices of a primitive, each combination of indices once.
struct Builder<'a> {
    whole: &'a Whole<'a>,
    textured: bool,
    has_normals: bool,
    heads: Heads,
    /// For each vertex its texture coordinates, its normal, and the next vertex at the same place.
    links: Vec<[u32; 3]>,
    primitive: Primitive,
}

/// The last vertex at each position of the file.
enum Heads {
    /// From the lowest position in use.
    Dense(u32, Vec<u32>),
    /// Where few of a wide range are in use.
    Sparse(HashMap<u32, u32>),
}

impl Heads {
    /// For so many corners with positions in this range.
    fn new((low, high): (u32, u32), corners: usize) -> Self {
        const FEW: usize = 8;
        let range = (high - low) as usize + 1;
        if range / FEW > corners {
            Heads::Sparse(HashMap::new())
        } else {
            Heads::Dense(low, vec![NONE; range])
        }
    }

    #[inline]
    fn at(&mut self, position: u32) -> &mut u32 {
        match self {
            Heads::Dense(low, list) => &mut list[(position - *low) as usize],
            Heads::Sparse(map) => map.entry(position).or_insert(NONE),
        }
    }
}

impl<'a> Builder<'a> {
    fn new(whole: &'a Whole, range: (u32, u32), corners: usize, textured: bool, has_normals: bool) -> Self {
        let primitive = Primitive { indices: Vec::with_capacity(corners), ..Primitive::default() };
        Builder {
            whole,
            textured,
            has_normals,
            heads: Heads::new(range, corners),
            links: Vec::new(),
            primitive,
        }
    }

    fn add(&mut self, triangle: &[Corner; 3]) {
        for corner in triangle {
            let index = self.vertex(*corner);
            self.primitive.indices.push(index);
        }
    }

    #[inline]
    fn vertex(&mut self, [v, vt, vn]: Corner) -> u32 {
        let head = self.heads.at(v);
        let mut at = *head;
        for _ in 0..MOST_COMPARED {
            if at == NONE {
                break;
            }
            let [known_vt, known_vn, next] = self.links[at as usize];
            if known_vt == vt && known_vn == vn {
                return at;
            }
            at = next;
        }
        let new = self.links.len() as u32;
        self.links.push([vt, vn, std::mem::replace(head, new)]);
        let (whole, p) = (self.whole, &mut self.primitive);
        p.positions.push(whole.positions[v as usize]);
        if self.has_normals {
            p.normals.push(whole.normals[vn as usize]);
        }
        if self.textured {
            p.uv0.push(whole.uvs.get(vt as usize).copied().unwrap_or(Vec2::ZERO));
        }
        if !whole.colors.is_empty() {
            p.colors.push(whole.colors[v as usize].extend(1.0));
        }
        new
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn whole<'a>() -> Whole<'a> {
        Whole {
            positions: (0..100).map(|i| Vec3::splat(i as f32)).collect(),
            uvs: (0..100).map(|i| Vec2::splat(i as f32)).collect(),
            ..Whole::default()
        }
    }

    #[test]
    fn equal_corners_are_one_vertex() {
        let whole = whole();
        for range in [(0, 99), (0, 4_000_000)] {
            let mut b = Builder::new(&whole, range, 9, true, false);
            for t in [[[7, 1, NONE], [8, 1, NONE], [9, 1, NONE]], [[7, 1, NONE], [8, 2, NONE], [9, 1, NONE]]]
            {
                b.add(&t);
            }
            assert_eq!(b.primitive.indices, [0, 1, 2, 0, 3, 2]);
            assert_eq!(b.primitive.positions[3], Vec3::splat(8.0));
            assert_eq!(b.primitive.uv0[3], Vec2::splat(2.0));
            assert!(b.primitive.normals.is_empty() && b.primitive.colors.is_empty());
        }
    }

    #[test]
    fn one_place_with_many_texture_coordinates_costs_no_more_than_its_corners() {
        let whole = whole();
        let mut b = Builder::new(&whole, (0, 0), 9, true, false);
        for i in 0..90 {
            b.add(&[[0, i, NONE], [0, i, NONE], [0, 0, NONE]]);
        }
        assert!(b.primitive.positions.len() <= 180 && b.primitive.positions.len() >= 90);
        assert!(b.primitive.indices.iter().all(|&i| (i as usize) < b.primitive.positions.len()));
    }
}
