//! Compute pipelines: shaders reach everything by address, but for textures; one block of push constants.

use crate::buffer::Buffer;
use crate::cache::PipelineCache;
use crate::commands::Commands;
use crate::descriptors::{Descriptors, STAGES};
use crate::error::{Called, VulkanError};
use crate::gpu::Gpu;
use crate::pipeline::{Layout, ShaderModule};
use crate::scene::SceneOnGpu;
use crate::specialisation::Specialisation;
use ash::vk;
use std::sync::Arc;

/// A compute pipeline.
pub(crate) struct ComputePipeline {
    gpu: Gpu,
    raw: vk::Pipeline,
    layout: Layout,
    /// Of a scene, where the shader reads textures.
    descriptors: Option<Arc<Descriptors>>,
}

impl ComputePipeline {
    /// Of SPIR-V whose push constants have `push_size` bytes.
    ///
    /// # Errors
    /// If the driver refuses it, or memory is out.
    pub(crate) fn new(
        gpu: &Gpu,
        spirv: &[u8],
        constants: &Specialisation,
        push_size: u32,
    ) -> Result<Self, VulkanError> {
        let layout = Layout::new(gpu, &[], vk::ShaderStageFlags::COMPUTE, push_size)?;
        Self::with(gpu, spirv, constants, (layout, None), vk::PipelineCache::null())
    }

    /// The same for a shader that reads the textures of a scene, which must live as long.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(crate) fn of_scene(
        scene: &SceneOnGpu,
        spirv: &[u8],
        constants: &Specialisation,
        push_size: u32,
        cache: &PipelineCache,
    ) -> Result<Self, VulkanError> {
        let descriptors = scene.descriptors.clone();
        let layout = Layout::new(scene.gpu(), &[descriptors.layout], STAGES, push_size)?;
        Self::with(scene.gpu(), spirv, constants, (layout, Some(descriptors)), cache.raw())
    }

    fn with(
        gpu: &Gpu,
        spirv: &[u8],
        constants: &Specialisation,
        (layout, descriptors): (Layout, Option<Arc<Descriptors>>),
        cache: vk::PipelineCache,
    ) -> Result<Self, VulkanError> {
        let module = ShaderModule::new(gpu, spirv)?;
        let constants = constants.table();
        let constants = constants.info();
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module.raw)
            .name(c"main")
            .specialization_info(&constants);
        let create = [vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout.raw)];
        // SAFETY: module and layout are alive; the pipeline is destroyed by `drop`.
        let made = unsafe { gpu.0.raw.create_compute_pipelines(cache, &create, None) };
        let raw = made.map_err(|(_, error)| error).called("vkCreateComputePipelines")?[0];
        Ok(ComputePipeline { gpu: gpu.clone(), raw, layout, descriptors })
    }

    /// Runs `groups` work groups. What it reaches by address must live until this was waited for.
    ///
    /// # Panics
    /// If `push` has not the size of the push constants.
    pub(crate) fn dispatch(&self, commands: &Commands<'_>, push: &[u8], groups: [u32; 2]) {
        self.bind(commands, push);
        // SAFETY: the command buffer is being recorded; the pipeline is alive, and so are by the caller the buffers.
        unsafe { self.gpu.0.raw.cmd_dispatch(commands.raw, groups[0], groups[1], 1) };
    }

    /// Runs as many work groups as `count` holds at `offset`, a `VkDispatchIndirectCommand`.
    ///
    /// # Panics
    /// As [`Self::dispatch`].
    pub(crate) fn dispatch_indirect(
        &self,
        commands: &Commands<'_>,
        push: &[u8],
        (count, offset): (&Buffer, u64),
    ) {
        self.bind(commands, push);
        // SAFETY: as `dispatch`; the buffer holds the sizes when the dispatch begins.
        unsafe { self.gpu.0.raw.cmd_dispatch_indirect(commands.raw, count.raw(), offset) };
    }

    fn bind(&self, commands: &Commands<'_>, push: &[u8]) {
        let (device, point) = (&self.gpu.0.raw, vk::PipelineBindPoint::COMPUTE);
        // SAFETY: the command buffer is being recorded; pipeline and set are alive.
        unsafe {
            device.cmd_bind_pipeline(commands.raw, point, self.raw);
            if let Some(descriptors) = &self.descriptors {
                device.cmd_bind_descriptor_sets(
                    commands.raw,
                    point,
                    self.layout.raw,
                    0,
                    &[descriptors.set],
                    &[],
                );
            }
        }
        self.layout.push(commands, push);
    }
}

impl Drop for ComputePipeline {
    fn drop(&mut self) {
        let raw = self.raw;
        // SAFETY: nothing that uses it is under way.
        self.gpu.0.discard(move |gpu| unsafe { gpu.raw.destroy_pipeline(raw, None) });
    }
}
