//! `cornell.glb`: the scene of the first command. A room open towards the camera with one teal and one coral wall, a warm panel of light
//! under the ceiling and a floor of patterned cement tiles; in it a copper trefoil on a plinth, a glazed vase, a clear glass ball and
//! two small glazed ones. Metres; dimensions and colours are this project's own.

mod obj;
mod png;
mod tile;

use crate::scenes::kit::{
    Document, Geometry, Mesh, Placement, icosphere, rectangle, revolve, rounded_box, trefoil,
};

use glam::{DVec2, DVec3};
use serde_json::{Value, json};

/// Half the width, the height and the two ends of the room along z; the camera stands beyond `FRONT`.
const HALF_WIDTH: f64 = 1.6;
const HEIGHT: f64 = 2.3;
const BACK: f64 = -1.6;
const FRONT: f64 = 1.9;
/// Side of a floor tile.
const TILE: f64 = 0.4;

/// The scene as a `.glb` file.
pub(crate) fn cornell() -> Vec<u8> {
    let mut document = Document::default();
    room(&mut document);
    lamp(&mut document);
    still_life(&mut document);
    document.camera("camera", [DVec3::new(0.0, 1.45, 4.9), DVec3::new(0.0, 0.96, 0.0)], 36.5, 4.0 / 3.0);
    document.to_glb()
}

/// The same room as Wavefront OBJ: mesh, materials, picture of the floor.
pub(crate) fn as_obj() -> Vec<u8> {
    obj::obj(&cornell())
}

/// Its materials.
pub(crate) fn as_mtl() -> Vec<u8> {
    obj::mtl(&cornell())
}

/// Its picture.
pub(crate) fn as_png() -> Vec<u8> {
    obj::picture(&cornell())
}

/// A dielectric material with the given linear colour and roughness.
fn dielectric(name: &str, rgb: [f64; 3], roughness: f64) -> Value {
    let [r, g, b] = rgb;
    json!({
        "name": name,
        "pbrMetallicRoughness": { "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": roughness },
    })
}

/// Floor, ceiling and three walls, all facing inward.
fn room(document: &mut Document) {
    let depth = FRONT - BACK;
    let (x, y, z) = (DVec3::X * 2.0 * HALF_WIDTH, DVec3::Y * HEIGHT, DVec3::Z * depth);
    let (left, right) = (DVec3::new(-HALF_WIDTH, 0.0, BACK), DVec3::new(HALF_WIDTH, 0.0, BACK));
    let walls = [
        ("back wall", [0.72, 0.67, 0.58], rectangle(left, x, y)),
        ("left wall", [0.045, 0.21, 0.25], rectangle(left, y, z)),
        ("right wall", [0.64, 0.125, 0.075], rectangle(right, z, y)),
        ("ceiling", [0.76, 0.73, 0.67], rectangle(left + y, x, z)),
    ];
    for (name, rgb, mesh) in walls {
        let material = document.material(dielectric(name, rgb, 1.0));
        place(document, name, &mesh, material);
    }
    let mut floor = rectangle(left, z, x);
    // Tiles begin at the middle of the back wall, so that both sides end alike.
    floor.uvs = floor.positions.iter().map(|p| DVec2::new(p.x, p.z - BACK) / TILE).collect();
    let texture = document.texture("cement tile", &png::encode(&tile::tile()));
    let mut tiles = dielectric("cement tiles", [1.0; 3], 0.42);
    tiles["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": texture });
    let material = document.material(tiles);
    place(document, "floor", &floor, material);
}

/// A slim frame under the ceiling with the panel of light in it.
fn lamp(document: &mut Document) {
    let (half, thickness) = (DVec2::new(0.65, 0.38), 0.05);
    let (rim, centre_z) = (0.03, -0.1);
    let frame = rounded_box(DVec3::new(half.x + rim, thickness / 2.0, half.y + rim), 0.012, 2);
    let material = document.material(dielectric("lamp frame", [0.8, 0.78, 0.74], 0.5));
    let geometry = document.geometry(&frame);
    let frame_centre = DVec3::new(0.0, HEIGHT - thickness / 2.0, centre_z);
    document.object("lamp frame", &geometry, material, &Placement::at(frame_centre));

    let light = document.material(json!({
        "name": "lamp",
        "pbrMetallicRoughness": { "baseColorFactor": [0.0, 0.0, 0.0, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0 },
        "emissiveFactor": [1.0, 0.85, 0.66],
        "extensions": {
            "KHR_materials_emissive_strength": { "emissiveStrength": 14.0 },
            "KHR_materials_specular": { "specularFactor": 0.0 },
        },
    }));
    // One millimetre below the frame.
    let corner = DVec3::new(-half.x, HEIGHT - thickness - 0.001, centre_z - half.y);
    place(document, "lamp", &rectangle(corner, DVec3::X * 2.0 * half.x, DVec3::Z * 2.0 * half.y), light);
}

/// The objects.
fn still_life(document: &mut Document) {
    // Plinth and, standing on it, the trefoil.
    let plinth = rounded_box(DVec3::new(0.38, 0.27, 0.38), 0.025, 4);
    let stone = document.material(dielectric("slate", [0.075, 0.085, 0.09], 0.35));
    let plinth_at = DVec3::new(-0.55, 0.27, -0.35);
    let geometry = document.geometry(&plinth);
    document.object("plinth", &geometry, stone, &Placement::at(plinth_at).turned_y(24.0));

    let knot = trefoil(0.42, 0.22, 160, 16);
    let lowest = knot.positions.iter().fold(f64::INFINITY, |low, p| low.min(p.y));
    let copper = document.material(json!({
        "name": "copper",
        "pbrMetallicRoughness": { "baseColorFactor": [0.932, 0.623, 0.522, 1.0], "metallicFactor": 1.0, "roughnessFactor": 0.26 },
    }));
    let scale = 0.36;
    let geometry = document.geometry(&knot);
    let standing = Placement::at(plinth_at + DVec3::Y * (0.27 - lowest * scale)).scaled(scale).turned_y(12.0);
    document.object("trefoil", &geometry, copper, &standing);

    let glaze = document.material(dielectric("blue glaze", [0.012, 0.075, 0.22], 0.15));
    let geometry = document.geometry(&vase());
    document.object("vase", &geometry, glaze, &Placement::at(DVec3::new(0.90, 0.0, -0.62)).scaled(1.36));

    let sphere = document.geometry(&icosphere(4));
    let glass = document.material(json!({
        "name": "glass",
        "pbrMetallicRoughness": { "baseColorFactor": [1.0, 1.0, 1.0, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.0 },
        "extensions": {
            "KHR_materials_transmission": { "transmissionFactor": 1.0 },
            "KHR_materials_ior": { "ior": 1.5 },
            // In the space of the mesh, a unit sphere.
            "KHR_materials_volume": { "thicknessFactor": 2.0 },
        },
    }));
    ball(document, &sphere, glass, ("glass ball", DVec2::new(0.40, 0.42), 0.37));
    let saffron = document.material(dielectric("saffron glaze", [0.80, 0.36, 0.03], 0.15));
    ball(document, &sphere, saffron, ("saffron ball", DVec2::new(-0.30, 0.72), 0.17));
    let white = document.material(dielectric("white glaze", [0.78, 0.76, 0.72], 0.15));
    ball(document, &sphere, white, ("white ball", DVec2::new(-0.92, 0.50), 0.12));
}

/// A vase of height 0.87 around the y axis: foot, belly, neck, lip, and the inside of the neck.
fn vase() -> Mesh {
    let profile = [
        (0.0, 0.0),
        (0.09, 0.0),
        (0.165, 0.0),
        (0.175, 0.03),
        (0.245, 0.15),
        (0.325, 0.36),
        (0.30, 0.55),
        (0.17, 0.68),
        (0.095, 0.75),
        (0.105, 0.82),
        (0.165, 0.872),
        (0.15, 0.876),
        (0.085, 0.82),
        (0.075, 0.74),
        (0.10, 0.62),
        (0.0, 0.58),
    ];
    revolve(&profile.map(DVec2::from), 4, 48)
}

/// A ball on the floor: name, place on the floor (x, z), radius.
fn ball(document: &mut Document, sphere: &Geometry, material: usize, (name, at, radius): (&str, DVec2, f64)) {
    document.object(name, sphere, material, &Placement::at(DVec3::new(at.x, radius, at.y)).scaled(radius));
}

/// Adds a mesh that is already in world coordinates.
fn place(document: &mut Document, name: &str, mesh: &Mesh, material: usize) {
    let geometry = document.geometry(mesh);
    document.object(name, &geometry, material, &Placement::at(DVec3::ZERO));
}
