//! From a film to a file.

use lumbre_core::color::{Exposure, srgb_encode_u8};
use lumbre_core::film::{Film, PixelSums};
use lumbre_core::rgb::Rgb;
use lumbre_io::{ExrImage, ExrLayer};

/// 8-bit sRGB, three bytes a pixel, row 0 on top: exposure, then the sRGB curve.
pub fn to_srgb8(film: &Film, exposure: Exposure) -> Vec<u8> {
    let radiance = film.radiance();
    let factor = exposure.factor(&radiance, film.width() as usize);
    radiance.iter().flat_map(|p| (*p * factor).to_array().map(srgb_encode_u8)).collect()
}

/// Linear radiance and every plane of the film, as layers: `albedo`, `normal`, `depth`, `position`, `samples`, `error`.
pub fn to_exr(film: &Film, metadata: Vec<(String, String)>) -> ExrImage {
    let colors = |f: fn(&PixelSums) -> Rgb| film.pixels().iter().map(f);
    let single = |name: &str, channel: &str, f: fn(&PixelSums) -> f32| ExrLayer {
        name: name.into(),
        channels: vec![(channel.into(), film.pixels().iter().map(f).collect())],
    };
    ExrImage {
        width: film.width(),
        height: film.height(),
        layers: vec![
            ExrLayer::rgb("", colors(PixelSums::radiance), false),
            ExrLayer::rgb("albedo", colors(PixelSums::albedo), false),
            ExrLayer::rgb("normal", colors(|p| Rgb::from_array(p.normal())), true),
            ExrLayer::rgb("position", colors(|p| Rgb::from_array(p.position())), true),
            single("depth", "Z", PixelSums::depth),
            single("samples", "Y", |p| p.samples() as f32),
            single("error", "Y", PixelSums::error),
        ],
        metadata,
    }
}

/// Whether samples were taken and none of them brought any light.
pub fn is_black(film: &Film) -> bool {
    let taken = film.pixels().iter().any(|p| p.samples() > 0);
    taken && film.pixels().iter().all(|p| p.radiance().max_component() <= 0.0)
}
