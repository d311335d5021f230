//! Sky and sun of a scene, for which glTF has no word: `extras` of the glTF scene, in an object of our own. Left out: environment
//! maps, which are files of their own.
//!
//! ```json
//! "extras": { "lumbre": { "sky": "gradient", "sun": { "elevation": 20, "azimuth": 130, "strength": 15 } } }
//! ```
//!
//! `sky` may also be a linear radiance `[r, g, b]`. Angles are in degrees, the azimuth from -z towards +x, the strength in lux
//! ([`Sun::daylight`]); azimuth and strength may be left out. Other programs' extras are none of our business.

use super::document::Document;
use super::json::Object;
use crate::IoError;
use crate::warnings::Warnings;
use gltf::json::Value;
use lumbre_core::Rgb;
use lumbre_scene::{Background, Environment, Sun};

/// The key of our object in the extras.
const NAME: &str = "lumbre";

/// The light from far away of scene `index`.
pub(super) fn load(
    doc: &Document,
    index: Option<usize>,
    warnings: &mut Warnings,
) -> Result<Environment, IoError> {
    let mut environment = Environment::default();
    let extras = index.and_then(|i| doc.root.scenes.get(i)?.extras.as_ref().map(|e| (i, e)));
    let Some((index, extras)) = extras else { return Ok(environment) };
    let place = || format!("/scenes/{index}/extras/{NAME}");
    let extras: Value = gltf::json::deserialize::from_str(extras.get()).map_err(|e| doc.error(place(), e))?;
    let Some(json) = Object::new(doc, extras.get(NAME), place)? else { return Ok(environment) };
    if let Some(value) = json.value("sky") {
        environment.background = sky(&json, value, warnings)?;
    }
    if let Some(json) = json.object("sun")? {
        environment.sun = Some(sun(&json, warnings)?);
    }
    json.warn_of_others(&["sky", "sun"], warnings);
    Ok(environment)
}

fn sky(json: &Object, value: &Value, warnings: &mut Warnings) -> Result<Background, IoError> {
    if value == "gradient" {
        return Ok(Background::Gradient);
    }
    if !value.is_array() {
        return Err(json.error("sky", "should be \"gradient\" or a list of 3 numbers"));
    }
    let color = json.color("sky", Rgb::BLACK)?;
    let mended = color.map(|c| c.max(0.0));
    if mended != color {
        warnings.add(format!("{}/sky", json.place()), "negative light is set to 0");
    }
    Ok(Background::Constant(mended))
}

fn sun(json: &Object, warnings: &mut Warnings) -> Result<Sun, IoError> {
    if json.value("elevation").is_none() {
        return Err(json.error("elevation", "is missing"));
    }
    let said = json.number("elevation", 0.0)?;
    let elevation = said.clamp(-90.0, 90.0);
    if elevation != said {
        warnings.add(json.place(), "an elevation beyond 90 degrees is clamped");
    }
    let azimuth = json.number("azimuth", 0.0)?;
    let mut strength = json.number("strength", Sun::STRENGTH)?;
    if strength < 0.0 {
        warnings.add(json.place(), "negative light is set to 0");
        strength = 0.0;
    }
    json.warn_of_others(&["elevation", "azimuth", "strength"], warnings);
    Ok(Sun::daylight(elevation, azimuth, strength))
}
