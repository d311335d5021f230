//! The rows of the board: each a feature of glTF's materials and one parameter of it in five steps.

use crate::scenes::kit::{Document, Grey, Material, Noise, Picture, smoothstep};
use glam::{DVec2, DVec3};
use serde_json::json;

/// One row: its name and the materials from left to right.
pub(super) struct Row {
    pub(super) name: &'static str,
    pub(super) materials: Vec<Material>,
    /// Bit `i` is set where ball `i` has colours at its vertices.
    pub(super) vertex_colors: u32,
}

/// Five values of `make`, its argument running from 0 to 1.
fn row(name: &'static str, make: impl Fn(f64) -> Material) -> Row {
    let materials = (0..5).map(|i| make(f64::from(i) / 4.0)).collect();
    Row { name, materials, vertex_colors: 0 }
}

/// All rows, in the order of the board: the left block from above, then the right one.
pub(super) fn all(document: &mut Document) -> Vec<Row> {
    let mut rows = surfaces();
    rows.extend(layers());
    rows.extend(glass());
    rows.extend(others(document));
    rows
}

/// The base: dielectric and metal.
fn surfaces() -> Vec<Row> {
    vec![
        row("ROUGHNESS", |t| Material::new("roughness", [0.55, 0.045, 0.03], t)),
        row("METAL", |t| Material::metal("metal", [1.0, 0.71, 0.29], 0.02 + 0.68 * t)),
        row("SPECULAR", |t| {
            let specular =
                json!({ "specularFactor": 1.0, "specularColorFactor": [2.0 * t, 1.0 * t, 0.45 * t + 0.05] });
            Material::new("specular", [0.02, 0.02, 0.025], 0.18).extension("KHR_materials_specular", specular)
        }),
        row("IOR", |t| {
            Material::new("ior", [0.03, 0.06, 0.16], 0.1)
                .extension("KHR_materials_ior", json!({ "ior": 1.0 + 1.4 * t }))
        }),
    ]
}

/// Layers and what changes the highlight.
fn layers() -> Vec<Row> {
    vec![
        row("CLEARCOAT", |t| Material::new("clearcoat", [0.02, 0.16, 0.42], 0.75).clearcoat(t, 0.03)),
        row("SHEEN", |t| {
            let sheen =
                json!({ "sheenColorFactor": [0.95, 0.75, 0.9], "sheenRoughnessFactor": 0.15 + 0.85 * t });
            Material::new("sheen", [0.12, 0.012, 0.05], 0.9).extension("KHR_materials_sheen", sheen)
        }),
        row("ANISOTROPY", |t| {
            let anisotropy = json!({ "anisotropyStrength": t, "anisotropyRotation": 0.0 });
            Material::metal("anisotropy", [0.78, 0.77, 0.75], 0.32)
                .extension("KHR_materials_anisotropy", anisotropy)
        }),
        row("IRIDESCENCE", |t| {
            let film = json!({
                "iridescenceFactor": 1.0, "iridescenceIor": 1.33,
                "iridescenceThicknessMinimum": 180.0 + 420.0 * t, "iridescenceThicknessMaximum": 180.0 + 420.0 * t,
            });
            Material::metal("iridescence", [0.6, 0.6, 0.62], 0.12)
                .extension("KHR_materials_iridescence", film)
        }),
        row("EMISSION", |t| {
            Material::new("emission", [0.02; 3], 0.6)
                .emissive([1.0, 0.42 + 0.2 * t, 0.10 + 0.3 * t], libm::pow(8.0, t) - 0.75)
        }),
    ]
}

/// What lets light through.
fn glass() -> Vec<Row> {
    const CLEAR: [f64; 3] = [1.0; 3];
    vec![
        row("ROUGH GLASS", |t| Material::new("glass", CLEAR, 0.6 * t).transmissive(1.5).volume(CLEAR, 10.0)),
        row("GLASS IOR", |t| {
            Material::new("glass ior", CLEAR, 0.0).transmissive(1.1 + 1.3 * t).volume(CLEAR, 10.0)
        }),
        row("VOLUME", |t| {
            Material::new("volume", CLEAR, 0.0)
                .transmissive(1.45)
                .volume([0.10, 0.55, 0.42], 1.6 * libm::pow(0.08, t))
        }),
        row("DISPERSION", |t| {
            let glass = Material::new("dispersion", CLEAR, 0.0).transmissive(1.7).volume(CLEAR, 10.0);
            glass.extension("KHR_materials_dispersion", json!({ "dispersion": 3.0 * t }))
        }),
        row("THIN WALL", |t| {
            Material::new("thin wall", [1.0 - 0.75 * t, 1.0 - 0.35 * t, 1.0], 0.45 * t)
                .transmissive(1.5)
                .double_sided()
        }),
        row("TRANSLUCENT", |t| {
            let through = json!({ "diffuseTransmissionFactor": t, "diffuseTransmissionColorFactor": [0.95, 0.55, 0.12] });
            let wax = Material::new("translucent", [0.55, 0.5, 0.42], 0.5).double_sided();
            wax.extension("KHR_materials_diffuse_transmission", through)
        }),
    ]
}

/// Textures, coverage, colours at vertices, unlit.
fn others(document: &mut Document) -> Vec<Row> {
    // A repetition is an eighth of the equator.
    let around = std::f64::consts::TAU * super::BALL;
    let size = [around / 8.0, around / 8.0];
    let bumps = Grey::from_fn([128, 128], |u, v| {
        let [d, _, _] = Noise::new(3, [4, 4]).cells(u, v);
        0.02 * smoothstep(0.75, 0.0, d)
    });
    let bumps = document.texture_of("bumps", &bumps.normal_map(size), size);
    let holes = Picture::with_alpha([128, 128], |u, v| {
        let cell = |x: f64| (x * 2.0).fract() - 0.5;
        let d = DVec2::new(cell(u), cell(v)).length();
        (DVec3::new(0.05, 0.35, 0.30), smoothstep(0.12, 0.62, d))
    });
    let holes = document.texture_of("holes", &holes.png(), size);
    let alpha = |i: usize| {
        let base = Material::new("alpha", [1.0; 3], 0.4).double_sided();
        match i {
            0..=2 => base.color_texture(holes).mask([0.15, 0.4, 0.65][i]),
            _ => Material::new("blend", [0.05, 0.35, 0.30], 0.4).blend([0.6, 0.25][i - 3]).double_sided(),
        }
    };
    let plain = |i: usize| {
        let colors = [[0.6, 0.05, 0.04], [0.05, 0.4, 0.1], [0.05, 0.12, 0.6]];
        if i < 3 {
            Material::new("unlit", colors[i], 1.0).extension("KHR_materials_unlit", json!({}))
        } else {
            Material::new("vertex colours", [1.0; 3], if i == 3 { 0.8 } else { 0.15 })
        }
    };
    vec![
        row("NORMAL MAP", |t| {
            Material::new("normal map", [0.42, 0.30, 0.16], 0.35).normal_texture(bumps, 1.5 * t)
        }),
        Row { name: "MASK - BLEND", materials: (0..5).map(alpha).collect(), vertex_colors: 0 },
        Row { name: "UNLIT - VERTEX", materials: (0..5).map(plain).collect(), vertex_colors: 0b11000 },
    ]
}

/// A colour for a direction, around the y axis.
pub(super) fn rainbow(n: DVec3) -> DVec3 {
    let wave = |phase: f64| 0.5 + 0.45 * libm::cos(3.0 * libm::atan2(n.z, n.x) + 2.0 * n.y + phase);
    let third = std::f64::consts::TAU / 3.0;
    DVec3::new(wave(0.0), wave(third), wave(2.0 * third))
}
