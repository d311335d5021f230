//! Buffers: memory with an address.

use crate::error::{Called, VulkanError};
use crate::gpu::Gpu;
use ash::vk;
use bytemuck::Pod;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::Allocation;

/// What a buffer is for: where it lies, and what else it may be used for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Data that shaders read and write by address; vertices and instances of acceleration structures; sizes of launches.
    Data,
    /// The inside of an acceleration structure.
    AccelerationStructure,
    /// A shader binding table.
    BindingTable,
    /// The host writes it, the device copies from it or reads it.
    Upload,
    /// The device copies to it, the host reads it (cached).
    Readback,
}

/// A piece of memory with an address on the device.
pub struct Buffer {
    gpu: Gpu,
    raw: vk::Buffer,
    allocation: Option<Allocation>,
    size: u64,
    address: u64,
}

impl std::fmt::Debug for Buffer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Buffer").field("size", &self.size).field("address", &self.address).finish()
    }
}

impl Purpose {
    fn usage(self) -> vk::BufferUsageFlags {
        let copied = vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST;
        let read = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::SHADER_DEVICE_ADDRESS;
        match self {
            Purpose::Data => {
                copied
                    | read
                    | vk::BufferUsageFlags::INDIRECT_BUFFER
                    | vk::BufferUsageFlags::ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_KHR
            }
            Purpose::AccelerationStructure => {
                vk::BufferUsageFlags::ACCELERATION_STRUCTURE_STORAGE_KHR
                    | vk::BufferUsageFlags::SHADER_DEVICE_ADDRESS
            }
            Purpose::BindingTable => {
                copied
                    | vk::BufferUsageFlags::SHADER_BINDING_TABLE_KHR
                    | vk::BufferUsageFlags::SHADER_DEVICE_ADDRESS
            }
            Purpose::Upload | Purpose::Readback => copied | read,
        }
    }

    fn location(self) -> MemoryLocation {
        match self {
            Purpose::Upload => MemoryLocation::CpuToGpu,
            Purpose::Readback => MemoryLocation::GpuToCpu,
            _ => MemoryLocation::GpuOnly,
        }
    }
}

impl Buffer {
    /// A buffer of `size` bytes, whose content is undefined; of at least 4 bytes, so that it has an address.
    ///
    /// # Errors
    /// If there is not enough memory, or it is larger than the device can give in one piece.
    pub fn new(gpu: &Gpu, name: &str, size: u64, purpose: Purpose) -> Result<Self, VulkanError> {
        let limit = gpu.0.limits.largest_allocation;
        if size > limit {
            return Err(VulkanError::TooLarge { what: format!("{name} (bytes)"), needed: size, limit });
        }
        let create = vk::BufferCreateInfo::default().size(size.max(4)).usage(purpose.usage());
        let device = &gpu.0.raw;
        // SAFETY: a live device; the buffer is destroyed by `drop`.
        let raw = unsafe { device.create_buffer(&create, None) }.called("vkCreateBuffer")?;
        let mut buffer = Buffer { gpu: gpu.clone(), raw, allocation: None, size, address: 0 };
        // SAFETY: the buffer is new; the memory is bound once and lives as long.
        let requirements = unsafe { device.get_buffer_memory_requirements(raw) };
        let allocation = gpu.0.memory.allocate(name, requirements, purpose.location(), true)?;
        let (memory, offset) = unsafe { (allocation.memory(), allocation.offset()) };
        buffer.allocation = Some(allocation);
        unsafe { device.bind_buffer_memory(raw, memory, offset) }.called("vkBindBufferMemory")?;
        let info = vk::BufferDeviceAddressInfo::default().buffer(raw);
        buffer.address = unsafe { device.get_buffer_device_address(&info) };
        gpu.0.name(raw, name);
        Ok(buffer)
    }

    /// Bytes asked for.
    pub fn size(&self) -> u64 {
        self.size
    }

    /// Where it lies on the device.
    pub fn address(&self) -> u64 {
        self.address
    }

    pub(crate) fn raw(&self) -> vk::Buffer {
        self.raw
    }

    /// Writes at `offset`, which the device sees from the next submission on.
    ///
    /// # Panics
    /// If this is no [`Purpose::Upload`] buffer, or too small.
    pub fn write(&mut self, offset: usize, bytes: &[u8]) {
        let mapped = self.allocation.as_mut().and_then(Allocation::mapped_slice_mut);
        let mapped = mapped.expect("a buffer that the host can write");
        mapped[offset..offset + bytes.len()].copy_from_slice(bytes);
    }

    /// What the device wrote, as of the last submission that was waited for.
    ///
    /// # Panics
    /// If this is no [`Purpose::Readback`] buffer.
    pub fn read(&self) -> &[u8] {
        let mapped = self.allocation.as_ref().and_then(Allocation::mapped_slice);
        &mapped.expect("a buffer that the host can read")[..self.size as usize]
    }

    /// The same as values.
    ///
    /// # Panics
    /// If this is no [`Purpose::Readback`] buffer, or its size is no multiple of theirs.
    pub fn read_as<T: Pod>(&self) -> Vec<T> {
        let bytes = self.read();
        assert_eq!(bytes.len() % size_of::<T>(), 0, "a whole number of values");
        bytes.chunks_exact(size_of::<T>()).map(bytemuck::pod_read_unaligned).collect()
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        let (raw, allocation) = (self.raw, self.allocation.take());
        self.gpu.0.discard(move |gpu| {
            // SAFETY: nothing that uses it is under way.
            unsafe { gpu.raw.destroy_buffer(raw, None) };
            allocation.into_iter().for_each(|a| gpu.memory.free(a));
        });
    }
}
