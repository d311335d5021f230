//! How a film is developed for a display: lens, exposure, tone curve.

use lumbre_core::color::Exposure;
use lumbre_core::film::{Film, PixelSums};
use lumbre_core::rgb::Rgb;
use lumbre_core::tone::{ToneCurve, aberration_shrinks, vignette};
use rayon::prelude::*;

/// How a film is developed for a display: lens, exposure, tone curve.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Look {
    /// Brightness.
    pub exposure: Exposure,
    /// Tone curve.
    pub tone: ToneCurve,
    /// Darkening towards the corners, which keep 1 - this of their light: 0 (none) to 1 ([`vignette`]).
    pub vignette: f32,
    /// Red is enlarged about the centre by this many per cent and blue made smaller by as much: 0 is none, negative the other
    /// way round, at most [`Look::MAX_ABERRATION`] either way.
    pub aberration: f32,
    /// The picture has alpha: that of the film.
    pub transparent: bool,
}

impl Look {
    /// Most of [`Look::aberration`], per cent.
    pub const MAX_ABERRATION: f32 = lumbre_core::tone::MAX_ABERRATION;

    /// The factor of its exposure on this film. The lens does not change it.
    pub fn exposure_factor(&self, film: &Film) -> f32 {
        self.exposure.factor(&film.radiance(), film.width() as usize)
    }
}

/// What of a film is needed to develop it, again and again where the look changes.
#[derive(Clone, Debug)]
pub(crate) struct Negative {
    size: [u32; 2],
    picture: [u32; 2],
    origin: [u32; 2],
    radiance: Vec<Rgb>,
    /// Empty: 1 everywhere.
    alpha: Vec<f32>,
}

impl Negative {
    /// Of a film, with alpha if that will be asked for.
    pub(crate) fn new(film: &Film, with_alpha: bool) -> Self {
        let alpha =
            if with_alpha { film.pixels().par_iter().map(PixelSums::alpha).collect() } else { Vec::new() };
        Negative {
            size: [film.width(), film.height()],
            picture: film.picture_size(),
            origin: film.origin(),
            radiance: film.pixels().par_iter().map(PixelSums::radiance).collect(),
            alpha,
        }
    }

    /// Columns and rows.
    pub(crate) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The factor of the look's exposure on it.
    pub(crate) fn exposure_factor(&self, look: &Look) -> f32 {
        look.exposure.factor(&self.radiance, self.size[0] as usize)
    }

    /// Three or four bytes a pixel, with this factor in place of the look's exposure.
    pub(crate) fn develop(&self, look: &Look, factor: f32, channels: usize) -> Vec<u8> {
        let lens = Lens::new(self, look);
        let mut bytes = vec![255; self.radiance.len() * channels];
        bytes.par_chunks_exact_mut(channels).enumerate().for_each(|(i, pixel)| {
            let mut color = lens.color(i) * factor;
            if let [_, _, _, shown] = pixel
                && look.transparent
            {
                let alpha = lens.alpha(i);
                *shown = code(alpha);
                color = if alpha > 0.0 { color / alpha } else { Rgb::BLACK };
            }
            let color = look.tone.display(color).to_array();
            pixel.iter_mut().zip(color).for_each(|(p, v)| *p = code(v));
        });
        bytes
    }
}

/// A negative seen through vignette and chromatic aberration.
struct Lens<'a> {
    negative: &'a Negative,
    vignette: f32,
    /// `None`: no aberration, pixels are as they are.
    shrinks: Option<[f32; 3]>,
    /// From the film's top left corner to the centre of the picture, pixels.
    center: [f32; 2],
    half_diagonal: f32,
}

impl<'a> Lens<'a> {
    fn new(negative: &'a Negative, look: &Look) -> Self {
        let (size, origin) = (negative.picture.map(|n| n as f32), negative.origin.map(|n| n as f32));
        let aberration = look.aberration.clamp(-Look::MAX_ABERRATION, Look::MAX_ABERRATION);
        Lens {
            negative,
            vignette: look.vignette.clamp(0.0, 1.0),
            shrinks: (aberration != 0.0).then(|| aberration_shrinks(aberration)),
            center: [0, 1].map(|i| 0.5 * size[i] - origin[i]),
            half_diagonal: 0.5 * (size[0] * size[0] + size[1] * size[1]).sqrt(),
        }
    }

    /// From the centre of the picture to that of a pixel.
    fn offset(&self, i: usize) -> [f32; 2] {
        let width = self.negative.size[0] as usize;
        [(i % width) as f32 + 0.5 - self.center[0], (i / width) as f32 + 0.5 - self.center[1]]
    }

    fn color(&self, i: usize) -> Rgb {
        let offset = self.offset(i);
        let color = match self.shrinks {
            None => self.negative.radiance[i],
            Some(shrinks) => {
                let band = |c: usize| self.bilinear(offset, shrinks[c], |i| self.negative.radiance[i][c]);
                Rgb::new(band(0), band(1), band(2))
            }
        };
        if self.vignette == 0.0 {
            return color;
        }
        color * vignette(self.vignette, offset.map(|v| v / self.half_diagonal))
    }

    /// The most that any band has of it, so that fringes are not cut off.
    fn alpha(&self, i: usize) -> f32 {
        let alpha = |i: usize| self.negative.alpha.get(i).copied().unwrap_or(1.0);
        match self.shrinks {
            None => alpha(i),
            Some(shrinks) => {
                shrinks.map(|s| self.bilinear(self.offset(i), s, alpha)).into_iter().fold(0.0, f32::max)
            }
        }
    }

    /// What an enlargement about the centre brings to a place.
    fn bilinear(&self, offset: [f32; 2], shrink: f32, value: impl Fn(usize) -> f32) -> f32 {
        let size = self.negative.size;
        // In units of pixels, the centre of the first one at 0.
        let at = [0, 1].map(|k| {
            let x = offset[k] * shrink + self.center[k] - 0.5;
            x.clamp(0.0, (size[k] - 1) as f32)
        });
        let [low, high] = [at.map(|x| x as u32), [0, 1].map(|k| (at[k] as u32 + 1).min(size[k] - 1))];
        let [u, v] = [0, 1].map(|k| at[k] - low[k] as f32);
        let pixel = |x: u32, y: u32| value(y as usize * size[0] as usize + x as usize);
        let row = |y: u32| pixel(low[0], y) * (1.0 - u) + pixel(high[0], y) * u;
        row(low[1]) * (1.0 - v) + row(high[1]) * v
    }
}

/// 0..1 as 8 bits.
fn code(x: f32) -> u8 {
    (x * 255.0 + 0.5) as u8
}
