//! KTX2 textures (Khronos Group, KTX file format specification 2.0): the largest image of a two-dimensional texture.
//! What `KHR_texture_basisu` allows is decoded by the `basisu` crate: ETC1S with its own entropy coding, UASTC plain or
//! squeezed by Zstandard or zlib. Uncompressed texels of 8 bits are read as well. The header is read here: the
//! `ktx2` crate panics on some descriptors, and `basisu` does not know zlib.
//!
//! Whether the numbers are sRGB is left out: in glTF, the use of a texture says it.

use super::ldr::{check_density, most_pixels_of_few_bytes};
use crate::{IoError, Limits};
use basisu::{DecodeFlags, SourceFormat, TargetFormat, Transcoder};
use std::borrow::Cow;
use std::io::Read;
use std::ops::Range;
use std::path::Path;

/// Bytes of the header, and of an entry of the index of levels after it, the largest one first.
const HEADER: usize = 80;
const LEVEL: usize = 24;

/// What a Zstandard frame may keep of what came before, beyond twice the size of the image: encoders that do not know
/// the size choose a window by their level.
const LEAST_WINDOW: u64 = 16 << 20;

/// How the images of a file are squeezed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Squeeze {
    None,
    BasisLz,
    Zstandard,
    Zlib,
}

/// A file whose header makes sense.
struct Texture<'a> {
    bytes: &'a [u8],
    /// Vulkan's number; 0 for Basis.
    format: u32,
    width: u32,
    height: u32,
    squeeze: Squeeze,
    /// Describes the format.
    descriptor: &'a [u8],
    /// The largest image, squeezed.
    level: &'a [u8],
}

/// Whether these are the first bytes of a KTX2 file.
pub(super) fn is_ktx2(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xabKTX 20\xbb\r\n\x1a\n")
}

/// Columns and rows, from the header; checked.
pub(super) fn dimensions(
    bytes: &[u8],
    path: &Path,
    limits: &Limits,
    decoded_texel: u64,
) -> Result<(u32, u32), IoError> {
    let texture = Texture::open(bytes, path, limits, decoded_texel)?;
    Ok((texture.width, texture.height))
}

/// Columns, rows and texels of R, G, B, A.
pub(super) fn decode(
    bytes: &[u8],
    path: &Path,
    limits: &Limits,
    decoded_texel: u64,
) -> Result<(u32, u32, Vec<u8>), IoError> {
    let texture = Texture::open(bytes, path, limits, decoded_texel)?;
    let rgba8 = if texture.format == 0 { texture.basis(path)? } else { texture.plain(path)? };
    Ok((texture.width, texture.height, rgba8))
}

fn u32_at(bytes: &[u8; HEADER + LEVEL], at: usize) -> u32 {
    u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

fn u64_at(bytes: &[u8; HEADER + LEVEL], at: usize) -> u64 {
    u64::from(u32_at(bytes, at)) | u64::from(u32_at(bytes, at + 4)) << 32
}

/// So many bytes from there.
fn range(start: u64, length: u64) -> Option<Range<usize>> {
    Some(usize::try_from(start).ok()?..usize::try_from(start.checked_add(length)?).ok()?)
}

impl<'a> Texture<'a> {
    fn open(bytes: &'a [u8], path: &Path, limits: &Limits, decoded_texel: u64) -> Result<Self, IoError> {
        let short = || IoError::data(path, "", "the KTX2 file ends before what its header says");
        let head = bytes.first_chunk().ok_or_else(short)?;
        let part =
            |start: u64, length: u64| range(start, length).and_then(|r| bytes.get(r)).ok_or_else(short);
        let [format, _, width, height, depth, layers, faces, _, squeeze, descriptor, length] =
            [12, 16, 20, 24, 28, 32, 36, 40, 44, 48, 52].map(|at| u32_at(head, at));
        if height == 0 || depth > 0 || layers > 0 || faces != 1 {
            let what = "KTX2 textures other than one two-dimensional image (lines, volumes, arrays, cubes)";
            return Err(IoError::unsupported(path, "", what));
        }
        limits.check_image(path, (width.into(), height.into()), decoded_texel)?;
        let squeeze = match squeeze {
            0 => Squeeze::None,
            1 => Squeeze::BasisLz,
            2 => Squeeze::Zstandard,
            3 => Squeeze::Zlib,
            _ => return Err(IoError::unsupported(path, "", "this KTX2's kind of supercompression")),
        };
        // Of all others, the size of the image is known exactly.
        if squeeze == Squeeze::BasisLz {
            check_density(path, (width, height), bytes.len(), most_pixels_of_few_bytes(bytes.len()))?;
        }
        let descriptor = part(descriptor.into(), length.into())?;
        let level = part(u64_at(head, HEADER), u64_at(head, HEADER + 8))?;
        Ok(Texture { bytes, format, width, height, squeeze, descriptor, level })
    }

    /// The bytes of the image, which must be `want`.
    fn image(&self, want: u64, path: &Path) -> Result<Cow<'a, [u8]>, IoError> {
        let wrong = |e: String| IoError::data(path, "", format!("its data is damaged: {e}"));
        let room = usize::try_from(want).map_err(|_| wrong("it is too large".into()))?;
        let bytes = match self.squeeze {
            Squeeze::None => Cow::Borrowed(self.level),
            Squeeze::Zstandard => {
                let window = want.saturating_mul(2).max(LEAST_WINDOW);
                let mut out = Vec::new();
                ruzstd::decoding::StreamingDecoder::new_with_max_window_size(self.level, window)
                    .map_err(|e| wrong(e.to_string()))?
                    .take(want.saturating_add(1))
                    .read_to_end(&mut out)
                    .map_err(|e| wrong(e.to_string()))?;
                Cow::Owned(out)
            }
            Squeeze::Zlib => Cow::Owned(
                miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(self.level, room)
                    .map_err(|e| wrong(e.to_string()))?,
            ),
            Squeeze::BasisLz => return Err(wrong("BasisLZ is for Basis textures only".into())),
        };
        if bytes.len() != room {
            let have = bytes.len();
            return Err(wrong(format!("the image takes {want} bytes, but there are {have}")));
        }
        Ok(bytes)
    }

    /// Uncompressed texels. Channels that a format lacks are 0, alpha 1, as for every reader of such a format.
    fn plain(&self, path: &Path) -> Result<Vec<u8>, IoError> {
        // Where the red, green, blue and alpha of a texel stand in it, if they do; each format plain and sRGB.
        let channels: &[usize] = match self.format {
            // R8, R8G8, R8G8B8, B8G8R8, R8G8B8A8, B8G8R8A8.
            9 | 15 => &[0],
            16 | 22 => &[0, 1],
            23 | 29 => &[0, 1, 2],
            30 | 36 => &[2, 1, 0],
            37 | 43 => &[0, 1, 2, 3],
            44 | 50 => &[2, 1, 0, 3],
            other => {
                let what = format!("KTX2 texels of the Vulkan format {other}; Basis and 8-bit ones are read");
                return Err(IoError::unsupported(path, "", what));
            }
        };
        let texels = u64::from(self.width) * u64::from(self.height);
        let bytes = self.image(texels * channels.len() as u64, path)?;
        let mut rgba8 = Vec::with_capacity(bytes.len() / channels.len() * 4);
        for texel in bytes.chunks_exact(channels.len()) {
            let mut out = [0, 0, 0, 255];
            for (to, &from) in out.iter_mut().zip(channels) {
                *to = texel[from];
            }
            rgba8.extend(out);
        }
        Ok(rgba8)
    }

    /// ETC1S and UASTC.
    fn basis(&self, path: &Path) -> Result<Vec<u8>, IoError> {
        let file = match self.squeeze {
            Squeeze::BasisLz => Cow::Borrowed(self.bytes),
            _ => Cow::Owned(self.unsqueezed(path)?),
        };
        // Its errors say no more than that.
        let wrong = |_| IoError::data(path, "", "its Basis data is damaged or of an unknown kind");
        let transcoder = Transcoder::new(&file).map_err(wrong)?;
        if !matches!(transcoder.source_format(), SourceFormat::Etc1s | SourceFormat::UastcLdr) {
            return Err(IoError::unsupported(path, "", "Basis data other than ETC1S and UASTC"));
        }
        if transcoder.is_video() {
            return Err(IoError::unsupported(path, "", "a KTX2 video"));
        }
        transcoder.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE).map_err(wrong)
    }

    /// The same texture with one level that is not squeezed (KTX 2.0, 3: header, index of levels, descriptor of the
    /// format, image), so that the size of what is inflated is bounded here.
    fn unsqueezed(&self, path: &Path) -> Result<Vec<u8>, IoError> {
        const IMAGE_ALIGNMENT: usize = 16;
        // UASTC: 16 bytes for each block of 4 x 4 texels.
        let blocks = u64::from(self.width.div_ceil(4)) * u64::from(self.height.div_ceil(4));
        let image = self.image(blocks * 16, path)?;
        let descriptor = self.descriptor;
        let start = (HEADER + LEVEL + descriptor.len()).next_multiple_of(IMAGE_ALIGNMENT);
        let mut out = Vec::with_capacity(start + image.len());
        out.extend(&self.bytes[..40]);
        // One level, not squeezed; where the descriptor stands.
        for word in [1, 0, (HEADER + LEVEL) as u32, descriptor.len() as u32] {
            out.extend(word.to_le_bytes());
        }
        out.resize(HEADER, 0);
        for word in [start, image.len(), image.len()] {
            out.extend((word as u64).to_le_bytes());
        }
        out.extend(descriptor);
        out.resize(start, 0);
        out.extend(&*image);
        Ok(out)
    }
}
