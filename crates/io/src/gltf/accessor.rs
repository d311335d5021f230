//! Accessors to vectors of numbers. Nothing is allocated for a count that the buffer's bytes do not bear out.

use super::buffers::{Buffers, View};
use super::document::Document;
use crate::{Bound, IoError};
use gltf::json::accessor::{ComponentType, Type, sparse::Sparse};
use gltf::json::mesh::Primitive as JsonPrimitive;
use gltf::json::validation::Checked;

/// Reads accessors of one document.
pub(super) struct Accessors<'a> {
    pub(super) doc: &'a Document<'a>,
    pub(super) buffers: &'a Buffers<'a>,
}

/// Elements somewhere in bytes, bounds checked.
#[derive(Clone, Copy)]
pub(super) struct Elements<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) stride: usize,
    pub(super) count: usize,
    pub(super) component: ComponentType,
    pub(super) lanes: usize,
    pub(super) normalized: bool,
}

impl Elements<'_> {
    /// Lane `lane` of element `i` as a float, normalised as the accessor says (glTF 2.0, 3.6.2.2).
    fn float(&self, i: usize, lane: usize) -> f32 {
        let b = &self.bytes[i * self.stride + lane * self.component.size()..];
        let n = self.normalized;
        match self.component {
            ComponentType::F32 => f32::from_le_bytes([b[0], b[1], b[2], b[3]]),
            ComponentType::U8 => f32::from(b[0]) / if n { 255.0 } else { 1.0 },
            ComponentType::U16 => f32::from(u16::from_le_bytes([b[0], b[1]])) / if n { 65535.0 } else { 1.0 },
            ComponentType::I8 if n => (f32::from(b[0] as i8) / 127.0).max(-1.0),
            ComponentType::I8 => f32::from(b[0] as i8),
            ComponentType::I16 if n => (f32::from(i16::from_le_bytes([b[0], b[1]])) / 32767.0).max(-1.0),
            ComponentType::I16 => f32::from(i16::from_le_bytes([b[0], b[1]])),
            ComponentType::U32 => u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as f32,
        }
    }

    /// Element `i` of a list of whole numbers.
    fn integer(&self, i: usize) -> u32 {
        let b = &self.bytes[i * self.stride..];
        match self.component {
            ComponentType::U8 => u32::from(b[0]),
            ComponentType::U16 => u32::from(u16::from_le_bytes([b[0], b[1]])),
            _ => u32::from_le_bytes([b[0], b[1], b[2], b[3]]),
        }
    }

    /// Element `i`; lanes that the accessor lacks are 1 (the alpha of colours without one).
    pub(super) fn vector<const N: usize>(&self, i: usize) -> [f32; N] {
        std::array::from_fn(|lane| if lane < self.lanes { self.float(i, lane) } else { 1.0 })
    }
}

/// The form of an accessor, from the JSON alone.
struct Form {
    count: usize,
    component: ComponentType,
    lanes: usize,
    normalized: bool,
}

impl<'a> Accessors<'a> {
    fn accessor(
        &self,
        index: usize,
        place: &dyn Fn() -> String,
    ) -> Result<&'a gltf::json::Accessor, IoError> {
        self.doc.item(&self.doc.root.accessors, index, "accessor", place)
    }

    /// How many elements an accessor claims; check it against a limit before believing it.
    pub(super) fn count(&self, index: usize, place: &dyn Fn() -> String) -> Result<u64, IoError> {
        Ok(self.accessor(index, place)?.count.0)
    }

    /// Whether an accessor's whole numbers stand for 0 to 1 or -1 to 1.
    pub(super) fn normalized(&self, index: usize, place: &dyn Fn() -> String) -> Result<bool, IoError> {
        Ok(self.accessor(index, place)?.normalized)
    }

    /// Checks that the buffer's bytes bear out the count of an accessor of three lanes, and returns it.
    pub(super) fn checked_count(&self, index: usize, place: &dyn Fn() -> String) -> Result<usize, IoError> {
        let form = self.form(index, &[3], place)?;
        self.elements(index, &form)?;
        Ok(form.count)
    }

    /// Whether an accessor has bytes of its own. (Those of compressed meshes do not.)
    pub(super) fn has_data(&self, index: usize) -> bool {
        self.doc.root.accessors.get(index).is_some_and(|a| a.buffer_view.is_some() || a.sparse.is_some())
    }

    fn form(&self, index: usize, lanes: &[usize], place: &dyn Fn() -> String) -> Result<Form, IoError> {
        let accessor = self.accessor(index, place)?;
        let here = format!("/accessors/{index}");
        let Checked::Valid(component) = &accessor.component_type else {
            return Err(self.doc.error(here + "/componentType", "is none of glTF's component types"));
        };
        let have = match accessor.type_ {
            Checked::Valid(Type::Scalar) => 1,
            Checked::Valid(Type::Vec2) => 2,
            Checked::Valid(Type::Vec3) => 3,
            Checked::Valid(Type::Vec4) => 4,
            _ => 0,
        };
        if !lanes.contains(&have) {
            let why = format!("has a type that does not fit its use at {}", place());
            return Err(self.doc.error(here + "/type", why));
        }
        let count = usize::try_from(accessor.count.0)
            .map_err(|_| self.doc.error(here.clone() + "/count", "is too large"))?;
        Ok(Form { count, component: component.0, lanes: have, normalized: accessor.normalized })
    }

    /// `None`: the accessor has no view, its elements are zeros.
    fn elements(&self, index: usize, form: &Form) -> Result<Option<Elements<'a>>, IoError> {
        let accessor = &self.doc.root.accessors[index];
        let Some(view) = accessor.buffer_view else {
            let here = format!("/accessors/{index}/count");
            self.doc.limits.hold(Bound::ZeroFilled, self.doc.path, &here, form.count as u64)?;
            return Ok(None);
        };
        let place = || format!("/accessors/{index}/bufferView");
        let view = self.buffers.view(self.doc, view.value(), &place)?;
        let start = accessor.byte_offset.map_or(0, |o| o.0);
        self.slice(view, start, form, &|| format!("/accessors/{index}")).map(Some)
    }

    fn slice(
        &self,
        view: View<'a>,
        start: u64,
        form: &Form,
        place: &dyn Fn() -> String,
    ) -> Result<Elements<'a>, IoError> {
        let size = form.component.size() * form.lanes;
        let stride = view.stride.unwrap_or(size);
        if stride < size {
            return Err(self
                .doc
                .error(place(), format!("elements of {size} bytes lie {stride} bytes apart")));
        }
        let need = match form.count.checked_sub(1) {
            None => Some(0),
            Some(steps) => steps.checked_mul(stride).and_then(|n| n.checked_add(size)),
        };
        let bytes = usize::try_from(start)
            .ok()
            .and_then(|s| Some(s..s.checked_add(need?)?))
            .and_then(|range| view.bytes.get(range));
        let bytes = bytes.ok_or_else(|| {
            let (count, have) = (form.count, view.bytes.len());
            let why = format!(
                "{count} elements of {size} bytes, {stride} bytes apart from byte {start}, do not fit into a \
                 buffer view of {have} bytes"
            );
            self.doc.error(place(), why)
        })?;
        let Form { count, component, lanes, normalized } = *form;
        Ok(Elements { bytes, stride, count, component, lanes, normalized })
    }

    /// True if any attribute of the primitive is sparse.
    pub(super) fn has_sparse(&self, primitive: &JsonPrimitive) -> bool {
        let accessors = &self.doc.root.accessors;
        primitive.attributes.values().any(|a| accessors.get(a.value()).is_some_and(|a| a.sparse.is_some()))
    }

    /// The elements as vectors of floats: all of them, or those that `select` lists (each below the count). The accessor
    /// must have one of `lanes` lanes.
    pub(super) fn floats<const N: usize>(
        &self,
        index: usize,
        lanes: &[usize],
        select: Option<&[u32]>,
        place: &dyn Fn() -> String,
    ) -> Result<Vec<[f32; N]>, IoError> {
        let form = self.form(index, lanes, place)?;
        let elements = self.elements(index, &form)?;
        let sparse = self.doc.root.accessors[index].sparse.as_ref();
        if let (Some(e), Some(select), None) = (&elements, select, sparse) {
            return Ok(select.iter().map(|&i| e.vector(i as usize)).collect());
        }
        let mut out: Vec<[f32; N]> = match elements {
            Some(e) => (0..e.count).map(|i| e.vector(i)).collect(),
            None => vec![[0.0; N]; form.count],
        };
        if let Some(sparse) = sparse {
            self.patch(index, sparse, &form, |at, values, i| out[at] = values.vector(i))?;
        }
        Ok(match select {
            Some(select) => select.iter().map(|&i| out[i as usize]).collect(),
            None => out,
        })
    }

    /// The elements as whole numbers.
    pub(super) fn integers(&self, index: usize, place: &dyn Fn() -> String) -> Result<Vec<u32>, IoError> {
        let form = self.form(index, &[1], place)?;
        if !matches!(form.component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32) {
            let here = format!("/accessors/{index}/componentType");
            return Err(self.doc.error(here, "indices must be unsigned whole numbers"));
        }
        let mut out = match self.elements(index, &form)? {
            Some(e) => (0..e.count).map(|i| e.integer(i)).collect(),
            None => vec![0; form.count],
        };
        if let Some(sparse) = self.doc.root.accessors[index].sparse.as_ref() {
            self.patch(index, sparse, &form, |at, values, i| out[at] = values.integer(i))?;
        }
        Ok(out)
    }

    /// Calls `set(element, values, i)` for each element that a sparse accessor replaces (glTF 2.0, 3.6.2.3).
    fn patch(
        &self,
        index: usize,
        sparse: &Sparse,
        form: &Form,
        mut set: impl FnMut(usize, &Elements, usize),
    ) -> Result<(), IoError> {
        let here = format!("/accessors/{index}/sparse");
        let count = usize::try_from(sparse.count.0).ok().filter(|&c| c <= form.count).ok_or_else(|| {
            self.doc.error(format!("{here}/count"), "replaces more elements than there are")
        })?;
        let Checked::Valid(component) = &sparse.indices.component_type else {
            return Err(self.doc.error(format!("{here}/indices/componentType"), "must be an unsigned type"));
        };
        let part = |name: &str, view: usize, offset: u64, form: &Form| {
            let place = || format!("{here}/{name}");
            self.slice(self.buffers.view(self.doc, view, &place)?, offset, form, &place)
        };
        let form_i = Form { count, component: component.0, lanes: 1, normalized: false };
        let form_v = Form { count, ..*form };
        let (i, v) = (&sparse.indices, &sparse.values);
        let indices = part("indices", i.buffer_view.value(), i.byte_offset.0, &form_i)?;
        let values = part("values", v.buffer_view.value(), v.byte_offset.0, &form_v)?;
        for k in 0..count {
            let at = indices.integer(k) as usize;
            if at >= form.count {
                let why = format!("index {at}, but there are {} elements", form.count);
                return Err(self.doc.error(format!("{here}/indices"), why));
            }
            set(at, &values, k);
        }
        Ok(())
    }
}
