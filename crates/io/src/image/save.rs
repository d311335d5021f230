//! Pictures out: PNG, JPEG, Radiance HDR and OpenEXR, into a file in one step or to standard output.

use super::exr::ExrImage;
use super::{LinearImage, exr, png};
use crate::{IoError, files};
use ::image::codecs::hdr::HdrEncoder;
use ::image::codecs::jpeg::JpegEncoder;
use ::image::{ExtendedColorType, Rgb};
use std::fs::File;
use std::io::{self, BufWriter, Cursor, Write};
use std::path::Path;

/// A picture as a display is sent it: 8 bits a band, encoded as sRGB.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DisplayImage {
    /// Columns, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// Pixels are R, G, B, A, with alpha not multiplied into the colours; otherwise R, G, B.
    pub has_alpha: bool,
    /// `width * height` pixels, row by row, the top one first.
    pub bytes: Vec<u8>,
}

impl DisplayImage {
    fn check(&self) -> Result<(), String> {
        let (width, height) = (self.width, self.height);
        let want = u64::from(width) * u64::from(height) * if self.has_alpha { 4 } else { 3 };
        if want == 0 || self.bytes.len() as u64 != want {
            return Err(format!("{width} x {height} pixels take {want} bytes, not {}", self.bytes.len()));
        }
        Ok(())
    }
}

/// What errors call standard output.
pub const STANDARD_OUTPUT: &str = "standard output";

/// A picture and the format it is to have.
#[derive(Debug)]
pub enum Picture<'a> {
    /// PNG.
    Png(&'a DisplayImage),
    /// JPEG of a quality from 1 to 100; the picture has no alpha.
    Jpeg(&'a DisplayImage, u8),
    /// Radiance HDR, its rows run-length encoded.
    Hdr(&'a LinearImage),
    /// OpenEXR.
    Exr(ExrImage),
}

impl Picture<'_> {
    /// Writes a file, which appears whole or not at all.
    ///
    /// # Errors
    /// `CannotWrite`, if that fails or the picture makes no sense.
    pub fn write(self, path: impl AsRef<Path>) -> Result<(), IoError> {
        files::write_atomic(path.as_ref(), |file| self.fill(file))
    }

    /// Writes the file to standard output instead.
    ///
    /// # Errors
    /// As [`Picture::write`].
    pub fn write_to_stdout(self) -> Result<(), IoError> {
        let failed = |why: String| IoError::write(Path::new(STANDARD_OUTPUT), why);
        let mut bytes = Cursor::new(Vec::new());
        match self {
            Picture::Exr(image) => exr::encode(image, &mut bytes).map_err(failed)?,
            other => other.stream(&mut bytes).map_err(failed)?,
        }
        let mut out = io::stdout().lock();
        out.write_all(bytes.get_ref()).and_then(|()| out.flush()).map_err(|e| failed(e.to_string()))
    }

    fn fill(self, file: &mut File) -> Result<(), String> {
        match self {
            Picture::Exr(image) => exr::encode(image, file),
            other => {
                let mut out = BufWriter::new(file);
                other.stream(&mut out)?;
                out.flush().map_err(|e| e.to_string())
            }
        }
    }

    /// The formats that are written from beginning to end.
    fn stream(self, out: &mut dyn Write) -> Result<(), String> {
        match self {
            Picture::Png(image) => {
                image.check()?;
                png::encode(image, out)
            }
            Picture::Jpeg(image, quality) => {
                image.check()?;
                if image.has_alpha {
                    return Err("a JPEG has no alpha".into());
                }
                let size = |n: u32| u16::try_from(n).map_err(|_| "a JPEG has at most 65535 columns and rows");
                let (width, height) = (size(image.width)?.into(), size(image.height)?.into());
                let mut encoder = JpegEncoder::new_with_quality(out, quality.clamp(1, 100));
                let written = encoder.encode(&image.bytes, width, height, ExtendedColorType::Rgb8);
                written.map_err(|e| e.to_string())
            }
            Picture::Hdr(image) => {
                let (width, height) = (image.width as usize, image.height as usize);
                if image.pixels.is_empty() || image.pixels.len() != width * height {
                    return Err(format!("{width} x {height} pixels are not {}", image.pixels.len()));
                }
                let pixels: Vec<_> = image.pixels.iter().map(|p| Rgb(p.to_array())).collect();
                HdrEncoder::new(out).encode(&pixels, width, height).map_err(|e| e.to_string())
            }
            Picture::Exr(_) => Err("OpenEXR is not a stream".into()),
        }
    }
}
