//! Writes the project's own scenes, `assets/scenes/*`: every file there is made by this program, byte for byte, on any machine
//! (`f64` arithmetic, transcendental functions of `libm`). `make_scenes` writes them, `make_scenes --check` only compares and
//! fails when one is stale; a test does the same. Takes an optional folder, by default `assets/scenes` of the workspace.
#![forbid(unsafe_code)]

mod cornell;
mod glb;
mod leaves;
mod mesh;
mod png;
mod prism;
mod shapes;
mod smooth;
mod tile;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// A scene file: its name inside the folder and its bytes.
struct SceneFile {
    name: &'static str,
    bytes: Vec<u8>,
}

/// Every file this program answers for.
fn all_scenes() -> Vec<SceneFile> {
    vec![
        SceneFile { name: "cornell.glb", bytes: cornell::cornell() },
        SceneFile { name: "leaves.gltf", bytes: leaves::leaves() },
        SceneFile { name: "prism.gltf", bytes: prism::prism() },
        SceneFile { name: "smooth.gltf", bytes: smooth::smooth() },
    ]
}

/// The folder of the checked-in scenes.
fn default_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes")
}

/// How the file on disk differs from what the generator makes: `None` when it does not.
fn stale(folder: &Path, scene: &SceneFile) -> Option<String> {
    let path = folder.join(scene.name);
    let on_disk = match std::fs::read(&path) {
        Ok(bytes) => bytes,
        Err(error) => return Some(format!("{}: {error}", path.display())),
    };
    if on_disk == scene.bytes {
        return None;
    }
    let at = on_disk
        .iter()
        .zip(&scene.bytes)
        .position(|(a, b)| a != b)
        .unwrap_or(on_disk.len().min(scene.bytes.len()));
    Some(format!(
        "{}: {} bytes on disk, {} generated, first difference at byte {at}",
        path.display(),
        on_disk.len(),
        scene.bytes.len()
    ))
}

fn main() -> ExitCode {
    let mut check = false;
    let mut folder = default_folder();
    for argument in std::env::args().skip(1) {
        match argument.as_str() {
            "--check" => check = true,
            "--help" | "-h" => {
                println!(
                    "usage: make_scenes [--check] [FOLDER]   writes (or compares) the scenes of assets/scenes"
                );
                return ExitCode::SUCCESS;
            }
            flag if flag.starts_with('-') => {
                eprintln!("make_scenes: unknown flag {flag}");
                return ExitCode::from(2);
            }
            path => folder = PathBuf::from(path),
        }
    }
    let mut failures = 0;
    for scene in all_scenes() {
        let problem = if check {
            stale(&folder, &scene)
        } else {
            let path = folder.join(scene.name);
            std::fs::write(&path, &scene.bytes).err().map(|error| format!("{}: {error}", path.display()))
        };
        match problem {
            Some(text) => {
                eprintln!("make_scenes: {text}");
                failures += 1;
            }
            None => println!("{} {} bytes", scene.name, scene.bytes.len()),
        }
    }
    if failures == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checked_in_scenes_are_what_the_generator_makes() {
        let problems: Vec<String> =
            all_scenes().iter().filter_map(|scene| stale(&default_folder(), scene)).collect();
        assert!(problems.is_empty(), "run `cargo run -p lumbre-testkit --bin make_scenes`: {problems:#?}");
    }

    #[test]
    fn a_changed_missing_or_longer_file_is_noticed() {
        let folder = default_folder();
        for mut scene in all_scenes() {
            let middle = scene.bytes.len() / 2;
            scene.bytes[middle] ^= 1;
            assert!(stale(&folder, &scene).is_some_and(|text| text.contains(&format!("at byte {middle}"))));
            scene.bytes[middle] ^= 1;
            scene.bytes.push(0);
            assert!(stale(&folder, &scene).is_some());
        }
        let missing = SceneFile { name: "no-such-scene.glb", bytes: Vec::new() };
        assert!(stale(&folder, &missing).is_some());
    }

    #[test]
    fn scenes_are_small() {
        for scene in all_scenes() {
            assert!(scene.bytes.len() < 400 * 1024, "{} has {} bytes", scene.name, scene.bytes.len());
        }
    }
}
