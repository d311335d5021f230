//! Where a picture goes when nobody said so.

use std::path::{Path, PathBuf};

/// `NAME.png` beside the scene, or in the current folder where that of the scene takes no files. What is there already is
/// never replaced, a scene's texture may have that name: then it is `NAME-2.png`, `NAME-3.png`, …
pub(super) fn default_output(scene: &Path) -> PathBuf {
    let stem = scene.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let stem = if stem.is_empty() { "picture".into() } else { stem };
    let beside = free(scene.parent().unwrap_or(Path::new("")), &stem);
    if lumbre::io::check_writable(&beside).is_ok() { beside } else { free(Path::new(""), &stem) }
}

/// The first such name in a folder that nothing has.
fn free(folder: &Path, stem: &str) -> PathBuf {
    let name = |i: u32| folder.join(if i == 1 { format!("{stem}.png") } else { format!("{stem}-{i}.png") });
    // A name that leads to nothing (a broken link) is taken too.
    (1..).map(name).find(|p| p.symlink_metadata().is_err()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn the_picture_lies_beside_the_scene_and_replaces_nothing() {
        let dir = tempfile::tempdir().unwrap();
        let named = |scene: &str| default_output(&dir.path().join(scene));
        assert_eq!(named("a b.c.glb"), dir.path().join("a b.c.png"));
        for name in ["duck.png", "duck-2.png"] {
            fs::write(dir.path().join(name), "texture").unwrap();
        }
        assert_eq!(named("duck.gltf"), dir.path().join("duck-3.png"));
        assert_eq!(default_output(Path::new("/none/such/duck.gltf")), Path::new("duck.png"));
        assert_eq!(default_output(Path::new("..")), Path::new("picture.png"));
    }
}
