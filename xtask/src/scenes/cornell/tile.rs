//! The floor of the Cornell room: one cement tile with an eight-pointed star, as a small picture that repeats.

use super::png::Indexed;
use crate::scenes::kit::srgb;
use glam::{DVec2, DVec3};

/// Pixels along one side of the tile.
const SIZE: usize = 256;
/// Samples per pixel along one axis.
const SUPERSAMPLING: usize = 5;

/// The plain colours, linear Rec. 709 reflectances.
const CREAM: usize = 0;
const TEAL: usize = 1;
const CLAY: usize = 2;
const GROUT: usize = 3;
const COLOURS: [DVec3; 4] = [
    DVec3::new(0.60, 0.51, 0.38),
    DVec3::new(0.085, 0.165, 0.175),
    DVec3::new(0.36, 0.125, 0.065),
    DVec3::new(0.34, 0.29, 0.23),
];

/// Whether `p` is inside the star made of two squares turned by 45°, with inner half side `r`.
fn in_star(p: DVec2, r: f64) -> bool {
    let q = p.abs();
    q.max_element() < r || q.x + q.y < r * std::f64::consts::SQRT_2
}

/// Colour index of the tile at `p` in [-1, 1]², the tile's centre at the origin.
fn pattern(p: DVec2) -> usize {
    if p.abs().max_element() > 0.985 {
        return GROUT;
    }
    // Quarter rosettes in the corners meet those of the neighbours.
    let corner = (DVec2::ONE - p.abs()).length();
    match corner {
        c if c < 0.16 => return TEAL,
        c if c < 0.26 => return CREAM,
        c if c < 0.38 => return CLAY,
        _ => {}
    }
    let centre = p.length();
    if centre < 0.13 {
        CLAY
    } else if in_star(p, 0.25) {
        CREAM
    } else if in_star(p, 0.47) {
        TEAL
    } else if in_star(p, 0.53) {
        CREAM
    } else if in_star(p, 0.57) {
        CLAY
    } else {
        CREAM
    }
}

/// Linear reflectance to the sRGB byte.
fn srgb_byte(x: f64) -> u8 {
    (255.0 * srgb(x)).round() as u8
}

/// The tile as a picture of 16 colours: the plain four and two blends of each pair, for smooth edges.
pub(crate) fn tile() -> Indexed {
    let mut colours = COLOURS.to_vec();
    for (i, a) in COLOURS.iter().enumerate() {
        for b in &COLOURS[i + 1..] {
            colours.extend([1.0, 2.0].map(|k| a.lerp(*b, k / 3.0)));
        }
    }
    let fine = (SIZE * SUPERSAMPLING) as f64;
    let mut pixels = Vec::with_capacity(SIZE * SIZE);
    for y in 0..SIZE {
        for x in 0..SIZE {
            let mut mean = DVec3::ZERO;
            for k in 0..SUPERSAMPLING * SUPERSAMPLING {
                let (sx, sy) = (x * SUPERSAMPLING + k % SUPERSAMPLING, y * SUPERSAMPLING + k / SUPERSAMPLING);
                let p = (DVec2::new(sx as f64, sy as f64) + 0.5) * 2.0 / fine - 1.0;
                mean += COLOURS[pattern(p)] / (SUPERSAMPLING * SUPERSAMPLING) as f64;
            }
            let distance = |i: &usize| (colours[*i] - mean).length_squared();
            let nearest = (0..colours.len())
                .min_by(|a, b| distance(a).total_cmp(&distance(b)))
                .expect("the palette is not empty");
            pixels.push(nearest as u8);
        }
    }
    let palette = colours.iter().map(|c| c.to_array().map(srgb_byte)).collect();
    Indexed { width: SIZE, height: SIZE, palette, pixels }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tile_repeats_without_a_seam() {
        let image = tile();
        let at = |x: usize, y: usize| image.pixels[y * SIZE + x];
        for i in 0..SIZE {
            // The pattern is symmetric under both mirrorings, so opposite edges agree.
            assert_eq!(at(i, 0), at(i, SIZE - 1), "column {i}");
            assert_eq!(at(0, i), at(SIZE - 1, i), "row {i}");
        }
        assert!((0..4).all(|colour| image.pixels.contains(&colour)), "a plain colour is missing");
    }
}
