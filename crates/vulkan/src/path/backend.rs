//! A scene on a GPU, rendered into films. Twin of the loop over tiles: `cpu/src/backend.rs`.

mod canvas;
mod edited;
mod hybrid;
mod own_rays;

pub use canvas::Canvas;
pub use own_rays::{OwnRays, RayBatch};

use super::code::Code;
use super::film::FilmOnGpu;
use super::media::Solids;
use super::passes::{Extent, HeadsReadback, LEAST_PATHS, MOST_PATHS, Passes, Paths, paths_per_sample};
use super::slices::{Pace, Slice, Slices};
use super::variant::{Needs, SceneConstants};
use crate::hybrid::HybridScene;
use crate::{
    Buffer, Gpu, Pending, PipelineCache, SceneOnGpu, SceneOptions, Specialisation, Timer, Upload, VulkanError,
};
use glam::Vec3;
use lumbre_core::control::{Control, Progress};
use lumbre_core::film::{Crop, Film};
use lumbre_core::measure::{AccelReport, Frames, PassTime};
use lumbre_core::medium::MediumStack;
use lumbre_core::settings::{RenderSettings, View};
use lumbre_scene::CompiledScene;
use lumbre_shaders as shaders;
use lumbre_shaders::view::{Push, QueueHeads, ViewTable, queue};
use std::collections::VecDeque;
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Choices of settings and features whose pipelines are kept.
const VARIANTS: usize = 8;

/// Most scattering events of one submission; longer paths take several.
const MOST_STEPS: u32 = 64;

/// Shadow catchers that a path passes within its first submission; more take another one.
const SOME_CATCHERS: u32 = 4;

/// A scene ready to be rendered on a GPU.
pub struct VulkanBackend {
    gpu: Gpu,
    scene: SceneOnGpu,
    solids: Solids,
    constants: SceneConstants,
    tables: Buffer,
    cache: PipelineCache,
    hybrid: HybridScene,
    /// Updates so far.
    version: u64,
    /// Why the scene cannot be drawn, after an update that failed.
    failed: Option<VulkanError>,
    /// One render at a time.
    work: Mutex<Work>,
}

/// Pipelines for a choice of settings and what the scene has.
#[derive(Clone)]
struct Variant {
    constants: Specialisation,
    needs: Needs,
    passes: Arc<Passes>,
}

/// What renders leave for the next.
struct Work {
    code: Code,
    #[cfg(feature = "shader-reload")]
    watched: super::code::Watched,
    variants: Vec<Variant>,
    hybrid: crate::hybrid::Kept,
    frames: Option<crate::hybrid::KeptFrames>,
    film: Option<FilmOnGpu>,
    canvas: Option<canvas::Kept>,
    paths: Option<Paths>,
    /// The solids around the last place of the camera.
    media: Option<(Vec3, MediumStack)>,
    pace: Pace,
    times: Vec<PassTime>,
}

impl Work {
    fn new() -> Self {
        Work {
            code: Code::embedded(),
            #[cfg(feature = "shader-reload")]
            watched: super::code::Watched::default(),
            variants: Vec::new(),
            hybrid: Vec::new(),
            frames: None,
            film: None,
            canvas: None,
            paths: None,
            media: None,
            pace: Pace::default(),
            times: Vec::new(),
        }
    }
}

/// A film on the device: the part of the picture that it holds, and where its sums and its list of samples that were not finite lie.
#[derive(Clone, Copy)]
struct Target {
    picture: [u32; 2],
    crop: Crop,
    film: [u64; 2],
}

/// What all submissions of a render have in common.
struct Shot {
    /// What its pipelines are specialised for.
    constants: Specialisation,
    passes: Arc<Passes>,
    push: Push,
    /// Steps of one submission, and whether paths cannot take more.
    steps: u32,
    complete: bool,
    /// Held for its address in `push`.
    _view: Buffer,
}

/// What is needed for a submission under way.
struct Flight {
    timer: Timer,
    heads: HeadsReadback,
}

/// A submission under way, and what lies between its stamps.
struct Submitted(Pending, Vec<&'static str>);

/// Rays of a slice.
#[derive(Clone, Copy, Debug, Default)]
struct Rays {
    path: u64,
    shadow: u64,
}

impl Shot {
    /// Rays of a slice whose last submission left these heads.
    fn rays(&self, slice: &Slice, heads: &QueueHeads) -> Rays {
        // Those of the last step have not been counted yet.
        let list = queue::SHADOW + 2 * (1 - self.steps % 2);
        let last: u64 = (list..list + 2).map(|l| u64::from(heads.at[l as usize].count)).sum();
        // Blocks that reach outside have places in the first list, but no rays.
        let outside = slice.paths() - slice.count();
        Rays { path: u64::from(heads.path_rays) - outside, shadow: u64::from(heads.shadow_rays) + last }
    }
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
        let hybrid = HybridScene::new(&mut upload, scene)?;
        upload.finish()?;
        Ok(VulkanBackend {
            gpu: gpu.clone(),
            scene: on_gpu,
            solids: Solids::new(scene),
            constants: SceneConstants::new(scene),
            tables,
            cache: PipelineCache::open(gpu),
            hybrid,
            version: 0,
            failed: None,
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
        self.lock().times.clone()
    }

    fn lock(&self) -> MutexGuard<'_, Work> {
        self.work.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Makes what renders with these settings need beside the film, so that the first one need not.
    ///
    /// # Errors
    /// If the driver refuses a pipeline or memory is out.
    pub fn warm_up(&self, settings: &RenderSettings) -> Result<(), VulkanError> {
        self.variant(&mut self.lock(), settings).map(drop)
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
        let target = self.own_film(&mut work, film)?;
        let done = self.add(&mut work, view, &target, samples, control)?;
        work.film.as_ref().expect("made for the target").read(&self.gpu, film)?;
        Ok(done)
    }

    /// Adds the samples of a range to a film on the device.
    fn add(
        &self,
        work: &mut Work,
        view: &View,
        target: &Target,
        samples: Range<u32>,
        control: &dyn Control,
    ) -> Result<Progress, VulkanError> {
        let shot = self.shot(work, view, target, samples.len() as u64)?;
        let flight = self.flight(&shot, true)?;
        let capacity = u64::from(work.paths.as_ref().expect("the shot made them").capacity());
        let mut slices = Slices::new(target.crop.size, samples, capacity);
        let mut done = Progress::default();
        while let Some(slice) = slices.next(&work.pace) {
            if control.cancelled() {
                break;
            }
            let began = Instant::now();
            let submitted = self.submit(work, &shot, &flight, (&slice, true))?;
            submitted.noted(&flight, &mut work.times)?;
            let Some(rays) = self.finish(work, &shot, &flight, (&slice, control))? else { break };
            work.pace.learn(slice.count(), began.elapsed().as_secs_f64());
            done.samples += slice.count();
            done.rays += rays.path + rays.shadow;
            control.progress(done);
        }
        Ok(done)
    }

    /// Draws `count` frames as an interactive program does, for measurements: each adds `spp` samples of every pixel to sums that stay
    /// on the device, from sample 0 on, and nothing but counters is read back. Two frames are under way at a time.
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub fn frames(&self, view: &View, size: [u32; 2], spp: u32, count: u32) -> Result<Frames, VulkanError> {
        let mut work = self.lock();
        let target = self.own_film(&mut work, &Film::new(size[0], size[1]))?;
        let shot = self.shot(&mut work, view, &target, spp.into())?;
        if !shot.complete {
            drop(work);
            return self.frames_by_renders(view, size, spp, count);
        }
        let capacity = u64::from(work.paths.as_ref().expect("the shot made them").capacity());
        let flights = [self.flight(&shot, true)?, self.flight(&shot, true)?];
        let mut frames = Frames::default();
        // All slices of all frames, in order; a frame is done with its last one.
        let mut slices: Vec<(Slice, bool)> = Vec::new();
        for frame in 0..count {
            let mut of_frame = Slices::new(size, frame * spp..(frame + 1) * spp, capacity);
            slices.extend(std::iter::from_fn(|| of_frame.next(&Pace::unbounded())).map(|s| (s, false)));
            slices.last_mut().into_iter().for_each(|s| s.1 = true);
        }
        let mut pending: VecDeque<Submitted> = VecDeque::new();
        let mut last = Instant::now();
        for i in 0..slices.len() + 1 {
            if let Some((slice, _)) = slices.get(i) {
                pending.push_back(self.submit(&work, &shot, &flights[i % 2], (slice, true))?);
            }
            // The slice before ends while this one is under way.
            let Some((slice, ends)) = i.checked_sub(1).and_then(|i| slices.get(i)) else { continue };
            let (flight, before) = (&flights[(i - 1) % 2], pending.pop_front());
            before.expect("one slice for each turn").noted(flight, &mut frames.passes)?;
            let (rays, now) = (shot.rays(slice, &flight.heads.read()), Instant::now());
            frames.progress.rays += rays.path + rays.shadow;
            *frames.path_rays.get_or_insert_default() += rays.path;
            if *ends {
                frames.seconds.push((now - last).as_secs_f64());
                last = now;
            }
        }
        frames.progress.samples = u64::from(size[0]) * u64::from(size[1]) * u64::from(spp) * u64::from(count);
        Ok(frames)
    }

    /// Frames one by one, for paths without an end and pictures that take many slices.
    fn frames_by_renders(
        &self,
        view: &View,
        size: [u32; 2],
        spp: u32,
        count: u32,
    ) -> Result<Frames, VulkanError> {
        let mut frames = Frames::default();
        let mut film = Film::new(size[0], size[1]);
        for frame in 0..count {
            let began = Instant::now();
            let done = self.render(view, frame * spp..(frame + 1) * spp, &mut film, &())?;
            frames.seconds.push(began.elapsed().as_secs_f64());
            frames.progress.samples += done.samples;
            frames.progress.rays += done.rays;
        }
        Ok(frames)
    }

    fn flight(&self, shot: &Shot, begins: bool) -> Result<Flight, VulkanError> {
        let stamps = shot.passes.stamps(shot.extent(begins));
        Ok(Flight { timer: Timer::new(&self.gpu, stamps)?, heads: HeadsReadback::new(&self.gpu)? })
    }

    /// Submits the beginning of a slice, or further steps of its paths.
    fn submit(
        &self,
        work: &Work,
        shot: &Shot,
        flight: &Flight,
        (slice, begins): (&Slice, bool),
    ) -> Result<Submitted, VulkanError> {
        let paths = work.paths.as_ref().expect("the shot made them");
        assert!(slice.paths() <= paths.capacity().into(), "{slice:?} has no room");
        let push = shot.of(slice);
        let mut names = Vec::new();
        let pending = self.gpu.submit("path tracing", |commands| {
            names = shot.passes.record(commands, paths, &flight.timer, (&push, shot.extent(begins)));
            shot.passes.copy_heads(commands, paths, &flight.heads);
            Ok(())
        })?;
        Ok(Submitted(pending, names))
    }

    /// Goes on until the last path of a slice has ended, and brings it to the film, where the first submission could not. `None` when
    /// cancelled: the film is left without this slice.
    fn finish(
        &self,
        work: &mut Work,
        shot: &Shot,
        first: &Flight,
        (slice, control): (&Slice, &dyn Control),
    ) -> Result<Option<Rays>, VulkanError> {
        if shot.complete {
            return Ok(Some(shot.rays(slice, &first.heads.read())));
        }
        let flight = self.flight(shot, false)?;
        let mut heads = first.heads.read();
        while heads.at[queue::PATHS as usize].count > 0 {
            if control.cancelled() {
                return Ok(None);
            }
            self.submit(work, shot, &flight, (slice, false))?.noted(&flight, &mut work.times)?;
            heads = flight.heads.read();
        }
        let paths = work.paths.as_ref().expect("the shot made them");
        let extent = Extent { begins: false, steps: 0, ends: true };
        let timer = Timer::new(&self.gpu, shot.passes.stamps(extent))?;
        self.gpu.run("gathering paths", |commands| {
            shot.passes.record(commands, paths, &timer, (&shot.of(slice), extent));
            Ok(())
        })?;
        Ok(Some(shot.rays(slice, &heads)))
    }

    /// The film that the backend keeps for renders, empty, with room for one like this.
    fn own_film(&self, work: &mut Work, film: &Film) -> Result<Target, VulkanError> {
        let pixels = film.pixels().len() as u64;
        if work.film.as_ref().is_none_or(|f| f.pixels() < pixels || f.pixels() > 4 * pixels.max(1)) {
            // The old one goes first: there may not be room for both.
            work.film = None;
            work.film = Some(FilmOnGpu::new(&self.gpu, pixels)?);
        }
        let on_gpu = work.film.as_ref().expect("made above");
        on_gpu.empty(&self.gpu)?;
        Ok(Target { picture: film.picture_size(), crop: film.crop(), film: on_gpu.addresses() })
    }

    /// Gets ready for so many samples of each pixel of a film: pipelines, view, room for paths.
    fn shot(&self, work: &mut Work, view: &View, target: &Target, samples: u64) -> Result<Shot, VulkanError> {
        self.failed.clone().map_or(Ok(()), Err)?;
        let Variant { constants, needs, passes } = self.variant(work, &view.settings)?;
        let paths = paths_per_sample(target.crop.size).saturating_mul(samples);
        let paths = paths.clamp(LEAST_PATHS, MOST_PATHS);
        let solids = needs.solids;
        if work.paths.as_ref().is_none_or(|p| !p.suits(paths, solids)) {
            work.paths = None;
            work.paths = Some(self.room(paths.next_power_of_two(), solids)?);
        }
        let media = self.media_around(work, view.camera.origin);
        let table = self.view_table(view, target, work.paths.as_ref().expect("made above"), &media);
        let mut upload = Upload::new(&self.gpu);
        let table = Buffer::with_content(&mut upload, "view", bytemuck::bytes_of(&table))?;
        upload.finish()?;
        let push = Push {
            tables: self.tables.address(),
            scene: self.scene.address(),
            view: table.address(),
            first_pixel: [0, 0],
            size: [0, 0],
            first_sample: 0,
            sample_count: 0,
            parity: 0,
            group: 0,
        };
        let steps = max_depth(&view.settings) + 1;
        let complete = steps <= MOST_STEPS && !needs.catchers;
        // Even: each submission finds the paths in the first list. A catcher takes a step of its own.
        let steps =
            if complete { steps } else { (steps + SOME_CATCHERS).next_multiple_of(2).min(MOST_STEPS) };
        Ok(Shot { constants, passes, push, steps, complete, _view: table })
    }

    /// Room for so many paths, or for fewer where memory is short: slices are smaller then.
    fn room(&self, paths: u64, solids: bool) -> Result<Paths, VulkanError> {
        match Paths::new(&self.gpu, paths, solids) {
            Err(VulkanError::OutOfMemory { .. } | VulkanError::TooLarge { .. }) if paths > LEAST_PATHS => {
                Ok(self.room(paths / 2, solids)?.short())
            }
            made => made,
        }
    }

    fn view_table(&self, view: &View, target: &Target, paths: &Paths, media: &MediumStack) -> ViewTable {
        let settings = &view.settings;
        let Target { picture, crop, film: [film, non_finite] } = *target;
        let [state, queues, heads] = paths.addresses();
        ViewTable {
            film,
            non_finite,
            state,
            queues,
            heads,
            picture,
            origin: crop.origin,
            size: crop.size,
            capacity: paths.capacity(),
            seed: settings.seed,
            frame: view.frame,
            max_depth: max_depth(settings),
            roulette: settings.roulette.unwrap_or(u32::MAX),
            clamp_to: settings.clamp.unwrap_or(f32::INFINITY),
            filter_kind: settings.filter as u32,
            object_colors: settings.object_colors.into(),
            rough_bounces: settings.rough_bounces.unwrap_or(u32::MAX),
            camera: (&view.camera).into(),
            media: media.into(),
        }
    }

    /// The solids around the camera.
    fn media_around(&self, work: &mut Work, eye: Vec3) -> MediumStack {
        match work.media {
            Some((at, media)) if at == eye => media,
            _ => work.media.insert((eye, self.solids.around(eye))).1,
        }
    }

    /// The pipelines for these settings, made if there are none yet.
    fn variant(&self, work: &mut Work, settings: &RenderSettings) -> Result<Variant, VulkanError> {
        #[cfg(feature = "shader-reload")]
        if let Some(code) = work.watched.changed() {
            work.code = code;
            work.variants.clear();
        }
        let constants = self.constants.with(settings);
        // An edited scene may be served by those of an earlier one, which had more.
        let exact = work.variants.iter().position(|v| v.constants == constants);
        let found = exact
            .or_else(|| work.variants.iter().position(|v| SceneConstants::serves(&v.constants, &constants)));
        if let Some(found) = found {
            // The longest unused goes first.
            work.variants[..=found].rotate_right(1);
            return Ok(work.variants[0].clone());
        }
        let needs = self.constants.needs;
        let light_sampling = settings.light_sampling;
        let passes = Passes::new(&self.scene, &work.code, &constants, (needs, light_sampling), &self.cache)?;
        self.cache.save();
        work.variants.truncate(VARIANTS - 1);
        work.variants.insert(0, Variant { constants, needs, passes: Arc::new(passes) });
        Ok(work.variants[0].clone())
    }
}

impl Shot {
    /// For a slice.
    fn of(&self, slice: &Slice) -> Push {
        Push {
            first_pixel: slice.first_pixel,
            size: slice.size,
            first_sample: slice.samples.start,
            sample_count: slice.samples.len() as u32,
            ..self.push
        }
    }

    /// What a submission does.
    fn extent(&self, begins: bool) -> Extent {
        Extent { begins, steps: self.steps, ends: self.complete }
    }
}

impl Submitted {
    /// Waits, and adds its times.
    fn noted(self, flight: &Flight, times: &mut Vec<PassTime>) -> Result<(), VulkanError> {
        self.0.wait()?;
        let ms = flight.timer.milliseconds()?;
        for (pair, name) in ms.windows(2).zip(self.1) {
            PassTime::add(times, name, pair[1] - pair[0]);
        }
        Ok(())
    }
}

/// Most scattering events of a path.
fn max_depth(settings: &RenderSettings) -> u32 {
    settings.max_depth.map_or(RenderSettings::DEPTH_BOUND, |d| d.min(RenderSettings::DEPTH_BOUND))
}
