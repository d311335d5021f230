//! Buffer views compressed by meshoptimizer: `EXT_meshopt_compression` and `KHR_meshopt_compression`, which adds a second
//! version of the attribute stream and the colour filter. The streams are decoded by the `meshoptimizer-rs` crate.

use super::document::Document;
use super::json::Object;
use crate::limits::Room;
use crate::{IoError, guard};
use gltf::json::Value;
use meshoptimizer_rs::{Workspace, codec};
use rayon::prelude::*;
use std::collections::HashMap;

/// Both names; what the second adds is read under either.
const NAMES: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// Most bytes that a byte of a stream stands for. The second version of attribute streams says with two bits that 256
/// elements have the same byte; nothing else is denser.
const MOST_BYTES_PER_BYTE: usize = 1024;

/// Bytes by which a stream may be shorter than that: an attribute stream of 256-byte elements ends with two of them, the
/// others have tables.
const SLACK: usize = 1024;

/// Whether a buffer merely stands in for loaders without the extension. It is not read: often it is not there.
pub(super) fn is_stand_in(buffer: &gltf::json::Buffer) -> bool {
    let extensions = buffer.extensions.iter().flat_map(|e| NAMES.iter().filter_map(|n| e.others.get(*n)));
    extensions.filter_map(|e| e.get("fallback")).any(|v| v.as_bool() == Some(true))
}

/// One view before decoding.
struct Job<'a> {
    view: usize,
    place: String,
    source: &'a [u8],
    mode: codec::Mode,
    filter: Filter,
    count: usize,
    stride: usize,
}

/// What is done to attributes once they are decoded.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Filter {
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Color,
}

/// The decoded bytes of every compressed view, by its index; within `room`.
pub(super) fn decode_all(
    doc: &Document,
    buffers: &[impl AsRef<[u8]>],
    mut room: Room,
) -> Result<HashMap<usize, Vec<u8>>, IoError> {
    let mut jobs = Vec::new();
    for (index, view) in doc.root.buffer_views.iter().enumerate() {
        let named = NAMES.iter().find_map(|&name| Some((name, view.extensions.as_ref()?.others.get(name)?)));
        let Some((name, value)) = named else { continue };
        let job = Job::new(doc, buffers, index, (name, value))?;
        let bytes = job.count as u64 * job.stride as u64;
        room.take(doc.path, &job.place, bytes)?;
        jobs.push(job);
    }
    let decode = |job: &Job| {
        let bytes = guard::decode(doc.path, || job.decode(doc)).map_err(|e| e.at_place(&job.place))?;
        Ok((job.view, bytes))
    };
    // Results are gathered before the first error is looked for, so that it is always the same one.
    let decoded: Vec<_> = jobs.par_iter().map(decode).collect();
    decoded.into_iter().collect()
}

impl<'a> Job<'a> {
    fn new(
        doc: &Document,
        buffers: &'a [impl AsRef<[u8]>],
        view: usize,
        (name, value): (&str, &Value),
    ) -> Result<Self, IoError> {
        let place = format!("/bufferViews/{view}/extensions/{name}");
        let wrong = |key: &str, why: &str| doc.error(format!("{place}/{key}"), why);
        let json = Object::new(doc, Some(value), || place.clone())?;
        let json = json.expect("there is a value");
        let need = |key: &str| json.index(key)?.ok_or_else(|| wrong(key, "is missing"));

        let buffer = doc.item(buffers, need("buffer")?, "buffer", &|| format!("{place}/buffer"))?.as_ref();
        let start = json.index("byteOffset")?.unwrap_or(0);
        let length = need("byteLength")?;
        let source = start.checked_add(length).and_then(|end| buffer.get(start..end)).ok_or_else(|| {
            let have = buffer.len();
            doc.error(&place, format!("takes {length} bytes from byte {start} of a buffer of {have}"))
        })?;
        let mode = codec::Mode::parse(json.string("mode")?.unwrap_or_default())
            .map_err(|_| wrong("mode", "is none of ATTRIBUTES, TRIANGLES and INDICES"))?;
        let filter = match json.string("filter")?.unwrap_or("NONE") {
            "NONE" => Filter::None,
            "OCTAHEDRAL" => Filter::Octahedral,
            "QUATERNION" => Filter::Quaternion,
            "EXPONENTIAL" => Filter::Exponential,
            "COLOR" => Filter::Color,
            _ => return Err(wrong("filter", "is none of the extension's filters")),
        };
        if mode != codec::Mode::Attributes && filter != Filter::None {
            return Err(wrong("filter", "is for attributes only"));
        }
        let (count, stride) = (need("count")?, need("byteStride")?);
        // Refused before memory is taken for it.
        let most = source.len().saturating_add(SLACK).saturating_mul(MOST_BYTES_PER_BYTE);
        if count.checked_mul(stride).is_none_or(|bytes| bytes > most) {
            return Err(wrong("count", &format!("{count} elements cannot be held by {length} bytes")));
        }
        Ok(Job { view, place, source, mode, filter, count, stride })
    }

    fn decode(&self, doc: &Document) -> Result<Vec<u8>, IoError> {
        let damaged = |e| doc.error(&self.place, format!("its stream is damaged: {e}"));
        let (count, stride) = (self.count, self.stride);
        if count == 0 {
            return Ok(Vec::new());
        }
        // The size was checked; what the crate does is linear in it.
        let room = meshoptimizer_rs::Limits { max_bytes: usize::MAX, max_work: u64::MAX };
        let workspace = &mut Workspace::new(room);
        let decoder = match self.mode {
            codec::Mode::Attributes => codec::decode_vertex_buffer,
            codec::Mode::Triangles => codec::decode_index_buffer,
            codec::Mode::Indices => codec::decode_index_sequence,
        };
        let mut bytes = decoder(count, stride, self.source, workspace).map_err(damaged)?;
        let filter = match self.filter {
            Filter::None => return Ok(bytes),
            Filter::Octahedral => codec::decode_filter_oct,
            Filter::Quaternion => codec::decode_filter_quat,
            Filter::Exponential => codec::decode_filter_exp,
            Filter::Color => codec::decode_filter_color,
        };
        filter(&mut bytes, count, stride, workspace).map_err(damaged)?;
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Limits;
    use base64::Engine;
    use gltf::json::serialize;
    use serde_json::json;
    use std::path::Path;

    fn bytes(base64: &serde_json::Value) -> Vec<u8> {
        base64::engine::general_purpose::STANDARD.decode(base64.as_str().unwrap()).unwrap()
    }

    fn decode(case: &serde_json::Value, stream: &[u8]) -> Result<Vec<u8>, IoError> {
        let extension = json!({"buffer": 0, "byteLength": stream.len(), "byteStride": case["stride"],
            "mode": case["mode"], "filter": case["filter"], "count": case["count"]});
        let text = serialize::to_vec(&json!({"asset": {"version": "2.0"}, "bufferViews": [
            {"buffer": 1, "byteLength": 1, "extensions": {"EXT_meshopt_compression": extension}}]}));
        let limits = Limits::default();
        let doc = Document::parse(Path::new("a.gltf"), &text.unwrap(), &limits).unwrap();
        let mut decoded = decode_all(&doc, &[stream], Room::from(1 << 20))?;
        assert_eq!(decoded.len(), 1);
        Ok(decoded.remove(&0).unwrap())
    }

    fn cases() -> Vec<serde_json::Value> {
        serde_json::from_str(include_str!("../../tests/io/data/meshopt.json")).unwrap()
    }

    /// Streams of meshoptimizer's own encoder, and what its own decoder makes of them. That one runs on vector units, which
    /// round halves to even, so that filters may differ by one unit.
    #[test]
    fn streams_hold_what_their_own_decoder_says() {
        for case in cases() {
            let have =
                decode(&case, &bytes(&case["stream"])).unwrap_or_else(|e| panic!("{}: {e}", case["name"]));
            let want = bytes(&case["decoded"]);
            assert_eq!(have.len(), want.len(), "{}", case["name"]);
            let shorts = case["stride"] == 8;
            let numbers = |b: &[u8]| -> Vec<i32> {
                match shorts {
                    true => b.chunks_exact(2).map(|c| i16::from_le_bytes([c[0], c[1]]).into()).collect(),
                    false => b.iter().map(|&v| i32::from(v as i8)).collect(),
                }
            };
            let slack = i32::from(!matches!(case["filter"].as_str().unwrap(), "NONE" | "EXPONENTIAL"));
            for (i, (h, w)) in numbers(&have).into_iter().zip(numbers(&want)).enumerate() {
                assert!((h - w).abs() <= slack, "{}: number {i} is {h}, not {w}", case["name"]);
            }
        }
    }

    #[test]
    fn every_truncation_is_an_error() {
        for case in cases() {
            let stream = bytes(&case["stream"]);
            for n in 0..stream.len() {
                assert!(decode(&case, &stream[..n]).is_err(), "{}: {n} bytes are enough", case["name"]);
            }
        }
    }
}
