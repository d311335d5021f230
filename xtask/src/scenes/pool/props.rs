//! Things that people left: lifebuoys, a lifeguard's chair, loungers with towels, kickboards, a shower, a bin.

use super::{Pool, joinery, lanes};
use crate::scenes::kit::{
    Grey, Material, Mesh, Noise, Picture, Placement, bevel_box, extrude_beveled, lathe, round_path,
    smoothstep, tube,
};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Everything.
pub(super) fn props(pool: &mut Pool) {
    lifebuoys(pool);
    chair(pool);
    loungers(pool);
    kickboards(pool);
    shower(pool);
    bins(pool);
}

/// A ring with red and white quarters on a post.
fn lifebuoys(pool: &mut Pool) {
    let skin = pool.material("lifebuoy", |pool| {
        let color = pool.texture("lifebuoy", [1.0; 2], || {
            let at = |u: f64, _: f64| {
                let quarter = ((u * 4.0).fract() - 0.5).abs();
                let white = smoothstep(0.26, 0.27, quarter);
                DVec3::new(0.72, 0.055, 0.03).lerp(DVec3::new(0.82, 0.80, 0.76), white)
            };
            Picture::from_fn([256, 4], at).png()
        });
        Material::new("lifebuoy", [1.0; 3], 0.45).color_texture(color)
    });
    // A torus in the plane of x and y.
    let (major, minor, rings, sides) = (0.29, 0.062, 28, 10);
    let mut ring = Mesh::default();
    for i in 0..=rings {
        let (s, c) = libm::sincos(TAU * f64::from(i % rings) / f64::from(rings));
        for k in 0..=sides {
            let (st, ct) = libm::sincos(TAU * f64::from(k % sides) / f64::from(sides));
            let n = DVec3::new(c * ct, s * ct, st);
            let uv = DVec2::new(f64::from(i) / f64::from(rings), f64::from(k) / f64::from(sides));
            ring.push_uv(DVec3::new(c, s, 0.0) * major + n * minor, n, uv);
        }
    }
    for i in 0..rings {
        for k in 0..sides {
            let at = |i: i32, k: i32| (i * (sides + 1) + k) as u32;
            ring.quad(at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
        }
    }
    let places = [
        Placement::xyz(-2.2, 1.22, -8.1),
        Placement::xyz(13.9, 1.22, 7.9).turned_y(-90.0),
        Placement::xyz(-16.6, 1.22, -7.6).turned_y(60.0),
    ];
    pool.document.scatter("lifebuoy", &ring, skin, &places);
    let steel = joinery::galvanised(pool);
    let mut post = tube(&[DVec3::new(0.0, -1.22, -0.1), DVec3::new(0.0, 0.42, -0.1)], 0.03, 12);
    for x in [-0.16, 0.16] {
        let p = |y: f64, z: f64| DVec3::new(x, y, z);
        post.append(&tube(&round_path(&[p(-0.20, -0.1), p(-0.20, 0.08), p(-0.13, 0.08)], 0.03, 3), 0.008, 6));
    }
    post.append(&bevel_box(DVec3::new(-0.18, -0.21, -0.115), DVec3::new(0.18, -0.17, -0.085), 0.004));
    post.append(&bevel_box(DVec3::new(-0.1, -1.23, -0.2), DVec3::new(0.1, -1.208, 0.0), 0.004));
    pool.document.scatter("lifebuoy post", &post, steel, &places);
}

/// The lifeguard's high chair.
fn chair(pool: &mut Pool) {
    let white = joinery::paint(pool, "white paint", joinery::WHITE);
    let mut chair = Mesh::default();
    let seat = 1.55;
    for x in [-1.0, 1.0] {
        let p = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
        chair.append(&tube(&[p(0.42 * x, 0.0, 0.62), p(0.30 * x, seat, 0.28)], 0.024, 10));
        chair.append(&tube(
            &[p(0.42 * x, 0.0, -0.55), p(0.30 * x, seat, -0.22), p(0.30 * x, seat + 0.75, -0.38)],
            0.024,
            10,
        ));
        chair.append(&tube(
            &[p(0.30 * x, seat + 0.26, -0.26), p(0.30 * x, seat + 0.26, 0.26), p(0.30 * x, seat, 0.28)],
            0.02,
            10,
        ));
        chair.append(&tube(&[p(0.40 * x, 0.25, 0.565), p(0.40 * x, 0.25, -0.50)], 0.016, 8));
    }
    for i in 0..4 {
        let t = 0.18 + 0.22 * f64::from(i);
        let (half, y, z) = (0.42 - 0.12 * t, seat * t, 0.62 - 0.34 * t);
        chair.append(&bevel_box(
            DVec3::new(-half, y - 0.015, z - 0.05),
            DVec3::new(half, y + 0.015, z + 0.04),
            0.006,
        ));
    }
    chair.append(&bevel_box(
        DVec3::new(-0.31, seat - 0.01, -0.24),
        DVec3::new(0.31, seat + 0.03, 0.30),
        0.012,
    ));
    for i in 0..3 {
        let board = bevel_box(DVec3::new(-0.31, -0.07, -0.012), DVec3::new(0.31, 0.07, 0.012), 0.006);
        let y = seat + 0.22 + 0.2 * f64::from(i);
        chair.append_at(
            &board,
            &Placement::xyz(0.0, y, -0.235 - 0.042 * f64::from(i)).turned(DVec3::X, -12.0),
        );
    }
    let place = Placement::xyz(3.4, 0.0, 7.75).turned_y(180.0);
    pool.document.scatter("lifeguard chair", &chair.box_uvs(DVec2::ZERO), white, &[place]);
}

/// White loungers, some with a striped towel.
fn loungers(pool: &mut Pool) {
    let white = pool.material("white plastic", |_| Material::new("white plastic", [0.80, 0.80, 0.78], 0.35));
    let mut frame = Mesh::default();
    // Lying along x, the head towards -x; the back is raised.
    let raise = DVec3::new(-0.72, 0.62, 0.0);
    for z in [-0.31, 0.31] {
        let p = |x: f64, y: f64| DVec3::new(x, y, z);
        frame.append(&tube(
            &round_path(&[p(1.05, 0.30), p(-0.25, 0.32), p(-0.25 + raise.x, 0.32 + raise.y)], 0.12, 4),
            0.022,
            10,
        ));
        for x in [0.8, -0.15] {
            frame.append(&tube(&[p(x, 0.31), p(x + 0.06, 0.0)], 0.02, 10));
        }
    }
    let slat = bevel_box(DVec3::new(-0.038, -0.008, -0.30), DVec3::new(0.038, 0.008, 0.30), 0.004);
    for i in 0..13 {
        frame.append_at(&slat, &Placement::xyz(1.0 - 0.093 * f64::from(i), 0.323, 0.0));
    }
    for i in 0..9 {
        let at = DVec3::new(-0.33, 0.375, 0.0) + raise * (0.115 * f64::from(i));
        frame.append_at(&slat, &Placement::at(at).turned(DVec3::Z, -40.7));
    }
    let places = [
        Placement::xyz(-6.6, 0.0, 8.75).turned_y(97.0),
        Placement::xyz(-4.9, 0.0, 8.85).turned_y(88.0),
        Placement::xyz(16.0, 0.0, 6.8).turned_y(20.0),
    ];
    pool.document.scatter("lounger", &Mesh { uvs: Vec::new(), ..frame }, white, &places);
    towels(pool, &places);
}

fn towels(pool: &mut Pool, loungers: &[Placement]) {
    let terry = pool.texture("terry normal", [0.1; 2], || {
        let loops = Noise::new(801, [16, 16]);
        Grey::from_fn([128; 2], |u, v| 0.002 * loops.at(u, v)).normal_map([0.1; 2])
    });
    let stripes = pool.texture("towel stripes", [1.0; 2], || {
        let at = |_: f64, v: f64| {
            let t = (v * 9.0).fract();
            let stripe = smoothstep(0.30, 0.32, t) - smoothstep(0.68, 0.70, t);
            DVec3::new(0.80, 0.78, 0.72).lerp(DVec3::new(0.70, 0.12, 0.06), stripe)
        };
        Picture::from_fn([8, 256], at).png()
    });
    let material = pool.material("striped towel", |_| {
        Material::new("striped towel", [1.0; 3], 1.0)
            .color_texture(stripes)
            .normal_texture(terry.of_size([0.05; 2]), 1.0)
            .double_sided()
            .extension(
                "KHR_materials_sheen",
                serde_json::json!({ "sheenColorFactor": [0.2, 0.2, 0.2], "sheenRoughnessFactor": 0.6 }),
            )
    });
    // Over the seat and down on both sides, with folds.
    let folds = Noise::new(811, [4, 5]);
    let (columns, rows) = (18, 22);
    let mut towel = Mesh::default();
    let point = |i: f64, k: f64| {
        let (u, v) = (i / f64::from(columns), k / f64::from(rows));
        let across = (u - 0.5) * 0.98;
        let over = (across.abs() - 0.33).max(0.0);
        let x = 0.95 - 1.15 * v;
        let wave = 0.012 * folds.fbm(u, v, 3) + 0.02 * over * libm::sin(v * 23.0);
        let z = across.clamp(-0.345, 0.345) + across.signum() * (0.10 * over + wave.abs() * over * 6.0);
        DVec3::new(
            x + 0.03 * folds.at(v, u),
            0.348 + 0.006 * wave.abs() + 0.010 * folds.at(u, v).abs() - over,
            z,
        )
    };
    for k in 0..=rows {
        for i in 0..=columns {
            let (i, k) = (f64::from(i), f64::from(k));
            let n = (point(i, k + 0.5) - point(i, k - 0.5)).cross(point(i + 0.5, k) - point(i - 0.5, k));
            let n = if n.y < 0.0 { -n } else { n };
            let uv = DVec2::new(i / f64::from(columns), k / f64::from(rows));
            towel.push_uv(point(i, k), n, uv);
        }
    }
    let columns = columns as u32;
    for k in 0..rows as u32 {
        for i in 0..columns {
            let at = |i: u32, k: u32| k * (columns + 1) + i;
            towel.quad(at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
        }
    }
    pool.document.scatter("striped towel", &towel, material, &[loungers[0], loungers[2]]);
}

/// A stack of kickboards beside the blocks, and one left on the deck.
fn kickboards(pool: &mut Pool) {
    let (w, l, r) = (0.14, 0.20, 0.09);
    let mut outline = Vec::new();
    // Square at the foot, round at the head.
    outline.extend([DVec2::new(-w, -l), DVec2::new(w, -l)]);
    for i in 0..=10 {
        let (s, c) = libm::sincos(std::f64::consts::PI * f64::from(i) / 10.0);
        outline.push(DVec2::new(w * c, l - r + r * s));
    }
    let board =
        extrude_beveled(&outline, 0.034, 0.009).placed(&Placement::at(DVec3::ZERO).turned(DVec3::X, -90.0));
    let mut stacks = [Vec::new(), Vec::new(), Vec::new()];
    for i in 0..9u32 {
        let turn = 9.0 * libm::sin(f64::from(i) * 2.1);
        let place = Placement::xyz(-13.85, 0.004 + 0.0345 * f64::from(i), 6.55).turned_y(turn + 40.0);
        stacks[(i % 3) as usize].push(place);
    }
    stacks[1].push(Placement::xyz(-11.0, 0.004, 8.1).turned_y(-35.0));
    stacks[0].push(Placement::xyz(-13.45, 0.004, 7.35).turned_y(75.0));
    let foams = [
        ("red foam", [0.66, 0.06, 0.035]),
        ("blue foam", [0.02, 0.16, 0.52]),
        ("yellow foam", [0.86, 0.58, 0.05]),
    ];
    for ((name, color), places) in foams.into_iter().zip(stacks) {
        let foam = pool.material(name, |_| Material::new(name, color, 0.8));
        pool.document.scatter(&format!("kickboard, {name}"), &board, foam, &places);
    }
}

/// Showers on the way to the water.
fn shower(pool: &mut Pool) {
    let steel = lanes::chrome(pool);
    let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let mut shower =
        tube(&round_path(&[p(0.0, 0.0), p(0.0, 2.35), p(0.42, 2.35), p(0.42, 2.22)], 0.14, 8), 0.026, 14);
    let rose = [(0.0, 0.03), (0.02, 0.03), (0.09, 0.0), (0.09, -0.012), (0.0, -0.016)];
    let rose: Vec<DVec2> = rose.iter().rev().map(|p| DVec2::from(*p)).collect();
    shower.append(&lathe(&rose, 20, 30.0).moved(p(0.42, 2.2)));
    let knob = [(0.0, 0.0), (0.03, 0.0), (0.035, 0.04), (0.0, 0.045)].map(DVec2::from);
    shower.append(&lathe(&knob, 12, 30.0).placed(&Placement::at(p(0.02, 1.1)).turned(DVec3::Z, -90.0)));
    let foot = [(0.0, 0.0), (0.11, 0.0), (0.11, 0.015), (0.05, 0.05), (0.0, 0.05)].map(DVec2::from);
    shower.append(&lathe(&foot, 20, 30.0));
    let places = [Placement::xyz(-15.4, 0.0, -11.8), Placement::xyz(-16.9, 0.0, -11.8)];
    pool.document.scatter("shower", &Mesh { uvs: Vec::new(), ..shower }, steel, &places);
}

/// Litter bins of perforated sheet.
fn bins(pool: &mut Pool) {
    let green = joinery::paint(pool, "green paint", [0.03, 0.16, 0.085]);
    let profile = [
        (0.0, 0.03),
        (0.20, 0.03),
        (0.21, 0.05),
        (0.235, 0.72),
        (0.25, 0.73),
        (0.25, 0.76),
        (0.22, 0.765),
        (0.20, 0.70),
        (0.18, 0.10),
        (0.0, 0.10),
    ];
    let bin = lathe(&profile.map(DVec2::from), 28, 30.0);
    let places =
        [Placement::xyz(-1.9, 0.0, -12.6), Placement::xyz(14.9, 0.0, -7.0), Placement::xyz(9.4, 0.0, 12.6)];
    pool.document.scatter("bin", &bin, green, &places);
}
