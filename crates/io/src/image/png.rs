//! PNG out.

use crate::{IoError, files};
use ::image::codecs::png::{CompressionType, FilterType, PngEncoder};
use ::image::{ExtendedColorType, ImageEncoder};
use std::io::{BufWriter, Write};
use std::path::Path;

/// Writes an 8-bit RGB picture whose values are already encoded as sRGB: `width * height * 3` bytes, the top row first.
/// The file appears whole or not at all.
///
/// # Errors
/// `CannotWrite`, if the file cannot be written or the bytes are not as many as the size says.
pub fn write_png(path: impl AsRef<Path>, width: u32, height: u32, rgb: &[u8]) -> Result<(), IoError> {
    let path = path.as_ref();
    let want = u64::from(width) * u64::from(height) * 3;
    if want == 0 || rgb.len() as u64 != want {
        let why = format!("{width} x {height} pixels take {want} bytes, not {}", rgb.len());
        return Err(IoError::write(path, why));
    }
    files::write_atomic(path, |file| {
        let mut out = BufWriter::new(file);
        PngEncoder::new_with_quality(&mut out, CompressionType::Default, FilterType::Adaptive)
            .write_image(rgb, width, height, ExtendedColorType::Rgb8)
            .map_err(|e| e.to_string())?;
        out.flush().map_err(|e| e.to_string())
    })
}
