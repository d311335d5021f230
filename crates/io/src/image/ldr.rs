//! PNG, JPEG, WebP, KTX2, BMP and TGA to texels, KTX2 by `ktx2.rs`, the others through the `image` crate. Sizes are read
//! and checked before anything is decoded.

use super::{LinearImage, ktx2};
use crate::{IoError, Limits, guard};
use ::image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, RgbaImage};
use lumbre_core::Rgb;
use lumbre_core::color::{srgb_decode, srgb_decode_table};
use std::io::Cursor;
use std::path::Path;

/// Bytes of a decoded texel.
const RGBA8: u64 = 4;

/// The formats that are read, for messages.
const READ: &str = "PNG, JPEG, WebP, KTX2, BMP and TGA are read";

/// What decodes an image.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Crate(ImageFormat),
    Ktx2,
}

/// The format, by the first bytes: names and MIME types are often wrong.
fn format(bytes: &[u8], path: &Path) -> Result<Format, IoError> {
    let named = |what: &str| Err(IoError::unsupported(path, "", format!("{what} images; {READ}")));
    Ok(Format::Crate(match bytes {
        [0x89, b'P', b'N', b'G', ..] => ImageFormat::Png,
        [0xff, 0xd8, ..] => ImageFormat::Jpeg,
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => ImageFormat::WebP,
        [0xab, b'K', b'T', b'X', ..] if ktx2::is_ktx2(bytes) => return Ok(Format::Ktx2),
        [0xab, b'K', b'T', b'X', ..] => return named("KTX (version 1)"),
        [b'B', b'M', ..] => ImageFormat::Bmp,
        [b'G', b'I', b'F', ..] => return named("GIF"),
        [b'D', b'D', b'S', b' ', ..] => return named("DDS"),
        _ if is_tga(bytes) => ImageFormat::Tga,
        _ => return Err(IoError::data(path, "", format!("not an image of a known kind; {READ}"))),
    }))
}

/// Whether a header makes sense as that of a TGA (Truevision 1991), which has no mark at its beginning.
fn is_tga(bytes: &[u8]) -> bool {
    let Some(header) = bytes.first_chunk::<18>() else { return false };
    let [_, has_map, kind, _, _, map_low, map_high, map_depth, ..] = *header;
    let side = |at: usize| u16::from_le_bytes([header[at], header[at + 1]]);
    let (depth, descriptor) = (header[16], header[17]);
    let map_fits = match (kind, has_map) {
        // Colours from a map.
        (1 | 9, 1) => (map_low, map_high) != (0, 0) && matches!(map_depth, 15 | 16 | 24 | 32) && depth <= 16,
        // Colours, or grey; a map may lie there unused.
        (2 | 10, 0 | 1) => matches!(depth, 15 | 16 | 24 | 32),
        (3 | 11, 0 | 1) => matches!(depth, 8 | 16),
        _ => false,
    };
    // The two highest bits of the descriptor are always 0, the lowest four are the bits of alpha.
    map_fits && side(12) > 0 && side(14) > 0 && descriptor & 0xc0 == 0 && descriptor & 0xf <= 8
}

/// Deflate reaches at most 1032:1 (RFC 1951: 258 bytes by 2 bits), and a PNG has up to 8 pixels to a byte. A JPEG spends
/// two bits on 64 pixels or more; runs in BMP and TGA make at most 255 pixels of two bytes.
const MOST_PIXELS_PER_BYTE: u64 = 8 * 1032;

/// WebP and ETC1S may say a plain picture of any size with the same few bytes: what is larger than a texture commonly is
/// (4096 x 4096) must have bytes to show for it, so that a handful of them does not keep the machine busy.
pub(super) fn most_pixels_of_few_bytes(bytes: usize) -> u64 {
    const ANY: u64 = 4096 * 4096;
    const PER_BYTE: u64 = 1 << 16;
    (bytes as u64).saturating_mul(PER_BYTE).max(ANY)
}

/// A header that claims more pixels than its file can hold is lying.
pub(super) fn check_density(
    path: &Path,
    (width, height): (u32, u32),
    bytes: usize,
    most: u64,
) -> Result<(), IoError> {
    if u64::from(width) * u64::from(height) <= most {
        return Ok(());
    }
    Err(IoError::data(path, "", format!("{width} x {height} pixels cannot be held by {bytes} bytes")))
}

fn open<'a>(
    bytes: &'a [u8],
    format: ImageFormat,
    path: &Path,
    limits: &Limits,
    decoded_texel: u64,
) -> Result<(impl ImageDecoder + 'a, u32, u32), IoError> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut inner = ::image::Limits::default();
    // Room for the decoder's own rows beside the picture.
    inner.max_alloc = Some(limits.max_image_bytes.saturating_mul(2).saturating_add(1 << 20));
    reader.limits(inner);
    let decoder = reader.into_decoder().map_err(|e| IoError::data(path, "", e))?;
    let (width, height) = decoder.dimensions();
    let texel = decoded_texel.max(u64::from(decoder.color_type().bytes_per_pixel()));
    limits.check_image(path, (width.into(), height.into()), texel)?;
    let most = match format {
        ImageFormat::WebP => most_pixels_of_few_bytes(bytes.len()),
        _ => (bytes.len() as u64).saturating_mul(MOST_PIXELS_PER_BYTE),
    };
    check_density(path, (width, height), bytes.len(), most)?;
    Ok((decoder, width, height))
}

/// Columns and rows, from the header; checked.
pub(crate) fn dimensions(bytes: &[u8], path: &Path, limits: &Limits) -> Result<(u32, u32), IoError> {
    guard::decode(path, || match format(bytes, path)? {
        Format::Ktx2 => ktx2::dimensions(bytes, path, limits, RGBA8),
        Format::Crate(f) => open(bytes, f, path, limits, RGBA8).map(|(_, width, height)| (width, height)),
    })
}

fn decode(bytes: &[u8], path: &Path, limits: &Limits, decoded_texel: u64) -> Result<DynamicImage, IoError> {
    guard::decode(path, || match format(bytes, path)? {
        Format::Ktx2 => {
            let (width, height, rgba8) = ktx2::decode(bytes, path, limits, decoded_texel)?;
            let image = RgbaImage::from_raw(width, height, rgba8);
            image.map(DynamicImage::from).ok_or_else(|| IoError::data(path, "", "its data is damaged"))
        }
        Format::Crate(f) => {
            let (decoder, ..) = open(bytes, f, path, limits, decoded_texel)?;
            DynamicImage::from_decoder(decoder).map_err(|e| IoError::data(path, "", e))
        }
    })
}

/// Columns, rows and texels of R, G, B, A. Grey becomes R = G = B, 16 bits become 8.
pub(crate) fn decode_rgba8(
    bytes: &[u8],
    path: &Path,
    limits: &Limits,
) -> Result<(u32, u32, Vec<u8>), IoError> {
    let rgba = decode(bytes, path, limits, RGBA8)?.into_rgba8();
    let (width, height) = rgba.dimensions();
    Ok((width, height, rgba.into_raw()))
}

/// A picture with its sRGB curve undone.
pub(crate) fn decode_linear(bytes: &[u8], path: &Path, limits: &Limits) -> Result<LinearImage, IoError> {
    let image = decode(bytes, path, limits, size_of::<Rgb>() as u64)?;
    let (width, height) = (image.width(), image.height());
    let wide = image.color().bytes_per_pixel() / image.color().channel_count() > 1;
    let pixels = if wide {
        let one = |v: u16| srgb_decode(f32::from(v) / 65535.0);
        image.into_rgb16().pixels().map(|p| Rgb::from_array(p.0.map(one))).collect()
    } else {
        let table = srgb_decode_table();
        image.into_rgb8().pixels().map(|p| Rgb::from_array(p.0.map(|v| table[v as usize]))).collect()
    };
    Ok(LinearImage { width, height, pixels })
}
