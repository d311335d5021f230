//! `lanterns.glb`: many lights. A lane at night between house fronts: strings of bulbs from side to side, paper lanterns in six
//! colours, lit windows, candles on tables, and spots over the doors: some five hundred small lights, none of which lights most of
//! the picture, over wet stone that mirrors them. Dimensions are this project's own.

use super::kit::{
    Document, Grey, Material, Mesh, Noise, Placement, bevel_box, hash01, icosphere, lathe, smoothstep, tube,
};
use glam::{DVec2, DVec3};
use serde_json::json;

/// Half the width of the lane, its ends along z (the camera stands near the near one) and the height of the fronts.
const HALF: f64 = 3.6;
const NEAR: f64 = 9.0;
const FAR: f64 = -15.0;
const HEIGHT: f64 = 6.6;
/// Fronts along each side, and how wide one is.
const FRONTS: usize = 6;
const FRONT: f64 = (NEAR - FAR) / FRONTS as f64;
/// Strings of bulbs across the lane, bulbs and lanterns on each.
const STRINGS: usize = 15;
const BULBS: usize = 22;
const LANTERNS: usize = 4;
/// Colours of the lanterns' paper, at most 1.
const PAPER: [[f64; 3]; 6] = [
    [1.0, 0.22, 0.10],
    [1.0, 0.55, 0.14],
    [1.0, 0.84, 0.36],
    [0.30, 0.85, 0.42],
    [0.28, 0.55, 1.0],
    [0.95, 0.30, 0.70],
];
const WARM: [f64; 3] = [1.0, 0.62, 0.28];

/// The scene as a `.glb` file.
pub(crate) fn lanterns() -> Vec<u8> {
    let mut document = Document::default();
    document.camera("camera", [DVec3::new(-0.75, 1.6, 8.4), DVec3::new(0.2, 2.05, -3.0)], 48.0, 16.0 / 9.0);
    document.sky(json!([0.004, 0.006, 0.014]));
    ground(&mut document);
    fronts(&mut document);
    strings(&mut document);
    tables(&mut document);
    document.to_glb()
}

fn random(seed: u64, index: usize) -> f64 {
    hash01(seed, index as u64)
}

/// Setts, wet in places.
fn ground(document: &mut Document) {
    let size = [1.6, 1.6];
    let stone = |u: f64, v: f64| {
        let [d, second, r] = Noise::new(5, [12, 12]).cells(u, v);
        (smoothstep(0.02, 0.22, second - d), r)
    };
    let height = Grey::from_fn([512, 512], |u, v| {
        let (top, r) = stone(u, v);
        0.009 * top + 0.003 * r + 0.0008 * Noise::new(8, [60, 60]).at(u, v)
    });
    let color = Grey::from_fn([256, 256], |u, v| {
        let (top, r) = stone(u, v);
        (0.05 + 0.10 * r) * (0.35 + 0.65 * top) * (1.0 + 0.2 * Noise::new(9, [40, 40]).at(u, v))
    });
    let wet = Grey::from_fn([256, 256], |u, v| {
        0.16 + 0.30 * smoothstep(-0.35, 0.4, Noise::new(4, [3, 3]).fbm(u, v, 3))
    });
    let [height, color, wet] = [height.normal_map(size), color.png_srgb(), wet.png()];
    let [height, color] =
        [("sett normals", height), ("setts", color)].map(|(n, png)| document.texture_of(n, &png, size));
    let wet = document.texture_of("wet", &wet, [5.0, 5.0]);
    let setts = Material::new("setts", [1.0, 0.97, 0.92], 1.0).color_texture(color).roughness_texture(wet);
    let setts = document.material(setts.normal_texture(height, 0.8));
    let mut mesh = Mesh::default();
    let corners = [
        (-HALF - 1.0, NEAR + 3.0),
        (HALF + 1.0, NEAR + 3.0),
        (HALF + 1.0, FAR - 1.0),
        (-HALF - 1.0, FAR - 1.0),
    ];
    mesh.flat_quad(corners.map(|(x, z)| DVec3::new(x, 0.0, z)), corners.map(DVec2::from));
    document.place("setts", &mesh, setts);
}

/// Where a front's parts stand: x along it seen from the lane, y up, z out into the lane.
fn on_front(side: usize, index: usize) -> Placement {
    let z = NEAR - FRONT * (index as f64 + 0.5);
    if side == 0 {
        Placement::xyz(-HALF, 0.0, z).turned_y(90.0)
    } else {
        Placement::xyz(HALF, 0.0, z).turned_y(-90.0)
    }
}

/// The place `at` in the frame of `front`.
fn at(front: &Placement, at: DVec3) -> Placement {
    Placement { translation: front.translation + front.rotation * at, ..*front }
}

/// House fronts with lit windows, doors, a spot over each door; a wall at the end of the lane.
fn fronts(document: &mut Document) {
    let plaster: Vec<usize> =
        [[0.42, 0.20, 0.11], [0.45, 0.34, 0.18], [0.16, 0.24, 0.27], [0.42, 0.38, 0.31]]
            .iter()
            .enumerate()
            .map(|(i, rgb)| document.material(Material::new(&format!("plaster {}", i + 1), *rgb, 0.9)))
            .collect();
    let frame = document.material(Material::new("window frame", [0.06, 0.045, 0.035], 0.5));
    let door = document.material(Material::new("door", [0.03, 0.09, 0.08], 0.4));
    let panes: Vec<usize> = [5.0, 2.2, 0.7]
        .map(|nits| Material::new("lit window", [0.0; 3], 1.0).specular(0.0).emissive(WARM, nits))
        .map(|m| document.material(m))
        .into();
    let dark = document.material(Material::new("dark window", [0.01, 0.012, 0.016], 0.05));
    let wall = bevel_box(
        DVec3::new(-FRONT / 2.0 + 0.03, -0.1, -0.5),
        DVec3::new(FRONT / 2.0 - 0.03, HEIGHT, 0.0),
        0.02,
    );
    let wall = document.geometry(&wall);
    let cornice =
        bevel_box(DVec3::new(-FRONT / 2.0, HEIGHT, -0.5), DVec3::new(FRONT / 2.0, HEIGHT + 0.16, 0.16), 0.03);
    let cornice = document.geometry(&cornice);
    let leaf = document.geometry(&bevel_box(DVec3::new(-0.5, 0.0, 0.0), DVec3::new(0.5, 2.15, 0.05), 0.012));
    let [window, pane] = window().map(|m| document.geometry(&m));
    for side in 0..2 {
        for index in 0..FRONTS {
            let front = on_front(side, index);
            let house = side * FRONTS + index;
            let material = plaster[(random(3, house) * 4.0) as usize];
            document.object("front", &wall, material, &front);
            document.object("cornice", &cornice, material, &front);
            document.object("door", &leaf, door, &at(&front, DVec3::new(-1.0, 0.0, 0.0)));
            for (k, (x, y)) in [(0.85, 1.0), (-1.15, 3.7), (0.0, 3.7), (1.15, 3.7)].into_iter().enumerate() {
                let place = at(&front, DVec3::new(x, y, 0.0));
                let lit = random(17, house * 8 + k);
                let glass = if lit < 0.75 { panes[(lit * 4.0) as usize] } else { dark };
                document.object("window", &window, frame, &place);
                document.object("pane", &pane, glass, &place);
            }
            let color = PAPER[(random(23, house) * 3.0) as usize];
            let spot = json!({
                "type": "spot", "color": color, "intensity": 5.0,
                "spot": { "innerConeAngle": 0.25, "outerConeAngle": 0.75 },
            });
            // Shines down along the wall: -z of the node turned to -y.
            let mut place = at(&front, DVec3::new(-1.0, 3.1, 0.35));
            place.rotation = Placement::at(DVec3::ZERO).turned(DVec3::X, -90.0).rotation;
            document.light("door spot", spot, &place);
        }
    }
    let end =
        bevel_box(DVec3::new(-HALF - 0.5, -0.1, FAR - 0.6), DVec3::new(HALF + 0.5, HEIGHT - 1.2, FAR), 0.03);
    document.place("end of the lane", &end, plaster[0]);
}

/// The bars of a window of 0.8 by 1.3 m over its sill, and its pane.
fn window() -> [Mesh; 2] {
    let (w, h) = (0.4, 1.3);
    let mut frame = bevel_box(DVec3::new(-w - 0.07, -0.05, 0.0), DVec3::new(w + 0.07, 0.0, 0.09), 0.01);
    let bars = [
        (-w, -w + 0.05, 0.0, h),
        (w - 0.05, w, 0.0, h),
        (-0.018, 0.018, 0.0, h),
        (-w, w, h - 0.05, h),
        (-w, w, 0.62, 0.655),
    ];
    for (x0, x1, y0, y1) in bars {
        frame.append(&bevel_box(DVec3::new(x0, y0, 0.0), DVec3::new(x1, y1, 0.045), 0.006));
    }
    let mut pane = Mesh::default();
    let corners = [(-w, 0.0), (w, 0.0), (w, h), (-w, h)];
    pane.flat_quad(corners.map(|(x, y)| DVec3::new(x, y, 0.015)), corners.map(DVec2::from));
    [frame, pane]
}

/// Cables across the lane with bulbs and, below them, paper lanterns.
fn strings(document: &mut Document) {
    let cable = document.material(Material::new("cable", [0.02; 3], 0.6));
    let bulb = Material::new("bulb", [0.0; 3], 1.0).specular(0.0).emissive([1.0, 0.72, 0.38], 420.0);
    let bulb = document.material(bulb);
    let paper: Vec<usize> = PAPER
        .iter()
        .map(|rgb| Material::new("paper", [0.0; 3], 1.0).specular(0.0).emissive(*rgb, 3.6))
        .map(|m| document.material(m))
        .collect();
    let ring = [(0.0, 0.155), (0.055, 0.155), (0.058, 0.165), (0.05, 0.185), (0.0, 0.185)].map(DVec2::from);
    let mut rims = lathe(&ring, 14, 30.0);
    rims.append(&lathe(&ring, 14, 30.0).placed(&Placement::at(DVec3::ZERO).turned(DVec3::X, 180.0)));
    let lantern = document.geometry(&icosphere(2));
    let lantern: Vec<usize> = paper.iter().map(|m| document.mesh("lantern", &[(&lantern, *m)])).collect();
    let (mut cables, mut bulbs, mut tops) = (Mesh::default(), Vec::new(), Vec::new());
    for string in 0..STRINGS {
        let z = NEAR - 2.6 - (NEAR - FAR - 4.0) * string as f64 / STRINGS as f64;
        let skew = 1.6 * (random(31, string) - 0.5);
        let (height, sag) = (4.15 + 1.3 * random(37, string), 0.45 + 0.35 * random(41, string));
        let on = |t: f64| {
            DVec3::new(HALF * (2.0 * t - 1.0), height - sag * 4.0 * t * (1.0 - t), z + skew * (t - 0.5))
        };
        let path: Vec<DVec3> = (0..=24).map(|i| on(f64::from(i) / 24.0)).collect();
        cables.append(&tube(&path, 0.007, 5));
        bulbs.extend(
            (0..BULBS)
                .map(|i| Placement::at(on((i as f64 + 0.5) / BULBS as f64) - DVec3::Y * 0.05).scaled(0.028)),
        );
        for i in 0..LANTERNS {
            let key = string * LANTERNS + i;
            let t = (i as f64 + 0.25 + 0.5 * random(43, key)) / LANTERNS as f64;
            let drop = 0.30 + 0.35 * random(47, key);
            let (top, radius) = (on(t), 0.17 + 0.05 * random(53, key));
            let centre = top - DVec3::Y * drop;
            cables.append(&tube(&[top, centre + DVec3::Y * radius], 0.004, 4));
            let place = Placement::at(centre).stretched(DVec3::new(1.0, 0.88, 1.0)).scaled(radius);
            document.instance("lantern", lantern[(random(59, key) * 6.0) as usize], &place);
            tops.push(Placement::at(centre).scaled(radius / 0.19));
        }
    }
    document.place("cables", &cables, cable);
    document.scatter("bulb", &icosphere(1), bulb, &bulbs);
    document.scatter("lantern rims", &rims, cable, &tops);
}

/// Tables along both sides, each with stools and two candles in glasses: a small flame and a point light each.
fn tables(document: &mut Document) {
    let wood = document.material(Material::new("wood", [0.16, 0.075, 0.03], 0.28));
    let iron = document.material(Material::new("iron", [0.03, 0.03, 0.033], 0.45));
    let wax = document.material(Material::new("wax", [0.75, 0.68, 0.52], 0.5));
    let flame = Material::new("flame", [0.0; 3], 1.0).specular(0.0).emissive([1.0, 0.6, 0.22], 900.0);
    let flame = document.material(flame);
    let top = [(0.0, 0.715), (0.385, 0.715), (0.395, 0.722), (0.395, 0.738), (0.388, 0.745), (0.0, 0.745)];
    let leg = [
        (0.0, 0.0),
        (0.22, 0.0),
        (0.225, 0.012),
        (0.05, 0.05),
        (0.028, 0.10),
        (0.026, 0.66),
        (0.06, 0.716),
        (0.0, 0.716),
    ];
    let seat = [(0.0, 0.44), (0.16, 0.44), (0.17, 0.45), (0.165, 0.475), (0.0, 0.48)];
    let candle = [(0.0, 0.745), (0.026, 0.745), (0.028, 0.75), (0.028, 0.815), (0.022, 0.82), (0.0, 0.815)];
    let [top, leg, seat, candle] = [&top[..], &leg, &seat, &candle].map(|profile| {
        let points: Vec<DVec2> = profile.iter().map(|p| DVec2::from(*p)).collect();
        lathe(&points, 28, 40.0)
    });
    let mut legs = Mesh::default();
    for turn in 0..3 {
        let (s, c) = libm::sincos(std::f64::consts::TAU * f64::from(turn) / 3.0);
        legs.append(&tube(
            &[DVec3::new(0.11 * c, 0.445, 0.11 * s), DVec3::new(0.19 * c, 0.0, 0.19 * s)],
            0.012,
            8,
        ));
    }
    let mut places = [Vec::new(), Vec::new(), Vec::new(), Vec::new()];
    for index in 0..12 {
        let side = if index % 2 == 0 { -1.0 } else { 1.0 };
        let jitter = |k: u64| random(61 + k, index) - 0.5;
        let centre = DVec3::new(
            side * (2.35 + 0.35 * jitter(0)),
            0.0,
            4.9 - 3.1 * (index / 2) as f64 + 0.7 * jitter(1),
        );
        places[0].push(Placement::at(centre));
        for stool in 0..3 {
            let angle = std::f64::consts::TAU * (f64::from(stool) / 3.0 + random(71, index));
            let (s, c) = libm::sincos(angle);
            places[1].push(
                Placement::at(centre + DVec3::new(0.68 * c, 0.0, 0.68 * s)).turned_y(50.0 * f64::from(stool)),
            );
        }
        for k in 0..2 {
            let offset =
                DVec3::new(0.16 * jitter(2) + 0.12 * f64::from(k) - 0.06, 0.0, 0.3 * (f64::from(k) - 0.5));
            let base = centre + offset;
            places[2].push(Placement::at(base));
            places[3].push(Placement::at(base + DVec3::Y * 0.845).stretched(DVec3::new(0.006, 0.018, 0.006)));
            let light = json!({ "type": "point", "color": [1.0, 0.6, 0.24], "intensity": 0.35 });
            document.light("candle", light, &Placement::at(base + DVec3::Y * 0.9));
        }
    }
    let [tables, stools, candles, flames] = &places;
    document.scatter("table", &top, wood, tables);
    document.scatter("table foot", &leg, iron, tables);
    document.scatter("stool", &seat, wood, stools);
    document.scatter("stool legs", &legs, iron, stools);
    document.scatter("candle", &candle, wax, candles);
    document.scatter("flame", &icosphere(1), flame, flames);
}
