//! Faces to triangles, on all cores: indices become those of the whole file, polygons are cut.

use super::chunk::{Chunk, RawCorner};
use super::whole::{Faces, Whole};
use crate::IoError;
use crate::polygon;
use crate::warnings::Warnings;
use rayon::prelude::*;
use std::path::Path;

/// Where a corner has no texture coordinates or no normal.
pub(super) const NONE: u32 = u32::MAX;

/// Position, texture coordinates and normal of a corner, as indices into those of [`Whole`].
pub(super) type Corner = [u32; 3];

/// The triangles of one piece of the file.
#[derive(Default)]
pub(super) struct Triangles {
    /// Either all three corners of a triangle have a normal, or none has.
    pub(super) corners: Vec<[Corner; 3]>,
    /// For each of the piece's states, the number of triangles before it.
    pub(super) starts: Vec<u32>,
    /// Indices of texture coordinates and of normals that lead nowhere.
    lost: [usize; 2],
    /// Faces that cross themselves.
    crossing: usize,
}

/// A face that refers to a vertex that is not there.
struct WrongFace {
    face: usize,
    why: String,
}

/// The triangles of every piece.
pub(super) fn triangulate(
    path: &Path,
    whole: &Whole,
    warnings: &mut Warnings,
) -> Result<Vec<Triangles>, IoError> {
    // Results are gathered before the first error is looked for, so that it is always the same one.
    let all: Vec<Result<Triangles, WrongFace>> =
        whole.pieces.par_iter().map(|p| of_piece(whole, p)).collect();
    let (mut lost, mut crossing) = ([0; 2], 0);
    let mut out = Vec::with_capacity(all.len());
    for (piece, triangles) in whole.pieces.iter().zip(all) {
        let triangles = triangles.map_err(|WrongFace { face, why }| {
            let line = piece.lines_before + Chunk::line_of_face(piece.text, face);
            IoError::data(path, format!("line {line}"), why)
        })?;
        (0..2).for_each(|i| lost[i] += triangles.lost[i]);
        crossing += triangles.crossing;
        out.push(triangles);
    }
    for (count, what) in lost.into_iter().zip(["texture coordinates", "normals"]) {
        if count > 0 {
            warnings.add_many(
                "",
                format!("faces refer to {what} that are not there; they go without"),
                count,
            );
        }
    }
    if crossing > 0 {
        warnings.add_many("", polygon::CROSSING, crossing);
    }
    Ok(out)
}

fn of_piece(whole: &Whole, piece: &Faces) -> Result<Triangles, WrongFace> {
    let mut out = Triangles::default();
    out.corners.reserve(piece.corners.len() - 2 * piece.face_ends.len());
    out.starts.reserve(piece.states.len());
    let mut states = piece.states.iter().map(|(face, _)| *face as usize).peekable();
    let (mut face, mut points, mut cuts) = (Vec::new(), Vec::new(), Vec::new());
    let mut begin = 0;
    for (number, &end) in piece.face_ends.iter().enumerate() {
        while states.next_if(|&at| at <= number).is_some() {
            out.starts.push(out.corners.len() as u32);
        }
        face.clear();
        for &raw in &piece.corners[begin..end as usize] {
            let corner = resolve(whole, piece, raw, &mut out.lost);
            face.push(corner.map_err(|why| WrongFace { face: number, why })?);
        }
        begin = end as usize;
        if face.iter().any(|c| c[2] == NONE) {
            face.iter_mut().for_each(|c| c[2] = NONE);
        }
        if let [a, b, c] = face[..] {
            out.corners.push([a, b, c]);
            continue;
        }
        points.clear();
        points.extend(face.iter().map(|c| whole.positions[c[0] as usize]));
        cuts.clear();
        out.crossing += usize::from(!polygon::triangulate(&points, &mut cuts));
        out.corners.extend(cuts.iter().map(|t| t.map(|i| face[i as usize])));
    }
    out.starts.extend(states.map(|_| out.corners.len() as u32));
    Ok(out)
}

#[inline]
fn resolve(whole: &Whole, piece: &Faces, raw: RawCorner, lost: &mut [usize; 2]) -> Result<Corner, String> {
    let counts = whole.counts();
    let [v, vt, vn] = [0, 1, 2].map(|k| raw[k].resolve(piece.bases[k], counts[k]));
    // No face is without its vertices: an index of 0 was refused before.
    let v = v
        .ok()
        .flatten()
        .ok_or_else(|| format!("refers to a vertex that is not there; there are {}", counts[0]))?;
    let mut other = |k: usize, index: Result<Option<u32>, ()>| {
        let index = index.unwrap_or_else(|()| {
            lost[k] += 1;
            None
        });
        index.unwrap_or(NONE)
    };
    let (vt, vn) = (other(0, vt), other(1, vn));
    let directed = vn != NONE && !whole.normals[vn as usize].is_nan();
    Ok([v, vt, if directed { vn } else { NONE }])
}
