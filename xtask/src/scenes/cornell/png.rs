//! The smallest PNG writer that serves: a palette of up to 16 colours, 4 bits per pixel, zlib blocks stored as they are. It is
//! written out here so that the bytes never change with the version of a compressor (PNG 2nd edition; RFC 1950, 1951).

use crate::scenes::kit::png_chunk;

/// An indexed picture, row 0 on top; `pixels` holds palette indices.
pub(crate) struct Indexed {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) palette: Vec<[u8; 3]>,
    pub(crate) pixels: Vec<u8>,
}

/// The picture as a PNG file. Panics when the palette has more than 16 entries or the width is odd.
pub(crate) fn encode(image: &Indexed) -> Vec<u8> {
    assert!(
        image.palette.len() <= 16
            && image.width.is_multiple_of(2)
            && image.pixels.len() == image.width * image.height
    );
    let mut rows = Vec::new();
    for row in image.pixels.chunks_exact(image.width) {
        rows.push(0); // filter type: none
        rows.extend(row.chunks_exact(2).map(|two| two[0] << 4 | two[1]));
    }
    let mut header = Vec::new();
    header.extend((image.width as u32).to_be_bytes());
    header.extend((image.height as u32).to_be_bytes());
    header.extend([4, 3, 0, 0, 0]); // 4 bits, palette, deflate, adaptive filters, no interlace
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    png_chunk(&mut file, b"IHDR", &header);
    png_chunk(&mut file, b"sRGB", &[0]);
    png_chunk(&mut file, b"PLTE", image.palette.as_flattened());
    png_chunk(&mut file, b"IDAT", &zlib_stored(&rows));
    png_chunk(&mut file, b"IEND", &[]);
    file
}

/// The data as a zlib stream of stored blocks.
fn zlib_stored(data: &[u8]) -> Vec<u8> {
    let mut stream = vec![0x78, 0x01];
    let blocks = data.chunks(65535);
    let last = blocks.len() - 1;
    for (i, block) in blocks.enumerate() {
        let length = block.len() as u16;
        stream.push(u8::from(i == last));
        stream.extend(length.to_le_bytes());
        stream.extend((!length).to_le_bytes());
        stream.extend(block);
    }
    // Adler-32 (RFC 1950, section 8.2).
    let (a, b) = data.iter().fold((1u32, 0u32), |(a, b), &byte| {
        let a = (a + u32::from(byte)) % 65521;
        (a, (b + a) % 65521)
    });
    stream.extend((b << 16 | a).to_be_bytes());
    stream
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_matches_its_published_check_value() {
        let stream = zlib_stored(b"Wikipedia");
        assert_eq!(stream[stream.len() - 4..], 0x11E6_0398u32.to_be_bytes());
    }

    #[test]
    fn long_data_is_cut_into_blocks() {
        let stream = zlib_stored(&vec![7; 70_000]);
        assert_eq!(stream.len(), 2 + 5 + 65535 + 5 + 4465 + 4);
        assert_eq!((stream[2], stream[2 + 5 + 65535]), (0, 1));
    }
}
