//! The pipelines of hybrid frames, and how a frame is recorded.

use super::memory::Memory;
use crate::compute::ComputePipeline;
use crate::gpu::lock;
use crate::path::code::{Code, Kinds};
use crate::path::variant::Needs;
use crate::raster::{Draws, Face, RasterPipeline};
use crate::{Commands, Gpu, PipelineCache, RayPipeline, SceneOnGpu, Specialisation, Timer, VulkanError};
use ash::vk;
use bytemuck::bytes_of;
use lumbre_core::hybrid::{AntiAliasing, HybridSettings};
use lumbre_shaders::hybrid::{FrameHeads, FramePush, passes};
use std::mem::offset_of;
use std::ops::Range;
use std::sync::{Arc, Mutex};

/// Pixels along each side of a work group.
const GROUP: u32 = 8;

/// Some draws and their pipeline.
pub(super) type Visible = (Arc<RasterPipeline>, Range<u32>);

/// The pipelines for what a scene has.
pub(crate) struct HybridPasses {
    needs: Needs,
    constants: Specialisation,
    /// Backs are drawn whatever a material says.
    shade_back_faces: bool,
    /// Made when a kind of triangle is first met.
    visible: Mutex<Vec<(Face, Arc<RasterPipeline>)>>,
    planes: ComputePipeline,
    advance: ComputePipeline,
    trace: RayPipeline,
    shade: ComputePipeline,
    shadow: RayPipeline,
    glass: Option<RayPipeline>,
    temporal: ComputePipeline,
    atrous: ComputePipeline,
    compose: ComputePipeline,
    anti_aliasing: [ComputePipeline; 2],
    gather: ComputePipeline,
}

/// What a frame does.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    /// Rays one after another.
    depth: u32,
    /// Passes of the filter over space.
    filters: u32,
    anti_aliasing: AntiAliasing,
}

/// Passes of the filter over space, the last with holes of 15 pixels.
const FILTERS: u32 = 5;

impl Course {
    pub(super) fn of(settings: &HybridSettings) -> Self {
        Course {
            depth: settings.depth,
            filters: if settings.filter && settings.has_soft_light() { FILTERS } else { 0 },
            anti_aliasing: settings.anti_aliasing,
        }
    }

    /// Passes of the filter over space.
    pub(super) fn filters(&self) -> u32 {
        self.filters
    }

    /// Stamps that a frame makes.
    pub(super) fn stamps(&self) -> usize {
        let filters = if self.filters > 0 { 2 } else { 0 };
        let edges = usize::from(self.anti_aliasing != AntiAliasing::None);
        // visible, planes, two for each generation of rays, compose, gather.
        5 + 2 * self.depth as usize + filters + edges
    }
}

impl HybridPasses {
    /// Makes them.
    ///
    /// # Errors
    /// If the driver refuses one or memory is out.
    pub(crate) fn new(
        scene: &SceneOnGpu,
        code: &Code,
        (constants, shade_back_faces): (&Specialisation, bool),
        needs: Needs,
        cache: &PipelineCache,
    ) -> Result<Self, VulkanError> {
        let push = size_of::<FramePush>() as u32;
        let compute = |code: &[u8]| ComputePipeline::of_scene(scene, code, constants, push, cache);
        let rays = |raygen: &[u8], kinds| {
            RayPipeline::new(scene, &code.rays(raygen, kinds, &needs), constants, push, cache)
        };
        Ok(HybridPasses {
            needs,
            constants: constants.clone(),
            shade_back_faces,
            visible: Mutex::default(),
            planes: compute(passes::PLANES)?,
            advance: compute(passes::ADVANCE)?,
            trace: rays(passes::TRACE, Kinds::Radiance)?,
            shade: compute(passes::SHADE)?,
            shadow: rays(passes::SHADOW, Kinds::Shadow)?,
            glass: needs.transmission.then(|| rays(passes::GLASS, Kinds::Radiance)).transpose()?,
            temporal: compute(passes::FILTER_TEMPORAL)?,
            atrous: compute(passes::FILTER_ATROUS)?,
            compose: compute(passes::COMPOSE)?,
            anti_aliasing: [compute(passes::AA_FXAA)?, compute(passes::AA_TEMPORAL)?],
            gather: compute(passes::GATHER)?,
        })
    }

    /// Whether rays carry the media that they are in.
    pub(super) fn solids(&self) -> bool {
        self.needs.solids
    }

    /// Draws, each with its pipeline.
    ///
    /// # Errors
    /// If the driver refuses one.
    pub(super) fn visible(
        &self,
        gpu: &Gpu,
        (pass, draws): (vk::RenderPass, &Draws),
        cache: &PipelineCache,
    ) -> Result<Vec<Visible>, VulkanError> {
        let of = |(face, batch): &(Face, Range<u32>)| {
            let culls = face.culls && !self.shade_back_faces;
            let face = Face { culls, mirrored: culls && face.mirrored, ..*face };
            Ok((self.pipeline(gpu, (pass, face), cache)?, batch.clone()))
        };
        draws.batches().iter().map(of).collect()
    }

    /// The pipeline that draws triangles of a kind.
    fn pipeline(
        &self,
        gpu: &Gpu,
        (pass, face): (vk::RenderPass, Face),
        cache: &PipelineCache,
    ) -> Result<Arc<RasterPipeline>, VulkanError> {
        let mut made = lock(&self.visible);
        if let Some((_, pipeline)) = made.iter().find(|p| p.0 == face) {
            return Ok(pipeline.clone());
        }
        let stages = match face.covered {
            true => [passes::COVERED_VERT, passes::COVERED_FRAG],
            false => [passes::VISIBLE_VERT, passes::VISIBLE_FRAG],
        };
        let told = (&self.constants, size_of::<FramePush>() as u32);
        let pipeline = Arc::new(RasterPipeline::new(gpu, stages, (pass, face), told, cache)?);
        made.push((face, pipeline.clone()));
        Ok(pipeline)
    }

    /// Records a frame. Makes the stamps of the timer; returns what is between them.
    pub(super) fn record(
        &self,
        commands: &Commands<'_>,
        (memory, draws, visible): (&Memory, &Draws, &[Visible]),
        timer: &Timer,
        (push, course): (&FramePush, &Course),
    ) -> Vec<&'static str> {
        let mut names = Vec::new();
        let mut done = |name| {
            names.push(name);
            timer.stamp(commands, names.len());
            commands.barrier();
        };
        let [width, height] = memory.size();
        let groups = [width.div_ceil(GROUP), height.div_ceil(GROUP)];
        timer.reset(commands);
        timer.stamp(commands, 0);
        memory.target.draw(commands, || {
            for (pipeline, batch) in visible {
                pipeline.bind(commands, bytes_of(push));
                draws.record(commands, batch);
            }
        });
        done("visible");
        self.planes.dispatch(commands, bytes_of(push), groups);
        done("planes");
        for generation in 0..course.depth {
            let list = generation % 2;
            let mut push = *push;
            push.path.parity = list;
            self.advance.dispatch(commands, bytes_of(&push), [1, 1]);
            commands.barrier();
            let [rays, shadows] = memory.most();
            let at = |offset| (memory.heads(), offset);
            self.trace.trace_indirect(commands, bytes_of(&push), at(Memory::rays_head(list)), rays);
            self.shadow.trace_indirect(commands, bytes_of(&push), at(Memory::shadows_head(list)), shadows);
            done("trace + shadow");
            let sizes = at(offset_of!(FrameHeads, groups) as u64);
            self.shade.dispatch_indirect(commands, bytes_of(&push), sizes);
            if let Some(glass) = &self.glass {
                glass.trace_indirect(commands, bytes_of(&push), at(Memory::glass_head(list)), shadows);
            }
            done("shade + glass");
        }
        let with = |number: u32| {
            let mut push = *push;
            push.path.sample_count = number;
            push
        };
        if course.filters > 0 {
            self.temporal.dispatch(commands, bytes_of(push), groups);
            done("filter over time");
            for pass in 0..course.filters {
                self.atrous.dispatch(commands, bytes_of(&with(pass)), groups);
                commands.barrier();
            }
            done("filter over space");
        }
        self.compose.dispatch(commands, bytes_of(&with(course.filters)), groups);
        memory.keep_planes(commands);
        done("compose");
        let [shown_width, shown_height] = memory.shape().shown;
        let shown_groups = [shown_width.div_ceil(GROUP), shown_height.div_ceil(GROUP)];
        let [fxaa, temporal] = &self.anti_aliasing;
        match course.anti_aliasing {
            AntiAliasing::None => {}
            AntiAliasing::Fxaa => fxaa.dispatch(commands, bytes_of(push), groups),
            AntiAliasing::Temporal => temporal.dispatch(commands, bytes_of(push), shown_groups),
        }
        let edges = u32::from(course.anti_aliasing != AntiAliasing::None);
        if edges > 0 {
            done("anti-aliasing");
        }
        self.gather.dispatch(commands, bytes_of(&with(edges)), shown_groups);
        done("gather");
        names
    }
}
