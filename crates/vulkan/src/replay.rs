//! Rays from a list through a scene, with no shading at all: what they hit, and how fast the device is at best.

use crate::buffer::{Buffer, Purpose};
use crate::cache::PipelineCache;
use crate::error::VulkanError;
use crate::ray_pipeline::{HitShaders, RayPipeline, RayShaders};
use crate::scene::SceneOnGpu;
use crate::specialisation::Specialisation;
use crate::timer::Timer;
use crate::upload::Upload;
use bytemuck::Pod;
use lumbre_shaders::replay::{self, Push, ReplayHit, ReplayRay, TextureAnswer, TextureQuery};
use lumbre_shaders::tables::tables;

/// A pipeline that replays rays through a scene.
pub struct Replay<'a> {
    scene: &'a SceneOnGpu,
    pipeline: RayPipeline,
    /// Tables of numbers, if the shaders read them.
    tables: Option<Buffer>,
}

impl<'a> Replay<'a> {
    /// `all_pass`: surfaces that a ray has to ask let it pass; otherwise they stop it.
    ///
    /// # Errors
    /// If the driver refuses the pipeline, or memory is out.
    pub fn new(scene: &'a SceneOnGpu, all_pass: bool, cache: &PipelineCache) -> Result<Self, VulkanError> {
        Self::with(scene, replay::RGEN, &Specialisation::new().bool(0, all_pass), cache)
    }

    /// Surfaces are asked as the path tracer asks them: by the key of each ray. `constants`: those of the path tracer's shaders.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(crate) fn asking(
        scene: &'a SceneOnGpu,
        constants: &Specialisation,
        cache: &PipelineCache,
    ) -> Result<Self, VulkanError> {
        let any = [Some(replay::PATH_RAHIT), Some(replay::SHADOW_RAHIT)];
        Self::with_any(scene, (replay::RGEN, any), constants, cache)
    }

    fn with(
        scene: &'a SceneOnGpu,
        raygen: &[u8],
        constants: &Specialisation,
        cache: &PipelineCache,
    ) -> Result<Self, VulkanError> {
        Self::with_any(scene, (raygen, [Some(replay::RAHIT); 2]), constants, cache)
    }

    /// `any`: any hit of rays of paths and of shadow rays.
    fn with_any(
        scene: &'a SceneOnGpu,
        (raygen, [path, shadow]): (&[u8], [Option<&[u8]>; 2]),
        constants: &Specialisation,
        cache: &PipelineCache,
    ) -> Result<Self, VulkanError> {
        let closest = Some(replay::RCHIT);
        let shaders = RayShaders {
            raygen,
            miss: [replay::PATH_RMISS, replay::SHADOW_RMISS],
            // The rows are those of `HitClass`: opaque, transmissive, covered.
            hits: [
                [HitShaders { closest, any: None }, HitShaders::default()],
                [HitShaders { closest, any: None }, HitShaders { closest: None, any: shadow }],
                [HitShaders { closest, any: path }, HitShaders { closest: None, any: shadow }],
            ],
        };
        let pipeline = RayPipeline::new(scene, &shaders, constants, size_of::<Push>() as u32, cache)?;
        Ok(Replay { scene, pipeline, tables: None })
    }

    /// What each ray hits, and how long the device took, milliseconds.
    ///
    /// # Errors
    /// If memory is out, the rays are too many for one launch, or the device is lost.
    pub fn run(&self, rays: &[ReplayRay]) -> Result<(Vec<ReplayHit>, f64), VulkanError> {
        self.answers(rays)
    }

    /// How long the device takes for groups of launches, milliseconds: for each of `runs`, which follow one that does not count, a number
    /// for each group. The launches of a group run beside one another, the next group waits for them.
    ///
    /// # Errors
    /// As [`Self::run`].
    pub fn times(&self, groups: &[Vec<&[ReplayRay]>], runs: u32) -> Result<Vec<Vec<f64>>, VulkanError> {
        let gpu = self.scene.gpu();
        let mut upload = Upload::new(gpu);
        let mut launches = Vec::new();
        // A group's launches write to places of their own.
        let mut most = 0;
        for group in groups {
            let (mut at, mut buffers) = (0, Vec::new());
            for rays in group.iter().filter(|rays| !rays.is_empty()) {
                self.check(rays.len())?;
                let rays_there = Buffer::with_content(&mut upload, "rays", bytemuck::cast_slice(rays))?;
                buffers.push((rays_there, at, rays.len() as u32));
                at += (rays.len() * size_of::<ReplayHit>()) as u64;
            }
            most = most.max(at);
            launches.push(buffers);
        }
        upload.finish()?;
        let hits = Buffer::new(gpu, "hits", most, Purpose::Data)?;
        let timer = Timer::new(gpu, groups.len() + 1)?;
        let mut times = Vec::new();
        for _ in 0..=runs {
            gpu.run("replayed rays", |c| {
                timer.reset(c);
                timer.stamp(c, 0);
                for (i, group) in launches.iter().enumerate() {
                    for (rays, at, count) in group {
                        let push = self.push(rays.address(), hits.address() + at, *count);
                        self.pipeline.trace(c, bytemuck::bytes_of(&push), [*count, 1, 1]);
                    }
                    timer.stamp(c, i + 1);
                    c.barrier();
                }
                Ok(())
            })?;
            times.push(timer.milliseconds()?.windows(2).map(|pair| pair[1] - pair[0]).collect());
        }
        times.remove(0);
        Ok(times)
    }

    /// # Errors
    /// If so many rays are too many for one launch.
    fn check(&self, rays: usize) -> Result<(), VulkanError> {
        let (needed, limit) = (rays as u64, self.pipeline.max_invocations());
        if needed > limit {
            return Err(VulkanError::TooLarge { what: "rays".to_owned(), needed, limit });
        }
        Ok(())
    }

    fn push(&self, rays: u64, hits: u64, count: u32) -> Push {
        let tables = self.tables.as_ref().map_or(0, Buffer::address);
        Push { tables, scene: self.scene.address(), rays, hits, count, unused: 0 }
    }

    /// An answer for each item, and how long the device took, milliseconds.
    fn answers<Q: Pod, A: Pod>(&self, items: &[Q]) -> Result<(Vec<A>, f64), VulkanError> {
        let gpu = self.scene.gpu();
        self.check(items.len())?;
        if items.is_empty() {
            return Ok((Vec::new(), 0.0));
        }
        let mut upload = Upload::new(gpu);
        let input = Buffer::with_content(&mut upload, "rays", bytemuck::cast_slice(items))?;
        upload.finish()?;
        let size = (items.len() * size_of::<A>()) as u64;
        let output = Buffer::new(gpu, "hits", size, Purpose::Data)?;
        let result = Buffer::new(gpu, "hits on the host", size, Purpose::Readback)?;
        let push = self.push(input.address(), output.address(), items.len() as u32);
        let timer = Timer::new(gpu, 2)?;
        gpu.run("replayed rays", |c| {
            timer.reset(c);
            timer.stamp(c, 0);
            self.pipeline.trace(c, bytemuck::bytes_of(&push), [items.len() as u32, 1, 1]);
            timer.stamp(c, 1);
            c.barrier();
            c.copy((&output, 0), (&result, 0), size);
            Ok(())
        })?;
        Ok((result.read_as(), timer.milliseconds()?[1]))
    }
}

impl SceneOnGpu {
    /// What textures hold at some places: for tests.
    ///
    /// # Errors
    /// If the driver refuses the pipeline, memory is out, or the device is lost.
    pub fn look_up(&self, places: &[TextureQuery]) -> Result<Vec<TextureAnswer>, VulkanError> {
        let constants = Specialisation::new();
        let cache = PipelineCache::open_in(self.gpu(), None);
        let mut replay = Replay::with(self, replay::TEXTURE_RGEN, &constants, &cache)?;
        let mut upload = Upload::new(self.gpu());
        replay.tables = Some(Buffer::with_content(&mut upload, "tables of numbers", &tables())?);
        upload.finish()?;
        Ok(replay.answers(places)?.0)
    }
}
