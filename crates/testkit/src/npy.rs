//! Arrays of 32-bit floats in NumPy's `.npy` files: as much of the format as the references of other renderers need.
//! Format: NumPy Enhancement Proposal 1, "A Simple File Format for NumPy Arrays".

use std::path::Path;

/// An array, its last axis running fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Length of each axis.
    pub shape: Vec<usize>,
    /// All values.
    pub values: Vec<f32>,
}

/// Reads a file.
///
/// # Errors
/// One line with the path: it cannot be read, or is no array of little-endian floats in C order.
pub fn read(path: &Path) -> Result<Array, String> {
    let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
    parse(&bytes).ok_or_else(|| format!("{}: not a .npy array of '<f4' in C order", path.display()))
}

fn parse(bytes: &[u8]) -> Option<Array> {
    let rest = bytes.strip_prefix(b"\x93NUMPY")?;
    let (length, rest) = match rest {
        [1, _, a, b, rest @ ..] => (usize::from(u16::from_le_bytes([*a, *b])), rest),
        [2 | 3, _, a, b, c, d, rest @ ..] => (u32::from_le_bytes([*a, *b, *c, *d]) as usize, rest),
        _ => return None,
    };
    let header = std::str::from_utf8(rest.get(..length)?).ok()?;
    let after = |key: &str| Some(header.split_once(key)?.1.trim_start_matches([' ', ':']));
    if !after("'descr'")?.starts_with("'<f4'") || !after("'fortran_order'")?.starts_with("False") {
        return None;
    }
    let (shape, _) = after("'shape'")?.strip_prefix('(')?.split_once(')')?;
    let sizes = shape.split(',').map(str::trim).filter(|s| !s.is_empty());
    let shape: Vec<usize> = sizes.map(|s| s.parse().ok()).collect::<Option<_>>()?;
    let data = &rest[length..];
    let values: Vec<f32> =
        data.chunks_exact(4).map(|c| f32::from_le_bytes([c[0], c[1], c[2], c[3]])).collect();
    (4 * shape.iter().product::<usize>() == data.len()).then_some(Array { shape, values })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(header: &str, values: &[f32]) -> Vec<u8> {
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(values.iter().flat_map(|v| v.to_le_bytes()));
        bytes
    }

    #[test]
    fn arrays_are_read_and_others_refused() {
        let values = [1.0, -2.5, 3e7, 0.0, 5.0, 6.0];
        let header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2, 3), }  \n";
        let array = parse(&file(header, &values)).expect("sound");
        assert_eq!((&array.shape[..], &array.values[..]), (&[1, 2, 3][..], &values[..]));
        let flat = parse(&file(&header.replace("(1, 2, 3)", "(6,)"), &values)).expect("sound");
        assert_eq!(flat.shape, [6]);
        for wrong in ["'<f4'|'<f8'", "False|True", "(1, 2, 3)|(1, 2)", "(1, 2, 3)|(x,)"] {
            let (from, to) = wrong.split_once('|').expect("a pair");
            assert_eq!(parse(&file(&header.replace(from, to), &values)), None, "{wrong}");
        }
        assert_eq!(parse(&file(header, &values)[..50]), None);
        assert_eq!(parse(b"PK"), None);
    }
}
