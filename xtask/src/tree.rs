//! The files of the workspace.

use std::path::{Path, PathBuf};

/// Folders that hold nothing written by hand.
const SKIPPED: &[&str] = &["target", "out", ".git"];

/// The workspace root.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask lies in the workspace root")
}

/// The text files with one of `extensions`, as (path relative to the root with `/`, text), sorted by path.
///
/// # Errors
/// The path that could not be read.
pub(crate) fn text_files(extensions: &[&str]) -> Result<Vec<(String, String)>, String> {
    let mut paths = Vec::new();
    collect(root(), &mut paths)?;
    paths.retain(|p| p.extension().is_some_and(|e| extensions.iter().any(|wanted| e == *wanted)));
    paths.sort();
    paths.iter().map(|p| Ok((relative(p), read(p)?))).collect()
}

/// Text of a file.
///
/// # Errors
/// Its path with the reason.
pub(crate) fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))
}

fn relative(path: &Path) -> String {
    let inside = path.strip_prefix(root()).expect("collected below the root");
    let parts: Vec<_> = inside.components().map(|c| c.as_os_str().to_string_lossy()).collect();
    parts.join("/")
}

fn collect(folder: &Path, paths: &mut Vec<PathBuf>) -> Result<(), String> {
    let name = |e: std::io::Error| format!("{}: {e}", folder.display());
    for entry in std::fs::read_dir(folder).map_err(name)? {
        let entry = entry.map_err(name)?;
        // A link is neither followed nor read: its target is elsewhere or met on its own.
        let kind = entry.file_type().map_err(name)?;
        if kind.is_dir() && !SKIPPED.iter().any(|s| entry.file_name() == *s) {
            collect(&entry.path(), paths)?;
        } else if kind.is_file() {
            paths.push(entry.path());
        }
    }
    Ok(())
}
