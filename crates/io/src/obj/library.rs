//! The material libraries that an OBJ names.

use super::mtl::{self, Mtl};
use crate::files::read_file;
use crate::resolver::Resolver;
use crate::warnings::Warnings;
use crate::{Bound, Limits};
use std::collections::{HashMap, HashSet};
use std::path::PathBuf;

/// Libraries of one file; every name costs a look at the disk.
const MOST_LIBRARIES: usize = 1 << 10;

/// A material and the file that has it.
#[derive(Clone)]
pub(super) struct Entry {
    pub(super) mtl: Mtl,
    /// Index into [`Libraries::files`].
    pub(super) file: usize,
}

/// A library that was read.
pub(super) struct File {
    /// For messages: its name.
    pub(super) name: String,
    /// The folder it lies in, without links.
    pub(super) folder: PathBuf,
}

/// All materials of all libraries.
#[derive(Default)]
pub(super) struct Libraries {
    pub(super) files: Vec<File>,
    pub(super) entries: Vec<Entry>,
    /// Where the first material of each name stands.
    by_name: HashMap<String, usize>,
}

impl Libraries {
    /// Reads the libraries of these `mtllib` statements. One that cannot be read is a warning.
    pub(super) fn load(
        resolver: &Resolver,
        statements: &[(usize, String)],
        limits: &Limits,
        warnings: &mut Warnings,
    ) -> Self {
        let mut out = Libraries::default();
        let mut seen = HashSet::new();
        let mut room = limits.room(Bound::FileBytes);
        // Looking for files costs time: each statement counts once, and no more of them than libraries.
        let mut known = HashSet::new();
        let new = statements.iter().filter(|(_, rest)| known.insert(rest.as_str())).take(MOST_LIBRARIES + 1);
        for (line, name) in new.flat_map(|(line, rest)| {
            names(rest, |whole| resolver.find_name(whole, None).is_ok_and(|f| f.note.is_none()))
                .into_iter()
                .map(move |name| (line, name))
        }) {
            if !seen.insert(name.clone()) {
                continue;
            }
            let place = format!("line {line}");
            if seen.len() > MOST_LIBRARIES {
                warnings.add(
                    place,
                    format!("more than {MOST_LIBRARIES} material libraries; the others are not read"),
                );
                break;
            }
            let found = match resolver.find_name(&name, None) {
                Ok(found) => found,
                Err(why) => {
                    warnings.add(place, format!("mtllib {why}; its materials are grey"));
                    continue;
                }
            };
            // What a name of another system led to is called by its last part.
            let mut called = name;
            if let Some(note) = &found.note {
                warnings.add(&place, format!("mtllib {note}"));
                called = found.real.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
            }
            let read = read_file(&found.real, room)
                .and_then(|b| room.take(&found.shown, "", b.len() as u64).map(|()| b));
            match read {
                Ok(text) => out.add(&text, called, found.real, warnings),
                Err(e) => warnings.add(place, format!("mtllib {e}; its materials are grey")),
            }
        }
        out
    }

    fn add(&mut self, text: &[u8], name: String, real: PathBuf, warnings: &mut Warnings) {
        let file = self.files.len();
        let list = mtl::parse(text, |line, why| warnings.add(format!("{name}: line {line}"), why));
        for mtl in list {
            self.by_name.entry(mtl.name.clone()).or_insert(self.entries.len());
            self.entries.push(Entry { mtl, file });
        }
        let folder = real.parent().map(PathBuf::from).unwrap_or_default();
        self.files.push(File { name, folder });
    }

    /// The first material of that name.
    pub(super) fn get(&self, name: &str) -> Option<&Entry> {
        self.by_name.get(name).map(|&at| &self.entries[at])
    }
}

/// The names of one `mtllib` statement. They are separated by blanks, but blanks are found in names too: the statement is one name
/// if there `exists` such a file, or if it does not end in several of `.mtl`.
fn names(rest: &str, exists: impl Fn(&str) -> bool) -> Vec<String> {
    let whole = rest.strip_prefix('"').and_then(|r| r.strip_suffix('"')).unwrap_or(rest);
    let is_end =
        |word: &str| word.len() >= 4 && word.as_bytes()[word.len() - 4..].eq_ignore_ascii_case(b".mtl");
    if whole.split_whitespace().filter(|w| is_end(w)).count() < 2 || exists(whole) {
        return vec![whole.to_string()];
    }
    let mut out = vec![String::new()];
    for word in whole.split(' ') {
        let last = out.last_mut().filter(|l| !is_end(l));
        match last {
            Some(last) if last.is_empty() => *last = word.into(),
            Some(last) => {
                last.push(' ');
                last.push_str(word);
            }
            None if word.is_empty() => {}
            None => out.push(word.into()),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_name_one_library_or_several() {
        let none = |_: &str| false;
        assert_eq!(names("a.mtl", none), ["a.mtl"]);
        assert_eq!(names("my room.mtl", none), ["my room.mtl"]);
        assert_eq!(names("\"my room.mtl\"", none), ["my room.mtl"]);
        assert_eq!(names("a.mtl  my room.MTL c.mtl", none), ["a.mtl", "my room.MTL", "c.mtl"]);
        assert_eq!(names("a.mtl b.mtl", |n| n == "a.mtl b.mtl"), ["a.mtl b.mtl"]);
        assert_eq!(names("materials", none), ["materials"]);
    }
}
