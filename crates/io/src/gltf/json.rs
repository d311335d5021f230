//! Values of extensions, read from raw JSON with their place for messages.

use super::document::Document;
use crate::IoError;
use crate::warnings::Warnings;
use gltf::json::Value;
use lumbre_core::Rgb;

/// An extension's object, or any object inside it.
#[derive(Clone)]
pub(super) struct Object<'a> {
    doc: &'a Document<'a>,
    value: &'a Value,
    place: String,
}

impl<'a> Object<'a> {
    /// `value` must be an object; `None` in, `None` out.
    pub(super) fn new(
        doc: &'a Document<'a>,
        value: Option<&'a Value>,
        place: impl FnOnce() -> String,
    ) -> Result<Option<Self>, IoError> {
        let Some(value) = value else { return Ok(None) };
        let object = Object { doc, value, place: place() };
        if value.is_object() { Ok(Some(object)) } else { Err(object.wrong("an object")) }
    }

    /// Where it stands.
    pub(super) fn place(&self) -> &str {
        &self.place
    }

    fn wrong(&self, expected: &str) -> IoError {
        self.doc.error(&self.place, format!("should be {expected}"))
    }

    /// An error about what stands under `key`.
    pub(super) fn error(&self, key: &str, why: impl std::fmt::Display) -> IoError {
        self.doc.error(format!("{}/{key}", self.place), why)
    }

    fn child(&self, key: &str) -> Option<Object<'a>> {
        let value = self.value.get(key)?;
        Some(Object { doc: self.doc, value, place: format!("{}/{key}", self.place) })
    }

    /// The raw value under `key`.
    pub(super) fn value(&self, key: &str) -> Option<&'a Value> {
        self.value.get(key)
    }

    /// Warns of each key that is none of `known`.
    pub(super) fn warn_of_others(&self, known: &[&str], warnings: &mut Warnings) {
        let keys = self.value.as_object().into_iter().flat_map(|map| map.keys());
        for key in keys.filter(|key| !known.contains(&key.as_str())) {
            warnings.add(&self.place, format!("the key {key:?} is not known and is ignored"));
        }
    }

    /// The object under `key`.
    pub(super) fn object(&self, key: &str) -> Result<Option<Object<'a>>, IoError> {
        Object::new(self.doc, self.value.get(key), || format!("{}/{key}", self.place))
    }

    /// The objects in the list under `key`; none if it is absent.
    pub(super) fn objects(&self, key: &str) -> Result<Vec<Object<'a>>, IoError> {
        let Some(child) = self.child(key) else { return Ok(Vec::new()) };
        let list = child.value.as_array().ok_or_else(|| child.wrong("a list"))?;
        let one = |(i, value)| {
            let o = Object { doc: self.doc, value, place: format!("{}/{i}", child.place) };
            if value.is_object() { Ok(o) } else { Err(o.wrong("an object")) }
        };
        list.iter().enumerate().map(one).collect()
    }

    /// The string under `key`.
    pub(super) fn string(&self, key: &str) -> Result<Option<&'a str>, IoError> {
        let Some(child) = self.child(key) else { return Ok(None) };
        child.value.as_str().map(Some).ok_or_else(|| child.wrong("a string"))
    }

    /// The truth value under `key`, or the default.
    pub(super) fn truth(&self, key: &str, default: bool) -> Result<bool, IoError> {
        let Some(child) = self.child(key) else { return Ok(default) };
        child.value.as_bool().ok_or_else(|| child.wrong("true or false"))
    }

    /// The index under `key`.
    pub(super) fn index(&self, key: &str) -> Result<Option<usize>, IoError> {
        let Some(child) = self.child(key) else { return Ok(None) };
        let index = child.value.as_u64().and_then(|v| u32::try_from(v).ok());
        index.map(|v| Some(v as usize)).ok_or_else(|| child.wrong("a small whole number"))
    }

    /// The indices in the list under `key`; none if it is absent.
    pub(super) fn indices(&self, key: &str) -> Result<Vec<usize>, IoError> {
        let Some(child) = self.child(key) else { return Ok(Vec::new()) };
        let index = |v: &Value| v.as_u64().and_then(|v| u32::try_from(v).ok()).map(|v| v as usize);
        let list = child.value.as_array().and_then(|l| l.iter().map(index).collect());
        list.ok_or_else(|| child.wrong("a list of small whole numbers"))
    }

    /// The finite number under `key`, or the default.
    pub(super) fn number(&self, key: &str, default: f32) -> Result<f32, IoError> {
        self.child(key).map_or(Ok(default), |c| c.finite())
    }

    fn finite(&self) -> Result<f32, IoError> {
        let number = self.value.as_f64().map(|v| v as f32).filter(|v| v.is_finite());
        number.ok_or_else(|| self.wrong("a finite number"))
    }

    /// The `N` finite numbers under `key`, or the default.
    pub(super) fn numbers<const N: usize>(&self, key: &str, default: [f32; N]) -> Result<[f32; N], IoError> {
        let Some(child) = self.child(key) else { return Ok(default) };
        let list = child.value.as_array().filter(|l| l.len() == N);
        let list = list.ok_or_else(|| child.wrong(&format!("a list of {N} numbers")))?;
        let mut out = default;
        for (i, (slot, value)) in out.iter_mut().zip(list).enumerate() {
            *slot = Object { doc: self.doc, value, place: format!("{}/{i}", child.place) }.finite()?;
        }
        Ok(out)
    }

    /// The colour under `key`, or the default.
    pub(super) fn color(&self, key: &str, default: Rgb) -> Result<Rgb, IoError> {
        self.numbers(key, default.to_array()).map(Rgb::from_array)
    }
}
