//! What lies about in the changing room: buckets, sandals, bottles, a bag, swimming boards. Each stands on y = 0 over the origin.

use super::parts::{block, pad, ribbon};
use crate::scenes::kit::{Mesh, Placement, lathe, rounded_box, tube};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// A bucket of 28 cm, open at the top, with a rolled rim; its wall has an inside.
pub(super) fn bucket() -> Mesh {
    let profile = [
        (0.0, 0.010),
        (0.084, 0.010),
        (0.092, 0.000),
        (0.102, 0.000),
        (0.106, 0.008),
        (0.138, 0.236),
        (0.143, 0.240),
        (0.145, 0.268),
        (0.153, 0.271),
        (0.155, 0.278),
        (0.150, 0.283),
        (0.143, 0.281),
        (0.140, 0.270),
        (0.1345, 0.236),
        (0.103, 0.020),
        (0.096, 0.014),
        (0.0, 0.014),
    ];
    lathe(&profile.map(DVec2::from), 28, 40.0)
}

/// The wire handle of a bucket and its grip, folded down by `tilt` degrees from upright.
pub(super) fn bucket_handle(tilt: f64) -> Mesh {
    let at = |t: f64, out: f64| {
        let (s, c) = libm::sincos(PI * t);
        DVec3::new(-(0.149 + out) * c, (0.149 + out) * s, 0.0)
    };
    let path: Vec<DVec3> = (0..=24).map(|i| at(f64::from(i) / 24.0, 0.0)).collect();
    let grip: Vec<DVec3> = (0..=8).map(|i| at(0.37 + 0.26 * f64::from(i) / 8.0, 0.0)).collect();
    let mut handle = tube(&path, 0.0022, 6);
    handle.append(&tube(&grip, 0.008, 10));
    handle.placed(&Placement::xyz(0.0, 0.262, 0.0).turned(DVec3::X, tilt))
}

/// The outline of a left sole, 27 cm along z, heel at the back (+z), counter-clockwise seen from above.
fn sole_outline(grow: f64) -> Vec<DVec2> {
    const STEPS: usize = 24;
    (0..STEPS)
        .map(|i| {
            let (s, c) = libm::sincos(TAU * i as f64 / STEPS as f64);
            // Along the foot from -1 (toes) to 1 (heel).
            let along = s;
            let width = 0.042 - 0.006 * along - 0.006 * libm::cos(PI * along * 0.9 - 0.5);
            let power = |x: f64, p: f64| x.signum() * libm::pow(x.abs(), p);
            let inward = 0.006 * libm::cos(PI * 0.8 * along);
            DVec2::new(power(c, 0.8) * (width + grow) + inward, power(s, 0.9) * (0.135 + grow))
        })
        .collect()
}

/// The sole of a bathing sandal.
pub(super) fn sandal_sole() -> Mesh {
    pad(&sole_outline(0.0), 0.024, 0.004)
}

/// The foot bed and the strap over it, in another colour than the sole.
pub(super) fn sandal_strap() -> Mesh {
    let bed = pad(&sole_outline(-0.007), 0.003, 0.001).moved(DVec3::Y * 0.023);
    let arch: Vec<DVec3> = (0..=10)
        .map(|i| {
            let (s, c) = libm::sincos(PI * f64::from(i) / 10.0);
            DVec3::new(-0.046 * c + 0.003, 0.008 + 0.058 * libm::pow(s, 0.75), -0.040 - 0.012 * s)
        })
        .collect();
    let mut strap = ribbon(&arch, DVec3::Z, 0.078, 0.0035);
    strap.append(&bed);
    strap
}

/// A bottle of shampoo, 19 cm with its cap; the cap is [`bottle_cap`].
pub(super) fn bottle() -> Mesh {
    let profile = [
        (0.0, 0.0),
        (0.027, 0.0),
        (0.030, 0.004),
        (0.031, 0.020),
        (0.031, 0.118),
        (0.028, 0.134),
        (0.018, 0.146),
        (0.013, 0.150),
        (0.0, 0.150),
    ];
    lathe(&profile.map(DVec2::from), 24, 40.0)
        .placed(&Placement::xyz(0.0, 0.0, 0.0).stretched(DVec3::new(1.15, 1.0, 0.8)))
}

/// The cap of a bottle.
pub(super) fn bottle_cap() -> Mesh {
    let profile = [
        (0.0, 0.148),
        (0.0145, 0.148),
        (0.0155, 0.150),
        (0.0155, 0.176),
        (0.0145, 0.180),
        (0.012, 0.182),
        (0.0, 0.182),
    ];
    lathe(&profile.map(DVec2::from), 20, 40.0)
}

/// A sports bag, 46 cm along x.
pub(super) fn bag() -> Mesh {
    rounded_box(DVec3::new(0.23, 0.115, 0.115), 0.085, 4).moved(DVec3::Y * 0.115)
}

/// The two handles of a bag, fallen to its sides, and the straps around it that carry them.
pub(super) fn bag_handles() -> Mesh {
    let mut all = Mesh::default();
    for side in [-1.0, 1.0] {
        let loop_: Vec<DVec3> = (0..=16)
            .map(|i| {
                let t = f64::from(i) / 16.0;
                let (s, c) = libm::sincos(PI * t);
                let lift = 0.19 + 0.055 * libm::pow(s, 0.6);
                DVec3::new(-0.11 * c, lift, side * (0.086 + 0.03 * s))
            })
            .collect();
        all.append(&tube(&loop_, 0.0075, 8));
    }
    for x in [-0.11, 0.11] {
        let around: Vec<DVec3> = (0..=40)
            .map(|i| {
                let (s, c) = libm::sincos(TAU * f64::from(i) / 40.0);
                // Outside of a rounded square of half side 0.115 and radius 0.085.
                let p = DVec2::new(c, s) * 0.0865;
                let q = DVec2::new(0.03 * (c * 8.0).clamp(-1.0, 1.0), 0.03 * (s * 8.0).clamp(-1.0, 1.0));
                DVec3::new(x, 0.115 + p.y + q.y, p.x + q.x)
            })
            .collect();
        all.append(&ribbon(&around, DVec3::X, 0.03, 0.003));
    }
    all
}

/// A swimming board of foam, 42 cm long, lying flat.
pub(super) fn board() -> Mesh {
    let outline: Vec<DVec2> = (0..32)
        .map(|i| {
            let (s, c) = libm::sincos(TAU * f64::from(i) / 32.0);
            let power = |x: f64, p: f64| x.signum() * libm::pow(x.abs(), p);
            // Squarer at the near end than at the far one.
            let p = if s > 0.0 { 0.35 } else { 0.75 };
            DVec2::new(power(c, 0.4) * 0.14, power(s, p) * 0.21)
        })
        .collect();
    pad(&outline, 0.032, 0.008)
}

/// A sign of a clock: its case, its hands, its marks.
pub(super) fn clock() -> [Mesh; 2] {
    let case = [
        (0.0, 0.0),
        (0.150, 0.0),
        (0.158, 0.008),
        (0.158, 0.036),
        (0.150, 0.042),
        (0.143, 0.036),
        (0.143, 0.028),
        (0.0, 0.028),
    ];
    let mut marks = Mesh::default();
    for hour in 0..12 {
        let long = if hour % 3 == 0 { 0.016 } else { 0.009 };
        let mark = block([-0.004, 0.028, 0.125 - long], [0.004, 0.030, 0.125], 0.0005);
        marks.append_at(&mark, &Placement::at(DVec3::ZERO).turned_y(30.0 * f64::from(hour)));
    }
    for (length, width, degrees) in [(0.07, 0.006, -52.0), (0.11, 0.004, 75.0)] {
        let hand = block([-width, 0.031, -0.018], [width, 0.033, length], 0.0006);
        marks.append_at(&hand, &Placement::at(DVec3::ZERO).turned_y(degrees));
    }
    [lathe(&case.map(DVec2::from), 48, 40.0), marks]
}
