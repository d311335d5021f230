//! PLY, the Stanford triangle format (Turk 1994), as a single object: text, and binary of either byte order.
//!
//! Read of `vertex`: x y z, nx ny nz, texture coordinates (u v, s t, texture_u texture_v), red green blue (as bytes, words
//! or floats; by the sRGB curve); of `face` the list of vertex indices; of `tristrips` the list with -1 between strips. All else is
//! passed over. Our own reader: the crates for PLY give every value a name of its own, which is slow and takes much memory.

mod header;
mod values;

use crate::error::one_line;
use crate::limits::Room;
use crate::warnings::Warnings;
use crate::{Bound, IoError, LoadOptions, Loaded, obj, polygon};
use glam::{Vec2, Vec3, Vec4};
use header::{Element, Header, Kind, Property};
use lumbre_scene::{Mesh, Primitive, Scene};
use std::path::Path;
use values::Values;

/// Whether a file begins as a PLY does.
pub(crate) fn is_ply(bytes: &[u8]) -> bool {
    bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r")
}

/// Loads a PLY from its bytes; `path` is where they came from.
pub(crate) fn load(path: &Path, bytes: &[u8], options: &LoadOptions) -> Result<Loaded, IoError> {
    let header = Header::parse(path, bytes)?;
    let limits = &options.limits;
    let vertices = header.elements.iter().filter(|e| e.name == "vertex").map(|e| e.count);
    limits.hold(Bound::Vertices, path, "", vertices.fold(0, u64::saturating_add))?;
    let mut body = Body {
        path,
        values: Values::new(&bytes[header.body..], header.format, header.lines),
        primitive: Primitive::default(),
        room: limits.room(Bound::Triangles),
        warnings: Warnings::default(),
        lost: 0,
        crossing: 0,
    };
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" if body.primitive.positions.is_empty() => body.vertices(element)?,
            "face" => body.faces(element)?,
            "tristrips" => body.strips(element)?,
            _ => body.pass_over(element)?,
        }
    }
    let Body { mut primitive, mut warnings, lost, crossing, .. } = body;
    if lost > 0 {
        warnings.add_many("", "a face of fewer than three corners is skipped", lost);
    }
    if crossing > 0 {
        warnings.add_many("", polygon::CROSSING, crossing);
    }
    check_indices(path, &primitive)?;
    mend_normals(&mut primitive, &mut warnings);
    if primitive.indices.is_empty() {
        warnings.add("", "it has no faces: there is nothing to draw");
    }
    Ok(single_object(path, primitive, warnings))
}

/// A scene of one mesh in a grey material, or white where vertex colours say all.
pub(crate) fn single_object(path: &Path, mut primitive: Primitive, warnings: Warnings) -> Loaded {
    let mut scene = Scene { name: obj::scene_name(path), ..Scene::default() };
    let material = scene.add_material(obj::stand_in("", !primitive.colors.is_empty()));
    primitive.material = Some(material);
    if !primitive.indices.is_empty() {
        let mesh = Mesh { name: String::new(), primitives: vec![primitive] };
        obj::add_meshes(&mut scene, vec![mesh], path);
    }
    Loaded { scene, warnings: warnings.into_lines() }
}

/// What is done with a property of a vertex.
#[derive(Clone, Copy)]
enum Slot {
    Position(usize),
    Normal(usize),
    Uv(usize),
    /// With the factor that brings it to 0 to 1.
    Color(usize, f32),
    Other,
}

impl Slot {
    fn of(property: &Property) -> Slot {
        if property.length.is_some() {
            return Slot::Other;
        }
        let unit = match property.kind {
            Kind::U8 => 1.0 / 255.0,
            Kind::U16 => 1.0 / 65535.0,
            _ => 1.0,
        };
        match property.name.as_str() {
            "x" => Slot::Position(0),
            "y" => Slot::Position(1),
            "z" => Slot::Position(2),
            "nx" => Slot::Normal(0),
            "ny" => Slot::Normal(1),
            "nz" => Slot::Normal(2),
            "u" | "s" | "texture_u" => Slot::Uv(0),
            "v" | "t" | "texture_v" => Slot::Uv(1),
            "red" | "r" | "diffuse_red" => Slot::Color(0, unit),
            "green" | "g" | "diffuse_green" => Slot::Color(1, unit),
            "blue" | "b" | "diffuse_blue" => Slot::Color(2, unit),
            _ => Slot::Other,
        }
    }
}

/// The body while it is read.
struct Body<'a> {
    path: &'a Path,
    values: Values<'a>,
    primitive: Primitive,
    /// For triangles.
    room: Room,
    warnings: Warnings,
    /// Faces of fewer than three corners.
    lost: usize,
    /// Faces that cross themselves.
    crossing: usize,
}

impl Body<'_> {
    /// The place of a row: its line where there are lines.
    fn error(&self, element: &Element, row: u64, why: impl ToString) -> IoError {
        IoError::data(self.path, self.place(element, row), why.to_string())
    }

    fn place(&self, element: &Element, row: u64) -> String {
        if self.values.is_text() {
            format!("line {}", self.values.line)
        } else {
            one_line(&format!("{} {row}", element.name))
        }
    }

    fn vertices(&mut self, element: &Element) -> Result<(), IoError> {
        let slots: Vec<Slot> = element.properties.iter().map(Slot::of).collect();
        let has = |wanted: fn(&Slot) -> bool| slots.iter().filter(|s| wanted(s)).count();
        if has(|s| matches!(s, Slot::Position(_))) < 3 {
            return Err(IoError::data(self.path, "", "its vertices have no x, y and z"));
        }
        let normals = has(|s| matches!(s, Slot::Normal(_))) >= 3;
        let uvs = has(|s| matches!(s, Slot::Uv(_))) >= 2;
        let colors = has(|s| matches!(s, Slot::Color(..))) >= 3;
        // The header's check has shown that there are bytes for so many.
        let count = usize::try_from(element.count).unwrap_or(usize::MAX);
        let mut p = Primitive { positions: Vec::with_capacity(count), ..Primitive::default() };
        let mut rgb = Vec::new();
        for row in 0..element.count {
            let (mut position, mut normal, mut uv, mut color) = ([0.0; 3], [0.0; 3], [0.0; 2], [1.0; 3]);
            for (property, slot) in element.properties.iter().zip(&slots) {
                let read = match *slot {
                    Slot::Position(k) => self.values.float(property.kind).map(|v| position[k] = v),
                    Slot::Normal(k) => self.values.float(property.kind).map(|v| normal[k] = v),
                    Slot::Uv(k) => self.values.float(property.kind).map(|v| uv[k] = v),
                    Slot::Color(k, unit) => self.values.float(property.kind).map(|v| color[k] = v * unit),
                    Slot::Other => self.skip(property),
                };
                read.map_err(|why| self.error(element, row, why))?;
            }
            let position = Vec3::from_array(position);
            if !position.is_finite() {
                return Err(self.error(element, row, format!("{position} is no position")));
            }
            p.positions.push(position);
            if normals {
                p.normals.push(Vec3::from_array(normal));
            }
            if uvs {
                let uv = Vec2::new(uv[0], 1.0 - uv[1]);
                p.uv0.push(if uv.is_finite() { uv } else { Vec2::ZERO });
            }
            if colors {
                rgb.push(Vec3::from_array(color));
            }
        }
        obj::linearise(&mut rgb);
        p.colors = rgb.into_iter().map(|c| Vec4::from((c, 1.0))).collect();
        // Faces may stand before their vertices.
        p.indices = std::mem::take(&mut self.primitive.indices);
        self.primitive = p;
        Ok(())
    }

    fn skip(&mut self, property: &Property) -> Result<(), String> {
        let count = match property.length {
            Some(length) => self.values.length(length, property.kind)?,
            None => 1,
        };
        self.values.skip(property.kind, count)
    }

    fn pass_over(&mut self, element: &Element) -> Result<(), IoError> {
        for row in 0..element.count {
            for property in &element.properties {
                self.skip(property).map_err(|why| self.error(element, row, why))?;
            }
        }
        Ok(())
    }

    /// Reads the rows of an element and gives the list of each to `each`.
    fn lists(
        &mut self,
        element: &Element,
        mut each: impl FnMut(&mut Self, &[i64]) -> Result<(), IoError>,
    ) -> Result<(), IoError> {
        let list = element.find(&["vertex_indices", "vertex_index"]);
        if list.is_none() {
            let what = format!("the element {} has no list of vertices and is skipped", element.name);
            self.warnings.add("", what);
        }
        let mut indices = Vec::new();
        for row in 0..element.count {
            indices.clear();
            for (at, property) in element.properties.iter().enumerate() {
                let read = match property.length.filter(|_| Some(at) == list) {
                    Some(length) => self.list(length, property.kind, &mut indices),
                    None => self.skip(property),
                };
                read.map_err(|why| self.error(element, row, why))?;
            }
            if list.is_some() {
                each(self, &indices).map_err(|e| e.at_place(&self.place(element, row)))?;
            }
        }
        Ok(())
    }

    fn list(&mut self, length: Kind, kind: Kind, out: &mut Vec<i64>) -> Result<(), String> {
        for _ in 0..self.values.length(length, kind)? {
            out.push(self.values.integer(kind)?);
        }
        Ok(())
    }

    fn faces(&mut self, element: &Element) -> Result<(), IoError> {
        let (mut points, mut cuts) = (Vec::new(), Vec::new());
        self.lists(element, |body, list| {
            if list.len() < 3 {
                body.lost += 1;
                return Ok(());
            }
            body.room.take(body.path, "", list.len() as u64 - 2)?;
            let corners = list.iter().map(|&i| body.index(i)).collect::<Result<Vec<u32>, _>>()?;
            if let [a, b, c] = corners[..] {
                body.primitive.indices.extend([a, b, c]);
                return Ok(());
            }
            // Of vertices that come later nothing is known yet: a fan.
            points.clear();
            let at = |i: &u32| body.primitive.positions.get(*i as usize).copied().unwrap_or(Vec3::ZERO);
            points.extend(corners.iter().map(at));
            cuts.clear();
            if !polygon::triangulate(&points, &mut cuts) {
                body.crossing += 1;
            }
            body.primitive.indices.extend(cuts.iter().flatten().map(|&i| corners[i as usize]));
            Ok(())
        })
    }

    /// Strips of triangles, each with the winding of its place in the strip.
    fn strips(&mut self, element: &Element) -> Result<(), IoError> {
        self.lists(element, |body, list| {
            for strip in list.split(|&i| i == -1) {
                for (k, t) in strip.windows(3).enumerate() {
                    body.room.take(body.path, "", 1)?;
                    let [a, b, c] = if k % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] };
                    for i in [a, b, c] {
                        let index = body.index(i)?;
                        body.primitive.indices.push(index);
                    }
                }
            }
            Ok(())
        })
    }

    /// An index; whether there is such a vertex is seen at the end.
    fn index(&self, i: i64) -> Result<u32, IoError> {
        u32::try_from(i).map_err(|_| IoError::data(self.path, "", format!("{i} is no index of a vertex")))
    }
}

fn check_indices(path: &Path, p: &Primitive) -> Result<(), IoError> {
    let count = p.positions.len();
    match p.indices.iter().position(|&i| i as usize >= count) {
        Some(at) => {
            let why = format!("refers to vertex {}, but there are {count}", p.indices[at]);
            Err(IoError::data(path, format!("triangle {}", at / 3), why))
        }
        None => Ok(()),
    }
}

/// Unit normals; those without a direction get that of the triangles around.
fn mend_normals(p: &mut Primitive, warnings: &mut Warnings) {
    let lost = p.normals.iter().filter(|n| n.try_normalize().is_none()).count();
    let mut around = Vec::new();
    if lost > 0 {
        warnings.add_many(
            "",
            "a normal without a direction is replaced by that of the triangles around",
            lost,
        );
        around = vec![Vec3::ZERO; p.positions.len()];
        for t in p.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|k| p.positions[t[k] as usize]);
            t.iter().for_each(|&v| around[v as usize] += (b - a).cross(c - a));
        }
    }
    for (i, n) in p.normals.iter_mut().enumerate() {
        let other = || around.get(i).and_then(|s| s.try_normalize()).unwrap_or(Vec3::Z);
        *n = n.try_normalize().unwrap_or_else(other);
    }
}
