//! The header of a PLY: what stands in the body, and how it is written.

use crate::IoError;
use std::path::Path;

/// Elements and properties that a header may name; real files have about ten.
const MOST_NAMES: usize = 1 << 12;

/// How values are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// Types of values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    /// By its name, old or new.
    fn named(name: &str) -> Option<Kind> {
        Some(match name {
            "char" | "int8" => Kind::I8,
            "uchar" | "uint8" => Kind::U8,
            "short" | "int16" => Kind::I16,
            "ushort" | "uint16" => Kind::U16,
            "int" | "int32" => Kind::I32,
            "uint" | "uint32" => Kind::U32,
            "float" | "float32" => Kind::F32,
            "double" | "float64" => Kind::F64,
            _ => return None,
        })
    }

    /// Bytes of a value.
    pub(super) fn size(self) -> usize {
        match self {
            Kind::I8 | Kind::U8 => 1,
            Kind::I16 | Kind::U16 => 2,
            Kind::I32 | Kind::U32 | Kind::F32 => 4,
            Kind::F64 => 8,
        }
    }

    pub(super) fn is_float(self) -> bool {
        matches!(self, Kind::F32 | Kind::F64)
    }
}

/// A value or a list of values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: String,
    /// Type of a list's length; `None`: a single value.
    pub(super) length: Option<Kind>,
    pub(super) kind: Kind,
}

/// Rows of the same properties.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// The fewest bytes that a row can take.
    fn least_row(&self, format: Format) -> u64 {
        let bytes = self.properties.iter().map(|p| match format {
            // A digit and what separates it from the next.
            Format::Ascii => 2,
            _ => p.length.unwrap_or(p.kind).size() as u64,
        });
        bytes.sum::<u64>().max(1)
    }

    /// Where the property with one of these names stands.
    pub(super) fn find(&self, names: &[&str]) -> Option<usize> {
        self.properties.iter().position(|p| names.contains(&p.name.as_str()))
    }
}

/// A whole header.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) format: Format,
    pub(super) elements: Vec<Element>,
    /// Where the body begins.
    pub(super) body: usize,
    /// Lines of the header.
    pub(super) lines: usize,
}

impl Header {
    /// Reads a header and checks that the body is long enough for what it promises.
    pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Header, IoError> {
        let mut reader = Reader { format: None, elements: Vec::new(), names: 0 };
        let (mut at, mut lines) = (0, 0);
        loop {
            let rest = &bytes[at..];
            let end = rest.iter().position(|&b| b == b'\n' || b == b'\r');
            lines += 1;
            let error = |why: String| IoError::data(path, format!("line {lines}"), why);
            let end = end.ok_or_else(|| error("the header does not end".into()))?;
            let line = &rest[..end];
            at += end + 1 + usize::from(rest[end..].starts_with(b"\r\n"));
            let line = std::str::from_utf8(line).map_err(|_| error("the header is not UTF-8".into()))?;
            if lines == 1 {
                if line.trim() != "ply" {
                    return Err(error("not a PLY: it does not begin with `ply`".into()));
                }
            } else if reader.line(line).map_err(error)? {
                break;
            }
        }
        let format = reader.format.ok_or_else(|| IoError::data(path, "", "the header names no format"))?;
        let header = Header { format, elements: reader.elements, body: at, lines };
        header.check_size(path, (bytes.len() - at) as u64)?;
        Ok(header)
    }

    fn check_size(&self, path: &Path, have: u64) -> Result<(), IoError> {
        let row = |e: &Element| e.count.saturating_mul(e.least_row(self.format));
        let want = self.elements.iter().map(row).fold(0, u64::saturating_add);
        // The last value of a text needs nothing after it.
        if want > have.saturating_add(1) {
            let why = format!("the header promises at least {want} bytes, but {have} follow");
            return Err(IoError::data(path, "", why));
        }
        Ok(())
    }
}

/// A header in the making.
struct Reader {
    format: Option<Format>,
    elements: Vec<Element>,
    names: usize,
}

impl Reader {
    /// Takes in a line; true at the end of the header.
    fn line(&mut self, line: &str) -> Result<bool, String> {
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        let wrong = || format!("{:?} is no line of a PLY header", line.chars().take(60).collect::<String>());
        match words[..] {
            [] | ["comment" | "obj_info", ..] => {}
            ["end_header"] => return Ok(true),
            ["format", format, "1.0"] => {
                self.format = Some(match format {
                    "ascii" => Format::Ascii,
                    "binary_little_endian" => Format::LittleEndian,
                    "binary_big_endian" => Format::BigEndian,
                    _ => return Err(wrong()),
                });
            }
            ["element", name, count] => {
                let count = count.parse().map_err(|_| wrong())?;
                self.elements.push(Element { name: name.into(), count, properties: Vec::new() });
                self.count_name()?;
            }
            ["property", "list", length, kind, name] => {
                let length = Kind::named(length).filter(|k| !k.is_float()).ok_or_else(wrong)?;
                self.property(name, Some(length), Kind::named(kind).ok_or_else(wrong)?)?;
            }
            ["property", kind, name] => self.property(name, None, Kind::named(kind).ok_or_else(wrong)?)?,
            _ => return Err(wrong()),
        }
        Ok(false)
    }

    fn property(&mut self, name: &str, length: Option<Kind>, kind: Kind) -> Result<(), String> {
        let element = self.elements.last_mut().ok_or("a property stands before any element")?;
        element.properties.push(Property { name: name.into(), length, kind });
        self.count_name()
    }

    fn count_name(&mut self) -> Result<(), String> {
        self.names += 1;
        if self.names > MOST_NAMES { Err("the header names too much".into()) } else { Ok(()) }
    }
}
