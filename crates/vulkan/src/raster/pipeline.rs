//! Graphics pipelines without vertex input: vertex and fragment shaders reach everything by address.

use super::draws::Face;
use crate::cache::PipelineCache;
use crate::commands::Commands;
use crate::error::{Called, VulkanError};
use crate::gpu::Gpu;
use crate::pipeline::{Layout, ShaderModule};
use crate::specialisation::Specialisation;
use ash::vk;

/// A pipeline that draws triangles of one kind.
pub(crate) struct RasterPipeline {
    gpu: Gpu,
    raw: vk::Pipeline,
    layout: Layout,
}

impl RasterPipeline {
    /// Of the SPIR-V of its two stages, whose push constants have `push_size` bytes. Nearer points have a larger depth.
    ///
    /// # Errors
    /// If the driver refuses it, or memory is out.
    pub(crate) fn new(
        gpu: &Gpu,
        [vertex, fragment]: [&[u8]; 2],
        (pass, face): (vk::RenderPass, Face),
        (constants, push_size): (&Specialisation, u32),
        cache: &PipelineCache,
    ) -> Result<Self, VulkanError> {
        let both = vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT;
        let layout = Layout::new(gpu, &[], both, push_size)?;
        let modules = [ShaderModule::new(gpu, vertex)?, ShaderModule::new(gpu, fragment)?];
        let constants = constants.table();
        let constants = constants.info();
        let kinds = [vk::ShaderStageFlags::VERTEX, vk::ShaderStageFlags::FRAGMENT];
        let stages: [vk::PipelineShaderStageCreateInfo<'_>; 2] = core::array::from_fn(|i| {
            vk::PipelineShaderStageCreateInfo::default()
                .stage(kinds[i])
                .module(modules[i].raw)
                .name(c"main")
                .specialization_info(&constants)
        });
        let input = vk::PipelineVertexInputStateCreateInfo::default();
        let assembly = vk::PipelineInputAssemblyStateCreateInfo::default()
            .topology(vk::PrimitiveTopology::TRIANGLE_LIST);
        let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let (cull, front) = facing(face);
        let raster = vk::PipelineRasterizationStateCreateInfo::default()
            .polygon_mode(vk::PolygonMode::FILL)
            .cull_mode(cull)
            .front_face(front)
            .line_width(1.0);
        let samples = vk::PipelineMultisampleStateCreateInfo::default()
            .rasterization_samples(vk::SampleCountFlags::TYPE_1);
        let depth = vk::PipelineDepthStencilStateCreateInfo::default()
            .depth_test_enable(true)
            .depth_write_enable(true)
            .depth_compare_op(vk::CompareOp::GREATER);
        let blend = [vk::PipelineColorBlendAttachmentState::default()
            .color_write_mask(vk::ColorComponentFlags::R | vk::ColorComponentFlags::G)];
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&blend);
        let dynamic = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
        let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&dynamic);
        let create = [vk::GraphicsPipelineCreateInfo::default()
            .stages(&stages)
            .vertex_input_state(&input)
            .input_assembly_state(&assembly)
            .viewport_state(&viewport)
            .rasterization_state(&raster)
            .multisample_state(&samples)
            .depth_stencil_state(&depth)
            .color_blend_state(&blend)
            .dynamic_state(&dynamic)
            .layout(layout.raw)
            .render_pass(pass)];
        // SAFETY: modules, layout and pass are alive; the pipeline is destroyed by `drop`.
        let made = unsafe { gpu.0.raw.create_graphics_pipelines(cache.raw(), &create, None) };
        let raw = made.map_err(|(_, error)| error).called("vkCreateGraphicsPipelines")?[0];
        Ok(RasterPipeline { gpu: gpu.clone(), raw, layout })
    }

    /// Draws that follow use it.
    ///
    /// # Panics
    /// If `push` has not the size of the push constants.
    pub(crate) fn bind(&self, commands: &Commands<'_>, push: &[u8]) {
        let point = vk::PipelineBindPoint::GRAPHICS;
        // SAFETY: the command buffer is being recorded; the pipeline is alive.
        unsafe { self.gpu.0.raw.cmd_bind_pipeline(commands.raw, point, self.raw) };
        self.layout.push(commands, push);
    }
}

/// Which triangles are left out, and which winding is the front: pictures have row 0 on top, and so have framebuffers, so that what winds
/// counter-clockwise for the viewer does so for Vulkan.
fn facing(face: Face) -> (vk::CullModeFlags, vk::FrontFace) {
    let cull = if face.culls { vk::CullModeFlags::BACK } else { vk::CullModeFlags::NONE };
    let front = if face.mirrored { vk::FrontFace::CLOCKWISE } else { vk::FrontFace::COUNTER_CLOCKWISE };
    (cull, front)
}

impl Drop for RasterPipeline {
    fn drop(&mut self) {
        let raw = self.raw;
        // SAFETY: nothing that uses it is under way.
        self.gpu.0.discard(move |gpu| unsafe { gpu.raw.destroy_pipeline(raw, None) });
    }
}
