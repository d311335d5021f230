//! Vertices and triangles of a scene on the device, in chunks of whole meshes so that no buffer is larger than a driver can give.

use crate::buffer::Buffer;
use crate::error::VulkanError;
use crate::upload::Upload;
use bytemuck::{Pod, cast_slice};
use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::geometry::{MeshRecord, Vertex, attribute};
use lumbre_shaders::layout::MeshTable;
use std::ops::Range;

/// Attributes that are part of [`Vertex`].
const IN_VERTEX: u32 = attribute::TANGENT | attribute::UV | attribute::COLOR;

/// The geometry of a scene.
pub(crate) struct Geometry {
    _buffers: Vec<Buffer>,
    tables: Vec<MeshTable>,
    /// For each mesh, the first vertex of its chunk.
    first_vertices: Vec<u32>,
    /// For each mesh, where it lies in the arrays of the scene.
    ranges: Vec<[u32; 4]>,
}

fn range(mesh: &MeshRecord) -> [u32; 4] {
    [mesh.first_triangle, mesh.triangle_count, mesh.first_vertex, mesh.vertex_count]
}

impl Geometry {
    /// Copies everything to the device, in buffers of at most `chunk` bytes if meshes are no larger.
    pub(crate) fn new(upload: &mut Upload, scene: &CompiledScene, chunk: u64) -> Result<Self, VulkanError> {
        let mut all = Geometry {
            _buffers: Vec::new(),
            tables: Vec::new(),
            first_vertices: Vec::new(),
            ranges: scene.meshes.iter().map(range).collect(),
        };
        for meshes in chunks(&scene.meshes, chunk) {
            all.add(upload, scene, &scene.meshes[meshes])?;
        }
        Ok(all)
    }

    /// Adds the meshes of a chunk.
    fn add(
        &mut self,
        upload: &mut Upload,
        scene: &CompiledScene,
        meshes: &[MeshRecord],
    ) -> Result<(), VulkanError> {
        let (first, last) = (&meshes[0], &meshes[meshes.len() - 1]);
        let vertices = first.first_vertex as usize..(last.first_vertex + last.vertex_count) as usize;
        let triangles = first.first_triangle as usize..(last.first_triangle + last.triangle_count) as usize;
        let used = meshes.iter().fold(0, |bits, m| bits | m.attributes);
        let positions = self.array(upload, "positions", &scene.positions[vertices.clone()])?;
        // Attributes that no mesh of the chunk has are not read.
        let normals = match used & attribute::NORMAL {
            0 => 0,
            _ => self.array(upload, "normals", &scene.normals[vertices.clone()])?,
        };
        let attributes = match used & IN_VERTEX {
            0 => 0,
            _ => self.array(upload, "vertices", &scene.vertices[vertices])?,
        };
        let materials =
            self.array(upload, "materials of triangles", &scene.triangle_materials[triangles.clone()])?;
        let indices = self.indices(upload, &scene.triangles[triangles], first.first_vertex)?;
        for mesh in meshes {
            let triangle = u64::from(mesh.first_triangle - first.first_triangle);
            self.first_vertices.push(first.first_vertex);
            self.tables.push(MeshTable {
                triangles: indices + triangle * size_of::<[u32; 3]>() as u64,
                triangle_materials: materials + triangle * size_of::<u32>() as u64,
                positions,
                normals,
                vertices: attributes,
                first_emissive_rank: mesh.first_emissive_rank,
                attributes: mesh.attributes,
            });
        }
        Ok(())
    }

    /// An array in a buffer of its own; its address.
    fn array<T: Pod>(&mut self, upload: &mut Upload, name: &str, content: &[T]) -> Result<u64, VulkanError> {
        let buffer = Buffer::with_content(upload, name, cast_slice(content))?;
        let address = buffer.address();
        self._buffers.push(buffer);
        Ok(address)
    }

    /// Indices of triangles, counted from the first vertex of the chunk.
    fn indices(
        &mut self,
        upload: &mut Upload,
        triangles: &[[u32; 3]],
        first_vertex: u32,
    ) -> Result<u64, VulkanError> {
        if first_vertex == 0 {
            return self.array(upload, "triangles", triangles);
        }
        let size = size_of_val(triangles) as u64;
        let buffer = Buffer::new(upload.gpu(), "triangles", size, crate::Purpose::Data)?;
        let (mut at, address) = (0, buffer.address());
        for some in triangles.chunks(1 << 20) {
            let moved: Vec<[u32; 3]> = some.iter().map(|t| t.map(|v| v - first_vertex)).collect();
            upload.write(&buffer, at, cast_slice(&moved))?;
            at += size_of_val(some) as u64;
        }
        self._buffers.push(buffer);
        Ok(address)
    }

    /// Where the data of a mesh lie.
    pub(crate) fn table(&self, mesh: u32) -> &MeshTable {
        &self.tables[mesh as usize]
    }

    /// Whether these meshes lie where those lay that were copied.
    pub(crate) fn has_ranges_of(&self, meshes: &[MeshRecord]) -> bool {
        self.ranges.iter().copied().eq(meshes.iter().map(range))
    }

    /// Takes over what of the records of meshes does not say where they lie.
    pub(crate) fn update(&mut self, meshes: &[MeshRecord]) {
        for (table, mesh) in self.tables.iter_mut().zip(meshes) {
            (table.first_emissive_rank, table.attributes) = (mesh.first_emissive_rank, mesh.attributes);
        }
    }

    pub(crate) fn tables(&self) -> &[MeshTable] {
        &self.tables
    }

    /// What the indices of a mesh count from.
    pub(crate) fn first_vertex_of_chunk(&self, mesh: u32) -> u32 {
        self.first_vertices[mesh as usize]
    }
}

/// Ranges of meshes whose largest array takes at most `limit` bytes, or that are single. Meshes lie one after another in the arrays.
fn chunks(meshes: &[MeshRecord], limit: u64) -> Vec<Range<usize>> {
    let bytes = |m: &MeshRecord| {
        (u64::from(m.vertex_count) * size_of::<Vertex>() as u64, u64::from(m.triangle_count) * 12)
    };
    let mut found: Vec<Range<usize>> = Vec::new();
    let mut sums = (0, 0);
    for (i, mesh) in meshes.iter().enumerate() {
        let (vertices, triangles) = bytes(mesh);
        let fits = sums.0 + vertices <= limit && sums.1 + triangles <= limit;
        match found.last_mut().filter(|_| fits) {
            Some(chunk) => chunk.end = i + 1,
            None => {
                found.push(i..i + 1);
                sums = (0, 0);
            }
        }
        sums = (sums.0 + vertices, sums.1 + triangles);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_are_whole_meshes() {
        let mesh = |vertex_count, triangle_count| MeshRecord {
            vertex_count,
            triangle_count,
            ..bytemuck::Zeroable::zeroed()
        };
        let meshes = [mesh(10, 5), mesh(10, 5), mesh(1, 1), mesh(1000, 5), mesh(1, 1), mesh(1, 2000)];
        let limit = 20 * size_of::<Vertex>() as u64;
        assert_eq!(chunks(&meshes, limit), [0..2, 2..3, 3..4, 4..5, 5..6]);
        assert_eq!(chunks(&meshes, u64::MAX).len(), 1);
        assert!(chunks(&[], limit).is_empty());
    }
}
