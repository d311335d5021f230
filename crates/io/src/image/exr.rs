//! OpenEXR in memory, and out, through the `exr` crate; in: `exr_read.rs`.
//!
//! Out: one part, 32-bit floats, scan lines, ZIP; the picture in bare `R`, `G`, `B` (`A`), every other layer as
//! `layer.channel`. One part, because that is what every program reads: those that know only pictures take R, G, B; Nuke,
//! tev and Blender show the dotted names as layers. A file of several parts hides all but the first from many of them.
//! Channels have names of one letter, for Blender keeps only the first; and no layer may have 24 of them, for then it refuses
//! the file (`IMB_exr_begin_read`, "too many channels in one pass"). There is no bare `Z`: Nuke makes it `depth.Z`, which is
//! there already.

use super::exr_header;
use crate::{IoError, files};
use ::exr::image::write::WritableImage;
use ::exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer};
use ::exr::meta::attribute::{AttributeValue, Chromaticities, IntegerBounds, LineOrder, Text};
use ::exr::meta::header::{ImageAttributes, LayerAttributes};
use ::exr::prelude::{Compression, Vec2};
use lumbre_core::Rgb;
use std::io::{BufWriter, Read, Seek, Write};
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
    /// Where they lie, if they are not all of the picture.
    pub window: Option<ExrWindow>,
    /// Its layers; the picture itself first, then by name.
    pub layers: Vec<ExrLayer>,
    /// Channels of whole numbers by their full names, `width * height` values each.
    pub whole: Vec<(String, Vec<u32>)>,
    /// Text attributes by name: sample count, seed and the like. Names are Latin letters, values Latin-1.
    pub metadata: Vec<(String, String)>,
}

/// The place of pixels (the data window) in a picture (the display window).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExrWindow {
    /// Columns and rows of the picture.
    pub picture: [u32; 2],
    /// Column and row of the first pixel, from the picture's top left. Files by others may reach outside.
    pub origin: [i32; 2],
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
    files::write_atomic(path.as_ref(), |file| encode(image, file))
}

/// Writes an EXR into something empty that can be read again.
pub(super) fn encode(image: ExrImage, out: &mut (impl Read + Write + Seek)) -> Result<(), String> {
    let image = assemble(image)?;
    let mut buffer = BufWriter::new(&mut *out);
    image.write().to_buffered(&mut buffer).map_err(|e| e.to_string())?;
    buffer.flush().map_err(|e| e.to_string())?;
    drop(buffer);
    out.rewind().map_err(|e| e.to_string())?;
    exr_header::sort_attributes(out)
}

fn assemble(image: ExrImage) -> Result<Image<Layer<AnyChannels<FlatSamples>>>, String> {
    let size = Vec2(image.width as usize, image.height as usize);
    let mut list = ::exr::prelude::SmallVec::new();
    let mut add = |name: String, n: usize, sample_data: FlatSamples| {
        if n != size.area() || n == 0 {
            return Err(format!("channel {name:?} has {n} values for {} x {} pixels", size.0, size.1));
        }
        let name = text(&name, 255).ok_or_else(|| format!("{name:?} cannot name a channel"))?;
        // Depths and counts are no colours; the flag only matters to lossy compression.
        list.push(AnyChannel { name, sample_data, quantize_linearly: false, sampling: Vec2(1, 1) });
        Ok(())
    };
    for layer in image.layers {
        for (channel, values) in layer.channels {
            let name = if layer.name.is_empty() { channel } else { format!("{}.{channel}", layer.name) };
            add(name, values.len(), FlatSamples::F32(values))?;
        }
    }
    for (name, values) in image.whole {
        add(name, values.len(), FlatSamples::U32(values))?;
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
    if let Some(ExrWindow { picture: [width, height], origin: [x, y] }) = image.window {
        shared.display_window = IntegerBounds::from_dimensions(Vec2(width as usize, height as usize));
        attributes.layer_position = Vec2(x, y);
    }
    shared.chromaticities = Some(REC_709);
    Ok(Image::new(shared, Layer::new(size, attributes, encoding, channels)))
}

/// A text that OpenEXR can store.
fn text(s: &str, most: usize) -> Option<Text> {
    let fits = s.len() <= most && !s.contains('\0') && (most == usize::MAX || !s.is_empty());
    fits.then(|| Text::new_or_none(s)).flatten()
}
