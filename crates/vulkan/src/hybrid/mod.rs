//! Hybrid frames: the rasteriser finds what the camera sees, rays bring the rest.
//!
//! ```text
//! visible   triangles of all pixels, as numbers (rasterised)
//! planes    surface of each pixel: its planes, its first light; asks for rays and shadow rays
//! for each ray one after another:
//!   trace   closest surfaces of rays      ║ shadow   shadow rays asked for before
//!   shade   what rays met; asks for more  ║ glass    those that meet what lets light through
//! filter    soft light over time, then over space
//! compose   sharp and soft light
//! anti-aliasing
//! gather    the picture and its planes to a film of one sample
//! ```
//!
//! Surfaces, lights and rays are those of the path tracer (`glsl/path`), and so are hit and miss shaders; ray generation and binding tables are
//! the frame's own. Where perfect lobes split light, all of them are followed (Whitted 1980), so that these cost no noise: rays lie in lists, as
//! paths do (`path/passes.rs` says why), each may leave several, and light is added to pixels as integers, so that no order matters.

mod memory;
mod passes;
mod scene;

pub(crate) use passes::HybridPasses;
pub(crate) use scene::HybridScene;

use crate::path::film::FilmOnGpu;
use crate::{Buffer, Gpu, Pending, Timer, VulkanBackend, VulkanError};
use bytemuck::bytes_of;
use lumbre_core::film::Film;
use lumbre_core::hybrid::{AntiAliasing, FrameDone, FrameView, HybridSettings, PixelPlanes};
use lumbre_shaders::camera::CameraRecord;
use lumbre_shaders::hybrid::FramePush;
use lumbre_shaders::view::Push;
use memory::{Memory, Shape, Since};
use passes::Course;
use std::collections::VecDeque;
use std::sync::Arc;

/// Draws frames of a scene, one after another.
pub struct Hybrid<'a> {
    backend: &'a VulkanBackend,
    /// `None` only while it is dropped.
    kept: Option<KeptFrames>,
    /// The last frame as it was read, unless there has been another since.
    host: Option<Film>,
    /// Frames under way, the oldest first: two at most.
    under_way: VecDeque<Flight>,
}

/// What frames leave for those to come, though the scene be edited in between: light goes on from there.
pub(crate) struct KeptFrames {
    memory: Option<Memory>,
    film: FilmOnGpu,
    /// The frame before.
    previous: Option<Previous>,
}

/// What a frame leaves for the next.
#[derive(Clone, Copy, PartialEq)]
struct Previous {
    camera: CameraRecord,
    settings: HybridSettings,
    jitter: [f32; 2],
    turn: u32,
    /// Updates of the scene until then.
    version: u64,
}

/// A frame under way, and where its figures will be.
struct Flight {
    pending: Pending,
    timer: Timer,
    names: Vec<&'static str>,
    heads: Buffer,
    /// Held for its address.
    _transforms: Option<Buffer>,
}

impl VulkanBackend {
    /// Gets ready to draw frames.
    ///
    /// # Errors
    /// If the device lacks what that takes, or memory is out.
    pub fn hybrid(&self) -> Result<Hybrid<'_>, VulkanError> {
        let adapter = self.gpu().adapter();
        if !adapter.features.hybrid {
            let what = adapter.lacks_for_hybrid.clone();
            return Err(VulkanError::Missing { device: adapter.name.clone(), what });
        }
        let kept = match self.take_frames() {
            Some(kept) => kept,
            None => KeptFrames { memory: None, film: FilmOnGpu::new(self.gpu(), 1)?, previous: None },
        };
        Ok(Hybrid { backend: self, kept: Some(kept), host: None, under_way: VecDeque::new() })
    }
}

impl Drop for Hybrid<'_> {
    fn drop(&mut self) {
        self.under_way.clear();
        self.kept.take().into_iter().for_each(|kept| self.backend.keep_frames(kept));
    }
}

impl Hybrid<'_> {
    /// Draws a frame.
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub fn frame(&mut self, shot: &FrameView<'_>) -> Result<FrameDone, VulkanError> {
        self.submit(shot)?;
        let mut last = FrameDone::default();
        while let Some(done) = self.finish()? {
            last = done;
        }
        Ok(last)
    }

    /// Begins a frame; returns one that was under way before, once there are two.
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub fn next(&mut self, shot: &FrameView<'_>) -> Result<Option<FrameDone>, VulkanError> {
        self.submit(shot)?;
        if self.under_way.len() < 2 { Ok(None) } else { self.finish() }
    }

    /// Waits for the oldest frame under way; `None`: there is none.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn finish(&mut self) -> Result<Option<FrameDone>, VulkanError> {
        self.under_way.pop_front().map(Flight::done).transpose()
    }

    fn kept(&mut self) -> &mut KeptFrames {
        self.kept.as_mut().expect("there until it is dropped")
    }
}

impl KeptFrames {
    /// Memory for frames of this shape.
    fn make_room(&mut self, gpu: &Gpu, shape: &Shape) -> Result<(), VulkanError> {
        if self.memory.as_ref().is_none_or(|m| m.shape() != shape) {
            // The old one goes first: there may not be room for both.
            (self.memory, self.previous) = (None, None);
            self.memory = Some(Memory::new(gpu, shape)?);
        }
        let pixels = u64::from(shape.shown[0]) * u64::from(shape.shown[1]);
        if self.film.pixels() != pixels {
            self.film = FilmOnGpu::new(gpu, pixels)?;
        }
        Ok(())
    }
}

impl Hybrid<'_> {
    fn submit(&mut self, shot: &FrameView<'_>) -> Result<(), VulkanError> {
        let &FrameView { view, size, settings } = shot;
        let backend = self.backend;
        let gpu = backend.gpu();
        let (passes, media) = backend.hybrid_parts(view, settings)?;
        self.host = None;
        let drawn = settings.drawn_size(size);
        let kept = self.kept();
        kept.make_room(
            gpu,
            &Shape {
                size: drawn,
                shown: size,
                solids: passes.solids(),
                sharp_lights: backend.hybrid_scene().sharp_light_count(),
                soft: settings.has_soft_light(),
            },
        )?;
        let scene = backend.scene_on_gpu();
        let camera = CameraRecord::from(&view.camera);
        let transforms = scene.take_previous_transforms();
        let transforms_address = transforms.as_ref().map_or(scene.transforms(), Buffer::address);
        let now = Previous {
            camera,
            settings: *settings,
            jitter: jitter(settings, view.frame),
            turn: kept.previous.map_or(0, |p| 1 - p.turn),
            version: backend.version(),
        };
        let since = since(kept.previous.as_ref(), &now, transforms_address);
        kept.previous = Some(now);
        let KeptFrames { memory, film, .. } = &*kept;
        let memory = memory.as_ref().expect("made above");
        let tables = memory.tables(backend, (view, settings), film.addresses(), (&media, &since));
        let path = Push {
            tables: backend.tables_address(),
            scene: scene.address(),
            view: memory.view_address(),
            first_pixel: [0, 0],
            size: drawn,
            first_sample: view.frame,
            sample_count: 1,
            parity: 0,
            group: 0,
        };
        let push = FramePush { path, frame: memory.frame_address() };
        let draws = &scene.draws;
        let visible = passes.visible(gpu, (memory.target.pass(), draws), backend.pipeline_cache())?;
        let course = Course::of(settings);
        let timer = Timer::new(gpu, course.stamps())?;
        let heads = Memory::readback(gpu)?;
        let mut names = Vec::new();
        let pending = gpu.submit("a hybrid frame", |commands| {
            memory.begin(commands, [bytes_of(&tables.0), bytes_of(&tables.1)], since.turn);
            film.begin(commands);
            names = passes.record(commands, (memory, draws, &visible), &timer, (&push, &course));
            memory.copy_heads(commands, &heads);
            Ok(())
        })?;
        self.under_way.push_back(Flight { pending, timer, names, heads, _transforms: transforms });
        Ok(())
    }

    /// What the last frame knows of its pixels, row by row from the top; its columns and rows are those of [`HybridSettings::drawn_size`].
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    ///
    /// # Panics
    /// Before the first frame.
    pub fn planes(&mut self) -> Result<Vec<PixelPlanes>, VulkanError> {
        let gpu = self.backend.gpu();
        let kept = self.kept();
        let filters = kept.previous.map_or(0, |p| Course::of(&p.settings).filters());
        kept.memory.as_ref().expect("a frame was drawn").read_planes(gpu, filters)
    }

    /// The last frame, as a film of one sample.
    ///
    /// # Errors
    /// If the device is lost.
    ///
    /// # Panics
    /// Before the first frame.
    pub fn film(&mut self) -> Result<&Film, VulkanError> {
        let film = match self.host.take() {
            Some(film) => film,
            None => {
                let gpu = self.backend.gpu();
                let kept = self.kept();
                let [width, height] = kept.memory.as_ref().expect("a frame was drawn").shape().shown;
                let mut film = Film::new(width, height);
                kept.film.read(gpu, &mut film)?;
                film
            }
        };
        Ok(self.host.insert(film))
    }
}

/// What was before a frame.
fn since(before: Option<&Previous>, now: &Previous, transforms: u64) -> Since {
    let before = before.filter(|p| p.settings == now.settings);
    Since {
        camera: before.map_or(now.camera, |p| p.camera),
        transforms,
        jitter: now.jitter,
        previous_jitter: before.map_or(now.jitter, |p| p.jitter),
        turn: now.turn,
        has_history: before.is_some(),
        is_still: before.is_some_and(|p| p.camera == now.camera && p.version == now.version),
    }
}

/// Places in their pixels through which frames look one after another.
const PLACES: u32 = 32;

/// Where in its pixels a frame looks, from the centre, pixels: points of Halton's sequence in bases 2 and 3.
fn jitter(settings: &HybridSettings, frame: u32) -> [f32; 2] {
    if settings.anti_aliasing != AntiAliasing::Temporal {
        return [0.0; 2];
    }
    let at = frame % PLACES + 1;
    [2, 3].map(|base| {
        let (mut n, mut digit, mut sum) = (at, 1.0, 0.0);
        while n > 0 {
            digit /= base as f32;
            sum += digit * (n % base) as f32;
            n /= base;
        }
        sum - 0.5
    })
}

impl Flight {
    fn done(self) -> Result<FrameDone, VulkanError> {
        self.pending.wait()?;
        let ms = self.timer.milliseconds()?;
        let passes = ms.windows(2).zip(self.names).map(|(pair, name)| (name, pair[1] - pair[0])).collect();
        Ok(FrameDone { report: Memory::report(&self.heads), passes })
    }
}

/// The passes for a choice of settings, kept by the backend.
pub(crate) type Kept = Vec<(crate::Specialisation, Arc<HybridPasses>)>;
