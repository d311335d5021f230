//! A small PNG writer (PNG 2nd edition): 8 bits a channel, each row with the filter whose residue is smallest, deflate by
//! `miniz_oxide`. The bytes change with that crate's version, which Cargo.lock holds.

/// How the bytes of a pixel are to be read.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Grey = 0,
    Rgb = 2,
    Rgba = 6,
}

impl Kind {
    fn channels(self) -> usize {
        match self {
            Kind::Grey => 1,
            Kind::Rgb => 3,
            Kind::Rgba => 4,
        }
    }
}

/// The picture as a PNG file: `pixels` row by row, the top one first.
pub(super) fn encode(kind: Kind, [width, height]: [usize; 2], pixels: &[u8]) -> Vec<u8> {
    let stride = width * kind.channels();
    assert_eq!(pixels.len(), stride * height);
    let mut filtered = Vec::with_capacity((stride + 1) * height);
    let mut above = vec![0; stride];
    for row in pixels.chunks_exact(stride) {
        filtered.extend(best_filter(row, &above, kind.channels()));
        above.copy_from_slice(row);
    }
    let mut header = Vec::new();
    header.extend((width as u32).to_be_bytes());
    header.extend((height as u32).to_be_bytes());
    header.extend([8, kind as u8, 0, 0, 0]); // 8 bits, deflate, adaptive filters, no interlace
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    chunk(&mut file, b"IHDR", &header);
    chunk(&mut file, b"IDAT", &miniz_oxide::deflate::compress_to_vec_zlib(&filtered, 8));
    chunk(&mut file, b"IEND", &[]);
    file
}

/// The row with its filter type in front, filtered so that the sum of its residues is least.
fn best_filter(row: &[u8], above: &[u8], channels: usize) -> Vec<u8> {
    let cost = |row: &Vec<u8>| row[1..].iter().map(|&x| u32::from((x as i8).unsigned_abs())).sum::<u32>();
    let rows = (0..5u8).map(|filter| {
        let mut out = vec![filter];
        out.extend((0..row.len()).map(|i| {
            let left = if i < channels { 0 } else { row[i - channels] };
            let corner = if i < channels { 0 } else { above[i - channels] };
            row[i].wrapping_sub(predict(filter, left, above[i], corner))
        }));
        out
    });
    rows.min_by_key(cost).expect("there are five filters")
}

/// What a filter expects from the neighbours left, above and left above.
fn predict(filter: u8, left: u8, above: u8, corner: u8) -> u8 {
    match filter {
        0 => 0,
        1 => left,
        2 => above,
        3 => ((u16::from(left) + u16::from(above)) / 2) as u8,
        _ => {
            let [a, b, c] = [left, above, corner].map(i16::from);
            let p = a + b - c;
            let [pa, pb, pc] = [a, b, c].map(|x| (p - x).abs());
            if pa <= pb && pa <= pc {
                left
            } else if pb <= pc {
                above
            } else {
                corner
            }
        }
    }
}

/// Appends one PNG chunk: length, type, data, CRC of type and data.
pub(crate) fn chunk(file: &mut Vec<u8>, kind: &[u8; 4], data: &[u8]) {
    file.extend((data.len() as u32).to_be_bytes());
    let start = file.len();
    file.extend(kind);
    file.extend(data);
    let crc = crc32(&file[start..]);
    file.extend(crc.to_be_bytes());
}

/// CRC-32 with the polynomial 0xEDB88320, as PNG and zip use it; by bytes with a table.
fn crc32(data: &[u8]) -> u32 {
    const TABLE: [u32; 256] = {
        let mut table = [0; 256];
        let mut i = 0;
        while i < 256 {
            let (mut crc, mut bit) = (i as u32, 0);
            while bit < 8 {
                crc = if crc & 1 == 1 { crc >> 1 ^ 0xEDB8_8320 } else { crc >> 1 };
                bit += 1;
            }
            table[i] = crc;
            i += 1;
        }
        table
    };
    !data.iter().fold(!0, |crc: u32, byte| TABLE[usize::from(crc as u8 ^ byte)] ^ crc >> 8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_matches_its_published_check_value() {
        assert_eq!(crc32(b"123456789"), 0xCBF4_3926);
    }

    #[test]
    fn every_filter_can_be_undone() {
        let (width, height, channels) = (7, 5, 3);
        let pixels: Vec<u8> = (0..width * height * channels).map(|i| (i * i * 37 % 251) as u8).collect();
        let file = encode(Kind::Rgb, [width, height], &pixels);
        let at = file.windows(4).position(|w| w == b"IDAT").unwrap() + 4;
        let length = u32::from_be_bytes(file[at - 8..at - 4].try_into().unwrap()) as usize;
        let rows = miniz_oxide::inflate::decompress_to_vec_zlib(&file[at..at + length]).unwrap();
        let (stride, mut back) = (width * channels, Vec::<u8>::new());
        for (y, row) in rows.chunks_exact(stride + 1).enumerate() {
            for x in 0..stride {
                let get = |dx: usize, dy: usize| {
                    if x < dx || y < dy { 0 } else { back[(y - dy) * stride + x - dx] }
                };
                let expected = predict(row[0], get(channels, 0), get(0, 1), get(channels, 1));
                back.push(row[1 + x].wrapping_add(expected));
            }
        }
        assert_eq!(back, pixels);
    }
}
