//! What belongs to swimming: lane ropes with their floats, ladders, starting blocks, backstroke flags.

use super::basin::lane_z;
use super::{HALF_LENGTH, HALF_WIDTH, LANE_WIDTH, LANES, Pool, WATER, joinery};
use crate::scenes::kit::{
    Grey, Material, Mesh, Picture, Placement, bevel_box, extrude_beveled, lathe, lettering, round_path,
    smoothstep, tube,
};
use glam::{DVec2, DVec3};

/// Chrome, a little dull.
pub(super) fn chrome(pool: &mut Pool) -> usize {
    pool.material("chrome", |_| Material::metal("chrome", [0.78, 0.79, 0.80], 0.32))
}

/// A plastic of one colour.
fn plastic(pool: &mut Pool, name: &'static str, color: [f64; 3]) -> usize {
    pool.material(name, |_| Material::new(name, color, 0.38))
}

/// Ropes between the lanes: a line with floats by turns blue and yellow.
pub(super) fn ropes(pool: &mut Pool) {
    let (blue, yellow) = (
        plastic(pool, "blue float", [0.012, 0.085, 0.42]),
        plastic(pool, "yellow float", [0.88, 0.56, 0.02]),
    );
    let profile =
        [(0.0, -0.105), (0.052, -0.105), (0.066, -0.088), (0.066, 0.088), (0.052, 0.105), (0.0, 0.105)];
    let float = lathe(&profile.map(DVec2::from), 8, 50.0)
        .placed(&Placement::xyz(0.0, 0.0, 0.0).turned(DVec3::Z, 90.0));
    let mut places = [Vec::new(), Vec::new()];
    let mut lines = Mesh::default();
    for rope in 1..LANES {
        let z = rope as f64 * LANE_WIDTH - HALF_WIDTH;
        // A rope is never quite straight.
        let line = |x: f64| {
            let phase = rope as f64 * 1.7;
            let sway = 0.035 * libm::sin(x * 0.42 + phase) * (1.0 - (x / HALF_LENGTH) * (x / HALF_LENGTH));
            DVec3::new(x, WATER + 0.022 + 0.006 * libm::sin(x * 2.3 + phase), z + sway)
        };
        let path: Vec<DVec3> =
            (0..=40).map(|i| line((f64::from(i) / 20.0 - 1.0) * (HALF_LENGTH - 0.02))).collect();
        lines.append(&tube(&path, 0.008, 4));
        let count = 72;
        for i in 0..count {
            let x = (i as f64 - (count - 1) as f64 / 2.0) * 0.341;
            places[i % 2].push(Placement::at(line(x)));
        }
    }
    let white = plastic(pool, "white rope", [0.75, 0.75, 0.72]);
    pool.document.place("ropes", &lines, white);
    pool.document.scatter("blue float", &float, blue, &places[0]);
    pool.document.scatter("yellow float", &float, yellow, &places[1]);
}

/// Chrome ladders on both long sides.
pub(super) fn ladders(pool: &mut Pool) {
    let steel = chrome(pool);
    let mut ladder = Mesh::default();
    // The water lies towards -z.
    for x in [-0.26, 0.26] {
        let p = |y: f64, z: f64| DVec3::new(x, y, z);
        let path = round_path(
            &[p(0.0, 0.62), p(0.86, 0.62), p(0.98, 0.42), p(0.86, -0.10), p(-0.95, -0.16), p(-1.0, -0.02)],
            0.16,
            5,
        );
        ladder.append(&tube(&path, 0.021, 8));
        let flange = [(0.0, 0.0), (0.055, 0.0), (0.055, 0.008), (0.03, 0.02), (0.0, 0.02)].map(DVec2::from);
        ladder.append(&lathe(&flange, 16, 30.0).moved(DVec3::new(x, 0.0, 0.62)));
    }
    for y in [-0.18, -0.45, -0.72] {
        ladder.append(&bevel_box(DVec3::new(-0.25, y, -0.20), DVec3::new(0.25, y + 0.03, -0.11), 0.006));
    }
    let ladder = Mesh { uvs: Vec::new(), ..ladder };
    let places = [
        Placement::xyz(-9.3, 0.0, HALF_WIDTH + 0.02),
        Placement::xyz(9.6, 0.0, HALF_WIDTH + 0.02),
        Placement::xyz(-9.3, 0.0, -HALF_WIDTH - 0.02).turned_y(180.0),
        Placement::xyz(9.6, 0.0, -HALF_WIDTH - 0.02).turned_y(180.0),
    ];
    pool.document.scatter("ladder", &ladder, steel, &places);
}

/// Five white blocks with their numbers, a rough plate to stand on and a bar to hold.
pub(super) fn blocks(pool: &mut Pool) {
    let white = pool.material("block white", |_| Material::new("block white", [0.80, 0.80, 0.77], 0.32));
    let grip = pool.material("grip", |pool| {
        let normal = pool.texture("grip normal", [0.06; 2], || {
            let at = |u: f64, v: f64| {
                let d = |x: f64, y: f64| DVec2::new(u - x, v - y).length();
                let dot = d(0.25, 0.25).min(d(0.75, 0.75));
                smoothstep(0.2, 0.1, dot) * 0.0016
            };
            Grey::from_fn([64; 2], at).normal_map([0.06; 2])
        });
        Material::new("grip", [0.05, 0.10, 0.17], 0.75).normal_texture(normal, 1.0)
    });
    // Side view, the water towards +x: a body that leans over the kerb.
    let side = [
        (-0.36, 0.0),
        (0.16, 0.0),
        (0.20, 0.10),
        (0.20, 0.44),
        (0.46, 0.575),
        (0.46, 0.625),
        (-0.30, 0.715),
        (-0.36, 0.69),
    ];
    let body = extrude_beveled(&side.map(DVec2::from), 0.56, 0.022)
        .moved(DVec3::new(0.0, 0.0, -0.28))
        .box_uvs(DVec2::ZERO);
    let plate = bevel_box(DVec3::new(-0.345, 0.0, -0.25), DVec3::new(0.345, 0.014, 0.25), 0.004)
        .box_uvs(DVec2::ZERO)
        .placed(&Placement::xyz(0.085, 0.668, 0.0).turned(DVec3::Z, -6.75));
    let p = |y: f64, z: f64, x: f64| DVec3::new(x, y, z);
    let bar = tube(
        &round_path(
            &[p(0.47, -0.2, 0.24), p(0.47, -0.2, 0.36), p(0.47, 0.2, 0.36), p(0.47, 0.2, 0.24)],
            0.05,
            4,
        ),
        0.014,
        10,
    );
    let steel = joinery::galvanised(pool);
    let x = -HALF_LENGTH - 0.54;
    let places: Vec<Placement> = (0..LANES).map(|lane| Placement::xyz(x, 0.0, lane_z(lane))).collect();
    pool.document.scatter("starting block", &body, white, &places);
    pool.document.scatter("starting block plate", &plate, grip, &places);
    pool.document.scatter("starting block bar", &bar, steel, &places);
    numbers(pool, x);
}

/// Digits in a row, white on blue, and a plate for each block's back and sides.
fn numbers(pool: &mut Pool, x: f64) {
    let material = pool.material("numbers", |pool| {
        let color = pool.texture("numbers", [1.0; 2], || {
            let texts: Vec<_> = (1..=LANES).map(|n| lettering(&n.to_string())).collect();
            let at = |u: f64, v: f64| {
                let cell = ((u * LANES as f64) as usize).min(LANES - 1);
                let text = &texts[cell];
                let p = DVec2::new((u * LANES as f64).fract() - 0.5, v - 0.5) * 1.5;
                let d = text.distance(p + DVec2::new(text.width / 2.0, 0.5));
                let rim = p.abs().max_element();
                let paint = smoothstep(0.105, 0.09, d).max(smoothstep(0.665, 0.675, rim));
                DVec3::new(0.012, 0.075, 0.30).lerp(DVec3::new(0.82, 0.82, 0.80), paint)
            };
            Picture::from_fn([128 * LANES, 128], at).png()
        });
        Material::new("numbers", [1.0; 3], 0.35).color_texture(color)
    });
    for lane in 0..LANES {
        let mut plate = bevel_box(DVec3::new(-0.15, -0.15, 0.0), DVec3::new(0.15, 0.15, 0.008), 0.003);
        let cell = |p: &DVec3| DVec2::new((p.x / 0.3 + 0.5 + lane as f64) / LANES as f64, 0.5 - p.y / 0.3);
        plate.uvs = plate.positions.iter().map(cell).collect();
        let z = lane_z(lane);
        // Back, both sides.
        let places = [
            Placement::xyz(x - 0.36, 0.42, z).turned_y(-90.0),
            Placement::xyz(x - 0.06, 0.36, z + 0.28),
            Placement::xyz(x - 0.06, 0.36, z - 0.28).turned_y(180.0),
        ];
        pool.document.scatter(&format!("number {}", lane + 1), &plate, material, &places);
    }
}

/// Pennants on lines across the pool, by which swimmers on their backs know that the wall is near.
pub(super) fn flags(pool: &mut Pool) {
    let white = joinery::paint(pool, "white paint", joinery::WHITE);
    let top = 1.95;
    let reach = HALF_WIDTH + 0.95;
    let mut posts = Mesh::default();
    let mut places = Vec::new();
    for x in [-7.5, 7.5] {
        let line = |z: f64| DVec3::new(x, top - 0.16 * (1.0 - (z / reach) * (z / reach)), z);
        let path: Vec<DVec3> = (0..=24).map(|i| line((f64::from(i) / 12.0 - 1.0) * reach)).collect();
        posts.append(&tube(&path, 0.004, 5));
        for side in [-1.0, 1.0] {
            let foot = DVec3::new(x, 0.0, side * reach);
            posts.append(&tube(&[foot, foot + DVec3::Y * (top + 0.05)], 0.022, 12));
            let base = [(0.0, 0.0), (0.09, 0.0), (0.09, 0.012), (0.04, 0.05), (0.0, 0.05)].map(DVec2::from);
            posts.append(&lathe(&base, 16, 30.0).moved(foot));
        }
        let count = 30;
        for i in 0..count {
            let z = (i as f64 - (count - 1) as f64 / 2.0) * 0.44;
            let swing = 14.0 * libm::sin(i as f64 * 2.4 + x) + 10.0;
            let hung =
                Placement::at(line(z)).turned(DVec3::Z, swing).turned_y(6.0 * libm::sin(i as f64 * 1.3));
            places.push(hung);
        }
    }
    pool.document.place("flag posts", &posts, white);
    // A pennant bulges a little; it hangs from its upper edge, in the plane of y and z.
    let mut pennant = Mesh::default();
    let rows = 5;
    for i in 0..=rows {
        let t = f64::from(i) / f64::from(rows);
        let (y, half, x) = (-0.30 * t, 0.115 * (1.0 - t).max(0.04), 0.02 * libm::sin(t * 3.0));
        for (z, u) in [(half, 0.0), (-half, 1.0)] {
            pennant.push_uv(
                DVec3::new(x, y, z),
                DVec3::new(1.0, 0.05 * (1.0 - 2.0 * t), 0.0),
                DVec2::new(u, t),
            );
        }
    }
    for i in 0..rows as u32 {
        pennant.quad(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1);
    }
    let colors = [
        ("red pennant", [0.62, 0.035, 0.03]),
        ("white pennant", [0.80, 0.79, 0.76]),
        ("blue pennant", [0.02, 0.11, 0.45]),
        ("yellow pennant", [0.85, 0.55, 0.03]),
    ];
    for (k, (name, color)) in colors.into_iter().enumerate() {
        let cloth = pool.material(name, |_| Material::new(name, color, 0.85).double_sided());
        let own: Vec<Placement> = places.iter().copied().skip(k).step_by(colors.len()).collect();
        pool.document.scatter(name, &pennant, cloth, &own);
    }
}
