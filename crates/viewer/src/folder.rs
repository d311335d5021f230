//! What stands in a folder, for the file dialog: read on a thread of its own, since a folder may lie on a slow disk.

use eframe::egui::Context;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};

/// Entries that a folder shows; more are counted.
const MOST: usize = 2000;

/// One entry.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its name.
    pub name: String,
    /// It can be entered.
    pub is_folder: bool,
}

/// What a folder holds: folders first, by name; what is hidden is left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// The first of its entries.
    pub entries: Vec<Entry>,
    /// How many more there are.
    pub left_out: usize,
}

/// A folder that is being read, or was.
pub struct Folder {
    /// Where.
    pub path: PathBuf,
    /// Files with other endings are not listed; empty: all are.
    endings: &'static [&'static str],
    coming: Receiver<Result<Listing, String>>,
    came: Option<Result<Listing, String>>,
}

impl Folder {
    /// Begins to read a folder.
    pub fn read(path: &Path, endings: &'static [&'static str], window: &Context) -> Self {
        let (send, coming) = channel();
        let (of_thread, window) = (path.to_path_buf(), window.clone());
        let work = move || {
            let _ = send.send(list(&of_thread, endings));
            window.request_repaint();
        };
        // Without a thread the channel is closed, which is told below.
        let _ = std::thread::Builder::new().name("folder".into()).spawn(work);
        Folder { path: path.into(), endings, coming, came: None }
    }

    /// What it holds, once it is known.
    pub fn listing(&mut self) -> Option<&Result<Listing, String>> {
        if self.came.is_none() {
            self.came = match self.coming.try_recv() {
                Ok(came) => Some(came),
                Err(std::sync::mpsc::TryRecvError::Empty) => None,
                Err(_) => Some(Err(format!("{} cannot be read", self.path.display()))),
            };
        }
        self.came.as_ref()
    }

    /// The endings of files that are listed.
    pub fn endings(&self) -> &'static [&'static str] {
        self.endings
    }
}

fn list(path: &Path, endings: &[&str]) -> Result<Listing, String> {
    let read = std::fs::read_dir(path).map_err(|e| format!("{}: {e}", path.display()))?;
    let mut entries: Vec<Entry> = read
        .filter_map(Result::ok)
        .filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            // Links lead where they lead.
            let is_folder = std::fs::metadata(entry.path()).ok()?.is_dir();
            let shown = !name.starts_with('.') && (is_folder || has_ending(&name, endings));
            shown.then_some(Entry { name, is_folder })
        })
        .collect();
    entries.sort_by_cached_key(|e| (!e.is_folder, e.name.to_lowercase(), e.name.clone()));
    let left_out = entries.len().saturating_sub(MOST);
    entries.truncate(MOST);
    Ok(Listing { entries, left_out })
}

/// Whether a file is one of a kind; every file is where no kind is asked for.
pub fn has_ending(name: &str, endings: &[&str]) -> bool {
    let ending = Path::new(name).extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    endings.is_empty() || ending.is_some_and(|e| endings.contains(&&*e))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wait(mut folder: Folder) -> Result<Listing, String> {
        for _ in 0..3000 {
            if let Some(came) = folder.listing() {
                return came.clone();
            }
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        panic!("nothing came");
    }

    #[test]
    fn folders_come_first_and_other_files_are_left_out() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b.glb", "A.GLTF", "notes.txt", ".hidden.glb"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        std::fs::create_dir(folder.path().join("z")).unwrap();
        let listing = wait(Folder::read(folder.path(), &["glb", "gltf"], &Context::default())).unwrap();
        let names: Vec<&str> = listing.entries.iter().map(|e| &*e.name).collect();
        assert_eq!(names, ["z", "A.GLTF", "b.glb"]);
        assert!(listing.entries[0].is_folder && listing.left_out == 0);
    }

    #[test]
    fn a_folder_that_is_not_there_says_so() {
        let missing = Path::new("/no/such/folder");
        let error = wait(Folder::read(missing, &[], &Context::default())).unwrap_err();
        assert!(error.starts_with("/no/such/folder: "), "{error}");
    }
}
