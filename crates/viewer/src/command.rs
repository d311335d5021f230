//! What the interface asks for, and how it is done. Panels only say what they want; all of it happens here, after everything is drawn, so
//! that no panel sees half of a change.

use crate::dialog::{Choice, Purpose};
use crate::input::Action;
use crate::leaving::Leave;
use crate::navigation;
use crate::open::FileKind;
use crate::panels::rows::Done;
use crate::picks::Why;
use crate::state::{Running, Selection, State};
use eframe::egui::{Context, ViewportCommand};
use glam::Vec3;
use lumbre::edits::{Changes, Edits, Item, Value};
use lumbre::scene::{MaterialId, NodeId};
use lumbre::session::Layer;
use std::path::PathBuf;

/// Something to be done.
#[derive(Clone, Debug)]
pub enum Command {
    /// What a key does too.
    Do(Action),
    /// A parameter was changed in a table.
    Row(Item, Done),
    /// Takes all changes of a thing back.
    Reset(Item),
    /// Picks a node or a light.
    Pick(Item),
    /// Picks a material.
    PickMaterial(MaterialId),
    /// Brings a node into view.
    Frame(NodeId),
    /// Another way to run.
    Run(Running),
    /// Opens a file.
    Open(PathBuf),
    /// Chooses a file for that.
    Ask(Purpose),
    /// Looks through one of the file's cameras, by number.
    FileCamera(usize),
    /// Goes to a bookmark.
    GoTo(usize),
    /// Removes a bookmark.
    Forget(usize),
    /// Adds a light: `point`, `spot` or `directional`.
    AddLight(&'static str),
    /// Removes a light.
    RemoveLight(Item),
    /// Copies the command that draws what is shown.
    CopyCommand,
    /// Watches the file of the scene, or not.
    Watch(bool),
    /// Factor on the speed of flying.
    Speed(f32),
    /// Shows lights in the picture, or not.
    Signs(bool),
    /// Puts the last error away.
    PutAway,
    /// Says what becomes of edits that are not saved.
    Leave(Leave),
}

/// A third of a stop.
const THIRD: f32 = 1.0 / 3.0;

impl State {
    /// Does what was asked for.
    pub fn obey(&mut self, command: Command, window: &Context) {
        match command {
            Command::Do(action) => self.act(action, window),
            Command::Row(item, done) => self.row(item, done, window),
            Command::Reset(item) => self.edit(|edits, base| edits.reset(base, item)),
            Command::Pick(item) => self.pick(item),
            Command::PickMaterial(id) => self.selection.material = Some(id),
            Command::Frame(node) => self.frame(node),
            Command::Run(running) => {
                self.announce |= running.device != self.running.device;
                self.running = running;
            }
            Command::Open(path) => self.open_file(path),
            Command::Leave(how) => self.leave(how, window),
            Command::Ask(purpose) => self.ask_for_file(purpose, window),
            Command::FileCamera(index) => self.file_camera(index),
            Command::GoTo(index) => self.go_to(index),
            Command::Forget(index) => self.edit(|edits, _| {
                if index < edits.bookmarks.len() {
                    edits.bookmarks.remove(index);
                }
                Ok(())
            }),
            Command::AddLight(kind) => self.add_light(kind),
            Command::RemoveLight(item) => self.remove_light(item),
            Command::CopyCommand => self.copy_command(window),
            Command::Watch(on) => self.watch(on, window),
            Command::Speed(speed) => self.speed = speed.clamp(0.01, 100.0),
            Command::Signs(on) => self.shown.signs = on,
            Command::PutAway => self.log.put_away(),
        }
    }

    fn row(&mut self, item: Item, done: Done, window: &Context) {
        match done {
            Done::Set(name, value) => {
                if item == Item::Camera {
                    self.stir();
                }
                // A sky from a file needs one.
                let file = (item, name, &value) == (Item::Sky, "kind", &Value::Word("file"));
                if file && !self.has_sky_file() {
                    return self.ask_for_file(Purpose::Environment, window);
                }
                self.set(item, name, value);
            }
            Done::Unset(name) => self.edit(|edits, base| edits.unset(base, item, name)),
            Done::Browse(_) => self.ask_for_file(Purpose::Environment, window),
        }
    }

    fn has_sky_file(&self) -> bool {
        let document = self.document.as_ref();
        let changes = document.and_then(|d| d.edits.changes(&d.base, Item::Sky).ok().flatten());
        changes.is_some_and(|c| c.get("file").is_some())
    }

    /// Does what a key asks for.
    pub fn act(&mut self, action: Action, window: &Context) {
        match action {
            Action::Open => self.ask_for_file(Purpose::Open, window),
            Action::SavePicture if self.document.is_some() => self.ask_for_file(Purpose::SavePicture, window),
            Action::SaveEdits if self.document.is_some() => self.ask_for_file(Purpose::SaveEdits, window),
            Action::SavePicture | Action::SaveEdits => {}
            Action::Undo => self.step(crate::document::Document::undo, "nothing to undo"),
            Action::Redo => self.step(crate::document::Document::redo, "nothing to redo"),
            Action::FrameAll => self.frame_all(),
            Action::FramePicked => self.frame_picked(),
            Action::NextCamera => self.next_camera(),
            Action::ViewBack => self.view(|views| views.undo()),
            Action::ViewForward => self.view(|views| views.redo()),
            Action::GoTo(index) => self.go_to(usize::from(index)),
            Action::Bookmark(index) => self.bookmark(usize::from(index)),
            Action::FocusByClick => self.focus_by_click = !self.focus_by_click && self.document.is_some(),
            Action::Brighter => self.brighter(THIRD),
            Action::Darker => self.brighter(-THIRD),
            Action::AutoExposure => self.auto_exposure(),
            Action::NextLayer => {
                let place = Layer::ALL.iter().position(|l| *l == self.running.layer).unwrap_or(0);
                self.running.layer = Layer::ALL[(place + 1) % Layer::ALL.len()];
                self.running.preview = false;
            }
            Action::Preview => self.running.preview = !self.running.preview,
            Action::Pause => self.running.paused = !self.running.paused,
            Action::Restart => self.running.restarts = self.running.restarts.wrapping_add(1),
            Action::Deselect => (self.selection, self.focus_by_click) = (Selection::default(), false),
            Action::Hide => self.hide(),
            Action::Remove => {
                if let Some(item @ (Item::Light(_) | Item::Added(_))) = self.selection.item {
                    self.remove_light(item);
                }
            }
            Action::Help => self.shown.help = !self.shown.help,
            Action::Panels => self.shown.bare = !self.shown.bare,
            Action::Quit => window.send_viewport_cmd(ViewportCommand::Close),
            Action::FullScreen => {
                self.full_screen = !self.full_screen;
                window.send_viewport_cmd(ViewportCommand::Fullscreen(self.full_screen));
            }
        }
    }

    fn step(&mut self, step: fn(&mut crate::document::Document) -> bool, nothing: &str) {
        let Some(document) = &mut self.document else { return };
        if !step(document) {
            self.log.note(nothing);
        }
    }

    fn view(&mut self, go: impl FnOnce(&mut crate::history::History<Changes>) -> Option<Changes>) {
        let Some(document) = &mut self.document else { return };
        // A move that has not come to rest is a step of its own.
        document.views.observe(&document.edits.camera, false);
        if let Some(camera) = go(&mut document.views) {
            document.edits.camera = camera;
            self.stir();
        }
    }

    fn frame_all(&mut self) {
        let bounds = self.document.as_ref().and_then(|d| d.places.all());
        if let (Some(bounds), Some(pose)) = (bounds, self.pose()) {
            self.set_pose(navigation::frame(pose, bounds));
        }
    }

    fn frame_picked(&mut self) {
        match self.selection.item {
            Some(Item::Node(node)) => self.frame(node),
            Some(item) => {
                let at = self.place_of(item);
                if let (Some(at), Some(pose)) = (at, self.pose()) {
                    let near = Vec3::splat(0.1 * self.radius());
                    let bounds = navigation::Bounds { min: at - near, max: at + near };
                    self.set_pose(navigation::frame(pose, bounds));
                }
            }
            None => {}
        }
    }

    /// Half the diagonal of the scene, metres.
    pub fn radius(&self) -> f32 {
        self.document.as_ref().map_or(1.0, |d| d.places.radius())
    }

    /// Where a node or a light stands: of what has a shape the middle of it.
    pub fn place_of(&self, item: Item) -> Option<Vec3> {
        let document = self.document.as_ref()?;
        match item {
            Item::Node(node) => {
                let bounds = document.places.bounds(&document.scene, node);
                bounds.map(|b| b.center()).or_else(|| document.places.origin(node))
            }
            Item::Light(_) | Item::Added(_) => {
                let camera = self.camera()?;
                let rows = document.edits.rows(&document.base, &camera, item).ok()?;
                let row = rows.into_iter().find(|r| r.name == "position")?;
                if let Value::Vector(at) = row.value { Some(at) } else { None }
            }
            _ => None,
        }
    }

    fn file_camera(&mut self, index: usize) {
        let Some(document) = &mut self.document else { return };
        let mut changes = Edits::default();
        let text = Value::Text(index.to_string());
        if changes.set(&document.base, Item::Camera, "camera", text).is_ok() {
            document.edits.camera = changes.camera;
        }
        self.stir();
        self.measure_reach();
    }

    fn next_camera(&mut self) {
        let Some(document) = &self.document else { return };
        let count = document.cameras.len();
        if count == 0 {
            return self.log.note("the scene has no camera");
        }
        let at = document.camera();
        // Back to the camera itself before the next one, where one has walked away from it.
        let walked = document.edits.camera.get("eye").is_some();
        self.file_camera(if walked { at } else { (at + 1) % count });
    }

    fn go_to(&mut self, index: usize) {
        let Some(document) = &mut self.document else { return };
        if let Some(bookmark) = document.edits.bookmarks.get(index) {
            document.edits.camera = bookmark.changes.clone();
            self.stir();
        }
    }

    /// Keeps where the camera is, in the place of that bookmark or after the last one.
    fn bookmark(&mut self, index: usize) {
        let Some(document) = &mut self.document else { return };
        let camera = document.edits.camera.clone();
        match document.edits.bookmarks.get_mut(index) {
            Some(bookmark) => bookmark.changes = camera,
            None => {
                document.edits.add_bookmark("view", camera);
            }
        }
        let number = index.min(document.edits.bookmarks.len() - 1) + 1;
        self.log.note(format!("bookmark {number} set; {number} comes back to it"));
    }

    fn brighter(&mut self, by: f32) {
        let look = self.look();
        match look.look.exposure {
            lumbre::core::color::Exposure::Ev(ev) => {
                self.set(Item::Look, "exposure", Value::Number(thirds(ev + by)))
            }
            _ => self.set(Item::Look, "exposureOffset", Value::Number(thirds(look.offset_ev + by))),
        }
    }

    /// By itself, or held as it is.
    fn auto_exposure(&mut self) {
        let held = matches!(self.look().look.exposure, lumbre::core::color::Exposure::Ev(_));
        let value = if held { Value::Word("auto") } else { Value::Number(self.stats.exposure_ev) };
        self.set(Item::Look, "exposure", value);
        if !held {
            self.edit(|edits, base| edits.unset(base, Item::Look, "exposureOffset"));
        }
    }

    fn hide(&mut self) {
        let Some(item) = self.selection.item else { return };
        let Some(document) = &self.document else { return };
        match item {
            Item::Node(node) => {
                let visible = document.scene.nodes.get(node.index()).is_some_and(|n| n.visible);
                self.set(item, "visible", Value::Flag(!visible));
            }
            Item::Light(_) | Item::Added(_) => {
                let changes = document.edits.changes(&document.base, item).ok().flatten();
                let on = !matches!(changes.and_then(|c| c.get("on")), Some(Value::Flag(false)));
                self.set(item, "on", Value::Flag(!on));
            }
            _ => {}
        }
    }

    fn pick(&mut self, item: Item) {
        self.selection.item = Some(item);
        // What is picked by name has the material of its first part.
        let Some(document) = &self.document else { return };
        if let Item::Node(node) = item {
            let mesh = document.scene.nodes.get(node.index()).and_then(|n| n.mesh);
            let mesh = mesh.and_then(|m| document.scene.meshes.get(m.index()));
            self.selection.material = mesh.and_then(|m| m.primitives.iter().find_map(|p| p.material));
        }
    }

    /// Adds a light near what is looked at, as bright as fits the exposure, and picks it.
    fn add_light(&mut self, kind: &'static str) {
        let Some(pose) = self.pose() else { return };
        let camera = pose.camera;
        let above = camera.up * (0.35 * pose.reach);
        let position = camera.origin + camera.forward * (0.6 * pose.reach) + above;
        let direction = (pose.pivot() - position).normalize_or(Vec3::NEG_Y);
        // A white surface at what is looked at comes out in a light grey.
        let radiance = 0.5 / self.stats.exposure_ev.exp2();
        let lux = std::f32::consts::PI * radiance;
        let intensity =
            if kind == "directional" { lux } else { lux * (pose.pivot() - position).length_squared() };
        let mut added = None;
        self.edit(|edits, base| {
            let item = edits.add_light(kind);
            added = Some(item);
            edits.set(base, item, "kind", Value::Word(kind))?;
            edits.set(base, item, "intensity", Value::Number(two_digits(intensity)))?;
            edits.set(base, item, "position", Value::Vector(position))?;
            edits.set(base, item, "direction", Value::Vector(direction))
        });
        self.selection = Selection { item: added, material: None };
        self.unfold = Some("Lights");
    }

    fn remove_light(&mut self, item: Item) {
        self.edit(|edits, base| edits.remove_light(base, item));
        // The numbers of added lights move up.
        self.selection.item = None;
    }

    /// What the file dialog ended with.
    pub fn chosen(&mut self, choice: Choice) {
        self.dialog = None;
        let Choice::File(purpose, path) = choice else {
            self.copies = false;
            return;
        };
        match purpose {
            Purpose::Open => self.open_file(path),
            Purpose::Environment => self.loader.open_environment(&path),
            Purpose::SavePicture => self.save_picture(path),
            Purpose::SaveEdits => self.save_edits(path),
        }
    }

    /// Files that were dropped on the window.
    pub fn dropped(&mut self, paths: Vec<PathBuf>) {
        let (scenes, others): (Vec<_>, Vec<_>) =
            paths.into_iter().partition(|p| FileKind::of(p) == FileKind::Scene);
        if scenes.len() > 1 {
            self.log.note("several scenes were dropped; the last one is opened");
        }
        match scenes.into_iter().next_back() {
            Some(scene) => {
                // The others are for that one.
                self.with_scene = Some((scene.clone(), others));
                self.open_file(scene);
            }
            None => others.into_iter().for_each(|path| self.open_file(path)),
        }
    }

    /// A place of the picture was clicked, 0 to 1 along each axis.
    pub fn clicked(&mut self, at: [f32; 2], twice: bool) {
        let why = match (std::mem::take(&mut self.focus_by_click), twice) {
            (true, _) => Why::Focus,
            (false, true) => Why::Frame,
            (false, false) => Why::Select,
        };
        self.picks.ask(at, why);
    }
}

/// Without what adding thirds leaves behind.
fn thirds(ev: f32) -> f32 {
    (ev * 3.0).round() / 3.0
}

/// Two digits are enough for a light that nobody has asked for in numbers.
fn two_digits(x: f32) -> f32 {
    if !(x > 0.0 && x.is_finite()) {
        return 1.0;
    }
    let unit = 10f32.powf(x.log10().floor() - 1.0);
    (x / unit).round() * unit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_nobody_asked_for_are_round() {
        assert_eq!(two_digits(1234.5), 1200.0);
        assert!((two_digits(0.018_76) - 0.019).abs() < 1e-6);
        assert_eq!([two_digits(0.0), two_digits(f32::NAN), two_digits(f32::INFINITY)], [1.0; 3]);
        assert_eq!(thirds(0.333 + 0.333 + 0.333), 1.0);
    }
}
