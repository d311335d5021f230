//! STL, the format of 3D printers (3D Systems 1989), text or binary, as a single flat-shaded object. The winding of a
//! triangle says which side is outside; the normals in the file repeat it, often wrongly, and are not read.

use crate::warnings::Warnings;
use crate::{Bound, IoError, LoadOptions, Loaded, ply};
use glam::Vec3;
use lumbre_scene::Primitive;
use std::path::Path;

/// Bytes before the first triangle of a binary file: 80 of anything, then their number.
const HEADER: usize = 84;
/// Bytes of a triangle: normal, three corners, two of anything.
const FACET: usize = 50;

/// Loads an STL from its bytes; `path` is where they came from.
pub(crate) fn load(path: &Path, bytes: &[u8], options: &LoadOptions) -> Result<Loaded, IoError> {
    let mut warnings = Warnings::default();
    let limits = &options.limits;
    let positions = match binary_count(bytes) {
        Some(count) => {
            limits.hold(Bound::Triangles, path, "", count as u64)?;
            limits.hold(Bound::Vertices, path, "", 3 * count as u64)?;
            if bytes.len() > HEADER + FACET * count {
                warnings.add("", "bytes after the last triangle are ignored");
            }
            binary(path, bytes, count)?
        }
        None if is_text(bytes) => {
            // No corner is shorter than `vertex 0 0 0`.
            text(path, bytes, limits.room(Bound::Triangles))?
        }
        None => {
            let why = "not an STL: no text that begins with `solid`, and too short for the triangles that a binary one promises";
            return Err(IoError::data(path, "", why));
        }
    };
    limits.hold(Bound::Vertices, path, "", positions.len() as u64)?;
    if positions.is_empty() {
        warnings.add("", "it has no triangles: there is nothing to draw");
    }
    let indices = (0..positions.len() as u64).map(|i| i as u32).collect();
    let primitive = Primitive { positions, indices, ..Primitive::default() };
    Ok(ply::single_object(path, primitive, warnings))
}

fn is_text(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().get(..5).is_some_and(|b| b.eq_ignore_ascii_case(b"solid"))
}

/// The number of triangles if it is a binary file. Some of these begin with `solid` too: then the size must be right to the byte.
fn binary_count(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..HEADER)?.try_into().map(u32::from_le_bytes).ok()? as usize;
    let size = HEADER + FACET.checked_mul(count)?;
    (bytes.len() == size || (bytes.len() > size && !is_text(bytes))).then_some(count)
}

fn binary(path: &Path, bytes: &[u8], count: usize) -> Result<Vec<Vec3>, IoError> {
    let mut positions = Vec::with_capacity(3 * count);
    for (number, facet) in bytes[HEADER..].chunks_exact(FACET).take(count).enumerate() {
        let (words, _) = facet.as_chunks::<4>();
        for corner in words[3..12].chunks_exact(3) {
            let p = Vec3::from_array([0, 1, 2].map(|k| f32::from_le_bytes(corner[k])));
            if !p.is_finite() {
                return Err(IoError::data(path, format!("triangle {number}"), format!("{p} is no position")));
            }
            positions.push(p);
        }
    }
    Ok(positions)
}

fn text(path: &Path, bytes: &[u8], mut room: crate::limits::Room) -> Result<Vec<Vec3>, IoError> {
    let mut positions: Vec<Vec3> = Vec::new();
    for (number, line) in bytes.split(|&b| b == b'\n').enumerate() {
        let place = || format!("line {}", number + 1);
        let error = |why: String| IoError::data(path, place(), why);
        let line = String::from_utf8_lossy(line.trim_ascii());
        let mut words = line.split_ascii_whitespace();
        let Some(key) = words.next() else { continue };
        match key.to_ascii_lowercase().as_str() {
            "vertex" => {
                let mut next = || words.next().and_then(|w| w.parse::<f32>().ok());
                let (Some(x), Some(y), Some(z)) = (next(), next(), next()) else {
                    return Err(error("a vertex needs three numbers".into()));
                };
                let p = Vec3::new(x, y, z);
                if !p.is_finite() {
                    return Err(error(format!("{p} is no position")));
                }
                positions.push(p);
            }
            "endloop" | "endfacet" if !positions.len().is_multiple_of(3) => {
                return Err(error("a facet has three vertices".into()));
            }
            "endfacet" => room.take(path, &place(), 1)?,
            "solid" | "facet" | "outer" | "endloop" | "endsolid" => {}
            other => {
                let other: String = other.chars().take(40).collect();
                return Err(error(format!("{other:?} is no word of an STL")));
            }
        }
    }
    if !positions.len().is_multiple_of(3) {
        return Err(IoError::data(path, "", "it ends within a facet"));
    }
    Ok(positions)
}
