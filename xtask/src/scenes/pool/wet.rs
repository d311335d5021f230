//! What shows that the deck is in use: water on it, wet footprints, cracks. Thin sheets over the slabs whose alpha is the share
//! that they cover.

use super::Pool;
use crate::scenes::kit::{Material, Mesh, Noise, Picture, Placement, rectangle, smoothstep};
use glam::{DVec2, DVec3};

/// The colour of wet concrete.
const WET: DVec3 = DVec3::new(0.10, 0.095, 0.085);

/// Dark wet places where people came out of the water.
pub(super) fn puddles(pool: &mut Pool) {
    let wet = pool.material("wet", |pool| {
        let alpha = pool.texture("wet", [1.0; 2], || {
            let (shape, drops) = (Noise::new(321, [5, 5]), Noise::new(322, [14, 14]));
            let at = |u: f64, v: f64| {
                let from_middle = DVec2::new(u - 0.5, v - 0.5).length() * 2.0;
                let body = smoothstep(0.02, -0.12, from_middle - 0.55 - 0.55 * shape.fbm(u, v, 4));
                let cells = drops.cells(u, v);
                let drop = if cells[2] > 0.45 {
                    smoothstep(0.30, 0.22, cells[0] / (0.5 + cells[2] * 0.6))
                } else {
                    0.0
                };
                let alpha = body.max(drop * smoothstep(0.95, 0.6, from_middle));
                (WET, alpha * 0.5 * smoothstep(1.0, 0.9, from_middle))
            };
            Picture::with_alpha([384; 2], at).png()
        });
        Material::new("wet", [1.0; 3], 0.12).color_texture(alpha).blend(1.0)
    });
    let spots = [
        (-9.1, 7.9, 2.4, 1.7, 15.0),
        (-10.6, 8.7, 1.3, 1.0, 80.0),
        (-14.6, 5.2, 1.6, 1.2, 140.0),
        (-14.9, 0.3, 1.7, 1.1, 200.0),
        (-15.4, 2.6, 1.0, 0.9, 30.0),
        (-15.6, 7.4, 1.6, 1.1, 60.0),
        (-12.2, 9.6, 1.2, 0.8, 260.0),
        (-5.0, 7.8, 1.9, 1.0, 300.0),
        (2.6, 7.7, 1.9, 1.2, 111.0),
        (9.2, -7.9, 2.2, 1.5, 5.0),
        (-3.0, -8.0, 1.8, 1.1, 170.0),
    ];
    let at = |&(x, z, sx, sz, turn): &(f64, f64, f64, f64, f64)| {
        Placement::xyz(x, 0.0035, z).turned_y(turn).stretched(DVec3::new(sx, 1.0, sz))
    };
    let places: Vec<Placement> = spots.iter().map(at).collect();
    pool.document.scatter("wet place", &sheet(), wet, &places);
}

/// A square sheet of one metre around the origin, facing up.
fn sheet() -> Mesh {
    let mut sheet = rectangle(DVec3::new(-0.5, 0.0, 0.5), DVec3::X, DVec3::NEG_Z);
    sheet.uvs = [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)].map(DVec2::from).to_vec();
    sheet
}

/// Footprints from the ladder to the loungers; they dry on the way.
pub(super) fn footprints(pool: &mut Pool) {
    let print = pool.material("footprint", |pool| {
        let color = pool.texture("footprint", [1.0; 2], || {
            let ragged = Noise::new(331, [9, 9]);
            // A right foot, toes up: the picture is as high as the foot is long.
            let toes = [
                (0.36, 0.09, 0.075),
                (0.50, 0.07, 0.05),
                (0.60, 0.095, 0.045),
                (0.69, 0.13, 0.04),
                (0.76, 0.18, 0.035),
            ];
            let at = |u: f64, v: f64| {
                let p = DVec2::new(u, v);
                let disc =
                    |x: f64, y: f64, rx: f64, ry: f64| ((p - DVec2::new(x, y)) / DVec2::new(rx, ry)).length();
                let ball = disc(0.54, 0.30, 0.27, 0.14).min(disc(0.66, 0.42, 0.15, 0.16));
                let heel = disc(0.56, 0.83, 0.19, 0.14).min(disc(0.67, 0.62, 0.10, 0.22));
                let toe = toes.iter().map(|&(x, y, r)| disc(x, y, r, r * 0.75)).fold(f64::MAX, f64::min);
                let inside = ball.min(heel).min(toe) + 0.22 * ragged.fbm(u, v, 3);
                (WET, 0.62 * smoothstep(1.0, 0.86, inside))
            };
            Picture::with_alpha([96, 192], at).png()
        });
        Material::new("footprint", [1.0; 3], 0.16).color_texture(color).blend(0.9)
    });
    // Along a curve from the ladder over the deck, left and right by turns.
    let path = |t: f64| DVec2::new(-9.3 - 4.4 * t + 0.3 * libm::sin(5.0 * t), 7.35 + 1.3 * t + 0.55 * t * t);
    let mut places = Vec::new();
    let steps = 11;
    for i in 0..steps {
        let t = f64::from(i) / f64::from(steps - 1);
        let (at, ahead) = (path(t), path(t + 0.01) - path(t - 0.01));
        let ahead = ahead.normalize();
        let side = if i % 2 == 0 { 1.0 } else { -1.0 };
        let right = DVec2::new(-ahead.y, ahead.x) * side * 0.10;
        let turn = libm::atan2(-ahead.x, -ahead.y).to_degrees() - 6.0 * side;
        let size = DVec3::new(0.13 * side, 1.0, 0.265) * (1.0 - 0.12 * t);
        places.push(Placement::xyz(at.x + right.x, 0.0042, at.y + right.y).turned_y(turn).stretched(size));
    }
    pool.document.scatter("footprint", &sheet(), print, &places);
}

/// Hairline cracks in a few slabs.
pub(super) fn cracks(pool: &mut Pool) {
    let crack = pool.material("crack", |pool| {
        let color = pool.texture("crack", [1.0; 2], || {
            let (wander, width) = (Noise::new(341, [4, 1]), Noise::new(342, [16, 1]));
            let at = |u: f64, v: f64| {
                let line = |at: f64, from: f64, lean: f64| {
                    let y = at + lean * (u - from) + 0.16 * wander.fbm(u, at, 5);
                    let here = smoothstep(from - 0.01, from + 0.08, u);
                    let w = (0.0016 + 0.0016 * width.at(u, at)) * here;
                    smoothstep(w + 0.0032, w, (v - y).abs()) * here
                };
                let ends = smoothstep(0.0, 0.04, u) * smoothstep(1.0, 0.94, u);
                let alpha = line(0.42, -0.2, 0.1).max(line(0.55, 0.45, 0.65)) * ends;
                (DVec3::new(0.045, 0.04, 0.035), 0.7 * alpha)
            };
            Picture::with_alpha([512; 2], at).png()
        });
        Material::new("crack", [1.0; 3], 1.0).color_texture(color).blend(1.0).specular(0.0)
    });
    let spots = [
        (-14.9, 8.0, 1.9, 20.0),
        (-17.9, 4.4, 1.9, 200.0),
        (-10.9, 10.2, 2.0, 100.0),
        (-6.0, 8.0, 1.9, 250.0),
        (4.0, -9.0, 2.0, 60.0),
        (15.6, 3.4, 1.9, 310.0),
    ];
    let at = |&(x, z, size, turn): &(f64, f64, f64, f64)| {
        Placement::xyz(x, 0.0030, z).turned_y(turn).stretched(DVec3::new(size, 1.0, size))
    };
    let places: Vec<Placement> = spots.iter().map(at).collect();
    pool.document.scatter("crack", &sheet(), crack, &places);
}
