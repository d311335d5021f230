//! The basin: tiled walls and sloping floor with lane lines, the water, the worn white kerb around it.

use super::{DEPTH, HALF_LENGTH, HALF_WIDTH, LANE_WIDTH, LANES, Pool, WATER, surfaces};
use crate::scenes::kit::{Material, Mesh, Noise, Placement, hash01, rectangle};
use glam::{DVec2, DVec3};

/// How far the kerb stands over the water and how wide it is.
const KERB_NOSE: f64 = 0.03;
pub(super) const KERB_WIDTH: f64 = 0.40;
/// Height of its top over the deck.
pub(super) const KERB_TOP: f64 = 0.14;

/// Height of the floor: it falls from one end to the other.
fn floor(x: f64) -> f64 {
    let t = (x + HALF_LENGTH) / (2.0 * HALF_LENGTH);
    DEPTH[0] + (DEPTH[1] - DEPTH[0]) * t
}

/// Walls, floor and water.
pub(super) fn basin(pool: &mut Pool) {
    let tiles = surfaces::pool_tiles(pool);
    let mut shell = Mesh::default();
    let corner = |sx: f64, sz: f64, top: bool| {
        let x = sx * HALF_LENGTH;
        DVec3::new(x, if top { KERB_TOP - 0.05 } else { floor(x) }, sz * HALF_WIDTH)
    };
    // Facing inward: floor, then the walls at -z, +z, -x, +x.
    let faces = [
        [(-1.0, 1.0, false), (1.0, 1.0, false), (1.0, -1.0, false), (-1.0, -1.0, false)],
        [(-1.0, -1.0, false), (1.0, -1.0, false), (1.0, -1.0, true), (-1.0, -1.0, true)],
        [(1.0, 1.0, false), (-1.0, 1.0, false), (-1.0, 1.0, true), (1.0, 1.0, true)],
        [(-1.0, 1.0, false), (-1.0, -1.0, false), (-1.0, -1.0, true), (-1.0, 1.0, true)],
        [(1.0, -1.0, false), (1.0, 1.0, false), (1.0, 1.0, true), (1.0, -1.0, true)],
    ];
    for face in faces {
        shell.flat_quad(face.map(|(x, z, top)| corner(x, z, top)), [DVec2::ZERO; 4]);
    }
    pool.document.place("basin", &shell.box_uvs(DVec2::ZERO), tiles);
    lane_lines(pool);
    water(pool);
}

/// A line of dark tiles along the middle of each lane with a bar at either end, and a cross on the end walls.
fn lane_lines(pool: &mut Pool) {
    let dark = surfaces::lane_tiles(pool);
    let (half, lift) = (0.125, 0.004);
    let mut lines = Mesh::default();
    let mut strip = |[x0, x1]: [f64; 2], [z0, z1]: [f64; 2]| {
        let p = |x: f64, z: f64| DVec3::new(x, floor(x) + lift, z);
        lines.flat_quad([p(x0, z1), p(x1, z1), p(x1, z0), p(x0, z0)], [DVec2::ZERO; 4]);
    };
    let end = HALF_LENGTH - 2.0;
    for lane in 0..LANES {
        let z = lane_z(lane);
        strip([-end, end], [z - half, z + half]);
        strip([-end - 2.0 * half, -end], [z - 0.5, z + 0.5]);
        strip([end, end + 2.0 * half], [z - 0.5, z + 0.5]);
    }
    for side in [-1.0, 1.0] {
        let x = side * (HALF_LENGTH - lift);
        let bottom = floor(x);
        for lane in 0..LANES {
            let z = lane_z(lane);
            for ([low, high], w) in [([bottom, -0.45], half), ([-0.85, -0.60], 0.4)] {
                let w = if w > half { w } else { half };
                let (corner, across) = (DVec3::new(x, low, z + side * -w), DVec3::Z * (2.0 * w * side));
                // The bar of the cross lies a little before its stem.
                let corner = corner - DVec3::X * side * if w > half { 0.002 } else { 0.0 };
                lines.append(&rectangle(corner, across, DVec3::Y * (high - low)));
            }
        }
    }
    pool.document.place("lane lines", &lines.box_uvs(DVec2::ZERO), dark);
}

/// The middle of a lane.
pub(super) fn lane_z(lane: usize) -> f64 {
    (lane as f64 + 0.5) * LANE_WIDTH - HALF_WIDTH
}

/// A closed body whose sides and bottom lie inside the walls, so that only its surface is ever met.
fn water(pool: &mut Pool) {
    let material = pool.material("water", |_| {
        Material::new("water", [1.0; 3], 0.0).transmissive(1.333).volume([0.42, 0.82, 0.88], 4.5)
    });
    let inside = 0.06;
    let (x, z) = (HALF_LENGTH + inside, HALF_WIDTH + inside);
    let p = |i: usize| {
        let sx = if i & 1 == 1 { x } else { -x };
        let sz = if i & 2 == 2 { z } else { -z };
        DVec3::new(sx, if i & 4 == 4 { WATER } else { floor(sx) - inside }, sz)
    };
    let faces = [[4, 6, 7, 5], [0, 1, 3, 2], [2, 3, 7, 6], [1, 0, 4, 5], [3, 1, 5, 7], [0, 2, 6, 4]];
    let faces: Vec<Vec<DVec3>> = faces.iter().map(|f| f.iter().map(|&i| p(i)).collect()).collect();
    pool.document.place("water", &crate::scenes::kit::faceted(&faces), material);
}

/// The kerb, of stones about a metre long.
pub(super) fn kerb(pool: &mut Pool) {
    let paint = surfaces::kerb_white(pool);
    let mut places = vec![Vec::new(); KERB_STONES.len()];
    let mut put = |placement: Placement| {
        let count = places.iter().map(Vec::len).sum::<usize>();
        places[(hash01(200, count as u64) * KERB_STONES.len() as f64) as usize].push(placement);
    };
    for i in 0..25 {
        let x = f64::from(i) - 12.0;
        put(Placement::xyz(x, 0.0, HALF_WIDTH));
        put(Placement::xyz(-x, 0.0, -HALF_WIDTH).turned_y(180.0));
    }
    // The short sides take the corners.
    let length = (2.0 * HALF_WIDTH + 2.0 * KERB_WIDTH) / 13.0;
    for i in 0..13 {
        let z = (f64::from(i) - 6.0) * length;
        let stretch = DVec3::new(length, 1.0, 1.0);
        put(Placement::xyz(HALF_LENGTH, 0.0, z).turned_y(90.0).stretched(stretch));
        put(Placement::xyz(-HALF_LENGTH, 0.0, z).turned_y(-90.0).stretched(stretch));
    }
    for (name, places) in KERB_STONES.iter().zip(places) {
        let seed = name.len() as u64 + name.bytes().map(u64::from).sum::<u64>();
        pool.document.scatter(name, &kerb_stone(seed), paint, &places);
    }
}

const KERB_STONES: [&str; 4] = ["kerb stone a", "kerb stone b", "kerb stone c", "kerb stone d"];

/// A stone a metre long along x, its outer side towards +z, with chipped edges.
fn kerb_stone(seed: u64) -> Mesh {
    const STEPS: usize = 7;
    let (nose, top, width) = (-KERB_NOSE, KERB_TOP, KERB_WIDTH);
    let profile = [
        (0.03, -0.12),
        (nose, -0.12),
        (nose, top - 0.035),
        (nose + 0.01, top - 0.01),
        (nose + 0.035, top),
        (width - 0.03, top + 0.004),
        (width - 0.008, top - 0.008),
        (width, top - 0.03),
        (width, -0.03),
    ];
    let (chips, waves) = (Noise::new(seed, [9, 8]), Noise::new(seed + 50, [3, 8]));
    let middle = DVec2::new(0.18, 0.0);
    // Corners of the profile wear, its flat sides do not.
    let worn = |i: usize, k: usize| {
        let p = DVec2::from(profile[i]);
        let edge = [0.0, 0.0, 0.3, 1.0, 0.6, 0.3, 1.0, 0.3, 0.0][i];
        let (u, v) = (k as f64 / STEPS as f64 * 0.93, i as f64 / 30.0);
        let chip = (chips.at(u, v) - 0.18).max(0.0) * 0.035 + 0.003 * waves.at(u, v).abs();
        p + (middle - p).normalize() * chip * edge
    };
    let half = 0.496;
    let x = |k: usize| (k as f64 / STEPS as f64 * 2.0 - 1.0) * half;
    let mut mesh = Mesh::default();
    for i in 0..profile.len() - 1 {
        for k in 0..STEPS {
            let p = |i: usize, k: usize| {
                let q = worn(i, k);
                DVec3::new(x(k), q.y, q.x)
            };
            let (a, b, c, d) = (p(i, k), p(i, k + 1), p(i + 1, k + 1), p(i + 1, k));
            mesh.flat_quad([a, d, c, b], [DVec2::ZERO; 4]);
        }
    }
    for (k, side) in [(0, -1.0), (STEPS, 1.0)] {
        let centre = DVec3::new(x(k), 0.03, 0.18);
        for i in 0..profile.len() {
            let [a, b] = [i, (i + 1) % profile.len()].map(|i| DVec3::new(x(k), worn(i, k).y, worn(i, k).x));
            let ids = [centre, a, b].map(|p| mesh.push_uv(p, DVec3::X * side, DVec2::ZERO));
            mesh.triangles.push(if side > 0.0 { ids } else { [ids[0], ids[2], ids[1]] });
        }
    }
    mesh.box_uvs(DVec2::new(hash01(seed, 1), hash01(seed, 2)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::kit::checks::assert_oriented;

    #[test]
    fn stones_face_outward() {
        for seed in 0..8 {
            let stone = kerb_stone(seed);
            assert_oriented(&stone);
            for (p, n) in stone.positions.iter().zip(&stone.normals) {
                assert!(n.dot(*p - DVec3::new(0.0, 0.0, 0.2)) > 0.0, "{p} faces {n}");
            }
        }
    }
}
