//! The CPU backend: prepares a scene, then renders ranges of samples into a film, tile by tile, on the rayon pool it is
//! called from.

use crate::accel::{Accel, CpuOptions};
use crate::bvh::{Hit, SimdLevel};
use crate::interaction::{Interaction, material_of};
use crate::observer::{PathObserver, RayCounter};
use crate::path;
use crate::tracer::Tracer;
use glam::Vec3;
use lumbre_core::Ray;
use lumbre_core::control::{Control, Progress};
use lumbre_core::film::{Crop, Film, FilmSample};
use lumbre_core::filter::Filter;
use lumbre_core::medium::MediumStack;
use lumbre_core::sampler::Sampler;
use lumbre_core::settings::View;
use lumbre_scene::compiled::material::flag;
use lumbre_scene::compiled::surroundings::{Crossing, surroundings};
use lumbre_scene::{CompiledScene, SceneChanges};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// Side of a tile, pixels.
const TILE: u32 = 16;

/// A scene ready to be rendered on the CPU.
#[derive(Debug)]
pub struct CpuBackend {
    scene: CompiledScene,
    accel: Accel,
}

impl CpuBackend {
    /// Builds the acceleration structures.
    pub fn new(scene: CompiledScene) -> Self {
        CpuBackend::with_options(scene, CpuOptions::default())
    }

    /// Builds the acceleration structures as `options` ask.
    pub fn with_options(scene: CompiledScene, options: CpuOptions) -> Self {
        let accel = Accel::with_options(&scene, options);
        CpuBackend { scene, accel }
    }

    /// Takes an edited scene, which differs from the present one in `changes`; what it then draws is what a new backend with the same
    /// options would draw.
    pub fn update(&mut self, scene: CompiledScene, changes: SceneChanges) {
        self.accel.update(&self.scene, &scene, changes);
        self.scene = scene;
    }

    /// Traverses with `level` from now on; the picture stays the same.
    ///
    /// # Panics
    /// If the processor does not support it.
    pub fn with_level(self, level: SimdLevel) -> Self {
        CpuBackend { accel: self.accel.with_level(level), ..self }
    }

    /// The scene.
    pub fn scene(&self) -> &CompiledScene {
        &self.scene
    }

    /// The acceleration structures.
    pub fn accel(&self) -> &Accel {
        &self.accel
    }

    fn shot<'a>(&'a self, view: &'a View, size: [u32; 2]) -> Shot<'a> {
        let tracer = Tracer { scene: &self.scene, accel: &self.accel, settings: &view.settings };
        let (filter, media) = (Filter::new(view.settings.filter), self.media_at(view.camera.origin));
        Shot { tracer, view, filter, media, size }
    }

    /// Adds the samples of `range` to every pixel of `film`, the whole picture or a part of it. Stops between rows of
    /// tiles when cancelled; pixels then differ in their sample counts. Returns what was done.
    pub fn render(&self, view: &View, range: Range<u32>, film: &mut Film, control: &dyn Control) -> Progress {
        let (width, height) = (film.width(), film.height());
        let (picture, origin) = (film.picture_size(), film.origin());
        let shot = self.shot(view, picture);
        let columns = width.div_ceil(TILE);
        let film = Mutex::new(film);
        let (samples, rays) = (AtomicU64::new(0), AtomicU64::new(0));
        (0..columns * height.div_ceil(TILE)).into_par_iter().for_each(|tile| {
            if control.cancelled() {
                return;
            }
            let at = [tile % columns * TILE, tile / columns * TILE];
            let size = [TILE.min(width - at[0]), TILE.min(height - at[1])];
            let at = [origin[0] + at[0], origin[1] + at[1]];
            let mut part = Film::window(picture, Crop { origin: at, size });
            let mut counter = RayCounter::default();
            let mut rows = 0;
            while rows < part.height() && !control.cancelled() {
                let y = rows;
                rows += 1;
                for x in 0..part.width() {
                    for index in range.clone() {
                        let sample = shot.sample([at[0] + x, at[1] + y], index, &mut counter);
                        part.add([x, y], index, &sample);
                    }
                }
            }
            let taken = u64::from(part.width()) * u64::from(rows) * range.len() as u64;
            film.lock().expect("no tile panics while it holds the film").merge_tile(&part);
            control.progress(Progress {
                samples: samples.fetch_add(taken, Ordering::Relaxed) + taken,
                rays: rays.fetch_add(counter.rays, Ordering::Relaxed) + counter.rays,
            });
        });
        Progress { samples: samples.into_inner(), rays: rays.into_inner() }
    }

    /// Takes one camera sample again, telling `observer` each step. `size` is that of the picture.
    pub fn replay(
        &self,
        view: &View,
        size: [u32; 2],
        pixel: [u32; 2],
        index: u32,
        observer: &mut impl PathObserver,
    ) -> FilmSample {
        self.shot(view, size).sample(pixel, index, observer)
    }

    /// The solids around a point: [`surroundings`].
    fn media_at(&self, point: Vec3) -> MediumStack {
        surroundings(&self.scene.materials, |dir| self.crossings(point, dir))
    }

    /// Surfaces of solids that a ray to infinity crosses.
    fn crossings(&self, point: Vec3, dir: Vec3) -> Vec<Crossing> {
        const MOST_CROSSINGS: usize = 256;
        let is_solid = |id: u32| self.scene.materials[id as usize].has(flag::SOLID);
        let mut ray = Ray::new(point, dir, 0.0);
        let mut crossings = Vec::new();
        for _ in 0..MOST_CROSSINGS {
            // Opaque surfaces do not ask the filter: they are passed below.
            let solids = |hit: &Hit| is_solid(material_of(&self.scene, hit));
            let Some(hit) = self.accel.closest_hit(&ray, solids) else { break };
            let it = Interaction::new(&self.scene, &ray, &hit);
            ray.origin = it.leave(dir);
            if is_solid(it.material) {
                crossings.push(Crossing { material: it.material, front: it.front });
            }
        }
        crossings
    }
}

/// What the samples of one picture have in common.
struct Shot<'a> {
    tracer: Tracer<'a>,
    view: &'a View,
    filter: Filter,
    /// The media around the camera.
    media: MediumStack,
    /// Size of the picture.
    size: [u32; 2],
}

impl Shot<'_> {
    /// Takes sample `index` of a pixel.
    #[inline]
    fn sample(&self, pixel: [u32; 2], index: u32, observer: &mut impl PathObserver) -> FilmSample {
        let settings = &self.view.settings;
        let sampler = Sampler::new(settings.sampler, settings.seed, self.view.frame, pixel, index);
        let offset = self.filter.sample(sampler.filter());
        let film = [0, 1].map(|i| (pixel[i] as f32 + 0.5 + offset[i]) / self.size[i] as f32);
        let camera = &self.view.camera;
        let lens = if camera.lens_radius > 0.0 { sampler.lens() } else { [0.5; 2] };
        let ray = camera.ray(film, lens, 0.0);
        path::radiance(&self.tracer, ray, self.media, &sampler, observer)
    }
}
