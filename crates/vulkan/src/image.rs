//! Images: textures whose texels shaders read, and targets of the rasteriser.

use crate::buffer::Buffer;
use crate::commands::Commands;
use crate::error::{Called, VulkanError};
use crate::gpu::Gpu;
use crate::upload::{CHUNK, Upload};
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::Allocation;

/// An image of one level.
pub(crate) struct Image {
    gpu: Gpu,
    pub(crate) raw: vk::Image,
    allocation: Option<Allocation>,
    pub(crate) view: vk::ImageView,
}

/// What an image is for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ImageUse {
    pub(crate) format: vk::Format,
    pub(crate) usage: vk::ImageUsageFlags,
    pub(crate) aspect: vk::ImageAspectFlags,
}

const TEXTURE: ImageUse = ImageUse {
    format: vk::Format::R8G8B8A8_UNORM,
    usage: vk::ImageUsageFlags::from_raw(
        vk::ImageUsageFlags::SAMPLED.as_raw() | vk::ImageUsageFlags::TRANSFER_DST.as_raw(),
    ),
    aspect: vk::ImageAspectFlags::COLOR,
};
const COLOR: vk::ImageSubresourceRange = vk::ImageSubresourceRange {
    aspect_mask: vk::ImageAspectFlags::COLOR,
    base_mip_level: 0,
    level_count: 1,
    base_array_layer: 0,
    layer_count: 1,
};

impl Image {
    /// A texture, RGBA8, with these texels, row by row from the top.
    pub(crate) fn texture(
        upload: &mut Upload,
        name: &str,
        [width, height]: [u32; 2],
        texels: &[u32],
    ) -> Result<Self, VulkanError> {
        let gpu = upload.gpu().clone();
        let image = Self::empty(&gpu, name, [width, height], &TEXTURE)?;
        // A row is far below a chunk: sides are bounded.
        let rows = (CHUNK / (4 * u64::from(width))).max(1) as usize;
        for (i, some) in texels.chunks(rows * width as usize).enumerate() {
            let first = (i * rows) as u32;
            let count = (some.len() / width as usize) as u32;
            upload.through(bytemuck::cast_slice(some), |from| {
                gpu.submit("an image", |c| {
                    if first == 0 {
                        image.transition(
                            c,
                            vk::ImageLayout::UNDEFINED,
                            vk::ImageLayout::TRANSFER_DST_OPTIMAL,
                        );
                    }
                    image.copy(c, from, [width, count], first);
                    if first + count == height {
                        let read = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
                        image.transition(c, vk::ImageLayout::TRANSFER_DST_OPTIMAL, read);
                    }
                    Ok(())
                })
            })?;
        }
        Ok(image)
    }

    /// Without content.
    pub(crate) fn empty(
        gpu: &Gpu,
        name: &str,
        [width, height]: [u32; 2],
        what: &ImageUse,
    ) -> Result<Self, VulkanError> {
        let create = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(what.format)
            .extent(vk::Extent3D { width, height, depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(what.usage);
        let device = &gpu.0.raw;
        // SAFETY: a live device; what is made is destroyed by `drop`.
        let raw = unsafe { device.create_image(&create, None) }.called("vkCreateImage")?;
        let mut image = Image { gpu: gpu.clone(), raw, allocation: None, view: vk::ImageView::null() };
        // SAFETY: the image is new; the memory is bound once and lives as long.
        let requirements = unsafe { device.get_image_memory_requirements(raw) };
        let allocation = gpu.0.memory.allocate(name, requirements, MemoryLocation::GpuOnly, false)?;
        let (memory, offset) = unsafe { (allocation.memory(), allocation.offset()) };
        image.allocation = Some(allocation);
        unsafe { device.bind_image_memory(raw, memory, offset) }.called("vkBindImageMemory")?;
        let range = vk::ImageSubresourceRange { aspect_mask: what.aspect, ..COLOR };
        let create = vk::ImageViewCreateInfo::default()
            .image(raw)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(what.format)
            .subresource_range(range);
        image.view = unsafe { device.create_image_view(&create, None) }.called("vkCreateImageView")?;
        gpu.0.name(raw, name);
        Ok(image)
    }

    fn transition(&self, c: &Commands<'_>, from: vk::ImageLayout, to: vk::ImageLayout) {
        let all = vk::PipelineStageFlags::ALL_COMMANDS;
        let barrier = [vk::ImageMemoryBarrier::default()
            .image(self.raw)
            .subresource_range(COLOR)
            .old_layout(from)
            .new_layout(to)
            .src_access_mask(vk::AccessFlags::MEMORY_WRITE)
            .dst_access_mask(vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE)];
        // SAFETY: the command buffer is being recorded.
        unsafe {
            let none = vk::DependencyFlags::empty();
            self.gpu.0.raw.cmd_pipeline_barrier(c.raw, all, all, none, &[], &[], &barrier);
        }
    }

    /// Copies rows from the start of a buffer.
    fn copy(&self, c: &Commands<'_>, from: &Buffer, [width, rows]: [u32; 2], first: u32) {
        let layers = vk::ImageSubresourceLayers {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            mip_level: 0,
            base_array_layer: 0,
            layer_count: 1,
        };
        let region = [vk::BufferImageCopy::default()
            .image_subresource(layers)
            .image_offset(vk::Offset3D { x: 0, y: first as i32, z: 0 })
            .image_extent(vk::Extent3D { width, height: rows, depth: 1 })];
        let layout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        // SAFETY: the command buffer is being recorded; the rows lie in buffer and image.
        unsafe { self.gpu.0.raw.cmd_copy_buffer_to_image(c.raw, from.raw(), self.raw, layout, &region) };
    }
}

impl Drop for Image {
    fn drop(&mut self) {
        let (raw, view, allocation) = (self.raw, self.view, self.allocation.take());
        self.gpu.0.discard(move |gpu| {
            // SAFETY: nothing that uses it is under way; a null view is ignored.
            unsafe {
                gpu.raw.destroy_image_view(view, None);
                gpu.raw.destroy_image(raw, None);
            }
            allocation.into_iter().for_each(|a| gpu.memory.free(a));
        });
    }
}
