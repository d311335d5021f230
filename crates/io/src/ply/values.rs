//! The values of a PLY's body, written as text or in binary.

use super::header::{Format, Kind};

/// Takes values off the body one by one.
pub(super) struct Values<'a> {
    rest: &'a [u8],
    format: Format,
    /// Lines of text taken so far.
    pub(super) line: usize,
}

const ENDS: &str = "the file ends within it";

impl<'a> Values<'a> {
    /// `line` is the number of lines before `body`.
    pub(super) fn new(body: &'a [u8], format: Format, line: usize) -> Self {
        Values { rest: body, format, line: line + 1 }
    }

    /// Whether values are written as text.
    pub(super) fn is_text(&self) -> bool {
        self.format == Format::Ascii
    }

    /// Bytes that are left.
    pub(super) fn left(&self) -> usize {
        self.rest.len()
    }

    /// The next word of a text.
    fn word(&mut self) -> Result<&'a [u8], String> {
        let begin = self.rest.iter().position(|b| !b.is_ascii_whitespace()).ok_or(ENDS)?;
        self.line += self.rest[..begin].iter().filter(|&&b| b == b'\n').count();
        let rest = &self.rest[begin..];
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let (word, rest) = rest.split_at(end);
        self.rest = rest;
        Ok(word)
    }

    fn parsed<T: std::str::FromStr>(&mut self) -> Result<T, String> {
        let word = self.word()?;
        let value = std::str::from_utf8(word).ok().and_then(|w| w.parse().ok());
        value.ok_or_else(|| {
            let shown: String = String::from_utf8_lossy(word).chars().take(40).collect();
            format!("{shown:?} is no such number")
        })
    }

    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let (head, rest) = self.rest.split_first_chunk::<N>().ok_or(ENDS)?;
        self.rest = rest;
        let mut bytes = *head;
        if self.format == Format::BigEndian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// A value as f32.
    #[inline]
    pub(super) fn float(&mut self, kind: Kind) -> Result<f32, String> {
        if self.is_text() {
            return self.parsed();
        }
        match kind {
            Kind::F32 => Ok(f32::from_le_bytes(self.bytes()?)),
            Kind::F64 => Ok(f64::from_le_bytes(self.bytes()?) as f32),
            _ => Ok(self.integer(kind)? as f32),
        }
    }

    /// A value as an integer; fractions are cut off.
    #[inline]
    pub(super) fn integer(&mut self, kind: Kind) -> Result<i64, String> {
        if self.is_text() {
            return if kind.is_float() { Ok(self.parsed::<f64>()? as i64) } else { self.parsed() };
        }
        Ok(match kind {
            Kind::I8 => i8::from_le_bytes(self.bytes()?).into(),
            Kind::U8 => u8::from_le_bytes(self.bytes()?).into(),
            Kind::I16 => i16::from_le_bytes(self.bytes()?).into(),
            Kind::U16 => u16::from_le_bytes(self.bytes()?).into(),
            Kind::I32 => i32::from_le_bytes(self.bytes()?).into(),
            Kind::U32 => u32::from_le_bytes(self.bytes()?).into(),
            Kind::F32 => f32::from_le_bytes(self.bytes()?) as i64,
            Kind::F64 => f64::from_le_bytes(self.bytes()?) as i64,
        })
    }

    /// The length of a list, which the rest of the file must be able to hold.
    pub(super) fn length(&mut self, length: Kind, kind: Kind) -> Result<usize, String> {
        let count = self.integer(length)?;
        let each = if self.is_text() { 1 } else { kind.size() };
        let fits =
            usize::try_from(count).ok().filter(|c| c.checked_mul(each).is_some_and(|b| b <= self.left()));
        fits.ok_or_else(|| format!("a list of {count} values cannot be held by the rest of the file"))
    }

    /// Passes over values.
    pub(super) fn skip(&mut self, kind: Kind, count: usize) -> Result<(), String> {
        if self.is_text() {
            return (0..count).try_for_each(|_| self.word().map(drop));
        }
        let bytes = kind.size().checked_mul(count).filter(|&b| b <= self.left()).ok_or(ENDS)?;
        self.rest = &self.rest[bytes..];
        Ok(())
    }
}
