//! Pictures made from pictures: MTL keeps in several what a scene's texture holds in one.

use super::map::Channel;
use lumbre_scene::Image;
use rayon::prelude::*;

/// Bytes of a texel.
const TEXEL: usize = 4;

/// How steep a bump map is: what a height of 1 (white) stands for, in widths of the picture. The format leaves it open; this
/// looks as bump maps usually do, and it does not depend on the resolution.
const HEIGHT: f32 = 0.01;

/// The size of a picture made from others: as fine as the finest in either direction.
pub(super) fn common_size<'a>(parts: impl Iterator<Item = &'a Image>) -> (u32, u32) {
    parts.fold((1, 1), |(w, h), i| (w.max(i.width), h.max(i.height)))
}

/// A picture of this size, row by row on all cores.
fn make(name: &str, (width, height): (u32, u32), texel: impl Fn(u32, u32) -> [u8; TEXEL] + Sync) -> Image {
    let mut rgba8 = vec![0; width as usize * height as usize * TEXEL];
    rgba8.par_chunks_exact_mut(width as usize * TEXEL).enumerate().for_each(|(y, row)| {
        for (x, out) in row.chunks_exact_mut(TEXEL).enumerate() {
            out.copy_from_slice(&texel(x as u32, y as u32));
        }
    });
    Image { name: name.into(), width, height, rgba8 }
}

fn at(image: &Image, x: u32, y: u32) -> [u8; TEXEL] {
    let first = (y as usize * image.width as usize + x as usize) * TEXEL;
    [0, 1, 2, 3].map(|k| image.rgba8[first + k])
}

/// The texel of a picture stretched to another size: bilinear, the edge going on outside.
fn stretched(image: &Image, (x, y): (u32, u32), (width, height): (u32, u32)) -> [u8; TEXEL] {
    if (image.width, image.height) == (width, height) {
        return at(image, x, y);
    }
    let place = |i: u32, n: u32, of: u32| {
        let p = ((i as f32 + 0.5) * of as f32 / n as f32 - 0.5).max(0.0);
        let low = (p as u32).min(of - 1);
        (low, (low + 1).min(of - 1), p - low as f32)
    };
    let ((x0, x1, fx), (y0, y1, fy)) = (place(x, width, image.width), place(y, height, image.height));
    let corners = [at(image, x0, y0), at(image, x1, y0), at(image, x0, y1), at(image, x1, y1)];
    [0, 1, 2, 3].map(|k| {
        let [a, b, c, d] = corners.map(|t| f32::from(t[k]));
        let (top, bottom) = (a + (b - a) * fx, c + (d - c) * fx);
        (top + (bottom - top) * fy + 0.5) as u8
    })
}

/// One number of a texel. Weights of Rec. 709.
fn scalar(texel: [u8; TEXEL], channel: Channel) -> u8 {
    match channel {
        Channel::One(k) => texel[usize::from(k)],
        Channel::Luminance => {
            let [r, g, b, _] = texel.map(f32::from);
            (0.2126 * r + 0.7152 * g + 0.0722 * b + 0.5) as u8
        }
    }
}

/// Whether any texel is less than opaque.
pub(super) fn has_alpha(image: &Image) -> bool {
    image.rgba8.par_chunks_exact(TEXEL).any(|t| t[3] != u8::MAX)
}

/// The colours of `color`, white without, and its alpha times a channel of `alpha`. Without a channel that is alpha where the
/// picture has some, else its luminance.
pub(super) fn with_coverage(color: Option<&Image>, alpha: &Image, channel: Option<Channel>) -> Image {
    let own = has_alpha(alpha);
    let channel = channel.unwrap_or(if own { Channel::One(3) } else { Channel::Luminance });
    let size = common_size(color.into_iter().chain([alpha]));
    make(&color.unwrap_or(alpha).name, size, |x, y| {
        let [r, g, b, a] = color.map_or([u8::MAX; TEXEL], |c| stretched(c, (x, y), size));
        let covered = u32::from(scalar(stretched(alpha, (x, y), size), channel));
        // The same picture may say both, and says it once.
        let twice = color.is_some_and(|c| std::ptr::eq(c, alpha)) && channel == Channel::One(3);
        let a = if twice { covered } else { (u32::from(a) * covered + 127) / 255 };
        [r, g, b, a as u8]
    })
}

/// Roughness in green and metallic in blue, each white without a picture.
pub(super) fn rough_metal(rough: Option<(&Image, Channel)>, metal: Option<(&Image, Channel)>) -> Image {
    let parts = || rough.iter().chain(&metal).map(|(image, _)| *image);
    let size = common_size(parts());
    let name = parts().next().map_or("", |i| &i.name);
    let one = |part: Option<(&Image, Channel)>, x, y| {
        part.map_or(u8::MAX, |(image, channel)| scalar(stretched(image, (x, y), size), channel))
    };
    make(name, size, |x, y| [u8::MAX, one(rough, x, y), one(metal, x, y), u8::MAX])
}

/// Whether a picture given as a bump map is a normal map, as many programs write: mostly blue, red and green half on average.
pub(super) fn is_normal_map(image: &Image) -> bool {
    let count = (image.rgba8.len() / TEXEL) as f64;
    let sums = image
        .rgba8
        .par_chunks_exact(TEXEL)
        .map(|t| [t[0], t[1], t[2]].map(u64::from))
        .reduce(|| [0; 3], |a, b| [a[0] + b[0], a[1] + b[1], a[2] + b[2]]);
    let [r, g, b] = sums.map(|s| s as f64 / count);
    (r - 127.5).abs() < 32.0 && (g - 127.5).abs() < 32.0 && b > 190.0
}

/// A normal map from heights, with the slopes of Blinn 1978; the picture repeats.
pub(super) fn normals_from_heights(heights: &Image, channel: Channel) -> Image {
    let (width, height) = (heights.width, heights.height);
    let level = |x: u32, y: u32| f32::from(scalar(at(heights, x % width, y % height), channel)) / 255.0;
    make(&heights.name, (width, height), |x, y| {
        // Central differences, per width of the picture; up is towards row 0.
        let right = level(x + 1, y) - level(x + width - 1, y);
        let up = level(x, y + height - 1) - level(x, y + 1);
        let (dx, dy) = (0.5 * HEIGHT * width as f32 * right, 0.5 * HEIGHT * width as f32 * up);
        let scale = 1.0 / (dx * dx + dy * dy + 1.0).sqrt();
        let [r, g, b] = [-dx, -dy, 1.0].map(|v| ((v * scale * 0.5 + 0.5) * 255.0 + 0.5) as u8);
        [r, g, b, u8::MAX]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: u32, height: u32, texels: &[[u8; 4]]) -> Image {
        Image { name: "a".into(), width, height, rgba8: texels.concat() }
    }

    fn grey(v: u8) -> [u8; 4] {
        [v, v, v, 255]
    }

    #[test]
    fn coverage_is_alpha_or_luminance() {
        let color = image(2, 1, &[[10, 20, 30, 255], [40, 50, 60, 128]]);
        let mask = image(2, 1, &[grey(255), grey(51)]);
        let made = with_coverage(Some(&color), &mask, None);
        assert_eq!(made.rgba8, [10, 20, 30, 255, 40, 50, 60, 26]);
        assert_eq!(with_coverage(None, &mask, None).rgba8, [255, 255, 255, 255, 255, 255, 255, 51]);
        // The same picture twice covers once.
        assert_eq!(with_coverage(Some(&color), &color, None).rgba8, color.rgba8);
        let blue = with_coverage(None, &color, Some(Channel::One(2)));
        assert_eq!([blue.rgba8[3], blue.rgba8[7]], [30, 60]);
    }

    #[test]
    fn sizes_meet_at_the_finest() {
        let rough = image(1, 2, &[grey(0), grey(200)]);
        let metal = image(4, 1, &[grey(0), grey(255), grey(255), grey(0)]);
        let made = rough_metal(Some((&rough, Channel::Luminance)), Some((&metal, Channel::Luminance)));
        assert_eq!((made.width, made.height), (4, 2));
        assert_eq!(at(&made, 1, 0), [255, 0, 255, 255]);
        assert_eq!(at(&made, 3, 1), [255, 200, 0, 255]);
        let alone = rough_metal(None, Some((&metal, Channel::One(0))));
        assert_eq!((at(&alone, 0, 0), at(&alone, 1, 0)), ([255, 255, 0, 255], [255, 255, 255, 255]));
    }

    #[test]
    fn heights_that_rise_turn_the_normal_back() {
        let ramp: Vec<[u8; 4]> = (0..64).map(|i| grey(32 * (i % 8))).collect();
        let right = normals_from_heights(&image(8, 8, &ramp), Channel::Luminance);
        let [r, g, b, _] = at(&right, 3, 3);
        assert!(r < 127 && g == 128 && b > 128, "{r} {g} {b}");
        let down: Vec<[u8; 4]> = (0..64).map(|i| grey(32 * (i / 8))).collect();
        let [r, g, _, _] = at(&normals_from_heights(&image(8, 8, &down), Channel::Luminance), 3, 3);
        // Higher at the bottom: it leans towards the top, which is green.
        assert!(r == 128 && g > 128, "{r} {g}");
    }

    #[test]
    fn normal_maps_are_known_by_their_colour() {
        assert!(is_normal_map(&image(2, 1, &[[128, 128, 255, 255], [100, 140, 230, 255]])));
        assert!(!is_normal_map(&image(2, 1, &[grey(128), grey(255)])));
        assert!(!is_normal_map(&image(1, 1, &[grey(255)])));
    }
}
