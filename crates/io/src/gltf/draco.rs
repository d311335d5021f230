//! Primitives compressed by Draco (`KHR_draco_mesh_compression`), decoded by the `draco-core` crate.

use super::accessor::{Accessors, Elements};
use super::json::Object;
use crate::{IoError, guard};
use draco_core::draco_types::DataType;
use draco_core::geometry_indices::PointIndex;
use draco_core::{DecodeLimits, DecoderBuffer, MeshDecoder, PointAttribute};
use gltf::json::accessor::ComponentType;
use gltf::json::mesh::{Mode, Semantic};

const NAME: &str = "KHR_draco_mesh_compression";

/// A decoded primitive.
pub(super) struct DracoMesh<'a> {
    mesh: draco_core::Mesh,
    /// The number that the stream gives to each attribute, by glTF's name for it.
    ids: Object<'a>,
}

/// What the accessors of a primitive claim, checked against the limits by who made it.
pub(super) struct Claims {
    pub(super) vertices: u64,
    pub(super) corners: u64,
    pub(super) mode: Mode,
}

/// Whether a primitive is compressed.
pub(super) fn is_used(json: &gltf::json::mesh::Primitive) -> bool {
    json.extensions.as_ref().is_some_and(|e| e.others.contains_key(NAME))
}

impl<'a> DracoMesh<'a> {
    /// Decodes the primitive that stands at `place`, if it is compressed. It must hold what its accessors claim, which
    /// bounds the memory it takes.
    pub(super) fn load(
        accessors: &Accessors<'a>,
        json: &'a gltf::json::mesh::Primitive,
        place: &str,
        claims: &Claims,
    ) -> Result<Option<Self>, IoError> {
        let doc = accessors.doc;
        let place = format!("{place}/extensions/{NAME}");
        let value = json.extensions.as_ref().and_then(|e| e.others.get(NAME));
        let Some(json) = Object::new(doc, value, || place.clone())? else { return Ok(None) };
        let missing = |key: &str| doc.error(format!("{place}/{key}"), "is missing");
        let view = json.index("bufferView")?.ok_or_else(|| missing("bufferView"))?;
        let ids = json.object("attributes")?.ok_or_else(|| missing("attributes"))?;
        let source = accessors.buffers.view(doc, view, &|| format!("{place}/bufferView"))?.bytes;

        // A strip of n corners has at most n - 2 triangles; the stream always lists triangles.
        let faces = match claims.mode {
            Mode::TriangleStrip => claims.corners.saturating_sub(2),
            _ => claims.corners / 3,
        };
        let limits = DecodeLimits::default()
            .with_max_points(claims.vertices)
            .with_max_faces(faces)
            .with_max_decoded_bytes(doc.limits.max_buffer_bytes);
        let mut mesh = draco_core::Mesh::new();
        guard::decode(doc.path, || {
            MeshDecoder::new()
                .decode(&mut DecoderBuffer::new(source).with_limits(limits), &mut mesh)
                .map_err(|e| doc.error(&place, format!("its stream is damaged: {e}")))
        })
        .map_err(|e| e.at_place(&place))?;

        let (points, triangles) = (mesh.num_points() as u64, mesh.num_faces() as u64);
        let exact = claims.mode != Mode::TriangleStrip;
        if points != claims.vertices || triangles > faces || (exact && triangles != faces) {
            let why = format!(
                "holds {points} vertices and {triangles} triangles, but the accessors say {} and {faces}",
                claims.vertices
            );
            return Err(doc.error(&place, why));
        }
        Ok(Some(DracoMesh { mesh, ids }))
    }

    /// The vertices of every triangle; not yet checked against their number.
    pub(super) fn corners(&self) -> Vec<u32> {
        self.mesh.faces().iter().flat_map(|face| face.map(|point| point.0)).collect()
    }

    fn attribute(&self, semantic: &Semantic) -> Result<Option<&PointAttribute>, IoError> {
        let Some(id) = self.ids.index(&semantic.to_string())? else { return Ok(None) };
        let found = self.mesh.attribute_by_unique_id(id as u32);
        let missing = || self.ids.error(&semantic.to_string(), format!("the stream has no attribute {id}"));
        found.map(Some).ok_or_else(missing)
    }

    /// An attribute of the vertices in `select`, or of all: `None` if it is not in the stream. Its values are whole
    /// numbers that stand for 0 to 1 or -1 to 1 if `normalized`, which the accessor says.
    pub(super) fn floats<const N: usize>(
        &self,
        semantic: &Semantic,
        normalized: bool,
        lanes: &[usize],
        select: Option<&[u32]>,
    ) -> Result<Option<Vec<[f32; N]>>, IoError> {
        let Some(attribute) = self.attribute(semantic)? else { return Ok(None) };
        let wrong = |why: &str| self.ids.error(&semantic.to_string(), why.to_owned());
        let component = match attribute.data_type() {
            DataType::Int8 => ComponentType::I8,
            DataType::Uint8 => ComponentType::U8,
            DataType::Int16 => ComponentType::I16,
            DataType::Uint16 => ComponentType::U16,
            DataType::Uint32 => ComponentType::U32,
            DataType::Float32 => ComponentType::F32,
            _ => return Err(wrong("the stream has it in a type that glTF does not have")),
        };
        let width = usize::from(attribute.num_components());
        if !lanes.contains(&width) {
            return Err(wrong(&format!("the stream has {width} numbers for each vertex")));
        }
        let bytes = attribute.buffer().data();
        let stride = usize::try_from(attribute.byte_stride()).unwrap_or(0);
        let size = component.size() * width;
        let count = if stride < size { 0 } else { (bytes.len() + stride - size) / stride };
        let elements = Elements { bytes, stride, count, component, lanes: width, normalized };
        let one = |point: u32| {
            let value = attribute.mapped_index(PointIndex(point)).0 as usize;
            (value < count).then(|| elements.vector(value))
        };
        let values: Option<Vec<[f32; N]>> = match select {
            Some(select) => select.iter().map(|&point| one(point)).collect(),
            None => (0..self.mesh.num_points() as u32).map(one).collect(),
        };
        values.map(Some).ok_or_else(|| wrong("the stream has no value for some vertices"))
    }
}
