//! One acceleration structure, and the sizes that building it takes.

use crate::buffer::{Buffer, Purpose};
use crate::error::{Called, VulkanError};
use crate::gpu::Gpu;
use ash::vk;
use std::sync::Arc;

/// An acceleration structure in a buffer that it may share with others.
pub(crate) struct Structure {
    gpu: Gpu,
    pub(crate) raw: vk::AccelerationStructureKHR,
    /// Dropped after `raw` was discarded: things are freed in the order in which they are dropped.
    _storage: Arc<Buffer>,
    size: u64,
}

impl Structure {
    /// Room for a structure, at a multiple of 256 bytes.
    pub(crate) fn new(
        gpu: &Gpu,
        kind: vk::AccelerationStructureTypeKHR,
        storage: &Arc<Buffer>,
        offset: u64,
        size: u64,
    ) -> Result<Self, VulkanError> {
        let create = vk::AccelerationStructureCreateInfoKHR::default()
            .ty(kind)
            .buffer(storage.raw())
            .offset(offset)
            .size(size);
        // SAFETY: the range lies in the buffer, which lives as long.
        let raw = unsafe { gpu.0.acceleration.create_acceleration_structure(&create, None) }
            .called("vkCreateAccelerationStructureKHR")?;
        Ok(Structure { gpu: gpu.clone(), raw, _storage: storage.clone(), size })
    }

    /// Bytes.
    pub(crate) fn size(&self) -> u64 {
        self.size
    }

    /// What an instance of it holds.
    pub(crate) fn address(&self) -> u64 {
        let info = vk::AccelerationStructureDeviceAddressInfoKHR::default().acceleration_structure(self.raw);
        // SAFETY: a live structure.
        unsafe { self.gpu.0.acceleration.get_acceleration_structure_device_address(&info) }
    }
}

impl Drop for Structure {
    fn drop(&mut self) {
        let raw = self.raw;
        // SAFETY: nothing that uses it is under way.
        self.gpu.0.discard(move |gpu| unsafe { gpu.acceleration.destroy_acceleration_structure(raw, None) });
    }
}

/// Structures of these sizes one after another in a new buffer.
pub(crate) fn side_by_side(
    gpu: &Gpu,
    kind: vk::AccelerationStructureTypeKHR,
    name: &str,
    sizes: &[u64],
) -> Result<Vec<Structure>, VulkanError> {
    let (offsets, total) = offsets(sizes);
    let storage = Arc::new(Buffer::new(gpu, name, total, Purpose::AccelerationStructure)?);
    offsets.iter().zip(sizes).map(|(&at, &size)| Structure::new(gpu, kind, &storage, at, size)).collect()
}

/// Where pieces of these sizes begin when each begins at a multiple of 256, and how much they take.
pub(crate) fn offsets(sizes: &[u64]) -> (Vec<u64>, u64) {
    let mut end = 0;
    let begin = |&size: &u64| {
        let begin = end;
        end = (begin + size).next_multiple_of(crate::memory::ALIGNMENT);
        begin
    };
    (sizes.iter().map(begin).collect(), end)
}

#[cfg(test)]
mod tests {
    use super::offsets;

    #[test]
    fn pieces_lie_apart_and_aligned() {
        assert_eq!(offsets(&[1, 256, 300, 0, 5]), (vec![0, 256, 512, 1024, 1024], 1280));
        assert_eq!(offsets(&[]), (vec![], 0));
    }
}
