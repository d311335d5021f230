//! An OBJ file read in pieces on all cores and put together.

use super::chunk::{Chunk, MOST_VERTICES, NO_COLOR, Note, RawCorner, State};
use crate::warnings::Warnings;
use crate::{Bound, IoError, Limits};
use glam::{Vec2, Vec3};
use lumbre_core::color::srgb_decode;
use rayon::prelude::*;
use std::path::Path;

/// Bytes of a piece: enough to outweigh its bookkeeping, few enough to keep all cores busy to the end.
const PIECE: usize = 1 << 20;
/// Pieces after which limits are checked; the number of cores must not decide what an error says.
const WAVE: usize = 64;

/// Faces of one piece, as it writes them.
pub(super) struct Faces<'a> {
    pub(super) text: &'a [u8],
    /// Lines of the file before it.
    pub(super) lines_before: usize,
    /// Positions, texture coordinates and normals before it.
    pub(super) bases: [u32; 3],
    pub(super) corners: Vec<RawCorner>,
    pub(super) face_ends: Vec<u32>,
    pub(super) states: Vec<(u32, State)>,
}

/// All that a file says.
#[derive(Default)]
pub(super) struct Whole<'a> {
    pub(super) positions: Vec<Vec3>,
    /// Linear; empty, or as many as positions.
    pub(super) colors: Vec<Vec3>,
    /// v points down.
    pub(super) uvs: Vec<Vec2>,
    /// Unit; NaN where the file's have no direction.
    pub(super) normals: Vec<Vec3>,
    pub(super) pieces: Vec<Faces<'a>>,
    /// Names of material libraries, and their lines.
    pub(super) libraries: Vec<(usize, String)>,
}

impl<'a> Whole<'a> {
    /// Reads a file's text; `path` is where it came from.
    pub(super) fn read(
        path: &Path,
        text: &'a [u8],
        limits: &Limits,
        warnings: &mut Warnings,
    ) -> Result<Self, IoError> {
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        let mut whole = Whole::default();
        let (mut lines, mut triangles) = (0, 0u64);
        for wave in split(text).chunks(WAVE) {
            let chunks: Vec<Chunk> = wave.par_iter().map(|piece| Chunk::read(piece)).collect();
            for (chunk, text) in chunks.into_iter().zip(wave) {
                if let Some((line, why)) = chunk.error {
                    return Err(IoError::data(path, format!("line {}", lines + line), why));
                }
                let place = format!("line {}", lines + chunk.lines);
                triangles += (chunk.corners.len() - 2 * chunk.face_ends.len()) as u64;
                limits.hold(Bound::Triangles, path, &place, triangles)?;
                whole.check_counts(path, &place, &chunk, limits)?;
                let before = lines;
                lines += chunk.lines;
                whole.append(chunk, text, before, warnings);
            }
        }
        whole.finish(warnings);
        Ok(whole)
    }

    /// Positions, texture coordinates and normals.
    pub(super) fn counts(&self) -> [u32; 3] {
        [self.positions.len(), self.uvs.len(), self.normals.len()].map(|n| n as u32)
    }

    fn check_counts(&self, path: &Path, place: &str, more: &Chunk, limits: &Limits) -> Result<(), IoError> {
        let more = [more.positions.len(), more.uvs.len(), more.normals.len()];
        let most =
            self.counts().iter().zip(more).map(|(&have, more)| have as usize + more).max().unwrap_or(0);
        limits.hold(Bound::Vertices, path, place, most as u64)?;
        if most >= MOST_VERTICES as usize {
            return Err(IoError::data(path, place, format!("{most} vertices are too many to be numbered")));
        }
        Ok(())
    }

    fn append(&mut self, chunk: Chunk, text: &'a [u8], lines_before: usize, warnings: &mut Warnings) {
        let bases = self.counts();
        for noted in &chunk.notes {
            let place = format!("line {}", lines_before + noted.line);
            warnings.add_many(place, what(&noted.note), noted.count);
        }
        let libraries = chunk.libraries.into_iter().map(|(line, name)| (lines_before + line, name));
        self.libraries.extend(libraries);
        if !(chunk.colors.is_empty() && self.colors.is_empty()) {
            self.colors.resize(self.positions.len(), NO_COLOR);
            self.colors.extend(chunk.colors);
            self.colors.resize(self.positions.len() + chunk.positions.len(), NO_COLOR);
        }
        self.positions.extend(chunk.positions);
        self.uvs.extend(chunk.uvs);
        self.normals.extend(chunk.normals);
        let Chunk { corners, face_ends, states, .. } = chunk;
        self.pieces.push(Faces { text, lines_before, bases, corners, face_ends, states });
    }

    /// Brings values into the scene's terms.
    fn finish(&mut self, warnings: &mut Warnings) {
        let odd = self.uvs.par_iter().filter(|uv| !uv.is_finite()).count();
        if odd > 0 {
            warnings.add_many("", "texture coordinates that are no numbers are set to 0", odd);
        }
        self.uvs.par_iter_mut().for_each(|uv| {
            *uv = if uv.is_finite() { Vec2::new(uv.x, 1.0 - uv.y) } else { Vec2::ZERO };
        });
        self.normals.par_iter_mut().for_each(|n| *n = n.try_normalize().unwrap_or(Vec3::NAN));
        let odd = self.normals.par_iter().filter(|n| n.is_nan()).count();
        if odd > 0 {
            warnings.add_many("", "normals without a direction are left out", odd);
        }
        linearise(&mut self.colors);
    }
}

/// Vertex colours as programs write them (Blender, MeshLab): by the sRGB curve, 0 to 1; some write 0 to 255. Those that are
/// not finite become white.
pub(crate) fn linearise(colors: &mut [Vec3]) {
    let most = colors.iter().map(|c| c.max_element()).filter(|m| m.is_finite()).fold(0.0, f32::max);
    // A little above 1 is a rounding error.
    let scale = if most > 2.0 { 1.0 / 255.0 } else { 1.0 };
    colors.par_iter_mut().for_each(|c| {
        let decode = |v: f32| srgb_decode((v * scale).clamp(0.0, 1.0));
        *c = if c.is_finite() { Vec3::from_array(c.to_array().map(decode)) } else { Vec3::ONE };
    });
}

/// Pieces that begin and end with whole statements.
fn split(text: &[u8]) -> Vec<&[u8]> {
    let mut pieces = Vec::with_capacity(text.len() / PIECE + 1);
    let mut rest = text;
    while rest.len() > PIECE {
        let (piece, others) = rest.split_at(statement_end(rest, PIECE));
        pieces.push(piece);
        rest = others;
    }
    pieces.push(rest);
    pieces
}

/// The end of the first statement that ends at `from` or later.
fn statement_end(text: &[u8], from: usize) -> usize {
    let mut at = from;
    while let Some(found) = text[at..].iter().position(|&b| b == b'\n') {
        at += found + 1;
        let line = &text[..at - 1];
        if !line.strip_suffix(b"\r").unwrap_or(line).ends_with(b"\\") {
            return at;
        }
    }
    text.len()
}

fn what(note: &Note) -> String {
    match note {
        Note::PointsAndLines => "points and lines are not supported and are skipped".into(),
        Note::FreeForm => "free-form curves and surfaces are not supported and are skipped".into(),
        Note::Commands => "commands to run other files are not followed".into(),
        Note::SmallFace => "a face of fewer than three corners is skipped".into(),
        Note::Unknown(word) => format!("the statement {word} is not known and is skipped"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_end_with_statements() {
        let text = b"v 1 \\\n 2 \\\r\n 3\nv 4 5 6\n";
        assert_eq!(statement_end(text, 0), 15);
        assert_eq!(statement_end(text, 5), 15);
        assert_eq!(statement_end(text, 15), 23);
        assert_eq!(statement_end(b"v 1 2 3", 2), 7);
        let long = "v 1 2 3 # some words behind it\n".repeat(100_000).into_bytes();
        let pieces = split(&long);
        assert!(pieces.len() == 3 && pieces.concat() == long);
        assert!(pieces.iter().all(|p| p.ends_with(b"\n")));
        assert_eq!(split(b""), [b""]);
    }

    /// What stands in a later piece refers to what stands in an earlier one, and lines are counted through.
    #[test]
    fn a_file_of_many_pieces_is_one() {
        let path = Path::new("a.obj");
        let mut text = String::new();
        for i in 0..60_000 {
            text += &format!("v {i} 0 0\nv {i} 1 0\nv {i} 0 1\nvt 0.25 0.25\nvn 0 0 2\nf -3/-1/-1 -2 -1\n");
        }
        let read = |text: &str, limits: &Limits| {
            Whole::read(path, text.as_bytes(), limits, &mut Warnings::default()).map(|w| {
                assert!(w.pieces.len() > 2);
                (w.counts(), w.pieces.last().unwrap().lines_before, w.uvs[0], w.normals[59_999])
            })
        };
        let (counts, before, uv, normal) = read(&text, &Limits::default()).unwrap();
        assert_eq!((counts, uv, normal), ([180_000, 60_000, 60_000], Vec2::new(0.25, 0.75), Vec3::Z));
        assert!(before > 100_000);
        let wrong = format!("{text}v 1 2\n");
        let e = read(&wrong, &Limits::default()).unwrap_err();
        assert_eq!(e.to_string(), "a.obj: line 360001: has 2 numbers where 3 are needed");
        let few = Limits { max_vertices: 179_999, ..Limits::default() };
        assert!(read(&text, &few).unwrap_err().to_string().ends_with("exceeds the limit of 179999"));
        let few = Limits { max_triangles: 59_999, ..Limits::default() };
        assert!(read(&text, &few).unwrap_err().to_string().contains("number of triangles 60000 exceeds"));
    }

    #[test]
    fn colours_become_linear() {
        let mut colors = [Vec3::new(0.0, 0.5, 1.0), Vec3::new(1.01, -1.0, 0.5), NO_COLOR];
        linearise(&mut colors);
        let half = srgb_decode(0.5);
        assert_eq!(colors, [Vec3::new(0.0, half, 1.0), Vec3::new(1.0, 0.0, half), Vec3::ONE]);
        let mut bytes = [Vec3::new(0.0, 127.5, 255.0), NO_COLOR];
        linearise(&mut bytes);
        assert!((bytes[0] - Vec3::new(0.0, half, 1.0)).length() < 1e-6);
        assert_eq!(bytes[1], Vec3::ONE);
    }
}
