//! Opening files, and writing edits, on threads of their own: the window never waits for a disk or a parser. What was asked for last wins; what comes
//! of it is taken by [`Loader::take`]. A file that cannot be opened changes nothing.

use crate::places::{MeshBounds, mesh_bounds};
use eframe::egui::Context;
use lumbre::LoadOptions;
use lumbre::edits::Edits;
use lumbre::io::Limits;
use lumbre::scene::{Background, EnvironmentMap, Scene};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

/// A scene that was opened.
#[derive(Clone)]
pub struct OpenedScene {
    /// Its file.
    pub path: PathBuf,
    /// It; with the gradient sky if it has no light at all, as `lumbre render` adds it.
    pub scene: Arc<Scene>,
    /// Boxes of its meshes.
    pub meshes: MeshBounds,
    /// How it was read.
    pub options: LoadOptions,
    /// What there is to say, a line each.
    pub notes: Vec<String>,
    /// The file had changed while it was shown.
    pub again: bool,
}

/// What a file turned out to hold.
pub enum Opened {
    /// A scene.
    Scene(Box<OpenedScene>),
    /// A picture of the surroundings.
    Environment {
        /// Its file.
        path: PathBuf,
        /// It.
        map: Arc<EnvironmentMap>,
        /// What there is to say, a line each.
        notes: Vec<String>,
    },
    /// Edits.
    Edits {
        /// Their file.
        path: PathBuf,
        /// Whether they fit the scene that is open is another matter.
        edits: Box<Edits>,
    },
    /// Edits were written.
    Written {
        /// Their file.
        path: PathBuf,
        /// They.
        edits: Box<Edits>,
    },
    /// Edits could not be written, one line; an older file is as it was.
    NotWritten(String),
    /// It could not be opened: one line.
    Failed {
        /// The file.
        path: PathBuf,
        /// Why not.
        reason: String,
    },
}

/// What a file is taken for, by its ending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// glTF, OBJ, PLY, STL.
    Scene,
    /// `.hdr` and `.exr`.
    Environment,
    /// `.json`.
    Edits,
}

/// Endings of scenes, for dialogs.
pub const SCENE_ENDINGS: &[&str] = &["gltf", "glb", "obj", "ply", "stl"];
/// Endings of pictures of surroundings.
pub const ENVIRONMENT_ENDINGS: &[&str] = &["hdr", "exr"];
/// Endings of edits.
pub const EDITS_ENDINGS: &[&str] = &["json"];

impl FileKind {
    /// Of a file; what is unknown is tried as a scene, whose error says what there is.
    pub fn of(path: &Path) -> FileKind {
        let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        match &*ending {
            e if ENVIRONMENT_ENDINGS.contains(&e) => FileKind::Environment,
            e if EDITS_ENDINGS.contains(&e) => FileKind::Edits,
            _ => FileKind::Scene,
        }
    }
}

/// Opens files and writes edits.
pub struct Loader {
    options: LoadOptions,
    send: Sender<(u64, Opened)>,
    receive: Receiver<(u64, Opened)>,
    /// The number of the scene that is open: what is asked for is for that one.
    pub document: u64,
    window: Arc<Mutex<Option<Context>>>,
    /// Number of the last scene that was asked for: those before it are of no use.
    last_scene: u64,
    count: u64,
    /// What is being opened or written, and the number of the scene that it is for.
    under_way: Vec<(u64, PathBuf, u64)>,
}

impl Loader {
    /// One that opens by these options. Those that choose within a file hold for `first` alone.
    pub fn new(options: LoadOptions) -> Self {
        let (send, receive) = channel();
        Loader {
            options,
            send,
            receive,
            document: 0,
            window: Arc::default(),
            last_scene: 0,
            count: 0,
            under_way: Vec::new(),
        }
    }

    /// Tells whose window is to be woken.
    pub fn wake(&self, window: &Context) {
        *self.window.lock().unwrap_or_else(PoisonError::into_inner) = Some(window.clone());
    }

    /// Opens a file by its ending.
    pub fn open(&mut self, path: &Path) {
        match FileKind::of(path) {
            FileKind::Scene => self.open_scene(path),
            FileKind::Environment => self.open_environment(path),
            FileKind::Edits => self.start(path, failed, move |path| {
                let edits = Edits::read(path).map_err(|e| e.to_string())?;
                Ok(Opened::Edits { path: path.into(), edits: Box::new(edits) })
            }),
        }
    }

    /// Opens a scene.
    pub fn open_scene(&mut self, path: &Path) {
        let options = self.options.clone();
        // Which of a file's scenes was said of the first file.
        (self.options.scene, self.options.variant) = Default::default();
        self.scene(path, options, false);
    }

    /// Opens the file of a scene again, which has changed, as it was opened before.
    pub fn open_again(&mut self, path: &Path, options: LoadOptions) {
        self.scene(path, options, true);
    }

    fn scene(&mut self, path: &Path, options: LoadOptions, again: bool) {
        self.last_scene = self.count + 1;
        self.start(path, failed, move |path| load(path, &options, again));
    }

    /// Writes edits.
    pub fn write_edits(&mut self, path: PathBuf, edits: Edits) {
        let failed = |_, reason| Opened::NotWritten(reason);
        self.start(&path, failed, move |path| {
            Ok(match edits.write(path) {
                Ok(()) => Opened::Written { path: path.into(), edits: Box::new(edits) },
                Err(e) => Opened::NotWritten(e.to_string()),
            })
        });
    }

    /// Opens a picture of the surroundings.
    pub fn open_environment(&mut self, path: &Path) {
        let limits = self.options.limits.clone();
        self.start(path, failed, move |path| environment(path, &limits));
    }

    fn start(
        &mut self,
        path: &Path,
        failed: fn(PathBuf, String) -> Opened,
        work: impl FnOnce(&Path) -> Result<Opened, String> + Send + 'static,
    ) {
        self.count += 1;
        let (number, send, window, path) =
            (self.count, self.send.clone(), self.window.clone(), path.to_path_buf());
        self.under_way.push((number, path.clone(), self.document));
        let of_thread = path.clone();
        let job = move || {
            let path = of_thread;
            // A panic was printed where it arose; here it is one more file that cannot be opened.
            let done = catch_unwind(AssertUnwindSafe(|| work(&path)))
                .unwrap_or_else(|_| Err(format!("{}: this is a bug: the loader panicked", path.display())));
            let _ = send.send((number, done.unwrap_or_else(|reason| failed(path, reason))));
            let window = window.lock().unwrap_or_else(PoisonError::into_inner).clone();
            if let Some(window) = window {
                window.request_repaint();
            }
        };
        if let Err(e) = std::thread::Builder::new().name("open".into()).spawn(job) {
            let _ = self.send.send((number, failed(path, e.to_string())));
        }
    }

    /// The file that is being opened.
    pub fn under_way(&self) -> Option<&Path> {
        self.under_way.last().map(|(_, path, _)| &**path)
    }

    /// Whether a file is being opened.
    pub fn is_opening(&self, file: &Path) -> bool {
        self.under_way.iter().any(|(_, path, _)| path == file)
    }

    /// What came, the oldest first, each with the number of the scene that it was asked for.
    pub fn take(&mut self) -> Vec<(u64, Opened)> {
        let came: Vec<(u64, Opened)> = self.receive.try_iter().collect();
        let mut out = Vec::new();
        for (number, opened) in came {
            let at = self.under_way.iter().position(|(n, ..)| *n == number);
            let document = at.map_or(self.document, |at| self.under_way.remove(at).2);
            if !matches!(opened, Opened::Scene(_)) || number == self.last_scene {
                out.push((document, opened));
            }
        }
        out
    }
}

fn failed(path: PathBuf, reason: String) -> Opened {
    Opened::Failed { path, reason }
}

/// Loads a scene, gives light to a dark one, and measures it.
fn load(path: &Path, options: &LoadOptions, again: bool) -> Result<Opened, String> {
    let began = Instant::now();
    let loaded = lumbre::load_scene(path, options).map_err(|e| e.to_string())?;
    let (mut scene, mut notes) = (loaded.scene, loaded.warnings);
    if !lumbre::light_kinds(&scene).any() {
        scene.environment.background = Background::Gradient;
        notes.push("light: nothing in the scene gives any; gradient sky added".into());
    }
    let meshes = mesh_bounds(&scene);
    let seconds = began.elapsed().as_secs_f64();
    notes.push(format!("{} opened in {seconds:.2} s", path.display()));
    Ok(Opened::Scene(Box::new(OpenedScene {
        path: path.into(),
        scene: Arc::new(scene),
        meshes,
        options: options.clone(),
        notes,
        again,
    })))
}

fn environment(path: &Path, limits: &Limits) -> Result<Opened, String> {
    let loaded = lumbre::io::read_environment(path, limits).map_err(|e| e.to_string())?;
    let notes = loaded.warnings.iter().map(|w| format!("{}: {w}", path.display())).collect();
    Ok(Opened::Environment { path: path.into(), map: Arc::new(loaded.map), notes })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    /// Waits for what comes next; a test that hangs is stopped.
    fn next(loader: &mut Loader) -> Opened {
        let began = Instant::now();
        while began.elapsed() < Duration::from_secs(30) {
            if let Some((_, opened)) = loader.take().pop() {
                return opened;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        panic!("nothing came");
    }

    /// A triangle as STL.
    fn triangle(folder: &Path) -> PathBuf {
        let path = folder.join("triangle.stl");
        let text = "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid t\n";
        std::fs::write(&path, text).unwrap();
        path
    }

    #[test]
    fn a_scene_comes_measured_and_lit() {
        let folder = tempfile::tempdir().unwrap();
        let path = triangle(folder.path());
        let mut loader = Loader::new(LoadOptions::default());
        loader.open(&path);
        assert_eq!(loader.under_way(), Some(&*path));
        let Opened::Scene(opened) = next(&mut loader) else { panic!("no scene") };
        assert_eq!(opened.scene.environment.background, Background::Gradient);
        assert_eq!(opened.meshes[0].unwrap().max, glam::Vec3::new(2.0, 1.0, 0.0));
        assert!(!opened.again && opened.notes.iter().any(|n| n.contains("gradient sky")));
        assert_eq!(loader.under_way(), None);
    }

    #[test]
    fn what_cannot_be_opened_says_why() {
        let folder = tempfile::tempdir().unwrap();
        let broken = folder.path().join("broken.glb");
        std::fs::write(&broken, b"glTF and then nothing").unwrap();
        for path in [
            broken,
            folder.path().join("missing.obj"),
            folder.path().join("missing.json"),
            folder.path().join("no.hdr"),
        ] {
            let mut loader = Loader::new(LoadOptions::default());
            loader.open(&path);
            let Opened::Failed { path: of, reason } = next(&mut loader) else { panic!("{path:?}") };
            assert_eq!(of, path);
            assert!(
                reason.contains(&*path.file_name().unwrap().to_string_lossy()) && !reason.contains('\n'),
                "{reason}"
            );
        }
    }

    #[test]
    fn the_scene_that_was_asked_for_last_wins() {
        let folder = tempfile::tempdir().unwrap();
        let path = triangle(folder.path());
        let mut loader = Loader::new(LoadOptions::default());
        loader.open_scene(&path);
        loader.open_again(&path, LoadOptions::default());
        let Opened::Scene(opened) = next(&mut loader) else { panic!("no scene") };
        assert!(opened.again);
        std::thread::sleep(Duration::from_millis(200));
        assert!(loader.take().is_empty(), "the first one is of no use");
    }

    #[test]
    fn a_panic_is_a_file_that_cannot_be_opened() {
        let mut loader = Loader::new(LoadOptions::default());
        loader.start(Path::new("a.glb"), failed, |_| panic!("on purpose"));
        let Opened::Failed { reason, .. } = next(&mut loader) else { panic!("opened") };
        assert!(reason.contains("a.glb") && reason.contains("bug"), "{reason}");
    }

    #[test]
    fn kinds_are_told_by_endings() {
        for (name, kind) in [
            ("a.glb", FileKind::Scene),
            ("a.HDR", FileKind::Environment),
            ("a.exr", FileKind::Environment),
            ("a.json", FileKind::Edits),
            ("a", FileKind::Scene),
        ] {
            assert_eq!(FileKind::of(Path::new(name)), kind, "{name}");
        }
    }
}
