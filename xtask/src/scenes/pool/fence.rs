//! The chain-link fence around the place.

use super::{Pool, joinery};
use crate::scenes::kit::{Material, Mesh, Picture, Placement, lathe, smoothstep, tube};
use glam::{DVec2, DVec3};

const HEIGHT: f64 = 4.4;
/// Corners of the fence.
const X: [f64; 2] = [-26.5, 29.5];
const Z: [f64; 2] = [-22.5, 17.5];

/// Posts, rails and the wire mesh.
pub(super) fn fence(pool: &mut Pool) {
    let wire = pool.material("wire mesh", |pool| {
        // One diamond of 60 mm; wires of 4 mm along both diagonals, one passing over the other.
        let color = pool.texture("wire mesh", [0.06; 2], || {
            let at = |u: f64, v: f64| {
                let near = |t: f64| (t - t.round()).abs() * 0.06 / 2f64.sqrt();
                let d = near(u + v).min(near(u - v));
                let shade = 0.42 + 0.35 * smoothstep(0.002, 0.0, d);
                (DVec3::new(1.0, 1.0, 0.98) * shade, smoothstep(0.0036, 0.0016, d))
            };
            Picture::with_alpha([64; 2], at).png()
        });
        Material::new("wire mesh", [0.85; 3], 0.5).color_texture(color).mask(0.5).double_sided()
    });
    let corners = [(X[0], Z[0]), (X[1], Z[0]), (X[1], Z[1]), (X[0], Z[1])];
    let mut mesh = Mesh::default();
    let mut rails = Mesh::default();
    let mut posts = Vec::new();
    for i in 0..4 {
        let [a, b] = [corners[i], corners[(i + 1) % 4]].map(|(x, z)| DVec3::new(x, 0.0, z));
        let length = (b - a).length();
        let uvs = [(0.0, 0.0), (length, 0.0), (length, -HEIGHT), (0.0, -HEIGHT)].map(DVec2::from);
        mesh.flat_quad([a, b, b + DVec3::Y * HEIGHT, a + DVec3::Y * HEIGHT], uvs);
        for y in [0.06, HEIGHT / 2.0, HEIGHT] {
            let lift = DVec3::Y * y;
            rails.append(&tube(&[a + lift, b + lift], if y == HEIGHT { 0.021 } else { 0.006 }, 8));
        }
        let count = (length / 2.8).round();
        posts.extend((0..count as u32).map(|k| Placement::at(a.lerp(b, f64::from(k) / count))));
    }
    pool.document.place("fence mesh", &mesh, wire);
    let steel = joinery::galvanised(pool);
    pool.document.place("fence rails", &rails, steel);
    let profile = [
        (0.0, -0.1),
        (0.03, -0.1),
        (0.03, HEIGHT + 0.05),
        (0.034, HEIGHT + 0.05),
        (0.034, HEIGHT + 0.07),
        (0.0, HEIGHT + 0.1),
    ];
    let post = lathe(&profile.map(DVec2::from), 6, 70.0);
    pool.document.scatter("fence post", &post, steel, &posts);
}
