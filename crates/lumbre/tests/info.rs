//! `lumbre::info` on well-known scenes: hints where something is wrong, and no false alarm elsewhere.

use lumbre::{HintKind, LoadOptions, SceneInfo, info, load_scene};
use std::path::{Path, PathBuf};

/// Hints that are true of scenes that mean no harm; all others may have no light of their own, and nothing else.
const EXPECTED: &[(&str, &[HintKind])] = &[
    // The author counts on an environment, and one camera is very close to the dark car.
    ("ToyCar.gltf", &[HintKind::AllBlack, HintKind::FaintEmission]),
    // Labels that emit are all the light there is.
    ("ClearCoatTest.gltf", &[HintKind::FaintEmission]),
    // A cube with emissive letters on it.
    ("MultiUVTest.glb", &[HintKind::FaintEmission]),
    // The room is open to -z only, and is put in view from the other side.
    ("cornell_box_saturada.obj", &[HintKind::AllBlack]),
];

fn scenes() -> Vec<PathBuf> {
    let folder = std::env::var_os("LUMBRE_SCENES")
        .map(PathBuf::from)
        .unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/scenes"));
    if !folder.is_dir() {
        eprintln!("skipped: no scenes at {} (set LUMBRE_SCENES)", folder.display());
    }
    let mut found = Vec::new();
    let mut folders = vec![folder];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                // The same scene with larger textures.
                folders.extend(Some(path).filter(|p| !p.ends_with("sponza/glTF")));
            } else if path.extension().is_some_and(|e| e == "gltf" || e == "glb" || e == "obj") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn look(path: &Path) -> SceneInfo {
    let scene = load_scene(path, &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}")).scene;
    info(&scene).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

#[test]
fn no_false_alarms_on_well_known_scenes() {
    for path in scenes() {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let found = look(&path);
        assert!(found.geometry.drawn_triangles > 0 && found.bounds.is_some(), "{}", path.display());
        let kinds: Vec<HintKind> = found.hints.iter().map(|h| h.kind).collect();
        match EXPECTED.iter().find(|(known, _)| *known == name) {
            Some((_, expected)) => assert_eq!(kinds, *expected, "{}", path.display()),
            None => assert!(
                kinds.is_empty() || kinds == [HintKind::NoLight],
                "{}: {:?}",
                path.display(),
                found.hints
            ),
        }
    }
}

#[test]
fn our_own_scenes_are_sound() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes");
    for name in ["cornell.glb", "smooth.gltf"] {
        let found = look(&folder.join(name));
        assert_eq!((found.hints.len(), found.notes.len()), (0, 0), "{name}: {:?}", found.hints);
    }
}
