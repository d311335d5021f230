//! Radiance RGBE pictures in (Ward 1991, "Real Pixels", Graphics Gems II; file form as in Radiance's `color.c`). Written
//! here because the `image` crate's reader ignores EXPOSURE and turned pictures, and overflows on crafted run lengths.

use super::LinearImage;
use crate::{IoError, Limits};
use lumbre_core::Rgb;
use std::path::Path;

/// Whether a file begins like one.
pub(super) fn is_hdr(bytes: &[u8]) -> bool {
    bytes.starts_with(b"#?")
}

struct Header {
    width: usize,
    height: usize,
    bottom_up: bool,
    right_to_left: bool,
    /// Factor that undoes the exposures noted in the file.
    scale: f32,
}

/// Decodes a picture.
pub(super) fn decode(path: &Path, bytes: &[u8], limits: &Limits) -> Result<LinearImage, IoError> {
    let error = |why: String| IoError::data(path, "", why);
    let mut input = Input { bytes, at: 0 };
    let header = read_header(path, &mut input)?;
    let (width, height) = (header.width, header.height);
    limits.check_image(path, (width as u64, height as u64), size_of::<Rgb>() as u64)?;
    // Rows grow with the bytes that are there, so that a false size takes no memory.
    let mut pixels: Vec<Rgb> = Vec::new();
    let mut row = vec![[0u8; 4]; width];
    for y in 0..height {
        read_row(&mut input, &mut row).ok_or_else(|| error(format!("row {y} is damaged or cut off")))?;
        if header.right_to_left {
            row.reverse();
        }
        pixels.extend(row.iter().map(|&p| rgbe(p) * header.scale));
    }
    if header.bottom_up {
        let mut rows: Vec<_> = pixels.chunks_exact(width).collect();
        rows.reverse();
        pixels = rows.concat();
    }
    Ok(LinearImage { width: width as u32, height: height as u32, pixels })
}

fn read_header(path: &Path, input: &mut Input) -> Result<Header, IoError> {
    let error = |why: &str| IoError::data(path, "header", why);
    let mut exposure = 1.0f64;
    input.line();
    loop {
        let line = input.line().ok_or_else(|| error("cut off"))?;
        if line.is_empty() {
            break;
        }
        let line = String::from_utf8_lossy(line);
        match line.split_once('=').map(|(k, v)| (k.trim(), v.trim())) {
            Some(("FORMAT", "32-bit_rle_rgbe")) => {}
            Some(("FORMAT", other)) => {
                return Err(IoError::unsupported(path, "header", format!("the format {other:?}")));
            }
            // Several exposures multiply.
            Some(("EXPOSURE", v)) => {
                exposure *= v.parse::<f64>().map_err(|_| error("EXPOSURE is no number"))?
            }
            _ => {}
        }
    }
    let scale = (1.0 / exposure) as f32;
    if !(scale.is_finite() && scale > 0.0) {
        return Err(error("EXPOSURE is not positive"));
    }
    let size = input.line().ok_or_else(|| error("has no size"))?;
    let size = String::from_utf8_lossy(size);
    let words: Vec<_> = size.split_ascii_whitespace().collect();
    let [y, height, x, width] = words[..] else { return Err(error("its size is not four words")) };
    let number = |w: &str| w.parse::<u32>().map(|n| n as usize).map_err(|_| error("its size is no number"));
    match (y, x) {
        ("-Y" | "+Y", "+X" | "-X") => Ok(Header {
            width: number(width)?,
            height: number(height)?,
            bottom_up: y == "+Y",
            right_to_left: x == "-X",
            scale,
        }),
        _ => Err(IoError::unsupported(path, "header", format!("the orientation {y:?} {x:?}"))),
    }
}

/// 2^(e - 128 - 8) times each mantissa; exponent 0 is black.
fn rgbe([r, g, b, e]: [u8; 4]) -> Rgb {
    if e == 0 {
        return Rgb::BLACK;
    }
    let unit = f64::from_bits((u64::from(e) + 1023 - 136) << 52);
    Rgb::from_array([r, g, b].map(|c| (f64::from(c) * unit) as f32))
}

struct Input<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Input<'a> {
    fn line(&mut self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(|&b| b == b'\n')?;
        self.at += end + 1;
        Some(rest[..end].strip_suffix(b"\r").unwrap_or(&rest[..end]))
    }

    fn take(&mut self, n: usize) -> Option<&'a [u8]> {
        let part = self.bytes.get(self.at..self.at + n)?;
        self.at += n;
        Some(part)
    }

    fn byte(&mut self) -> Option<u8> {
        self.take(1).map(|b| b[0])
    }

    fn pixel(&mut self) -> Option<[u8; 4]> {
        self.take(4).map(|b| [b[0], b[1], b[2], b[3]])
    }
}

/// Reads one row in whichever of the three codings it has; `None`: damaged.
fn read_row(input: &mut Input, row: &mut [[u8; 4]]) -> Option<()> {
    let first = input.pixel()?;
    let [a, b, high, low] = first;
    let by_component = (8..0x8000).contains(&row.len())
        && (a, b) == (2, 2)
        && usize::from(high) << 8 | usize::from(low) == row.len();
    if by_component {
        return (0..4).try_for_each(|c| read_component(input, row, c));
    }
    read_old(input, first, row)
}

/// Runs of one component: above 128 one value repeated, else as many values.
fn read_component(input: &mut Input, row: &mut [[u8; 4]], c: usize) -> Option<()> {
    let mut x = 0;
    while x < row.len() {
        let count = input.byte()?;
        if count > 128 {
            let run = row.get_mut(x..x + usize::from(count - 128))?;
            let value = input.byte()?;
            run.iter_mut().for_each(|p| p[c] = value);
            x += run.len();
        } else {
            let run = row.get_mut(x..x + usize::from(count))?;
            if run.is_empty() {
                return None;
            }
            let values = input.take(run.len())?;
            run.iter_mut().zip(values).for_each(|(p, &v)| p[c] = v);
            x += run.len();
        }
    }
    Some(())
}

/// Plain pixels, among which 1, 1, 1, n repeats the one before n times; such marks in a row are digits to base 256.
fn read_old(input: &mut Input, first: [u8; 4], row: &mut [[u8; 4]]) -> Option<()> {
    let (mut x, mut shift) = (0usize, 0);
    let mut pixel = first;
    loop {
        if let [1, 1, 1, n] = pixel {
            let count = usize::from(n).checked_shl(shift).filter(|_| shift <= 24)?;
            let before = *row.get(x.checked_sub(1)?)?;
            row.get_mut(x..x.checked_add(count)?)?.fill(before);
            x += count;
            shift += 8;
        } else {
            *row.get_mut(x)? = pixel;
            x += 1;
            shift = 0;
        }
        if x == row.len() {
            return Some(());
        }
        pixel = input.pixel()?;
    }
}
