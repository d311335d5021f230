//! The parsed JSON with its file's name, for messages.

use super::prescan;
use crate::warnings::Warnings;
use crate::{Bound, IoError, Limits};
use gltf::json::{self, Root};
use std::fmt::Display;
use std::path::Path;

/// A glTF's JSON.
pub(super) struct Document<'a> {
    pub(super) path: &'a Path,
    pub(super) limits: &'a Limits,
    pub(super) root: Root,
}

impl<'a> Document<'a> {
    /// Parses the text. Only its form is checked; every index is checked where it is used.
    pub(super) fn parse(path: &'a Path, text: &[u8], limits: &'a Limits) -> Result<Self, IoError> {
        limits.hold(Bound::JsonBytes, path, "", text.len() as u64)?;
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        prescan::check(path, text, limits)?;
        let root: Root = json::deserialize::from_slice(text).map_err(|e| IoError::data(path, "JSON", e))?;
        let doc = Document { path, limits, root };
        let version = &doc.root.asset.version;
        if !version.starts_with("2.") {
            return Err(doc.unsupported("/asset/version", format!("glTF version {version:?}")));
        }
        Ok(doc)
    }

    /// An error at a place in the JSON.
    pub(super) fn error(&self, place: impl Display, reason: impl Display) -> IoError {
        IoError::data(self.path, place, reason)
    }

    /// A refusal of what is not supported.
    pub(super) fn unsupported(&self, place: impl Display, feature: impl Display) -> IoError {
        IoError::unsupported(self.path, place, feature)
    }

    /// The element of a list that `place` refers to.
    pub(super) fn item<'l, T>(
        &self,
        list: &'l [T],
        index: usize,
        what: &str,
        place: &dyn Fn() -> String,
    ) -> Result<&'l T, IoError> {
        list.get(index).ok_or_else(|| {
            self.error(place(), format!("refers to {what} {index}, but there are {}", list.len()))
        })
    }

    /// Warns of what moves: only the rest pose is read.
    pub(super) fn warn_of_motion(&self, warnings: &mut Warnings) {
        let root = &self.root;
        for (count, what) in [(root.animations.len(), "animations"), (root.skins.len(), "skins")] {
            if count > 0 {
                warnings.add(format!("/{what}"), format!("{what} are not supported; the rest pose is shown"));
            }
        }
    }
}
