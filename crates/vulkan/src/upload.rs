//! From the host to the device, through two buffers that take turns.

use crate::buffer::{Buffer, Purpose};
use crate::commands::Pending;
use crate::error::VulkanError;
use crate::gpu::Gpu;

/// Bytes of each of the two buffers.
pub(crate) const CHUNK: u64 = 32 << 20;

/// A way for much data: one chunk is copied by the device while the host writes the next.
pub struct Upload {
    gpu: Gpu,
    /// Buffers, with the copy that reads them.
    chunks: [Option<(Buffer, Option<Pending>)>; 2],
    next: usize,
}

impl Upload {
    /// Takes no memory until it is used.
    pub fn new(gpu: &Gpu) -> Self {
        Upload { gpu: gpu.clone(), chunks: [None, None], next: 0 }
    }

    /// Copies to a buffer, from `offset` on.
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub fn write(&mut self, to: &Buffer, offset: u64, bytes: &[u8]) -> Result<(), VulkanError> {
        let mut at = offset;
        for chunk in bytes.chunks(CHUNK as usize) {
            let gpu = self.gpu.clone();
            self.through(chunk, |from| {
                gpu.submit("an upload", |c| {
                    c.copy((from, 0), (to, at), chunk.len() as u64);
                    Ok(())
                })
            })?;
            at += chunk.len() as u64;
        }
        Ok(())
    }

    /// Puts at most [`CHUNK`] bytes into a chunk that is free, and lets `submit` copy from there.
    pub(crate) fn through(
        &mut self,
        bytes: &[u8],
        submit: impl FnOnce(&Buffer) -> Result<Pending, VulkanError>,
    ) -> Result<(), VulkanError> {
        let place = &mut self.chunks[self.next];
        self.next = 1 - self.next;
        let free = place.take().map(|(buffer, copy)| copy.map_or(Ok(()), Pending::wait).map(|()| buffer));
        let large_enough = |buffer: &Buffer| buffer.size() >= bytes.len() as u64;
        let mut buffer = match free.transpose()?.filter(large_enough) {
            Some(buffer) => buffer,
            None => {
                // Small uploads get small buffers.
                let size = (bytes.len() as u64).next_power_of_two().clamp(1 << 16, CHUNK);
                Buffer::new(&self.gpu, "upload", size, Purpose::Upload)?
            }
        };
        buffer.write(0, bytes);
        let pending = submit(&buffer)?;
        *place = Some((buffer, Some(pending)));
        Ok(())
    }

    /// Waits until all is there.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn finish(mut self) -> Result<(), VulkanError> {
        self.chunks.iter_mut().flatten().filter_map(|c| c.1.take()).try_for_each(Pending::wait)
    }
}

impl Upload {
    pub(crate) fn gpu(&self) -> &Gpu {
        &self.gpu
    }
}

impl Drop for Upload {
    fn drop(&mut self) {
        // Copies end before the buffers that they read are freed.
        self.chunks.iter_mut().flatten().for_each(|c| drop(c.1.take()));
    }
}

impl Buffer {
    /// A [`Purpose::Data`] buffer with this content.
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub fn with_content(upload: &mut Upload, name: &str, content: &[u8]) -> Result<Self, VulkanError> {
        let buffer = Buffer::new(&upload.gpu, name, content.len() as u64, Purpose::Data)?;
        upload.write(&buffer, 0, content)?;
        Ok(buffer)
    }

    /// Gives it this content, in its place if there is room, else in a new one with some to spare. What is left of the old content behind
    /// the new one stays.
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub(crate) fn refill(
        &mut self,
        upload: &mut Upload,
        name: &str,
        content: &[u8],
    ) -> Result<(), VulkanError> {
        let size = content.len() as u64;
        if size > self.size() {
            *self = Buffer::new(&upload.gpu, name, size + size / 4, Purpose::Data)?;
        }
        upload.write(self, 0, content)
    }
}
