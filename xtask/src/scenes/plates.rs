//! `plates.glb`: light and gloss, the picture with which Veach and Guibas 1995 (and Veach 1997, figure 9.2) show why several
//! sampling techniques are to be combined. Four glossy plates, the smoothest above, mirror four round lamps of different size and
//! equal power; under each small lamp light sampling does well on rough plates, under large ones scattering does on smooth plates.
//! Arrangement after the description there; dimensions are this project's own.

use super::kit::{Document, Material, Mesh, Placement, bevel_box, icosphere};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Where the eye is.
const EYE: DVec3 = DVec3::new(0.0, 2.6, 15.0);
/// Radii of the lamps from left to right, the distance between them, their height and place along z.
const LAMPS: [f64; 4] = [0.033, 0.1, 0.3, 0.9];
const SPACING: f64 = 2.6;
const LAMPS_AT: DVec2 = DVec2::new(5.2, 0.0);
/// Radiant power of a lamp, and its colour.
const POWER: f64 = 260.0;
const COLORS: [[f64; 3]; 4] = [[1.0, 0.36, 0.30], [1.0, 0.86, 0.40], [0.42, 1.0, 0.55], [0.45, 0.62, 1.0]];
/// Centres (y, z) and perceptual roughness of the plates, the far and smooth one first.
const PLATES: [([f64; 2], f64); 4] =
    [([1.95, 0.3], 0.07), ([1.13, 2.25], 0.16), ([0.52, 4.35], 0.26), ([0.10, 6.55], 0.38)];
/// Length of the plates along x, and their depth.
const PLATE: DVec2 = DVec2::new(10.4, 1.35);

/// The scene as a `.glb` file.
pub(crate) fn plates() -> Vec<u8> {
    let mut document = Document::default();
    document.camera("camera", [EYE, DVec3::new(0.0, 1.9, 0.0)], 33.0, 4.0 / 3.0);
    room(&mut document);
    lamps(&mut document);
    for (i, ([y, z], roughness)) in PLATES.into_iter().enumerate() {
        plate(&mut document, i, DVec3::new(0.0, y, z), roughness);
    }
    document.to_glb()
}

/// A floor that turns up into a wall behind, matte.
fn room(document: &mut Document) {
    let matte = Material::new("matte", [0.40, 0.40, 0.40], 1.0).specular(0.0);
    let matte = document.material(matte);
    let (radius, back, floor, half) = (2.5, -4.5, -0.7, 22.0);
    let mut profile = vec![(DVec2::new(24.0, floor), DVec2::Y)];
    for i in 0..=24 {
        let (s, c) = libm::sincos(PI / 2.0 * f64::from(i) / 24.0);
        let n = DVec2::new(s, c);
        profile.push((DVec2::new(back + radius, floor + radius) - n * radius, n));
    }
    profile.push((DVec2::new(back, 14.0), DVec2::X));
    let mut sheet = Mesh::default();
    for (p, n) in &profile {
        for x in [-half, half] {
            sheet.push(DVec3::new(x, p.y, p.x), DVec3::new(0.0, n.y, n.x));
        }
    }
    for i in 0..profile.len() as u32 - 1 {
        let at = 2 * i;
        sheet.quad(at, at + 1, at + 3, at + 2);
    }
    document.place("room", &sheet, matte);
}

/// The lamps, and one far behind the eye that lifts the shadows.
fn lamps(document: &mut Document) {
    let first = -SPACING * (LAMPS.len() as f64 - 1.0) / 2.0;
    for (i, radius) in LAMPS.into_iter().enumerate() {
        let at = DVec3::new(first + SPACING * i as f64, LAMPS_AT.x, LAMPS_AT.y);
        lamp(document, &format!("lamp {}", i + 1), at, radius, (COLORS[i], POWER));
    }
    lamp(document, "fill", DVec3::new(-6.0, 12.0, 20.0), 0.5, ([1.0; 3], 1400.0));
}

/// A sphere that shines: power is radiance times its area times pi.
fn lamp(document: &mut Document, name: &str, at: DVec3, radius: f64, (color, power): ([f64; 3], f64)) {
    let radiance = power / (4.0 * PI * PI * radius * radius);
    let light = Material::new(name, [0.0; 3], 1.0).specular(0.0).emissive(color, radiance);
    let light = document.material(light);
    let sphere = icosphere(if radius > 0.5 { 3 } else { 2 });
    let geometry = document.geometry(&sphere);
    document.object(name, &geometry, light, &Placement::at(at).scaled(radius));
}

/// A plate whose normal halves the angle between the eye and the row of lamps.
fn plate(document: &mut Document, index: usize, at: DVec3, roughness: f64) {
    let to_eye = (DVec3::new(0.0, EYE.y, EYE.z) - at).normalize();
    let to_lamps = (DVec3::new(0.0, LAMPS_AT.x, LAMPS_AT.y) - at).normalize();
    let normal = to_eye + to_lamps;
    let tilt = libm::atan2(normal.z, normal.y).to_degrees();
    let metal = Material::metal(&format!("plate {}", index + 1), [0.28, 0.28, 0.29], roughness);
    let metal = document.material(metal);
    let (half, depth) = (PLATE.x / 2.0, PLATE.y / 2.0);
    let body = bevel_box(DVec3::new(-half, -0.08, -depth), DVec3::new(half, 0.0, depth), 0.012);
    let geometry = document.geometry(&body);
    document.object(
        &format!("plate {}", index + 1),
        &geometry,
        metal,
        &Placement::at(at).turned(DVec3::X, tilt),
    );
}
