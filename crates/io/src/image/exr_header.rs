//! Puts the attributes of an EXR header in order of their names. The `exr` crate keeps custom ones in a hash map, so that
//! two runs would write the same picture as different bytes; OpenEXR allows any order.

use std::io::{Read, Seek, Write};

/// Magic number and version.
const START: usize = 8;

/// Sorts the header of the one-part file, which stands at its beginning.
pub(super) fn sort_attributes(file: &mut (impl Read + Write + Seek)) -> Result<(), String> {
    let mut bytes = Vec::new();
    let mut want = 4096u64;
    loop {
        (&mut *file).take(want).read_to_end(&mut bytes).map_err(|e| e.to_string())?;
        if let Some(sorted) = sorted(&bytes) {
            file.seek(std::io::SeekFrom::Start(START as u64)).map_err(|e| e.to_string())?;
            return file.write_all(&sorted).map_err(|e| e.to_string());
        }
        if (bytes.len() as u64) < want {
            return Err("the EXR header has no end".into());
        }
        want *= 2;
        bytes.clear();
        file.rewind().map_err(|e| e.to_string())?;
    }
}

/// The attributes in order, if `bytes` hold them all: name, 0, type, 0, size, value; a 0 ends them.
fn sorted(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut attributes: Vec<(&[u8], &[u8])> = Vec::new();
    let mut at = START;
    while *bytes.get(at)? != 0 {
        let zero = |from: usize| Some(from + bytes.get(from..)?.iter().position(|&b| b == 0)?);
        let name_end = zero(at)?;
        let type_end = zero(name_end + 1)?;
        let size: [u8; 4] = bytes.get(type_end + 1..type_end + 5)?.try_into().ok()?;
        let end = (type_end + 5).checked_add(usize::try_from(i32::from_le_bytes(size)).ok()?)?;
        attributes.push((&bytes[at..name_end], bytes.get(at..end)?));
        at = end;
    }
    attributes.sort();
    Some(attributes.into_iter().flat_map(|(_, whole)| whole).copied().collect())
}
