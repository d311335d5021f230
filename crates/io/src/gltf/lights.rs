//! `KHR_lights_punctual` (Khronos Group 2018).

use super::document::Document;
use super::json::Object;
use crate::IoError;
use crate::warnings::Warnings;
use lumbre_core::Rgb;
use lumbre_scene::{Light, LightKind};
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

pub(super) const NAME: &str = "KHR_lights_punctual";

/// Reads every light; light `i` of the file becomes light `i` of the scene.
pub(super) fn load_all(doc: &Document, warnings: &mut Warnings) -> Result<Vec<Light>, IoError> {
    let value = doc.root.extensions.as_ref().and_then(|e| e.others.get(NAME));
    let Some(extension) = Object::new(doc, value, || format!("/extensions/{NAME}"))? else {
        return Ok(Vec::new());
    };
    extension.objects("lights")?.iter().map(|l| load(doc, l, warnings)).collect()
}

fn load(doc: &Document, json: &Object, warnings: &mut Warnings) -> Result<Light, IoError> {
    let kind = match json.string("type")? {
        Some("point") => LightKind::Point,
        Some("directional") => LightKind::Directional,
        Some("spot") => spot(doc, json, warnings)?,
        Some(other) => return Err(doc.unsupported(json.place(), format!("lights of type {other:?}"))),
        None => return Err(doc.error(json.place(), "has no type")),
    };
    // The range is a hint for renderers that cannot afford every light; light itself has none.
    let mut intensity = json.color("color", Rgb::WHITE)? * json.number("intensity", 1.0)?;
    if !intensity.is_finite() || intensity.to_array().iter().any(|&c| c < 0.0) {
        warnings.add(json.place(), "negative or infinite light is set to 0");
        intensity = intensity.map(|c| if c.is_finite() { c.max(0.0) } else { 0.0 });
    }
    Ok(Light { name: json.string("name")?.unwrap_or_default().into(), kind, intensity })
}

fn spot(doc: &Document, json: &Object, warnings: &mut Warnings) -> Result<LightKind, IoError> {
    let Some(spot) = json.object("spot")? else {
        return Err(doc.error(json.place(), "is a spot light without \"spot\""));
    };
    let inner = spot.number("innerConeAngle", 0.0)?;
    let outer = spot.number("outerConeAngle", FRAC_PI_4)?;
    let outer_angle = outer.clamp(0.0, FRAC_PI_2);
    let inner_angle = inner.clamp(0.0, outer_angle);
    if (inner, outer) != (inner_angle, outer_angle) {
        warnings.add(spot.place(), "cone angles out of range are clamped");
    }
    Ok(LightKind::Spot { inner_angle, outer_angle })
}
