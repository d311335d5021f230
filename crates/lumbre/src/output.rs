//! From a film to pictures: what a display is sent, and the layers of an EXR.

pub use crate::look::Look;
use crate::look::Negative;
use lumbre_core::color::Exposure;
use lumbre_core::film::{Film, PixelSums};
use lumbre_core::rgb::Rgb;
pub use lumbre_io::{DisplayImage, Picture};
use lumbre_io::{ExrImage, ExrLayer, ExrWindow, IoError, LinearImage};
use std::path::Path;

/// 8 bits a band for a display: lens, exposure and tone curve. With alpha, colours are those of what is there, not multiplied
/// by alpha (PNG's way); without, what is there stands before black. The lens is that of the whole picture, also where the
/// film is a part of it; at the edge of a part, aberration takes the part's last pixels for what lies beyond.
pub fn develop(film: &Film, look: &Look) -> DisplayImage {
    develop_at(film, look, look.exposure_factor(film))
}

/// The same with this factor in the place of the look's exposure.
pub fn develop_at(film: &Film, look: &Look, factor: f32) -> DisplayImage {
    let negative = Negative::new(film, look.transparent);
    let channels = if look.transparent { 4 } else { 3 };
    let bytes = negative.develop(look, factor, channels);
    DisplayImage { width: film.width(), height: film.height(), has_alpha: look.transparent, bytes }
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

/// Writes a film to a file in the format of its ending: PNG or JPEG developed by the look, EXR with every plane, HDR as it is.
///
/// # Errors
/// If the ending is none of these, or the file cannot be written.
pub fn save(film: &Film, look: &Look, path: &Path) -> Result<(), IoError> {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    match ending.as_str() {
        "png" => Picture::Png(&develop(film, look)).write(path),
        "jpg" | "jpeg" => {
            Picture::Jpeg(&develop(film, &Look { transparent: false, ..*look }), QUALITY).write(path)
        }
        "exr" => Picture::Exr(to_exr(film, look.transparent, Vec::new())).write(path),
        "hdr" => Picture::Hdr(&to_linear(film)).write(path),
        _ => Err(IoError::write(path, "its ending is not one of .png, .jpg, .jpeg, .exr, .hdr")),
    }
}

/// Quality of a JPEG where none is asked for.
pub const QUALITY: u8 = 92;

/// Whether samples were taken and none of them brought any light.
pub fn is_black(film: &Film) -> bool {
    let taken = film.pixels().iter().any(|p| p.samples() > 0);
    taken && film.pixels().iter().all(|p| p.radiance().max_component() <= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_core::film::{Crop, FilmSample};
    use lumbre_core::tone::ToneCurve;

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
