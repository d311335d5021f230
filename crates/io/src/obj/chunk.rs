//! The statements of one piece of an OBJ file, which is read without knowing what stands before it: indices and names are
//! resolved later, by `faces.rs` and `parts.rs`.

use super::text::{Lines, Words, name, number, shown, split_word};
use glam::{Vec2, Vec3};
use std::mem::discriminant;

/// The largest index of a vertex that can be written down.
pub(super) const MOST_VERTICES: u32 = 1 << 30;

/// The colour of a position that comes without, among others that have one.
pub(super) const NO_COLOR: Vec3 = Vec3::NAN;

/// Indices of a corner as the file writes them: vertex, texture coordinates, normal.
pub(super) type RawCorner = [RawIndex; 3];

/// An index as the file writes it: from the first element, or back from the place where it stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct RawIndex(u32);

impl RawIndex {
    const NONE: RawIndex = RawIndex(0);
    /// Set for an index that counts from the beginning of the chunk.
    const RELATIVE: u32 = 1 << 31;

    /// From what the file says; `here` is the number of elements in the chunk so far.
    fn new(value: i64, here: usize) -> Option<RawIndex> {
        let most = i64::from(MOST_VERTICES);
        if (0..=most).contains(&value) {
            return Some(RawIndex(value as u32));
        }
        // It may point before the chunk. Kept above 0 by as much as it may at most do so.
        let from_chunk = here as i64 + value + most;
        (value < 0 && (0..2 * most).contains(&from_chunk))
            .then_some(RawIndex(Self::RELATIVE | from_chunk as u32))
    }

    /// The element it names, counted from 0; `base` is the number of elements before the chunk. `Ok(None)`: it names none.
    /// `Err`: there is no such element among `count`.
    #[inline]
    pub(super) fn resolve(self, base: u32, count: u32) -> Result<Option<u32>, ()> {
        let index = if self.0 & Self::RELATIVE == 0 {
            let Some(index) = self.0.checked_sub(1) else { return Ok(None) };
            index
        } else {
            let from_chunk = i64::from(self.0 & !Self::RELATIVE) - i64::from(MOST_VERTICES);
            u32::try_from(from_chunk + i64::from(base)).map_err(|_| ())?
        };
        if index < count { Ok(Some(index)) } else { Err(()) }
    }
}

/// A statement that changes how the faces after it are read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum State {
    Object(String),
    Group(String),
    Material(String),
    /// A smoothing group; 0 is off.
    Smoothing(u32),
}

/// What is left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Note {
    PointsAndLines,
    FreeForm,
    Commands,
    SmallFace,
    Unknown(String),
}

/// A kind of note with the line of the first and the number of all.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Noted {
    pub(super) note: Note,
    pub(super) line: usize,
    pub(super) count: usize,
}

/// Corners of a face. A line has no end otherwise.
const MOST_CORNERS: usize = 1 << 20;

/// Kinds of notes that one chunk tells.
const MOST_NOTES: usize = 64;

/// What one chunk says. Lines are counted from 1 in the chunk.
#[derive(Default)]
pub(super) struct Chunk {
    pub(super) positions: Vec<Vec3>,
    /// Colours of the positions as written; empty, or as many.
    pub(super) colors: Vec<Vec3>,
    pub(super) uvs: Vec<Vec2>,
    pub(super) normals: Vec<Vec3>,
    pub(super) corners: Vec<RawCorner>,
    /// For each face, the end of its corners.
    pub(super) face_ends: Vec<u32>,
    /// Before which face each stands.
    pub(super) states: Vec<(u32, State)>,
    /// Names of material libraries, and their lines.
    pub(super) libraries: Vec<(usize, String)>,
    pub(super) notes: Vec<Noted>,
    pub(super) lines: usize,
    /// The first line that is wrong, and why; nothing after it is read.
    pub(super) error: Option<(usize, String)>,
}

impl Chunk {
    /// Reads all lines.
    pub(super) fn read(text: &[u8]) -> Chunk {
        let mut chunk = Chunk::default();
        chunk.read_until(text, usize::MAX);
        chunk
    }

    /// The line of a face, found by reading the text once more.
    pub(super) fn line_of_face(text: &[u8], face: usize) -> usize {
        let mut chunk = Chunk::default();
        chunk.read_until(text, face + 1)
    }

    /// Reads lines until there are so many faces; returns the number of the last line read.
    fn read_until(&mut self, text: &[u8], faces: usize) -> usize {
        let mut lines = Lines::new(text);
        let mut last = 0;
        while self.face_ends.len() < faces {
            let Some((number, line)) = lines.next() else { break };
            last = number;
            if let Err(why) = self.statement(&line, number) {
                self.error = Some((number, why));
                break;
            }
        }
        self.lines = lines.taken;
        last
    }

    fn statement(&mut self, line: &[u8], number: usize) -> Result<(), String> {
        let (key, rest) = split_word(line);
        match key {
            b"v" => self.position(rest),
            b"vt" => {
                let ([u, v, ..], _) = numbers::<3>(rest, 1)?;
                self.uvs.push(Vec2::new(u, v));
                Ok(())
            }
            b"vn" => {
                let (n, _) = numbers::<3>(rest, 3)?;
                self.normals.push(Vec3::from_array(n));
                Ok(())
            }
            b"f" | b"fo" => self.face(rest, number),
            b"" => Ok(()),
            _ if key[0] == b'#' => Ok(()),
            b"o" => self.state(State::Object(name(rest))),
            b"g" => self.state(State::Group(name(rest))),
            b"usemtl" => self.state(State::Material(name(rest))),
            b"s" => self.smoothing(rest),
            b"mtllib" => {
                let library = name(rest);
                // Many files repeat it for each object.
                if self.libraries.last().is_none_or(|(_, last)| *last != library) {
                    self.libraries.push((number, library));
                }
                Ok(())
            }
            _ => self.left_out(key, number),
        }
    }

    fn left_out(&mut self, key: &[u8], line: usize) -> Result<(), String> {
        let note = match key {
            b"p" | b"l" => Note::PointsAndLines,
            b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm"
            | b"trim" | b"hole" | b"scrv" | b"sp" | b"end" | b"con" | b"mg" | b"bzp" | b"bsp" | b"cdc"
            | b"cdp" | b"res" => Note::FreeForm,
            b"call" | b"csh" => Note::Commands,
            // How other programs were to draw it.
            b"bevel" | b"c_interp" | b"d_interp" | b"lod" | b"shadow_obj" | b"trace_obj" | b"ctech"
            | b"stech" | b"usemap" | b"maplib" => return Ok(()),
            _ => Note::Unknown(shown(key)),
        };
        self.note(note, line);
        Ok(())
    }

    fn note(&mut self, note: Note, line: usize) {
        if let Some(known) = self.notes.iter_mut().find(|n| n.note == note) {
            known.count += 1;
        } else if self.notes.len() < MOST_NOTES {
            self.notes.push(Noted { note, line, count: 1 });
        }
    }

    /// Of states of one kind without a face between them, the last counts.
    fn state(&mut self, state: State) -> Result<(), String> {
        let face = self.face_ends.len() as u32;
        let same_place = self.states.iter_mut().rev().take_while(|(at, _)| *at == face);
        let same_kind = |known: &State| discriminant(known) == discriminant(&state);
        match same_place.map(|(_, known)| known).find(|known| same_kind(known)) {
            Some(known) => *known = state,
            None => self.states.push((face, state)),
        }
        Ok(())
    }

    fn smoothing(&mut self, rest: &[u8]) -> Result<(), String> {
        let word = Words(rest).next().unwrap_or(b"0");
        let group = match word {
            b"off" => 0,
            b"on" => 1,
            _ => {
                let value = std::str::from_utf8(word).ok().and_then(|w| w.parse::<i64>().ok());
                let value = value.ok_or_else(|| format!("{} is no smoothing group", shown(word)))?;
                value.clamp(0, u32::MAX.into()) as u32
            }
        };
        self.state(State::Smoothing(group))
    }

    /// `v x y z [w]`, or `v x y z r g b` as many programs write colours. The weight w matters to free-form geometry only.
    #[inline]
    fn position(&mut self, rest: &[u8]) -> Result<(), String> {
        let (v, count) = numbers::<7>(rest, 3)?;
        let position = Vec3::new(v[0], v[1], v[2]);
        if !position.is_finite() {
            return Err(format!("{position} is no position"));
        }
        if count >= 6 {
            self.colors.resize(self.positions.len(), NO_COLOR);
            self.colors.push(Vec3::new(v[3], v[4], v[5]));
        } else if !self.colors.is_empty() {
            self.colors.push(NO_COLOR);
        }
        self.positions.push(position);
        Ok(())
    }

    #[inline]
    fn face(&mut self, rest: &[u8], line: usize) -> Result<(), String> {
        let begin = self.corners.len();
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        for word in Words(rest) {
            self.corners.push(corner(word, counts)?);
            if self.corners.len() - begin > MOST_CORNERS {
                return Err(format!("a face of more than {MOST_CORNERS} corners"));
            }
        }
        if self.corners.len() - begin < 3 {
            self.corners.truncate(begin);
            self.note(Note::SmallFace, line);
            return Ok(());
        }
        self.face_ends.push(self.corners.len() as u32);
        Ok(())
    }
}

/// Up to N numbers of a line and how many there are, at least `least`; those that are missing are 0.
#[inline]
fn numbers<const N: usize>(rest: &[u8], least: usize) -> Result<([f32; N], usize), String> {
    let mut out = [0.0; N];
    let mut count = 0;
    for (value, word) in out.iter_mut().zip(Words(rest)) {
        *value = number(word)?;
        count += 1;
    }
    if count < least {
        return Err(format!("has {count} numbers where {least} are needed"));
    }
    Ok((out, count))
}

/// `v`, `v/vt`, `v//vn` or `v/vt/vn`. An index of 0 for the last two is taken as none.
#[inline]
fn corner(word: &[u8], counts: [usize; 3]) -> Result<RawCorner, String> {
    let wrong = || format!("{} is no corner of a face", shown(word));
    let mut out = [RawIndex::NONE; 3];
    let mut at = 0;
    for (i, (slot, here)) in out.iter_mut().zip(counts).enumerate() {
        let (value, end) = integer(word, at).ok_or_else(wrong)?;
        let Some(index) = value.filter(|&v| v != 0) else {
            if i == 0 {
                let why = if value.is_some() { ": vertices are counted from 1" } else { "" };
                return Err(wrong() + why);
            }
            if end == word.len() {
                return Ok(out);
            }
            at = next_field(word, end).ok_or_else(wrong)?;
            continue;
        };
        let kind = ["vertex", "texture coordinate", "normal"][i];
        *slot = RawIndex::new(index, here)
            .ok_or_else(|| format!("refers to {kind} {index}, which no file has"))?;
        if end == word.len() {
            return Ok(out);
        }
        at = next_field(word, end).ok_or_else(wrong)?;
    }
    Err(wrong())
}

/// The place after the slash at `at`.
#[inline]
fn next_field(word: &[u8], at: usize) -> Option<usize> {
    (word.get(at) == Some(&b'/')).then_some(at + 1)
}

/// An integer that begins at `at`, or `None` where a field is empty; and the place after it. `None`: neither.
#[inline]
fn integer(word: &[u8], at: usize) -> Option<(Option<i64>, usize)> {
    let negative = word.get(at) == Some(&b'-');
    let mut end = at + usize::from(negative);
    let begin = end;
    let mut value = 0i64;
    while let Some(digit) = word.get(end).map(|b| b.wrapping_sub(b'0')).filter(|&d| d < 10) {
        // Too large for any file; larger than what is kept, and no overflow.
        value = (value * 10 + i64::from(digit)).min(i64::MAX / 16);
        end += 1;
    }
    match (end > begin, negative) {
        (true, _) => Some((Some(if negative { -value } else { value }), end)),
        (false, false) => Some((None, end)),
        (false, true) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn resolved(text: &str, base: u32, count: u32) -> Vec<[Result<Option<u32>, ()>; 3]> {
        let chunk = Chunk::read(text.as_bytes());
        assert_eq!(chunk.error, None);
        chunk.corners.iter().map(|c| c.map(|i| i.resolve(base, count))).collect()
    }

    #[test]
    fn all_forms_of_a_corner() {
        let (some, none) = (|i| Ok(Some(i)), Ok(None));
        assert_eq!(
            resolved("f 1 2/3 4//5 6/7/8 9/ 9/1/ 9/0/0", 0, 100),
            [
                [some(0), none, none],
                [some(1), some(2), none],
                [some(3), none, some(4)],
                [some(5), some(6), some(7)],
                [some(8), none, none],
                [some(8), some(0), none],
                [some(8), none, none],
            ]
        );
        for wrong in [
            "f 0 1 2",
            "f 1 2 x",
            "f 1 2 3/4/5/6",
            "f 1 2 -",
            "f 1 2 3\\4",
            "f /1 2 3",
            "f 1 2 3/x",
            "f 1 2 1.5",
        ] {
            assert!(Chunk::read(wrong.as_bytes()).error.is_some(), "{wrong}");
        }
    }

    #[test]
    fn negative_indices_count_back_from_where_they_stand() {
        let text = "v 0 0 0\nv 0 0 0\nf -1 -2 -3\nv 0 0 0\nf -1 -1 -1";
        let first: Vec<_> = resolved(text, 10, 13).into_iter().map(|c| c[0]).collect();
        assert_eq!(
            first,
            [Ok(Some(11)), Ok(Some(10)), Ok(Some(9)), Ok(Some(12)), Ok(Some(12)), Ok(Some(12))]
        );
        // Before the first vertex of the file, and beyond the last.
        let first: Vec<_> = resolved("f -1 -2 3", 1, 2).into_iter().map(|c| c[0]).collect();
        assert_eq!(first, [Ok(Some(0)), Err(()), Err(())]);
        for wrong in ["f 1 2 99999999999999999999999", "f 1 2 -99999999999999999999999", "f 1 2 1073741825"] {
            assert!(Chunk::read(wrong.as_bytes()).error.is_some(), "{wrong}");
        }
    }

    #[test]
    fn lines_are_counted() {
        let text = b"v 0 0 0\nv 1 0 \\\n 0\r\nf 1 2\n\nf 1 1 2 2\nf 1 2 1 # last\nv x 0 0\n";
        let chunk = Chunk::read(text);
        assert_eq!(chunk.positions.len(), 2);
        assert_eq!(chunk.face_ends, [4, 7]);
        assert_eq!(chunk.notes, [Noted { note: Note::SmallFace, line: 4, count: 1 }]);
        assert_eq!(chunk.error, Some((8, "\"x\" is no number".into())));
        assert_eq!([0, 1].map(|f| Chunk::line_of_face(text, f)), [6, 7]);
    }

    #[test]
    fn states_without_faces_between_them_do_not_pile_up() {
        let chunk = Chunk::read(b"g a\ns 1\nusemtl m\ng b\nusemtl n\nf 1 1 1\ng c\ng\nusemtl n\n");
        let state = |at, state| (at, state);
        let text = |t: &str| t.to_string();
        assert_eq!(
            chunk.states,
            [
                state(0, State::Group(text("b"))),
                state(0, State::Smoothing(1)),
                state(0, State::Material(text("n"))),
                state(1, State::Group(text(""))),
                state(1, State::Material(text("n"))),
            ]
        );
    }

    #[test]
    fn a_face_has_an_end() {
        let line = format!("f{}", " 1".repeat(MOST_CORNERS + 1));
        let chunk = Chunk::read(line.as_bytes());
        assert_eq!(chunk.error, Some((1, "a face of more than 1048576 corners".into())));
    }

    #[test]
    fn colours_stand_behind_positions() {
        let chunk = Chunk::read(b"v 1 2 3\nv 1 2 3 0.5\nv 1 2 3 0.1 0.2 0.3\nv 4 5 6");
        assert_eq!(chunk.colors.len(), 4);
        assert_eq!(chunk.colors[2], Vec3::new(0.1, 0.2, 0.3));
        assert!([0, 1, 3].iter().all(|&i| chunk.colors[i].is_nan()));
        assert!(Chunk::read(b"v 1 2 3").colors.is_empty());
        assert_eq!(Chunk::read(b"v 1 nan 3").error, Some((1, "[1, NaN, 3] is no position".into())));
    }
}
