//! `cargo xtask scenes`: writes the project's own scenes, `assets/scenes/*`. Every file there is made by this program, byte for
//! byte, on any machine; with `--check` it only compares and fails when one is stale.

mod cornell;
mod kit;
mod lanterns;
mod leaves;
mod materials;
mod plates;
mod pool;
mod prism;
mod smooth;

use crate::tree;
use std::path::{Path, PathBuf};

/// A scene file: its name inside the folder and how it is made.
struct SceneFile {
    name: &'static str,
    make: fn() -> Vec<u8>,
}

/// Every file this program answers for.
const SCENES: &[SceneFile] = &[
    SceneFile { name: "cornell.glb", make: cornell::cornell },
    SceneFile { name: "cornell.mtl", make: cornell::as_mtl },
    SceneFile { name: "cornell.obj", make: cornell::as_obj },
    SceneFile { name: "cornell_tile.png", make: cornell::as_png },
    SceneFile { name: "lanterns.glb", make: lanterns::lanterns },
    SceneFile { name: "leaves.gltf", make: leaves::leaves },
    SceneFile { name: "materials.glb", make: materials::materials },
    SceneFile { name: "plates.glb", make: plates::plates },
    SceneFile { name: "pool.glb", make: pool::pool },
    SceneFile { name: "prism.gltf", make: prism::prism },
    SceneFile { name: "smooth.gltf", make: smooth::smooth },
];

/// Writes or compares the scenes whose names (with or without ending) are given, or all.
///
/// # Errors
/// What is stale, could not be written, or is no scene.
pub(crate) fn run(args: &[String]) -> Result<(), String> {
    let check = args.iter().any(|a| a == "--check");
    let wanted: Vec<&str> = args.iter().map(String::as_str).filter(|a| *a != "--check").collect();
    let is = |scene: &SceneFile, name: &str| scene.name == name || scene.name.split('.').next() == Some(name);
    if let Some(unknown) = wanted.iter().find(|name| !SCENES.iter().any(|s| is(s, name))) {
        let names: Vec<&str> = SCENES.iter().map(|s| s.name).collect();
        return Err(format!("no such scene: {unknown}; there are {}", names.join(", ")));
    }
    let mut problems = Vec::new();
    for scene in SCENES.iter().filter(|s| wanted.is_empty() || wanted.iter().any(|name| is(s, name))) {
        let bytes = (scene.make)();
        let path = folder().join(scene.name);
        let problem = if check { stale(&path, &bytes) } else { write(&path, &bytes) };
        match problem {
            Some(problem) => problems.push(problem),
            None => println!("{} {} bytes", scene.name, bytes.len()),
        }
    }
    if problems.is_empty() { Ok(()) } else { Err(problems.join("\n")) }
}

/// The folder of the checked-in scenes.
fn folder() -> PathBuf {
    tree::root().join("assets/scenes")
}

fn write(path: &Path, bytes: &[u8]) -> Option<String> {
    std::fs::write(path, bytes).err().map(|error| format!("{}: {error}", path.display()))
}

/// How the file on disk differs from what the generator makes: `None` when it does not.
fn stale(path: &Path, bytes: &[u8]) -> Option<String> {
    let on_disk = match std::fs::read(path) {
        Ok(on_disk) => on_disk,
        Err(error) => return Some(format!("{}: {error}", path.display())),
    };
    if on_disk == bytes {
        return None;
    }
    let differ = on_disk.iter().zip(bytes).position(|(a, b)| a != b);
    let at = differ.unwrap_or(on_disk.len().min(bytes.len()));
    Some(format!(
        "{}: {} bytes on disk, {} generated, first difference at byte {at}; `cargo xtask scenes` writes it anew",
        path.display(),
        on_disk.len(),
        bytes.len()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_missing_or_longer_file_is_noticed() {
        let path = folder().join("smooth.gltf");
        let mut bytes = std::fs::read(&path).unwrap();
        assert_eq!(stale(&path, &bytes), None);
        bytes[100] ^= 1;
        assert!(stale(&path, &bytes).is_some_and(|text| text.contains("at byte 100;")));
        bytes[100] ^= 1;
        bytes.push(0);
        assert!(stale(&path, &bytes).is_some());
        assert!(stale(&folder().join("no-such-scene.glb"), &[]).is_some());
    }

    #[test]
    fn an_unknown_name_is_refused() {
        let error = run(&["pond".into(), "--check".into()]).unwrap_err();
        assert!(error.starts_with("no such scene: pond; there are "), "{error}");
    }
}
