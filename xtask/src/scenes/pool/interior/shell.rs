//! The room itself: four walls of concrete with openings, seen from inside and outside, the floor, the ceiling and the roof.
//!
//! Coordinates are those of the room: x from 0 to 6, z from 0 to 5, the floor at y = 0. A wall has two faces, one towards the room
//! and one towards the weather, and the reveals of its openings between them; edges of openings are chamfered.

use super::parts::block;
use crate::scenes::kit::Mesh;
use glam::{DVec2, DVec3};

/// Width, height and depth of the room.
pub(super) const ROOM: DVec3 = DVec3::new(6.0, 2.8, 5.0);
/// Thickness of the walls.
pub(super) const WALL: f64 = 0.22;
/// Where board-marked concrete ends and plain concrete begins.
pub(super) const BOARDS_END: f64 = 1.9;
/// Height of the groove there, its depth, and the chamfer of the openings' edges.
const GROOVE: f64 = 0.014;
const GROOVE_DEPTH: f64 = 0.010;
const CHAMFER: f64 = 0.010;
/// How far the outer faces go below the floor and above the ceiling, into ground and roof.
const BELOW: f64 = 0.3;
const ABOVE: f64 = 0.01;

/// A hole in a wall: from `low` to `high`, along the wall and up.
#[derive(Clone, Copy)]
pub(super) struct Opening {
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

impl Opening {
    pub(super) fn new(low: [f64; 2], high: [f64; 2]) -> Self {
        Opening { low: DVec2::from(low), high: DVec2::from(high) }
    }

    /// With its chamfer; an opening that reaches the floor has none there.
    fn widened(&self) -> Opening {
        let below = if self.low.y > 0.0 { CHAMFER } else { 0.0 };
        Opening { low: self.low - DVec2::new(CHAMFER, below), high: self.high + CHAMFER }
    }

    fn holds(&self, p: DVec2) -> bool {
        p.cmpgt(self.low).all() && p.cmplt(self.high).all()
    }
}

/// A wall: `u` along it seen from the room, left to right, `inward` into the room.
pub(super) struct Wall {
    pub(super) corner: DVec3,
    pub(super) u: DVec3,
    pub(super) length: f64,
    pub(super) openings: Vec<Opening>,
    /// Added to texture coordinates, so that walls differ.
    pub(super) shift: f64,
}

impl Wall {
    /// Into the room.
    pub(super) fn inward(&self) -> DVec3 {
        self.u.cross(DVec3::Y)
    }

    /// The point at `p` along and up the wall, `depth` behind its inner face.
    fn at(&self, p: DVec2, depth: f64) -> DVec3 {
        self.corner + self.u * p.x + DVec3::Y * p.y - self.inward() * depth
    }

    /// Adds a quadrilateral given by (along, up, depth), counter-clockwise seen from its front, textured by its place in metres.
    fn quad(&self, mesh: &mut Mesh, corners: [[f64; 3]; 4]) {
        let positions = corners.map(|[x, y, depth]| self.at(DVec2::new(x, y), depth));
        // Depth counts as a way along, so that reveals are not smeared.
        mesh.flat_quad(positions, corners.map(|[x, y, depth]| DVec2::new(x + depth + self.shift, -y)));
    }

    /// The face between two points at a depth, without the openings; seen from the room, or from outside.
    fn face(&self, mesh: &mut Mesh, [low, high]: [DVec2; 2], depth: f64, outside: bool) {
        let cuts = |pick: fn(DVec2) -> f64| {
            let mut cuts = vec![pick(low), pick(high)];
            let of_openings =
                self.openings.iter().flat_map(|o| [pick(o.widened().low), pick(o.widened().high)]);
            cuts.extend(of_openings.filter(|c| *c > pick(low) && *c < pick(high)));
            cuts.sort_by(f64::total_cmp);
            cuts.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
            cuts
        };
        let (xs, ys) = (cuts(|p| p.x), cuts(|p| p.y));
        for y in ys.windows(2) {
            for x in xs.windows(2) {
                let centre = DVec2::new(x[0] + x[1], y[0] + y[1]) / 2.0;
                if self.openings.iter().any(|o| o.widened().holds(centre)) {
                    continue;
                }
                let corners =
                    [[x[0], y[0], depth], [x[1], y[0], depth], [x[1], y[1], depth], [x[0], y[1], depth]];
                let [a, b, c, d] = corners;
                self.quad(mesh, if outside { [b, a, d, c] } else { corners });
            }
        }
    }

    /// The board-marked part below.
    pub(super) fn lower(&self, mesh: &mut Mesh) {
        self.face(mesh, [DVec2::ZERO, DVec2::new(self.length, BOARDS_END - GROOVE / 2.0)], 0.0, false);
    }

    /// The plain part above with the groove under it, and the reveals of the openings.
    pub(super) fn upper(&self, mesh: &mut Mesh) {
        let (y0, y1) = (BOARDS_END - GROOVE / 2.0, BOARDS_END + GROOVE / 2.0);
        self.face(mesh, [DVec2::new(0.0, y1), DVec2::new(self.length, ROOM.y)], 0.0, false);
        self.face(mesh, [DVec2::new(0.0, y0), DVec2::new(self.length, y1)], GROOVE_DEPTH, false);
        let mut cuts = vec![0.0, self.length];
        let crossing = self.openings.iter().map(Opening::widened).filter(|o| o.low.y < y0 && o.high.y > y1);
        cuts.extend(crossing.flat_map(|o| [o.low.x, o.high.x]));
        cuts.sort_by(f64::total_cmp);
        for pair in cuts.chunks_exact(2) {
            let (x0, x1) = (pair[0], pair[1]);
            self.quad(mesh, [[x0, y0, 0.0], [x1, y0, 0.0], [x1, y0, GROOVE_DEPTH], [x0, y0, GROOVE_DEPTH]]);
            self.quad(mesh, [[x0, y1, GROOVE_DEPTH], [x1, y1, GROOVE_DEPTH], [x1, y1, 0.0], [x0, y1, 0.0]]);
        }
        self.openings.iter().for_each(|o| self.reveals(mesh, o));
    }

    /// The four sides of an opening through the wall, with the chamfers at both faces.
    fn reveals(&self, mesh: &mut Mesh, opening: &Opening) {
        let wide = opening.widened();
        let rings = [(wide, 0.0), (*opening, CHAMFER), (*opening, WALL - CHAMFER), (wide, WALL)];
        for pair in rings.windows(2) {
            let corners = |(o, depth): (Opening, f64)| {
                [[o.low.x, o.low.y], [o.high.x, o.low.y], [o.high.x, o.high.y], [o.low.x, o.high.y]]
                    .map(|[x, y]| [x, y, depth])
            };
            let (near, far) = (corners(pair[0]), corners(pair[1]));
            for i in 0..4 {
                let j = (i + 1) % 4;
                self.quad(mesh, [near[i], near[j], far[j], far[i]]);
            }
        }
    }

    /// The outer face, which reaches around the corners, into the ground and into the roof.
    pub(super) fn outer(&self, mesh: &mut Mesh) {
        let low = DVec2::new(-WALL, -BELOW);
        self.face(mesh, [low, DVec2::new(self.length + WALL, ROOM.y + ABOVE)], WALL, true);
    }
}

/// The floor, which reaches under the walls.
pub(super) fn floor() -> Mesh {
    let m = 0.1;
    let corners = [(-m, ROOM.z + m), (ROOM.x + m, ROOM.z + m), (ROOM.x + m, -m), (-m, -m)];
    let mut mesh = Mesh::default();
    mesh.flat_quad(corners.map(|(x, z)| DVec3::new(x, 0.0, z)), corners.map(DVec2::from));
    mesh
}

/// The ceiling, which reaches over the walls.
pub(super) fn ceiling() -> Mesh {
    let m = 0.1;
    let corners = [(-m, -m), (ROOM.x + m, -m), (ROOM.x + m, ROOM.z + m), (-m, ROOM.z + m)];
    let mut mesh = Mesh::default();
    mesh.flat_quad(corners.map(|(x, z)| DVec3::new(x, ROOM.y, z)), corners.map(|(x, z)| DVec2::new(x, -z)));
    mesh
}

/// The flat roof, which hangs over on all sides.
pub(super) fn roof() -> Mesh {
    let over = WALL + 0.55;
    let low = [-over, ROOM.y + 0.002, -over];
    let high = [ROOM.x + over, ROOM.y + 0.262, ROOM.z + over];
    block(low, high, 0.012).box_uvs(DVec2::ZERO)
}
