//! Towels: folded, rolled, hung on a hook, thrown over a bench. Texture coordinates are metres of cloth.

use super::parts::surface;
use crate::scenes::kit::{Mesh, Placement, hash01, lathe, rounded_box};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// A towel folded to 30 by 22 cm in `layers` layers of 2 cm, on y = 0 over the origin.
pub(super) fn folded(layers: u32, seed: u64) -> Mesh {
    let mut pile = Mesh::default();
    for layer in 0..layers {
        let jitter = |k: u64| hash01(seed, u64::from(layer) * 7 + k) - 0.5;
        let half = DVec3::new(0.15 + 0.008 * jitter(0), 0.0112, 0.105 + 0.008 * jitter(1));
        let at = DVec3::new(0.008 * jitter(2), 0.011 + 0.0208 * f64::from(layer), 0.006 * jitter(3));
        let slab = rounded_box(half, 0.0105, 1);
        pile.append_at(&slab, &Placement::at(at).turned_y(2.5 * jitter(4)));
    }
    pile.box_uvs(DVec2::ZERO)
}

/// A towel rolled to a bolt 36 cm long and 13 cm thick, lying along z on y = 0; its ends show the turns.
pub(super) fn rolled() -> Mesh {
    let (radius, half) = (0.062, 0.18);
    let mut profile = vec![DVec2::new(0.0, -half)];
    for turn in 0..3 {
        let r = 0.006 + 0.0185 * f64::from(turn);
        for (dr, sink) in [(0.002, 0.004), (0.009, 0.0), (0.016, 0.004)] {
            profile.push(DVec2::new(r + dr, -half + sink));
        }
    }
    profile.push(DVec2::new(radius, -half + 0.006));
    let mirrored: Vec<DVec2> = profile.iter().rev().map(|p| DVec2::new(p.x, -p.y)).collect();
    profile.extend(mirrored);
    let lying = Placement::xyz(0.0, radius, 0.0).turned(DVec3::X, 90.0);
    lathe(&profile, 20, 50.0).placed(&lying).box_uvs(DVec2::ZERO)
}

/// A towel of `width` by `height` metres that hangs from a hook at the origin, in front of a wall at z = 0, facing +z.
pub(super) fn hung(width: f64, height: f64, seed: u64) -> Mesh {
    let phase = |k: u64| TAU * hash01(seed, k);
    let (a, b) = (phase(0), phase(1));
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let mut mesh = surface(26, 22, |p| {
        let side = 2.0 * p.x - 1.0;
        // Gathered at the hook, falling into folds that open downwards.
        let open = 0.17 + 0.36 * smooth((p.y * 1.15).min(1.0));
        let folds = 3.0 + hash01(seed, 9) * 1.5;
        let wave =
            libm::cos(PI * folds * side + a) + 0.35 * libm::cos(PI * 1.7 * folds * side + b + 1.5 * p.y);
        let depth = 0.010 + 0.022 * smooth(p.y.min(1.0)) * (1.0 - 0.25 * p.y);
        let shoulder = -0.06 * side * side * (1.0 - p.y) * (1.0 - p.y);
        let x = side * width * open * (1.0 - 0.05 * libm::sin(3.0 * p.y + a))
            + 0.012 * libm::sin(4.0 * p.y + b) * p.y;
        let hem = 0.02 * libm::cos(PI * side + b) * p.y;
        DVec3::new(x, 0.012 - height * p.y + shoulder + hem, 0.020 + depth * (1.35 + wave))
    });
    mesh.uvs = uv_grid(26, 22, width, height);
    mesh
}

/// A towel thrown across a seat `depth` deep along z whose top is at y = 0 and front edge at z = depth / 2: it lies on the seat
/// and hangs by `front` and `back` metres on the two sides.
pub(super) fn thrown(width: f64, depth: f64, front: f64, back: f64) -> Mesh {
    let radius = 0.02;
    let gap = 0.004;
    let flat = depth - 2.0 * radius + 2.0 * gap;
    let arc = PI / 2.0 * (radius + gap);
    let length = back + arc + flat + arc + front;
    let place = |s: f64| -> (DVec2, DVec2) {
        // Point (z, y) and outward normal along the cloth, from the back hem to the front hem.
        let r = radius + gap;
        let half = flat / 2.0;
        if s < back {
            return (DVec2::new(-half - r, -radius - (back - s)), DVec2::NEG_X);
        }
        let s = s - back;
        if s < arc {
            let (sin, cos) = libm::sincos(s / r);
            return (DVec2::new(-half - r * cos, -radius + r * sin), DVec2::new(-cos, sin));
        }
        let s = s - arc;
        if s < flat {
            return (DVec2::new(s - half, gap), DVec2::Y);
        }
        let s = s - flat;
        if s < arc {
            let (sin, cos) = libm::sincos(s / r);
            return (DVec2::new(half + r * sin, -radius + r * cos), DVec2::new(sin, cos));
        }
        (DVec2::new(half + r, -radius - (s - arc)), DVec2::X)
    };
    let mut mesh = surface(20, 46, |p| {
        let s = p.y * length;
        let (at, out) = place(s);
        let side = 2.0 * p.x - 1.0;
        // Folds grow with the length that hangs freely; on the seat the cloth lies with low wrinkles.
        let free = ((back - s).max(s - back - 2.0 * arc - flat)).max(0.0);
        let fold = (free * 0.12).min(0.018) * (1.0 + libm::cos(PI * 2.5 * side + 1.3 + 2.0 * p.y));
        let wrinkle =
            0.0018 * (1.0 + libm::sin(9.0 * side + 21.0 * p.y)) * (1.0 + libm::cos(5.0 * side - 14.0 * p.y));
        let at = at + out * (fold + wrinkle);
        let skew = 0.035 * (p.y - 0.4);
        DVec3::new(side * width / 2.0 + skew, at.y + 0.01 * side * (p.y - 0.5) * free * 6.0, at.x)
    });
    mesh.uvs = uv_grid(20, 46, width, length);
    mesh
}

/// Texture coordinates of a [`surface`] of `columns` by `rows` quads, in metres.
fn uv_grid(columns: usize, rows: usize, width: f64, height: f64) -> Vec<DVec2> {
    let step = |i: usize, n: usize| i as f64 / n as f64;
    (0..=rows)
        .flat_map(|row| {
            (0..=columns)
                .map(move |column| DVec2::new(step(column, columns) * width, step(row, rows) * height))
        })
        .collect()
}
