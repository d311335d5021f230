//! `leaves.gltf`: leaves against the light (`KHR_materials_diffuse_transmission`), in the colours of two seasons (`KHR_materials_variants`).
//!
//! A panel of light stands behind two curved leaves, a ball between the panel and the larger leaf: its shadow shows through, and where the leaves
//! overlap they are darker. A sheet of paper on the floor glows from below.

use super::kit::{Document, Mesh, Placement, icosphere, rectangle};
use glam::{DVec2, DVec3};
use serde_json::{Value, json};
use std::f64::consts::PI;

/// The scene as a `.gltf` file.
pub(crate) fn leaves() -> Vec<u8> {
    let mut document = Document::default();
    document.variant("summer");
    document.variant("autumn");
    let floor = document.material(matte("floor", [0.5, 0.48, 0.45]));
    let ball = document.material(matte("ball", [0.3, 0.3, 0.32]));
    let paper = document.material(sheet("paper", [0.8, 0.8, 0.76], [0.9, 0.86, 0.7], 0.5));
    let summer = document.material(sheet("summer leaf", [0.05, 0.22, 0.03], [0.35, 0.72, 0.06], 0.6));
    let autumn = document.material(sheet("autumn leaf", [0.35, 0.1, 0.02], [0.85, 0.33, 0.03], 0.6));
    let lamp = document.material(json!({
        "name": "lamp",
        "pbrMetallicRoughness": { "baseColorFactor": [0.0, 0.0, 0.0, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0 },
        "emissiveFactor": [1.0, 0.97, 0.9],
        "extensions": {
            "KHR_materials_emissive_strength": { "emissiveStrength": 40.0 },
            "KHR_materials_specular": { "specularFactor": 0.0 },
        },
    }));
    let here = || Placement::at(DVec3::ZERO);
    let geometry =
        document.geometry(&rectangle(DVec3::new(-4.0, 0.0, 3.0), DVec3::X * 8.0, DVec3::NEG_Z * 7.0));
    document.object("floor", &geometry, floor, &here());
    let geometry = document.geometry(&rectangle(DVec3::new(-0.6, 2.6, -2.6), DVec3::X * 1.2, DVec3::Y * 1.2));
    document.object("lamp", &geometry, lamp, &here());
    let geometry = document.geometry(&icosphere(3));
    document.object("ball", &geometry, ball, &Placement::at(DVec3::new(-0.42, 1.35, -0.55)).scaled(0.13));
    document.object("ball", &geometry, ball, &Placement::at(DVec3::new(0.35, 0.12, 0.95)).scaled(0.12));
    let leaf = document.geometry(&leaf());
    let places = [(DVec3::new(-0.35, 0.25, 0.0), 1.6, 8.0), (DVec3::new(0.18, 0.15, 0.2), 1.25, -14.0)];
    for (at, size, turn) in places {
        let placement = Placement::at(at).scaled(size).turned_y(turn);
        document.object_of_variants("leaf", &leaf, &[summer, autumn], &placement);
    }
    let geometry = document.geometry(&arch());
    document.object("paper", &geometry, paper, &Placement::at(DVec3::new(0.62, 0.0, 0.85)));
    document.camera("camera", [DVec3::new(0.1, 1.2, 4.0), DVec3::new(0.05, 0.86, 0.0)], 34.0, 4.0 / 3.0);
    document.to_gltf()
}

fn matte(name: &str, [r, g, b]: [f64; 3]) -> Value {
    json!({
        "name": name,
        "pbrMetallicRoughness": { "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0 },
        "extensions": { "KHR_materials_specular": { "specularFactor": 0.0 } },
    })
}

/// A sheet that reflects one colour and lets another through.
fn sheet(name: &str, [r, g, b]: [f64; 3], through: [f64; 3], share: f64) -> Value {
    json!({
        "name": name,
        "doubleSided": true,
        "pbrMetallicRoughness": { "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.5 },
        "extensions": { "KHR_materials_diffuse_transmission": {
            "diffuseTransmissionFactor": share,
            "diffuseTransmissionColorFactor": through,
        } },
    })
}

/// The sheet `f` over the unit square in `columns` by `rows` quads, its normals from difference quotients.
fn surface(columns: usize, rows: usize, f: impl Fn(DVec2) -> DVec3) -> Mesh {
    let mut mesh = Mesh::default();
    let h = 1e-5;
    for row in 0..=rows {
        for column in 0..=columns {
            let p = DVec2::new(column as f64 / columns as f64, row as f64 / rows as f64);
            // Inwards from the tips, where the sheet has no width.
            let q = DVec2::new(p.x, p.y.clamp(1e-3, 1.0 - 1e-3));
            let along = |d: DVec2| f(q + d * h) - f(q - d * h);
            mesh.push(f(p), along(DVec2::X).cross(along(DVec2::Y)));
        }
    }
    let at = |column: usize, row: usize| (row * (columns + 1) + column) as u32;
    for row in 0..rows {
        for column in 0..columns {
            mesh.quad(at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1));
        }
    }
    mesh
}

/// A leaf of height 1, folded a little along its middle and bent towards +z.
fn leaf() -> Mesh {
    surface(16, 24, |p| {
        let width = 0.26 * libm::pow(libm::sin(PI * (0.004 + 0.992 * p.y)), 0.8) * (1.25 - 0.5 * p.y);
        let side = 2.0 * p.x - 1.0;
        let fold = 0.25 * width * libm::sqrt(side * side + 0.02);
        DVec3::new(width * side, p.y, 0.18 * p.y * p.y - fold)
    })
}

/// A sheet of paper that stands on the floor as half a tube.
fn arch() -> Mesh {
    surface(24, 1, |p| {
        let (s, c) = libm::sincos(PI * p.x);
        DVec3::new(-0.28 * c, 0.28 * s, 0.3 - 0.6 * p.y)
    })
}
