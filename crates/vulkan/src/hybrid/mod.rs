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
use crate::{Buffer, Pending, Timer, VulkanBackend, VulkanError};
use bytemuck::bytes_of;
use lumbre_core::film::Film;
use lumbre_core::hybrid::{AntiAliasing, FrameDone, FrameView, HybridSettings};
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
    memory: Option<Memory>,
    film: FilmOnGpu,
    /// The frame before.
    previous: Option<Previous>,
    /// The last frame as it was read, unless there has been another since.
    host: Option<Film>,
    /// Frames under way, the oldest first: two at most.
    under_way: VecDeque<Flight>,
}

/// What a frame leaves for the next.
#[derive(Clone, Copy, PartialEq)]
struct Previous {
    camera: CameraRecord,
    settings: HybridSettings,
    jitter: [f32; 2],
    turn: u32,
}

/// A frame under way, and where its figures will be.
struct Flight {
    pending: Pending,
    timer: Timer,
    names: Vec<&'static str>,
    heads: Buffer,
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
        Ok(Hybrid {
            backend: self,
            memory: None,
            film: FilmOnGpu::new(self.gpu(), 1)?,
            previous: None,
            host: None,
            under_way: VecDeque::new(),
        })
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

    /// Memory for frames of this shape.
    fn make_room(&mut self, shape: &Shape) -> Result<(), VulkanError> {
        let gpu = self.backend.gpu();
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

    fn submit(&mut self, shot: &FrameView<'_>) -> Result<(), VulkanError> {
        let &FrameView { view, size, settings } = shot;
        let backend = self.backend;
        let gpu = backend.gpu();
        let (passes, media) = backend.hybrid_parts(view, settings)?;
        self.host = None;
        let drawn = settings.drawn_size(size);
        self.make_room(&Shape {
            size: drawn,
            shown: size,
            solids: passes.solids(),
            sharp_lights: backend.hybrid_scene().sharp_light_count(),
            soft: settings.has_soft_light(),
        })?;
        let memory = self.memory.as_ref().expect("made above");
        let camera = CameraRecord::from(&view.camera);
        let since = since(self.previous.as_ref(), &camera, shot, backend.scene_on_gpu().transforms());
        self.previous =
            Some(Previous { camera, settings: *settings, jitter: since.jitter, turn: since.turn });
        let tables = memory.tables(backend, (view, settings), self.film.addresses(), (&media, &since));
        let path = Push {
            tables: backend.tables_address(),
            scene: backend.scene_on_gpu().address(),
            view: memory.view_address(),
            first_pixel: [0, 0],
            size: drawn,
            first_sample: view.frame,
            sample_count: 1,
            parity: 0,
            group: 0,
        };
        let push = FramePush { path, frame: memory.frame_address() };
        let draws = &backend.scene_on_gpu().draws;
        let visible = passes.visible(gpu, (memory.target.pass(), draws), backend.pipeline_cache())?;
        let course = Course::of(settings);
        let timer = Timer::new(gpu, course.stamps())?;
        let heads = Memory::readback(gpu)?;
        let mut names = Vec::new();
        let pending = gpu.submit("a hybrid frame", |commands| {
            memory.begin(commands, [bytes_of(&tables.0), bytes_of(&tables.1)], since.turn);
            self.film.begin(commands);
            names = passes.record(commands, (memory, draws, &visible), &timer, (&push, &course));
            memory.copy_heads(commands, &heads);
            Ok(())
        })?;
        self.under_way.push_back(Flight { pending, timer, names, heads });
        Ok(())
    }

    /// The last frame, as a film of one sample.
    ///
    /// # Errors
    /// If the device is lost.
    ///
    /// # Panics
    /// Before the first frame.
    pub fn film(&mut self) -> Result<&Film, VulkanError> {
        let [width, height] = self.memory.as_ref().expect("a frame was drawn").shape().shown;
        let film = match self.host.take() {
            Some(film) => film,
            None => {
                let mut film = Film::new(width, height);
                self.film.read(self.backend.gpu(), &mut film)?;
                film
            }
        };
        Ok(self.host.insert(film))
    }
}

/// What was before a frame.
fn since(previous: Option<&Previous>, camera: &CameraRecord, shot: &FrameView<'_>, transforms: u64) -> Since {
    let same = previous.filter(|p| p.settings == *shot.settings);
    let jitter = match shot.settings.anti_aliasing {
        AntiAliasing::Temporal => jitter(shot.view.frame),
        AntiAliasing::None | AntiAliasing::Fxaa => [0.0; 2],
    };
    Since {
        camera: same.map_or(*camera, |p| p.camera),
        transforms,
        jitter,
        previous_jitter: same.map_or(jitter, |p| p.jitter),
        turn: previous.map_or(0, |p| 1 - p.turn),
        has_history: same.is_some(),
        is_still: same.is_some_and(|p| p.camera == *camera),
    }
}

/// Places in their pixels through which frames look one after another.
const PLACES: u32 = 32;

/// Offset from the centre of a pixel, pixels: points of Halton's sequence in bases 2 and 3.
fn jitter(frame: u32) -> [f32; 2] {
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
