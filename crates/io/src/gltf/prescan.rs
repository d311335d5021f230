//! A look over JSON text before it is parsed: how deep it nests and how many objects it holds. Parsing makes of the three
//! bytes `{},` a record of some hundred, so that a small file could fill the memory.

use crate::{Bound, IoError, Limits};
use std::path::Path;

/// Checks nesting and the number of objects. Text that is no JSON passes: the parser says what is wrong with it.
pub(super) fn check(path: &Path, text: &[u8], limits: &Limits) -> Result<(), IoError> {
    let (mut depth, mut deepest, mut objects) = (0u64, 0u64, 0u64);
    let mut bytes = text.iter();
    while let Some(&byte) = bytes.next() {
        match byte {
            b'"' => skip_string(&mut bytes),
            b'{' | b'[' => {
                objects += u64::from(byte == b'{');
                depth += 1;
                deepest = deepest.max(depth);
            }
            b'}' | b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    limits.hold(Bound::JsonDepth, path, "JSON", deepest)?;
    limits.hold(Bound::JsonObjects, path, "JSON", objects)
}

/// Moves past the closing quote.
fn skip_string(bytes: &mut std::slice::Iter<'_, u8>) {
    while let Some(&byte) = bytes.next() {
        match byte {
            b'"' => return,
            b'\\' => drop(bytes.next()),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(text: &str, max_json_depth: u64, max_json_objects: u64) -> String {
        let limits = Limits { max_json_depth, max_json_objects, ..Limits::default() };
        let checked = check(Path::new("a.gltf"), text.as_bytes(), &limits);
        checked.map_or_else(|e| e.to_string(), |()| String::new())
    }

    #[test]
    fn depth_and_objects_are_counted_outside_of_strings() {
        let text = r#"{"a[{\"{[": [{}, {"b": "\\"}, [[]]], "c": "{{{{"}"#;
        assert_eq!(said(text, 4, 3), "");
        assert_eq!(said(text, 3, 3), "a.gltf: JSON: depth of the JSON 4 exceeds the limit of 3");
        assert_eq!(said(text, 4, 2), "a.gltf: JSON: number of JSON objects 3 exceeds the limit of 2");
    }

    #[test]
    fn broken_text_ends() {
        for text in ["", "\"", "\"\\", "]]]]}}{", "{\"a\\\""] {
            assert_eq!(said(text, 1, 1), "", "{text}");
        }
    }
}
