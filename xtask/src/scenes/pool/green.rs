//! What grows around the place, and the hills at the horizon.

use super::Pool;
use crate::scenes::kit::{Material, Mesh, Noise, Picture, Placement, hash01, smoothstep, tube};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Ridges of hills at the horizon, paler and bluer the farther they are.
pub(super) fn hills(pool: &mut Pool) {
    let ridges = [
        ("near hills", 170.0, 9.0, [0.13, 0.145, 0.085]),
        ("middle hills", 270.0, 24.0, [0.19, 0.225, 0.215]),
        ("far hills", 400.0, 52.0, [0.27, 0.335, 0.41]),
    ];
    for (k, (name, radius, height, color)) in ridges.into_iter().enumerate() {
        let material = pool.material(name, |_| Material::new(name, color, 1.0).specular(0.0));
        let noise = Noise::new(600 + k as u64, [7 + 3 * k as i64, 1]);
        let mut ridge = Mesh::default();
        let count = 220;
        for i in 0..=count {
            let u = f64::from(i % count) / f64::from(count);
            let (s, c) = libm::sincos(TAU * u);
            let top =
                height * (0.55 + 0.55 * noise.fbm(u, 0.37, 5) + 0.25 * noise.at(u * 0.5, 0.8)).max(0.12);
            let out = DVec3::new(c, 0.0, -s);
            // Facing the middle and the sky.
            for (r, y) in [(radius, -1.0), (radius + 2.2 * top, 0.62 * top), (radius + 3.6 * top, top)] {
                ridge.push(out * r + DVec3::Y * y, DVec3::Y - out * 0.45);
            }
        }
        for i in 0..count as u32 {
            for row in 0..2 {
                let a = 3 * i + row;
                ridge.quad(a, a + 1, a + 4, a + 3);
            }
        }
        pool.document.place(name, &ridge, material);
    }
}

/// Cypresses and stone pines: a trunk and a crown of small sheets of leaves, whose normals are those of the crown.
pub(super) fn trees(pool: &mut Pool) {
    let leaves = pool.material("leaves", |pool| {
        let color = pool.texture("leaves", [1.0; 2], || {
            let sprig = Noise::new(701, [9, 9]);
            let at = |u: f64, v: f64| {
                let cell = sprig.cells(u, v);
                let round = smoothstep(1.0, 0.8, DVec2::new(u - 0.5, v - 0.5).length() * 2.0);
                let shade = 0.55 + 0.65 * cell[2];
                let leaf = smoothstep(0.44, 0.36, cell[0]) * round;
                (DVec3::new(0.060, 0.085, 0.028) * shade, leaf)
            };
            Picture::with_alpha([128; 2], at).png()
        });
        Material::new("leaves", [1.0; 3], 0.8).color_texture(color).mask(0.5).double_sided().specular(0.3)
    });
    let bark = pool.material("bark", |_| Material::new("bark", [0.11, 0.075, 0.05], 1.0).specular(0.0));
    let cypresses = [("cypress a", 701, 8.2), ("cypress b", 702, 6.6)];
    let pines = [("pine a", 711, 7.4), ("pine b", 712, 6.0)];
    for (name, seed, height) in cypresses {
        let widest = height * 0.105;
        let shape = move |t: f64| widest * libm::pow(libm::sin(PI * (0.04 + 0.9 * libm::pow(t, 0.75))), 0.8);
        let crown = crown(seed, 290, |t, _| (0.25 + (height - 0.3) * t, shape(t)), 0.84);
        let places = tree_places(name);
        pool.document.scatter(name, &crown, leaves, &places);
        let trunk = tube(&[DVec3::ZERO, DVec3::Y * height * 0.6], 0.10, 8);
        pool.document.scatter(&format!("{name} trunk"), &trunk, bark, &places);
    }
    for (name, seed, height) in pines {
        let crown = crown(
            seed,
            390,
            |t, r| {
                let (s, c) = libm::sincos(PI * (t - 0.5));
                (height * (0.82 + 0.16 * s) + 0.25 * r, height * 0.46 * c.max(0.1))
            },
            1.42,
        );
        let places = tree_places(name);
        pool.document.scatter(name, &crown, leaves, &places);
        let lean = DVec3::new(0.35, 0.0, 0.2);
        let mut trunk = tube(
            &[DVec3::ZERO, DVec3::Y * height * 0.4 + lean * 0.4, DVec3::Y * height * 0.74 + lean],
            0.17,
            9,
        );
        for k in 0..4 {
            let (s, c) = libm::sincos(TAU * f64::from(k) / 4.0 + 0.6);
            let from = DVec3::Y * height * (0.52 + 0.05 * f64::from(k)) + lean * 0.7;
            trunk.append(&tube(&[from, from + DVec3::new(c * 1.3, height * 0.2, s * 1.3)], 0.06, 6));
        }
        pool.document.scatter(&format!("{name} trunk"), &trunk, bark, &places);
    }
}

/// Sheets of leaves on a surface of revolution: `shape` gives height and radius at `t` from 0 to 1 and a random number.
fn crown(seed: u64, count: u64, shape: impl Fn(f64, f64) -> (f64, f64), size: f64) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..count {
        let random = |k: u64| hash01(seed * 16 + k, i);
        let (y, radius) = shape((i as f64 + random(0)) / count as f64, random(6) - 0.5);
        let (s, c) = libm::sincos(TAU * random(1));
        let depth = radius * (0.62 + 0.40 * libm::sqrt(random(2)));
        let out = DVec3::new(c, 0.0, s);
        let centre = out * depth + DVec3::Y * y;
        let normal = (out * depth / radius.max(0.1) + DVec3::Y * (0.35 + 0.5 * random(5))).normalize();
        let place = Placement::at(centre)
            .turned(DVec3::X, 360.0 * random(3))
            .turned_y(360.0 * random(4))
            .scaled(size * (0.7 + 0.6 * random(5)));
        let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
        let ids = corners.map(|(x, y)| {
            let p = place.rotation * (DVec3::new(x, y, 0.0) * place.scale) + place.translation;
            mesh.push_uv(p, normal, DVec2::new(x + 0.5, 0.5 - y))
        });
        mesh.quad(ids[0], ids[1], ids[2], ids[3]);
    }
    mesh
}

/// Where the trees of a kind stand: behind the fence.
fn tree_places(name: &str) -> Vec<Placement> {
    let spots: &[(f64, f64, f64)] = match name {
        "cypress a" => &[
            (-16.5, -27.0, 1.0),
            (-13.2, -27.6, 0.9),
            (9.6, -27.5, 1.05),
            (33.5, -20.5, 1.1),
            (35.0, 9.5, 1.0),
        ],
        "cypress b" => &[
            (-19.4, -27.3, 1.0),
            (11.8, -28.0, 1.0),
            (34.2, -16.8, 1.05),
            (34.6, 12.6, 1.15),
            (-31.0, 2.0, 1.2),
        ],
        "pine a" => &[(-3.5, -29.0, 1.05), (20.5, -29.5, 1.15), (38.5, -6.5, 1.0)],
        _ => &[(3.6, -32.0, 1.1), (27.0, -31.0, 1.0), (40.0, 1.5, 1.2), (-27.0, -34.0, 1.3)],
    };
    let at = |(i, &(x, z, scale)): (usize, &(f64, f64, f64))| {
        Placement::xyz(x, -0.05, z).turned_y(77.0 * i as f64).scaled(scale)
    };
    spots.iter().enumerate().map(at).collect()
}

/// Palms: a ringed trunk that leans a little and fronds of feathered sheets.
pub(super) fn palms(pool: &mut Pool) {
    let bark = pool.material("palm bark", |pool| {
        let color = pool.texture("palm bark", [0.6; 2], || {
            let (rings, fibres) = (Noise::new(721, [3, 6]), Noise::new(722, [40, 6]));
            let at = |u: f64, v: f64| {
                let ring = smoothstep(0.35, 0.0, (v * 6.0 + 0.35 * rings.at(u, v)).rem_euclid(1.0));
                let shade = 0.75 + 0.3 * fibres.fbm(u, v, 2) - 0.5 * ring;
                DVec3::new(0.21, 0.165, 0.12) * shade.max(0.15)
            };
            Picture::from_fn([256; 2], at).png()
        });
        Material::new("palm bark", [1.0; 3], 0.95).color_texture(color).specular(0.3)
    });
    let leaf = pool.material("palm leaf", |pool| {
        // Half a frond: its rib at u = 0, leaflets that lean towards the tip, v from foot to tip.
        let color = pool.texture("palm leaf", [1.0; 2], || {
            let at = |u: f64, v: f64| {
                let row = (v * 30.0 + u * 7.0).rem_euclid(1.0) - 0.5;
                let reach = libm::sin(PI * (0.10 + 0.86 * v)) * 0.98;
                let width = 0.34 * (1.0 - u / reach.max(0.05)).max(0.0).sqrt();
                let leaflet = if u < reach { smoothstep(0.02, -0.06, row.abs() - width) } else { 0.0 };
                let rib = smoothstep(0.05, 0.03, u);
                let green = DVec3::new(0.085, 0.125, 0.030).lerp(DVec3::new(0.17, 0.165, 0.05), u * u);
                (green.lerp(DVec3::new(0.22, 0.20, 0.08), rib), leaflet.max(rib))
            };
            Picture::with_alpha([128, 512], at).png()
        });
        Material::new("palm leaf", [1.0; 3], 0.55).color_texture(color).mask(0.5).double_sided()
    });
    let places = [
        Placement::xyz(20.3, -0.05, -17.6),
        Placement::xyz(-17.5, -0.05, -18.6).turned_y(140.0).scaled(1.08),
        Placement::xyz(25.5, -0.05, 7.2).turned_y(250.0).scaled(0.92),
    ];
    let height = 7.8;
    let bow = |t: f64| DVec3::new(0.55 * t * t, height * t, 0.12 * libm::sin(3.0 * t));
    let path: Vec<DVec3> = (0..=14).map(|i| bow(f64::from(i) / 14.0)).collect();
    let mut trunk = tube(&path, 0.17, 12);
    for p in &mut trunk.positions {
        // Thick at the foot, and under the crown.
        let t = (p.y / height).clamp(0.0, 1.0);
        let axis = bow(t);
        let thick = 1.0 + 0.55 * smoothstep(0.12, 0.0, t) + 0.45 * smoothstep(0.90, 0.985, t);
        *p = DVec3::new(axis.x + (p.x - axis.x) * thick, p.y, axis.z + (p.z - axis.z) * thick);
    }
    pool.document.scatter("palm trunk", &trunk, bark, &places);
    let mut fronds = Mesh::default();
    for i in 0..34u32 {
        let random = |k: u64| hash01(731 + k, u64::from(i));
        let rise = 1.25 - 1.75 * f64::from(i) / 34.0 + 0.2 * (random(0) - 0.5);
        let place = Placement::at(bow(1.0)).turned_y(137.5 * f64::from(i)).scaled(2.5 + 0.5 * random(1));
        fronds.append_at(&frond(rise, 0.9 + 0.5 * random(2)), &place);
    }
    pool.document.scatter("palm fronds", &fronds, leaf, &places);
}

/// A frond a metre long along +x: it rises with the slope `rise` and falls over by `droop`; its halves hang like a roof.
fn frond(rise: f64, droop: f64) -> Mesh {
    let steps = 7;
    let rib = |t: f64| DVec3::new(t * (1.0 - 0.18 * droop * t), rise * t - droop * t * t, 0.0);
    let mut mesh = Mesh::default();
    for side in [-1.0, 1.0] {
        let base = mesh.positions.len() as u32;
        for i in 0..=steps {
            let t = f64::from(i) / f64::from(steps);
            let along = (rib(t + 0.01) - rib(t - 0.01)).normalize();
            let up = DVec3::Z.cross(along);
            let out = DVec3::Z * side * 0.21 - up * 0.11 * (0.4 + t);
            let normal = (up + DVec3::Z * side * 0.45).normalize();
            mesh.push_uv(rib(t), normal, DVec2::new(0.0, t));
            mesh.push_uv(rib(t) + out, normal, DVec2::new(1.0, t));
        }
        for i in 0..steps as u32 {
            let a = base + 2 * i;
            if side > 0.0 {
                mesh.quad(a, a + 1, a + 3, a + 2);
            } else {
                mesh.quad(a, a + 2, a + 3, a + 1);
            }
        }
    }
    mesh
}
