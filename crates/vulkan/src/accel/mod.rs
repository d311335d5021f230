//! Acceleration structures of a scene: which there are ([`plan`]), bottom-level ones ([`blas`]) and the top-level one ([`tlas`]).

mod blas;
pub(crate) mod plan;
mod structure;
mod tlas;

pub(crate) use structure::Structure;

use crate::buffer::Buffer;
use crate::error::VulkanError;
use crate::gpu::Gpu;
use crate::scene::geometry::Geometry;
use crate::upload::Upload;
use lumbre_core::measure::AccelReport;
use lumbre_scene::{CompiledScene, SceneChanges};
use plan::{Part, Plan};

/// The acceleration structures of a scene.
pub(crate) struct Accel {
    /// `None` only while it is built anew.
    top: Option<Structure>,
    /// Held for `top`.
    bottom: blas::Bottom,
    /// Indices and numbers of the triangles of parts; the latter are read when something is hit.
    parts: PartBuffers,
    plan: Plan,
    merge: bool,
    /// `GeometryRecord`s.
    pub(crate) records: Buffer,
    pub(crate) report: AccelReport,
}

/// Indices of the triangles of parts that are not the whole of their mesh, and their numbers in the mesh.
pub(crate) struct PartBuffers {
    buffers: Vec<Buffer>,
    /// For each part: addresses of its indices and its numbers; zero where the part is the whole.
    pub(crate) addresses: Vec<[u64; 2]>,
}

impl PartBuffers {
    fn new(
        upload: &mut Upload,
        scene: &CompiledScene,
        geometry: &Geometry,
        parts: &[Part],
    ) -> Result<Self, VulkanError> {
        let mut all = PartBuffers { buffers: Vec::new(), addresses: Vec::new() };
        for part in parts {
            let mut addresses = [0; 2];
            if let Some(ids) = &part.triangles {
                let mesh = &scene.meshes[part.mesh as usize];
                let rebase = geometry.first_vertex_of_chunk(part.mesh);
                let index =
                    |&t: &u32| scene.triangles[(mesh.first_triangle + t) as usize].map(|v| v - rebase);
                let indices: Vec<[u32; 3]> = ids.iter().map(index).collect();
                let contents: [&[u8]; 2] = [bytemuck::cast_slice(&indices), bytemuck::cast_slice(ids)];
                for (address, content) in addresses.iter_mut().zip(contents) {
                    let buffer = Buffer::with_content(upload, "triangles of a part of a mesh", content)?;
                    *address = buffer.address();
                    all.buffers.push(buffer);
                }
            }
            all.addresses.push(addresses);
        }
        Ok(all)
    }
}

impl Accel {
    /// Builds all structures of a scene whose geometry is on the device.
    ///
    /// # Errors
    /// If memory is out, the scene has too many geometries, or the device is lost.
    pub(crate) fn new(
        gpu: &Gpu,
        scene: &CompiledScene,
        geometry: &Geometry,
        merge: bool,
    ) -> Result<Self, VulkanError> {
        let plan = Plan::new(scene, merge);
        let mut upload = Upload::new(gpu);
        let parts = PartBuffers::new(&mut upload, scene, geometry, plan.parts())?;
        let records: Vec<_> = plan.records(&parts.addresses);
        let records = Buffer::with_content(&mut upload, "geometry records", bytemuck::cast_slice(&records))?;
        let (bottom, bottom_report) = blas::build(&mut upload, scene, geometry, &plan, &parts)?;
        let (top, top_ms) = tlas::build(&mut upload, scene, (&plan, &bottom), None)?;
        upload.finish()?;
        let report = AccelReport {
            instances: plan.instances.len(),
            top_bytes: top.size(),
            top_build_ms: top_ms,
            ..bottom_report
        };
        Ok(Accel { top: Some(top), bottom, parts, plan, merge, records, report })
    }

    /// Brings them up to date with an edited scene whose meshes are the same. Where none of their triangles changed its class, and none
    /// that moved is merged with others, that is the top level only.
    ///
    /// # Errors
    /// If memory is out, the scene has too many geometries, or the device is lost; they are then of no use.
    pub(crate) fn update(
        &mut self,
        gpu: &Gpu,
        scene: &CompiledScene,
        geometry: &Geometry,
        changes: SceneChanges,
    ) -> Result<(), VulkanError> {
        let plan = self.plan.again(scene, self.merge);
        if !plan.has_structures_of(&self.plan, changes.has(lumbre_scene::Part::Transforms)) {
            *self = Accel::new(gpu, scene, geometry, self.merge)?;
            return Ok(());
        }
        let mut upload = Upload::new(gpu);
        if plan.hits != self.plan.hits {
            let records = plan.records(&self.parts.addresses);
            self.records.refill(&mut upload, "geometry records", bytemuck::cast_slice(&records))?;
        }
        if changes.any(&[lumbre_scene::Part::Instances, lumbre_scene::Part::Transforms]) {
            let (top, ms) = tlas::build(&mut upload, scene, (&plan, &self.bottom), self.top.take())?;
            let (instances, top_bytes) = (plan.instances.len(), top.size());
            self.report = AccelReport { instances, top_bytes, top_build_ms: ms, ..self.report };
            self.top = Some(top);
        }
        self.plan = plan;
        upload.finish()
    }

    /// Which structures there are, and what their geometries are.
    pub(crate) fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The top-level structure.
    ///
    /// # Panics
    /// If an update failed before.
    pub(crate) fn top(&self) -> ash::vk::AccelerationStructureKHR {
        self.top.as_ref().expect("no update has failed").raw
    }
}
