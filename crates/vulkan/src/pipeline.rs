//! What compute and ray tracing pipelines share: modules of shader code and pipeline layouts.

use crate::commands::Commands;
use crate::error::{Called, VulkanError};
use crate::gpu::Gpu;
use ash::vk;

/// Shader code; needed only while a pipeline is made.
pub(crate) struct ShaderModule {
    gpu: Gpu,
    pub(crate) raw: vk::ShaderModule,
}

impl ShaderModule {
    /// From SPIR-V.
    ///
    /// # Errors
    /// If the driver refuses it.
    ///
    /// # Panics
    /// If it is no multiple of four bytes or lacks the magic number.
    pub(crate) fn new(gpu: &Gpu, spirv: &[u8]) -> Result<Self, VulkanError> {
        let words: Vec<u32> = spirv.chunks_exact(4).map(bytemuck::pod_read_unaligned).collect();
        assert!(spirv.len().is_multiple_of(4) && words.first() == Some(&0x0723_0203), "no SPIR-V");
        let create = vk::ShaderModuleCreateInfo::default().code(&words);
        // SAFETY: a live device; the code is that of this project's shaders.
        let raw = unsafe { gpu.0.raw.create_shader_module(&create, None) }.called("vkCreateShaderModule")?;
        Ok(ShaderModule { gpu: gpu.clone(), raw })
    }
}

impl Drop for ShaderModule {
    fn drop(&mut self) {
        // SAFETY: pipelines do not need their modules once they are made.
        unsafe { self.gpu.0.raw.destroy_shader_module(self.raw, None) };
    }
}

/// A pipeline layout: sets of descriptors and one block of push constants.
pub(crate) struct Layout {
    gpu: Gpu,
    pub(crate) raw: vk::PipelineLayout,
    stages: vk::ShaderStageFlags,
    push_size: u32,
}

impl Layout {
    pub(crate) fn new(
        gpu: &Gpu,
        sets: &[vk::DescriptorSetLayout],
        stages: vk::ShaderStageFlags,
        push_size: u32,
    ) -> Result<Self, VulkanError> {
        let push = [vk::PushConstantRange { stage_flags: stages, offset: 0, size: push_size }];
        let create = vk::PipelineLayoutCreateInfo::default().set_layouts(sets).push_constant_ranges(&push);
        // SAFETY: a live device and live set layouts.
        let raw =
            unsafe { gpu.0.raw.create_pipeline_layout(&create, None) }.called("vkCreatePipelineLayout")?;
        Ok(Layout { gpu: gpu.clone(), raw, stages, push_size })
    }

    /// Sets all push constants.
    ///
    /// # Panics
    /// If their size is not that of the layout.
    pub(crate) fn push(&self, commands: &Commands<'_>, bytes: &[u8]) {
        assert_eq!(bytes.len(), self.push_size as usize, "bytes of push constants");
        // SAFETY: the command buffer is being recorded.
        unsafe { self.gpu.0.raw.cmd_push_constants(commands.raw, self.raw, self.stages, 0, bytes) };
    }
}

impl Drop for Layout {
    fn drop(&mut self) {
        let raw = self.raw;
        // SAFETY: nothing that uses it is under way.
        self.gpu.0.discard(move |gpu| unsafe { gpu.raw.destroy_pipeline_layout(raw, None) });
    }
}
