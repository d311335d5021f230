//! Doors, barred windows, shutters and the tube lamps over the doors.

use super::{Pool, lanes};
use crate::scenes::kit::{
    Grey, Material, Mesh, Noise, Picture, Placement, bevel_box, lathe, round_path, smoothstep, tube,
};
use glam::{DVec2, DVec3};

/// Openings: width and height.
pub(super) const DOOR: DVec2 = DVec2::new(1.06, 2.12);
pub(super) const WINDOW: DVec2 = DVec2::new(0.92, 0.56);
pub(super) const SHUTTER: DVec2 = DVec2::new(2.6, 1.35);

/// The white of frames and posts.
pub(super) const WHITE: [f64; 3] = [0.76, 0.75, 0.71];

/// Where they go: the middle of the lower edge of each opening, on the outer face of the wall.
#[derive(Default)]
pub(super) struct Joinery {
    pub(super) doors: Vec<Placement>,
    pub(super) windows: Vec<Placement>,
    pub(super) shutters: Vec<Placement>,
    pub(super) lamps: Vec<Placement>,
}

/// Zinc on steel: spangled.
pub(super) fn galvanised(pool: &mut Pool) -> usize {
    pool.material("galvanised steel", |pool| {
        let spangles = pool.texture("zinc", [0.5; 2], || {
            let spangle = Noise::new(401, [24, 24]);
            Grey::from_fn([128; 2], |u, v| 0.42 + 0.16 * spangle.cells(u, v)[2]).png_srgb()
        });
        Material::metal("galvanised steel", [1.0; 3], 0.5).color_texture(spangles)
    })
}

/// Painted steel of one colour, streaked by dust and rain; 1.5 m.
pub(super) fn paint(pool: &mut Pool, name: &'static str, color: [f64; 3]) -> usize {
    pool.material(name, |pool| {
        let dirt = pool.texture("dust on paint", [1.5; 2], || {
            let (runs, spots, broad) =
                (Noise::new(411, [40, 3]), Noise::new(412, [30, 30]), Noise::new(413, [4, 4]));
            let at = |u: f64, v: f64| {
                let run = smoothstep(0.05, 0.6, runs.fbm(u, v, 3));
                let chip = smoothstep(0.45, 0.6, spots.fbm(u, v, 3));
                let shade = 0.93 + 0.08 * broad.fbm(u, v, 3) - 0.13 * run;
                DVec3::new(1.0, 0.985, 0.96) * shade * (1.0 - 0.5 * chip)
            };
            Picture::from_fn([384; 2], at).png()
        });
        Material::new(name, color, 0.42).color_texture(dirt)
    })
}

/// All of it, each kind as one mesh for each material.
pub(super) fn joinery(pool: &mut Pool) {
    let places = std::mem::take(&mut pool.joinery);
    doors(pool, &places.doors);
    windows(pool, &places.windows);
    shutters(pool, &places.shutters);
    lamps(pool, &places.lamps);
}

/// A box in the plane of the wall: x and y from corner to corner, z from back to front.
fn slab(x: [f64; 2], y: [f64; 2], z: [f64; 2], bevel: f64) -> Mesh {
    bevel_box(DVec3::new(x[0], y[0], z[0]), DVec3::new(x[1], y[1], z[1]), bevel)
}

/// A frame around an opening of `size`.
fn frame(size: DVec2, width: f64, [back, front]: [f64; 2], sill: bool) -> Mesh {
    let (half, bevel) = (size.x / 2.0, 0.004);
    let mut mesh = slab([-half, -half + width], [0.0, size.y], [back, front], bevel);
    mesh.append(&slab([half - width, half], [0.0, size.y], [back, front], bevel));
    mesh.append(&slab([-half + width, half - width], [size.y - width, size.y], [back, front], bevel));
    if sill {
        mesh.append(&slab([-half + width, half - width], [0.0, width], [back, front], bevel));
    }
    mesh
}

fn doors(pool: &mut Pool, places: &[Placement]) {
    let turquoise = paint(pool, "turquoise paint", [0.035, 0.34, 0.36]);
    let mut door = frame(DOOR, 0.055, [-0.16, -0.07], false);
    let half = DOOR.x / 2.0 - 0.058;
    let height = DOOR.y - 0.06;
    door.append(&slab([-half, half], [0.012, height], [-0.145, -0.105], 0.003));
    // Raised stiles and rails around two fields, louvres in the lower one.
    let (front, back) = (-0.09, -0.106);
    for x in [[-half, -half + 0.11], [half - 0.11, half]] {
        door.append(&slab(x, [0.012, height], [back, front], 0.004));
    }
    for y in [[0.012, 0.20], [0.92, 1.04], [height - 0.12, height]] {
        door.append(&slab([-half + 0.11, half - 0.11], y, [back, front], 0.004));
    }
    for i in 0..7 {
        let y = 0.25 + 0.095 * f64::from(i);
        let louvre = slab([-half + 0.11, half - 0.11], [-0.006, 0.006], [-0.03, 0.03], 0.002);
        door.append(&louvre.placed(&Placement::xyz(0.0, y, -0.095).turned(DVec3::X, 35.0)));
    }
    pool.document.scatter("door", &door.box_uvs(DVec2::ZERO), turquoise, places);
    let p = |y: f64, z: f64| DVec3::new(half - 0.06, y, z);
    let mut handle = tube(
        &round_path(&[p(0.98, -0.09), p(0.98, -0.03), p(1.22, -0.03), p(1.22, -0.09)], 0.02, 2),
        0.009,
        8,
    );
    let lock = [(0.0, 0.0), (0.024, 0.0), (0.024, 0.006), (0.0, 0.006)].map(DVec2::from);
    handle.append(&lathe(&lock, 10, 30.0).placed(&Placement::at(p(0.90, -0.092)).turned(DVec3::X, 90.0)));
    let steel = lanes::chrome(pool);
    pool.document.scatter("door handle", &handle, steel, places);
}

fn windows(pool: &mut Pool, places: &[Placement]) {
    let white = paint(pool, "white paint", WHITE);
    let mut sash = frame(WINDOW, 0.045, [-0.17, -0.11], true);
    sash.append(&slab([-0.02, 0.02], [0.045, WINDOW.y - 0.045], [-0.16, -0.12], 0.004));
    let sill = slab([-WINDOW.x / 2.0 - 0.04, WINDOW.x / 2.0 + 0.04], [-0.035, 0.004], [-0.10, 0.045], 0.006);
    sash.append(&sill);
    pool.document.scatter("window", &sash.box_uvs(DVec2::ZERO), white, places);
    let glass = pool.material("window glass", |_| Material::new("window glass", [0.012, 0.016, 0.018], 0.1));
    let pane = slab(
        [-WINDOW.x / 2.0 + 0.04, WINDOW.x / 2.0 - 0.04],
        [0.04, WINDOW.y - 0.04],
        [-0.145, -0.138],
        0.002,
    );
    pool.document.scatter("window pane", &pane, glass, places);
    let iron = pool.material("iron", |_| Material::new("iron", [0.035, 0.035, 0.037], 0.5));
    let mut bars = Mesh::default();
    for i in 0..7 {
        let x = (f64::from(i) - 3.0) * 0.125;
        bars.append(&tube(
            &[DVec3::new(x, -0.01, -0.045), DVec3::new(x, WINDOW.y + 0.01, -0.045)],
            0.0085,
            8,
        ));
    }
    for y in [0.12, WINDOW.y - 0.12] {
        bars.append(&slab(
            [-WINDOW.x / 2.0 - 0.01, WINDOW.x / 2.0 + 0.01],
            [y - 0.014, y + 0.014],
            [-0.0495, -0.0405],
            0.002,
        ));
    }
    pool.document.scatter("window bars", &bars, iron, places);
}

/// Rolling shutters of the bar over a counter.
fn shutters(pool: &mut Pool, places: &[Placement]) {
    let steel = paint(pool, "shutter paint", [0.50, 0.54, 0.56]);
    let mut shutter = Mesh::default();
    let half = SHUTTER.x / 2.0;
    let rows = 15;
    let pitch = SHUTTER.y / f64::from(rows);
    // Slats bulge: five points each.
    for i in 0..rows {
        let at = |k: u32| {
            let t = f64::from(k) / 4.0;
            let z = -0.13 + 0.014 * (1.0 - (2.0 * t - 1.0) * (2.0 * t - 1.0));
            (pitch * (f64::from(i) + t), z)
        };
        for k in 0..4 {
            let ((y0, z0), (y1, z1)) = (at(k), at(k + 1));
            let p = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
            shutter.flat_quad(
                [p(-half, y0, z0), p(half, y0, z0), p(half, y1, z1), p(-half, y1, z1)],
                [DVec2::ZERO; 4],
            );
        }
    }
    for x in [[-half, -half + 0.06], [half - 0.06, half]] {
        shutter.append(&slab(x, [0.0, SHUTTER.y], [-0.14, -0.08], 0.004));
    }
    shutter.append(&slab([-half - 0.12, half + 0.12], [-0.06, 0.0], [-0.26, 0.34], 0.012));
    pool.document.scatter("shutter", &shutter.box_uvs(DVec2::ZERO), steel, places);
}

/// A lamp over each door: a trough with one tube, switched off by day.
fn lamps(pool: &mut Pool, places: &[Placement]) {
    let white = paint(pool, "white paint", WHITE);
    let mut trough = slab([-0.42, 0.42], [0.0, 0.09], [0.0, 0.05], 0.008);
    for x in [[-0.40, -0.36], [0.36, 0.40]] {
        trough.append(&slab(x, [0.015, 0.075], [0.045, 0.105], 0.006));
    }
    pool.document.scatter("lamp", &trough.box_uvs(DVec2::ZERO), white, places);
    let glow = pool.material("lamp tube", |_| Material::new("lamp tube", [0.8; 3], 0.3));
    let profile = [(0.0, -0.36), (0.014, -0.36), (0.014, 0.36), (0.0, 0.36)].map(DVec2::from);
    let tube = lathe(&profile, 10, 30.0).placed(&Placement::xyz(0.0, 0.045, 0.078).turned(DVec3::Z, 90.0));
    pool.document.scatter("lamp tube", &tube, glow, places);
}
