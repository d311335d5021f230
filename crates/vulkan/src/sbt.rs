//! The shader binding table: one buffer with the records of ray generation, miss and hit shaders.
//!
//! ```text
//! ray generation | miss: radiance, shadow | hit: class 0 radiance, class 0 shadow, class 1 radiance, …
//! ```

use crate::buffer::{Buffer, Purpose};
use crate::error::{Called, VulkanError};
use crate::gpu::{Gpu, Limits};
use crate::upload::Upload;
use ash::vk;

/// Every region begins at a multiple of this: enough for every known driver.
const ALIGNMENT: u64 = crate::memory::ALIGNMENT;

/// Where each kind of record lies.
pub(crate) struct BindingTable {
    _buffer: Buffer,
    pub(crate) raygen: vk::StridedDeviceAddressRegionKHR,
    pub(crate) miss: vk::StridedDeviceAddressRegionKHR,
    pub(crate) hit: vk::StridedDeviceAddressRegionKHR,
}

/// Offset, stride and number of the records of a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Region {
    offset: u64,
    stride: u64,
    count: u64,
}

/// The regions, and the size of all of them.
fn regions(limits: &Limits, counts: [u64; 3]) -> ([Region; 3], u64) {
    let stride = u64::from(limits.handle_size).next_multiple_of(u64::from(limits.handle_alignment).max(1));
    let alignment = ALIGNMENT.max(u64::from(limits.base_alignment));
    let mut end = 0;
    let regions = counts.map(|count| {
        let region = Region { offset: end, stride, count };
        end = (end + stride * count).next_multiple_of(alignment);
        region
    });
    (regions, end)
}

impl BindingTable {
    /// The table of a pipeline whose groups are one for ray generation, then `miss`, then `hit`.
    pub(crate) fn new(gpu: &Gpu, pipeline: vk::Pipeline, miss: u32, hit: u32) -> Result<Self, VulkanError> {
        let limits = &gpu.0.limits;
        let count = 1 + miss + hit;
        let size = limits.handle_size as usize;
        // SAFETY: a pipeline with as many groups.
        let handles = unsafe {
            let size = size * count as usize;
            gpu.0.pipelines.get_ray_tracing_shader_group_handles(pipeline, 0, count, size)
        }
        .called("vkGetRayTracingShaderGroupHandlesKHR")?;
        let (regions, total) = regions(limits, [1, miss.into(), hit.into()]);
        let mut content = vec![0; total as usize];
        let mut handles = handles.chunks_exact(size);
        for region in &regions {
            for i in 0..region.count {
                let at = (region.offset + i * region.stride) as usize;
                content[at..at + size].copy_from_slice(handles.next().expect("a handle for each group"));
            }
        }
        let buffer = Buffer::new(gpu, "shader binding table", total, Purpose::BindingTable)?;
        let mut upload = Upload::new(gpu);
        upload.write(&buffer, 0, &content)?;
        upload.finish()?;
        assert_eq!(buffer.address() % ALIGNMENT, 0, "the address of a shader binding table");
        let [raygen, miss, hit] = regions.map(|r| vk::StridedDeviceAddressRegionKHR {
            device_address: buffer.address() + r.offset,
            stride: r.stride,
            size: r.stride * r.count,
        });
        Ok(BindingTable { _buffer: buffer, raygen, miss, hit })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_lie_as_drivers_ask() {
        let limits =
            Limits { handle_size: 32, handle_alignment: 64, base_alignment: 64, ..Limits::default() };
        let ([raygen, miss, hit], total) = regions(&limits, [1, 2, 6]);
        // Size and stride of ray generation must be equal.
        assert_eq!(raygen, Region { offset: 0, stride: 64, count: 1 });
        assert_eq!(miss, Region { offset: 256, stride: 64, count: 2 });
        assert_eq!(hit, Region { offset: 512, stride: 64, count: 6 });
        assert_eq!(total, 1024);
    }
}
