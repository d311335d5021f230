//! Pictures computed pixel by pixel, rows on all cores, and height maps turned into normal maps.

use super::png::{Kind, encode};
use glam::DVec3;
use rayon::prelude::*;

/// 0 below `a`, 1 above `b`, smooth between; falling where `a` > `b`.
pub(crate) fn smoothstep(a: f64, b: f64, x: f64) -> f64 {
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// From `a` to `b` as `t` runs from 0 to 1.
pub(crate) fn mix(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

/// Linear value to sRGB (IEC 61966-2-1), both 0 to 1.
pub(crate) fn srgb(x: f64) -> f64 {
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * libm::pow(x, 1.0 / 2.4) - 0.055 }
}

fn byte(x: f64) -> u8 {
    (x.clamp(0.0, 1.0) * 255.0).round() as u8
}

/// Every pixel of a picture at its centre, (u, v) in [0, 1)², row 0 on top.
fn evaluate<T: Send>([width, height]: [usize; 2], at: impl Fn(f64, f64) -> T + Sync) -> Vec<T> {
    let pixel = |i: usize| {
        let (x, y) = ((i % width) as f64, (i / width) as f64);
        at((x + 0.5) / width as f64, (y + 0.5) / height as f64)
    };
    (0..width * height).into_par_iter().with_min_len(width).map(pixel).collect()
}

/// One number for each pixel: reflectance, roughness or height.
#[derive(Clone)]
pub(crate) struct Grey {
    size: [usize; 2],
    values: Vec<f64>,
}

impl Grey {
    /// Computes `at(u, v)` for each pixel.
    pub(crate) fn from_fn(size: [usize; 2], at: impl Fn(f64, f64) -> f64 + Sync) -> Grey {
        Grey { size, values: evaluate(size, at) }
    }

    /// As a grey PNG of plain numbers, for roughness.
    pub(crate) fn png(&self) -> Vec<u8> {
        let bytes: Vec<u8> = self.values.iter().map(|x| byte(*x)).collect();
        encode(Kind::Grey, self.size, &bytes)
    }

    /// As a grey PNG of linear reflectances in sRGB, for colour.
    pub(crate) fn png_srgb(&self) -> Vec<u8> {
        let bytes: Vec<u8> = self.values.iter().map(|x| byte(srgb(*x))).collect();
        encode(Kind::Grey, self.size, &bytes)
    }

    /// The normal map of these heights in metres, of which a repetition covers `metres`; green points up in the picture (glTF).
    pub(crate) fn normal_map(&self, metres: [f64; 2]) -> Vec<u8> {
        let [w, h] = self.size;
        let at = |x: usize, y: usize| self.values[y % h * w + x % w];
        let slope = |x: usize, y: usize| {
            let dx = (at(x + 1, y) - at(x + w - 1, y)) * w as f64 / (2.0 * metres[0]);
            let dy = (at(x, y + 1) - at(x, y + h - 1)) * h as f64 / (2.0 * metres[1]);
            DVec3::new(-dx, dy, 1.0).normalize()
        };
        let row = |y: usize| (0..w).flat_map(move |x| slope(x, y).to_array().map(|n| byte(n * 0.5 + 0.5)));
        let rows: Vec<Vec<u8>> = (0..h).into_par_iter().map(|y| row(y).collect()).collect();
        encode(Kind::Rgb, self.size, &rows.concat())
    }
}

/// A linear colour for each pixel, with alpha.
pub(crate) struct Picture {
    size: [usize; 2],
    pixels: Vec<[f64; 4]>,
}

impl Picture {
    /// Computes the colour `at(u, v)` for each pixel.
    pub(crate) fn from_fn(size: [usize; 2], at: impl Fn(f64, f64) -> DVec3 + Sync) -> Picture {
        Picture::with_alpha(size, |u, v| (at(u, v), 1.0))
    }

    /// Computes the colour and the alpha `at(u, v)` for each pixel.
    pub(crate) fn with_alpha(size: [usize; 2], at: impl Fn(f64, f64) -> (DVec3, f64) + Sync) -> Picture {
        let pixels = evaluate(size, |u, v| {
            let (c, a) = at(u, v);
            [c.x, c.y, c.z, a]
        });
        Picture { size, pixels }
    }

    /// As a PNG in sRGB, with alpha where a pixel has one below 1.
    pub(crate) fn png(&self) -> Vec<u8> {
        let opaque = self.pixels.iter().all(|p| p[3] >= 1.0);
        let (kind, channels) = if opaque { (Kind::Rgb, 3) } else { (Kind::Rgba, 4) };
        let bytes: Vec<u8> = self
            .pixels
            .par_iter()
            .flat_map_iter(|[r, g, b, a]| {
                [byte(srgb(*r)), byte(srgb(*g)), byte(srgb(*b)), byte(*a)].into_iter().take(channels)
            })
            .collect();
        encode(kind, self.size, &bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_encodes_its_ends_and_middle_grey() {
        assert_eq!([0.0, 0.215_860_5, 1.0].map(|x| byte(srgb(x))), [0, 128, 255]);
    }

    #[test]
    fn a_slope_of_one_leans_by_half_a_right_angle() {
        // Height falls to the right by a metre per metre, but for the seam.
        let heights = Grey::from_fn([16, 4], |u, _| -u);
        let file = heights.normal_map([1.0, 1.0]);
        let at = file.windows(4).position(|w| w == b"IDAT").unwrap() + 4;
        let rows = miniz_oxide::inflate::decompress_to_vec_zlib(&file[at..]).unwrap();
        // The first row is filtered by its left neighbour or not at all: the second pixel stands for itself or repeats.
        assert!(rows[0] <= 1);
        let red = if rows[0] == 0 { rows[4] } else { rows[1].wrapping_add(rows[4]) };
        assert_eq!(red, byte(0.5 + 0.5 / 2f64.sqrt()));
    }

    #[test]
    fn alpha_is_written_where_there_is_some() {
        let kind = |p: Picture| p.png()[25];
        assert_eq!(kind(Picture::from_fn([2, 2], |_, _| DVec3::ONE)), Kind::Rgb as u8);
        assert_eq!(kind(Picture::with_alpha([2, 2], |u, _| (DVec3::ONE, u))), Kind::Rgba as u8);
    }
}
