//! The patterns of the changing room: formwork on concrete, screed, wood, terry cloth, pebbled glass, wire.

use crate::scenes::kit::{Grey, Noise, Picture, hash01, mix, smoothstep};
use glam::{DVec2, DVec3};

/// Metres that one repetition of the formwork covers, and its boards.
pub(super) const FORMWORK: [f64; 2] = [1.8, 1.8];
const BOARDS: f64 = 12.0;

/// What the formwork left at (u, v): height in metres and reflectance.
fn formwork(u: f64, v: f64) -> (f64, f64) {
    let x = u * BOARDS;
    let (board, across) = (x.floor(), x - x.floor());
    let id = board as u64;
    let random = |k: u64| hash01(40 + k, id);
    // Boards run upwards; each is cut from another place of a long plank.
    let along = v + random(0);
    let warp = 0.05 * Noise::new(11, [28, 6]).at(u, along);
    let grain = Noise::new(3, [12 * 9, 3]).fbm(u + warp * 0.02, along, 3);
    let fine = Noise::new(5, [12 * 24, 10]).at(u, along);
    let blotch = Noise::new(7, [4, 4]).fbm(u, v, 4);
    let pore = {
        let [d, _, r] = Noise::new(9, [46, 46]).cells(u, v);
        if r > 0.86 { smoothstep(0.16, 0.05, d) } else { 0.0 }
    };
    let edge = across.min(1.0 - across) * FORMWORK[0] / BOARDS;
    // A thin fin where mortar ran between two boards, a shade where it did not.
    let fin = smoothstep(0.0032, 0.0, edge) * (0.35 + 0.65 * hash01(77, (x + 0.5) as u64));
    let height = 0.0030 * (random(1) - 0.5) + 0.0010 * grain + 0.0003 * fine + 0.0030 * fin - 0.002 * pore;
    let tone = 0.42 * (1.0 + 0.34 * (random(2) - 0.5) + 0.17 * grain + 0.06 * fine + 0.14 * blotch);
    let dark = smoothstep(0.007, 0.0015, edge) * 0.38;
    (height, tone * (1.0 - dark) * (1.0 - 0.4 * pore))
}

/// Reflectance of the board-marked concrete.
pub(super) fn formwork_color() -> Grey {
    Grey::from_fn([512, 512], |u, v| formwork(u, v).1)
}

/// Its heights.
pub(super) fn formwork_height() -> Grey {
    Grey::from_fn([512, 512], |u, v| formwork(u, v).0)
}

/// Smooth concrete, cast against sheets: clouds, streaks and pores, 2.4 m.
pub(super) fn smooth_concrete() -> Grey {
    Grey::from_fn([256, 256], |u, v| {
        let cloud = Noise::new(21, [3, 3]).fbm(u, v, 5);
        let fine = Noise::new(23, [60, 60]).fbm(u, v, 2);
        let [d, _, r] = Noise::new(25, [30, 30]).cells(u, v);
        let pore = if r > 0.8 { smoothstep(0.17, 0.06, d) } else { 0.0 };
        0.56 * (1.0 + 0.11 * cloud + 0.035 * fine) * (1.0 - 0.35 * pore)
    })
}

/// Trowelled screed, worn and stained, 2 m with a saw-cut joint along its edges.
pub(super) fn screed() -> Grey {
    Grey::from_fn([512, 512], |u, v| {
        let cloud = Noise::new(31, [4, 4]).fbm(u, v, 5);
        let swirl = Noise::new(33, [9, 9]).fbm(u + 0.03 * cloud, v - 0.03 * cloud, 3);
        let grit = Noise::new(35, [180, 180]).at(u, v);
        let [_, _, r] = Noise::new(37, [220, 220]).cells(u, v);
        let speck = if r > 0.93 { 0.10 } else { 0.0 };
        let joint = [u, v].map(|t| t.min(1.0 - t) * 2.0).into_iter().fold(f64::MAX, f64::min);
        let dark = smoothstep(0.004, 0.0015, joint) * 0.65 + smoothstep(0.03, 0.0, joint) * 0.08;
        0.27 * (1.0 + 0.22 * cloud + 0.07 * swirl + 0.06 * grit - speck) * (1.0 - dark)
    })
}

/// Roughness of the screed: 0.34 where feet polished it, 0.7 where it is raw.
pub(super) fn screed_roughness() -> Grey {
    Grey::from_fn([256, 256], |u, v| {
        let cloud = Noise::new(31, [4, 4]).fbm(u, v, 4);
        let wear = Noise::new(39, [7, 7]).fbm(u, v, 4);
        mix(0.34, 0.70, smoothstep(-0.5, 0.6, 0.6 * cloud + wear))
    })
}

/// Grain of sawn wood along u, 1.2 x 0.4 m: a factor on the colour.
pub(super) fn wood() -> Grey {
    Grey::from_fn([512, 256], |u, v| {
        let wander = 0.035 * Noise::new(51, [3, 2]).fbm(u, v, 3);
        let rings = (v + wander) * 17.0;
        let phase = rings - rings.floor();
        // Late wood darkens slowly and ends at once.
        let ring = smoothstep(0.15, 0.92, phase) * smoothstep(1.0, 0.94, phase);
        let fibre = Noise::new(53, [10, 150]).fbm(u, v + wander, 3);
        let tone = Noise::new(55, [2, 5]).fbm(u, v, 3);
        let [d, _, r] = Noise::new(57, [4, 3]).cells(u, v);
        let knot = if r > 0.72 { smoothstep(0.13, 0.05, d) } else { 0.0 };
        (0.80 - 0.20 * ring + 0.14 * fibre + 0.12 * tone) * (1.0 - 0.55 * knot)
    })
}

/// Loops of terry cloth, heights over 8 cm.
pub(super) fn terry() -> Grey {
    Grey::from_fn([128, 128], |u, v| {
        let [d, _, r] = Noise::new(61, [26, 26]).cells(u, v);
        let soft = Noise::new(63, [5, 5]).fbm(u, v, 3);
        0.0022 * (1.0 - d) * (0.6 + 0.4 * r) + 0.0012 * soft
    })
}

/// A beach towel: broad stripes across, in two colours with thin lines between, 0.6 m.
pub(super) fn stripes(field: DVec3, stripe: DVec3) -> Picture {
    Picture::from_fn([64, 256], |u, v| {
        let t = v * 3.0 - (v * 3.0).floor();
        let broad = smoothstep(0.10, 0.115, t) * smoothstep(0.50, 0.485, t);
        let thin = smoothstep(0.58, 0.59, t) * smoothstep(0.64, 0.63, t);
        let loops = 0.93 + 0.10 * Noise::new(65, [32, 128]).at(u, v);
        field.lerp(stripe, (broad + thin).min(1.0)) * loops
    })
}

/// The bumps of pebbled glass, heights over 16 cm.
pub(super) fn pebbles() -> Grey {
    Grey::from_fn([160, 160], |u, v| {
        let [d, second, r] = Noise::new(71, [13, 13]).cells(u, v);
        let dome = smoothstep(0.0, 0.55, second - d) * (0.7 + 0.3 * r);
        0.0035 * dome
    })
}

/// Welded wire with holes of 4 cm, its alpha; the picture holds four holes.
pub(super) fn wire() -> Picture {
    Picture::with_alpha([128, 128], |u, v| {
        let near = |t: f64| {
            let x = t * 2.0 + 0.5;
            ((x - x.floor()) - 0.5).abs() * 0.04
        };
        let d = DVec2::new(near(u), near(v)).min_element();
        (DVec3::splat(0.16), smoothstep(0.0023, 0.0017, d))
    })
}
