//! Compute kernels that evaluate a function for a list of inputs: what tests of shader functions need.

use crate::buffer::{Buffer, Purpose};
use crate::compute::ComputePipeline;
use crate::error::VulkanError;
use crate::gpu::Gpu;
use crate::specialisation::Specialisation;
use crate::upload::Upload;
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
    pipeline: ComputePipeline,
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
        let pipeline = ComputePipeline::new(self, spirv, constants, size_of::<Push>() as u32)?;
        Ok(Kernel { gpu: self.clone(), pipeline, tables })
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
            self.pipeline.dispatch(commands, bytemuck::bytes_of(&push), [groups as u32, 1]);
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
