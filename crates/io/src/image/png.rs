//! PNG out, through the `png` crate: that of `image` writes no sRGB chunk, without which programs guess.

use super::save::{DisplayImage, Picture};
use crate::IoError;
use std::io::Write;
use std::path::Path;

/// Writes an 8-bit RGB picture whose values are already encoded as sRGB: `width * height * 3` bytes, the top row first.
/// The file appears whole or not at all.
///
/// # Errors
/// `CannotWrite`, if the file cannot be written or the bytes are not as many as the size says.
pub fn write_png(path: impl AsRef<Path>, width: u32, height: u32, rgb: &[u8]) -> Result<(), IoError> {
    let image = DisplayImage { width, height, has_alpha: false, bytes: rgb.to_vec() };
    Picture::Png(&image).write(path)
}

/// Writes a PNG with the sRGB chunk (PNG, third edition, 11.3.2.5) and alpha where the picture has it.
pub(super) fn encode(image: &DisplayImage, out: &mut dyn Write) -> Result<(), String> {
    let mut encoder = png::Encoder::new(out, image.width, image.height);
    encoder.set_color(if image.has_alpha { png::ColorType::Rgba } else { png::ColorType::Rgb });
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_filter(png::Filter::Adaptive);
    let mut writer = encoder.write_header().map_err(|e| e.to_string())?;
    writer.write_image_data(&image.bytes).map_err(|e| e.to_string())?;
    writer.finish().map_err(|e| e.to_string())
}
