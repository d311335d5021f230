//! From a film on the device to what a display is sent: automatic exposure from the luminance of blocks, eased from frame to frame, lens,
//! tone curve. The same as `lumbre::output::develop` on the host, but for the last digits: a code of 8 bits differs by 1 at most.

use crate::buffer::{Buffer, Purpose};
use crate::commands::Commands;
use crate::compute::ComputePipeline;
use crate::error::VulkanError;
use crate::gpu::Gpu;
use crate::specialisation::Specialisation;
use lumbre_core::film::Crop;
use lumbre_shaders::post::{PostBuffers, PostLook, PostPush, STATE_BYTES};
use lumbre_shaders::{POST_BLOCKS, POST_DEVELOP, POST_EXPOSURE};

/// The passes, with what they keep from frame to frame. For films of one size.
pub struct Post {
    passes: [ComputePipeline; 3],
    blocks: Buffer,
    state: Buffer,
    display: Buffer,
    size: [u32; 2],
}

impl Post {
    /// For films of `size` pixels.
    ///
    /// # Errors
    /// If the driver refuses the shaders, or memory is out.
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Result<Self, VulkanError> {
        let push_size = size_of::<PostPush>() as u32;
        let pass = |spirv| ComputePipeline::new(gpu, spirv, &Specialisation::new(), push_size);
        let data = |name, bytes| Buffer::new(gpu, name, bytes, Purpose::Data);
        let post = Post {
            passes: [pass(POST_BLOCKS)?, pass(POST_EXPOSURE)?, pass(POST_DEVELOP)?],
            blocks: data("luminance of blocks", PostPush::block_bytes(size))?,
            state: data("exposure", STATE_BYTES)?,
            display: data("display", 4 * u64::from(size[0]) * u64::from(size[1]))?,
            size,
        };
        gpu.run("forgetting the exposure", |commands| {
            post.forget(commands);
            Ok(())
        })?;
        Ok(post)
    }

    /// For films of another size from now on. The exposure is kept.
    ///
    /// # Errors
    /// If memory is out.
    pub fn resize(&mut self, gpu: &Gpu, size: [u32; 2]) -> Result<(), VulkanError> {
        let fit = |buffer: &mut Buffer, name, bytes: u64| -> Result<(), VulkanError> {
            if buffer.size() < bytes {
                *buffer = Buffer::new(gpu, name, bytes, Purpose::Data)?;
            }
            Ok(())
        };
        fit(&mut self.blocks, "luminance of blocks", PostPush::block_bytes(size))?;
        fit(&mut self.display, "display", 4 * u64::from(size[0]) * u64::from(size[1]))?;
        self.size = size;
        Ok(())
    }

    /// Exposure begins anew with the next frame, without easing from the last.
    pub fn forget(&self, commands: &Commands<'_>) {
        commands.fill(&self.state, 0);
        commands.barrier();
    }

    /// Develops the film at an address, which holds `crop` of a picture of `picture` pixels, and was written before in these commands (with a
    /// barrier) or in others. [`Post::display`] has it afterwards, behind a barrier.
    ///
    /// # Panics
    /// If the film has another size.
    pub fn record(&self, commands: &Commands<'_>, film: u64, picture: [u32; 2], crop: Crop, look: &PostLook) {
        assert_eq!(crop.size, self.size, "size of the film");
        let buffers = PostBuffers {
            film,
            blocks: self.blocks.address(),
            state: self.state.address(),
            display: self.display.address(),
        };
        let push = PostPush::new(&buffers, picture, crop, look);
        let groups = [push.block_count, [1, 1], push.develop_groups()];
        for (pass, groups) in self.passes.iter().zip(groups) {
            pass.dispatch(commands, bytemuck::bytes_of(&push), groups);
            commands.barrier();
        }
    }

    /// The picture: four bytes a pixel (red, green, blue, alpha), row 0 on top.
    pub fn display(&self) -> &Buffer {
        &self.display
    }

    /// The exposure that was used last: its factor, as one float.
    pub fn exposure(&self) -> &Buffer {
        &self.state
    }
}
