//! Compute kernels that evaluate a function for a list of inputs: what tests of shader functions need.

use crate::buffer::{Buffer, Purpose};
use crate::error::{Called, VulkanError};
use crate::gpu::Gpu;
use crate::pipeline::{Layout, ShaderModule};
use crate::specialisation::Specialisation;
use crate::upload::Upload;
use ash::vk;
use bytemuck::{Pod, Zeroable};

/// Invocations in a group: `local_size_x` of `twins/kernel.glsl`.
const GROUP: usize = 64;

/// The push constants of `twins/kernel.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Push {
    tables: [u32; 2],
    inputs: [u32; 2],
    outputs: [u32; 2],
    count: u32,
}

/// A compute shader made with `twins/kernel.glsl`.
pub struct Kernel {
    gpu: Gpu,
    pipeline: vk::Pipeline,
    layout: Layout,
    tables: Buffer,
}

impl Gpu {
    /// A kernel: SPIR-V of a file of `glsl/twins`, and the content of `push.tables`.
    ///
    /// # Errors
    /// If the driver refuses it, or memory is out.
    pub fn kernel(
        &self,
        spirv: &[u8],
        tables: &[u8],
        constants: &Specialisation,
    ) -> Result<Kernel, VulkanError> {
        let mut upload = Upload::new(self);
        let tables = Buffer::with_content(&mut upload, "tables", tables)?;
        upload.finish()?;
        let layout = Layout::new(self, &[], vk::ShaderStageFlags::COMPUTE, size_of::<Push>() as u32)?;
        let module = ShaderModule::new(self, spirv)?;
        let constants = constants.table();
        let constants = constants.info();
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module.raw)
            .name(c"main")
            .specialization_info(&constants);
        let create = [vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout.raw)];
        // SAFETY: module and layout are alive; the pipeline is destroyed by `drop`.
        let made = unsafe { self.0.raw.create_compute_pipelines(vk::PipelineCache::null(), &create, None) };
        let pipeline = made.map_err(|(_, error)| error).called("vkCreateComputePipelines")?[0];
        Ok(Kernel { gpu: self.clone(), pipeline, layout, tables })
    }
}

impl Kernel {
    /// The function of every input. `I` and `O` are laid out as `Input` and `Output` of the shader are by the `scalar` rules.
    ///
    /// # Errors
    /// If memory is out, the inputs are too many, or the device is lost.
    pub fn run<I: Pod, O: Pod>(&self, inputs: &[I]) -> Result<Vec<O>, VulkanError> {
        let gpu = &self.gpu;
        let groups = inputs.len().div_ceil(GROUP);
        let limit = u64::from(gpu.0.limits.max_groups) * GROUP as u64;
        if inputs.len() as u64 > limit {
            return Err(VulkanError::TooLarge { what: "inputs".into(), needed: inputs.len() as u64, limit });
        }
        if inputs.is_empty() {
            return Ok(Vec::new());
        }
        let mut upload = Upload::new(gpu);
        let input = Buffer::with_content(&mut upload, "inputs", bytemuck::cast_slice(inputs))?;
        upload.finish()?;
        let size = (inputs.len() * size_of::<O>()) as u64;
        let output = Buffer::new(gpu, "outputs", size, Purpose::Data)?;
        let result = Buffer::new(gpu, "outputs on the host", size, Purpose::Readback)?;
        let push = Push {
            tables: words(self.tables.address()),
            inputs: words(input.address()),
            outputs: words(output.address()),
            count: inputs.len() as u32,
        };
        gpu.run("a kernel", |commands| {
            let device = &gpu.0.raw;
            // SAFETY: the command buffer is being recorded; the pipeline and the buffers live until it was waited for.
            unsafe {
                device.cmd_bind_pipeline(commands.raw, vk::PipelineBindPoint::COMPUTE, self.pipeline);
                self.layout.push(commands, bytemuck::bytes_of(&push));
                device.cmd_dispatch(commands.raw, groups as u32, 1, 1);
            }
            commands.barrier();
            commands.copy((&output, 0), (&result, 0), size);
            Ok(())
        })?;
        Ok(result.read_as())
    }
}

/// An address as two words, low one first: a structure with it has no gaps.
fn words(address: u64) -> [u32; 2] {
    [address as u32, (address >> 32) as u32]
}

impl Drop for Kernel {
    fn drop(&mut self) {
        if !self.gpu.0.hangs() {
            // SAFETY: every run was waited for.
            unsafe { self.gpu.0.raw.destroy_pipeline(self.pipeline, None) };
        }
    }
}
