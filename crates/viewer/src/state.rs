//! What the interface holds, and what it wants to see: [`State::wanted`] is all that the render thread is told.

use crate::dialog::{Dialog, Purpose};
use crate::document::Document;
use crate::leaving::Leaving;
use crate::log::Log;
use crate::meter::Meter;
use crate::navigation::{Pose, overview};
use crate::open::{Loader, OpenedScene};
use crate::picks::{Picks, Why};
use crate::recent::Recent;
use crate::shot::{Found, aspect_of, write_extent, write_pose};
use crate::watch::Watch;
use glam::Vec3;
use lumbre::camera::DEFAULT_FOV;
use lumbre::core::Camera;
use lumbre::core::settings::RenderSettings;
use lumbre::edits::{Changes, Edits, EditsError, Item, LookEdits, Value};
use lumbre::scene::{EnvironmentMap, MaterialId, NodeId, Scene};
use lumbre::session::{Event, FrameStats, Layer, Picked, ViewLook, Wanted};
use lumbre::{Device, LoadOptions, Look};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What of a render is not part of the picture, and so of no file of edits.
#[derive(Clone, Debug, PartialEq)]
pub struct Running {
    /// What draws.
    pub device: Device,
    /// Samples of each pixel from one frame to the next.
    pub samples_per_frame: u32,
    /// Samples of each pixel after which it rests.
    pub limit: u32,
    /// It rests.
    pub paused: bool,
    /// How many times it was begun anew.
    pub restarts: u32,
    /// What is shown.
    pub layer: Layer,
    /// Normals alone, without any light.
    pub preview: bool,
    /// Automatic exposure follows slowly.
    pub eased: bool,
    /// The window waits for the display.
    pub vsync: bool,
}

impl Default for Running {
    fn default() -> Self {
        Running {
            device: Device::Auto,
            samples_per_frame: 1,
            limit: 4096,
            paused: false,
            restarts: 0,
            layer: Layer::Picture,
            preview: false,
            eased: true,
            vsync: true,
        }
    }
}

/// What is picked.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Selection {
    /// A node or a light.
    pub item: Option<Item>,
    /// A material.
    pub material: Option<MaterialId>,
}

/// Edits that were opened: their file, they, and the camera before them.
pub(crate) struct Arriving {
    pub(crate) path: PathBuf,
    pub(crate) edits: Edits,
    pub(crate) camera: Changes,
}

/// A scene that another has taken the place of, and the file of its edits.
struct Before {
    document: Document,
    edits_file: Option<PathBuf>,
    filed: Option<Edits>,
}

/// Which parts of the window are shown.
#[derive(Clone, Debug, Default)]
pub struct Shown {
    /// All panels are away.
    pub bare: bool,
    /// The help.
    pub help: bool,
    /// Lights have signs in the picture.
    pub signs: bool,
}

/// All that the interface holds.
pub struct State {
    /// The open scene.
    pub document: Option<Document>,
    /// How it is rendered, but for what edits say.
    pub running: Running,
    /// What is picked.
    pub selection: Selection,
    /// The panel that is to be unfolded.
    pub(crate) unfold: Option<&'static str>,
    /// What is asked of the session.
    pub picks: Picks,
    /// Columns and rows of the picture, pixels.
    pub size: [u32; 2],
    /// Distance of what is looked at, metres, where the camera does not say it.
    reach: f32,
    /// What lies in the centre of the picture, metres along the direction of view.
    pub auto_focus: Option<f32>,
    /// The next click says what is sharp.
    pub focus_by_click: bool,
    /// Factor on the speed of flying.
    pub speed: f32,
    /// When something last moved.
    stirred: Option<Instant>,
    /// The mouse holds the picture.
    pub held: bool,
    /// How the last frame was made.
    pub stats: FrameStats,
    /// What the session is busy with before there are frames.
    pub preparing: Option<String>,
    /// What it takes that from.
    pub meter: Meter,
    /// What happened.
    pub log: Log,
    /// Scenes that were opened before.
    pub recent: Recent,
    /// The file dialog, while it is open.
    pub dialog: Option<Dialog>,
    /// Opens files.
    pub loader: Loader,
    /// Which parts of the window are shown.
    pub shown: Shown,
    /// The file is watched.
    pub watching: bool,
    watch: Option<Watch>,
    /// What waits until it is known what becomes of edits that are not saved.
    pub leaving: Option<Leaving>,
    /// Where edits were saved, or read.
    pub edits_file: Option<PathBuf>,
    /// What that file holds.
    pub(crate) filed: Option<Edits>,
    /// The command is to be copied once the edits are written.
    pub(crate) copies: bool,
    /// Where pictures are saved.
    pub picture_file: Option<PathBuf>,
    /// Where the picture is to be saved, until the session is told.
    pub(crate) picture_to_save: Option<PathBuf>,
    /// A scene that was asked for, and the edits and surroundings that are to be opened once it is there.
    pub with_scene: Option<(PathBuf, Vec<PathBuf>)>,
    /// Edits that were opened, until it is known that they fit.
    pub(crate) arriving: Option<Arriving>,
    /// Edits are being written.
    pub(crate) writing: bool,
    /// Where they are to be written after that.
    pub(crate) next_file: Option<PathBuf>,
    /// What there was before the last scene that was opened, until that is on the device.
    before: Option<Before>,
    /// Devices of this machine, once they are known.
    pub devices: Vec<(String, Device)>,
    /// The window is to fill the screen, or not to.
    pub full_screen: bool,
    /// Another scene or device is on its way, which is worth a line once it is there.
    pub announce: bool,
    /// Scenes that were opened so far.
    opened: u64,
    found: Found,
}

/// After this long without a move it is over.
pub const REST: Duration = Duration::from_millis(150);

impl State {
    /// Without a scene.
    pub fn new(options: LoadOptions, running: Running, recent: Recent) -> Self {
        State {
            document: None,
            running,
            selection: Selection::default(),
            unfold: None,
            picks: Picks::default(),
            size: [0, 0],
            reach: 1.0,
            auto_focus: None,
            focus_by_click: false,
            speed: 1.0,
            stirred: None,
            held: false,
            stats: FrameStats::default(),
            preparing: None,
            meter: Meter::default(),
            log: Log::default(),
            recent,
            dialog: None,
            loader: Loader::new(options),
            shown: Shown { signs: true, ..Shown::default() },
            watching: false,
            watch: None,
            leaving: None,
            edits_file: None,
            filed: None,
            copies: false,
            picture_file: None,
            picture_to_save: None,
            with_scene: None,
            writing: false,
            next_file: None,
            arriving: None,
            before: None,
            devices: Vec::new(),
            full_screen: false,
            announce: false,
            opened: 0,
            found: Found::default(),
        }
    }

    /// Shows a scene that was opened.
    pub fn open(&mut self, opened: OpenedScene, window: &eframe::egui::Context) {
        opened.notes.iter().for_each(|note| self.log.note(note.clone()));
        self.log.put_away();
        let again = opened.again && self.document.as_ref().is_some_and(|d| d.path == opened.path);
        if !again {
            self.recent.add(&opened.path);
        }
        let path = opened.path.clone();
        let old = self.document.take();
        // One that has not been on the device yet is nothing to go back to.
        if self.before.is_none() {
            let (edits_file, filed) = (self.edits_file.clone(), self.filed.clone());
            self.before = old.clone().map(|document| Before { document, edits_file, filed });
        }
        let document = match old {
            Some(old) if again => {
                let (document, gone) = old.reloaded(opened);
                gone.into_iter().for_each(|line| self.log.error(format!("taken back: {line}")));
                document
            }
            _ => {
                self.forget_files();
                self.selection = Selection::default();
                self.opened += 1;
                self.loader.document = self.opened;
                Document::new(opened, self.opened)
            }
        };
        self.document = Some(document);
        self.announce = true;
        self.picks.clear();
        self.watch = self.watching.then(|| Watch::of(&path, window.clone()));
        if !again {
            self.first_view();
        }
    }

    /// No files belong to what is shown, and none is on its way.
    fn forget_files(&mut self) {
        (self.edits_file, self.filed, self.next_file, self.copies) = (None, None, None, false);
        self.arriving = None;
    }

    /// Sets the camera of a scene that was just opened: its own, or all of it in view.
    fn first_view(&mut self) {
        self.auto_focus = None;
        let Some(document) = &mut self.document else { return };
        if document.cameras.is_empty() {
            let pose = overview(document.places.all(), DEFAULT_FOV, aspect_of(self.size));
            write_pose(&mut document.edits, &document.base, &pose);
            document.views = crate::history::History::new(document.edits.camera.clone());
        }
        self.measure_reach();
    }

    /// How far what is looked at is, where nothing says so: the middle of the scene, or what is sharp.
    pub fn measure_reach(&mut self) {
        let Some(camera) = self.camera() else { return };
        let Some(document) = &self.document else { return };
        let center = document.places.all().map_or(Vec3::ZERO, |b| b.center());
        let radius = document.places.radius();
        let along = (center - camera.origin).dot(camera.forward);
        self.reach = if camera.lens_radius > 0.0 { camera.focus_distance } else { along.max(0.2 * radius) };
    }

    /// Looks whether the file of the scene has changed.
    pub fn look_at_file(&mut self) {
        let changed = self.watch.as_ref().is_some_and(Watch::changed);
        if let (true, Some(document)) = (changed, &self.document) {
            let (path, options) = (document.path.clone(), document.options.clone());
            self.loader.open_again(&path, options);
        }
    }

    /// Begins or ends to watch the file.
    pub fn watch(&mut self, on: bool, window: &eframe::egui::Context) {
        self.watching = on;
        let path = self.document.as_ref().map(|d| d.path.clone());
        self.watch = path.filter(|_| on).map(|path| Watch::of(&path, window.clone()));
    }

    /// The camera that looks; `None` without a scene.
    pub fn camera(&self) -> Option<Camera> {
        let document = self.document.as_ref()?;
        let mut camera = self.found.get(document, aspect_of(self.size));
        if self.focuses_by_itself() {
            camera.focus_distance = self.auto_focus.unwrap_or(self.reach);
        }
        Some(camera)
    }

    /// The camera, and how far what it looks at is.
    pub fn pose(&self) -> Option<Pose> {
        let camera = self.camera()?;
        let target = self.document.as_ref()?.edits.camera_options().look_at;
        let reach = target.map_or(self.reach, |target| (target - camera.origin).length());
        Some(Pose { camera, reach: reach.max(1e-6) })
    }

    /// Looks at something nearer or farther in the same direction. While nothing moves this must not touch the edits: the same camera from
    /// another target has other last digits.
    fn look_at(&mut self, pose: Pose) {
        if self.held {
            self.set_pose(pose);
        } else {
            self.reach = pose.reach;
        }
    }

    /// Moves the camera.
    pub fn set_pose(&mut self, pose: Pose) {
        let Some(before) = self.pose() else { return };
        if before == pose {
            return;
        }
        self.stir();
        self.reach = pose.reach;
        let Some(document) = &mut self.document else { return };
        if before.camera.projection != pose.camera.projection {
            write_extent(&mut document.edits, &document.base, pose.camera.projection);
        }
        write_pose(&mut document.edits, &document.base, &pose);
    }

    /// Whether the lens is open and focuses on the centre.
    pub fn focuses_by_itself(&self) -> bool {
        self.document.as_ref().is_some_and(|d| {
            let changes = &d.edits.camera;
            let open = changes.get("aperture").is_some_and(|v| !matches!(v, Value::Word(_)));
            open && !matches!(changes.get("focus"), Some(Value::Number(_)))
        })
    }

    /// Sets a parameter; what is wrong is logged.
    pub fn set(&mut self, item: Item, name: &str, value: Value) {
        self.edit(|edits, base| edits.set(base, item, name, value));
    }

    /// Edits the document; what is wrong is logged.
    pub fn edit(&mut self, with: impl FnOnce(&mut Edits, &Scene) -> Result<(), EditsError>) {
        let Some(document) = &mut self.document else { return };
        if let Err(e) = with(&mut document.edits, &document.base) {
            self.log.error(e.to_string());
        }
    }

    /// Something moves.
    pub fn stir(&mut self) {
        self.stirred = Some(Instant::now());
    }

    /// Whether something moves, or moved a moment ago.
    pub fn is_moving(&self) -> bool {
        self.held || self.stirred.is_some_and(|at| at.elapsed() < REST)
    }

    /// Whether something moved and rests now: asked once for each move.
    pub fn came_to_rest(&mut self) -> bool {
        let rests = self.stirred.is_some() && !self.is_moving();
        if rests {
            self.stirred = None;
        }
        rests
    }

    /// The look, with what was changed of it.
    pub fn look(&self) -> LookEdits {
        self.document.as_ref().map_or_else(LookEdits::default, |d| d.edits.look(LookEdits::default()))
    }

    /// All that is to be drawn; `None` without a scene or a place to show it.
    pub fn wanted(&self) -> Option<Wanted> {
        let document = self.document.as_ref()?;
        let camera = self.camera()?;
        if self.size.contains(&0) {
            return None;
        }
        let running = &self.running;
        let look = self.look();
        let mut settings = document.edits.settings(RenderSettings::default());
        let transparent = settings.transparent_background;
        if running.preview {
            settings = RenderSettings { max_depth: Some(0), light_sampling: false, ..settings };
        }
        Some(Wanted {
            scene: document.scene.clone(),
            camera,
            size: self.size,
            settings,
            samples_per_frame: running.samples_per_frame,
            limit: if running.preview { running.limit.min(PREVIEW_SAMPLES) } else { running.limit },
            paused: running.paused,
            restarts: running.restarts,
            moving: self.is_moving(),
            look: ViewLook {
                look: Look { transparent, ..look.look },
                eased: running.eased,
                offset_ev: look.offset_ev,
            },
            layer: if running.preview { Layer::Normal } else { running.layer },
            device: running.device.clone(),
        })
    }

    /// Something happened in the session.
    pub fn happened(&mut self, event: Event, window: &eframe::egui::Context) {
        match event {
            Event::Preparing(what) => self.preparing = Some(what),
            Event::Prepared { device, seconds, scene } => {
                self.preparing = None;
                if self.shows(&scene) {
                    self.before = None;
                }
                self.picks.ask([0.5; 2], Why::Pivot);
                if std::mem::take(&mut self.announce) {
                    self.log.note(format!("on {device} in {seconds:.2} s"));
                }
            }
            Event::Refused { scene, reason } => {
                self.preparing = None;
                if self.shows(&scene) {
                    self.go_back(window);
                }
                self.log.error(reason);
            }
            Event::Notice(text) => self.log.note(text),
            Event::Failed(text) => self.log.error(text),
            Event::Picked(found) => self.picked(found),
            Event::Saved(path) => self.log.note(format!("saved {}", path.display())),
        }
    }

    /// Whether a scene is what is open, edited or not.
    fn shows(&self, scene: &Scene) -> bool {
        self.document.as_ref().is_some_and(|d| Arc::ptr_eq(&d.base.meshes, &scene.meshes))
    }

    /// What is open cannot be drawn: back to the scene before, if there is one.
    fn go_back(&mut self, window: &eframe::egui::Context) {
        let Some(Before { document: before, edits_file, filed }) = self.before.take() else { return };
        let Some(refused) = self.document.take() else { return };
        if refused.number == before.number {
            self.document = Some(refused.back_to(before));
        } else {
            self.recent.remove(&refused.path);
            self.forget_files();
            self.selection = Selection::default();
            (self.edits_file, self.filed) = (edits_file, filed);
            self.loader.document = before.number;
            self.document = Some(before);
            // The file that is watched is the other one.
            self.watch(self.watching, window);
        }
        self.measure_reach();
    }

    /// An answer of the session.
    fn picked(&mut self, found: Option<Picked>) {
        let Some(why) = self.picks.answered() else { return };
        let Some(pose) = self.pose() else { return };
        let along =
            found.map(|p| (p.point - pose.camera.origin).dot(pose.camera.forward)).filter(|d| *d > 0.0);
        match (why, found) {
            (Why::AutoFocus, _) => self.auto_focus = along.or(Some(FAR)),
            (Why::Pivot, _) => {
                if let Some(reach) = along {
                    self.look_at(Pose { reach, ..pose });
                }
            }
            (Why::Focus, _) => {
                if let Some(along) = along {
                    self.set(Item::Camera, "focus", Value::Number(along));
                    self.log.note(format!("focus: {along:.3} m"));
                }
            }
            (Why::Select | Why::Frame, None) => self.selection = Selection::default(),
            (Why::Select | Why::Frame, Some(picked)) => {
                let material = picked.material;
                self.selection = Selection { item: Some(Item::Node(picked.node)), material };
                self.unfold = Some("Material");
                if why == Why::Frame {
                    self.frame(picked.node);
                }
            }
        }
    }

    /// Brings a node into view.
    pub fn frame(&mut self, node: NodeId) {
        let Some(document) = &self.document else { return };
        let bounds = document.places.bounds(&document.scene, node);
        if let (Some(bounds), Some(pose)) = (bounds, self.pose()) {
            self.set_pose(crate::navigation::frame(pose, bounds));
        }
    }

    /// A picture of the surroundings was read: it becomes the sky, unless it is already.
    pub fn use_environment(&mut self, path: PathBuf, map: Arc<EnvironmentMap>) {
        let Some(document) = &mut self.document else {
            return self.log.error("an environment lights a scene: open that first");
        };
        let wanted = document.edits.sky_file().is_some_and(|file| file == path);
        document.know(path.clone(), map);
        if wanted {
            return;
        }
        self.edit(|edits, base| {
            let name = path.to_string_lossy().into_owned();
            edits.set(base, Item::Sky, "kind", Value::Word("file"))?;
            edits.set(base, Item::Sky, "file", Value::Text(name))?;
            // A picture of the sky has its own sun.
            edits.set(base, Item::Sun, "on", Value::Flag(false))
        });
    }

    /// Opens the file dialog.
    pub fn ask_for_file(&mut self, purpose: Purpose, window: &eframe::egui::Context) {
        self.copies &= purpose == Purpose::SaveEdits;
        let scene =
            self.document.as_ref().map(|d| d.path.clone()).or_else(|| self.recent.paths().first().cloned());
        let beside = |ending: &str| scene.as_ref().map(|path| path.with_extension(ending));
        let at = match purpose {
            Purpose::Open | Purpose::Environment => scene.clone(),
            Purpose::SavePicture => self.picture_file.clone().or_else(|| beside("png")),
            Purpose::SaveEdits => self.edits_file.clone().or_else(|| beside("edits.json")),
        };
        let at = at.or_else(|| std::env::current_dir().ok()).unwrap_or_else(|| PathBuf::from("."));
        self.dialog = Some(Dialog::open(purpose, &at, window));
    }
}

/// Samples after which the preview rests.
const PREVIEW_SAMPLES: u32 = 8;
/// Distance that stands for infinity, metres, as in `lumbre render`.
const FAR: f32 = 1e5;
