//! What the rasteriser draws to: two numbers for each pixel, and depth.
//!
//! Nothing else: of the chip of a data-centre GPU two parts in 66 draw (an H100), and whatever can be found from the numbers is found by compute
//! shaders. (Burns and Hunt 2013, "The Visibility Buffer".)

use crate::buffer::{Buffer, Purpose};
use crate::commands::Commands;
use crate::error::{Called, VulkanError};
use crate::gpu::Gpu;
use crate::image::{Image, ImageUse};
use ash::vk;

const IDS: ImageUse = ImageUse {
    format: vk::Format::R32G32_UINT,
    usage: vk::ImageUsageFlags::from_raw(
        vk::ImageUsageFlags::COLOR_ATTACHMENT.as_raw() | vk::ImageUsageFlags::TRANSFER_SRC.as_raw(),
    ),
    aspect: vk::ImageAspectFlags::COLOR,
};
const DEPTH: ImageUse = ImageUse {
    format: vk::Format::D32_SFLOAT,
    usage: vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT,
    aspect: vk::ImageAspectFlags::DEPTH,
};

/// Images of one size with the pass that draws to them, and the numbers where compute shaders read them.
pub(crate) struct Target {
    gpu: Gpu,
    size: [u32; 2],
    ids: Image,
    _depth: Image,
    pass: vk::RenderPass,
    framebuffer: vk::Framebuffer,
    /// Two words a pixel, row by row.
    pub(crate) numbers: Buffer,
}

impl Target {
    /// Of so many pixels.
    ///
    /// # Errors
    /// If memory is out.
    pub(crate) fn new(gpu: &Gpu, size: [u32; 2]) -> Result<Self, VulkanError> {
        let limit = gpu.0.limits.max_image_side;
        if let Some(&side) = size.iter().find(|&&s| s > limit) {
            let what = "side of a picture that is rasterised".to_owned();
            return Err(VulkanError::TooLarge { what, needed: side.into(), limit: limit.into() });
        }
        let bytes = 8 * u64::from(size[0]) * u64::from(size[1]);
        let mut target = Target {
            gpu: gpu.clone(),
            size,
            ids: Image::empty(gpu, "visible triangles", size, &IDS)?,
            _depth: Image::empty(gpu, "depth", size, &DEPTH)?,
            pass: vk::RenderPass::null(),
            framebuffer: vk::Framebuffer::null(),
            numbers: Buffer::new(gpu, "visible triangles", bytes, Purpose::Data)?,
        };
        target.pass = pass(gpu)?;
        let views = [target.ids.view, target._depth.view];
        let create = vk::FramebufferCreateInfo::default()
            .render_pass(target.pass)
            .attachments(&views)
            .width(size[0])
            .height(size[1])
            .layers(1);
        // SAFETY: pass and views are alive; destroyed by `drop`.
        target.framebuffer =
            unsafe { gpu.0.raw.create_framebuffer(&create, None) }.called("vkCreateFramebuffer")?;
        Ok(target)
    }

    /// The pass; pipelines made for one of the same kind serve, too.
    pub(crate) fn pass(&self) -> vk::RenderPass {
        self.pass
    }

    /// Draws what `draw` records onto nothing, and copies the numbers to the buffer.
    pub(crate) fn draw(&self, commands: &Commands<'_>, draw: impl FnOnce()) {
        let [width, height] = self.size;
        let all = vk::Rect2D { offset: vk::Offset2D::default(), extent: vk::Extent2D { width, height } };
        let clear = [
            vk::ClearValue { color: vk::ClearColorValue { uint32: [u32::MAX; 4] } },
            vk::ClearValue { depth_stencil: vk::ClearDepthStencilValue { depth: 0.0, stencil: 0 } },
        ];
        let begin = vk::RenderPassBeginInfo::default()
            .render_pass(self.pass)
            .framebuffer(self.framebuffer)
            .render_area(all)
            .clear_values(&clear);
        let viewport = [vk::Viewport {
            x: 0.0,
            y: 0.0,
            width: width as f32,
            height: height as f32,
            min_depth: 0.0,
            max_depth: 1.0,
        }];
        let device = &self.gpu.0.raw;
        // SAFETY: the command buffer is being recorded; pass, images and buffer live until it was waited for.
        unsafe {
            device.cmd_begin_render_pass(commands.raw, &begin, vk::SubpassContents::INLINE);
            device.cmd_set_viewport(commands.raw, 0, &viewport);
            device.cmd_set_scissor(commands.raw, 0, &[all]);
            draw();
            device.cmd_end_render_pass(commands.raw);
            let layers = vk::ImageSubresourceLayers {
                aspect_mask: vk::ImageAspectFlags::COLOR,
                mip_level: 0,
                base_array_layer: 0,
                layer_count: 1,
            };
            let region = [vk::BufferImageCopy::default()
                .image_subresource(layers)
                .image_extent(vk::Extent3D { width, height, depth: 1 })];
            let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
            device.cmd_copy_image_to_buffer(commands.raw, self.ids.raw, layout, self.numbers.raw(), &region);
        }
    }
}

/// One subpass with both attachments, cleared; afterwards the numbers are ready to be copied.
fn pass(gpu: &Gpu) -> Result<vk::RenderPass, VulkanError> {
    let attachment = |what: &ImageUse, store, last| {
        vk::AttachmentDescription::default()
            .format(what.format)
            .samples(vk::SampleCountFlags::TYPE_1)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(store)
            .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
            .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
            .initial_layout(vk::ImageLayout::UNDEFINED)
            .final_layout(last)
    };
    let drawn = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
    let tested = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    let attachments = [
        attachment(&IDS, vk::AttachmentStoreOp::STORE, vk::ImageLayout::TRANSFER_SRC_OPTIMAL),
        attachment(&DEPTH, vk::AttachmentStoreOp::DONT_CARE, tested),
    ];
    let color = [vk::AttachmentReference { attachment: 0, layout: drawn }];
    let depth = vk::AttachmentReference { attachment: 1, layout: tested };
    let subpasses = [vk::SubpassDescription::default()
        .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
        .color_attachments(&color)
        .depth_stencil_attachment(&depth)];
    let stages = |subpass| match subpass {
        vk::SUBPASS_EXTERNAL => vk::PipelineStageFlags::ALL_COMMANDS,
        _ => vk::PipelineStageFlags::ALL_GRAPHICS,
    };
    let writes = vk::AccessFlags::MEMORY_WRITE;
    let both = vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE;
    let dependency = |from, to| {
        vk::SubpassDependency::default()
            .src_subpass(from)
            .dst_subpass(to)
            .src_stage_mask(stages(from))
            .dst_stage_mask(stages(to))
            .src_access_mask(writes)
            .dst_access_mask(both)
    };
    let outside = vk::SUBPASS_EXTERNAL;
    let dependencies = [dependency(outside, 0), dependency(0, outside)];
    let create = vk::RenderPassCreateInfo::default()
        .attachments(&attachments)
        .subpasses(&subpasses)
        .dependencies(&dependencies);
    // SAFETY: a live device; the caller destroys it.
    unsafe { gpu.0.raw.create_render_pass(&create, None) }.called("vkCreateRenderPass")
}

impl Drop for Target {
    fn drop(&mut self) {
        let (pass, framebuffer) = (self.pass, self.framebuffer);
        self.gpu.0.discard(move |gpu| {
            // SAFETY: nothing that uses them is under way; null handles are ignored.
            unsafe {
                gpu.raw.destroy_framebuffer(framebuffer, None);
                gpu.raw.destroy_render_pass(pass, None);
            }
        });
    }
}
