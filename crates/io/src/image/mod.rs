//! Pictures in and out, all linear Rec. 709 once in memory.

pub(crate) mod exr;
mod exr_dwa;
mod exr_header;
pub(crate) mod exr_read;
mod hdr;
mod ktx2;
pub(crate) mod ldr;
pub(crate) mod png;
pub(crate) mod save;

use crate::warnings::Warnings;
use crate::{IoError, Limits, files};
use lumbre_core::Rgb;
use lumbre_scene::EnvironmentMap;
use std::path::Path;

/// A picture in linear Rec. 709; values are as the file has them, not even necessarily finite.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearImage {
    /// Columns, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// `width * height` pixels, row by row, the top one first.
    pub pixels: Vec<Rgb>,
}

/// An environment map, and what there is to say about how it was read.
#[derive(Debug)]
pub struct LoadedEnvironment {
    /// The map.
    pub map: EnvironmentMap,
    /// One line each, without the file's name.
    pub warnings: Vec<String>,
}

/// What the values in a picture file stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// Radiance of any size (EXR, HDR).
    Scene,
    /// What a screen shows, black 0 to white 1 (all others).
    Display,
}

/// Reads a picture as [`read_linear_image`] does, and says what its values stand for.
///
/// # Errors
/// As [`read_linear_image`].
pub fn read_picture(
    path: impl AsRef<Path>,
    layer: Option<&str>,
    limits: &Limits,
) -> Result<(LinearImage, Range), IoError> {
    let path = path.as_ref();
    let bytes = files::read_file(path, limits.max_file_bytes)?;
    if exr_read::is_exr(&bytes) {
        return Ok((exr_read::linear(path, exr_read::decode(path, &bytes, limits)?, layer)?, Range::Scene));
    }
    if let Some(layer) = layer {
        return Err(IoError::data(path, "", format!("only EXR files have layers; there is no {layer:?}")));
    }
    if hdr::is_hdr(&bytes) {
        return Ok((hdr::decode(path, &bytes, limits)?, Range::Scene));
    }
    Ok((ldr::decode_linear(&bytes, path, limits)?, Range::Display))
}

/// Reads a picture: EXR, Radiance HDR, or PNG, JPEG, WebP, KTX2, BMP and TGA, whose sRGB curve is undone and whose alpha
/// is ignored.
/// `layer` names a layer of an EXR; `None` is the picture itself.
///
/// # Errors
/// `CannotOpen` if it cannot be read; `BadData` if it is damaged, of another kind, too large, or lacks the layer.
pub fn read_linear_image(
    path: impl AsRef<Path>,
    layer: Option<&str>,
    limits: &Limits,
) -> Result<LinearImage, IoError> {
    read_picture(path, layer, limits).map(|(image, _)| image)
}

/// Reads a latitude-longitude environment map: Radiance HDR, EXR, or PNG and JPEG (whose range is small). Texels that are
/// negative or no finite number become 0, with a warning.
///
/// # Errors
/// As [`read_linear_image`].
pub fn read_environment(path: impl AsRef<Path>, limits: &Limits) -> Result<LoadedEnvironment, IoError> {
    let LinearImage { width, height, mut pixels } = read_linear_image(path, None, limits)?;
    let good = |c: f32| c.is_finite() && c >= 0.0;
    let mut bad = 0usize;
    for p in &mut pixels {
        if !p.to_array().into_iter().all(good) {
            bad += 1;
            *p = p.map(|c| if good(c) { c } else { 0.0 });
        }
    }
    let mut warnings = Warnings::default();
    if bad > 0 {
        let of = pixels.len();
        warnings.add(
            "",
            format!("{bad} of {of} texels are negative or no finite number; these parts are set to 0"),
        );
    }
    if u64::from(width) != 2 * u64::from(height) {
        warnings.add(
            "",
            format!(
                "{width} x {height} is not twice as wide as high; taken as latitude-longitude all the same"
            ),
        );
    }
    let map = EnvironmentMap { width, height, pixels: pixels.into() };
    Ok(LoadedEnvironment { map, warnings: warnings.into_lines() })
}
