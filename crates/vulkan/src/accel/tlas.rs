//! The top-level acceleration structure: instances of the bottom-level ones.

use super::blas::{Bottom, build_sizes};
use super::plan::{Class, Plan};
use super::structure::{Structure, side_by_side};
use crate::buffer::{Buffer, Purpose};
use crate::error::VulkanError;
use crate::timer::Timer;
use crate::upload::Upload;
use ash::vk;
use bytemuck::{Pod, Zeroable};
use lumbre_scene::CompiledScene;
use lumbre_shaders::layout::RAY_KINDS;

const TOP: vk::AccelerationStructureTypeKHR = vk::AccelerationStructureTypeKHR::TOP_LEVEL;
/// Custom indices have 24 bits.
const MOST_RECORDS: u64 = 1 << 24;

/// `VkAccelerationStructureInstanceKHR`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Instance {
    /// Rows of a 3x4 matrix.
    transform: [[f32; 4]; 3],
    /// 24 bits of custom index, 8 of mask.
    custom_index_and_mask: u32,
    /// 24 bits of offset into the shader binding table, 8 of flags.
    record_and_flags: u32,
    /// Address of the structure, low word first.
    structure: [u32; 2],
}

const IDENTITY: [[f32; 4]; 3] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

/// How rays treat the triangles of a class. The front is the side from which they wind counter-clockwise in their mesh; unflipped, it
/// is that in the space of the structure (right-handed).
fn flags(class: Class) -> u32 {
    let mut flags = vk::GeometryInstanceFlagsKHR::empty();
    if !class.culls {
        flags |= vk::GeometryInstanceFlagsKHR::TRIANGLE_FACING_CULL_DISABLE;
    }
    if class.mirrored {
        flags |= vk::GeometryInstanceFlagsKHR::TRIANGLE_FLIP_FACING;
    }
    flags.as_raw()
}

fn instances(scene: &CompiledScene, plan: &Plan, bottom: &Bottom) -> Vec<Instance> {
    let addresses: Vec<u64> = bottom.structures.iter().map(Structure::address).collect();
    let instance = |i: &super::plan::InstancePlan| {
        let class = plan.structures[i.blas].class;
        let (transform, mask) = match i.instance {
            None => (IDENTITY, 0xff),
            Some(id) => {
                let record = &scene.instances[id as usize];
                (scene.transforms[record.first_transform as usize].object_to_world, record.mask & 0xff)
            }
        };
        let address = addresses[i.blas];
        Instance {
            transform,
            custom_index_and_mask: i.first_record as u32 | (mask << 24),
            record_and_flags: (class.hit as u32 * RAY_KINDS) | (flags(class) << 24),
            structure: [address as u32, (address >> 32) as u32],
        }
    };
    plan.instances.iter().map(instance).collect()
}

/// Builds the top level, in the place of an earlier one that is large enough; how long the device took, milliseconds.
pub(super) fn build(
    upload: &mut Upload,
    scene: &CompiledScene,
    (plan, bottom): (&Plan, &Bottom),
    earlier: Option<Structure>,
) -> Result<(Structure, f64), VulkanError> {
    let gpu = upload.gpu().clone();
    if plan.hits.len() as u64 > MOST_RECORDS {
        let needed = plan.hits.len() as u64;
        return Err(VulkanError::TooLarge { what: "instances".to_owned(), needed, limit: MOST_RECORDS });
    }
    let all = instances(scene, plan, bottom);
    let buffer = Buffer::with_content(upload, "instances", bytemuck::cast_slice(&all))?;
    let data = vk::AccelerationStructureGeometryInstancesDataKHR::default()
        .data(vk::DeviceOrHostAddressConstKHR { device_address: buffer.address() });
    let geometry = [vk::AccelerationStructureGeometryKHR::default()
        .geometry_type(vk::GeometryTypeKHR::INSTANCES)
        .geometry(vk::AccelerationStructureGeometryDataKHR { instances: data })];
    let info = vk::AccelerationStructureBuildGeometryInfoKHR::default()
        .ty(TOP)
        .flags(vk::BuildAccelerationStructureFlagsKHR::PREFER_FAST_TRACE)
        .mode(vk::BuildAccelerationStructureModeKHR::BUILD)
        .geometries(&geometry);
    let sizes = build_sizes(&gpu, &info, &[all.len() as u32]);
    let needed = sizes.acceleration_structure_size;
    let structure = match earlier.filter(|e| e.size() >= needed) {
        Some(earlier) => earlier,
        None => side_by_side(&gpu, TOP, "the top-level structure", &[needed])?.pop().expect("one"),
    };
    let scratch =
        Buffer::new(&gpu, "scratch space of the top level", sizes.build_scratch_size, Purpose::Data)?;
    let infos = [info
        .dst_acceleration_structure(structure.raw)
        .scratch_data(vk::DeviceOrHostAddressKHR { device_address: scratch.address() })];
    let ranges = [vk::AccelerationStructureBuildRangeInfoKHR::default().primitive_count(all.len() as u32)];
    let timer = Timer::new(&gpu, 2)?;
    gpu.run("the top-level structure", |c| {
        timer.reset(c);
        timer.stamp(c, 0);
        // SAFETY: the command buffer is being recorded; all that the build uses is alive until it was waited for.
        unsafe { gpu.0.acceleration.cmd_build_acceleration_structures(c.raw, &infos, &[&ranges]) };
        timer.stamp(c, 1);
        Ok(())
    })?;
    Ok((structure, timer.milliseconds()?[1]))
}
