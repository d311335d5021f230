//! From a film to pictures: what a display is sent, and the layers of an EXR.

use lumbre_core::color::Exposure;
use lumbre_core::film::{Film, PixelSums};
use lumbre_core::rgb::Rgb;
use lumbre_core::tone::{ToneCurve, aberration_shrinks, vignette};
pub use lumbre_io::{DisplayImage, Picture};
use lumbre_io::{ExrImage, ExrLayer, ExrWindow, LinearImage};
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

/// 8 bits a band for a display: lens, exposure and tone curve. With alpha, colours are those of what is there, not multiplied
/// by alpha (PNG's way); without, what is there stands before black. The lens is that of the whole picture, also where the
/// film is a part of it; at the edge of a part, aberration takes the part's last pixels for what lies beyond.
pub fn develop(film: &Film, look: &Look) -> DisplayImage {
    let radiance = film.radiance();
    let factor = look.exposure.factor(&radiance, film.width() as usize);
    let lens = Lens::new(film, &radiance, look);
    let channels = if look.transparent { 4 } else { 3 };
    let mut bytes = vec![0; radiance.len() * channels];
    bytes.par_chunks_exact_mut(channels).enumerate().for_each(|(i, pixel)| {
        let mut color = lens.color(i) * factor;
        if let [_, _, _, shown] = pixel {
            let alpha = lens.alpha(i);
            *shown = code(alpha);
            color = if alpha > 0.0 { color / alpha } else { Rgb::BLACK };
        }
        let color = look.tone.display(color).to_array();
        pixel.iter_mut().zip(color).for_each(|(p, v)| *p = code(v));
    });
    DisplayImage { width: film.width(), height: film.height(), has_alpha: look.transparent, bytes }
}

/// 0..1 as 8 bits.
fn code(x: f32) -> u8 {
    (x * 255.0 + 0.5) as u8
}

/// A film seen through vignette and chromatic aberration.
struct Lens<'a> {
    film: &'a Film,
    radiance: &'a [Rgb],
    vignette: f32,
    /// `None`: no aberration, pixels are as they are.
    shrinks: Option<[f32; 3]>,
    /// From the film's top left corner to the centre of the picture, pixels.
    center: [f32; 2],
    half_diagonal: f32,
}

impl<'a> Lens<'a> {
    fn new(film: &'a Film, radiance: &'a [Rgb], look: &Look) -> Self {
        let (size, origin) = (film.picture_size().map(|n| n as f32), film.origin().map(|n| n as f32));
        let aberration = look.aberration.clamp(-Look::MAX_ABERRATION, Look::MAX_ABERRATION);
        Lens {
            film,
            radiance,
            vignette: look.vignette.clamp(0.0, 1.0),
            shrinks: (aberration != 0.0).then(|| aberration_shrinks(aberration)),
            center: [0, 1].map(|i| 0.5 * size[i] - origin[i]),
            half_diagonal: 0.5 * (size[0] * size[0] + size[1] * size[1]).sqrt(),
        }
    }

    /// From the centre of the picture to that of a pixel.
    fn offset(&self, i: usize) -> [f32; 2] {
        let width = self.film.width() as usize;
        [(i % width) as f32 + 0.5 - self.center[0], (i / width) as f32 + 0.5 - self.center[1]]
    }

    fn color(&self, i: usize) -> Rgb {
        let offset = self.offset(i);
        let color = match self.shrinks {
            None => self.radiance[i],
            Some(shrinks) => {
                let band = |c: usize| self.bilinear(offset, shrinks[c], |i| self.radiance[i][c]);
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
        let alpha = |i: usize| self.film.pixels()[i].alpha();
        match self.shrinks {
            None => alpha(i),
            Some(shrinks) => {
                shrinks.map(|s| self.bilinear(self.offset(i), s, alpha)).into_iter().fold(0.0, f32::max)
            }
        }
    }

    /// What an enlargement about the centre brings to a place.
    fn bilinear(&self, offset: [f32; 2], shrink: f32, value: impl Fn(usize) -> f32) -> f32 {
        let size = [self.film.width(), self.film.height()];
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

/// 8-bit sRGB, three bytes a pixel, row 0 on top: exposure, then the sRGB curve.
pub fn to_srgb8(film: &Film, exposure: Exposure) -> Vec<u8> {
    develop(film, &Look { exposure, ..Look::default() }).bytes
}

/// Linear radiance, before black where the background is left out.
pub fn to_linear(film: &Film) -> LinearImage {
    LinearImage { width: film.width(), height: film.height(), pixels: film.radiance() }
}

/// Linear radiance and every plane of the film, as layers: `albedo`, `normal`, `depth`, `position`, `samples`, `error`. A
/// `transparent` picture has alpha, which is multiplied into radiance (EXR's way). A part of a picture says where it lies.
pub fn to_exr(film: &Film, transparent: bool, metadata: Vec<(String, String)>) -> ExrImage {
    let colors = |f: fn(&PixelSums) -> Rgb| film.pixels().iter().map(f);
    let plane = |f: fn(&PixelSums) -> f32| film.pixels().iter().map(f).collect::<Vec<f32>>();
    let single = |name: &str, channel: &str, f: fn(&PixelSums) -> f32| ExrLayer {
        name: name.into(),
        channels: vec![(channel.into(), plane(f))],
    };
    let mut picture = ExrLayer::rgb("", colors(PixelSums::radiance), false);
    if transparent {
        picture.channels.push(("A".into(), plane(PixelSums::alpha)));
    }
    let whole = (film.origin(), film.picture_size()) == ([0, 0], [film.width(), film.height()]);
    let window = ExrWindow { picture: film.picture_size(), origin: film.origin().map(|n| n as i32) };
    ExrImage {
        width: film.width(),
        height: film.height(),
        window: (!whole).then_some(window),
        layers: vec![
            picture,
            ExrLayer::rgb("albedo", colors(PixelSums::albedo), false),
            ExrLayer::rgb("normal", colors(|p| Rgb::from_array(p.normal())), true),
            ExrLayer::rgb("position", colors(|p| Rgb::from_array(p.position())), true),
            single("depth", "Z", PixelSums::depth),
            single("samples", "Y", |p| p.samples() as f32),
            single("error", "Y", PixelSums::error),
        ],
        whole: Vec::new(),
        metadata,
    }
}

/// Whether samples were taken and none of them brought any light.
pub fn is_black(film: &Film) -> bool {
    let taken = film.pixels().iter().any(|p| p.samples() > 0);
    taken && film.pixels().iter().all(|p| p.radiance().max_component() <= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_core::film::{Crop, FilmSample};

    /// One sample a pixel.
    fn film(picture: [u32; 2], crop: Crop, sample: impl Fn([u32; 2]) -> (Rgb, f32)) -> Film {
        let mut film = Film::window(picture, crop);
        for y in 0..crop.size[1] {
            for x in 0..crop.size[0] {
                let (radiance, alpha) = sample([crop.origin[0] + x, crop.origin[1] + y]);
                film.add([x, y], 0, &FilmSample { radiance, first_hit: None, alpha });
            }
        }
        film
    }

    fn whole(size: [u32; 2], sample: impl Fn([u32; 2]) -> (Rgb, f32)) -> Film {
        film(size, Crop { origin: [0, 0], size }, sample)
    }

    const PLAIN: Look = Look {
        exposure: Exposure::Ev(0.0),
        tone: ToneCurve::Srgb,
        vignette: 0.0,
        aberration: 0.0,
        transparent: false,
    };

    fn ramp([x, y]: [u32; 2]) -> (Rgb, f32) {
        (Rgb::new(0.02 * x as f32, 0.03 * y as f32, 0.01 * (x + y) as f32), 1.0)
    }

    #[test]
    fn exposure_comes_before_the_curve() {
        let grey = whole([3, 2], |_| (Rgb::splat(0.25), 1.0));
        let red = |look: Look| develop(&grey, &look).bytes[0];
        assert_eq!(red(PLAIN), 137);
        assert_eq!(red(Look { exposure: Exposure::Ev(1.0), ..PLAIN }), 188);
        assert_eq!(red(Look { tone: ToneCurve::Linear, ..PLAIN }), 136);
        assert_eq!(develop(&grey, &PLAIN).bytes, to_srgb8(&grey, Exposure::Ev(0.0)));
        assert_eq!(develop(&grey, &PLAIN).bytes.len(), 18);
    }

    #[test]
    fn alpha_is_straight_in_a_display_picture_and_premultiplied_in_an_exr() {
        // A quarter of the pixel is a surface of radiance 0.5.
        let film = whole([2, 1], |[x, _]| if x == 0 { (Rgb::splat(0.125), 0.25) } else { (Rgb::BLACK, 0.0) });
        let image = develop(&film, &Look { transparent: true, ..PLAIN });
        assert!(image.has_alpha);
        assert_eq!(image.bytes, [188, 188, 188, 64, 0, 0, 0, 0]);
        let opaque = develop(&film, &PLAIN);
        assert_eq!(opaque.bytes, [99, 99, 99, 0, 0, 0], "before black");
        let exr = to_exr(&film, true, Vec::new());
        assert_eq!(exr.layers[0].channel("A"), Some(&[0.25, 0.0][..]));
        assert_eq!(exr.layers[0].channel("R"), Some(&[0.125, 0.0][..]));
        assert_eq!(to_exr(&film, false, Vec::new()).layers[0].channel("A"), None);
    }

    #[test]
    fn vignette_darkens_radiance_towards_the_corners() {
        // Corners of 100 x 100 pixel centres are at 0.99 of the half diagonal.
        let film = whole([100, 100], |_| (Rgb::splat(0.8), 1.0));
        let image = develop(&film, &Look { vignette: 0.5, ..PLAIN });
        let at = |x: usize, y: usize| image.bytes[3 * (100 * y + x)];
        let want = |radiance: f32| lumbre_core::color::srgb_encode_u8(radiance);
        assert_eq!(at(50, 50), want(0.8));
        assert_eq!(at(0, 0), want(0.8 * (1.0 - 0.5 * 0.99 * 0.99)));
        assert_eq!((at(99, 0), at(0, 99), at(99, 99)), (at(0, 0), at(0, 0), at(0, 0)));
        assert_eq!(at(0, 50), want(0.8 * (1.0 - 0.5 * 0.49)), "the middle of an edge");
    }

    #[test]
    fn aberration_moves_red_out_and_blue_in() {
        // A white line, 20 pixels right of the centre of 101 columns.
        let film = whole([101, 9], |[x, _]| (Rgb::splat(if x == 70 { 1.0 } else { 0.0 }), 1.0));
        let image = develop(&film, &Look { aberration: 10.0, tone: ToneCurve::Linear, ..PLAIN });
        let brightest = |band: usize| (0..101).max_by_key(|x| image.bytes[3 * (4 * 101 + x) + band]).unwrap();
        assert_eq!([0, 1, 2].map(brightest), [72, 70, 68]);
        // A linear ramp stays one: bilinear look-up.
        let ramped = whole([101, 9], ramp);
        let lens = develop(&ramped, &Look { aberration: 10.0, tone: ToneCurve::Srgb, ..PLAIN });
        let red = f32::from(lens.bytes[3 * (4 * 101 + 40)]);
        let want = f32::from(lumbre_core::color::srgb_encode_u8(0.02 * (50.0 - 10.0 / 1.1)));
        assert!((red - want).abs() <= 1.0, "{red} {want}");
        assert_eq!(develop(&ramped, &PLAIN), develop(&ramped, &Look { aberration: 0.0, ..PLAIN }));
    }

    #[test]
    fn a_part_has_the_lens_of_the_whole() {
        let crop = Crop { origin: [20, 4], size: [30, 9] };
        let (all, part) = (whole([64, 16], ramp), film([64, 16], crop, ramp));
        let look = Look { vignette: 0.7, aberration: 3.0, transparent: true, ..PLAIN };
        let (all, part) = (develop(&all, &look), develop(&part, &look));
        // One pixel from the edges, beyond which the part knows nothing; the shift is less than that.
        for y in 1..8 {
            for x in 1..29 {
                let pixel = |i: &DisplayImage, x: u32, y: u32| {
                    let at = 4 * (y * i.width + x) as usize;
                    i.bytes[at..at + 4].to_vec()
                };
                assert_eq!(pixel(&part, x, y), pixel(&all, x + 20, y + 4), "{x} {y}");
            }
        }
        let exr = to_exr(&film([64, 16], crop, ramp), false, Vec::new());
        assert_eq!(exr.window, Some(ExrWindow { picture: [64, 16], origin: [20, 4] }));
        assert_eq!(to_exr(&whole([4, 4], ramp), false, Vec::new()).window, None);
    }
}
