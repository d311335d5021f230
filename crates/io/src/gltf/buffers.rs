//! Buffers and the views into them.

use super::document::Document;
use super::meshopt;
use crate::resolver::Resolver;
use crate::{Bound, IoError};
use std::borrow::Cow;
use std::collections::HashMap;

/// All buffers of a scene.
pub(super) struct Buffers<'a> {
    data: Vec<Cow<'a, [u8]>>,
    /// The bytes of compressed views, by the view's index.
    decoded: HashMap<usize, Vec<u8>>,
}

/// Bytes of a buffer view.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) bytes: &'a [u8],
    /// Distance of elements, if the view says one.
    pub(super) stride: Option<usize>,
}

impl<'a> Buffers<'a> {
    /// Reads every buffer; `bin` is the binary chunk of a .glb.
    pub(super) fn load(doc: &Document, resolver: &Resolver, bin: Option<&'a [u8]>) -> Result<Self, IoError> {
        let mut room = doc.limits.room(Bound::BufferBytes);
        let mut data = Vec::with_capacity(doc.root.buffers.len());
        for (i, buffer) in doc.root.buffers.iter().enumerate() {
            if meshopt::is_stand_in(buffer) {
                data.push(Cow::Borrowed(&[][..]));
                continue;
            }
            let place = format!("/buffers/{i}");
            let bytes = match &buffer.uri {
                Some(uri) => {
                    let limit = room.min(doc.limits.room(Bound::FileBytes));
                    Cow::Owned(resolver.read(uri, &format!("{place}/uri"), limit)?.bytes)
                }
                // Only the first buffer may mean the binary chunk.
                None => Cow::Borrowed(bin.filter(|_| i == 0).ok_or_else(|| {
                    doc.error(&place, "has neither a uri nor a binary chunk to hold its bytes")
                })?),
            };
            let (want, have) = (buffer.byte_length.0, bytes.len() as u64);
            if want > have {
                return Err(doc.error(&place, format!("byteLength is {want}, but there are {have} bytes")));
            }
            room.take(doc.path, &place, have)?;
            // A file may be longer than the buffer (a .glb's chunk is padded).
            data.push(match bytes {
                Cow::Borrowed(b) => Cow::Borrowed(&b[..want as usize]),
                Cow::Owned(mut b) => {
                    b.truncate(want as usize);
                    Cow::Owned(b)
                }
            });
        }
        let decoded = meshopt::decode_all(doc, &data, room)?;
        Ok(Buffers { data, decoded })
    }

    /// The bytes of a view that `place` refers to.
    pub(super) fn view(
        &self,
        doc: &Document,
        index: usize,
        place: &dyn Fn() -> String,
    ) -> Result<View<'_>, IoError> {
        let view = doc.item(&doc.root.buffer_views, index, "buffer view", place)?;
        // 0 is not allowed; exporters that write it mean tightly packed.
        let stride = view.byte_stride.map(|s| s.0).filter(|&s| s > 0);
        if let Some(bytes) = self.decoded.get(&index) {
            return Ok(View { bytes, stride });
        }
        let here = || format!("/bufferViews/{index}");
        let buffer = doc.item(&self.data, view.buffer.value(), "buffer", &here)?;
        let start = view.byte_offset.map_or(0, |o| o.0);
        let range = start
            .checked_add(view.byte_length.0)
            .and_then(|end| Some(usize::try_from(start).ok()?..usize::try_from(end).ok()?));
        let bytes = range.and_then(|r| buffer.get(r)).ok_or_else(|| {
            let (length, have) = (view.byte_length.0, buffer.len());
            doc.error(here(), format!("takes {length} bytes from byte {start} of a buffer of {have}"))
        })?;
        Ok(View { bytes, stride })
    }
}
