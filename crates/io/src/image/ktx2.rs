//! KTX2 textures (Khronos Group, KTX file format specification 2.0): the largest image of a two-dimensional texture.
//! What `KHR_texture_basisu` allows is decoded by the `basisu` crate: ETC1S with its own entropy coding, UASTC plain or
//! squeezed by Zstandard or zlib. Uncompressed texels of 8 bits are read as well. The container is parsed by the `ktx2`
//! crate.
//!
//! Whether the numbers are sRGB is left out: in glTF, the use of a texture says it.

use super::ldr::{check_density, most_pixels_of_few_bytes};
use crate::{IoError, Limits};
use basisu::{DecodeFlags, SourceFormat, TargetFormat, Transcoder};
use ktx2::{Format, Header, Reader, SupercompressionScheme};
use std::borrow::Cow;
use std::io::Read;
use std::path::Path;

/// What a Zstandard frame may keep of what came before, beyond twice the size of the image: encoders that do not know
/// the size choose a window by their level.
const LEAST_WINDOW: u64 = 16 << 20;

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
    let header = open(bytes, path, limits, decoded_texel)?.header();
    Ok((header.pixel_width, header.pixel_height))
}

/// Columns, rows and texels of R, G, B, A.
pub(super) fn decode(
    bytes: &[u8],
    path: &Path,
    limits: &Limits,
    decoded_texel: u64,
) -> Result<(u32, u32, Vec<u8>), IoError> {
    let reader = open(bytes, path, limits, decoded_texel)?;
    let header = reader.header();
    let rgba8 = match header.format {
        Some(format) => plain(&reader, format, path)?,
        None => basis(&reader, path)?,
    };
    Ok((header.pixel_width, header.pixel_height, rgba8))
}

fn open<'a>(
    bytes: &'a [u8],
    path: &Path,
    limits: &Limits,
    decoded_texel: u64,
) -> Result<Reader<&'a [u8]>, IoError> {
    let reader = Reader::new(bytes).map_err(|e| IoError::data(path, "", format!("damaged KTX2: {e}")))?;
    let header = reader.header();
    let Header { pixel_width, pixel_height, pixel_depth, layer_count, face_count, .. } = header;
    if pixel_height == 0 || pixel_depth > 0 || layer_count > 0 || face_count != 1 {
        let what = "KTX2 textures other than one two-dimensional image (lines, volumes, arrays, cubes)";
        return Err(IoError::unsupported(path, "", what));
    }
    limits.check_image(path, (pixel_width.into(), pixel_height.into()), decoded_texel)?;
    // Of all others, the size of the image is known exactly.
    if header.supercompression_scheme == Some(SupercompressionScheme::BasisLZ) {
        let most = most_pixels_of_few_bytes(bytes.len());
        check_density(path, (pixel_width, pixel_height), bytes.len(), most)?;
    }
    Ok(reader)
}

/// The bytes of the largest image, which must be `want`.
fn largest<'a>(reader: &'a Reader<&[u8]>, want: u64, path: &Path) -> Result<Cow<'a, [u8]>, IoError> {
    let level = reader.levels().next().ok_or_else(|| IoError::data(path, "", "holds no image"))?;
    let wrong = |e: String| IoError::data(path, "", format!("its data is damaged: {e}"));
    let room = usize::try_from(want).map_err(|_| wrong("it is too large".into()))?;
    let bytes = match reader.header().supercompression_scheme {
        None => Cow::Borrowed(level.data),
        Some(SupercompressionScheme::Zstandard) => {
            let window = want.saturating_mul(2).max(LEAST_WINDOW);
            let mut out = Vec::new();
            ruzstd::decoding::StreamingDecoder::new_with_max_window_size(level.data, window)
                .map_err(|e| wrong(e.to_string()))?
                .take(want.saturating_add(1))
                .read_to_end(&mut out)
                .map_err(|e| wrong(e.to_string()))?;
            Cow::Owned(out)
        }
        Some(SupercompressionScheme::ZLIB) => Cow::Owned(
            miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(level.data, room)
                .map_err(|e| wrong(e.to_string()))?,
        ),
        Some(_) => return Err(IoError::unsupported(path, "", "this KTX2's kind of supercompression")),
    };
    if bytes.len() != room {
        let have = bytes.len();
        return Err(wrong(format!("the image takes {want} bytes, but there are {have}")));
    }
    Ok(bytes)
}

/// Uncompressed texels. Channels that a format lacks are 0, alpha 1, as for every reader of such a format.
fn plain(reader: &Reader<&[u8]>, format: Format, path: &Path) -> Result<Vec<u8>, IoError> {
    // Where the red, green, blue and alpha of a texel stand in it, if they do.
    let channels: &[usize] = match format {
        Format::R8_UNORM | Format::R8_SRGB => &[0],
        Format::R8G8_UNORM | Format::R8G8_SRGB => &[0, 1],
        Format::R8G8B8_UNORM | Format::R8G8B8_SRGB => &[0, 1, 2],
        Format::B8G8R8_UNORM | Format::B8G8R8_SRGB => &[2, 1, 0],
        Format::R8G8B8A8_UNORM | Format::R8G8B8A8_SRGB => &[0, 1, 2, 3],
        Format::B8G8R8A8_UNORM | Format::B8G8R8A8_SRGB => &[2, 1, 0, 3],
        other => {
            let number = other.value();
            let what = format!("KTX2 texels of the Vulkan format {number}; Basis and 8-bit ones are read");
            return Err(IoError::unsupported(path, "", what));
        }
    };
    let header = reader.header();
    let texels = u64::from(header.pixel_width) * u64::from(header.pixel_height);
    let bytes = largest(reader, texels * channels.len() as u64, path)?;
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
fn basis(reader: &Reader<&[u8]>, path: &Path) -> Result<Vec<u8>, IoError> {
    let header = reader.header();
    let lz = header.supercompression_scheme == Some(SupercompressionScheme::BasisLZ);
    let file = if lz { Cow::Borrowed(reader.data()) } else { Cow::Owned(unsqueezed(reader, path)?) };
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

/// The same texture with one level that is not squeezed (KTX 2.0, 3: header, index of levels, descriptor of the format,
/// image), so that the size of what is inflated is bounded here.
fn unsqueezed(reader: &Reader<&[u8]>, path: &Path) -> Result<Vec<u8>, IoError> {
    const HEADER: usize = 80;
    const INDEX: usize = 24;
    const IMAGE_ALIGNMENT: usize = 16;
    let header = reader.header();
    // UASTC: 16 bytes for each block of 4 x 4 texels.
    let blocks = u64::from(header.pixel_width.div_ceil(4)) * u64::from(header.pixel_height.div_ceil(4));
    let image = largest(reader, blocks * 16, path)?;
    let file = reader.data();
    let from = header.index.dfd_byte_offset as usize;
    let descriptor = &file[from..from + header.index.dfd_byte_length as usize];

    let mut out = Vec::with_capacity(HEADER + INDEX + descriptor.len() + IMAGE_ALIGNMENT + image.len());
    out.extend(&file[..40]);
    for word in [1, 0, (HEADER + INDEX) as u32, descriptor.len() as u32] {
        // Levels, supercompression, where the descriptor stands.
        out.extend(word.to_le_bytes());
    }
    out.resize(HEADER, 0);
    let start = (HEADER + INDEX + descriptor.len()).next_multiple_of(IMAGE_ALIGNMENT);
    for word in [start, image.len(), image.len()] {
        out.extend((word as u64).to_le_bytes());
    }
    out.extend(descriptor);
    out.resize(start, 0);
    out.extend(&*image);
    Ok(out)
}
