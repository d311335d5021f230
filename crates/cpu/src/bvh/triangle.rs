//! The watertight triangle test (Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection", JCGT 2(1)) on packets
//! of triangles.
//!
//! Each vertex is moved into a frame in which the ray is the z axis, in single precision with one fixed order of operations
//! and no fused products: neighbours see the same bits at a shared vertex. The signs of the three edge functions then decide.
//! It goes in two steps:
//!
//! 1. A filter on all lanes at once rejects triangles with edge functions of both signs. A nonzero difference of two
//!    rounded products has the sign of the exact one (rounding is monotone), and a zero rejects nothing, so that the
//!    filter never loses a hit. Each SIMD level has its own, all with the same operations.
//! 2. [`finish`] decides the few lanes that remain, in double precision, where the products are exact and the signs hence
//!    certain: the fallback of the paper for edge functions of zero, taken for all. It makes `t` and the barycentric
//!    coordinates good to single precision even on needles, which the proof in [`super::ray`] relies on, and it is
//!    one scalar function for all SIMD levels, so that hits agree in every bit.

use super::ray::TravRay;
use glam::Vec3;

/// Triangles tested at once.
pub(super) const LANES: usize = 8;

/// Vertices of [`LANES`] triangles: row `3 v + axis` holds that coordinate of vertex `v`. A packet that is not full repeats
/// its last triangle, which changes no result and needs no mask.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct Packet {
    pub(super) rows: [[f32; LANES]; 9],
    /// Index of each triangle in its mesh.
    pub(super) ids: [u32; LANES],
}

impl Packet {
    /// A packet of 1 to [`LANES`] triangles.
    pub(super) fn new(triangles: impl ExactSizeIterator<Item = (u32, [Vec3; 3])>) -> Packet {
        let mut packet = Packet { rows: [[0.0; LANES]; 9], ids: [0; LANES] };
        let count = triangles.len();
        assert!((1..=LANES).contains(&count), "{count} triangles in a packet");
        for (lane, (id, vertices)) in triangles.enumerate() {
            for to in lane..if lane + 1 == count { LANES } else { lane + 1 } {
                packet.ids[to] = id;
                for (v, p) in vertices.iter().enumerate() {
                    for axis in 0..3 {
                        packet.rows[3 * v + axis][to] = p[axis];
                    }
                }
            }
        }
        packet
    }
}

/// Vertices in the frame of the ray, as the filter leaves them: rows x, y, z of the vertices in turn.
pub(super) type Sheared = [[f32; LANES]; 9];

/// A point of a triangle on the ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TriangleHit {
    pub(super) t: f32,
    pub(super) b1: f32,
    pub(super) b2: f32,
}

/// The smaller one as the `minps` instruction has it: one comparison, where `f32::min` also sorts out NaN.
#[inline(always)]
pub(super) fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The larger one, as [`min`].
#[inline(always)]
pub(super) fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The filter without SIMD instructions: returns the lanes that may be hit with `t_min < t <= t_best`, and fills `sheared`.
#[inline(always)]
pub(super) fn filter(packet: &Packet, ray: &TravRay, t_best: f32, sheared: &mut Sheared) -> u32 {
    let [kx, ky, kz] = ray.axes;
    let [sx, sy, sz] = ray.shear;
    let o = ray.origin;
    let mut mask = 0;
    for lane in 0..LANES {
        let vertex = |v: usize| {
            let x = packet.rows[3 * v + kx][lane] - o[kx];
            let y = packet.rows[3 * v + ky][lane] - o[ky];
            let z = packet.rows[3 * v + kz][lane] - o[kz];
            [x - sx * z, y - sy * z, sz * z]
        };
        let [a, b, c] = [vertex(0), vertex(1), vertex(2)];
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let mixed = min(min(u, v), w) < 0.0 && max(max(u, v), w) > 0.0;
        // `t` is a mean of the three depths, and rounding keeps it between them.
        let in_range = min(min(a[2], b[2]), c[2]) <= t_best && max(max(a[2], b[2]), c[2]) > ray.t_min;
        mask |= ((!mixed && in_range) as u32) << lane;
        for (row, value) in sheared.iter_mut().zip(a.into_iter().chain(b).chain(c)) {
            row[lane] = value;
        }
    }
    mask
}

/// Decides one lane that passed the filter; `t` is not compared with the ray's interval.
#[inline(always)]
pub(super) fn finish(sheared: &Sheared, lane: usize) -> Option<TriangleHit> {
    let at = |row: usize| f64::from(sheared[row][lane]);
    let (ax, ay, az) = (at(0), at(1), at(2));
    let (bx, by, bz) = (at(3), at(4), at(5));
    let (cx, cy, cz) = (at(6), at(7), at(8));
    // Products of two floats are exact in double precision, and one rounded difference has the right sign.
    let u = cx * by - cy * bx;
    let v = ax * cy - ay * cx;
    let w = bx * ay - by * ax;
    let det = u + v + w;
    if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) || det == 0.0 {
        return None;
    }
    let r = 1.0 / det;
    let t = (u * az + v * bz + w * cz) * r;
    Some(TriangleHit { t: t as f32, b1: (v * r) as f32, b2: (w * r) as f32 })
}
