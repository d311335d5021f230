//! Files that another program may write again while they are shown.

use eframe::egui::Context;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, SystemTime};

/// Tells when a file has changed, by its time and size. Asks the disk on a thread of its own.
pub struct Watch {
    changed: Receiver<()>,
    /// The thread ends when this is gone.
    _alive: Arc<()>,
}

/// Between two looks at the file, and how long it must have stayed as it is: what is still being written is no scene.
const LOOK: Duration = Duration::from_millis(250);

impl Watch {
    /// Watches a file until this is dropped.
    pub fn of(path: &Path, window: Context) -> Self {
        let (send, changed) = channel();
        let alive = Arc::new(());
        let (path, watched) = (path.to_path_buf(), Arc::downgrade(&alive));
        let look = move || {
            let mut seen = stamp(&path);
            let mut settling = seen;
            while watched.strong_count() > 0 {
                std::thread::sleep(LOOK);
                let now = stamp(&path);
                if now.is_some() && now == settling && now != seen {
                    seen = now;
                    let _ = send.send(());
                    window.request_repaint();
                }
                settling = now;
            }
        };
        let _ = std::thread::Builder::new().name("watch".into()).spawn(look);
        Watch { changed, _alive: alive }
    }

    /// Whether the file changed since this was asked last.
    pub fn changed(&self) -> bool {
        self.changed.try_iter().count() > 0
    }
}

fn stamp(path: &Path) -> Option<(SystemTime, u64)> {
    let data = std::fs::metadata(path).ok()?;
    Some((data.modified().ok()?, data.len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Instant;

    #[test]
    fn a_file_that_changes_is_noticed_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.stl");
        std::fs::write(&path, "solid\n").unwrap();
        let watch = Watch::of(&path, Context::default());
        std::thread::sleep(LOOK * 2);
        assert!(!watch.changed());
        std::fs::write(&path, "solid longer than before\n").unwrap();
        let began = Instant::now();
        while !watch.changed() {
            assert!(began.elapsed() < Duration::from_secs(30), "not noticed");
            std::thread::sleep(Duration::from_millis(10));
        }
        std::thread::sleep(LOOK * 3);
        assert!(!watch.changed());
    }
}
