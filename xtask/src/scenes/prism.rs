//! `prism.gltf`: glass that disperses (`KHR_materials_dispersion`). A prism of heavy flint and a cut diamond stand before bright bars on a dark wall; what is
//! seen through them has coloured edges, and the diamond throws coloured light on the floor.

use super::kit::{Document, Mesh, Placement, faceted, rectangle};
use glam::DVec3;
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// The scene as a `.gltf` file.
pub(crate) fn prism() -> Vec<u8> {
    let mut document = Document::default();
    let floor = document.material(plain("floor", [0.55, 0.55, 0.55], 0.0));
    let wall = document.material(plain("wall", [0.02, 0.02, 0.025], 0.0));
    let bar = document.material(plain("bar", [0.0; 3], 5.0));
    let flint = document.material(glass("flint", 1.72, 20.0 / 29.0));
    let diamond = document.material(glass("diamond", 2.417, 20.0 / 55.0));
    let mut show = |name: &str, mesh: &Mesh, material: usize, placement: Placement| {
        let geometry = document.geometry(mesh);
        document.object(name, &geometry, material, &placement);
    };
    let corner = DVec3::new(-6.0, 0.0, 4.0);
    show("floor", &rectangle(corner, DVec3::X * 12.0, DVec3::NEG_Z * 7.0), floor, Placement::at(DVec3::ZERO));
    let corner = DVec3::new(-6.0, 0.0, -3.0);
    show("wall", &rectangle(corner, DVec3::X * 12.0, DVec3::Y * 4.0), wall, Placement::at(DVec3::ZERO));
    for i in 0..6 {
        let corner = DVec3::new(-3.4 + 1.2 * f64::from(i), 0.4, -2.95);
        let mesh = rectangle(corner, DVec3::X * 0.14, DVec3::Y * 1.9);
        show("bar", &mesh, bar, Placement::at(DVec3::ZERO));
    }
    let panel = rectangle(DVec3::new(-1.2, 3.6, 0.4), DVec3::X * 1.6, DVec3::Z * 1.2);
    show("lamp", &panel, bar, Placement::at(DVec3::ZERO));
    show("prism", &wedge(), flint, Placement::at(DVec3::new(-0.75, 0.0, 0.2)).turned_y(24.0));
    show(
        "diamond",
        &brilliant(),
        diamond,
        Placement::at(DVec3::new(0.75, 0.62, 0.5)).scaled(0.6).turned_y(11.0),
    );
    document.camera("camera", [DVec3::new(0.0, 1.25, 4.2), DVec3::new(0.0, 0.72, 0.0)], 34.0, 4.0 / 3.0);
    document.to_gltf()
}

/// A matte or shining material.
fn plain(name: &str, color: [f64; 3], strength: f64) -> Value {
    let [r, g, b] = color;
    let mut material = json!({
        "name": name,
        "pbrMetallicRoughness": { "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0 },
        "extensions": { "KHR_materials_specular": { "specularFactor": 0.0 } },
    });
    if strength > 0.0 {
        material["emissiveFactor"] = json!([1.0, 1.0, 1.0]);
        material["extensions"]["KHR_materials_emissive_strength"] = json!({ "emissiveStrength": strength });
    }
    material
}

/// Clear solid glass.
fn glass(name: &str, ior: f64, dispersion: f64) -> Value {
    json!({
        "name": name,
        "pbrMetallicRoughness": { "metallicFactor": 0.0, "roughnessFactor": 0.0 },
        "extensions": {
            "KHR_materials_dispersion": { "dispersion": dispersion },
            "KHR_materials_ior": { "ior": ior },
            "KHR_materials_transmission": { "transmissionFactor": 1.0 },
            "KHR_materials_volume": { "thicknessFactor": 1.0 },
        },
    })
}

/// An upright prism with an edge of 40° towards -x.
fn wedge() -> Mesh {
    let half = libm::tan(20f64.to_radians());
    let at = |x: f64, z: f64, y: f64| DVec3::new(x, y, z);
    let [edge, back, front] = [(-0.6, 0.0), (0.5, -1.1 * half), (0.5, 1.1 * half)];
    let (bottom, top) = (0.001, 1.5);
    let ring = |y: f64| [edge, front, back].map(|(x, z)| at(x, z, y));
    let ([a, b, c], [d, e, f]) = (ring(bottom), ring(top));
    faceted(&[vec![c, b, a], vec![d, e, f], vec![a, b, e, d], vec![b, c, f, e], vec![c, a, d, f]])
}

/// A cut stone of radius 1: a table, a crown of eight facets and as many of the pavilion, down to a point at y = -1.
fn brilliant() -> Mesh {
    const SIDES: usize = 8;
    let ring = |radius: f64, y: f64| -> Vec<DVec3> {
        (0..SIDES)
            .map(|i| {
                let (s, c) = libm::sincos(TAU * i as f64 / SIDES as f64);
                DVec3::new(radius * c, y, -radius * s)
            })
            .collect()
    };
    let (table, upper, lower) = (ring(0.56, 0.36), ring(1.0, 0.03), ring(1.0, -0.03));
    let culet = DVec3::NEG_Y;
    let mut faces = vec![table.clone()];
    for i in 0..SIDES {
        let j = (i + 1) % SIDES;
        faces.push(vec![upper[i], upper[j], table[j], table[i]]);
        faces.push(vec![lower[i], lower[j], upper[j], upper[i]]);
        faces.push(vec![culet, lower[j], lower[i]]);
    }
    faceted(&faces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::kit::checks::{assert_closed, assert_oriented};

    #[test]
    fn stones_are_closed_and_face_outward() {
        for mesh in [wedge(), brilliant()] {
            assert_oriented(&mesh);
            assert_closed(&mesh);
            let volume: f64 =
                mesh.triangles.iter().map(|&t| mesh.area_vector(t).dot(mesh.positions[t[0] as usize])).sum();
            assert!(volume > 0.0);
        }
    }
}
