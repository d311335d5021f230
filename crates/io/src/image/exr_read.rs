//! OpenEXR in, through the `exr` crate, behind checks of what its headers claim.

use super::exr::{ExrImage, ExrLayer, ExrWindow};
use super::{LinearImage, exr_dwa};
use crate::{Bound, IoError, Limits, files, guard};
use ::exr::block;
use ::exr::image::read::read;
use ::exr::image::{FlatImage, FlatSamples, read::image::ReadLayers, read::layers::ReadChannels};
use ::exr::meta::attribute::{AttributeValue, IntegerBounds, Text};
use ::exr::meta::header::Header;
use ::exr::prelude::Vec2;
use lumbre_core::Rgb;
use std::io::Cursor;
use std::path::Path;

/// Whether a file begins like an EXR.
pub(super) fn is_exr(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01])
}

/// Reads every layer of an EXR. Halves become floats; of several resolutions the largest is read; parts become layers named
/// after them.
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
    let picture = image.attributes.display_window;
    for layer in image.layer_data {
        (out.width, out.height) = (layer.size.width() as u32, layer.size.height() as u32);
        out.window = window(picture, IntegerBounds::new(layer.attributes.layer_position, layer.size));
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
            if let FlatSamples::U32(values) = channel.sample_data {
                let name = if group.is_empty() { name.to_string() } else { format!("{group}.{name}") };
                out.whole.push((name, values));
                continue;
            }
            let values = channel.sample_data.values_as_f32().collect();
            push(&mut out.layers, &group, name, values);
        }
    }
    out.metadata.sort();
    out.metadata.dedup();
    sort(&mut out.layers);
    out
}

/// Where pixels lie in a picture, unless they are all of it; `None` too where the picture is empty or out of reach.
fn window(picture: IntegerBounds, data: IntegerBounds) -> Option<ExrWindow> {
    if picture == data || picture.size.area() == 0 {
        return None;
    }
    let side = |n: usize| u32::try_from(n).ok();
    let [x, y] = [(data.position.0, picture.position.0), (data.position.1, picture.position.1)];
    Some(ExrWindow {
        picture: [side(picture.size.0)?, side(picture.size.1)?],
        origin: [x.0.checked_sub(x.1)?, y.0.checked_sub(y.1)?],
    })
}

/// Whole numbers as floats, among the other channels.
fn as_floats(image: &mut ExrImage) {
    for (name, values) in std::mem::take(&mut image.whole) {
        let (group, channel) = name.rsplit_once('.').unwrap_or(("", &name));
        let values = values.into_iter().map(|v| v as f32).collect();
        push(&mut image.layers, group, channel, values);
    }
    sort(&mut image.layers);
}

fn push(layers: &mut Vec<ExrLayer>, group: &str, channel: &str, values: Vec<f32>) {
    let at = layers.iter().position(|l| l.name == group).unwrap_or_else(|| {
        layers.push(ExrLayer { name: group.into(), channels: Vec::new() });
        layers.len() - 1
    });
    layers[at].channels.push((channel.to_string(), values));
}

fn sort(layers: &mut [ExrLayer]) {
    layers.sort_by(|a, b| a.name.cmp(&b.name));
    for layer in layers {
        layer.channels.sort_by_key(|(n, _)| ("RGBAXYZ".find(n.as_str()).unwrap_or(7), n.clone()));
    }
}

/// The colours of one layer: its R, G, B, or X, Y, Z, or its only channel as grey. `None` is the picture itself, or where
/// there is none the first layer with colours.
pub(super) fn linear(path: &Path, mut image: ExrImage, layer: Option<&str>) -> Result<LinearImage, IoError> {
    as_floats(&mut image);
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
