//! What is built into the changing room: the tube lamp, windows, the door, switch and conduits.
//!
//! The lamp's and the conduits' places are those of the room; windows and door are described in the frame of their opening: x along
//! the wall, y up from the opening's lower edge, z into the room, the inner face of the wall at z = 0.

use super::parts::block;
use crate::scenes::kit::{Mesh, Placement, lathe, round_path, tube};
use glam::{DVec2, DVec3};

/// Length of the luminous cover, half its width, height of the body above it.
pub(super) const LAMP: [f64; 3] = [2.40, 0.120, 0.060];
/// How far below the ceiling the lamp hangs.
pub(super) const LAMP_DROP: f64 = 0.30;
/// How far the cover lies below the body.
const COVER: f64 = 0.002;

/// The body of the lamp, along x, its luminous cover just below y = 0, and the two rods that hold it. The cover is flat and as wide as
/// the body, so that it lights nothing beside it: what is close to a lamp is bright, small and therefore noise.
pub(super) fn lamp_body() -> Mesh {
    let [length, half, height] = LAMP;
    let end = length / 2.0;
    let mut lamp = block([-end, 0.0, -half], [end, height, half], 0.004);
    for x in [-end * 0.62, end * 0.62] {
        let top = LAMP_DROP;
        lamp.append(&tube(&[DVec3::new(x, height - 0.004, 0.0), DVec3::new(x, top, 0.0)], 0.006, 10));
        let rose = [(0.0, top - 0.022), (0.022, top - 0.018), (0.030, top), (0.0, top)];
        lamp.append(&lathe(&rose.map(DVec2::from), 20, 40.0).moved(DVec3::X * x));
    }
    lamp
}

/// The luminous cover, facing down.
pub(super) fn lamp_cover() -> Mesh {
    let [end, half] = [LAMP[0] / 2.0, LAMP[1]];
    let mut mesh = Mesh::default();
    for (x, z) in [(-end, half), (-end, -half), (end, -half), (end, half)] {
        mesh.push(DVec3::new(x, -COVER, z), -DVec3::Y);
    }
    mesh.quad(0, 1, 2, 3);
    mesh
}

/// The steel frame of a window of `width` by `height`, set `inset` behind the face of the wall, with a
/// mullion: frame, and the two panes as one mesh.
pub(super) fn window([width, height]: [f64; 2], inset: f64) -> [Mesh; 2] {
    let (bar, depth) = (0.032, 0.045);
    let (z0, z1) = (-inset - depth, -inset);
    let mut frame = Mesh::default();
    let bars = [
        ([0.0, 0.0], [width, bar]),
        ([0.0, height - bar], [width, height]),
        ([0.0, bar - 0.002], [bar, height - bar + 0.002]),
        ([width - bar, bar - 0.002], [width, height - bar + 0.002]),
        ([(width - bar) / 2.0, bar - 0.002], [(width + bar) / 2.0, height - bar + 0.002]),
    ];
    for (min, max) in bars {
        frame.append(&block([min[0], min[1], z0], [max[0], max[1], z1], 0.004));
    }
    let halves = [(bar, (width - bar) / 2.0), ((width + bar) / 2.0, width - bar)];
    let mut panes = Mesh::default();
    for (x0, x1) in halves {
        let (y0, y1) = (bar, height - bar);
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)];
        let z = -inset - 0.024;
        panes.flat_quad(corners.map(|(x, y)| DVec3::new(x, y, z)), corners.map(|(x, y)| DVec2::new(x, -y)));
    }
    // A handle on the mullion.
    let x = width / 2.0;
    frame.append(&block(
        [x - 0.011, height * 0.42, z1 - 0.001],
        [x + 0.011, height * 0.42 + 0.06, z1 + 0.006],
        0.002,
    ));
    frame.append(&block(
        [x - 0.006, height * 0.42 - 0.06, z1 + 0.018],
        [x + 0.006, height * 0.42 + 0.04, z1 + 0.028],
        0.003,
    ));
    frame.append(&tube(
        &[DVec3::new(x, height * 0.42 + 0.03, z1), DVec3::new(x, height * 0.42 + 0.03, z1 + 0.022)],
        0.006,
        8,
    ));
    [frame, panes]
}

/// The wire mesh before a window, a sheet whose texture cuts the holes; texture coordinates in metres.
pub(super) fn wire_sheet([width, height]: [f64; 2], behind: f64) -> Mesh {
    let mut sheet = Mesh::default();
    let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
    sheet.flat_quad(corners.map(|(x, y)| DVec3::new(x, y, -behind)), corners.map(|(x, y)| DVec2::new(x, -y)));
    sheet
}

/// The steel frame of the door, around an opening of `width` by `height` through a wall of `thickness`.
pub(super) fn door_frame([width, height]: [f64; 2], thickness: f64) -> Mesh {
    let (jamb, lip) = (0.035, 0.012);
    let mut frame = Mesh::default();
    let (z0, z1) = (-thickness - lip, lip);
    frame.append(&block([-0.03, 0.0, z0], [jamb, height + 0.03, z1], 0.004));
    frame.append(&block([width - jamb, 0.0, z0], [width + 0.03, height + 0.03, z1], 0.004));
    frame.append(&block([jamb - 0.005, height - jamb, z0], [width - jamb + 0.005, height + 0.03, z1], 0.004));
    // The stop that the leaf closes against, and the sill.
    let (s0, s1) = (-0.075, -0.045);
    frame.append(&block([jamb - 0.003, 0.0, s0], [jamb + 0.014, height - jamb, s1], 0.002));
    frame.append(&block([width - jamb - 0.014, 0.0, s0], [width - jamb + 0.003, height - jamb, s1], 0.002));
    frame.append(&block([jamb, height - jamb - 0.014, s0], [width - jamb, height - jamb + 0.003, s1], 0.002));
    frame.append(&block([0.0, -0.02, z0 + 0.02], [width, 0.006, z1 - 0.004], 0.003));
    frame
}

/// The leaf of the door, hinged on the y axis: it extends along +x, its closed room side is z = 0. Painted steel with a raised rim
/// and two panels.
pub(super) fn door_leaf([width, height]: [f64; 2]) -> Mesh {
    let (thick, gap) = (0.042, 0.006);
    let mut leaf = block([0.004, gap, -thick], [width, height, 0.0], 0.003);
    for face in [1.0, -1.0] {
        let z = if face > 0.0 { 0.0 } else { -thick };
        // Raised rims around two fields.
        for (y0, y1) in [(0.16, 0.92), (1.04, height - 0.14)] {
            let (x0, x1, w, up) = (0.13, width - 0.13, 0.022, 0.005 * face);
            for (min, max) in [
                ([x0, y0], [x1, y0 + w]),
                ([x0, y1 - w], [x1, y1]),
                ([x0, y0 + w - 0.002], [x0 + w, y1 - w + 0.002]),
                ([x1 - w, y0 + w - 0.002], [x1, y1 - w + 0.002]),
            ] {
                let (za, zb) = ((z - 0.002 * face).min(z + up), (z - 0.002 * face).max(z + up));
                leaf.append(&block([min[0], min[1], za], [max[0], max[1], zb], 0.002));
            }
        }
    }
    leaf
}

/// Handle, plates, hinges and kick plate of the door.
pub(super) fn door_metal([width, height]: [f64; 2]) -> Mesh {
    let thick = 0.042;
    let mut metal = Mesh::default();
    for face in [1.0, -1.0] {
        let z = if face > 0.0 { 0.0 } else { -thick };
        let out = |d: f64| z + face * d;
        let span = |a: f64, b: f64| (out(a).min(out(b)), out(a).max(out(b)));
        let x = width - 0.055;
        let (z0, z1) = span(-0.001, 0.004);
        metal.append(&block([x - 0.02, 0.90, z0], [x + 0.02, 1.12, z1], 0.0015));
        let lever = [
            DVec3::new(x, 1.04, out(0.002)),
            DVec3::new(x, 1.04, out(0.048)),
            DVec3::new(x - 0.115, 1.04, out(0.048)),
        ];
        metal.append(&tube(&round_path(&lever, 0.018, 5), 0.0085, 12));
        let (z0, z1) = span(-0.001, 0.0016);
        metal.append(&block([0.02, 0.02, z0], [width - 0.02, 0.14, z1], 0.0007));
    }
    for y in [0.22, height / 2.0, height - 0.22] {
        metal.append(&tube(&[DVec3::new(0.0, y - 0.05, 0.004), DVec3::new(0.0, y + 0.05, 0.004)], 0.009, 12));
    }
    metal
}

/// A light switch in its box on the wall: the frame of [`window`].
pub(super) fn switch() -> Mesh {
    let mut switch = block([-0.041, -0.041, -0.001], [0.041, 0.041, 0.034], 0.008);
    let rocker = block([-0.026, -0.026, -0.004], [0.026, 0.026, 0.006], 0.003);
    switch.append_at(&rocker, &Placement::xyz(0.0, 0.0, 0.032).turned(DVec3::X, 5.0));
    switch
}

/// A conduit along a path, with a clip every 60 cm of its straight parts; `wall` points from the pipe to what it is fixed on.
pub(super) fn conduit(path: &[DVec3], clips: &[(DVec3, DVec3)]) -> Mesh {
    let mut all = tube(&round_path(path, 0.05, 5), 0.010, 10);
    for &(at, along) in clips {
        let half = DVec3::splat(0.0135) + along.abs() * (0.009 - 0.0135);
        all.append(&block((at - half).to_array(), (at + half).to_array(), 0.004));
    }
    all
}

/// The grating of the floor's gully: a ring and bars, flush with the floor at y = 0.
pub(super) fn gully() -> Mesh {
    let ring = [(0.062, -0.004), (0.064, 0.0012), (0.076, 0.0018), (0.080, 0.0), (0.080, -0.004)];
    let mut all = lathe(&ring.map(DVec2::from), 24, 40.0);
    for i in -4..=4 {
        let z = 0.0135 * f64::from(i);
        let half = libm::sqrt(0.064 * 0.064 - z * z);
        all.append(&block([-half, -0.006, z - 0.0035], [half, 0.0010, z + 0.0035], 0.001));
    }
    all
}
