//! The same with a real session: what is shown is what `lumbre render` draws.

use crate::kit::{Window, asset};
use eframe::egui;
use egui_kittest::Harness;
use lumbre::core::Film;
use lumbre::core::settings::{RenderSettings, View};
use lumbre::edits::{Edits, Item, LookEdits, Value};
use lumbre::scene::MaterialId;
use lumbre::session::{Event, Frame, FrameSink, Wanted};
use lumbre::{Device, GpuOptions, LoadOptions, Targets};
use lumbre_viewer::app::{App, Renders, Start, session};
use lumbre_viewer::recent::Recent;
use lumbre_viewer::state::{Running, State};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Keeps the last frame on its way to the window.
struct Tap {
    to: Arc<dyn FrameSink>,
    last: Arc<Mutex<Option<(Wanted, Frame)>>>,
    wanted: Arc<Mutex<Vec<Wanted>>>,
}

impl FrameSink for Tap {
    fn frame(&self, frame: Frame) {
        let wanted = self.wanted.lock().unwrap()[frame.number as usize - 1].clone();
        *self.last.lock().unwrap() = Some((wanted, frame.clone()));
        self.to.frame(frame);
    }
    fn event(&self, event: Event) {
        self.to.event(event);
    }
}

/// A session that notes what it is told.
struct Noted {
    inner: Box<dyn Renders>,
    wanted: Arc<Mutex<Vec<Wanted>>>,
}

impl Renders for Noted {
    fn set(&self, wanted: Wanted) -> u64 {
        let mut all = self.wanted.lock().unwrap();
        all.push(wanted.clone());
        let number = self.inner.set(wanted);
        assert_eq!(number as usize, all.len());
        number
    }
    fn pick(&self, at: [f32; 2]) {
        self.inner.pick(at);
    }
    fn save(&self, path: PathBuf) {
        self.inner.save(path);
    }
}

const SAMPLES: u32 = 4;

#[test]
fn the_view_is_to_the_bit_what_its_edits_render() {
    let last = Arc::new(Mutex::new(None));
    let tapped = last.clone();
    let begin = session(GpuOptions::default());
    let start: Start = Box::new(move |wanted, to| {
        let all = Arc::new(Mutex::new(vec![wanted.clone()]));
        let tap = Tap { to, last: tapped.clone(), wanted: all.clone() };
        Box::new(Noted { inner: begin(wanted, Arc::new(tap)), wanted: all })
    });
    let running = Running { device: Device::Cpu, limit: SAMPLES, eased: false, ..Running::default() };
    let mut state = State::new(LoadOptions::default(), running, Recent::read(None));
    state.shown.bare = true;
    state.loader.open(&asset("cornell.glb"));
    let step = |ui: &mut egui::Ui, app: &mut App| {
        app.receive(ui.ctx());
        app.show(ui, None);
    };
    let builder = Harness::builder().with_size([96.0, 64.0]).with_step_dt(1.0 / 60.0);
    let mut ui = builder.build_ui_state(step, App::new(state, start));
    let wait = |ui: &mut Harness<'_, App>, what: &str, so: &dyn Fn(&App) -> bool| {
        let began = Instant::now();
        while !so(ui.state()) {
            let waited = began.elapsed() > Duration::from_secs(60);
            assert!(!waited, "waiting for {what}: {:?} {:?}", ui.state().state.log, ui.state().state.stats);
            std::thread::sleep(Duration::from_millis(5));
            ui.run_steps(1);
        }
    };
    wait(&mut ui, "a scene", &|app| app.state.document.is_some());
    let state = &mut ui.state_mut().state;
    state.set(Item::Material(MaterialId(0)), "roughness", Value::Number(0.3));
    state.set(Item::Look, "exposure", Value::Number(-0.5));
    state.set(Item::Settings, "maxDepth", Value::Whole(3));
    state.edit(|edits, base| {
        let light = edits.add_light("lamp");
        edits.set(base, light, "position", Value::Vector(glam::Vec3::new(0.1, 0.4, 0.2)))
    });
    let pose = state.pose().unwrap();
    state.set_pose(lumbre_viewer::navigation::orbit(pose, 0.3, 0.1));
    let done = |app: &App| {
        let last = last.lock().unwrap();
        // A quick device is done before the move counts as over.
        let now = app.state.wanted().unwrap();
        let same =
            |w: &Wanted| w.camera == now.camera && Arc::ptr_eq(&w.scene, &now.scene) && w.look == now.look;
        let finished = |f: &Frame| (f.stats.scale, f.stats.spp, f.stats.exposure_ev) == (1, SAMPLES, -0.5);
        let whole = |(w, f): &(Wanted, Frame)| finished(f) && same(w);
        last.as_ref().is_some_and(whole) && !app.state.is_moving()
    };
    ui.run_steps(2);
    wait(&mut ui, "all samples", &done);
    let edits = ui.state().state.document.as_ref().unwrap().edits.clone();
    let (_, frame) = last.lock().unwrap().clone().unwrap();
    assert_eq!(frame.rgba, rendered(&edits.to_text(), frame.size));
}

/// What the command line makes of the same scene and the text of these edits.
fn rendered(edits: &str, size: [u32; 2]) -> Vec<u8> {
    let edits = Edits::parse(edits).unwrap();
    let base = lumbre::load_scene(asset("cornell.glb"), &LoadOptions::default()).unwrap().scene;
    let scene = edits.apply(&base).unwrap();
    let compiled = lumbre::compile(&scene).unwrap().scene;
    let aspect = size[0] as f32 / size[1] as f32;
    let camera = lumbre::find_camera(&scene, &compiled, &edits.camera_options(), aspect).unwrap().camera;
    let view = View { camera, settings: edits.settings(RenderSettings::default()), frame: 0 };
    let backend = lumbre::prepare(compiled, Device::Cpu).unwrap();
    let mut film = Film::new(size[0], size[1]);
    lumbre::render(&*backend, &view, Targets::spp(SAMPLES), &mut film, &()).unwrap();
    let picture = lumbre::output::develop(&film, &edits.look(LookEdits::default()).look);
    picture.bytes.chunks(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect()
}

#[test]
fn a_window_that_is_minimised_rests_and_goes_on_from_there() {
    let mut window = Window::with("cornell.glb");
    let before = window.fake.wanted();
    assert!(!before.paused);
    for minimised in [true, false] {
        let viewports = &mut window.ui.input_mut().viewports;
        viewports.entry(egui::ViewportId::ROOT).or_default().minimized = Some(minimised);
        window.steps(2);
        let wanted = window.fake.wanted();
        assert_eq!(wanted.paused, minimised);
        assert_eq!(
            (wanted.size, wanted.camera, wanted.restarts),
            (before.size, before.camera, before.restarts)
        );
    }
    assert!(!window.state().running.paused, "nobody paused it");
}
