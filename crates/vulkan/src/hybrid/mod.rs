//! Hybrid frames: the rasteriser finds what the camera sees, rays bring the rest.
//!
//! ```text
//! visible   triangles of all pixels, as numbers (rasterised)
//! planes    surface of each pixel: its planes, its first light; asks for rays and shadow rays
//! for each ray one after another:
//!   trace   closest surfaces of rays      ║ shadow   shadow rays asked for before
//!   shade   what rays met; asks for more  ║ glass    those that meet what lets light through
//! gather    light and planes to a film of one sample
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
use lumbre_core::hybrid::{FrameDone, FrameView};
use lumbre_shaders::camera::CameraRecord;
use lumbre_shaders::hybrid::FramePush;
use lumbre_shaders::view::Push;
use memory::Memory;
use std::collections::VecDeque;
use std::sync::Arc;

/// Draws frames of a scene, one after another.
pub struct Hybrid<'a> {
    backend: &'a VulkanBackend,
    memory: Option<Memory>,
    film: FilmOnGpu,
    /// The camera of the frame before.
    previous: Option<CameraRecord>,
    /// The last frame as it was read, unless there has been another since.
    host: Option<Film>,
    /// Frames under way, the oldest first: two at most.
    under_way: VecDeque<Flight>,
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

    /// Memory for frames of this size.
    fn make_room(&mut self, size: [u32; 2], solids: bool) -> Result<(), VulkanError> {
        let gpu = self.backend.gpu();
        let sharp = self.backend.hybrid_scene().sharp_light_count();
        if self.memory.as_ref().is_none_or(|m| !m.suits(size, solids, sharp)) {
            // The old one goes first: there may not be room for both.
            self.memory = None;
            self.memory = Some(Memory::new(gpu, size, solids, sharp)?);
        }
        let pixels = u64::from(size[0]) * u64::from(size[1]);
        if self.film.pixels() != pixels {
            self.film = FilmOnGpu::new(gpu, pixels)?;
        }
        Ok(())
    }

    fn submit(&mut self, shot: &FrameView<'_>) -> Result<(), VulkanError> {
        let &FrameView { view, size, settings } = shot;
        let backend = self.backend;
        let gpu = backend.gpu();
        let (passes, media) = backend.hybrid_parts(view)?;
        self.host = None;
        self.make_room(size, passes.solids())?;
        let memory = self.memory.as_ref().expect("made above");
        let camera = CameraRecord::from(&view.camera);
        let previous = self.previous.replace(camera).unwrap_or(camera);
        let tables = memory.tables(backend, (view, settings), self.film.addresses(), (&media, previous));
        let path = Push {
            tables: backend.tables_address(),
            scene: backend.scene_on_gpu().address(),
            view: memory.view_address(),
            first_pixel: [0, 0],
            size,
            first_sample: 0,
            sample_count: 1,
            parity: 0,
            group: 0,
        };
        let push = FramePush { path, frame: memory.frame_address() };
        let draws = &backend.scene_on_gpu().draws;
        let visible = passes.visible(gpu, (memory.target.pass(), draws), backend.pipeline_cache())?;
        let timer = Timer::new(gpu, passes.stamps(settings.depth))?;
        let heads = Memory::readback(gpu)?;
        let mut names = Vec::new();
        let pending = gpu.submit("a hybrid frame", |commands| {
            memory.begin(commands, [bytes_of(&tables.0), bytes_of(&tables.1)]);
            self.film.begin(commands);
            names = passes.record(commands, (memory, draws, &visible), &timer, (&push, settings.depth));
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
        let [width, height] = self.memory.as_ref().expect("a frame was drawn").size();
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
