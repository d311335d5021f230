//! The scene that is open, what was changed of it, and the scene that comes of both. The interface changes [`Document::edits`] as it likes;
//! [`Document::settle`] makes the scene anew where that asks for it, and only then: another tone curve leaves the scene, and so the
//! picture, as it is.

use crate::history::History;
use crate::open::OpenedScene;
use crate::places::{MeshBounds, Places};
use lumbre::LoadOptions;
use lumbre::camera::camera_names;
use lumbre::edits::{Changes, Edits, Value};
use lumbre::scene::{EnvironmentMap, Scene};
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

/// A scene that is open.
#[derive(Clone)]
pub struct Document {
    /// Its file.
    pub path: PathBuf,
    /// How it was read.
    pub options: LoadOptions,
    /// Another number for each scene that is opened; reading a file again does not change it.
    pub number: u64,
    /// As the file says.
    pub base: Arc<Scene>,
    /// What was changed.
    pub edits: Edits,
    /// As it is drawn.
    pub scene: Arc<Scene>,
    /// Where its things are.
    pub places: Places,
    /// Names of its cameras.
    pub cameras: Vec<String>,
    /// Steps to take back. Of the camera there are others: looking around is no edit.
    pub history: History<Edits>,
    /// Where the camera was.
    pub views: History<Changes>,
    meshes: MeshBounds,
    /// The part of the edits that `scene` shows.
    shown: Edits,
    /// The edits that are in a file, but for the camera.
    saved: Edits,
    /// Those that there were when the file was read, but for the camera.
    arrived: Edits,
    maps: HashMap<PathBuf, Arc<EnvironmentMap>>,
}

/// What [`Document::settle`] finds.
#[derive(Clone, Debug, PartialEq)]
pub enum Settled {
    /// The scene is as it was.
    Same,
    /// The scene is another one.
    Changed,
    /// The sky is in a file that is not read yet; the scene is as it was until [`Document::know`] brings it.
    Needs(PathBuf),
    /// The edits do not fit the scene, one line; they are again what they were.
    Refused(String),
}

impl Document {
    /// A scene that nobody has changed, the `number`-th that is opened.
    pub fn new(opened: OpenedScene, number: u64) -> Self {
        let places = Places::of(&opened.scene, &opened.meshes);
        let name = opened.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let mut edits = Edits::default();
        edits.scene = name;
        Document {
            path: opened.path,
            options: opened.options,
            number,
            cameras: camera_names(&opened.scene),
            scene: opened.scene.clone(),
            base: opened.scene,
            history: History::new(undoable(&edits)),
            views: History::new(edits.camera.clone()),
            shown: Edits::default(),
            saved: undoable(&edits),
            arrived: undoable(&edits),
            edits,
            places,
            meshes: opened.meshes,
            maps: HashMap::new(),
        }
    }

    /// The same after its file has changed: edits, steps and views stay, but for edits of what is not there any more. Also why each of
    /// these left, a line.
    pub fn reloaded(self, opened: OpenedScene) -> (Self, Vec<String>) {
        let fresh = Document::new(opened, self.number);
        let Document { mut edits, mut history, views, maps, saved, .. } = self;
        history.observe(&undoable(&edits), false);
        let gone = edits.fit(&fresh.base).iter().map(ToString::to_string).collect();
        let arrived = undoable(&edits);
        (Document { edits, history, views, maps, saved, arrived, ..fresh }, gone)
    }

    /// Back to what there was before [`Document::reloaded`], with all that was done since.
    pub fn back_to(self, before: Document) -> Self {
        let Document { mut edits, mut history, views, maps, mut saved, arrived, .. } = self;
        if undoable(&edits) == arrived {
            let camera = edits.camera;
            (edits, history, saved) = (before.edits, before.history, before.saved);
            edits.camera = camera;
        }
        Document { edits, history, views, maps, saved, ..before }
    }

    /// Opens edits in the place of those there are. They can be undone.
    pub fn replace_edits(&mut self, edits: Edits) {
        let scene = std::mem::take(&mut self.edits.scene);
        self.edits = edits;
        self.edits.scene = scene;
    }

    /// Which of the file's cameras looks, by number: edits name it or number it.
    pub fn camera(&self) -> usize {
        match self.edits.camera.get("camera") {
            Some(Value::Text(text)) => {
                let named = self.cameras.iter().position(|name| name == text);
                named.or_else(|| text.parse().ok()).unwrap_or(0)
            }
            _ => 0,
        }
    }

    /// Whether something was changed that is in no file. Looking around is no change.
    pub fn is_unsaved(&self) -> bool {
        undoable(&self.edits) != self.saved
    }

    /// The edits are in a file, or nobody wants them.
    pub fn mark_saved(&mut self) {
        self.saved = undoable(&self.edits);
    }

    /// These edits are in a file; by now there may be others.
    pub fn mark_saved_as(&mut self, edits: &Edits) {
        self.saved = undoable(edits);
    }

    /// Brings a map that was read from a file.
    pub fn know(&mut self, path: PathBuf, map: Arc<EnvironmentMap>) {
        self.maps.insert(path, map);
    }

    /// Whether the scene is that of the edits.
    pub fn is_settled(&self) -> bool {
        self.edits.of_scene() == self.shown
    }

    /// Makes the scene anew where the edits ask for it.
    pub fn settle(&mut self) -> Settled {
        let wanted = self.edits.of_scene();
        if wanted == self.shown {
            return Settled::Same;
        }
        let file = wanted.sky_file();
        let map = file.as_ref().and_then(|file| self.maps.get(file));
        if let (Some(file), None) = (&file, map) {
            return Settled::Needs(file.clone());
        }
        match wanted.apply_with(&self.base, map.map(|m| &**m)) {
            Ok(scene) => {
                self.places = Places::of(&scene, &self.meshes);
                self.scene = Arc::new(scene);
                self.shown = wanted;
                Settled::Changed
            }
            Err(e) => {
                self.give_up();
                Settled::Refused(e.to_string())
            }
        }
    }

    /// Takes back what of the edits is not shown, as where a file cannot be read: to the last step if that is shown, else to the scene as it is
    /// shown, with all that does not decide it.
    pub fn give_up(&mut self) {
        let step = self.history.now().clone();
        let back = if step.of_scene() == self.shown { step } else { self.edits.with_scene_of(&self.shown) };
        let scene = self.edits.scene.clone();
        self.set_undoable(back);
        self.edits.scene = scene;
    }

    /// Notes a step, unless something is still being dragged.
    pub fn note_steps(&mut self, busy: bool) {
        self.history.observe(&undoable(&self.edits), busy);
        self.views.observe(&self.edits.camera, busy);
    }

    /// Takes the last step back. Whether there was one.
    pub fn undo(&mut self) -> bool {
        self.step(History::undo, History::redo)
    }

    /// Makes it again.
    pub fn redo(&mut self) -> bool {
        self.step(History::redo, History::undo)
    }

    /// To the next step that fits the scene: those of what a changed file has lost are passed over.
    fn step(&mut self, on: Step, back: Step) -> bool {
        self.history.observe(&undoable(&self.edits), false);
        let mut over = 0;
        while let Some(edits) = on(&mut self.history) {
            if edits.clone().fit(&self.base).is_empty() {
                self.set_undoable(edits);
                return true;
            }
            over += 1;
        }
        (0..over).for_each(|_| drop(back(&mut self.history)));
        false
    }

    fn set_undoable(&mut self, edits: Edits) {
        let camera = std::mem::take(&mut self.edits.camera);
        self.edits = edits;
        self.edits.camera = camera;
    }
}

/// A way through the steps.
type Step = fn(&mut History<Edits>) -> Option<Edits>;

/// The edits without the camera.
fn undoable(edits: &Edits) -> Edits {
    let mut edits = edits.clone();
    edits.camera = Changes::default();
    edits
}
