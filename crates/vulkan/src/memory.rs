//! Memory of the device: what is there, what is free, and pieces of it.

use crate::adapters::Adapter;
use crate::error::VulkanError;
use crate::gpu::lock;
use ash::vk;
use gpu_allocator::vulkan::{
    Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc,
};
use gpu_allocator::{AllocationError, AllocationSizes, AllocatorDebugSettings, MemoryLocation};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

/// Every piece begins at a multiple of this, so that what is built in it (acceleration structures, their scratch space, shader
/// binding tables) lies as every known driver asks.
pub(crate) const ALIGNMENT: u64 = 256;

/// The memory of a device.
pub(crate) struct Memory {
    allocator: Mutex<Allocator>,
    instance: ash::Instance,
    adapter: vk::PhysicalDevice,
    knows_budget: bool,
    heaps: vk::PhysicalDeviceMemoryProperties,
    /// Bytes of all pieces.
    allocated: AtomicU64,
    /// Bytes that tests leave of it.
    cap: AtomicU64,
}

/// How much of the device's own memory is in use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryUse {
    /// Bytes that live buffers and images take.
    pub allocated: u64,
    /// Bytes taken from the driver for them.
    pub reserved: u64,
    /// How many buffers and images there are.
    pub pieces: usize,
    /// Bytes that the driver would still give, of the device's own memory.
    pub available: u64,
}

impl Memory {
    pub(crate) fn new(
        instance: &ash::Instance,
        device: &ash::Device,
        adapter: &Adapter,
    ) -> Result<Self, VulkanError> {
        const MIB: u64 = 1 << 20;
        let sizes = AllocationSizes::new(8 * MIB, 8 * MIB)
            .with_max_device_memblock_size(256 * MIB)
            .with_max_host_memblock_size(64 * MIB);
        let allocator = Allocator::new(&AllocatorCreateDesc {
            instance: instance.clone(),
            device: device.clone(),
            physical_device: adapter.raw,
            debug_settings: AllocatorDebugSettings::default(),
            buffer_device_address: true,
            allocation_sizes: sizes,
        })
        .map_err(|_| VulkanError::Missing {
            device: adapter.name.clone(),
            what: vec!["memory that can be mapped".to_owned()],
        })?;
        Ok(Memory {
            allocator: Mutex::new(allocator),
            instance: instance.clone(),
            adapter: adapter.raw,
            knows_budget: adapter.features.memory_budget,
            // SAFETY: an adapter of this instance.
            heaps: unsafe { instance.get_physical_device_memory_properties(adapter.raw) },
            allocated: AtomicU64::new(0),
            cap: AtomicU64::new(u64::MAX),
        })
    }

    /// A piece of memory.
    ///
    /// # Errors
    /// If there is not enough, with what there is.
    pub(crate) fn allocate(
        &self,
        name: &str,
        requirements: vk::MemoryRequirements,
        location: MemoryLocation,
        linear: bool,
    ) -> Result<Allocation, VulkanError> {
        let out = |available| VulkanError::OutOfMemory {
            what: name.to_owned(),
            needed: requirements.size,
            available,
        };
        // A driver that is asked for more than there is may move memory to the host's side, or end the process. What fits into what
        // it gave already needs nothing more.
        if location == MemoryLocation::GpuOnly {
            let available = self.available();
            if requirements.size > available && requirements.size > self.spare() {
                return Err(out(available));
            }
        }
        let alignment = requirements.alignment.max(ALIGNMENT);
        let description = AllocationCreateDesc {
            name,
            requirements: vk::MemoryRequirements { alignment, ..requirements },
            location,
            linear,
            allocation_scheme: AllocationScheme::GpuAllocatorManaged,
        };
        let allocated = lock(&self.allocator).allocate(&description);
        let count = |a: &Allocation| self.allocated.fetch_add(a.size(), Ordering::Relaxed);
        allocated.inspect(|a| _ = count(a)).map_err(|error| match error {
            AllocationError::OutOfMemory => out(self.available()),
            _ => VulkanError::Call { call: "vkAllocateMemory", result: vk::Result::ERROR_UNKNOWN },
        })
    }

    /// Gives a piece back.
    pub(crate) fn free(&self, allocation: Allocation) {
        self.allocated.fetch_sub(allocation.size(), Ordering::Relaxed);
        lock(&self.allocator).free(allocation).expect("a piece of this allocator, freed once");
    }

    /// Bytes that the driver would still give, of the largest heap of the device's own memory.
    pub(crate) fn available(&self) -> u64 {
        let heaps = self.heaps.memory_heaps_as_slice();
        let own = |i: &usize| heaps[*i].flags.contains(vk::MemoryHeapFlags::DEVICE_LOCAL);
        let Some(largest) = (0..heaps.len()).filter(own).max_by_key(|&i| heaps[i].size) else { return 0 };
        let size = heaps[largest].size.min(self.cap.load(Ordering::Relaxed));
        let rest = size.saturating_sub(lock(&self.allocator).capacity());
        if !self.knows_budget {
            return rest;
        }
        let mut budget = vk::PhysicalDeviceMemoryBudgetPropertiesEXT::default();
        let mut all = vk::PhysicalDeviceMemoryProperties2::default().push_next(&mut budget);
        // SAFETY: an adapter of this instance that has the extension.
        unsafe { self.instance.get_physical_device_memory_properties2(self.adapter, &mut all) };
        // Where pages are only taken when they are touched, the driver's figures lag behind.
        rest.min(budget.heap_budget[largest].saturating_sub(budget.heap_usage[largest]))
    }

    /// Bytes taken from the driver that no piece uses.
    fn spare(&self) -> u64 {
        lock(&self.allocator).capacity().saturating_sub(self.allocated.load(Ordering::Relaxed))
    }

    /// Plays a device with this much memory.
    pub(crate) fn limit(&self, bytes: u64) {
        self.cap.store(bytes, Ordering::Relaxed);
    }

    /// What is in use.
    pub(crate) fn report(&self) -> MemoryUse {
        let report = lock(&self.allocator).generate_report();
        MemoryUse {
            allocated: report.total_allocated_bytes,
            reserved: report.total_capacity_bytes,
            pieces: report.allocations.len(),
            available: self.available(),
        }
    }
}
