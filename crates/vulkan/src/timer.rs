//! Queries: how long the device takes for something, and what it says of acceleration structures.

use crate::commands::Commands;
use crate::error::{Called, VulkanError};
use crate::gpu::Gpu;
use ash::vk;

/// A pool of queries, one number each.
pub(crate) struct Queries {
    gpu: Gpu,
    pub(crate) raw: vk::QueryPool,
    count: usize,
}

impl Queries {
    pub(crate) fn new(gpu: &Gpu, kind: vk::QueryType, count: usize) -> Result<Self, VulkanError> {
        let create = vk::QueryPoolCreateInfo::default().query_type(kind).query_count(count as u32);
        // SAFETY: a live device.
        let raw = unsafe { gpu.0.raw.create_query_pool(&create, None) }.called("vkCreateQueryPool")?;
        Ok(Queries { gpu: gpu.clone(), raw, count })
    }

    /// Before they are used again.
    pub(crate) fn reset(&self, commands: &Commands<'_>) {
        // SAFETY: the command buffer is being recorded.
        unsafe { self.gpu.0.raw.cmd_reset_query_pool(commands.raw, self.raw, 0, self.count as u32) };
    }

    /// Their numbers, once the submission that writes all of them was waited for.
    pub(crate) fn results(&self) -> Result<Vec<u64>, VulkanError> {
        let mut results = vec![0u64; self.count];
        let flags = vk::QueryResultFlags::TYPE_64 | vk::QueryResultFlags::WAIT;
        // SAFETY: a live pool with as many queries.
        unsafe { self.gpu.0.raw.get_query_pool_results(self.raw, 0, &mut results, flags) }
            .called("vkGetQueryPoolResults")?;
        Ok(results)
    }
}

impl Drop for Queries {
    fn drop(&mut self) {
        let raw = self.raw;
        // SAFETY: nothing that uses it is under way.
        self.gpu.0.discard(move |gpu| unsafe { gpu.raw.destroy_query_pool(raw, None) });
    }
}

/// A stopwatch of the device: stamps within one submission. Where the device has no clock all times are 0.
pub struct Timer {
    queries: Queries,
    /// Bits of a stamp that count.
    mask: u64,
}

impl Timer {
    /// With so many stamps.
    ///
    /// # Errors
    /// If the driver refuses.
    pub fn new(gpu: &Gpu, stamps: usize) -> Result<Self, VulkanError> {
        let mask = u64::MAX.checked_shr(64 - gpu.0.adapter.clock_bits.min(64)).unwrap_or(0);
        Ok(Timer { queries: Queries::new(gpu, vk::QueryType::TIMESTAMP, stamps)?, mask })
    }

    /// First of all in a submission.
    pub fn reset(&self, commands: &Commands<'_>) {
        self.queries.reset(commands);
    }

    /// Notes when all commands so far were done.
    ///
    /// # Panics
    /// If there are not as many stamps.
    pub fn stamp(&self, commands: &Commands<'_>, stamp: usize) {
        assert!(stamp < self.queries.count, "stamp {stamp} of {}", self.queries.count);
        if self.mask == 0 {
            return;
        }
        let stage = vk::PipelineStageFlags::BOTTOM_OF_PIPE;
        // SAFETY: the command buffer is being recorded; the query was reset.
        unsafe {
            commands.gpu.0.raw.cmd_write_timestamp(commands.raw, stage, self.queries.raw, stamp as u32)
        };
    }

    /// Times of the stamps since the first, milliseconds, once the submission was waited for.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn milliseconds(&self) -> Result<Vec<f64>, VulkanError> {
        if self.mask == 0 {
            return Ok(vec![0.0; self.queries.count]);
        }
        let results = self.queries.results()?;
        let period = f64::from(self.queries.gpu.0.limits.timestamp_period_ns) * 1e-6;
        Ok(results.iter().map(|r| (r.wrapping_sub(results[0]) & self.mask) as f64 * period).collect())
    }
}
