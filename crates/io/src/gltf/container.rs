//! The binary container of glTF: a header and chunks (glTF 2.0, 4.4).

use crate::IoError;
use crate::warnings::Warnings;
use std::path::Path;

/// The chunks that matter.
pub(super) struct Parts<'a> {
    pub(super) json: &'a [u8],
    pub(super) bin: Option<&'a [u8]>,
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    let word = bytes.get(at..at.checked_add(4)?)?;
    word.try_into().ok().map(u32::from_le_bytes)
}

/// Splits a .glb. Chunks of other kinds are passed over, as the specification asks.
pub(super) fn split<'a>(path: &Path, bytes: &'a [u8], warnings: &mut Warnings) -> Result<Parts<'a>, IoError> {
    let error = |at: usize, why: String| IoError::data(path, format!("byte {at}"), why);
    let short = |at: usize| error(at, "the file ends inside a header".into());
    let version = u32_at(bytes, 4).ok_or_else(|| short(4))?;
    if version != 2 {
        return Err(IoError::unsupported(path, "byte 4", format!("glTF container version {version}")));
    }
    let length = u32_at(bytes, 8).ok_or_else(|| short(8))? as usize;
    if length > bytes.len() {
        let why = format!("the header says {length} bytes, the file has {}", bytes.len());
        return Err(error(8, why));
    }
    if length < bytes.len() {
        warnings.add("", "bytes after the end of the glTF container are ignored");
    }
    let bytes = &bytes[..length];
    let (mut json, mut bin) = (None, None);
    let mut at = 12;
    while at < length {
        let size = u32_at(bytes, at).ok_or_else(|| short(at))? as usize;
        let kind = bytes.get(at + 4..at + 8).ok_or_else(|| short(at + 4))?;
        let start = at + 8;
        let chunk = start.checked_add(size).and_then(|end| bytes.get(start..end)).ok_or_else(|| {
            error(at, format!("a chunk of {size} bytes, but {} are left", length.saturating_sub(start)))
        })?;
        match kind {
            b"JSON" if json.is_none() => json = Some(chunk),
            b"BIN\0" if bin.is_none() => bin = Some(chunk),
            _ => {}
        }
        // Chunks begin at multiples of four.
        at = start + size.next_multiple_of(4);
    }
    let json = json.ok_or_else(|| error(12, "there is no JSON chunk".into()))?;
    Ok(Parts { json, bin })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glb(chunks: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
        let mut body = Vec::new();
        for (kind, data) in chunks {
            body.extend((data.len() as u32).to_le_bytes());
            body.extend(*kind);
            body.extend(*data);
        }
        let mut out = b"glTF\x02\0\0\0".to_vec();
        out.extend((body.len() as u32 + 12).to_le_bytes());
        out.extend(body);
        out
    }

    #[test]
    fn finds_its_chunks_and_passes_over_others() {
        let path = Path::new("a.glb");
        let mut w = Warnings::default();
        let bytes = glb(&[(b"JSON", b"{}  "), (b"XTRA", b"1234"), (b"BIN\0", b"abcd")]);
        let parts = split(path, &bytes, &mut w).unwrap();
        assert_eq!((parts.json, parts.bin), (&b"{}  "[..], Some(&b"abcd"[..])));
    }

    #[test]
    fn every_truncation_is_an_error() {
        let path = Path::new("a.glb");
        let bytes = glb(&[(b"JSON", b"{}  "), (b"BIN\0", b"abcd")]);
        for n in 0..bytes.len() {
            assert!(split(path, &bytes[..n], &mut Warnings::default()).is_err(), "{n}");
        }
        let mut long = bytes.clone();
        long[12..16].copy_from_slice(&u32::MAX.to_le_bytes());
        let e = split(path, &long, &mut Warnings::default()).err().unwrap();
        assert_eq!(e.to_string(), "a.glb: byte 12: a chunk of 4294967295 bytes, but 16 are left");
    }
}
