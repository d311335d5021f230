//! Command buffers: recorded, submitted, waited for.
//!
//! Each is recorded once. It begins with a barrier after all that was submitted before, and ends with one that lets the host read,
//! so that only steps within one need barriers of their own.

use crate::buffer::Buffer;
use crate::error::{Called, VulkanError};
use crate::gpu::{Gpu, lock};
use ash::vk;

/// A command buffer with its pool and the fence that says when it is done.
pub(crate) struct Slot {
    pool: vk::CommandPool,
    buffer: vk::CommandBuffer,
    fence: vk::Fence,
}

/// A command buffer that is being recorded.
pub struct Commands<'a> {
    pub(crate) gpu: &'a Gpu,
    pub(crate) raw: vk::CommandBuffer,
}

/// Work that the device has been given; dropping it waits. What it uses and is dropped meanwhile is freed when it is done.
#[must_use = "dropping it waits"]
pub struct Pending {
    gpu: Gpu,
    slot: Option<Slot>,
    what: &'static str,
}

impl Slot {
    fn new(gpu: &Gpu) -> Result<Self, VulkanError> {
        let device = &gpu.0.raw;
        let create = vk::CommandPoolCreateInfo::default()
            .queue_family_index(gpu.0.adapter.queue_family)
            .flags(vk::CommandPoolCreateFlags::TRANSIENT);
        // SAFETY: a live device; on failure what was made so far is destroyed.
        unsafe {
            let mut slot = Slot {
                pool: device.create_command_pool(&create, None).called("vkCreateCommandPool")?,
                buffer: vk::CommandBuffer::null(),
                fence: vk::Fence::null(),
            };
            let allocate =
                vk::CommandBufferAllocateInfo::default().command_pool(slot.pool).command_buffer_count(1);
            let rest = device.allocate_command_buffers(&allocate).and_then(|buffers| {
                slot.buffer = buffers[0];
                slot.fence = device.create_fence(&vk::FenceCreateInfo::default(), None)?;
                Ok(())
            });
            match rest.called("vkAllocateCommandBuffers") {
                Ok(()) => Ok(slot),
                Err(error) => {
                    slot.destroy(device);
                    Err(error)
                }
            }
        }
    }

    /// # Safety
    /// The device has finished with it.
    pub(crate) unsafe fn destroy(self, device: &ash::Device) {
        // SAFETY: by the caller. Destroying the pool frees its buffer; a null fence is ignored.
        unsafe {
            device.destroy_fence(self.fence, None);
            device.destroy_command_pool(self.pool, None);
        }
    }
}

impl Gpu {
    /// Records and submits work and waits for it.
    ///
    /// # Errors
    /// Those of recording; if the device is lost or does not finish in time.
    pub fn run(
        &self,
        what: &'static str,
        record: impl FnOnce(&Commands<'_>) -> Result<(), VulkanError>,
    ) -> Result<(), VulkanError> {
        self.submit(what, record)?.wait()
    }

    /// Records and submits work.
    ///
    /// # Errors
    /// Those of recording; if the device is lost.
    pub fn submit(
        &self,
        what: &'static str,
        record: impl FnOnce(&Commands<'_>) -> Result<(), VulkanError>,
    ) -> Result<Pending, VulkanError> {
        self.0.alive()?;
        let idle = lock(&self.0.idle).pop();
        let slot = idle.map_or_else(|| Slot::new(self), Ok)?;
        self.0.begin();
        match self.record_and_submit(&slot, record) {
            Ok(()) => Ok(Pending { gpu: self.clone(), slot: Some(slot), what }),
            Err(error) => {
                // SAFETY: it was not submitted.
                unsafe { slot.destroy(&self.0.raw) };
                self.0.end();
                self.0.remember(Err(error))
            }
        }
    }

    fn record_and_submit(
        &self,
        slot: &Slot,
        record: impl FnOnce(&Commands<'_>) -> Result<(), VulkanError>,
    ) -> Result<(), VulkanError> {
        let device = &self.0.raw;
        let commands = Commands { gpu: self, raw: slot.buffer };
        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the slot is idle and owned by this thread; what is recorded lives until it is done (`Shared::discard`).
        unsafe {
            device
                .reset_command_pool(slot.pool, vk::CommandPoolResetFlags::empty())
                .called("vkResetCommandPool")?;
            device.begin_command_buffer(slot.buffer, &begin).called("vkBeginCommandBuffer")?;
            commands.barrier();
            record(&commands)?;
            commands.barrier_to_host();
            device.end_command_buffer(slot.buffer).called("vkEndCommandBuffer")?;
            device.reset_fences(&[slot.fence]).called("vkResetFences")?;
            let buffers = [slot.buffer];
            let submit = [vk::SubmitInfo::default().command_buffers(&buffers)];
            let queue = lock(&self.0.queue);
            device.queue_submit(*queue, &submit, slot.fence).called("vkQueueSubmit")
        }
    }
}

impl Pending {
    /// Waits until it is done.
    ///
    /// # Errors
    /// If the device is lost or does not finish in time.
    pub fn wait(mut self) -> Result<(), VulkanError> {
        self.finish()
    }

    /// Whether it is done already.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn is_done(&self) -> Result<bool, VulkanError> {
        let Some(slot) = &self.slot else { return Ok(true) };
        // SAFETY: a live fence.
        self.gpu.0.remember(unsafe { self.gpu.0.raw.get_fence_status(slot.fence) }.called("vkGetFenceStatus"))
    }

    fn finish(&mut self) -> Result<(), VulkanError> {
        let Some(slot) = self.slot.take() else { return Ok(()) };
        let patience = self.gpu.0.patience;
        // SAFETY: a live fence.
        let waited = unsafe {
            let nanoseconds = u64::try_from(patience.as_nanos()).unwrap_or(u64::MAX);
            self.gpu.0.raw.wait_for_fences(&[slot.fence], true, nanoseconds)
        };
        match waited {
            Ok(()) => {
                lock(&self.gpu.0.idle).push(slot);
                self.gpu.0.end();
                Ok(())
            }
            // The slot is leaked: the device may be using it.
            Err(vk::Result::TIMEOUT) => {
                let hang = VulkanError::Hang { what: self.what, seconds: patience.as_secs() };
                self.gpu.0.remember(Err(hang))
            }
            Err(error) => {
                // SAFETY: a lost device has finished with everything.
                unsafe { slot.destroy(&self.gpu.0.raw) };
                self.gpu.0.end();
                self.gpu.0.remember(Err(error).called("vkWaitForFences"))
            }
        }
    }
}

impl Drop for Pending {
    fn drop(&mut self) {
        // An error is found again by the next submission.
        let _ = self.finish();
    }
}

impl Commands<'_> {
    /// Everything after it sees everything before it.
    pub fn barrier(&self) {
        let all = vk::PipelineStageFlags::ALL_COMMANDS;
        let seen = vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE;
        self.memory_barrier(all, all, seen);
    }

    /// The host sees everything before it.
    fn barrier_to_host(&self) {
        let (all, host) = (vk::PipelineStageFlags::ALL_COMMANDS, vk::PipelineStageFlags::HOST);
        self.memory_barrier(all, host, vk::AccessFlags::HOST_READ);
    }

    fn memory_barrier(
        &self,
        from: vk::PipelineStageFlags,
        to: vk::PipelineStageFlags,
        seen: vk::AccessFlags,
    ) {
        let barrier = [vk::MemoryBarrier::default()
            .src_access_mask(vk::AccessFlags::MEMORY_WRITE)
            .dst_access_mask(seen)];
        // SAFETY: the command buffer is being recorded.
        unsafe {
            let none = vk::DependencyFlags::empty();
            self.gpu.0.raw.cmd_pipeline_barrier(self.raw, from, to, none, &barrier, &[], &[]);
        }
    }

    /// Copies `size` bytes between buffers.
    ///
    /// # Panics
    /// If they do not lie within both.
    pub fn copy(&self, from: (&Buffer, u64), to: (&Buffer, u64), size: u64) {
        assert!(from.1 + size <= from.0.size() && to.1 + size <= to.0.size(), "{size} bytes to copy");
        if size == 0 {
            return;
        }
        let region = [vk::BufferCopy { src_offset: from.1, dst_offset: to.1, size }];
        // SAFETY: the command buffer is being recorded; both ranges exist.
        unsafe { self.gpu.0.raw.cmd_copy_buffer(self.raw, from.0.raw(), to.0.raw(), &region) };
    }

    /// Writes a few bytes, a multiple of four and at most 64 KiB, at the start of a buffer.
    ///
    /// # Panics
    /// If there are more, or more than fit.
    pub fn update(&self, buffer: &Buffer, bytes: &[u8]) {
        let size = bytes.len() as u64;
        assert!(size <= 65536 && size.is_multiple_of(4) && size <= buffer.size(), "{size} bytes to write");
        // SAFETY: the command buffer is being recorded.
        unsafe { self.gpu.0.raw.cmd_update_buffer(self.raw, buffer.raw(), 0, bytes) };
    }

    /// Fills a whole buffer with one word.
    pub fn fill(&self, buffer: &Buffer, word: u32) {
        // SAFETY: the command buffer is being recorded.
        unsafe { self.gpu.0.raw.cmd_fill_buffer(self.raw, buffer.raw(), 0, vk::WHOLE_SIZE, word) };
    }
}
