//! A window without a screen, and a render thread without a device.

use eframe::egui::{self, Key, Modifiers, PointerButton, Pos2, Rect};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumbre::LoadOptions;
use lumbre::session::{Event, Frame, FrameSink, FrameStats, Wanted};
use lumbre_viewer::app::{App, Renders, Start};
use lumbre_viewer::recent::Recent;
use lumbre_viewer::state::{REST, Running, State};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// What the stand-in was told.
#[derive(Default)]
pub(crate) struct Told {
    pub(crate) wanted: Vec<Wanted>,
    pub(crate) picks: Vec<[f32; 2]>,
    pub(crate) saves: Vec<PathBuf>,
    sink: Option<Arc<dyn FrameSink>>,
}

/// The stand-in, and the way to it.
#[derive(Clone, Default)]
pub(crate) struct Fake(Arc<Mutex<Told>>);

impl Fake {
    pub(crate) fn told<T>(&self, of: impl FnOnce(&mut Told) -> T) -> T {
        of(&mut self.0.lock().unwrap())
    }

    /// What is wanted now.
    pub(crate) fn wanted(&self) -> Wanted {
        self.told(|t| t.wanted.last().expect("something is wanted").clone())
    }

    /// How many times something was wanted.
    pub(crate) fn count(&self) -> usize {
        self.told(|t| t.wanted.len())
    }

    pub(crate) fn happens(&self, event: Event) {
        self.sink().event(event);
    }

    /// What is wanted is on a device.
    pub(crate) fn prepared(&self, device: &str, seconds: f64) {
        let scene = self.wanted().scene;
        self.happens(Event::Prepared { device: device.into(), seconds, scene });
    }

    /// What is wanted cannot be drawn.
    pub(crate) fn refuses(&self, reason: &str) {
        let scene = self.wanted().scene;
        self.happens(Event::Refused { scene, reason: reason.into() });
    }

    fn sink(&self) -> Arc<dyn FrameSink> {
        self.told(|t| t.sink.clone().expect("a session was started"))
    }

    /// Sends a grey frame of what is wanted, at a fourth of its size while something moves.
    pub(crate) fn draw(&self, spp: u32) {
        let (wanted, number) = (self.wanted(), self.count() as u64);
        let scale = if wanted.moving { 4 } else { 1 };
        let size = wanted.size.map(|n| n.div_ceil(scale));
        let pixels = size[0] as usize * size[1] as usize;
        let stats = FrameStats {
            device: "Stand-in".into(),
            spp,
            seconds: 0.02,
            samples: pixels as u64,
            rays: 3 * pixels as u64,
            scale,
            exposure_ev: 1.5,
            ..FrameStats::default()
        };
        self.sink().frame(Frame { size, rgba: [90, 100, 110, 255].repeat(pixels), number, stats });
    }
}

impl Renders for Fake {
    fn set(&self, wanted: Wanted) -> u64 {
        self.told(|t| {
            t.wanted.push(wanted);
            t.wanted.len() as u64
        })
    }
    fn pick(&self, at: [f32; 2]) {
        self.told(|t| t.picks.push(at));
    }
    fn save(&self, path: PathBuf) {
        self.told(|t| t.saves.push(path));
    }
}

/// A window and what it tells.
pub(crate) struct Window {
    pub(crate) ui: Harness<'static, App>,
    pub(crate) fake: Fake,
}

impl Window {
    /// Without a scene.
    pub(crate) fn empty() -> Self {
        Self::sized([1280.0, 800.0], 1.0)
    }

    pub(crate) fn sized(size: [f32; 2], scale: f32) -> Self {
        let fake = Fake::default();
        let stand_in = fake.clone();
        let start: Start = Box::new(move |wanted, sink| {
            stand_in.told(|t| {
                t.wanted.push(wanted);
                t.sink = Some(sink);
            });
            Box::new(stand_in.clone())
        });
        let state = State::new(LoadOptions::default(), Running::default(), Recent::read(None));
        let mut entered = false;
        let step = move |ui: &mut egui::Ui, app: &mut App| {
            if !std::mem::replace(&mut entered, true) {
                app.enter(ui.ctx());
            }
            app.receive(ui.ctx());
            app.show(ui, None);
        };
        let builder =
            Harness::builder().with_size(size).with_pixels_per_point(scale).with_step_dt(1.0 / 60.0);
        let ui = builder.build_ui_state(step, App::new(state, start));
        let mut window = Window { ui, fake };
        window.steps(3);
        window
    }

    /// With a scene of this project, and its first frame.
    pub(crate) fn with(scene: &str) -> Self {
        let mut window = Self::empty();
        window.open(&asset(scene));
        window
    }

    /// Opens a scene and draws it.
    pub(crate) fn open(&mut self, path: &Path) {
        self.ui.state_mut().state.loader.open(path);
        let shown = |w: &Window| w.ui.state().state.document.as_ref().is_some_and(|d| d.path == path);
        self.until("the scene is open", shown);
        self.rest();
        self.fake.draw(1);
        self.steps(2);
    }

    pub(crate) fn state(&self) -> &State {
        &self.ui.state().state
    }

    pub(crate) fn state_mut(&mut self) -> &mut State {
        &mut self.ui.state_mut().state
    }

    pub(crate) fn steps(&mut self, count: usize) {
        self.ui.run_steps(count);
    }

    /// Steps until something is so; a test that waits in vain fails.
    pub(crate) fn until(&mut self, what: &str, so: impl Fn(&Window) -> bool) {
        let began = Instant::now();
        while !so(self) {
            assert!(began.elapsed() < Duration::from_secs(60), "waiting for: {what}");
            std::thread::sleep(Duration::from_millis(5));
            self.steps(1);
        }
    }

    /// Lets what moved come to rest.
    pub(crate) fn rest(&mut self) {
        self.steps(1);
        std::thread::sleep(REST + Duration::from_millis(20));
        self.steps(2);
        assert!(!self.fake.wanted().moving, "it does not come to rest");
    }

    /// Where the picture is.
    pub(crate) fn picture(&self) -> Rect {
        self.ui.get_by_label("Picture").rect()
    }

    /// A place of the picture, 0 to 1 along each axis.
    pub(crate) fn at(&self, x: f32, y: f32) -> Pos2 {
        let rect = self.picture();
        rect.min + rect.size() * egui::vec2(x, y)
    }

    fn button(&mut self, pos: Pos2, button: PointerButton, pressed: bool, modifiers: Modifiers) {
        self.ui.event(egui::Event::PointerButton { pos, button, pressed, modifiers });
        self.steps(1);
    }

    /// Drags from one place to another in some steps, and does `during` before it lets go.
    pub(crate) fn drag(
        &mut self,
        from: Pos2,
        to: Pos2,
        button: PointerButton,
        during: impl FnOnce(&mut Window),
    ) {
        self.ui.event(egui::Event::PointerMoved(from));
        self.steps(1);
        self.button(from, button, true, Modifiers::NONE);
        for i in 1..=8 {
            self.ui.event(egui::Event::PointerMoved(from + (to - from) * (i as f32 / 8.0)));
            self.steps(1);
        }
        during(self);
        self.button(to, button, false, Modifiers::NONE);
    }

    pub(crate) fn click(&mut self, pos: Pos2) {
        self.ui.event(egui::Event::PointerMoved(pos));
        self.steps(1);
        self.button(pos, PointerButton::Primary, true, Modifiers::NONE);
        self.button(pos, PointerButton::Primary, false, Modifiers::NONE);
        self.steps(1);
    }

    pub(crate) fn press(&mut self, with: Modifiers, key: Key) {
        self.ui.key_press_modifiers(with, key);
        self.steps(2);
    }

    /// Clicks on a widget by its name.
    pub(crate) fn click_on(&mut self, name: &str) {
        self.ui.get_by_label(name).click();
        self.steps(2);
    }

    /// Unfolds a panel of the side bar, or folds it.
    pub(crate) fn unfold(&mut self, name: &str) {
        let header = self.ui.get_all_by_label(name).last().expect("a panel of this name");
        header.scroll_to_me();
        self.steps(40);
        self.ui.get_all_by_label(name).last().expect("a panel of this name").click();
        self.steps(30);
    }

    /// Scrolls to the field of a row.
    pub(crate) fn scrolled_to(&mut self, name: &str) -> Rect {
        let field = |w: &Self| w.ui.get_all_by_label(name).find(|n| n.value().is_some()).map(|n| n.rect());
        self.ui
            .get_all_by_label(name)
            .find(|n| n.value().is_some())
            .expect("a field of this name")
            .scroll_to_me();
        self.steps(40);
        field(self).expect("a field of this name")
    }

    /// Sets a number by the name of its row.
    pub(crate) fn set_number(&mut self, name: &str, value: f64) {
        self.scrolled_to(name);
        let field =
            self.ui.get_all_by_label(name).find(|n| n.value().is_some()).expect("a field of this name");
        field.set_value_accesskit(value);
        self.steps(2);
    }

    pub(crate) fn shows(&self, text: &str) -> bool {
        self.ui.query_all_by_label_contains(text).next().is_some()
    }
}

/// A scene of this project.
pub(crate) fn asset(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes").join(name)
}
