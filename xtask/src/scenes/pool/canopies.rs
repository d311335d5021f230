//! Corrugated blue canopies on posts, with blue benches beneath them.

use super::{Pool, joinery};
use crate::scenes::kit::{Material, Mesh, Noise, Picture, Placement, bevel_box, smoothstep, tube};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Along x and z, and heights of the roof in front and behind.
const LENGTH: f64 = 7.6;
const DEPTH: f64 = 2.7;
const FRONT: f64 = 2.62;
const BACK: f64 = 2.30;

/// Where they stand: the middle of each; the front is towards +z.
fn places() -> [Placement; 3] {
    [
        Placement::xyz(-6.6, 0.0, -11.4),
        Placement::xyz(2.4, 0.0, -11.4),
        Placement::xyz(17.6, 0.0, -2.6).turned_y(-90.0),
    ]
}

/// Sheets, frames and benches.
pub(super) fn canopies(pool: &mut Pool) {
    let blue = pool.material("corrugated blue", |pool| {
        let color = pool.texture("corrugated blue", [2.0; 2], || {
            let (runs, broad, rust) =
                (Noise::new(501, [30, 2]), Noise::new(502, [3, 3]), Noise::new(503, [16, 10]));
            let at = |u: f64, v: f64| {
                let run = smoothstep(-0.05, 0.6, runs.fbm(u, v, 3));
                let faded = smoothstep(-0.5, 0.6, broad.fbm(u, v, 4));
                let paint = DVec3::new(0.018, 0.125, 0.44).lerp(DVec3::new(0.075, 0.24, 0.55), faded);
                let paint = paint * (1.0 - 0.35 * run);
                paint.lerp(DVec3::new(0.20, 0.085, 0.035), smoothstep(0.38, 0.55, rust.fbm(u, v, 4)) * 0.8)
            };
            Picture::from_fn([512; 2], at).png()
        });
        Material::new("corrugated blue", [1.0; 3], 0.42).color_texture(color).double_sided()
    });
    pool.document.scatter("corrugated sheet", &sheet(), blue, &places());
    let white = joinery::paint(pool, "white paint", joinery::WHITE);
    pool.document.scatter("canopy frame", &canopy_frame(), white, &places());
    benches(pool);
}

/// A sheet of sine waves along x, falling towards the back, and bent edges.
fn sheet() -> Mesh {
    const PITCH: f64 = 0.127;
    const STEPS: usize = 6;
    let count = (LENGTH / PITCH) as usize * STEPS;
    let (half, over) = (LENGTH / 2.0, 0.22);
    let slope = (FRONT - BACK) / DEPTH;
    let mut mesh = Mesh::default();
    for i in 0..=count {
        let x = i as f64 / count as f64 * (LENGTH + 2.0 * over) - half - over;
        let phase = TAU * i as f64 / STEPS as f64;
        let wave = 0.021 * libm::sin(phase);
        let lean = -0.021 * TAU / PITCH * libm::cos(phase);
        for z in [DEPTH / 2.0 + over, -DEPTH / 2.0 - over] {
            let y = (FRONT + BACK) / 2.0 + slope * z + wave + 0.04;
            mesh.push_uv(DVec3::new(x, y, z), DVec3::new(lean, 1.0, -slope), DVec2::new(x, -z));
        }
    }
    for i in 0..count as u32 {
        let a = 2 * i;
        mesh.quad(a, a + 2, a + 3, a + 1);
    }
    mesh
}

/// Posts on foot plates, beams along the front and the back, rafters and purlins.
fn canopy_frame() -> Mesh {
    let mut mesh = Mesh::default();
    let part = |mesh: &mut Mesh, low: [f64; 3], high: [f64; 3]| {
        mesh.append(&bevel_box(DVec3::from(low), DVec3::from(high), 0.006));
    };
    let (half, deep) = (LENGTH / 2.0 - 0.1, DEPTH / 2.0 - 0.25);
    let height = |z: f64| (FRONT + BACK) / 2.0 + (FRONT - BACK) / DEPTH * z;
    for x in [-half, 0.0, half] {
        for z in [-deep, deep] {
            let foot = DVec3::new(x, 0.0, z);
            mesh.append(&tube(&[foot, foot + DVec3::Y * (height(z) - 0.16)], 0.042, 10));
            part(&mut mesh, [x - 0.1, -0.01, z - 0.1], [x + 0.1, 0.014, z + 0.1]);
        }
        // A rafter, leaning with the roof.
        let angle = libm::atan((FRONT - BACK) / DEPTH).to_degrees();
        let rafter = bevel_box(DVec3::new(-0.03, -0.05, -1.5), DVec3::new(0.03, 0.045, 1.5), 0.005);
        mesh.append_at(&rafter, &Placement::xyz(x, height(0.0) - 0.05, 0.0).turned(DVec3::X, -angle));
    }
    for z in [-deep, deep] {
        let y = height(z) - 0.16;
        part(&mut mesh, [-half - 0.25, y - 0.11, z - 0.035], [half + 0.25, y + 0.015, z + 0.035]);
    }
    mesh.box_uvs(DVec2::ZERO)
}

/// Two benches under each canopy.
fn benches(pool: &mut Pool) {
    let blue = joinery::paint(pool, "bench blue", [0.018, 0.13, 0.46]);
    let mut bench = Mesh::default();
    let half = 1.35;
    for i in 0..4 {
        let z = -0.12 + 0.115 * f64::from(i);
        bench.append(&bevel_box(
            DVec3::new(-half, 0.425, z - 0.048),
            DVec3::new(half, 0.455, z + 0.048),
            0.008,
        ));
    }
    for i in 0..3 {
        let y = 0.56 + 0.12 * f64::from(i);
        let board = bevel_box(DVec3::new(-half, -0.048, -0.014), DVec3::new(half, 0.048, 0.014), 0.008);
        let at = Placement::xyz(0.0, y, -0.21 - 0.025 * f64::from(i)).turned(DVec3::X, -12.0);
        bench.append_at(&board, &at);
    }
    pool.document.scatter("bench boards", &bench.box_uvs(DVec2::ZERO), blue, &bench_places());
    let steel = joinery::galvanised(pool);
    let mut legs = Mesh::default();
    for x in [-1.0, 1.0] {
        let p = |y: f64, z: f64| DVec3::new(x, y, z);
        legs.append(&tube(&[p(0.0, 0.22), p(0.41, 0.20), p(0.41, -0.16), p(0.0, -0.24)], 0.02, 10));
        legs.append(&tube(&[p(0.40, -0.175), p(0.86, -0.285)], 0.018, 10));
    }
    pool.document.scatter("bench legs", &legs, steel, &bench_places());
}

fn bench_places() -> Vec<Placement> {
    let under = |p: &Placement| {
        [-1.75, 1.75]
            .map(|x| Placement { translation: p.translation + p.rotation * DVec3::new(x, 0.0, -0.45), ..*p })
    };
    places().iter().flat_map(under).collect()
}
