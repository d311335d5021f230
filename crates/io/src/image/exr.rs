//! OpenEXR in and out, through the `exr` crate.
//!
//! Out: one part, 32-bit floats, scan lines, ZIP; the picture in bare `R`, `G`, `B` (`A`), every other layer as
//! `layer.channel`. One part, because that is what every program reads: those that know only pictures take R, G, B; Nuke,
//! tev and Blender show the dotted names as layers. A file of several parts hides all but the first from many of them.

use super::LinearImage;
use super::{exr_dwa, exr_header};
use crate::{Bound, IoError, Limits, files, guard};
use ::exr::block;
use ::exr::image::read::read;
use ::exr::image::write::WritableImage;
use ::exr::image::{
    AnyChannel, AnyChannels, Blocks, Encoding, FlatImage, FlatSamples, Image, Layer, read::image::ReadLayers,
    read::layers::ReadChannels,
};
use ::exr::meta::attribute::{AttributeValue, Chromaticities, LineOrder, Text};
use ::exr::meta::header::{Header, ImageAttributes, LayerAttributes};
use ::exr::prelude::{Compression, Vec2};
use lumbre_core::Rgb;
use std::io::{BufWriter, Cursor, Seek, Write};
use std::path::Path;

/// A named group of channels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExrLayer {
    /// Its name; empty for the picture itself.
    pub name: String,
    /// Name and `width * height` values of each channel, the top row first. `R`, `G`, `B`, `A` and `X`, `Y`, `Z` come back
    /// in that order, whatever the file's.
    pub channels: Vec<(String, Vec<f32>)>,
}

impl ExrLayer {
    /// A layer of the channels R, G, B, or X, Y, Z if `vectors`.
    pub fn rgb(name: &str, pixels: impl Iterator<Item = Rgb> + Clone, vectors: bool) -> Self {
        let names = if vectors { ["X", "Y", "Z"] } else { ["R", "G", "B"] };
        let channel = |i: usize| (names[i].to_string(), pixels.clone().map(|p| p[i]).collect());
        ExrLayer { name: name.into(), channels: (0..3).map(channel).collect() }
    }

    /// The values of a channel.
    pub fn channel(&self, name: &str) -> Option<&[f32]> {
        self.channels.iter().find(|(n, _)| n == name).map(|(_, v)| &v[..])
    }
}

/// An EXR file in memory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExrImage {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Its layers; the picture itself first, then by name.
    pub layers: Vec<ExrLayer>,
    /// Text attributes by name: sample count, seed and the like. Names are Latin letters, values Latin-1.
    pub metadata: Vec<(String, String)>,
}

/// ITU-R BT.709 primaries and D65, which OpenEXR assumes where nothing is said; here it is said.
const REC_709: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.3290),
};

/// Writes an EXR. The file appears whole or not at all, and the same image makes the same bytes.
///
/// # Errors
/// `CannotWrite`, if the file cannot be written, a channel is not as long as the size says, or a name cannot be stored.
pub fn write_exr(path: impl AsRef<Path>, image: ExrImage) -> Result<(), IoError> {
    let path = path.as_ref();
    let image = assemble(image).map_err(|why| IoError::write(path, why))?;
    files::write_atomic(path, |file| {
        let mut out = BufWriter::new(&mut *file);
        image.write().to_buffered(&mut out).map_err(|e| e.to_string())?;
        out.flush().map_err(|e| e.to_string())?;
        drop(out);
        file.rewind().map_err(|e| e.to_string())?;
        exr_header::sort_attributes(file)
    })
}

fn assemble(image: ExrImage) -> Result<Image<Layer<AnyChannels<FlatSamples>>>, String> {
    let size = Vec2(image.width as usize, image.height as usize);
    let mut list = ::exr::prelude::SmallVec::new();
    for layer in image.layers {
        for (channel, values) in layer.channels {
            let name = if layer.name.is_empty() { channel } else { format!("{}.{channel}", layer.name) };
            if values.len() != size.area() || values.is_empty() {
                let (w, h, n) = (image.width, image.height, values.len());
                return Err(format!("channel {name:?} has {n} values for {w} x {h} pixels"));
            }
            let name = text(&name, 255).ok_or_else(|| format!("{name:?} cannot name a channel"))?;
            // Depths and counts are no colours; the flag only matters to lossy compression.
            list.push(AnyChannel {
                name,
                sample_data: FlatSamples::F32(values),
                quantize_linearly: false,
                sampling: Vec2(1, 1),
            });
        }
    }
    let channels = AnyChannels::sort(list);
    if channels.list.is_empty() {
        return Err("there is no channel to write".into());
    }
    if let Some(two) = channels.list.windows(2).find(|two| two[0].name == two[1].name) {
        return Err(format!("there are two channels {}", two[0].name));
    }
    let software_name = Some(Text::from("Lumbre"));
    let mut attributes = LayerAttributes { software_name, ..LayerAttributes::default() };
    for (name, value) in image.metadata {
        let key = text(&name, 255).ok_or_else(|| format!("{name:?} cannot name an attribute"))?;
        // What Latin-1 lacks cannot be stored.
        let value: String = value.chars().map(|c| if u32::from(c) < 256 { c } else { '?' }).collect();
        let value = text(&value, usize::MAX).unwrap_or_else(|| Text::from(""));
        attributes.other.insert(key, AttributeValue::Text(value));
    }
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let mut shared = ImageAttributes::with_size(size);
    shared.chromaticities = Some(REC_709);
    Ok(Image::new(shared, Layer::new(size, attributes, encoding, channels)))
}

/// A text that OpenEXR can store.
fn text(s: &str, most: usize) -> Option<Text> {
    let fits = s.len() <= most && !s.contains('\0') && (most == usize::MAX || !s.is_empty());
    fits.then(|| Text::new_or_none(s)).flatten()
}

/// Whether a file begins like an EXR.
pub(super) fn is_exr(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01])
}

/// Reads every layer of an EXR. Halves and whole numbers become floats; of several resolutions the largest is read; parts
/// become layers named after them.
///
/// # Errors
/// `CannotOpen` if it cannot be read; `BadData` if it is damaged, too large or of a kind that is not supported (deep data,
/// subsampled channels, parts of different sizes, some compressions).
pub fn read_exr(path: impl AsRef<Path>, limits: &Limits) -> Result<ExrImage, IoError> {
    let path = path.as_ref();
    let bytes = files::read_file(path, limits.max_file_bytes)?;
    decode(path, &bytes, limits)
}

/// Decodes a whole file.
pub(super) fn decode(path: &Path, bytes: &[u8], limits: &Limits) -> Result<ExrImage, IoError> {
    let failed = |e: ::exr::error::Error| match e {
        ::exr::error::Error::NotSupported(what) => IoError::unsupported(path, "", what),
        other => IoError::data(path, "", format!("not a sound EXR: {other}")),
    };
    let image = guard::decode(path, || {
        let chunks = block::read(Cursor::new(bytes), false).map_err(failed)?;
        check_headers(path, chunks.headers(), bytes.len(), limits)?;
        exr_dwa::check(bytes, chunks.headers()).map_err(failed)?;
        let reader = read().no_deep_data().largest_resolution_level().all_channels().all_layers();
        // On this thread: a panic in one of the crate's own would end the process.
        let image: FlatImage = reader.all_attributes().non_parallel().from_chunks(chunks).map_err(failed)?;
        Ok(image)
    })?;
    Ok(disassemble(image))
}

/// Checks what the headers claim, before pixels are allocated for it.
fn check_headers(path: &Path, headers: &[Header], file: usize, limits: &Limits) -> Result<(), IoError> {
    let Some(first) = headers.first() else { return Err(IoError::data(path, "", "it has no parts")) };
    let mut bytes = 0u64;
    let mut chunks = 0u64;
    for (i, h) in headers.iter().enumerate() {
        let place = format!("part {i}");
        if h.deep {
            return Err(IoError::unsupported(path, place, "deep data"));
        }
        let size = (h.layer_size.width() as u64, h.layer_size.height() as u64);
        if h.layer_size != first.layer_size {
            return Err(IoError::unsupported(path, place, "parts of different sizes"));
        }
        if h.channels.list.iter().any(|c| c.sampling != Vec2(1, 1)) {
            return Err(IoError::unsupported(path, place, "subsampled channels"));
        }
        let channels = h.channels.list.len() as u64;
        limits.check_image(path, size, channels.saturating_mul(4))?;
        bytes = bytes.saturating_add(size.0.saturating_mul(size.1).saturating_mul(channels * 4));
        chunks = chunks.saturating_add(h.chunk_count as u64);
    }
    limits.hold(Bound::ImageBytes, path, "", bytes)?;
    // Each chunk has an entry of 8 bytes in a table and a header of 8 bytes or more.
    if chunks.saturating_mul(16) > file as u64 {
        return Err(IoError::data(path, "", format!("{chunks} chunks cannot be held by {file} bytes")));
    }
    Ok(())
}

fn disassemble(image: FlatImage) -> ExrImage {
    let parts = image.layer_data.len();
    let mut out = ExrImage::default();
    for layer in image.layer_data {
        (out.width, out.height) = (layer.size.width() as u32, layer.size.height() as u32);
        let part = layer.attributes.layer_name.as_ref().map(Text::to_string).filter(|_| parts > 1);
        let texts = image.attributes.other.iter().chain(&layer.attributes.other);
        out.metadata.extend(texts.filter_map(|(k, v)| match v {
            AttributeValue::Text(t) => Some((k.to_string(), t.to_string())),
            _ => None,
        }));
        for channel in layer.channel_data.list {
            let full = channel.name.to_string();
            let (prefix, name) = full.rsplit_once('.').unwrap_or(("", &full));
            let group: Vec<&str> =
                part.as_deref().into_iter().chain([prefix]).filter(|s| !s.is_empty()).collect();
            let group = group.join(".");
            let values = channel.sample_data.values_as_f32().collect();
            let at = out.layers.iter().position(|l| l.name == group).unwrap_or_else(|| {
                out.layers.push(ExrLayer { name: group, channels: Vec::new() });
                out.layers.len() - 1
            });
            out.layers[at].channels.push((name.to_string(), values));
        }
    }
    out.metadata.sort();
    out.metadata.dedup();
    out.layers.sort_by(|a, b| a.name.cmp(&b.name));
    for layer in &mut out.layers {
        layer.channels.sort_by_key(|(n, _)| ("RGBAXYZ".find(n.as_str()).unwrap_or(7), n.clone()));
    }
    out
}

/// The colours of one layer: its R, G, B, or X, Y, Z, or its only channel as grey. `None` is the picture itself, or where
/// there is none the first layer with colours.
pub(super) fn linear(path: &Path, image: ExrImage, layer: Option<&str>) -> Result<LinearImage, IoError> {
    let names = || image.layers.iter().map(|l| format!("{:?}", l.name)).collect::<Vec<_>>().join(", ");
    let found = match layer {
        Some(name) => image.layers.iter().find(|l| l.name == name).and_then(colors),
        None => image.layers.iter().find_map(colors),
    };
    let Some(pixels) = found else {
        let what = layer.map_or("colours".into(), |l| format!("layer {l:?} with colours"));
        return Err(IoError::data(path, "", format!("has no {what}; its layers are {}", names())));
    };
    Ok(LinearImage { width: image.width, height: image.height, pixels })
}

fn colors(layer: &ExrLayer) -> Option<Vec<Rgb>> {
    let three = |names: [&str; 3]| {
        let [a, b, c] = names.map(|n| layer.channel(n));
        let (a, b, c) = (a?, b?, c?);
        Some(a.iter().zip(b).zip(c).map(|((&a, &b), &c)| Rgb::new(a, b, c)).collect())
    };
    let grey = || match &layer.channels[..] {
        [(_, values)] => Some(values.iter().map(|&v| Rgb::splat(v)).collect()),
        _ => Some(layer.channel("Y")?.iter().map(|&v| Rgb::splat(v)).collect()),
    };
    three(["R", "G", "B"]).or_else(|| three(["X", "Y", "Z"])).or_else(grey)
}
