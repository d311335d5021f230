//! A scene on a GPU, rendered into films. Twin of the loop over tiles: `cpu/src/backend.rs`.

use super::code::Code;
use super::film::{CounterReadback, FilmOnGpu};
use super::media::Solids;
use super::slices::{Pace, Slice, Slices};
use super::variant::SceneConstants;
use crate::{
    AccelReport, Buffer, Gpu, PipelineCache, RayPipeline, SceneOnGpu, SceneOptions, Specialisation, Timer,
    Upload, VulkanError,
};
use lumbre_core::control::{Control, Progress};
use lumbre_core::film::Film;
use lumbre_core::settings::{RenderSettings, View};
use lumbre_scene::CompiledScene;
use lumbre_shaders as shaders;
use lumbre_shaders::view::{Push, ViewTable};
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Pipelines that are kept; each is for one choice of settings.
const PIPELINES: usize = 4;

/// A scene ready to be rendered on a GPU.
pub struct VulkanBackend {
    gpu: Gpu,
    scene: SceneOnGpu,
    solids: Solids,
    constants: SceneConstants,
    tables: Buffer,
    cache: PipelineCache,
    /// One render at a time.
    work: Mutex<Work>,
}

/// What renders leave for the next.
struct Work {
    code: Code,
    #[cfg(feature = "shader-reload")]
    watched: super::code::Watched,
    pipelines: Vec<(Specialisation, Arc<RayPipeline>)>,
    film: Option<FilmOnGpu>,
    pace: Pace,
    trace: PassTime,
}

impl Work {
    fn new() -> Self {
        Work {
            code: Code::embedded(),
            #[cfg(feature = "shader-reload")]
            watched: super::code::Watched::default(),
            pipelines: Vec::new(),
            film: None,
            pace: Pace::default(),
            trace: PassTime::trace(),
        }
    }
}

/// Time that the GPU spent on one of its passes, by its own clock.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PassTime {
    /// Which pass.
    pub name: &'static str,
    /// How often it ran.
    pub count: u64,
    /// Milliseconds in all.
    pub total_ms: f64,
}

/// What [`VulkanBackend::frames`] took.
#[derive(Clone, Debug, Default)]
pub struct Frames {
    /// Seconds of each frame, from the end of the one before.
    pub seconds: Vec<f64>,
    /// Camera samples and rays in all.
    pub progress: Progress,
    /// Rays of paths among them: the others went to lights.
    pub path_rays: u64,
    /// Time of the GPU.
    pub trace: PassTime,
}

/// What all dispatches of a render have in common.
struct Shot {
    pipeline: Arc<RayPipeline>,
    push: Push,
    /// Held for its address in `push`.
    _view: Buffer,
}

/// What is needed for a dispatch under way.
struct Flight {
    timer: Timer,
    counters: CounterReadback,
}

impl VulkanBackend {
    /// Brings a scene to a device.
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub fn new(gpu: &Gpu, scene: &CompiledScene, options: SceneOptions) -> Result<Self, VulkanError> {
        let on_gpu = gpu.scene(scene, options)?;
        let mut upload = Upload::new(gpu);
        let tables = Buffer::with_content(&mut upload, "tables of numbers", &shaders::tables::tables())?;
        upload.finish()?;
        Ok(VulkanBackend {
            gpu: gpu.clone(),
            scene: on_gpu,
            solids: Solids::new(scene),
            constants: SceneConstants::new(scene),
            tables,
            cache: PipelineCache::open(gpu),
            work: Mutex::new(Work::new()),
        })
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// What there is of acceleration structures and what making them took.
    pub fn accel(&self) -> &AccelReport {
        self.scene.accel()
    }

    /// What the passes took since the scene was brought here.
    pub fn pass_times(&self) -> Vec<PassTime> {
        let trace = self.lock().trace;
        if trace.count > 0 { vec![trace] } else { Vec::new() }
    }

    fn lock(&self) -> MutexGuard<'_, Work> {
        self.work.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds the samples of a range to every pixel of `film`, the whole picture or a part of it. Stops within about a tenth of a second
    /// when cancelled; pixels then differ in their sample counts. Returns what was done.
    ///
    /// # Errors
    /// If memory is out or the device is lost; the film is then as it was.
    pub fn render(
        &self,
        view: &View,
        samples: Range<u32>,
        film: &mut Film,
        control: &dyn Control,
    ) -> Result<Progress, VulkanError> {
        let mut work = self.lock();
        let shot = self.shot(&mut work, view, film)?;
        let flight = self.flight()?;
        let mut slices = Slices::new(film, samples);
        let mut done = Progress::default();
        while let Some(slice) = slices.next(&work.pace) {
            if control.cancelled() {
                break;
            }
            let began = Instant::now();
            self.submit(&work, &shot, &flight, &slice)?.wait()?;
            let (rays, ms) = (flight.counters.read(), flight.timer.milliseconds()?[1]);
            work.pace.learn(slice.count(), began.elapsed().as_secs_f64());
            work.trace.add(ms);
            done.samples += slice.count();
            done.rays += rays.path + rays.shadow;
            control.progress(done);
        }
        let on_gpu = work.film.as_ref().expect("the shot made it");
        on_gpu.read(&self.gpu, film)?;
        Ok(done)
    }

    /// Draws `count` frames as an interactive program does, for measurements: each adds `spp` samples of every pixel to sums that stay
    /// on the device, from sample 0 on, and nothing but counters is read back. Two frames are under way at a time.
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub fn frames(&self, view: &View, size: [u32; 2], spp: u32, count: u32) -> Result<Frames, VulkanError> {
        let mut work = self.lock();
        let film = Film::new(size[0], size[1]);
        let shot = self.shot(&mut work, view, &film)?;
        let flights = [self.flight()?, self.flight()?];
        let mut frames = Frames { trace: PassTime::trace(), ..Frames::default() };
        let mut pending = std::collections::VecDeque::new();
        let mut last = Instant::now();
        for frame in 0..count + 1 {
            if frame < count {
                let samples = frame * spp..(frame + 1) * spp;
                let slice = Slice { first_pixel: [0, 0], size, samples };
                pending.push_back(self.submit(&work, &shot, &flights[frame as usize % 2], &slice)?);
            }
            // The frame before ends while this one is under way.
            if frame > 0 {
                pending.pop_front().expect("one frame for each turn").wait()?;
                let flight = &flights[(frame as usize - 1) % 2];
                let (rays, now) = (flight.counters.read(), Instant::now());
                frames.seconds.push((now - last).as_secs_f64());
                frames.trace.add(flight.timer.milliseconds()?[1]);
                frames.progress.rays += rays.path + rays.shadow;
                frames.path_rays += rays.path;
                last = now;
            }
        }
        frames.progress.samples = u64::from(size[0]) * u64::from(size[1]) * u64::from(spp) * u64::from(count);
        Ok(frames)
    }

    fn flight(&self) -> Result<Flight, VulkanError> {
        Ok(Flight { timer: Timer::new(&self.gpu, 2)?, counters: CounterReadback::new(&self.gpu)? })
    }

    /// Submits one dispatch.
    fn submit(
        &self,
        work: &Work,
        shot: &Shot,
        flight: &Flight,
        slice: &Slice,
    ) -> Result<crate::Pending, VulkanError> {
        let film = work.film.as_ref().expect("the shot made it");
        let push = Push {
            first_pixel: slice.first_pixel,
            first_sample: slice.samples.start,
            sample_count: slice.samples.len() as u32,
            ..shot.push
        };
        let [width, height] = slice.size;
        self.gpu.submit("path tracing", |commands| {
            film.clear_counters(commands);
            commands.barrier();
            flight.timer.reset(commands);
            flight.timer.stamp(commands, 0);
            shot.pipeline.trace(commands, bytemuck::bytes_of(&push), [width, height, 1]);
            flight.timer.stamp(commands, 1);
            commands.barrier();
            film.copy_counters(commands, &flight.counters);
            Ok(())
        })
    }

    /// Gets ready for a film: pipeline, view, empty sums.
    fn shot(&self, work: &mut Work, view: &View, film: &Film) -> Result<Shot, VulkanError> {
        let pixels = film.pixels().len() as u64;
        if work.film.as_ref().is_none_or(|f| f.pixels() < pixels || f.pixels() > 4 * pixels.max(1)) {
            // The old one goes first: there may not be room for both.
            work.film = None;
            work.film = Some(FilmOnGpu::new(&self.gpu, pixels)?);
        }
        let on_gpu = work.film.as_ref().expect("made above");
        let table = self.view_table(view, film, on_gpu);
        let mut upload = Upload::new(&self.gpu);
        let table = Buffer::with_content(&mut upload, "view", bytemuck::bytes_of(&table))?;
        upload.finish()?;
        self.gpu.run("clearing the film", |commands| {
            on_gpu.clear(commands);
            Ok(())
        })?;
        let push = Push {
            tables: self.tables.address(),
            scene: self.scene.address(),
            view: table.address(),
            first_pixel: [0, 0],
            first_sample: 0,
            sample_count: 0,
        };
        Ok(Shot { pipeline: self.pipeline(work, &view.settings)?, push, _view: table })
    }

    fn view_table(&self, view: &View, film: &Film, on_gpu: &FilmOnGpu) -> ViewTable {
        let settings = &view.settings;
        let [film_address, non_finite, rays] = on_gpu.addresses();
        ViewTable {
            film: film_address,
            non_finite,
            rays,
            picture: film.picture_size(),
            origin: film.origin(),
            size: [film.width(), film.height()],
            seed: settings.seed,
            frame: view.frame,
            max_depth: settings.max_depth.unwrap_or(RenderSettings::DEPTH_BOUND),
            roulette: settings.roulette.unwrap_or(u32::MAX),
            clamp_to: settings.clamp.unwrap_or(f32::INFINITY),
            filter_kind: settings.filter as u32,
            camera: (&view.camera).into(),
            media: (&self.solids.around(view.camera.origin)).into(),
            unused: 0,
        }
    }

    /// The pipeline for these settings, made if there is none yet.
    fn pipeline(&self, work: &mut Work, settings: &RenderSettings) -> Result<Arc<RayPipeline>, VulkanError> {
        #[cfg(feature = "shader-reload")]
        if let Some(code) = work.watched.changed() {
            work.code = code;
            work.pipelines.clear();
        }
        let constants = self.constants.with(settings);
        if let Some((_, pipeline)) = work.pipelines.iter().find(|(c, _)| *c == constants) {
            return Ok(pipeline.clone());
        }
        let push = size_of::<Push>() as u32;
        let pipeline =
            Arc::new(RayPipeline::new(&self.scene, &work.code.shaders(), &constants, push, &self.cache)?);
        self.cache.save();
        work.pipelines.truncate(PIPELINES - 1);
        work.pipelines.insert(0, (constants, pipeline.clone()));
        Ok(pipeline)
    }
}

impl PassTime {
    fn trace() -> Self {
        PassTime { name: "trace", ..PassTime::default() }
    }

    fn add(&mut self, ms: f64) {
        self.count += 1;
        self.total_ms += ms;
    }
}
