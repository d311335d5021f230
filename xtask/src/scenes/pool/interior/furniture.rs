//! The furniture of the changing room: shelf, cabinet, benches, mats, pallets, hooks. Each stands on y = 0 with its back towards
//! -z and its middle over the origin, unless told otherwise.

use super::parts::{block, grained};
use crate::scenes::kit::{Mesh, Placement, extrude, hash01, lathe, round_path, tube};
use glam::{DVec2, DVec3};

/// Columns and rows of the shelf, the inside of a cell, the thickness of its boards, its depth and the height of its foot.
pub(super) const CELLS: [usize; 2] = [9, 3];
pub(super) const CELL: [f64; 2] = [0.30, 0.34];
pub(super) const BOARD: f64 = 0.018;
pub(super) const SHELF_DEPTH: f64 = 0.36;
pub(super) const SHELF_FOOT: f64 = 0.07;

/// The width of the shelf.
pub(super) fn shelf_width() -> f64 {
    CELLS[0] as f64 * (CELL[0] + BOARD) + BOARD
}

/// The middle of the floor of a cell, columns from the left and rows from below, at half the shelf's depth.
pub(super) fn cell_floor(column: usize, row: usize) -> DVec3 {
    let x = -shelf_width() / 2.0 + BOARD + CELL[0] / 2.0 + column as f64 * (CELL[0] + BOARD);
    DVec3::new(x, SHELF_FOOT + BOARD + row as f64 * (CELL[1] + BOARD), 0.0)
}

/// A shelf of 9 x 3 open cells of plywood: boards, uprights between them, a back and a foot set back from the front.
pub(super) fn shelf() -> Mesh {
    let (half_width, half_depth) = (shelf_width() / 2.0, SHELF_DEPTH / 2.0);
    let pitch = CELL[1] + BOARD;
    let top = SHELF_FOOT + CELLS[1] as f64 * pitch + BOARD;
    let mut shelf = Mesh::default();
    for row in 0..=CELLS[1] {
        let y = SHELF_FOOT + row as f64 * pitch;
        // The boards reach over the uprights and stand 2 mm before them.
        shelf.append(
            &block([-half_width, y, -half_depth], [half_width, y + BOARD, half_depth], 0.002)
                .box_uvs(DVec2::new(0.3 * row as f64, 0.0)),
        );
    }
    for column in 0..=CELLS[0] {
        let x = -half_width + column as f64 * (CELL[0] + BOARD);
        for row in 0..CELLS[1] {
            let y = SHELF_FOOT + BOARD + row as f64 * pitch;
            let upright = block(
                [x, y - 0.002, -half_depth + 0.006],
                [x + BOARD, y + CELL[1] + 0.002, half_depth - 0.002],
                0.0015,
            );
            shelf.append(&grained(upright, DVec3::Y, DVec2::new(0.17 * column as f64, 0.41 * row as f64)));
        }
    }
    let back = block(
        [-half_width + 0.004, SHELF_FOOT, -half_depth + 0.001],
        [half_width - 0.004, top - 0.002, -half_depth + 0.007],
        0.001,
    );
    shelf.append(&back.box_uvs(DVec2::new(0.1, 0.6)));
    let foot = block(
        [-half_width + 0.03, 0.0, -half_depth + 0.03],
        [half_width - 0.03, SHELF_FOOT + 0.002, half_depth - 0.05],
        0.002,
    );
    shelf.append(&foot.box_uvs(DVec2::new(0.7, 0.2)));
    shelf
}

/// Length, height and depth of a bench.
pub(super) const BENCH: [f64; 3] = [1.8, 0.45, 0.36];

/// The three slats of a bench.
pub(super) fn bench_seat() -> Mesh {
    let [length, height, depth] = BENCH;
    let gap = 0.012;
    let width = (depth - 2.0 * gap) / 3.0;
    let mut seat = Mesh::default();
    for i in 0..3 {
        let z = -depth / 2.0 + f64::from(i) * (width + gap);
        let slat = block([-length / 2.0, height - 0.032, z], [length / 2.0, height, z + width], 0.006);
        seat.append(&slat.box_uvs(DVec2::new(0.37 * f64::from(i), 0.21 * f64::from(i))));
    }
    seat
}

/// The white tubes that carry a bench: two bent frames, a rail under the seat on each side, one between the feet, and rubber feet.
pub(super) fn bench_frame() -> Mesh {
    let [length, height, depth] = BENCH;
    let (r, top, z) = (0.016, height - 0.032 - 0.016, depth / 2.0 - 0.045);
    let x = length / 2.0 - 0.22;
    let mut frame = Mesh::default();
    for side in [-x, x] {
        let corners = [
            DVec3::new(side, 0.004, z + 0.03),
            DVec3::new(side, top, z),
            DVec3::new(side, top, -z),
            DVec3::new(side, 0.004, -z - 0.03),
        ];
        frame.append(&tube(&round_path(&corners, 0.06, 4), r, 10));
    }
    for (y, rail_z) in [(top, z - 0.09), (top, -z + 0.09)] {
        frame.append(&tube(&[DVec3::new(-x, y, rail_z), DVec3::new(x, y, rail_z)], 0.012, 12));
    }
    // The frames lean out a little, so a rail at their middle height joins the two at the back.
    let rail_z = -z - 0.02;
    frame.append(&tube(&[DVec3::new(-x, 0.14, rail_z), DVec3::new(x, 0.14, rail_z)], 0.012, 12));
    frame
}

/// The rubber feet of a bench.
pub(super) fn bench_feet() -> Mesh {
    let (x, z) = (BENCH[0] / 2.0 - 0.22, BENCH[2] / 2.0 - 0.015);
    let foot = lathe(
        &[(0.0, 0.0), (0.019, 0.0), (0.021, 0.003), (0.020, 0.028), (0.0, 0.028)].map(DVec2::from),
        8,
        40.0,
    );
    let mut feet = Mesh::default();
    for (sx, sz) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
        feet.append(&foot.clone().moved(DVec3::new(sx * x, 0.0, sz * z)));
    }
    feet
}

/// Width, height and depth of the cabinet.
pub(super) const CABINET: [f64; 3] = [0.92, 1.86, 0.46];

/// The body and the two doors of a steel cabinet, with vents, hinges and feet.
pub(super) fn cabinet() -> Mesh {
    let [width, height, depth] = CABINET;
    let (w, d) = (width / 2.0, depth / 2.0);
    let mut body = block([-w, 0.10, -d], [w, height, d - 0.022], 0.004);
    body.append(&block([-w + 0.03, 0.0, -d + 0.03], [w - 0.03, 0.105, d - 0.06], 0.003));
    for side in [-1.0, 1.0] {
        let (near, far) = (0.0015, w - 0.003);
        let (x0, x1) = if side < 0.0 { (-far, -near) } else { (near, far) };
        body.append(&block([x0, 0.106, d - 0.021], [x1, height - 0.006, d], 0.003));
        // Louvres: folded strips that lean out over their slots, above and below.
        for (base, count) in [(height - 0.30, 6), (0.24, 4)] {
            for i in 0..count {
                let y = base + 0.026 * f64::from(i);
                let louvre = block([-0.11, -0.007, -0.004], [0.11, 0.007, 0.002], 0.0012);
                let at = DVec3::new((x0 + x1) / 2.0, y, d + 0.0035);
                body.append_at(&louvre, &Placement::at(at).turned(DVec3::X, -32.0));
            }
        }
        for y in [0.35, 1.0, 1.65] {
            let hinge = DVec3::new(side * (w + 0.002), y, d - 0.016);
            body.append(&tube(&[hinge - DVec3::Y * 0.03, hinge + DVec3::Y * 0.03], 0.006, 10));
        }
    }
    body
}

/// What is bright metal on the cabinet: a turning handle with its plate and two frames for labels.
pub(super) fn cabinet_metal() -> Mesh {
    let d = CABINET[2] / 2.0;
    let mut metal = block([0.030, 0.98, d], [0.062, 1.10, d + 0.004], 0.0015);
    metal.append(&tube(&[DVec3::new(0.046, 1.06, d + 0.002), DVec3::new(0.046, 1.06, d + 0.03)], 0.007, 10));
    metal.append(&block([0.036, 0.955, d + 0.026], [0.056, 1.075, d + 0.036], 0.003));
    for x in [-0.23, 0.23] {
        for (a, b) in [
            ([-0.045, -0.025], [0.045, -0.021]),
            ([-0.045, 0.021], [0.045, 0.025]),
            ([-0.045, -0.025], [-0.041, 0.025]),
            ([0.041, -0.025], [0.045, 0.025]),
        ] {
            metal.append(&block(
                [x + a[0], 1.45 + a[1], d - 0.001],
                [x + b[0], 1.45 + b[1], d + 0.003],
                0.0008,
            ));
        }
    }
    metal
}

/// Length and width of a mat.
pub(super) const MAT: [f64; 2] = [1.0, 0.6];

/// A duckboard mat of soft plastic: bars along x, their upper edges cut off, over bars across.
pub(super) fn mat() -> Mesh {
    let [length, width] = MAT;
    let (bars, bar, bevel) = (17, 0.021, 0.003);
    let mut mat = Mesh::default();
    let pitch = (width - bar) / f64::from(bars - 1);
    let outline = [
        (0.0, 0.006),
        (bar, 0.006),
        (bar, 0.014 - bevel),
        (bar - bevel, 0.014),
        (bevel, 0.014),
        (0.0, 0.014 - bevel),
    ];
    let along =
        extrude(&outline.map(DVec2::from), length).placed(&Placement::at(DVec3::ZERO).turned_y(-90.0));
    let along = Mesh { uvs: Vec::new(), ..along.without_side(DVec3::NEG_Y) };
    for i in 0..bars {
        let z = -width / 2.0 + f64::from(i) * pitch;
        mat.append(&along.clone().moved(DVec3::new(length / 2.0, 0.0, z)));
    }
    for i in 0..6 {
        let x = -length / 2.0 + 0.03 + f64::from(i) * (length - 0.06 - 0.02) / 5.0;
        let across = block([x, 0.0, -width / 2.0 + 0.004], [x + 0.02, 0.008, width / 2.0 - 0.004], 0.001);
        mat.append(&across.without_side(DVec3::NEG_Y).without_side(DVec3::Y));
    }
    mat
}

/// Length and depth of a pallet, its height.
pub(super) const PALLET: [f64; 3] = [1.0, 0.13, 0.8];

/// A wooden pallet: deck boards along x over three bearers of blocks and boards, runners below. No two boards are alike.
pub(super) fn pallet(seed: u64) -> Mesh {
    let [length, height, depth] = PALLET;
    let random = |k: u64| hash01(seed, k) - 0.5;
    let mut pallet = Mesh::default();
    let mut counter = 0;
    let mut add = |min: [f64; 3], max: [f64; 3], along_x: bool| {
        counter += 1;
        let shift = DVec2::new(3.1 * random(counter), 2.7 * random(counter + 50));
        let plank = block(min, max, 0.0025);
        pallet.append(&grained(plank, if along_x { DVec3::X } else { DVec3::Z }, shift));
    };
    let deck = 0.018;
    let (boards, width) = (7, 0.095);
    for i in 0..boards {
        let z = -depth / 2.0 + f64::from(i) * (depth - width) / f64::from(boards - 1);
        let (jx, jz) = (0.005 * random(200 + i as u64), 0.006 * random(220 + i as u64));
        let z = (z + jz).clamp(-depth / 2.0, depth / 2.0 - width);
        add([-length / 2.0 + jx, height - deck, z], [length / 2.0 + jx, height, z + width], true);
    }
    for x in [-length / 2.0 + 0.005, -0.05, length / 2.0 - 0.105] {
        // Cross board, blocks, runner.
        add([x, height - 2.0 * deck, -depth / 2.0], [x + 0.10, height - deck, depth / 2.0], false);
        for z in [-depth / 2.0 + 0.002, -0.07, depth / 2.0 - 0.142] {
            add([x + 0.004, deck, z], [x + 0.096, height - 2.0 * deck, z + 0.14], false);
        }
        add([x + 0.002, 0.0, -depth / 2.0 + 0.003], [x + 0.098, deck, depth / 2.0 - 0.003], false);
    }
    pallet
}

/// A rail of hooks for the wall: a board of `length` along x in front of the wall at z = 0, and where its hooks are.
pub(super) fn hook_rail(length: f64) -> Mesh {
    block([-length / 2.0, -0.05, 0.0], [length / 2.0, 0.05, 0.02], 0.003).box_uvs(DVec2::ZERO)
}

/// Two-armed hook of bent wire, on the front of a rail at the origin.
pub(super) fn hook() -> Mesh {
    let mut hook = block([-0.012, -0.03, 0.0], [0.012, 0.03, 0.003], 0.001);
    let upper = [(0.0, 0.018, 0.002), (0.0, 0.020, 0.045), (0.0, 0.055, 0.062)];
    let lower = [(0.0, -0.014, 0.002), (0.0, -0.030, 0.026), (0.0, -0.012, 0.044)];
    for arm in [upper, lower] {
        let path = round_path(&arm.map(DVec3::from), 0.015, 2);
        hook.append(&tube(&path, 0.0042, 6));
    }
    hook
}
