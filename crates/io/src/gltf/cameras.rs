//! Cameras (glTF 2.0, 3.10). Near and far planes are not read: rays begin at the camera and end nowhere.

use super::document::Document;
use crate::IoError;
use crate::warnings::Warnings;
use gltf::json::camera::{Orthographic, Perspective, Type};
use gltf::json::validation::Checked;
use lumbre_scene::{Camera, Projection};

/// Reads every camera; camera `i` of the file becomes camera `i` of the scene.
pub(super) fn load_all(doc: &Document, warnings: &mut Warnings) -> Result<Vec<Camera>, IoError> {
    let mut cameras = Vec::with_capacity(doc.root.cameras.len());
    for (i, json) in doc.root.cameras.iter().enumerate() {
        let place = format!("/cameras/{i}");
        let projection = match (&json.type_, &json.perspective, &json.orthographic) {
            (Checked::Valid(Type::Perspective), Some(p), _) => perspective(doc, p, &place, warnings)?,
            (Checked::Valid(Type::Orthographic), _, Some(o)) => orthographic(doc, o, &place, warnings)?,
            _ => return Err(doc.error(place, "is neither a perspective nor an orthographic camera")),
        };
        let name = json.name.clone().unwrap_or_default();
        cameras.push(Camera { name, projection, lens_radius: 0.0, focus_distance: 1.0 });
    }
    Ok(cameras)
}

fn perspective(
    doc: &Document,
    json: &Perspective,
    place: &str,
    warnings: &mut Warnings,
) -> Result<Projection, IoError> {
    let yfov = json.yfov;
    if !(yfov > 0.0 && yfov < std::f32::consts::PI) {
        return Err(doc.error(format!("{place}/perspective"), format!("yfov {yfov} is not between 0 and π")));
    }
    let aspect = json.aspect_ratio.filter(|a| a.is_finite() && *a > 0.0);
    if aspect != json.aspect_ratio {
        warnings.add(place, "the aspect ratio is not positive and is ignored");
    }
    Ok(Projection::Perspective { yfov, aspect })
}

fn orthographic(
    doc: &Document,
    json: &Orthographic,
    place: &str,
    warnings: &mut Warnings,
) -> Result<Projection, IoError> {
    let (xmag, ymag) = (json.xmag, json.ymag);
    if [xmag, ymag].iter().any(|m| *m == 0.0 || !m.is_finite()) {
        let why = format!("xmag {xmag} and ymag {ymag} make no picture");
        return Err(doc.error(format!("{place}/orthographic"), why));
    }
    // glTF advises against the mirrored pictures that these would ask for.
    if xmag < 0.0 || ymag < 0.0 {
        warnings.add(place, "the signs of negative magnifications are ignored");
    }
    Ok(Projection::Orthographic { xmag: xmag.abs(), ymag: ymag.abs() })
}
