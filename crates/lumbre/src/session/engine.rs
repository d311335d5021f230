//! The thread of a session: what is wanted becomes frames.

use super::pace::{Pace, finer, scaled};
use super::show::{STEP, Shot, Show, arrived, offset, share};
use super::sink::{Event, Frame, FrameSink, FrameStats};
use super::{Layer, Shared, ViewLook, Wanted, layers};
use crate::backend::{Backend, Canvas, PassTime, RenderError};
use crate::estimate::Estimator;
use crate::look::Negative;
use crate::{Device, GpuOptions};
use lumbre_core::Film;
use lumbre_core::control::Control;
use lumbre_core::settings::{RenderSettings, View};
use lumbre_scene::{CompiledScene, Scene, SceneChanges, compile, recompile};
use std::sync::atomic::Ordering;
use std::sync::{Arc, PoisonError};
use std::time::{Duration, Instant};

/// Samples from which an estimate of the error says anything.
const LEAST_FOR_ERROR: u32 = 16;

/// The thread: until the session ends.
pub(super) fn run(shared: Arc<Shared>, gpu: GpuOptions, sink: Arc<dyn FrameSink>) {
    let show = Show::start(sink.clone());
    let wanted = {
        let mut state = shared.state();
        state.taken = state.number;
        state.wanted.clone()
    };
    show.look(wanted.look);
    let pace = Pace::new(false);
    let (number, failed, refused, exposed) = (1, None, None, None);
    let mut engine = Engine { shared, gpu, sink, show, wanted, number, failed, refused, pace, exposed };
    // `None` comes from far inside once the session is over.
    let _ = engine.work();
}

struct Engine {
    shared: Arc<Shared>,
    gpu: GpuOptions,
    sink: Arc<dyn FrameSink>,
    show: Show,
    wanted: Wanted,
    /// Of what is wanted.
    number: u64,
    /// The device that failed, and that the CPU stands in for until another one is wanted.
    failed: Option<Device>,
    /// The scene that could not be compiled.
    refused: Option<Arc<Scene>>,
    /// Of the device that draws.
    pace: Pace,
    /// Exposure of the last frame that it developed itself.
    exposed: Option<(f32, Instant)>,
}

/// A scene as it was written and as it is drawn.
struct Made {
    scene: Arc<Scene>,
    compiled: CompiledScene,
}

/// Why frames of a backend ended.
enum Next {
    /// Another scene is to be drawn; in what it differs if it is an edited form of the last.
    Scene(Box<Made>, Option<SceneChanges>),
    /// Another device is wanted.
    Device,
    /// The device failed.
    Lost(RenderError),
}

/// Interrupts a pass when something else is wanted.
struct Interrupt<'a>(&'a Shared);

impl Control for Interrupt<'_> {
    fn cancelled(&self) -> bool {
        self.0.interrupt.load(Ordering::Relaxed)
    }
}

impl Engine {
    fn work(&mut self) -> Option<()> {
        let mut made = self.first_scene()?;
        loop {
            let mut backend = self.prepare(&made)?;
            loop {
                *self.shared.drawn() = Some(made.compiled.clone());
                let updated = match self.frames(&*backend, &mut made)? {
                    Next::Device => {
                        self.failed = None;
                        break;
                    }
                    Next::Scene(other, changes) => {
                        made = *other;
                        let Some(changes) = changes else {
                            // What had no room for the last one may have room for this.
                            self.failed = None;
                            break;
                        };
                        backend.update(made.compiled.clone(), changes)
                    }
                    Next::Lost(error) => Err(error),
                };
                if let Err(error) = updated {
                    self.failed = Some(self.wanted.device.clone());
                    self.sink.event(Event::Notice(format!("{error}; going on with the CPU")));
                    break;
                }
            }
        }
    }

    /// The first scene that can be compiled.
    fn first_scene(&mut self) -> Option<Made> {
        loop {
            if let Some((made, _)) = self.compile(None) {
                return Some(made);
            }
            self.wait(None)?;
        }
    }

    /// Compiles the scene that is wanted; in what it differs from `last`, if it is an edited form of that.
    fn compile(&mut self, last: Option<&Made>) -> Option<(Made, Option<SceneChanges>)> {
        let scene = self.wanted.scene.clone();
        let edited = |m: &&Made| {
            Arc::ptr_eq(&m.scene.meshes, &scene.meshes) && Arc::ptr_eq(&m.scene.images, &scene.images)
        };
        let done = match last.filter(edited) {
            Some(m) => recompile(&m.scene, &m.compiled, &scene).map(|(done, changes)| (done, Some(changes))),
            None => {
                self.sink.event(Event::Preparing("compiling the scene".into()));
                compile(&scene).map(|done| (done, None))
            }
        };
        match done {
            Ok((done, changes)) => {
                if changes.is_none() {
                    done.notes.into_iter().for_each(|note| self.sink.event(Event::Notice(note)));
                }
                Some((Made { scene, compiled: done.scene }, changes))
            }
            Err(e) => {
                let reason = format!("{}: {e}", scene.name);
                self.sink.event(Event::Refused { scene: scene.clone(), reason });
                self.refused = Some(scene);
                None
            }
        }
    }

    /// Brings a scene to the device that is wanted, or to the CPU.
    fn prepare(&mut self, made: &Made) -> Option<Box<dyn Backend>> {
        let began = Instant::now();
        loop {
            let device = match &self.failed {
                Some(failed) if *failed == self.wanted.device => Device::Cpu,
                _ => self.wanted.device.clone(),
            };
            self.sink.event(Event::Preparing("bringing the scene to the device".into()));
            let opened = device.open(&self.gpu).and_then(|open| {
                open.notes().iter().for_each(|note| self.sink.event(Event::Notice(note.clone())));
                // The session goes on by itself where a device fails, and then has the edited scene.
                open.alone().editable().prepare(made.compiled.clone())
            });
            match opened {
                Ok(prepared) => {
                    prepared.note.into_iter().for_each(|note| self.sink.event(Event::Notice(note)));
                    self.pace = Pace::new(device != Device::Cpu);
                    self.exposed = None;
                    let device = prepared.backend.device();
                    *self.shared.drawn() = Some(made.compiled.clone());
                    let seconds = began.elapsed().as_secs_f64();
                    let scene = made.scene.clone();
                    self.sink.event(Event::Prepared { device, seconds, scene });
                    return Some(prepared.backend);
                }
                Err(e) if device == Device::Cpu => {
                    let (scene, reason) = (made.scene.clone(), e.to_string());
                    self.sink.event(Event::Refused { scene, reason });
                    self.wait(None)?;
                }
                Err(e) => {
                    self.failed = Some(device);
                    self.sink.event(Event::Notice(format!("{e}; going on with the CPU")));
                }
            }
        }
    }

    /// Takes in what is wanted by now; waits for it, up to a time, if nothing else is wanted. `None` when the session is over.
    fn wait(&mut self, up_to: Option<Duration>) -> Option<()> {
        let mut state = self.shared.state();
        while state.number == state.taken && !state.ended && !state.saving() {
            let Some(up_to) = up_to else {
                state = self.shared.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
                continue;
            };
            if !up_to.is_zero() {
                let waited = self.shared.changed.wait_timeout(state, up_to);
                state = waited.unwrap_or_else(PoisonError::into_inner).0;
            }
            break;
        }
        if state.ended {
            return None;
        }
        state.taken = state.number;
        self.number = state.number;
        self.wanted = state.wanted.clone();
        self.shared.interrupt.store(false, Ordering::Relaxed);
        Some(())
    }

    /// Frames of one scene on one device.
    fn frames(&mut self, backend: &dyn Backend, made: &mut Made) -> Option<Next> {
        // It may have come with the scene or the device that began this.
        self.show.look(self.wanted.look);
        let run = backend.canvas().and_then(|canvas| Run::new(backend, canvas, self));
        let mut run = match run {
            Ok(run) => run,
            Err(e) => return Some(Next::Lost(e)),
        };
        loop {
            let before = self.wanted.clone();
            self.wait(run.patience(self))?;
            if self.wanted.device != before.device {
                return Some(Next::Device);
            }
            let drawn = |s: &Arc<Scene>| Arc::ptr_eq(s, &self.wanted.scene);
            let refused = self.refused.as_ref().is_some_and(drawn);
            if !drawn(&made.scene)
                && !refused
                && let Some((next, changes)) = self.compile(Some(made))
            {
                if changes != Some(SceneChanges::default()) {
                    return Some(Next::Scene(Box::new(next), changes));
                }
                // Nothing that is drawn: as where something hidden moves.
                *made = next;
            }
            if let Err(e) = run.turn(self, &before) {
                return Some(Next::Lost(e));
            }
        }
    }
}

/// A picture that grows on a device.
struct Run<'a> {
    backend: &'a dyn Backend,
    canvas: Box<dyn Canvas + 'a>,
    estimator: Estimator,
    scale: u32,
    spp: u32,
    /// The canvas holds nothing but these samples.
    clear: bool,
    /// Frames so far: the random stream of rough ones.
    rough: u32,
    began: Instant,
    passes: Vec<PassTime>,
    stats: FrameStats,
    /// An eased exposure has not arrived.
    easing: bool,
}

impl<'a> Run<'a> {
    fn new(
        backend: &'a dyn Backend,
        canvas: Box<dyn Canvas + 'a>,
        engine: &Engine,
    ) -> Result<Self, RenderError> {
        backend.warm_up(&engine.view(0))?;
        let mut run = Run {
            backend,
            canvas,
            estimator: Estimator::new(&Film::new(0, 0), &engine.wanted.settings),
            scale: 1,
            spp: 0,
            clear: false,
            rough: 0,
            began: Instant::now(),
            passes: backend.pass_times(),
            stats: FrameStats::default(),
            easing: false,
        };
        run.begin(engine);
        Ok(run)
    }

    /// Begins the picture anew, as rough as is quick.
    fn begin(&mut self, engine: &Engine) {
        self.began = Instant::now();
        self.at_scale(engine.pace.scale(engine.wanted.size));
    }

    /// The next pass begins with nothing, so rough. A canvas of full size is not cleared before that: what comes next may be rougher.
    fn at_scale(&mut self, scale: u32) {
        (self.scale, self.spp, self.clear) = (scale, 0, false);
    }

    /// Whether there is nothing to sample.
    fn rests(&self, wanted: &Wanted) -> bool {
        let shown = self.spp > 0 && (self.scale == 1 || wanted.moving);
        shown && (wanted.paused || self.spp >= wanted.limit)
    }

    /// How long to wait for something new to be wanted.
    fn patience(&self, engine: &Engine) -> Option<Duration> {
        match (self.rests(&engine.wanted), self.easing) {
            (false, _) => Some(Duration::ZERO),
            (true, true) => Some(STEP),
            (true, false) => None,
        }
    }

    /// One turn: a frame of what is wanted, or nothing if it rests.
    fn turn(&mut self, engine: &mut Engine, before: &Wanted) -> Result<(), RenderError> {
        let wanted = &engine.wanted;
        if before.begins_anew(wanted) {
            self.begin(engine);
        } else if self.scale > 1 && self.spp > 0 && !wanted.moving {
            self.at_scale(finer(self.scale));
        }
        let developed_anew = before.look != wanted.look || before.layer != wanted.layer || self.easing;
        if before.look != wanted.look {
            engine.show.look(wanted.look);
        }
        if self.rests(wanted) {
            if developed_anew {
                self.show(engine, 0.0)?;
            }
            return self.save(engine);
        }
        if self.spp > 0 && (before.look != wanted.look || before.layer != wanted.layer) {
            // What there is, before the next samples have taken their time.
            self.show(engine, 0.0)?;
        }
        self.pass(engine)?;
        self.save(engine)
    }

    /// Takes samples and shows them, unless something interrupts.
    fn pass(&mut self, engine: &mut Engine) -> Result<(), RenderError> {
        let wanted = &engine.wanted;
        let size = scaled(wanted.size, self.scale);
        let pixels = u64::from(size[0]) * u64::from(size[1]);
        let count = if self.scale > 1 { 1 } else { wanted.samples_per_frame.max(1) };
        let count = count.min(wanted.limit.max(1) - self.spp);
        self.rough += u32::from(self.scale > 1);
        let view = engine.view(if self.scale > 1 { self.rough } else { 0 });
        if !self.clear {
            self.canvas.clear(size)?;
            self.estimator = Estimator::new(&Film::new(0, 0), &wanted.settings);
            self.clear = true;
        }
        let began = Instant::now();
        let done = self.canvas.add(&view, self.spp..self.spp + count, &Interrupt(&engine.shared))?;
        let seconds = began.elapsed().as_secs_f64();
        if done.samples < pixels * u64::from(count) {
            // Uneven: what interrupted it begins anew, or lets go of all of it.
            self.at_scale(self.scale);
            return Ok(());
        }
        engine.pace.learn(done.samples, seconds);
        self.spp += count;
        self.stats = FrameStats {
            device: self.backend.device(),
            samples: done.samples,
            rays: done.rays,
            passes: self.passes_since(),
            memory: self.backend.memory() + self.canvas.bytes(),
            error: self.stats.error.filter(|_| self.spp > count),
            scale: self.scale,
            ..FrameStats::default()
        };
        let doubled = (self.spp - count).checked_ilog2() != self.spp.checked_ilog2();
        if self.scale == 1 && doubled && self.spp >= LEAST_FOR_ERROR {
            self.stats.error = self.estimator.look(self.canvas.film()?, self.spp);
        }
        self.show(engine, seconds)
    }

    /// What the passes of the device took since the last frame.
    fn passes_since(&mut self) -> Vec<PassTime> {
        let now = self.backend.pass_times();
        let since = |t: &PassTime| {
            let last = self.passes.iter().find(|l| l.name == t.name);
            let (count, ms) = last.map_or((0, 0.0), |l| (l.count, l.total_ms));
            PassTime { name: t.name, count: t.count - count, total_ms: t.total_ms - ms }
        };
        let passes = now.iter().map(since).filter(|t| t.count > 0).collect();
        self.passes = now;
        passes
    }

    /// Sends what there is to be shown.
    fn show(&mut self, engine: &mut Engine, seconds: f64) -> Result<(), RenderError> {
        let Engine { wanted, number, sink, show, exposed, .. } = engine;
        let stats = FrameStats {
            spp: self.spp,
            seconds,
            since: self.began.elapsed().as_secs_f64(),
            done: self.rests(wanted),
            ..self.stats.clone()
        };
        let number = *number;
        let frame = |size, rgba, stats| Frame { size, rgba, number, stats };
        self.easing = false;
        if wanted.layer != Layer::Picture {
            show.blank();
            let film = self.canvas.film()?;
            let stats = FrameStats { non_finite: film.non_finite_count(), ..stats };
            let rgba = layers::layer(film, wanted.layer);
            sink.frame(frame([film.width(), film.height()], rgba, stats));
            return Ok(());
        }
        if let Some((rgba, exposure)) = self.developed(wanted.look, exposed)? {
            show.blank();
            let stats = FrameStats { exposure_ev: exposure.log2(), ..stats };
            sink.frame(frame(scaled(wanted.size, self.scale), rgba, stats));
            return Ok(());
        }
        let film = self.canvas.film()?;
        let stats = FrameStats { non_finite: film.non_finite_count(), ..stats };
        let negative = Negative::new(film, wanted.look.look.transparent);
        show.shot(Shot { negative, number, stats });
        Ok(())
    }

    /// The picture as the device develops it, with the factor of its exposure.
    fn developed(
        &mut self,
        look: ViewLook,
        exposed: &mut Option<(f32, Instant)>,
    ) -> Result<Option<(Vec<u8>, f32)>, RenderError> {
        let share = share(&look, exposed.map(|(_, at)| at));
        let Some(done) = self.canvas.develop(&look.look, offset(&look), share)? else { return Ok(None) };
        let last = exposed.replace((done.factor, Instant::now()));
        // A step of this share of the way.
        self.easing = last.is_some_and(|(f, _)| share < 1.0 && !arrived(done.factor / f, share));
        Ok(Some((done.rgba, done.factor)))
    }

    /// Writes what is to be saved, once there is a whole picture.
    #[cfg(feature = "files")]
    fn save(&mut self, engine: &Engine) -> Result<(), RenderError> {
        if self.scale > 1 || self.spp == 0 {
            return Ok(());
        }
        let mut state = engine.shared.state();
        // Those that came since may be of what was wanted since.
        let taken = state.taken;
        let paths: Vec<_> = state.saves.extract_if(.., |(number, _)| *number <= taken).collect();
        drop(state);
        for (_, path) in paths {
            let film = self.canvas.film()?;
            let look = engine.look_of(film);
            engine.sink.event(match crate::output::save(film, &look, &path) {
                Ok(()) => Event::Saved(path),
                Err(e) => Event::Failed(e.to_string()),
            });
        }
        Ok(())
    }

    #[cfg(not(feature = "files"))]
    fn save(&mut self, _: &Engine) -> Result<(), RenderError> {
        Ok(())
    }
}

impl Engine {
    /// What is rendered.
    fn view(&self, frame: u32) -> View {
        let object_colors = self.wanted.layer == Layer::Objects;
        let settings = RenderSettings { object_colors, ..self.wanted.settings };
        View { camera: self.wanted.camera, settings, frame }
    }

    /// The look with its exposure as it is shown once it has arrived.
    #[cfg(feature = "files")]
    fn look_of(&self, film: &Film) -> crate::Look {
        use lumbre_core::color::Exposure;
        let look = self.wanted.look;
        let target = look.look.exposure_factor(film) * offset(&look);
        crate::Look { exposure: Exposure::Ev(target.log2()), ..look.look }
    }
}

impl super::State {
    /// Whether a picture waits to be written.
    fn saving(&self) -> bool {
        #[cfg(feature = "files")]
        return !self.saves.is_empty();
        #[cfg(not(feature = "files"))]
        false
    }
}
