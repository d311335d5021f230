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

    fn with(
        scene: &'a SceneOnGpu,
        raygen: &[u8],
        constants: &Specialisation,
        cache: &PipelineCache,
    ) -> Result<Self, VulkanError> {
        let closest = Some(replay::RCHIT);
        let any = Some(replay::RAHIT);
        let shaders = RayShaders {
            raygen,
            miss: [replay::PATH_RMISS, replay::SHADOW_RMISS],
            // The rows are those of `HitClass`: opaque, transmissive, covered.
            hits: [
                [HitShaders { closest, any: None }, HitShaders::default()],
                [HitShaders { closest, any: None }, HitShaders { closest: None, any }],
                [HitShaders { closest, any }, HitShaders { closest: None, any }],
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

    /// An answer for each item, and how long the device took, milliseconds.
    fn answers<Q: Pod, A: Pod>(&self, items: &[Q]) -> Result<(Vec<A>, f64), VulkanError> {
        let gpu = self.scene.gpu();
        let (needed, limit) = (items.len() as u64, self.pipeline.max_invocations());
        if needed > limit {
            return Err(VulkanError::TooLarge { what: "rays".to_owned(), needed, limit });
        }
        if items.is_empty() {
            return Ok((Vec::new(), 0.0));
        }
        let mut upload = Upload::new(gpu);
        let input = Buffer::with_content(&mut upload, "rays", bytemuck::cast_slice(items))?;
        upload.finish()?;
        let size = (items.len() * size_of::<A>()) as u64;
        let output = Buffer::new(gpu, "hits", size, Purpose::Data)?;
        let result = Buffer::new(gpu, "hits on the host", size, Purpose::Readback)?;
        let push = Push {
            tables: self.tables.as_ref().map_or(0, Buffer::address),
            scene: self.scene.address(),
            rays: input.address(),
            hits: output.address(),
            count: items.len() as u32,
            unused: 0,
        };
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
