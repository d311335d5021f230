//! Images of a scene, decoded on all cores.

use super::buffers::Buffers;
use super::document::Document;
use crate::image::ldr;
use crate::limits::Room;
use crate::resolver::Resolver;
use crate::{Bound, IoError};
use lumbre_scene::Image;
use rayon::prelude::*;
use std::borrow::Cow;
use std::path::PathBuf;

/// An image before decoding.
struct Encoded<'a> {
    name: String,
    bytes: Cow<'a, [u8]>,
    /// The image's own file, if it has one.
    file: Option<PathBuf>,
    place: String,
}

/// Reads the images with these indices, in this order.
pub(super) fn load_all(
    doc: &Document,
    buffers: &Buffers,
    resolver: &Resolver,
    indices: &[usize],
) -> Result<Vec<Image>, IoError> {
    let limits = doc.limits;
    let mut encoded = Vec::with_capacity(indices.len());
    let (mut files, mut decoded) = (limits.room(Bound::BufferBytes), limits.room(Bound::TotalImageBytes));
    for &index in indices {
        let e = fetch(doc, buffers, resolver, index, files)?;
        if let Cow::Owned(bytes) = &e.bytes {
            files.take(doc.path, &e.place, bytes.len() as u64)?;
        }
        let (width, height) = e.tell(doc, ldr::dimensions(&e.bytes, doc.path, limits))?;
        decoded.take(doc.path, &e.place, u64::from(width) * u64::from(height) * 4)?;
        encoded.push(e);
    }
    let results: Vec<Result<Image, IoError>> = encoded
        .into_par_iter()
        .map(|e| {
            let (width, height, rgba8) = e.tell(doc, ldr::decode_rgba8(&e.bytes, doc.path, limits))?;
            Ok(Image { name: e.name, width, height, rgba8 })
        })
        .collect();
    results.into_iter().collect()
}

impl Encoded<'_> {
    /// Puts the image's file and place into an error.
    fn tell<T>(&self, doc: &Document, result: Result<T, IoError>) -> Result<T, IoError> {
        result.map_err(|e| match &self.file {
            Some(file) => e.at_path(file).named_by(doc.path, &self.place),
            None => e.at_place(&self.place),
        })
    }
}

fn fetch<'a>(
    doc: &Document,
    buffers: &'a Buffers,
    resolver: &Resolver,
    index: usize,
    room: Room,
) -> Result<Encoded<'a>, IoError> {
    let json = &doc.root.images[index];
    let place = format!("/images/{index}");
    let name = json.name.clone();
    if let Some(uri) = &json.uri {
        let limit = room.min(doc.limits.room(Bound::FileBytes));
        let resolved = resolver.read(uri, &format!("{place}/uri"), limit)?;
        let file_name =
            resolved.file.as_ref().and_then(|f| f.file_name()).map(|n| n.to_string_lossy().into_owned());
        let name = name.or(file_name).unwrap_or_default();
        return Ok(Encoded { name, bytes: resolved.bytes.into(), file: resolved.file, place });
    }
    let Some(view) = json.buffer_view else {
        return Err(doc.error(&place, "has neither a uri nor a bufferView"));
    };
    let view = buffers.view(doc, view.value(), &|| format!("{place}/bufferView"))?;
    Ok(Encoded { name: name.unwrap_or_default(), bytes: view.bytes.into(), file: None, place })
}
