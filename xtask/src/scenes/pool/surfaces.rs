//! Concrete, tiles and ground: the large textured materials of the pool. Every texture repeats without a seam.

use super::Pool;
use crate::scenes::kit::{Grey, Material, Noise, Picture, hash01, mix, smoothstep};
use glam::DVec3;

/// Concrete slabs of the deck: a texture of 3 m, from trowelled mottles down to grains of sand, with darker stains.
pub(super) fn deck_concrete(pool: &mut Pool) -> usize {
    pool.material("deck concrete", |pool| {
        let color =
            pool.texture("deck concrete", [3.0; 2], || Grey::from_fn([1024; 2], deck_color).png_srgb());
        let normal = pool.texture("deck concrete normal", [1.5; 2], || {
            let (grain, broad) = (Noise::new(31, [90, 90]), Noise::new(32, [12, 12]));
            let pits = Noise::new(33, [40, 40]);
            let height = |u: f64, v: f64| {
                let pit = smoothstep(0.22, 0.05, pits.cells(u, v)[0]) * 0.0008;
                grain.fbm(u, v, 2) * 0.0006 + broad.at(u, v) * 0.0012 - pit
            };
            Grey::from_fn([512; 2], height).normal_map([1.5; 2])
        });
        let material = Material::new("deck concrete", [1.0, 0.945, 0.86], 1.0);
        let rough = pool.texture("deck concrete roughness", [3.0; 2], || {
            let (broad, fine) = (Noise::new(34, [4, 4]), Noise::new(35, [64, 64]));
            Grey::from_fn([256; 2], |u, v| 0.78 + 0.12 * broad.fbm(u, v, 4) + 0.08 * fine.at(u, v)).png()
        });
        material.color_texture(color).roughness_texture(rough).normal_texture(normal, 1.0)
    })
}

fn deck_color(u: f64, v: f64) -> f64 {
    let mottle = Noise::new(21, [3, 3]).fbm(u, v, 5);
    let sand = Noise::new(22, [256, 256]).at(u, v);
    let speck = Noise::new(23, [110, 110]).cells(u, v);
    let stain = Noise::new(24, [2, 2]).fbm(u, v, 4);
    let dark_grain = if speck[2] > 0.8 { smoothstep(0.42, 0.2, speck[0]) * 0.10 } else { 0.0 };
    let pale_grain = if speck[2] < 0.12 { smoothstep(0.35, 0.15, speck[0]) * 0.08 } else { 0.0 };
    let color = 0.50 + 0.085 * mottle + 0.03 * sand - dark_grain + pale_grain;
    color * (1.0 - 0.22 * smoothstep(0.15, 0.55, stain))
}

/// Concrete that was poured between rough boards 12 cm wide: grain, steps between boards, ties, runs of water. 2.4 m.
pub(super) fn board_concrete(pool: &mut Pool) -> usize {
    pool.material("board-marked concrete", |pool| {
        let color = pool
            .texture("board-marked concrete", [2.4; 2], || Grey::from_fn([1024; 2], board_color).png_srgb());
        let normal = pool.texture("board-marked concrete normal", [2.4; 2], || {
            Grey::from_fn([768; 2], board_height).normal_map([2.4; 2])
        });
        Material::new("board-marked concrete", [1.0, 0.965, 0.905], 0.9)
            .color_texture(color)
            .normal_texture(normal, 1.0)
    })
}

/// Boards in the height of the texture.
const BOARDS: f64 = 20.0;

/// Which board, how far from its lower edge (0 to 1), and where its butt joint is in u.
fn board(v: f64) -> (u64, f64, f64) {
    let row = (v * BOARDS).floor();
    (row as u64, v * BOARDS - row, hash01(40, row as u64))
}

/// Distance in metres from the nearest of the four ties that hold the formwork.
fn tie_distance(u: f64, v: f64) -> f64 {
    let near = |x: f64, at: f64| (x - at).abs().min(1.0 - (x - at).abs()) * 2.4;
    let (x, y) = (near(u, 0.25).min(near(u, 0.75)), near(v, 0.275).min(near(v, 0.775)));
    (x * x + y * y).sqrt()
}

/// Height of the surface in metres.
fn board_height(u: f64, v: f64) -> f64 {
    let (row, y, joint) = board(v);
    // Fibres run along the board; each board stands out by its own amount.
    let fibres = Noise::new(41 + row, [10, 400]).fbm(u, v, 2);
    let knots = Noise::new(61 + row, [6, 20]).fbm(u, v, 3);
    let step = hash01(42, row) * 0.004 + if (u - joint).rem_euclid(1.0) < 0.5 { 0.0012 } else { 0.0 };
    let seam = smoothstep(0.05, 0.0, y.min(1.0 - y)) * 0.003;
    let butt = smoothstep(0.0016, 0.0, (u - joint).abs()) * 0.002;
    let hole = smoothstep(0.017, 0.012, tie_distance(u, v)) * 0.008;
    step + fibres * 0.0011 + knots * 0.0010 + seam * 0.6 - butt - hole
}

fn board_color(u: f64, v: f64) -> f64 {
    let (row, y, joint) = board(v);
    let side = (u - joint).rem_euclid(1.0) < 0.5;
    let shade = hash01(43, row * 2 + u64::from(side)) - 0.5;
    let fibres = Noise::new(44 + row, [8, 320]).fbm(u, v, 3);
    let mottle = Noise::new(71, [3, 4]).fbm(u, v, 5);
    let runs = smoothstep(0.1, 0.6, Noise::new(72, [26, 2]).fbm(u, v, 3));
    let seam = smoothstep(0.06, 0.0, y.min(1.0 - y));
    let pores = Noise::new(73, [70, 70]).cells(u, v);
    let pore = if pores[2] > 0.72 { smoothstep(0.2, 0.09, pores[0]) } else { 0.0 };
    let hole = smoothstep(0.018, 0.013, tie_distance(u, v));
    let rust = smoothstep(0.1, 0.0, tie_distance(u, v)) * 0.05;
    let color = 0.40 + 0.075 * shade + 0.06 * fibres + 0.06 * mottle - 0.07 * runs - 0.09 * seam;
    color * (1.0 - 0.25 * pore) * (1.0 - 0.7 * hole) - rust
}

/// Smooth concrete of roofs, plinths and steps, 2 m.
pub(super) fn plain_concrete(pool: &mut Pool) -> usize {
    pool.material("plain concrete", |pool| {
        let color = pool.texture("plain concrete", [2.0; 2], || {
            let (mottle, runs, fine) =
                (Noise::new(81, [3, 3]), Noise::new(82, [22, 2]), Noise::new(83, [128, 128]));
            let at = |u: f64, v: f64| {
                let run = smoothstep(0.0, 0.6, runs.fbm(u, v, 3));
                0.43 + 0.08 * mottle.fbm(u, v, 5) - 0.09 * run + 0.02 * fine.at(u, v)
            };
            Grey::from_fn([512; 2], at).png_srgb()
        });
        Material::new("plain concrete", [1.0, 0.97, 0.92], 0.85).color_texture(color)
    })
}

/// Pale blue glazed tiles of 10 cm with their grout, 1 m.
pub(super) fn pool_tiles(pool: &mut Pool) -> usize {
    tiles(pool, "pool tiles", DVec3::new(0.62, 0.80, 0.84), 0)
}

/// Dark blue tiles of the lane lines.
pub(super) fn lane_tiles(pool: &mut Pool) -> usize {
    tiles(pool, "lane tiles", DVec3::new(0.018, 0.045, 0.11), 1)
}

fn tiles(pool: &mut Pool, name: &'static str, glaze: DVec3, seed: u64) -> usize {
    // Along an axis: the tile and the distance from its edge in metres.
    let axis = |t: f64| ((t * 10.0).floor(), (0.5 - ((t * 10.0).fract() - 0.5).abs()) * 0.1);
    pool.material(name, |pool| {
        let grout = glaze.lerp(DVec3::new(0.5, 0.55, 0.55), 0.55);
        let color = pool.texture(name, [1.0; 2], || {
            let dirt = Noise::new(91, [5, 5]);
            let at = |u: f64, v: f64| {
                let ((i, x), (j, y)) = (axis(u), axis(v));
                let joint = smoothstep(0.0028, 0.0016, x.min(y));
                let shade = 0.90 + 0.16 * hash01(92 + seed, (i * 10.0 + j) as u64);
                (glaze * shade).lerp(grout, joint) * (1.0 + 0.06 * dirt.fbm(u, v, 3))
            };
            Picture::from_fn([512; 2], at).png()
        });
        let normal = pool.texture("pool tiles normal", [1.0; 2], || {
            let at = |u: f64, v: f64| {
                let ((i, x), (j, y)) = (axis(u), axis(v));
                let lean = |k: u64| hash01(93 + k, (i * 10.0 + j) as u64) - 0.5;
                let centre = |t: f64| (t * 10.0).fract() - 0.5;
                smoothstep(0.0, 0.005, x.min(y)) * 0.0015
                    + (lean(0) * centre(u) + lean(1) * centre(v)) * 0.0016
            };
            Grey::from_fn([512; 2], at).normal_map([1.0; 2])
        });
        // Under water a glaze hardly reflects: its index is near that of water.
        Material::new(name, [1.0; 3], 0.5).color_texture(color).normal_texture(normal, 1.0).specular(0.12)
    })
}

/// White painted concrete of the kerb, worn to the grey beneath along its joints, 1 m.
pub(super) fn kerb_white(pool: &mut Pool) -> usize {
    pool.material("worn white paint", |pool| {
        let wear = |u: f64, v: f64| {
            let patches = Noise::new(101, [6, 6]).fbm(u, v, 5);
            let chips = Noise::new(102, [24, 24]).fbm(u, v, 3);
            smoothstep(0.20, 0.32, patches + 0.35 * chips)
        };
        let color = pool.texture("worn white paint", [1.0; 2], move || {
            let (dirt, fine) = (Noise::new(103, [3, 3]), Noise::new(104, [100, 100]));
            let at = move |u: f64, v: f64| {
                let grime = smoothstep(-0.2, 0.7, dirt.fbm(u, v, 4));
                let paint = DVec3::new(0.80, 0.79, 0.76).lerp(DVec3::new(0.60, 0.57, 0.50), 0.5 * grime);
                let concrete = DVec3::new(0.44, 0.42, 0.39) * (1.0 + 0.2 * fine.at(u, v));
                paint.lerp(concrete, wear(u, v))
            };
            Picture::from_fn([512; 2], at).png()
        });
        let normal = pool.texture("worn white paint normal", [1.0; 2], move || {
            let fine = Noise::new(105, [64, 64]);
            let at = move |u: f64, v: f64| 0.0009 * fine.fbm(u, v, 2) - 0.0015 * wear(u, v);
            Grey::from_fn([512; 2], at).normal_map([1.0; 2])
        });
        let rough = pool.texture("worn white paint roughness", [1.0; 2], move || {
            Grey::from_fn([256; 2], move |u, v| mix(0.5, 0.9, wear(u, v))).png()
        });
        Material::new("worn white paint", [1.0; 3], 1.0)
            .color_texture(color)
            .roughness_texture(rough)
            .normal_texture(normal, 1.0)
    })
}

/// Dry grass and earth around the place, 6 m.
pub(super) fn dry_grass(pool: &mut Pool) -> usize {
    pool.material("dry grass", |pool| {
        let color = pool.texture("dry grass", [6.0; 2], || {
            let (patches, blades, tufts) =
                (Noise::new(111, [4, 4]), Noise::new(112, [180, 60]), Noise::new(113, [30, 30]));
            let at = |u: f64, v: f64| {
                let bare = smoothstep(-0.1, 0.5, patches.fbm(u, v, 4));
                let grass = DVec3::new(0.15, 0.15, 0.055).lerp(DVec3::new(0.30, 0.25, 0.12), bare);
                grass * (1.0 + 0.5 * blades.at(u, v) + 0.4 * tufts.fbm(u, v, 3))
            };
            Picture::from_fn([512; 2], at).png()
        });
        Material::new("dry grass", [1.0; 3], 1.0).color_texture(color).specular(0.0)
    })
}
