//! Compute pipelines whose shaders reach everything by address: no descriptors, one block of push constants.

use crate::commands::Commands;
use crate::error::{Called, VulkanError};
use crate::gpu::Gpu;
use crate::pipeline::{Layout, ShaderModule};
use crate::specialisation::Specialisation;
use ash::vk;

/// A compute pipeline.
pub(crate) struct ComputePipeline {
    gpu: Gpu,
    raw: vk::Pipeline,
    layout: Layout,
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
        let made = unsafe { gpu.0.raw.create_compute_pipelines(vk::PipelineCache::null(), &create, None) };
        let raw = made.map_err(|(_, error)| error).called("vkCreateComputePipelines")?[0];
        Ok(ComputePipeline { gpu: gpu.clone(), raw, layout })
    }

    /// Runs `groups` work groups. What it reaches by address must live until this was waited for.
    ///
    /// # Panics
    /// If `push` has not the size of the push constants.
    pub(crate) fn dispatch(&self, commands: &Commands<'_>, push: &[u8], groups: [u32; 2]) {
        let device = &self.gpu.0.raw;
        // SAFETY: the command buffer is being recorded; the pipeline is alive, and so are by the caller the buffers.
        unsafe {
            device.cmd_bind_pipeline(commands.raw, vk::PipelineBindPoint::COMPUTE, self.raw);
            self.layout.push(commands, push);
            device.cmd_dispatch(commands.raw, groups[0], groups[1], 1);
        }
    }
}

impl Drop for ComputePipeline {
    fn drop(&mut self) {
        let raw = self.raw;
        // SAFETY: nothing that uses it is under way.
        self.gpu.0.discard(move |gpu| unsafe { gpu.raw.destroy_pipeline(raw, None) });
    }
}
