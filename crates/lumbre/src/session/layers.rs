//! Planes of a film as pictures.

use super::Layer;
use crate::compare::magma;
use crate::look::{Look, Negative};
use lumbre_core::Rgb;
use lumbre_core::color::srgb_encode_u8;
use lumbre_core::film::{Film, PixelSums};
use rayon::prelude::*;

/// Four bytes a pixel of any layer but the picture.
pub(super) fn layer(film: &Film, layer: Layer) -> Vec<u8> {
    match layer {
        // Objects come in the plane of albedo: `RenderSettings::object_colors`.
        Layer::Picture | Layer::Albedo | Layer::Objects => {
            each(film, |p| p.albedo().to_array().map(srgb_encode_u8))
        }
        Layer::Normal => {
            each(film, |p| p.normal().map(|v| ((0.5 * v + 0.5).clamp(0.0, 1.0) * 255.0 + 0.5) as u8))
        }
        Layer::Depth => depth(film),
        Layer::Error => each(film, |p| magma(p.error() / p.radiance().luminance().abs().max(1e-6))),
        Layer::Samples => {
            let most = film.pixels().iter().map(PixelSums::samples).max().unwrap_or(0).max(1) as f32;
            each(film, move |p| magma(p.samples() as f32 / most))
        }
        Layer::NonFinite => non_finite(film),
    }
}

fn each(film: &Film, color: impl Fn(&PixelSums) -> [u8; 3] + Sync) -> Vec<u8> {
    film.pixels()
        .par_iter()
        .flat_map_iter(|p| {
            let [r, g, b] = color(p);
            [r, g, b, 255]
        })
        .collect()
}

/// White is the nearest, black the farthest and what is not there; even in the logarithm, so that a room before a wide land has shades.
fn depth(film: &Film) -> Vec<u8> {
    let seen = film.pixels().iter().map(PixelSums::depth).filter(|d| d.is_finite() && *d > 0.0);
    let (near, far) = seen.fold((f32::INFINITY, 0.0f32), |(n, f), d| (n.min(d), f.max(d)));
    let range = (far / near).ln().max(1e-3);
    each(film, |p| {
        let d = p.depth();
        let shade = if d.is_finite() { 1.0 - 0.9 * (d.max(near) / near).ln() / range } else { 0.0 };
        [(shade.clamp(0.0, 1.0) * 255.0) as u8; 3]
    })
}

/// The picture in grey, and the pixels that are named in red, each with its neighbours, so that one among a million is seen.
fn non_finite(film: &Film) -> Vec<u8> {
    let look = Look::default();
    let negative = Negative::new(film, false);
    let mut rgba = negative.develop(&look, negative.exposure_factor(&look), 4);
    rgba.par_chunks_exact_mut(4).for_each(|p| {
        let y = Rgb::new(f32::from(p[0]), f32::from(p[1]), f32::from(p[2])).luminance() as u8;
        p[..3].fill(y / 2);
    });
    let (width, height) = (film.width() as usize, film.height() as usize);
    for n in film.non_finite() {
        let [row, column] = n.row_column.map(|v| v as usize);
        for y in row.saturating_sub(2)..(row + 3).min(height) {
            for x in column.saturating_sub(2)..(column + 3).min(width) {
                rgba[4 * (y * width + x)..][..3].copy_from_slice(&[255, 0, 0]);
            }
        }
    }
    rgba
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_core::film::{FilmSample, FirstHit};

    fn film() -> Film {
        let mut film = Film::new(8, 8);
        for y in 0..8 {
            for x in 0..8 {
                let hit = FirstHit {
                    albedo: Rgb::new(1.0, 0.0, 0.0),
                    normal: [0.0, 1.0, 0.0],
                    depth: 1.0 + x as f32,
                    ..FirstHit::default()
                };
                let radiance = if (x, y) == (6, 6) { Rgb::splat(f32::NAN) } else { Rgb::splat(0.5) };
                let first_hit = (y > 0).then_some(hit);
                film.add([x, y], 0, &FilmSample { radiance, first_hit, alpha: 1.0 });
            }
        }
        film
    }

    #[test]
    fn every_layer_shows_what_it_says() {
        let film = film();
        let at =
            |l, x: usize, y: usize| <[u8; 4]>::try_from(&layer(&film, l)[4 * (8 * y + x)..][..4]).unwrap();
        assert_eq!(at(Layer::Albedo, 3, 3), [255, 0, 0, 255]);
        assert_eq!(at(Layer::Normal, 3, 3), [128, 255, 128, 255]);
        assert_eq!(at(Layer::Depth, 0, 3), [255, 255, 255, 255]);
        assert!(at(Layer::Depth, 7, 3)[0] < at(Layer::Depth, 3, 3)[0]);
        assert_eq!(at(Layer::Depth, 0, 0), [0, 0, 0, 255], "nothing there");
        assert_eq!(at(Layer::Samples, 1, 1)[..3], magma(1.0));
        assert_eq!(at(Layer::Error, 1, 1)[..3], magma(1.0), "one sample says nothing");
        assert_eq!(at(Layer::NonFinite, 6, 6), [255, 0, 0, 255]);
        let grey = at(Layer::NonFinite, 1, 1);
        assert!(grey[0] == grey[1] && grey[0] == grey[2] && grey[0] < 128);
    }
}
