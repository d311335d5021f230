//! Ray tracing pipelines: from SPIR-V to dispatches.

use crate::buffer::Buffer;
use crate::cache::PipelineCache;
use crate::commands::Commands;
use crate::descriptors::{Descriptors, STAGES};
use crate::error::{Called, VulkanError};
use crate::gpu::Gpu;
use crate::pipeline::{Layout, ShaderModule};
use crate::sbt::BindingTable;
use crate::scene::SceneOnGpu;
use crate::specialisation::Specialisation;
use crate::statistics::{self, ShaderStatistics};
use ash::vk;
use lumbre_shaders::layout::{HitClass, RAY_KINDS};
use std::sync::Arc;

/// SPIR-V of the shaders of a hit.
#[derive(Clone, Copy, Debug, Default)]
pub struct HitShaders<'a> {
    /// For the closest hit.
    pub closest: Option<&'a [u8]>,
    /// For every candidate of a geometry that is not opaque.
    pub any: Option<&'a [u8]>,
}

/// SPIR-V of all shaders of a pipeline.
#[derive(Clone, Copy, Debug)]
pub struct RayShaders<'a> {
    /// Ray generation.
    pub raygen: &'a [u8],
    /// What a ray of each kind does when it meets nothing.
    pub miss: [&'a [u8]; RAY_KINDS as usize],
    /// What a ray of each kind does when it meets a triangle of each class.
    pub hits: [[HitShaders<'a>; RAY_KINDS as usize]; HitClass::ALL.len()],
}

/// A ray tracing pipeline for a scene, which must live as long.
pub struct RayPipeline {
    gpu: Gpu,
    raw: vk::Pipeline,
    layout: Layout,
    descriptors: Arc<Descriptors>,
    table: BindingTable,
}

/// The stages of a pipeline, each module once.
struct Stages<'a> {
    gpu: &'a Gpu,
    code: Vec<(vk::ShaderStageFlags, &'a [u8])>,
    modules: Vec<ShaderModule>,
}

impl<'a> Stages<'a> {
    /// The place of a stage among all.
    fn add(&mut self, stage: vk::ShaderStageFlags, code: &'a [u8]) -> Result<u32, VulkanError> {
        let same = |&(s, c): &(vk::ShaderStageFlags, &[u8])| s == stage && std::ptr::eq(c, code);
        let at = match self.code.iter().position(same) {
            Some(at) => at,
            None => {
                self.code.push((stage, code));
                self.modules.push(ShaderModule::new(self.gpu, code)?);
                self.code.len() - 1
            }
        };
        Ok(at as u32)
    }

    fn add_if(&mut self, stage: vk::ShaderStageFlags, code: Option<&'a [u8]>) -> Result<u32, VulkanError> {
        code.map_or(Ok(vk::SHADER_UNUSED_KHR), |code| self.add(stage, code))
    }
}

fn group(kind: vk::RayTracingShaderGroupTypeKHR) -> vk::RayTracingShaderGroupCreateInfoKHR<'static> {
    vk::RayTracingShaderGroupCreateInfoKHR::default()
        .ty(kind)
        .general_shader(vk::SHADER_UNUSED_KHR)
        .closest_hit_shader(vk::SHADER_UNUSED_KHR)
        .any_hit_shader(vk::SHADER_UNUSED_KHR)
        .intersection_shader(vk::SHADER_UNUSED_KHR)
}

/// The groups, in the order of the shader binding table.
fn groups<'a>(
    stages: &mut Stages<'a>,
    shaders: &RayShaders<'a>,
) -> Result<Vec<vk::RayTracingShaderGroupCreateInfoKHR<'static>>, VulkanError> {
    let general = vk::RayTracingShaderGroupTypeKHR::GENERAL;
    let raygen = stages.add(vk::ShaderStageFlags::RAYGEN_KHR, shaders.raygen)?;
    let mut groups = vec![group(general).general_shader(raygen)];
    for code in shaders.miss {
        groups.push(group(general).general_shader(stages.add(vk::ShaderStageFlags::MISS_KHR, code)?));
    }
    for hit in shaders.hits.as_flattened() {
        groups.push(
            group(vk::RayTracingShaderGroupTypeKHR::TRIANGLES_HIT_GROUP)
                .closest_hit_shader(stages.add_if(vk::ShaderStageFlags::CLOSEST_HIT_KHR, hit.closest)?)
                .any_hit_shader(stages.add_if(vk::ShaderStageFlags::ANY_HIT_KHR, hit.any)?),
        );
    }
    Ok(groups)
}

impl RayPipeline {
    /// Makes a pipeline whose shaders trace rays of recursion depth 1 through the scene and read `push_size` bytes of push constants.
    ///
    /// # Errors
    /// If the driver refuses it or memory is out.
    pub fn new(
        scene: &SceneOnGpu,
        shaders: &RayShaders<'_>,
        constants: &Specialisation,
        push_size: u32,
        cache: &PipelineCache,
    ) -> Result<Self, VulkanError> {
        let gpu = scene.gpu();
        let descriptors = scene.descriptors.clone();
        let layout = Layout::new(gpu, &[descriptors.layout], STAGES, push_size)?;
        let mut stages = Stages { gpu, code: Vec::new(), modules: Vec::new() };
        let groups = groups(&mut stages, shaders)?;
        let constants = constants.table();
        let constants = constants.info();
        let stage = |(module, (stage, _)): (&ShaderModule, &(vk::ShaderStageFlags, &[u8]))| {
            vk::PipelineShaderStageCreateInfo::default()
                .stage(*stage)
                .module(module.raw)
                .name(c"main")
                .specialization_info(&constants)
        };
        let all: Vec<_> = stages.modules.iter().zip(&stages.code).map(stage).collect();
        let flags = match &gpu.0.executables {
            Some(_) => vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR,
            None => vk::PipelineCreateFlags::empty(),
        };
        let create = [vk::RayTracingPipelineCreateInfoKHR::default()
            .flags(flags)
            .stages(&all)
            .groups(&groups)
            .max_pipeline_ray_recursion_depth(1)
            .layout(layout.raw)];
        let none = vk::DeferredOperationKHR::null();
        // SAFETY: modules and layout are alive; the pipeline is destroyed by `drop`.
        let made = unsafe { gpu.0.pipelines.create_ray_tracing_pipelines(none, cache.raw(), &create, None) };
        let raw = made.map_err(|(_, error)| error).called("vkCreateRayTracingPipelinesKHR")?[0];
        let destroy = || unsafe { gpu.0.raw.destroy_pipeline(raw, None) };
        let [miss, hit] = [shaders.miss.len(), shaders.hits.as_flattened().len()].map(|n| n as u32);
        let table = BindingTable::new(gpu, raw, miss, hit).inspect_err(|_| destroy())?;
        Ok(RayPipeline { gpu: gpu.clone(), raw, layout, descriptors, table })
    }

    /// What the driver's compiler says of each shader (registers, spills, …); empty if it says nothing or was not asked to
    /// ([`crate::Options::pipeline_statistics`]).
    ///
    /// # Errors
    /// If memory is out.
    pub fn statistics(&self) -> Result<Vec<ShaderStatistics>, VulkanError> {
        self.gpu.0.executables.as_ref().map_or(Ok(Vec::new()), |e| statistics::read(e, self.raw))
    }

    /// Launches ray generation for `size` invocations.
    ///
    /// # Panics
    /// If `push` is not as long as was said, or the launch is larger than [`Self::max_invocations`].
    pub fn trace(&self, commands: &Commands<'_>, push: &[u8], size: [u32; 3]) {
        let invocations = size.iter().map(|&s| u64::from(s)).product::<u64>();
        assert!(invocations <= self.max_invocations(), "{size:?} is too large a launch");
        let point = vk::PipelineBindPoint::RAY_TRACING_KHR;
        let device = &self.gpu.0.raw;
        let none = vk::StridedDeviceAddressRegionKHR::default();
        let (table, [width, height, depth]) = (&self.table, size);
        // SAFETY: the command buffer is being recorded; pipeline and scene live until it was waited for.
        unsafe {
            device.cmd_bind_pipeline(commands.raw, point, self.raw);
            let sets = [self.descriptors.set];
            device.cmd_bind_descriptor_sets(commands.raw, point, self.layout.raw, 0, &sets, &[]);
            self.layout.push(commands, push);
            self.gpu.0.pipelines.cmd_trace_rays(
                commands.raw,
                &table.raygen,
                &table.miss,
                &table.hit,
                &none,
                width,
                height,
                depth,
            );
        }
    }

    /// Launches ray generation for as many invocations as `count` holds at `offset`, a `VkTraceRaysIndirectCommandKHR`, and at most `most`.
    /// Where the device cannot read that itself, `most` are launched: shaders must ask whether there is work for them.
    ///
    /// # Panics
    /// As [`Self::trace`].
    pub fn trace_indirect(
        &self,
        commands: &Commands<'_>,
        push: &[u8],
        (count, offset): (&Buffer, u64),
        most: u32,
    ) {
        if !self.gpu.features().indirect_launch {
            return self.trace(commands, push, [most, 1, 1]);
        }
        let point = vk::PipelineBindPoint::RAY_TRACING_KHR;
        let device = &self.gpu.0.raw;
        let none = vk::StridedDeviceAddressRegionKHR::default();
        let table = &self.table;
        // SAFETY: as `trace`; the buffer holds the sizes when the launch begins.
        unsafe {
            device.cmd_bind_pipeline(commands.raw, point, self.raw);
            let sets = [self.descriptors.set];
            device.cmd_bind_descriptor_sets(commands.raw, point, self.layout.raw, 0, &sets, &[]);
            self.layout.push(commands, push);
            self.gpu.0.pipelines.cmd_trace_rays_indirect(
                commands.raw,
                &table.raygen,
                &table.miss,
                &table.hit,
                &none,
                count.address() + offset,
            );
        }
    }

    /// Most invocations of one launch.
    pub fn max_invocations(&self) -> u64 {
        self.gpu.0.limits.max_invocations.into()
    }
}

impl Drop for RayPipeline {
    fn drop(&mut self) {
        let raw = self.raw;
        // SAFETY: nothing that uses it is under way.
        self.gpu.0.discard(move |gpu| unsafe { gpu.raw.destroy_pipeline(raw, None) });
    }
}
