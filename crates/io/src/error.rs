//! What can go wrong with a file: always its path, the place inside it where there is one, and the reason.

use crate::Bound;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Classes of failure, for exit codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ErrorKind {
    /// The file is there, and what it holds is wrong, not supported, or beyond a limit.
    BadData,
    /// The file, or one that it names, cannot be opened or read.
    CannotOpen,
    /// The caller asked for a part of the file that it does not have.
    BadChoice,
    /// The output cannot be written.
    CannotWrite,
}

/// A failed read or write. `Display` is one line: path, place, reason.
#[derive(Debug, thiserror::Error)]
pub enum IoError {
    /// A file cannot be opened or read.
    #[error("{}: {}{reason}", show(path), prefix(place))]
    Open {
        /// The file that was asked for; for a file named inside another one, that other one.
        path: PathBuf,
        /// Where in `path` the missing file is named; empty if it is `path` itself.
        place: String,
        /// The reason.
        reason: String,
    },
    /// What a file holds is wrong.
    #[error("{}: {}{reason}", show(path), prefix(place))]
    Data {
        /// The file.
        path: PathBuf,
        /// Where in it (a JSON pointer, a line); may be empty.
        place: String,
        /// The reason.
        reason: String,
    },
    /// What a file asks for is not supported.
    #[error("{}: {}not supported: {feature}", show(path), prefix(place))]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// Where in it; may be empty.
        place: String,
        /// What is missing, by name.
        feature: String,
    },
    /// A limit of [`Limits`](crate::Limits) is exceeded.
    #[error("{}: {}{} {value} exceeds the limit of {limit}", show(path), prefix(place), bound.what())]
    Limit {
        /// The file.
        path: PathBuf,
        /// Where in it; may be empty.
        place: String,
        /// Which limit.
        bound: Bound,
        /// Its value.
        value: u64,
        /// The limit.
        limit: u64,
    },
    /// The file has no part of this name or number.
    #[error("{}: no {what} {wanted}; {}", show(path), list(available))]
    NotThere {
        /// The file.
        path: PathBuf,
        /// What kind of part.
        what: &'static str,
        /// The name or number that was asked for.
        wanted: String,
        /// Names of what there is.
        available: Vec<String>,
    },
    /// A file cannot be written; an older file of that name is unchanged.
    #[error("{}: cannot write: {reason}", show(path))]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
}

impl IoError {
    /// Its class.
    pub fn kind(&self) -> ErrorKind {
        match self {
            IoError::Open { .. } => ErrorKind::CannotOpen,
            IoError::Data { .. } | IoError::Unsupported { .. } | IoError::Limit { .. } => ErrorKind::BadData,
            IoError::NotThere { .. } => ErrorKind::BadChoice,
            IoError::Write { .. } => ErrorKind::CannotWrite,
        }
    }

    /// The file it is about.
    pub fn path(&self) -> &Path {
        match self {
            IoError::Open { path, .. }
            | IoError::Data { path, .. }
            | IoError::Unsupported { path, .. }
            | IoError::Limit { path, .. }
            | IoError::NotThere { path, .. }
            | IoError::Write { path, .. } => path,
        }
    }

    /// The limit that was exceeded, if that is what it is about.
    pub fn bound(&self) -> Option<Bound> {
        match self {
            IoError::Limit { bound, .. } => Some(*bound),
            _ => None,
        }
    }

    pub(crate) fn open(path: &Path, error: &io::Error) -> Self {
        IoError::Open {
            path: path.into(),
            place: String::new(),
            reason: format!("cannot open: {}", reason(error)),
        }
    }

    pub(crate) fn data(path: &Path, place: impl fmt::Display, reason: impl fmt::Display) -> Self {
        IoError::Data { path: path.into(), place: place.to_string(), reason: one_line(&reason.to_string()) }
    }

    pub(crate) fn unsupported(path: &Path, place: impl fmt::Display, feature: impl fmt::Display) -> Self {
        IoError::Unsupported {
            path: path.into(),
            place: place.to_string(),
            feature: one_line(&feature.to_string()),
        }
    }

    pub(crate) fn not_there(path: &Path, what: &'static str, wanted: String, available: &[String]) -> Self {
        IoError::NotThere {
            path: path.into(),
            what,
            wanted: one_line(&wanted),
            available: available.to_vec(),
        }
    }

    /// A file that cannot be written, and why.
    pub fn write(path: &Path, reason: impl fmt::Display) -> Self {
        IoError::Write { path: path.into(), reason: one_line(&reason.to_string()) }
    }

    /// The same error about another file.
    pub(crate) fn at_path(mut self, new: &Path) -> Self {
        match &mut self {
            IoError::Open { path, .. }
            | IoError::Data { path, .. }
            | IoError::Unsupported { path, .. }
            | IoError::Limit { path, .. }
            | IoError::NotThere { path, .. }
            | IoError::Write { path, .. } => *path = new.into(),
        }
        self
    }

    /// The same error at another place.
    pub(crate) fn at_place(mut self, new: &str) -> Self {
        match &mut self {
            IoError::Open { place, .. }
            | IoError::Data { place, .. }
            | IoError::Unsupported { place, .. }
            | IoError::Limit { place, .. } => *place = new.into(),
            IoError::NotThere { .. } | IoError::Write { .. } => {}
        }
        self
    }

    /// The same error, told by the file `path` that names the failing one at `place`.
    pub(crate) fn named_by(self, path: &Path, place: impl fmt::Display) -> Self {
        let (outer, place) = (path.to_path_buf(), place.to_string());
        match self {
            IoError::Open { path, reason, .. } => {
                IoError::Open { path: outer, place, reason: format!("{}: {reason}", show(&path)) }
            }
            IoError::Limit { path, place: inner, bound, value, limit } => {
                let place = format!("{place}: {}: {inner}", show(&path));
                let place = place.trim_end_matches(": ").to_string();
                IoError::Limit { path: outer, place, bound, value, limit }
            }
            other => {
                let reason = other.to_string();
                IoError::Data { path: outer, place, reason }
            }
        }
    }
}

/// What there is, in a line that a file of a million names cannot make endless.
fn list(names: &[String]) -> String {
    const MOST: usize = 30;
    if names.is_empty() {
        return "there are none".into();
    }
    let short = |name: &String| format!("{:?}", name.chars().take(60).collect::<String>());
    let shown: Vec<String> = names.iter().take(MOST).map(short).collect();
    let more = if names.len() > MOST { format!(" and {} more", names.len() - MOST) } else { String::new() };
    format!("there are {}{more}", shown.join(", "))
}

fn prefix(place: &str) -> String {
    if place.is_empty() { String::new() } else { format!("{place}: ") }
}

fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file".into(),
        io::ErrorKind::PermissionDenied => "permission denied".into(),
        _ => one_line(&error.to_string()),
    }
}

/// Text from a file made fit for a line on a terminal: control characters, which could break it or steer the terminal, become
/// escapes.
pub fn one_line(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.trim().chars() {
        if c == '\n' {
            out.push(' ');
        } else if c.is_control() {
            out.extend(c.escape_default());
        } else {
            out.push(c);
        }
    }
    out
}

/// A path fit for a message.
pub(crate) fn show(path: &Path) -> String {
    one_line(&path.to_string_lossy())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_path_place_and_reason() {
        let e = IoError::data(Path::new("scene.gltf"), "/accessors/7", "too short");
        assert_eq!(e.to_string(), "scene.gltf: /accessors/7: too short");
        assert_eq!(e.kind(), ErrorKind::BadData);
        assert_eq!(e.path(), Path::new("scene.gltf"));
        let missing = IoError::open(Path::new("a.png"), &io::ErrorKind::NotFound.into());
        assert_eq!(missing.to_string(), "a.png: cannot open: no such file");
        let inner = missing.named_by(Path::new("s.gltf"), "/images/0/uri");
        assert_eq!(inner.to_string(), "s.gltf: /images/0/uri: a.png: cannot open: no such file");
        assert_eq!(inner.kind(), ErrorKind::CannotOpen);
    }

    #[test]
    fn control_characters_cannot_leave_the_line() {
        let e = IoError::data(Path::new("a\u{1b}[2Jb"), "", "x\ny\u{7}");
        assert_eq!(e.to_string(), "a\\u{1b}[2Jb: x y\\u{7}");
    }
}
