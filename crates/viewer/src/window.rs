//! Opens the window, by the first way of presenting that works here.

use crate::app::{App, session};
use crate::recent::Recent;
use crate::report::Report;
use crate::state::{Running, State};
use eframe::egui::ViewportBuilder;
use eframe::{NativeOptions, Renderer};
use lumbre::{Device, GpuOptions, LoadOptions};
use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;

/// What the window begins with.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The scene; `None`: people open one.
    pub scene: Option<PathBuf>,
    /// How scenes are read.
    pub load: LoadOptions,
    /// A file of edits for the scene.
    pub edits: Option<PathBuf>,
    /// What draws.
    pub device: Device,
    /// How a GPU is used.
    pub gpu: GpuOptions,
    /// The scene is opened again when its file changes.
    pub watch: bool,
    /// Width and height of the window, points.
    pub size: Option<[f32; 2]>,
    /// Where it writes down what it does, step by step.
    pub report: Option<Report>,
}

/// There is no window.
#[derive(Debug, thiserror::Error)]
pub enum ViewError {
    /// This machine has no display, or it cannot be reached.
    #[error(
        "no window can be opened here ({0}); `lumbre render SCENE -o picture.png` draws without one, and `ssh -X` or DISPLAY leads to one"
    )]
    NoDisplay(String),
    /// There is a display, but nothing to draw on it with.
    #[error(
        "nothing can be drawn in a window here ({0}); `lumbre render SCENE -o picture.png` draws without one"
    )]
    NoPresentation(String),
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// If there is no display, or no way to draw on it. Whatever goes wrong later is told in the window.
pub fn run(options: Options) -> Result<(), ViewError> {
    // The scene is read while the window opens.
    let app = Rc::new(RefCell::new(Some(begin(&options))));
    let mut reasons = Vec::new();
    for renderer in RENDERERS {
        loop {
            let opened = open(&options, *renderer, &app);
            match opened {
                Ok(()) => {}
                Err(eframe::Error::WinitEventLoop(e)) => return Err(ViewError::NoDisplay(one_line(&e))),
                Err(e) => {
                    reasons.push(format!("{renderer}: {}", one_line(&e)));
                    break;
                }
            }
            let again = app.borrow().as_ref().is_some_and(App::reopens);
            if !again {
                return Ok(());
            }
        }
    }
    Err(ViewError::NoPresentation(reasons.join("; ")))
}

/// Ways of presenting, the first that works is taken.
const RENDERERS: &[Renderer] = &[
    Renderer::Glow,
    #[cfg(feature = "vulkan-window")]
    Renderer::Wgpu,
];

fn begin(options: &Options) -> App {
    let running = Running { device: options.device.clone(), ..Running::default() };
    let mut state = State::new(options.load.clone(), running, Recent::of_user());
    state.watching = options.watch;
    if let Some(scene) = &options.scene {
        state.loader.open_scene(scene);
        state.with_scene = options.edits.clone().map(|edits| (scene.clone(), vec![edits]));
    }
    let mut app = App::new(state, session(options.gpu));
    options.report.iter().for_each(|report| app.report(report.clone()));
    app.look_for_devices();
    app
}

/// One window, from its opening to its end. The contents are put back where they came from.
fn open(options: &Options, renderer: Renderer, app: &Rc<RefCell<Option<App>>>) -> Result<(), eframe::Error> {
    let vsync = app.borrow().as_ref().is_none_or(|app| app.state.running.vsync);
    let mut native = NativeOptions {
        viewport: ViewportBuilder::default()
            .with_app_id("lumbre")
            .with_title("Lumbre")
            .with_inner_size(options.size.unwrap_or([1280.0, 800.0]))
            .with_min_inner_size([480.0, 320.0])
            .with_drag_and_drop(true),
        renderer,
        persist_window: false,
        // The picture is 8 bits already; noise over it would be no part of it.
        dithering: false,
        ..NativeOptions::default()
    };
    native.glow_options.vsync = vsync;
    let contents = app.clone();
    let create = move |created: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, Box<dyn std::error::Error + Send + Sync>> {
        let Some(mut app) = contents.borrow_mut().take() else { return Err("the window is open already".into()) };
        app.enter(&created.egui_ctx);
        Ok(Box::new(Held { app: Some(app), back: contents.clone() }))
    };
    eframe::run_native("lumbre", native, Box::new(create))
}

/// The contents while a window has them.
struct Held {
    app: Option<App>,
    back: Rc<RefCell<Option<App>>>,
}

impl eframe::App for Held {
    fn logic(&mut self, window: &eframe::egui::Context, frame: &mut eframe::Frame) {
        if let Some(app) = &mut self.app {
            app.logic(window, frame);
        }
    }

    fn ui(&mut self, ui: &mut eframe::egui::Ui, frame: &mut eframe::Frame) {
        if let Some(app) = &mut self.app {
            app.ui(ui, frame);
        }
    }

    fn clear_color(&self, visuals: &eframe::egui::Visuals) -> [f32; 4] {
        self.app.as_ref().map_or([0.0; 4], |app| app.clear_color(visuals))
    }
}

impl Drop for Held {
    fn drop(&mut self) {
        *self.back.borrow_mut() = self.app.take();
    }
}

/// What others say, in one line.
fn one_line(text: &impl std::fmt::Display) -> String {
    text.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}
