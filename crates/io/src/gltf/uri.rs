//! Names inside a scene to bytes. Only `data:` URIs (RFC 2397) and relative paths beneath the scene's folder are
//! followed; everything else that a URI (RFC 3986) could say is refused.

use crate::IoError;
use crate::files::read_file;
use crate::limits::Room;
use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};

/// Base64 with or without its padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// Follows names from one scene.
pub(super) struct Resolver<'a> {
    /// The scene file.
    scene: &'a Path,
    /// Its folder, without links.
    folder: PathBuf,
}

/// What a URI led to.
pub(super) struct Resolved {
    /// Its bytes.
    pub(super) bytes: Vec<u8>,
    /// The file they came from; `None`: they stood in the URI.
    pub(super) file: Option<PathBuf>,
}

impl<'a> Resolver<'a> {
    /// For the scene at `path`, which exists.
    pub(super) fn new(path: &'a Path) -> Result<Self, IoError> {
        let folder = match path.parent() {
            Some(p) if !p.as_os_str().is_empty() => p,
            _ => Path::new("."),
        };
        let folder = fs::canonicalize(folder).map_err(|e| IoError::open(folder, &e))?;
        Ok(Resolver { scene: path, folder })
    }

    /// Reads what `uri`, found at `place`, names, within `limit`.
    pub(super) fn read(&self, uri: &str, place: &str, limit: impl Into<Room>) -> Result<Resolved, IoError> {
        let limit = limit.into();
        if let Some(data) = strip_scheme(uri, "data") {
            let bytes = decode_data(data).map_err(|why| IoError::data(self.scene, place, why))?;
            limit.check(self.scene, place, bytes.len() as u64)?;
            return Ok(Resolved { bytes, file: None });
        }
        let refuse = |why: String| {
            let shown: String = uri.chars().take(200).collect();
            IoError::data(self.scene, place, format!("refused path {shown:?}: {why}"))
        };
        let relative = relative_path(uri).map_err(refuse)?;
        let joined = self.folder.join(&relative);
        // Links are followed first: where they lead is what counts.
        let real = fs::canonicalize(&joined)
            .map_err(|e| IoError::open(&relative, &e).named_by(self.scene, place))?;
        if !real.starts_with(&self.folder) {
            return Err(refuse("it leads out of the scene's folder through a link".into()));
        }
        let bytes = read_file(&real, limit).map_err(|e| e.named_by(self.scene, place))?;
        Ok(Resolved { bytes, file: Some(self.scene.with_file_name("").join(relative)) })
    }
}

/// What follows `scheme:`; schemes ignore case.
fn strip_scheme<'u>(uri: &'u str, scheme: &str) -> Option<&'u str> {
    let (head, rest) = uri.split_once(':')?;
    head.eq_ignore_ascii_case(scheme).then_some(rest)
}

/// The path that a relative reference means, or why it is refused.
fn relative_path(uri: &str) -> Result<PathBuf, String> {
    let decoded: Cow<str> = percent_encoding::percent_decode_str(uri)
        .decode_utf8()
        .map_err(|_| "it is not UTF-8 once decoded".to_string())?;
    if decoded.is_empty() {
        return Err("it is empty".into());
    }
    // A colon begins a scheme, a drive letter or a hidden stream of a file; none of them is a plain relative path.
    if let Some((head, _)) = decoded.split_once(':') {
        let head: String = head.chars().take(20).collect();
        return Err(format!("it has the scheme or drive {head:?}; only data: and relative paths are read"));
    }
    if decoded.contains('\\') {
        return Err("it has a backslash; folders are separated by /".into());
    }
    if decoded.chars().any(char::is_control) {
        return Err("it has a control character".into());
    }
    if decoded.starts_with('/') {
        return Err("it is absolute".into());
    }
    let mut path = PathBuf::new();
    for part in decoded.split('/') {
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
            assert_eq!(relative_path(uri).unwrap(), Path::new(path), "{uri}");
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
            assert!(relative_path(uri).is_err(), "{uri:?} passed");
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
