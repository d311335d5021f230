//! A picture that people look at while it grows, and that begins anew the moment something moves: for windows, and for anything else that
//! shows frames.
//!
//! A [`Session`] owns a thread, and the thread owns the device. [`Session::set`] says what is wanted, all of it, and never waits; the latest
//! wins, and the thread finds out by comparing what has to be done: an edited scene is compiled in part and brought to the device, another
//! camera begins the picture anew, another tone curve only develops it again. Frames and events leave through a [`FrameSink`].
//!
//! While something moves, frames are as rough as it takes to be soon ([`Wanted::moving`]); when it rests they get finer step by step, and at full size
//! samples add up. These are the samples that [`crate::render()`] takes, so that a view which has got `n` of them is, to the bit, the
//! picture that it draws.

mod engine;
mod layers;
mod pace;
mod pick;
mod show;
mod sink;
#[cfg(all(test, feature = "files"))]
mod tests;
mod wanted;

pub use sink::{Event, Frame, FrameSink, FrameStats, Picked};
pub use wanted::{Layer, ViewLook, Wanted};

use crate::GpuOptions;
use lumbre_core::Camera;
use lumbre_scene::CompiledScene;
#[cfg(feature = "files")]
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

/// A picture on its way. Dropping it ends it, within about a tenth of a second unless a scene is just being prepared.
pub struct Session {
    shared: Arc<Shared>,
    sink: Arc<dyn FrameSink>,
    thread: Option<JoinHandle<()>>,
}

/// What both sides see.
struct Shared {
    state: Mutex<State>,
    changed: Condvar,
    /// The frame under way is better left.
    interrupt: AtomicBool,
    /// For picking: the scene as it is drawn.
    drawn: Mutex<Option<CompiledScene>>,
}

struct State {
    wanted: Wanted,
    /// How many times something was wanted.
    number: u64,
    /// What the thread knows of.
    taken: u64,
    /// With the number of the last wish before.
    #[cfg(feature = "files")]
    saves: Vec<(u64, PathBuf)>,
    ended: bool,
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn drawn(&self) -> MutexGuard<'_, Option<CompiledScene>> {
        self.drawn.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Session {
    /// Begins. The scene is compiled and brought to the device on the session's thread; events tell how that goes.
    ///
    /// # Panics
    /// If the system has no room for a thread.
    pub fn start(wanted: Wanted, gpu: GpuOptions, sink: Arc<dyn FrameSink>) -> Self {
        let state = State {
            wanted,
            number: 1,
            taken: 0,
            #[cfg(feature = "files")]
            saves: Vec::new(),
            ended: false,
        };
        let shared = Arc::new(Shared {
            state: Mutex::new(state),
            changed: Condvar::new(),
            interrupt: AtomicBool::new(false),
            drawn: Mutex::new(None),
        });
        let (of_thread, to) = (shared.clone(), sink.clone());
        let work = move || engine::run(of_thread, gpu, to);
        let thread = std::thread::Builder::new().name("render".into()).spawn(work);
        Session { shared, sink, thread: Some(thread.expect("the system has room for a thread")) }
    }

    /// Says what is wanted from now on, and returns its number: frames tell theirs. Never waits for the device.
    pub fn set(&self, wanted: Wanted) -> u64 {
        let mut state = self.shared.state();
        if state.wanted.interrupts(&wanted) {
            self.shared.interrupt.store(true, Ordering::Relaxed);
        }
        state.wanted = wanted;
        state.number += 1;
        self.shared.changed.notify_one();
        state.number
    }

    /// Asks what stands at a place of the view: `at` from its top left corner, 0 to 1 along each axis. [`Event::Picked`] answers, from a
    /// thread of its own.
    ///
    /// # Panics
    /// If the system has no room for a thread.
    pub fn pick(&self, at: [f32; 2]) {
        let scene = self.shared.drawn().clone();
        let (camera, settings): (Camera, _) = {
            let state = self.shared.state();
            (state.wanted.camera, state.wanted.settings)
        };
        let sink = self.sink.clone();
        let work = move || {
            let found = scene.and_then(|scene| pick::pick(&scene, &camera, &settings, at));
            sink.event(Event::Picked(found));
        };
        std::thread::Builder::new()
            .name("pick".into())
            .spawn(work)
            .expect("the system has room for a thread");
    }

    /// Writes the picture to a file, in the format that its ending says: PNG or JPEG as it is shown, EXR with all layers. What it gets is the
    /// first frame of full size that all that was wanted so far has; [`Event::Saved`] or [`Event::Failed`] answers.
    #[cfg(feature = "files")]
    pub fn save(&self, path: PathBuf) {
        let mut state = self.shared.state();
        let number = state.number;
        state.saves.push((number, path));
        drop(state);
        self.shared.changed.notify_one();
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.shared.state().ended = true;
        self.shared.interrupt.store(true, Ordering::Relaxed);
        self.shared.changed.notify_one();
        // A panic of the thread was printed by itself.
        let _ = self.thread.take().map(JoinHandle::join);
    }
}
