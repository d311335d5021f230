//! The deck: concrete slabs with joints, the drain around the pool, wet places, and the land beyond.

use super::basin::KERB_WIDTH;
use super::{HALF_LENGTH, HALF_WIDTH, Pool, surfaces};
use crate::scenes::kit::{Grey, Material, Mesh, Noise, Placement, bevel_box, hash01, rectangle, smoothstep};
use glam::{DVec2, DVec3};

/// Ends of the deck along x and z.
pub(super) const DECK_X: [f64; 2] = [-25.0, 22.0];
pub(super) const DECK_Z: [f64; 2] = [-15.6, 15.4];

/// Width of the drain outside the kerb.
const DRAIN: f64 = 0.20;

/// The middle of the drain, from the middle of the pool.
const INNER: DVec2 = DVec2::new(HALF_LENGTH + KERB_WIDTH + DRAIN, HALF_WIDTH + KERB_WIDTH + DRAIN);

/// Slabs about two metres wide; each has its own height, shade and piece of the texture.
pub(super) fn slabs(pool: &mut Pool) {
    let concrete = surfaces::deck_concrete(pool);
    let cuts = |low: f64, inner: f64, high: f64, [a, b, c]: [usize; 3]| -> Vec<f64> {
        let part =
            |from: f64, to: f64, n: usize| (0..n).map(move |i| from + (to - from) * i as f64 / n as f64);
        part(low, -inner, a).chain(part(-inner, inner, b)).chain(part(inner, high, c)).chain([high]).collect()
    };
    let xs = cuts(DECK_X[0], INNER.x, DECK_X[1], [6, 13, 5]);
    let zs = cuts(DECK_Z[0], INNER.y, DECK_Z[1], [4, 7, 4]);
    let mut meshes = vec![Mesh::default(); 5];
    for (i, x) in xs.windows(2).enumerate() {
        for (j, z) in zs.windows(2).enumerate() {
            if x[0] > -INNER.x - 0.1 && x[1] < INNER.x + 0.1 && z[0] > -INNER.y - 0.1 && z[1] < INNER.y + 0.1
            {
                continue;
            }
            let cell = (i * 100 + j) as u64;
            let random = |k: u64| hash01(300 + k, cell);
            let (gap, top) = (0.008, 0.004 * (random(0) - 0.5));
            let slab = bevel_box(
                DVec3::new(x[0] + gap, -0.09, z[0] + gap),
                DVec3::new(x[1] - gap, top, z[1] - gap),
                0.004,
            );
            let offset = DVec2::new(random(1), random(2)) * 3.0;
            let mut slab = slab.without_side(DVec3::NEG_Y).box_uvs(offset);
            if random(3) < 0.5 {
                slab.uvs.iter_mut().for_each(|uv| *uv = DVec2::new(uv.y, -uv.x));
            }
            let shade = 0.86 + 0.14 * random(4);
            let warm = DVec3::new(1.0, 0.985 + 0.015 * random(5), 0.95 + 0.05 * random(5));
            meshes[(random(6) * 5.0) as usize].append(&slab.tinted(warm * shade));
        }
    }
    for (mesh, name) in meshes.iter().zip(["slabs a", "slabs b", "slabs c", "slabs d", "slabs e"]) {
        pool.document.place(name, mesh, concrete);
    }
    bed(pool);
}

/// What is seen in the joints.
fn bed(pool: &mut Pool) {
    let dirt = pool.material("joint", |_| Material::new("joint", [0.05, 0.045, 0.04], 1.0).specular(0.0));
    let mut bed = Mesh::default();
    let (x, z) = (HALF_LENGTH + 0.05, HALF_WIDTH + 0.05);
    let parts = [
        ([DECK_X[0], DECK_X[1]], [DECK_Z[0], -z]),
        ([DECK_X[0], DECK_X[1]], [z, DECK_Z[1]]),
        ([DECK_X[0], -x], [-z, z]),
        ([x, DECK_X[1]], [-z, z]),
    ];
    for ([x0, x1], [z0, z1]) in parts {
        bed.append(&rectangle(DVec3::new(x0, -0.03, z1), DVec3::X * (x1 - x0), DVec3::NEG_Z * (z1 - z0)));
    }
    pool.document.place("bed", &bed, dirt);
}

/// A grating over the channel around the kerb.
pub(super) fn drain(pool: &mut Pool) {
    let grating = pool.material("grating", |pool| {
        // Slots of 12 mm every 25 mm, in bars 0.2 m wide.
        let slot = |u: f64, v: f64| {
            let across = (((u * 8.0).fract() - 0.5).abs() - 0.26) * 0.025;
            let along = ((v - 0.5).abs() - 0.36) * 0.20;
            smoothstep(0.0006, -0.0006, across.max(along))
        };
        let color = pool.texture("grating", [0.2; 2], || {
            let dirt = Noise::new(311, [4, 4]);
            let at = |u: f64, v: f64| (0.58 + 0.1 * dirt.fbm(u, v, 3)) * (1.0 - 0.93 * slot(u, v));
            Grey::from_fn([256; 2], at).png_srgb()
        });
        let normal = pool.texture("grating normal", [0.2; 2], || {
            Grey::from_fn([256; 2], |u, v| -0.0015 * slot(u, v)).normal_map([0.2; 2])
        });
        Material::new("grating", [0.95, 0.95, 0.92], 0.55).color_texture(color).normal_texture(normal, 1.0)
    });
    // Pieces of two metres, along x, a metre long before they are stretched; u runs along, v across.
    let mut piece = bevel_box(DVec3::new(0.0, -0.06, 0.0), DVec3::new(1.0, -0.002, DRAIN - 0.008), 0.003)
        .without_side(DVec3::NEG_Y)
        .box_uvs(DVec2::ZERO);
    piece.uvs.iter_mut().for_each(|uv| *uv = DVec2::new(2.0 * uv.x, uv.y + 0.004));
    let (x, z) = (HALF_LENGTH + KERB_WIDTH, HALF_WIDTH + KERB_WIDTH);
    let mut places = Vec::new();
    let long = (2.0 * x) / 13.0;
    for i in 0..13 {
        let at = -x + long * f64::from(i);
        let stretch = DVec3::new(long - 0.004, 1.0, 1.0);
        places.push(Placement::xyz(at, 0.0, z + 0.004).stretched(stretch));
        places.push(Placement::xyz(at, 0.0, -z - DRAIN + 0.004).stretched(stretch));
    }
    let length = 2.0 * (z + DRAIN) / 7.0;
    for i in 0..7 {
        let at = z + DRAIN - length * f64::from(i);
        let stretch = DVec3::new(length - 0.004, 1.0, 1.0);
        places.push(Placement::xyz(x + 0.004, 0.0, at).turned_y(90.0).stretched(stretch));
        places.push(Placement::xyz(-x - DRAIN + 0.004, 0.0, at).turned_y(90.0).stretched(stretch));
    }
    pool.document.scatter("grating", &piece, grating, &places);
}

/// The land: dry grass out to the hills.
pub(super) fn land(pool: &mut Pool) {
    let grass = surfaces::dry_grass(pool);
    let far = 420.0;
    let mut land = Mesh::default();
    // Under the deck there is none of it: the basin goes deeper.
    let parts = [
        ([-far, far], [-far, DECK_Z[0]]),
        ([-far, far], [DECK_Z[1], far]),
        ([-far, DECK_X[0]], [DECK_Z[0], DECK_Z[1]]),
        ([DECK_X[1], far], [DECK_Z[0], DECK_Z[1]]),
    ];
    for ([x0, x1], [z0, z1]) in parts {
        land.append(&rectangle(DVec3::new(x0, -0.05, z1), DVec3::X * (x1 - x0), DVec3::NEG_Z * (z1 - z0)));
    }
    pool.document.place("land", &land.box_uvs(DVec2::ZERO), grass);
}
