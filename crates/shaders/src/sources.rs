//! What a shader is made of: its entry file and all that it includes, and a hash over them. Used by the compiler
//! (`cargo xtask shaders`) and by the test that says when SPIR-V is older than its sources; no part of the library.

use std::collections::BTreeMap;
use std::path::Path;

/// Endings of files that are compiled; `.glsl` files are included by them.
pub(crate) const STAGES: [&str; 7] = ["rgen", "rchit", "rahit", "rmiss", "comp", "vert", "frag"];

/// All entry files below `root`, as paths with `/` relative to it, sorted.
///
/// # Errors
/// If a folder cannot be read.
pub(crate) fn entries(root: &Path) -> std::io::Result<Vec<String>> {
    let mut found = Vec::new();
    let mut folders = vec![root.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder)? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| STAGES.iter().any(|s| e == *s)) {
                let below = path.strip_prefix(root).expect("found below root");
                let parts: Vec<_> = below.iter().map(|p| p.to_string_lossy()).collect();
                found.push(parts.join("/"));
            }
        }
    }
    found.sort();
    Ok(found)
}

/// An entry file and all files that it includes, however deep: path relative to `root` and text.
///
/// # Errors
/// If one cannot be read.
pub(crate) fn closure(root: &Path, entry: &str) -> std::io::Result<BTreeMap<String, String>> {
    let mut found = BTreeMap::new();
    let mut open = vec![entry.to_owned()];
    while let Some(name) = open.pop() {
        if found.contains_key(&name) {
            continue;
        }
        let text = std::fs::read_to_string(root.join(&name))
            .map_err(|e| std::io::Error::new(e.kind(), format!("{name}: {e}")))?;
        open.extend(text.lines().filter_map(included).map(str::to_owned));
        found.insert(name, text);
    }
    Ok(found)
}

/// The file that a line includes.
fn included(line: &str) -> Option<&str> {
    line.trim_start().strip_prefix("#include")?.trim().strip_prefix('"')?.split('"').next()
}

/// The line of `spirv/sources.txt` for an entry: its name and a hash over all that it is made of.
///
/// # Errors
/// If a file cannot be read.
pub(crate) fn manifest_line(root: &Path, entry: &str) -> std::io::Result<String> {
    let mut all = String::new();
    for (name, text) in closure(root, entry)? {
        all.push_str(&name);
        all.push('\0');
        all.push_str(&text);
        all.push('\0');
    }
    Ok(format!("{entry} {:032x}", twox_hash::XxHash3_128::oneshot(all.as_bytes())))
}
