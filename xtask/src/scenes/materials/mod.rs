//! `materials.glb`: a board of balls on steps. Each row varies one parameter of one material feature from left to right; a plate at its
//! end names it. Soft boxes and a pale sky light it. The first camera sees all, the two others one half each.

mod rows;

use super::kit::{
    Document, Geometry, Material, Mesh, Picture, Placement, bevel_box, lathe, lettering, smoothstep,
};
use glam::{DVec2, DVec3};
use rows::Row;
use std::f64::consts::PI;

/// Radius of a ball, distance between columns, height and depth of a step.
const BALL: f64 = 0.36;
const PITCH: f64 = 0.92;
const RISE: f64 = 0.60;
const TREAD: f64 = 0.86;
/// Columns of a block; rows fill the left block from below, then the right one.
const COLUMNS: usize = 5;
const ROWS: usize = 9;
/// Where the inner column of a block stands, and the inner edge of the plates.
const INNER: f64 = 0.62;
const PLATES: f64 = INNER + PITCH * (COLUMNS as f64 - 0.5) + 0.12;
/// The foot under a ball.
const FOOT: f64 = 0.05;

/// The scene as a `.glb` file.
pub(crate) fn materials() -> Vec<u8> {
    let mut document = Document::default();
    let middle = DVec3::new(0.0, ROWS as f64 * RISE * 0.5 - 0.62, -(ROWS as f64) * TREAD * 0.5);
    let back = DVec3::new(0.0, 9.6, 19.0);
    document.camera("all", [middle + back, middle + DVec3::new(0.0, 0.05, 0.0)], 24.2, 16.0 / 9.0);
    for (name, x) in [("left", -3.2), ("right", 3.2)] {
        let at = middle + DVec3::X * x;
        document.camera(name, [at + back * 0.95, at], 23.0, 1.0);
    }
    document.sky(serde_json::json!([0.34, 0.36, 0.40]));
    steps(&mut document);
    lights(&mut document);
    let balls = Balls::new(&mut document);
    for (index, row) in rows::all(&mut document).into_iter().enumerate() {
        balls.place(&mut document, index, row);
    }
    document.to_glb()
}

/// The floor of a step, in the middle.
fn step(row: usize) -> DVec3 {
    DVec3::new(0.0, row as f64 * RISE, -(row as f64) * TREAD)
}

/// The steps: a checked pattern, which glass bends, on dark stone.
fn steps(document: &mut Document) {
    let half = PLATES + 2.1;
    let check =
        Picture::from_fn([64, 64], |u, v| DVec3::splat(if (u < 0.5) == (v < 0.5) { 0.46 } else { 0.34 }));
    let texture = document.texture_of("check", &check.png(), [0.46, 0.46]);
    let stone = document.material(Material::new("checked stone", [1.0; 3], 0.7).color_texture(texture));
    let mut all = Mesh::default();
    for row in 0..ROWS {
        let at = step(row);
        let front = at.z + TREAD * 0.5;
        let low = DVec3::new(-half, if row == 0 { -0.4 } else { at.y - RISE - 0.02 }, front - TREAD - 0.05);
        all.append(&bevel_box(low, DVec3::new(half, at.y, front), 0.008));
    }
    document.place("steps", &all.box_uvs(DVec2::ZERO), stone);
    let wall = document.material(Material::new("backdrop", [0.60, 0.61, 0.63], 0.9));
    let top = step(ROWS - 1);
    let z = top.z - TREAD * 0.5 - 0.04;
    let backdrop =
        bevel_box(DVec3::new(-half - 8.0, -0.4, z - 0.3), DVec3::new(half + 8.0, top.y + 9.0, z), 0.01);
    document.place("backdrop", &backdrop, wall);
    let floor = bevel_box(DVec3::new(-half - 8.0, -0.7, z), DVec3::new(half + 8.0, -0.4, 12.0), 0.01);
    document.place("floor", &floor, wall);
}

/// Three soft boxes: a large one from the left, a tall one from the right, a strip from above and behind.
fn lights(document: &mut Document) {
    let boxes = [
        ("key", DVec3::new(-9.0, 10.5, 5.5), [3.2, 2.4], 15.0),
        ("fill", DVec3::new(10.0, 7.5, 5.0), [1.0, 2.6], 10.0),
        ("top", DVec3::new(0.0, 12.5, -2.5), [4.5, 0.7], 12.0),
    ];
    let target = DVec3::new(0.0, 2.4, -3.6);
    for (name, at, [width, height], nits) in boxes {
        let light = Material::new(name, [0.0; 3], 1.0).specular(0.0).emissive([1.0, 0.98, 0.95], nits);
        let light = document.material(light);
        let mut panel = Mesh::default();
        let corners = [(-width, -height), (width, -height), (width, height), (-width, height)];
        panel.flat_quad(corners.map(|(x, y)| DVec3::new(x, y, 0.0)), corners.map(DVec2::from));
        // A placement looks along -z; the panel shines along +z.
        let mut placement = Placement::looking(at, at * 2.0 - target);
        placement.translation = at;
        let geometry = document.geometry(&panel);
        document.object(name, &geometry, light, &placement);
    }
}

/// What every row shares.
struct Balls {
    ball: Geometry,
    rainbow: Geometry,
    foot: Geometry,
    foot_material: usize,
}

impl Balls {
    fn new(document: &mut Document) -> Self {
        let ball = sphere();
        let mut rainbow = ball.clone();
        rainbow.colors = ball.normals.iter().map(|n| rows::rainbow(*n)).collect();
        let profile = [(0.0, 0.0), (0.25, 0.0), (0.26, 0.01), (0.22, 0.042), (0.205, FOOT), (0.0, FOOT)];
        let foot = lathe(&profile.map(DVec2::from), 40, 35.0);
        Balls {
            ball: document.geometry(&ball),
            rainbow: document.geometry(&rainbow),
            foot: document.geometry(&foot),
            foot_material: document.material(Material::new("foot", [0.03, 0.03, 0.032], 0.35)),
        }
    }

    /// Places a row and its plate.
    fn place(&self, document: &mut Document, index: usize, row: Row) {
        let (side, level) = (if index < ROWS { -1.0 } else { 1.0 }, ROWS - 1 - index % ROWS);
        let base = step(level);
        plate(document, row.name, side, base);
        assert_eq!(row.materials.len(), COLUMNS, "{}", row.name);
        let foot = document.mesh("foot", &[(&self.foot, self.foot_material)]);
        for (column, material) in row.materials.into_iter().enumerate() {
            // From left to right in both blocks.
            let from_left = PITCH * column as f64;
            let x = if side < 0.0 {
                -INNER - PITCH * (COLUMNS as f64 - 1.0) + from_left
            } else {
                INNER + from_left
            };
            let at = base + DVec3::X * x;
            let material = document.material(material);
            let colored = row.vertex_colors & (1 << column) != 0;
            let geometry = if colored { &self.rainbow } else { &self.ball };
            let name = format!("{} {}", row.name.to_lowercase(), column + 1);
            document.object(&name, geometry, material, &Placement::at(at + DVec3::Y * (FOOT + BALL + 0.002)));
            document.instance("foot", foot, &Placement::at(at));
        }
    }
}

/// The ball, with texture coordinates in metres at its equator.
fn sphere() -> Mesh {
    const ROWS: usize = 36;
    let profile: Vec<DVec2> = (0..=ROWS)
        .map(|i| {
            let (s, c) = libm::sincos(PI * i as f64 / ROWS as f64);
            DVec2::new(if i % ROWS == 0 { 0.0 } else { s }, -c) * BALL
        })
        .collect();
    let mut mesh = lathe(&profile, 72, 60.0);
    // The profile's normals are those of its segments' means: the sphere has its own.
    mesh.normals = mesh.positions.iter().map(|p| p.normalize()).collect();
    mesh
}

/// A plate with the name of a row, at the outer end of its step.
fn plate(document: &mut Document, name: &str, side: f64, base: DVec3) {
    let text = lettering(name);
    let (letter, margin) = (0.155, 0.07);
    let [width, height] = [text.width * letter + 2.0 * margin, letter + 2.0 * margin];
    let pixels = [(width / 0.006) as usize, (height / 0.006) as usize];
    let picture = Picture::from_fn(pixels, |u, v| {
        let p = DVec2::new(u * width - margin, v * height - margin) / letter;
        let ink = smoothstep(0.085, 0.045, text.distance(p));
        DVec3::splat(0.035).lerp(DVec3::splat(0.85), ink)
    });
    let texture = document.texture(&format!("plate {name}"), &picture.png());
    let texture = super::kit::Texture { index: texture, size: [1.0; 2] };
    let material = document.material(Material::new(name, [1.0; 3], 0.5).color_texture(texture));
    let mut face = Mesh::default();
    let (w, h) = (width / 2.0, height / 2.0);
    let corners = [(-w, -h), (w, -h), (w, h), (-w, h)].map(|(x, y)| DVec3::new(x, y, 0.0));
    face.flat_quad(corners, [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)].map(DVec2::from));
    let back =
        bevel_box(DVec3::new(-w - 0.01, -h - 0.01, -0.03), DVec3::new(w + 0.01, h + 0.01, -0.001), 0.004);
    // Leaning back towards the camera above.
    let x = side * (PLATES + w);
    let stand = Placement::at(base + DVec3::new(x, h * 0.93 + 0.012, 0.24)).turned(DVec3::X, -24.0);
    let geometry = document.geometry(&face);
    document.object(name, &geometry, material, &stand);
    let dark = document.material(Material::new("plate back", [0.03; 3], 0.5));
    let geometry = document.geometry(&back);
    document.object("plate back", &geometry, dark, &stand);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_has_its_five_balls_and_names_are_its_own() {
        let rows = rows::all(&mut Document::default());
        assert_eq!(rows.len(), 2 * ROWS);
        let names: std::collections::BTreeSet<&str> = rows.iter().map(|r| r.name).collect();
        assert_eq!(names.len(), rows.len());
        assert!(rows.iter().all(|r| r.materials.len() == COLUMNS));
    }
}
