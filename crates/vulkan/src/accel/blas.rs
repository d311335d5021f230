//! Bottom-level acceleration structures: built in batches of bounded size, then compacted.

use super::PartBuffers;
use super::plan::{BlasPlan, Plan};
use super::structure::{Structure, offsets, side_by_side};
use crate::buffer::{Buffer, Purpose};
use crate::commands::Commands;
use crate::error::VulkanError;
use crate::gpu::Gpu;
use crate::scene::geometry::Geometry;
use crate::timer::{Queries, Timer};
use crate::upload::Upload;
use ash::vk;
use lumbre_core::measure::AccelReport;
use lumbre_scene::CompiledScene;
use lumbre_shaders::layout::HitClass;

const BOTTOM: vk::AccelerationStructureTypeKHR = vk::AccelerationStructureTypeKHR::BOTTOM_LEVEL;
/// Bytes of structures before compaction, and of scratch space, that a batch takes unless one structure alone takes more.
const BATCH: u64 = 256 << 20;

/// All bottom-level structures, in the order of the plan.
pub(crate) struct Bottom {
    pub(crate) structures: Vec<Structure>,
}

/// What Vulkan wants to know of one structure; `info` must be completed where it is used.
struct Description {
    geometries: Vec<vk::AccelerationStructureGeometryKHR<'static>>,
    ranges: Vec<vk::AccelerationStructureBuildRangeInfoKHR>,
    size: u64,
    scratch: u64,
}

impl Description {
    fn info(&self) -> vk::AccelerationStructureBuildGeometryInfoKHR<'_> {
        vk::AccelerationStructureBuildGeometryInfoKHR::default()
            .ty(BOTTOM)
            .flags(
                vk::BuildAccelerationStructureFlagsKHR::PREFER_FAST_TRACE
                    | vk::BuildAccelerationStructureFlagsKHR::ALLOW_COMPACTION,
            )
            .mode(vk::BuildAccelerationStructureModeKHR::BUILD)
            .geometries(&self.geometries)
    }
}

/// Builds and compacts all.
pub(crate) fn build(
    upload: &mut Upload,
    scene: &CompiledScene,
    geometry: &Geometry,
    plan: &Plan,
    parts: &PartBuffers,
) -> Result<(Bottom, AccelReport), VulkanError> {
    let gpu = upload.gpu().clone();
    let transforms = transforms(upload, scene)?;
    let inputs = Inputs { scene, geometry, plan, parts, transforms: transforms.address() };
    let descriptions: Vec<Description> = plan.structures.iter().map(|s| inputs.describe(&gpu, s)).collect();
    let mut report = AccelReport {
        structures: descriptions.len(),
        triangles: descriptions.iter().flat_map(|d| &d.ranges).map(|r| u64::from(r.primitive_count)).sum(),
        ..AccelReport::default()
    };
    let mut structures = Vec::with_capacity(descriptions.len());
    for batch in batches(&descriptions) {
        let built = build_batch(&gpu, batch, &mut report)?;
        structures.extend(compact(&gpu, built, &mut report)?);
    }
    Ok((Bottom { structures }, report))
}

/// Rows of the 3x4 matrix of each instance, as `VkTransformMatrixKHR`.
fn transforms(upload: &mut Upload, scene: &CompiledScene) -> Result<Buffer, VulkanError> {
    let rows: Vec<[[f32; 4]; 3]> = scene
        .instances
        .iter()
        .map(|i| scene.transforms[i.first_transform as usize].object_to_world)
        .collect();
    Buffer::with_content(upload, "transforms of geometries", bytemuck::cast_slice(&rows))
}

/// Where everything lies that structures are built from.
struct Inputs<'a> {
    scene: &'a CompiledScene,
    geometry: &'a Geometry,
    plan: &'a Plan,
    parts: &'a PartBuffers,
    transforms: u64,
}

impl Inputs<'_> {
    fn describe(&self, gpu: &Gpu, plan: &BlasPlan) -> Description {
        let mut description = Description { geometries: Vec::new(), ranges: Vec::new(), size: 0, scratch: 0 };
        for g in &plan.geometries {
            let part = &self.plan.parts()[g.part];
            let mesh = &self.scene.meshes[part.mesh as usize];
            let table = self.geometry.table(part.mesh);
            let indices = match self.parts.addresses[g.part][0] {
                0 => table.triangles,
                own => own,
            };
            let last = mesh.first_vertex + mesh.vertex_count.max(1)
                - 1
                - self.geometry.first_vertex_of_chunk(part.mesh);
            let triangles = vk::AccelerationStructureGeometryTrianglesDataKHR::default()
                .vertex_format(vk::Format::R32G32B32_SFLOAT)
                .vertex_data(vk::DeviceOrHostAddressConstKHR { device_address: table.positions })
                .vertex_stride(12)
                .max_vertex(last)
                .index_type(vk::IndexType::UINT32)
                .index_data(vk::DeviceOrHostAddressConstKHR { device_address: indices })
                .transform_data(vk::DeviceOrHostAddressConstKHR {
                    device_address: if g.placed.is_some() { self.transforms } else { 0 },
                });
            let flags = match plan.class.hit {
                HitClass::Opaque => vk::GeometryFlagsKHR::OPAQUE,
                // Any-hit shaders decide by a hash of what is hit: asked twice they say the same.
                HitClass::Transmissive | HitClass::Covered => vk::GeometryFlagsKHR::empty(),
            };
            description.geometries.push(
                vk::AccelerationStructureGeometryKHR::default()
                    .geometry_type(vk::GeometryTypeKHR::TRIANGLES)
                    .geometry(vk::AccelerationStructureGeometryDataKHR { triangles })
                    .flags(flags),
            );
            description.ranges.push(
                vk::AccelerationStructureBuildRangeInfoKHR::default()
                    .primitive_count(part.count)
                    .transform_offset(
                        g.placed.map_or(0, |instance| instance * size_of::<[[f32; 4]; 3]>() as u32),
                    ),
            );
        }
        let counts: Vec<u32> = description.ranges.iter().map(|r| r.primitive_count).collect();
        let sizes = build_sizes(gpu, &description.info(), &counts);
        (description.size, description.scratch) =
            (sizes.acceleration_structure_size, sizes.build_scratch_size);
        description
    }
}

/// What a build will take.
pub(super) fn build_sizes(
    gpu: &Gpu,
    info: &vk::AccelerationStructureBuildGeometryInfoKHR<'_>,
    counts: &[u32],
) -> vk::AccelerationStructureBuildSizesInfoKHR<'static> {
    let mut sizes = vk::AccelerationStructureBuildSizesInfoKHR::default();
    // SAFETY: as many counts as geometries; addresses are not read.
    unsafe {
        gpu.0.acceleration.get_acceleration_structure_build_sizes(
            vk::AccelerationStructureBuildTypeKHR::DEVICE,
            info,
            counts,
            &mut sizes,
        );
    }
    sizes
}

/// Neighbours that are built together.
fn batches(all: &[Description]) -> Vec<&[Description]> {
    let mut batches = Vec::new();
    let (mut first, mut size, mut scratch) = (0, 0, 0);
    for (i, d) in all.iter().enumerate() {
        if i > first && (size + d.size > BATCH || scratch + d.scratch > BATCH) {
            batches.push(&all[first..i]);
            (first, size, scratch) = (i, 0, 0);
        }
        size += d.size;
        scratch += d.scratch;
    }
    if first < all.len() {
        batches.push(&all[first..]);
    }
    batches
}

/// Structures as built, and what each would take when compacted.
fn build_batch(
    gpu: &Gpu,
    batch: &[Description],
    report: &mut AccelReport,
) -> Result<Vec<(Structure, u64)>, VulkanError> {
    let sizes: Vec<u64> = batch.iter().map(|d| d.size).collect();
    let structures = side_by_side(gpu, BOTTOM, "structures before compaction", &sizes)?;
    let (places, scratch_size) = offsets(&batch.iter().map(|d| d.scratch).collect::<Vec<_>>());
    let scratch = Buffer::new(gpu, "scratch space of structures", scratch_size, Purpose::Data)?;
    let compacted = Queries::new(gpu, vk::QueryType::ACCELERATION_STRUCTURE_COMPACTED_SIZE_KHR, batch.len())?;
    let timer = Timer::new(gpu, 2)?;
    let infos: Vec<_> = (0..batch.len())
        .map(|i| {
            batch[i]
                .info()
                .dst_acceleration_structure(structures[i].raw)
                .scratch_data(vk::DeviceOrHostAddressKHR { device_address: scratch.address() + places[i] })
        })
        .collect();
    let ranges: Vec<&[_]> = batch.iter().map(|d| &d.ranges[..]).collect();
    gpu.run("acceleration structures", |c| {
        timer.reset(c);
        compacted.reset(c);
        timer.stamp(c, 0);
        // SAFETY: the command buffer is being recorded; all that the builds use is alive until it was waited for.
        unsafe { gpu.0.acceleration.cmd_build_acceleration_structures(c.raw, &infos, &ranges) };
        timer.stamp(c, 1);
        c.barrier();
        write_compacted_sizes(c, &structures, &compacted);
        Ok(())
    })?;
    report.build_ms += timer.milliseconds()?[1];
    report.bytes_built += sizes.iter().sum::<u64>();
    Ok(structures.into_iter().zip(compacted.results()?).collect())
}

fn write_compacted_sizes(c: &Commands<'_>, structures: &[Structure], into: &Queries) {
    let raw: Vec<_> = structures.iter().map(|s| s.raw).collect();
    // SAFETY: the command buffer is being recorded; the structures were built with leave to compact; the queries were reset.
    unsafe {
        c.gpu.0.acceleration.cmd_write_acceleration_structures_properties(
            c.raw,
            &raw,
            vk::QueryType::ACCELERATION_STRUCTURE_COMPACTED_SIZE_KHR,
            into.raw,
            0,
        );
    }
}

/// Copies structures to as much memory as they need.
fn compact(
    gpu: &Gpu,
    built: Vec<(Structure, u64)>,
    report: &mut AccelReport,
) -> Result<Vec<Structure>, VulkanError> {
    let sizes: Vec<u64> = built.iter().map(|b| b.1).collect();
    let compacted = side_by_side(gpu, BOTTOM, "structures", &sizes)?;
    let timer = Timer::new(gpu, 2)?;
    gpu.run("compaction", |c| {
        timer.reset(c);
        timer.stamp(c, 0);
        for ((from, _), to) in built.iter().zip(&compacted) {
            let copy = vk::CopyAccelerationStructureInfoKHR::default()
                .src(from.raw)
                .dst(to.raw)
                .mode(vk::CopyAccelerationStructureModeKHR::COMPACT);
            // SAFETY: the command buffer is being recorded; the new structure is as large as the query said.
            unsafe { gpu.0.acceleration.cmd_copy_acceleration_structure(c.raw, &copy) };
        }
        timer.stamp(c, 1);
        Ok(())
    })?;
    report.compact_ms += timer.milliseconds()?[1];
    report.bytes += sizes.iter().sum::<u64>();
    Ok(compacted)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_are_bounded() {
        let of = |size, scratch| Description { geometries: vec![], ranges: vec![], size, scratch };
        let all = [of(BATCH / 2, 1), of(BATCH / 2, 1), of(1, 1), of(2 * BATCH, 1), of(1, BATCH), of(1, 1)];
        let lengths: Vec<usize> = batches(&all).iter().map(|b| b.len()).collect();
        assert_eq!(lengths, [2, 1, 1, 1, 1]);
        assert!(batches(&[]).is_empty());
        // The batches are all of them, in order.
        assert_eq!(lengths.iter().sum::<usize>(), all.len());
    }
}
