//! PNG and JPEG to texels, through the `image` crate. Sizes are read and checked before anything is decoded.

use super::LinearImage;
use crate::{IoError, Limits, guard};
use ::image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader};
use lumbre_core::Rgb;
use lumbre_core::color::{srgb_decode, srgb_decode_table};
use std::io::Cursor;
use std::path::Path;

/// No PNG holds more pixels per byte: deflate reaches at most 1032:1 (RFC 1951: 258 bytes by 2 bits), 8 pixels to a byte.
/// A JPEG spends two bits on 64 pixels or more. A header that claims more than this is lying about its size.
const MAX_PIXELS_PER_BYTE: u64 = 8 * 1032;

/// Bytes of a decoded texel.
const RGBA8: u64 = 4;

/// The format, by the first bytes: names and MIME types are often wrong.
fn format(bytes: &[u8], path: &Path) -> Result<ImageFormat, IoError> {
    let named =
        |what: &str| Err(IoError::unsupported(path, "", format!("{what} images; PNG and JPEG are read")));
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => Ok(ImageFormat::Png),
        [0xff, 0xd8, ..] => Ok(ImageFormat::Jpeg),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => named("WebP"),
        [0xab, b'K', b'T', b'X', ..] => named("KTX"),
        [b'B', b'M', ..] => named("BMP"),
        [b'G', b'I', b'F', ..] => named("GIF"),
        [b'D', b'D', b'S', b' ', ..] => named("DDS"),
        _ => Err(IoError::data(path, "", "not an image of a known kind")),
    }
}

fn open<'a>(
    bytes: &'a [u8],
    path: &Path,
    limits: &Limits,
    decoded_texel: u64,
) -> Result<(impl ImageDecoder + 'a, u32, u32), IoError> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format(bytes, path)?);
    let mut inner = ::image::Limits::default();
    // Room for the decoder's own rows beside the picture.
    inner.max_alloc = Some(limits.max_image_bytes.saturating_mul(2).saturating_add(1 << 20));
    reader.limits(inner);
    let decoder = reader.into_decoder().map_err(|e| IoError::data(path, "", e))?;
    let (width, height) = decoder.dimensions();
    let texel = decoded_texel.max(u64::from(decoder.color_type().bytes_per_pixel()));
    limits.check_image(path, (width.into(), height.into()), texel)?;
    let most = (bytes.len() as u64).saturating_mul(MAX_PIXELS_PER_BYTE);
    if u64::from(width) * u64::from(height) > most {
        let why = format!("{width} x {height} pixels cannot be held by {} bytes", bytes.len());
        return Err(IoError::data(path, "", why));
    }
    Ok((decoder, width, height))
}

/// Columns and rows, from the header; checked.
pub(crate) fn dimensions(bytes: &[u8], path: &Path, limits: &Limits) -> Result<(u32, u32), IoError> {
    guard::decode(path, || open(bytes, path, limits, RGBA8).map(|(_, width, height)| (width, height)))
}

fn decode(bytes: &[u8], path: &Path, limits: &Limits, decoded_texel: u64) -> Result<DynamicImage, IoError> {
    guard::decode(path, || {
        let (decoder, ..) = open(bytes, path, limits, decoded_texel)?;
        DynamicImage::from_decoder(decoder).map_err(|e| IoError::data(path, "", e))
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
