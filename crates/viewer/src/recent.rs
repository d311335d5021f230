//! Scenes that were opened before, the last one first, in a small file in the user's folder for configuration. Whatever is wrong
//! with that file or folder does no harm: the list is then empty or not kept.

use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Entries that are kept.
const LENGTH: usize = 12;
/// A file larger than this is not ours, bytes.
const LARGEST: u64 = 1 << 20;

/// The list, and where it is kept.
#[derive(Clone, Debug, Default)]
pub struct Recent {
    paths: Vec<PathBuf>,
    file: Option<PathBuf>,
}

impl Recent {
    /// Reads the user's list.
    pub fn of_user() -> Self {
        Self::read(user_folder().map(|folder| folder.join("recent.json")))
    }

    /// Reads a list from a file; `None`: it is not kept.
    pub fn read(file: Option<PathBuf>) -> Self {
        let paths = file.as_deref().and_then(paths_in).unwrap_or_default();
        Recent { paths, file }
    }

    /// The scenes, the last one first.
    pub fn paths(&self) -> &[PathBuf] {
        &self.paths
    }

    /// Puts a scene first, and keeps the list.
    pub fn add(&mut self, path: &Path) {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.into());
        self.paths.retain(|p| *p != path);
        self.paths.insert(0, path);
        self.paths.truncate(LENGTH);
        self.write();
    }

    /// Takes a scene off the list: it is gone.
    pub fn remove(&mut self, path: &Path) {
        self.paths.retain(|p| p != path);
        self.write();
    }

    /// Whether it can be written is of no importance to anyone who looks at a picture.
    fn write(&self) {
        let Some(file) = &self.file else { return };
        let paths: Vec<&str> = self.paths.iter().filter_map(|p| p.to_str()).collect();
        let text = json!({ "recent": paths }).to_string();
        let folder = file.parent().unwrap_or(Path::new("."));
        // By rename, so that two windows do not mix their lists in one file.
        let beside = folder.join(format!("recent.{}.tmp", std::process::id()));
        let written = std::fs::create_dir_all(folder)
            .and_then(|()| std::fs::write(&beside, text))
            .and_then(|()| std::fs::rename(&beside, file));
        if written.is_err() {
            let _ = std::fs::remove_file(&beside);
        }
    }
}

/// What a file lists; `None` where it is no such file. Entries that are no paths are left out.
fn paths_in(file: &Path) -> Option<Vec<PathBuf>> {
    if std::fs::metadata(file).ok()?.len() > LARGEST {
        return None;
    }
    let value: Value = serde_json::from_slice(&std::fs::read(file).ok()?).ok()?;
    let listed = value.get("recent")?.as_array()?;
    let paths = listed.iter().filter_map(Value::as_str).filter(|p| !p.is_empty()).map(PathBuf::from);
    Some(paths.take(LENGTH).collect())
}

/// The folder of this program among the user's settings: of XDG, Windows or macOS.
fn user_folder() -> Option<PathBuf> {
    let from = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|p| p.is_absolute());
    let base = if cfg!(windows) {
        from("APPDATA")
    } else if cfg!(target_os = "macos") {
        from("HOME").map(|home| home.join("Library/Application Support"))
    } else {
        from("XDG_CONFIG_HOME").or_else(|| from("HOME").map(|home| home.join(".config")))
    };
    base.map(|base| base.join("lumbre"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_one_comes_first_and_is_found_again() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("new/recent.json");
        let mut recent = Recent::read(Some(file.clone()));
        for name in ["/a.glb", "/b.glb", "/a.glb"] {
            recent.add(Path::new(name));
        }
        assert_eq!(recent.paths(), [Path::new("/a.glb"), Path::new("/b.glb")]);
        assert_eq!(Recent::read(Some(file.clone())).paths(), recent.paths());
        recent.remove(Path::new("/a.glb"));
        assert_eq!(Recent::read(Some(file)).paths(), [Path::new("/b.glb")]);
        for i in 0..100 {
            recent.add(&PathBuf::from(format!("/{i}.glb")));
        }
        assert_eq!(recent.paths().len(), LENGTH);
        assert_eq!(recent.paths()[0], Path::new("/99.glb"));
    }

    #[test]
    fn bad_files_do_no_harm() {
        let folder = tempfile::tempdir().unwrap();
        for (i, text) in ["", "{", "[]", "{\"recent\": 3}", "\u{0}\u{1}", "null"].iter().enumerate() {
            let file = folder.path().join(i.to_string());
            std::fs::write(&file, text).unwrap();
            let mut recent = Recent::read(Some(file.clone()));
            assert!(recent.paths().is_empty(), "{text:?}");
            recent.add(Path::new("/a.glb"));
            assert_eq!(Recent::read(Some(file)).paths(), [Path::new("/a.glb")], "{text:?}");
        }
        let mixed = folder.path().join("mixed");
        std::fs::write(&mixed, r#"{"recent": [1, "", null, "/good.glb", {}]}"#).unwrap();
        assert_eq!(Recent::read(Some(mixed)).paths(), [Path::new("/good.glb")]);
        // A folder in the place of the file, and nowhere to write.
        let mut recent = Recent::read(Some(folder.path().into()));
        recent.add(Path::new("/a.glb"));
        assert_eq!(recent.paths(), [Path::new("/a.glb")]);
        assert!(folder.path().is_dir());
        let mut nowhere = Recent::read(None);
        nowhere.add(Path::new("/a.glb"));
        assert_eq!(nowhere.paths().len(), 1);
    }
}
