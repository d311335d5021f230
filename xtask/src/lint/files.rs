//! Rules on whole files: how long, and how they begin.

use super::{Finding, source::Source};

/// Lines a file may have, tests included.
const MAX_LINES: usize = 600;

/// Generated tables, which nobody reads.
const GENERATED: &[&str] = &[];

/// Files are short.
pub(super) fn length(source: &Source) -> Vec<Finding> {
    let lines = source.text.lines().count();
    if lines <= MAX_LINES || GENERATED.contains(&source.path.as_str()) {
        return Vec::new();
    }
    vec![source.finding(0, format!("{lines} lines, at most {MAX_LINES}: split it"))]
}

/// Files begin with `//!`: what they do and their source.
pub(super) fn head(source: &Source) -> Vec<Finding> {
    if source.text.starts_with("//! ") {
        return Vec::new();
    }
    vec![source.finding(1, "begin with `//!`: what this file does")]
}

#[cfg(test)]
mod tests {
    use super::super::source::source;
    use super::*;

    #[test]
    fn a_long_file_is_found() {
        let text = |lines| "// a line\n".repeat(lines);
        assert!(length(&source("crates/core/src/a.rs", &text(600))).is_empty());
        assert_eq!(length(&source("crates/core/src/a.rs", &text(601))).len(), 1);
        assert_eq!(length(&source("crates/core/tests/a.rs", &text(601))).len(), 1);
    }

    #[test]
    fn a_file_without_a_head_is_found() {
        assert!(head(&source("crates/core/src/a.rs", "//! Sums.\nfn a() {}\n")).is_empty());
        for text in ["fn a() {}\n", "// Sums.\n", "\n//! Sums.\n", "//!\nfn a() {}\n"] {
            assert_eq!(head(&source("crates/core/src/a.rs", text)).len(), 1, "{text}");
        }
    }
}
