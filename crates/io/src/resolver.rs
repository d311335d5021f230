//! Names inside a scene to files. Only relative paths beneath the scene's folder, or beneath a folder that the user
//! named, are followed; everything else that a path or a URI could say is refused.
//!
//! glTF writes URIs (RFC 3986), which may also be `data:` (RFC 2397); OBJ and MTL write plain names, in which a percent
//! sign is a percent sign. Where a plain name leads nowhere, its last part is looked for in the same folders: files that
//! were written on another machine name folders that exist only there.

use crate::files::read_file;
use crate::limits::Room;
use crate::{IoError, LoadOptions};
use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use std::borrow::Cow;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Base64 with or without its padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// Follows names from one scene.
pub(crate) struct Resolver<'a> {
    /// The scene file.
    scene: &'a Path,
    /// Its folder, then those of [`LoadOptions::asset_dirs`].
    roots: Vec<Root>,
}

/// A folder beneath which files may be read.
struct Root {
    /// As the user named it.
    named: PathBuf,
    /// Without links.
    real: PathBuf,
}

/// What a URI led to.
pub(crate) struct Resolved {
    /// Its bytes.
    pub(crate) bytes: Vec<u8>,
    /// The file they came from; `None`: they stood in the URI.
    pub(crate) file: Option<PathBuf>,
}

/// A file that a name led to; it may still be too large or unreadable.
#[derive(Debug)]
pub(crate) struct Found {
    /// To be opened: without links, beneath one of the folders.
    pub(crate) real: PathBuf,
    /// The same file for messages.
    pub(crate) shown: PathBuf,
    /// Why it is not the file that the name says, if it is another.
    pub(crate) note: Option<String>,
}

/// Why a file was not found in a folder.
enum Miss {
    /// It is not there, or cannot be reached.
    Absent(io::Error),
    /// It is there through a link to elsewhere.
    Outside,
}

/// Bytes of the longest plain name that is looked for: the longest path of common systems.
const MOST_NAME_BYTES: usize = 4096;

impl<'a> Resolver<'a> {
    /// For the scene at `path`, which exists.
    pub(crate) fn new(path: &'a Path, options: &LoadOptions) -> Result<Self, IoError> {
        let folder = match path.parent() {
            Some(p) if !p.as_os_str().is_empty() => p,
            _ => Path::new("."),
        };
        let root = |folder: &Path, named: PathBuf| {
            let real = fs::canonicalize(folder).map_err(|e| IoError::open(folder, &e))?;
            Ok(Root { named, real })
        };
        let mut roots = vec![root(folder, path.with_file_name(""))?];
        for dir in &options.asset_dirs {
            let root = root(dir, dir.clone())?;
            if !root.real.is_dir() {
                return Err(IoError::open(dir, &io::ErrorKind::NotADirectory.into()));
            }
            roots.push(root);
        }
        Ok(Resolver { scene: path, roots })
    }

    /// Reads what `uri`, found at `place`, names, within `limit`.
    pub(crate) fn read(&self, uri: &str, place: &str, limit: impl Into<Room>) -> Result<Resolved, IoError> {
        let limit = limit.into();
        if let Some(data) = strip_scheme(uri, "data") {
            let bytes = decode_data(data).map_err(|why| IoError::data(self.scene, place, why))?;
            limit.check(self.scene, place, bytes.len() as u64)?;
            return Ok(Resolved { bytes, file: None });
        }
        let refuse = |why: &str| IoError::data(self.scene, place, refused(uri, why));
        let relative = uri_path(uri).map_err(|why| refuse(&why))?;
        let (real, shown) = self.find(&relative).map_err(|miss| match miss {
            Miss::Absent(e) => IoError::open(&relative, &e).named_by(self.scene, place),
            Miss::Outside => refuse(OUTSIDE),
        })?;
        let bytes = read_file(&real, limit).map_err(|e| e.named_by(self.scene, place))?;
        Ok(Resolved { bytes, file: Some(shown) })
    }

    /// Finds the file that a plain `name` means: beneath `beside`, which is a folder that an earlier name led to, beneath the
    /// scene's folder or a named one, and if that fails by its last part alone. The error is a reason, to be told with its place.
    pub(crate) fn find_name(&self, name: &str, beside: Option<&Path>) -> Result<Found, String> {
        if name.len() > MOST_NAME_BYTES {
            return Err(refused(name, "it is longer than names of files are"));
        }
        let why = match relative_path(name) {
            Ok(relative) => {
                if let Some(found) = beside.and_then(|folder| self.find_beside(folder, &relative)) {
                    return Ok(found);
                }
                match self.find(&relative) {
                    Ok((real, shown)) => return Ok(Found { real, shown, note: None }),
                    Err(Miss::Outside) => refused(name, OUTSIDE),
                    Err(Miss::Absent(e)) => IoError::open(&relative, &e).to_string(),
                }
            }
            Err(why) => refused(name, &why),
        };
        let Some(last) = last_part(name) else { return Err(why) };
        let found = beside.and_then(|folder| self.find_beside(folder, &last));
        let found = found.or_else(|| {
            let (real, shown) = self.find(&last).ok()?;
            Some(Found { real, shown, note: None })
        });
        match found {
            Some(f) => {
                let note = format!("{why}; {} is taken instead", f.shown.display());
                Ok(Found { note: Some(note), ..f })
            }
            // A plain name was its own last part.
            None if last.as_os_str() == name => Err(why),
            None => Err(format!("{why}, nor is there a {}", last.display())),
        }
    }

    /// Looks for a file in the folders, in their order.
    fn find(&self, relative: &Path) -> Result<(PathBuf, PathBuf), Miss> {
        let mut first = None;
        for root in &self.roots {
            match self.inside(&root.real.join(relative)) {
                Ok(real) => return Ok((real, root.named.join(relative))),
                Err(Miss::Outside) => return Err(Miss::Outside),
                Err(Miss::Absent(e)) => first = first.or(Some(e)),
            }
        }
        Err(Miss::Absent(first.unwrap_or_else(|| io::ErrorKind::NotFound.into())))
    }

    /// Looks for a file beneath a folder that is beneath one of the roots.
    fn find_beside(&self, folder: &Path, relative: &Path) -> Option<Found> {
        let real = self.inside(&folder.join(relative)).ok()?;
        let root = self.roots.iter().find(|r| folder.starts_with(&r.real))?;
        let below = folder.strip_prefix(&root.real).ok()?;
        Some(Found { real, shown: root.named.join(below).join(relative), note: None })
    }

    /// Follows the links of a path. Where they lead is what counts.
    fn inside(&self, path: &Path) -> Result<PathBuf, Miss> {
        let real = fs::canonicalize(path).map_err(Miss::Absent)?;
        if self.roots.iter().any(|r| real.starts_with(&r.real)) { Ok(real) } else { Err(Miss::Outside) }
    }
}

const OUTSIDE: &str = "it leads out of the scene's folder through a link";

/// The message on a name that is not followed.
fn refused(name: &str, why: &str) -> String {
    let shown: String = name.chars().take(200).collect();
    format!("refused path {shown:?}: {why}")
}

/// The last part of a name of any system, if it is a plain one.
fn last_part(name: &str) -> Option<PathBuf> {
    relative_path(name.rsplit(['/', '\\', ':']).next()?).ok()
}

/// What follows `scheme:`; schemes ignore case.
fn strip_scheme<'u>(uri: &'u str, scheme: &str) -> Option<&'u str> {
    let (head, rest) = uri.split_once(':')?;
    head.eq_ignore_ascii_case(scheme).then_some(rest)
}

/// The path that a relative URI means, or why it is refused.
fn uri_path(uri: &str) -> Result<PathBuf, String> {
    let decoded: Cow<str> = percent_encoding::percent_decode_str(uri)
        .decode_utf8()
        .map_err(|_| "it is not UTF-8 once decoded".to_string())?;
    relative_path(&decoded)
}

/// The path that a plain name means, or why it is refused.
fn relative_path(name: &str) -> Result<PathBuf, String> {
    if name.is_empty() {
        return Err("it is empty".into());
    }
    // A colon begins a scheme, a drive letter or a hidden stream of a file; none of them is a plain relative path.
    if let Some((head, _)) = name.split_once(':') {
        let head: String = head.chars().take(20).collect();
        return Err(format!("it has the scheme or drive {head:?}; only data: and relative paths are read"));
    }
    if name.contains('\\') {
        return Err("it has a backslash; folders are separated by /".into());
    }
    if name.chars().any(char::is_control) {
        return Err("it has a control character".into());
    }
    if name.starts_with('/') {
        return Err("it is absolute".into());
    }
    let mut path = PathBuf::new();
    for part in name.split('/') {
        match part {
            "" | "." => {}
            ".." => return Err("it climbs with ..".into()),
            name => path.push(name),
        }
    }
    if path.as_os_str().is_empty() { Err("it names no file".into()) } else { Ok(path) }
}

/// The payload of a data URI after `data:`.
fn decode_data(data: &str) -> Result<Vec<u8>, String> {
    let (header, payload) = data.split_once(',').ok_or("a data: URI without a comma")?;
    let base64 = header.rsplit(';').next().is_some_and(|p| p.trim().eq_ignore_ascii_case("base64"));
    if !base64 {
        return Ok(percent_encoding::percent_decode_str(payload).collect());
    }
    BASE64.decode(payload.trim()).map_err(|e| format!("a data: URI with wrong base64: {e}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_names_pass() {
        for (uri, path) in [
            ("a.png", "a.png"),
            ("./a.png", "a.png"),
            ("t/a.png", "t/a.png"),
            ("t//./a.png", "t/a.png"),
            ("Normal%20Map.png", "Normal Map.png"),
            ("Normal Map.png", "Normal Map.png"),
            ("%C3%B1and%C3%BA.png", "ñandú.png"),
            ("ñandú.png", "ñandú.png"),
            ("a..b.png", "a..b.png"),
            ("...", "..."),
            ("100%.png", "100%.png"),
            ("a%2Fb.png", "a/b.png"),
        ] {
            assert_eq!(uri_path(uri).unwrap(), Path::new(path), "{uri}");
        }
    }

    #[test]
    fn escapes_are_refused() {
        for uri in [
            "",
            ".",
            "./",
            "..",
            "../a.png",
            "t/../../a.png",
            "t/../a.png",
            "t/..",
            "%2e%2e/a.png",
            "%2E%2E%2Fa.png",
            "..%2fa.png",
            ".%2e/a.png",
            "/etc/passwd",
            "//host/share/a.png",
            "%2fetc/passwd",
            "///a",
            "file:a.png",
            "file:///etc/passwd",
            "FILE:///etc/passwd",
            "http://host/a.png",
            "https://host/a.png",
            "ftp://host/a",
            "C:/a.png",
            "c:a.png",
            "C%3A/a.png",
            "C:\\a.png",
            "..\\a.png",
            "t\\..\\..\\a.png",
            "\\\\host\\share",
            "%5c%5chost%5cshare",
            "..%5ca.png",
            "a.png:stream",
            "a%00.png",
            "a\n.png",
            "%ff%fe.png",
        ] {
            assert!(uri_path(uri).is_err(), "{uri:?} passed");
        }
    }

    #[test]
    fn a_percent_sign_in_a_plain_name_is_one() {
        assert_eq!(relative_path("%2e%2e/a%20b.png").unwrap(), Path::new("%2e%2e/a%20b.png"));
        assert!(relative_path("..").is_err() && relative_path("t\\a.png").is_err());
    }

    #[test]
    fn last_parts_are_plain_names() {
        for (name, last) in [
            ("C:\\textures\\wood.png", Some("wood.png")),
            ("..\\wood 2.png", Some("wood 2.png")),
            ("../../wood.png", Some("wood.png")),
            ("http://host/wood.png", Some("wood.png")),
            ("C:wood.png", Some("wood.png")),
            ("wood.png", Some("wood.png")),
            ("..", None),
            ("a/..", None),
            ("a/", None),
            ("", None),
        ] {
            assert_eq!(last_part(name), last.map(PathBuf::from), "{name}");
        }
    }

    #[test]
    fn data_uris() {
        assert_eq!(decode_data("text/plain;base64,aGk=").unwrap(), b"hi");
        assert_eq!(decode_data(";base64,aGk").unwrap(), b"hi");
        assert_eq!(decode_data("application/octet-stream,h%69").unwrap(), b"hi");
        assert!(decode_data(";base64,a$k=").is_err());
        assert!(decode_data("no comma").is_err());
        assert_eq!(strip_scheme("DATA:,x", "data"), Some(",x"));
    }
}
