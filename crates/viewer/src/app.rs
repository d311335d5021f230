//! The window's contents: takes what came, shows it, does what was asked for, and tells the render thread what is wanted now. Nothing in here
//! waits: files are opened and scenes are rendered on threads of their own, and how long a step took is measured ([`Meter`]).
//!
//! [`Meter`]: crate::meter::Meter

use crate::command::Command;
use crate::document::Settled;
use crate::input;
use crate::open::Opened;
use crate::panels;
use crate::picture::{self, Picture};
use crate::report::{Report, Step};
use crate::sink::Sink;
use crate::state::{Arriving, REST, State};
use eframe::egui::{self, CentralPanel, Context, Event as Input, Frame, Panel, Rect, Ui, ViewportCommand};
use lumbre::session::{FrameSink, FrameStats, Layer, Session, Wanted};
use lumbre::{Device, GpuOptions};
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// What renders: a [`Session`], or what stands in for it in tests.
pub trait Renders {
    /// Says what is wanted, and returns its number.
    fn set(&self, wanted: Wanted) -> u64;
    /// Asks what stands at a place of the view, 0 to 1 along each axis.
    fn pick(&self, at: [f32; 2]);
    /// Writes the picture.
    fn save(&self, path: PathBuf);
}

impl Renders for Session {
    fn set(&self, wanted: Wanted) -> u64 {
        Session::set(self, wanted)
    }
    fn pick(&self, at: [f32; 2]) {
        Session::pick(self, at);
    }
    fn save(&self, path: PathBuf) {
        Session::save(self, path);
    }
}

/// Begins to render.
pub type Start = Box<dyn Fn(Wanted, Arc<dyn FrameSink>) -> Box<dyn Renders>>;

/// A session of the library.
pub fn session(gpu: GpuOptions) -> Start {
    Box::new(move |wanted, sink| Box::new(Session::start(wanted, gpu, sink)))
}

/// The contents of the window.
pub struct App {
    /// What the interface holds.
    pub state: State,
    picture: Picture,
    sink: Arc<Sink>,
    start: Start,
    session: Option<Box<dyn Renders>>,
    /// What the session was told last.
    told: Option<Wanted>,
    /// What it was told, with the number and the time, until a frame shows it.
    sent: VecDeque<(u64, Instant)>,
    devices: Option<Receiver<Vec<(String, Device)>>>,
    report: Option<Report>,
    /// The wish that the frame on the screen shows.
    number: u64,
    /// The last wish.
    wish: u64,
    title: String,
    /// Whether this window waits for the display, and whether it is closed to be opened in the other way.
    vsync: bool,
    reopens: bool,
}

impl App {
    /// A window that renders by `start`.
    pub fn new(state: State, start: Start) -> Self {
        App {
            state,
            picture: Picture::default(),
            sink: Arc::default(),
            start,
            session: None,
            told: None,
            sent: VecDeque::new(),
            devices: None,
            report: None,
            number: 0,
            wish: 0,
            title: String::new(),
            vsync: true,
            reopens: false,
        }
    }

    /// Writes down what it does from now on.
    pub fn report(&mut self, report: Report) {
        self.report = Some(report);
    }

    /// Belongs to a window from now on.
    pub fn enter(&mut self, window: &Context) {
        crate::theme::set(window);
        if let Some(report) = &self.report {
            report.follow(window);
        }
        self.sink.wake(window);
        self.state.loader.wake(window);
        // Those of the last window are gone with it.
        self.picture = Picture::default();
        self.title.clear();
        self.told = None;
        (self.vsync, self.reopens) = (self.state.running.vsync, false);
    }

    /// Whether the window was closed to be opened anew in another way.
    pub fn reopens(&self) -> bool {
        self.reopens
    }

    /// Looks for the devices of this machine, which takes a moment.
    pub fn look_for_devices(&mut self) {
        let (send, receive) = channel();
        let sink = self.sink.clone();
        let look = move || {
            let found = lumbre::devices().list.into_iter().filter(|d| d.lacks.is_empty());
            let _ = send.send(found.map(|d| (d.name, d.device)).collect());
            sink.tell();
        };
        if std::thread::Builder::new().name("devices".into()).spawn(look).is_ok() {
            self.devices = Some(receive);
        }
    }

    /// Takes what came from other threads. Also for a window that is hidden.
    pub fn receive(&mut self, window: &Context) {
        let now = Instant::now();
        let news = self.sink.take();
        news.made.iter().for_each(|made| self.state.meter.made(made, now));
        if let Some(frame) = news.frame {
            self.picture.set(window, &frame);
            self.state.meter.shown(now);
            self.answered(frame.number, now);
            self.number = frame.number;
            // Other layers have no exposure.
            let exposure_ev = match self.state.running.layer {
                Layer::Picture if !self.state.running.preview => frame.stats.exposure_ev,
                _ => self.state.stats.exposure_ev,
            };
            self.state.stats = FrameStats { exposure_ev, ..frame.stats };
        }
        news.events.into_iter().for_each(|event| self.state.happened(event, window));
        for (number, opened) in self.state.loader.take() {
            self.opened(number, opened, window);
        }
        self.state.look_at_file();
        if let Some(found) = self.devices.as_ref().and_then(|d| d.try_recv().ok()) {
            self.state.devices = found;
            self.devices = None;
        }
        self.state.meter.tick(now);
    }

    /// How long it took from a wish to the first frame that has it.
    fn answered(&mut self, number: u64, now: Instant) {
        while self.sent.front().is_some_and(|(sent, _)| *sent <= number) {
            if let Some((_, at)) = self.sent.pop_front() {
                self.state.meter.answered(now.saturating_duration_since(at));
            }
        }
    }

    /// Something that was asked for when the scene of this number was open.
    fn opened(&mut self, number: u64, opened: Opened, window: &Context) {
        let state = &mut self.state;
        let is_of_use = state.document.as_ref().is_none_or(|d| d.number == number);
        match opened {
            Opened::Scene(opened) => {
                let (path, again) = (opened.path.clone(), opened.again);
                state.open(*opened, window);
                let with = state.with_scene.take_if(|(scene, _)| *scene == path && !again);
                with.into_iter().flat_map(|(_, files)| files).for_each(|file| state.loader.open(&file));
            }
            Opened::Failed { path, reason } => {
                state.recent.remove(&path);
                state.log.error(reason);
                state.with_scene.take_if(|(scene, _)| *scene == path);
                // A sky that cannot be read.
                if let Some(document) = &mut state.document
                    && is_of_use
                    && document.edits.sky_file().is_some_and(|file| file == path)
                {
                    document.give_up();
                    state.refuse_edits();
                }
            }
            Opened::Written { path, edits } => state.edits_written(path, *edits, number, window),
            Opened::NotWritten(reason) => state.edits_not_written(reason),
            // For the scene that was there before.
            Opened::Environment { .. } | Opened::Edits { .. } if !is_of_use => {}
            Opened::Environment { path, map, notes } => {
                notes.into_iter().for_each(|note| state.log.note(note));
                state.use_environment(path, map);
            }
            Opened::Edits { path, edits } => match &mut state.document {
                Some(document) => {
                    let camera = document.edits.camera.clone();
                    state.arriving = Some(Arriving { path, edits: (*edits).clone(), camera });
                    document.replace_edits(*edits);
                    state.stir();
                }
                None => state.log.error("edits belong to a scene: open that first"),
            },
        }
    }

    /// One step of the interface: shows everything, and does what was asked for. `last`: how long the step before took as a whole,
    /// with what is beyond this program; `None` where nobody knows.
    pub fn show(&mut self, ui: &mut Ui, last: Option<Duration>) {
        let began = Instant::now();
        let window = ui.ctx().clone();
        let mut commands = self.keys(&window);
        let rect = self.layout(ui, &mut commands);
        self.windows(&window, rect, &mut commands);
        let dropped =
            window.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_path_buf()).collect::<Vec<_>>());
        self.state.dropped(dropped);
        commands.into_iter().for_each(|command| self.state.obey(command, &window));
        self.settle(&window);
        self.tell(&window);
        if window.input(|i| i.viewport().close_requested()) && !self.reopens && !self.state.may_close() {
            window.send_viewport_cmd(ViewportCommand::CancelClose);
        }
        if self.state.running.vsync != self.vsync && !self.reopens {
            self.reopens = true;
            window.send_viewport_cmd(ViewportCommand::Close);
        }
        let interface = began.elapsed();
        self.state.meter.updated(last.unwrap_or(interface));
        if let Some(report) = &self.report {
            let stats = &self.state.stats;
            let step = Step {
                began: Some(began),
                interface,
                last: last.unwrap_or_default(),
                spp: stats.spp,
                scale: stats.scale,
                number: self.number,
                wish: self.wish,
                device: stats.device.clone(),
                log: Vec::new(),
            };
            report.step(step, &self.state.log);
        }
    }

    fn keys(&self, window: &Context) -> Vec<Command> {
        if self.state.dialog.is_some() || self.state.leaving.is_some() || window.text_edit_focused() {
            return Vec::new();
        }
        let pressed = window.input(|i| {
            let pressed = i.events.iter().filter_map(|event| match event {
                Input::Key { key, pressed: true, repeat, modifiers, .. } => Some((*key, *modifiers, *repeat)),
                _ => None,
            });
            pressed.collect::<Vec<_>>()
        });
        let action = |(key, with, repeat): (egui::Key, egui::Modifiers, bool)| {
            let action = input::action(key, with)?;
            // Brightness goes on while its key is held; all else happens once.
            let steady = matches!(action, input::Action::Brighter | input::Action::Darker);
            (!repeat || steady).then_some(Command::Do(action))
        };
        pressed.into_iter().filter_map(action).collect()
    }

    /// The panels and the picture; where the picture is.
    fn layout(&mut self, ui: &mut Ui, commands: &mut Vec<Command>) -> Rect {
        let state = &mut self.state;
        if !state.shown.bare {
            Panel::top("menu").show(ui, |ui| panels::menu(ui, state, commands));
            Panel::bottom("status").show(ui, |ui| panels::status(ui, state));
            Panel::right("side")
                .default_size(SIDE)
                .min_size(240.0)
                .show(ui, |ui| panels::side_bar(ui, state, commands));
            state.unfold = None;
        }
        let picture = &mut self.picture;
        CentralPanel::default().frame(Frame::NONE).show(ui, |ui| picture.show(ui, state)).inner
    }

    /// What floats over the rest.
    fn windows(&mut self, window: &Context, rect: Rect, commands: &mut Vec<Command>) {
        let state = &mut self.state;
        if state.document.is_none() || !self.picture.is_there() {
            panels::welcome(window, state, rect, commands);
        }
        panels::banner(window, state, rect, commands);
        if state.shown.help {
            state.shown.help = panels::help(window);
        }
        panels::leaving(window, state, commands);
        if let Some(mut dialog) = state.dialog.take() {
            match dialog.show(window, state.recent.paths()) {
                None => state.dialog = Some(dialog),
                Some(choice) => state.chosen(choice),
            }
        }
    }

    /// Flies, makes the scene of the edits, notes steps for undo.
    fn settle(&mut self, window: &Context) {
        let busy = window.input(|i| i.pointer.any_down()) || window.text_edit_focused();
        let state = &mut self.state;
        if state.dialog.is_none() && !window.text_edit_focused() {
            picture::flown(window, state);
        }
        let Some(document) = &mut state.document else { return };
        match document.settle() {
            Settled::Same => {}
            Settled::Changed if busy => state.stir(),
            Settled::Changed => {}
            Settled::Needs(file) => {
                if !state.loader.is_opening(&file) {
                    state.loader.open_environment(&file);
                }
            }
            Settled::Refused(reason) => {
                state.log.error(reason);
                state.refuse_edits();
            }
        }
        state.accept_edits();
        let moving = state.is_moving();
        if let Some(document) = &mut state.document {
            document.note_steps(busy || moving);
        }
        if state.came_to_rest() && state.focuses_by_itself() {
            state.picks.ask([0.5; 2], crate::picks::Why::AutoFocus);
        }
        if moving {
            window.request_repaint_after(REST + Duration::from_millis(10));
        }
    }

    /// Tells the session what is wanted, if that is something else than before.
    fn tell(&mut self, window: &Context) {
        let title = match &self.state.document {
            Some(document) => {
                format!("{} - Lumbre", document.path.file_name().unwrap_or_default().to_string_lossy())
            }
            None => "Lumbre".to_owned(),
        };
        if title != self.title {
            window.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
        let Some(mut wanted) = self.state.wanted() else { return };
        wanted.paused |= window.input(|i| i.viewport().minimized).unwrap_or(false);
        if self.told.as_ref().is_some_and(|told| same(told, &wanted)) {
            return self.ask();
        }
        match &self.session {
            None => {
                self.session = Some((self.start)(wanted.clone(), self.sink.clone()));
                self.wish = 1;
            }
            Some(session) => {
                let number = session.set(wanted.clone());
                self.wish = number;
                if self.sent.len() < 1000 {
                    self.sent.push_back((number, Instant::now()));
                }
            }
        }
        self.told = Some(wanted);
        self.ask();
    }

    /// Asks what stands where the mouse clicked, and for a file of the picture.
    fn ask(&mut self) {
        if let (Some(session), Some(path)) = (&self.session, self.state.picture_to_save.take()) {
            session.save(path);
        }
        if let Some(session) = &self.session
            && let Some(at) = self.state.picks.to_ask()
        {
            session.pick(at);
        }
    }
}

/// Width of the side bar, points.
const SIDE: f32 = 340.0;

/// Whether two wishes are one.
fn same(a: &Wanted, b: &Wanted) -> bool {
    Arc::ptr_eq(&a.scene, &b.scene)
        && a.camera == b.camera
        && a.size == b.size
        && a.settings == b.settings
        && (a.samples_per_frame, a.limit, a.paused, a.restarts, a.moving)
            == (b.samples_per_frame, b.limit, b.paused, b.restarts, b.moving)
        && a.look == b.look
        && a.layer == b.layer
        && a.device == b.device
}

impl eframe::App for App {
    fn logic(&mut self, window: &Context, _: &mut eframe::Frame) {
        self.receive(window);
        let hidden = window.input(|i| i.viewport().minimized).unwrap_or(false);
        if hidden {
            self.tell(window);
        }
    }

    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        self.show(ui, frame.info().cpu_usage.map(Duration::from_secs_f32));
    }

    fn clear_color(&self, _: &egui::Visuals) -> [f32; 4] {
        [0.07, 0.07, 0.07, 1.0]
    }
}
