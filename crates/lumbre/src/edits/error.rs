//! What can be wrong with edits.

use lumbre_io::{IoError, one_line};
use std::fmt;
use std::path::Path;

/// Edits that cannot be read, or that do not fit a scene. `Display` is one line: line, place, reason.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct EditsError {
    /// Where in the document, as a JSON pointer (Bryan et al. 2013, RFC 6901); may be empty.
    pub place: String,
    /// The line of the text, from 1, where there is one.
    pub line: Option<u32>,
    /// The reason.
    pub reason: String,
}

impl fmt::Display for EditsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let where_ = self.position();
        let gap = if where_.is_empty() { "" } else { ": " };
        write!(f, "{where_}{gap}{}", one_line(&self.reason))
    }
}

impl EditsError {
    /// About what stands under a key.
    pub(super) fn new(key: &str, reason: impl fmt::Display) -> Self {
        EditsError { place: under("", key), line: None, reason: reason.to_string() }
    }

    /// The same, seen from further up.
    pub(super) fn under(self, place: &str) -> Self {
        EditsError { place: format!("{place}{}", self.place), ..self }
    }

    pub(super) fn at_line(self, line: u32) -> Self {
        EditsError { line: self.line.or(Some(line)), ..self }
    }

    fn position(&self) -> String {
        let line = self.line.map(|line| format!("line {line}"));
        let place = (!self.place.is_empty()).then(|| one_line(&self.place));
        line.into_iter().chain(place).collect::<Vec<_>>().join(": ")
    }

    /// The same about a file.
    pub fn in_file(&self, path: &Path) -> IoError {
        IoError::Data { path: path.into(), place: self.position(), reason: one_line(&self.reason) }
    }
}

/// A JSON pointer to a member of what another one points to.
pub(super) fn under(place: &str, key: &str) -> String {
    format!("{place}/{}", key.replace('~', "~0").replace('/', "~1"))
}
