//! Shapes that the things of the changing room share: a box between two corners, a strap along a path, a sheet over the unit square.

use crate::scenes::kit::{Mesh, Placement, bevel_box};
use glam::{DVec2, DVec3};

/// The box between two opposite corners, its edges bevelled by `bevel`.
pub(super) fn block(min: [f64; 3], max: [f64; 3], bevel: f64) -> Mesh {
    bevel_box(DVec3::from(min), DVec3::from(max), bevel)
}

/// A strap along `path`, `width` wide in the direction `across`, `thickness` thick, with its ends closed; `path` runs along the
/// middle of its thickness. `across` and the path's direction span the strap; its outside is on their left-hand side.
pub(super) fn ribbon(path: &[DVec3], across: DVec3, width: f64, thickness: f64) -> Mesh {
    let last = path.len() - 1;
    let out = |i: usize| {
        let along = path[(i + 1).min(last)] - path[i.saturating_sub(1)];
        across.cross(along).normalize()
    };
    let rims = [(-0.5, 0.5), (0.5, 0.5), (0.5, -0.5), (-0.5, -0.5)];
    let point = |i: usize, (a, t): (f64, f64)| path[i] + across * (a * width) + out(i) * (t * thickness);
    let mut mesh = Mesh::default();
    for side in 0..4 {
        let (from, to) = (rims[side], rims[(side + 1) % 4]);
        let normal = |i: usize| match side {
            0 => out(i),
            1 => across,
            2 => -out(i),
            _ => -across,
        };
        let rows: Vec<[u32; 2]> =
            (0..=last).map(|i| [from, to].map(|rim| mesh.push(point(i, rim), normal(i)))).collect();
        for pair in rows.windows(2) {
            mesh.quad(pair[0][0], pair[1][0], pair[1][1], pair[0][1]);
        }
    }
    for (i, toward, order) in
        [(0, path[0] - path[1], [0, 1, 2, 3]), (last, path[last] - path[last - 1], [3, 2, 1, 0])]
    {
        let [a, b, c, d] = order.map(|k: usize| mesh.push(point(i, rims[k]), toward));
        mesh.quad(a, b, c, d);
    }
    mesh
}

/// The sheet `f` over the unit square in `columns` by `rows` quads, its normals from difference quotients; it faces
/// ∂f/∂v × ∂f/∂u, the viewer of a sheet whose u runs right and v down.
pub(super) fn surface(columns: usize, rows: usize, f: impl Fn(DVec2) -> DVec3) -> Mesh {
    let mut mesh = Mesh::default();
    let h = 1e-5;
    for row in 0..=rows {
        for column in 0..=columns {
            let p = DVec2::new(column as f64 / columns as f64, row as f64 / rows as f64);
            let along = |d: DVec2| f(p + d * h) - f(p - d * h);
            mesh.push(f(p), along(DVec2::Y).cross(along(DVec2::X)));
        }
    }
    let at = |column: usize, row: usize| (row * (columns + 1) + column) as u32;
    for row in 0..rows {
        for column in 0..columns {
            mesh.quad(at(column, row), at(column, row + 1), at(column + 1, row + 1), at(column + 1, row));
        }
    }
    mesh
}

/// Texture coordinates in metres by projection, u along the unit axis `grain`; `shift` is added, so that planks differ.
pub(super) fn grained(mesh: Mesh, grain: DVec3, shift: DVec2) -> Mesh {
    let turn = match grain {
        DVec3::Y => Placement::at(DVec3::ZERO).turned(DVec3::Z, -90.0),
        DVec3::Z => Placement::at(DVec3::ZERO).turned(DVec3::Y, 90.0),
        _ => Placement::at(DVec3::ZERO),
    };
    let back = Placement { rotation: turn.rotation.conjugate(), ..turn };
    mesh.placed(&turn).box_uvs(shift).placed(&back)
}

/// A pad on y = 0 under an outline in (x, z) that can be seen whole from its centre, clockwise seen from above as (x, z) are drawn on
/// paper with z downwards; its rims are rounded off by `bevel`.
pub(super) fn pad(outline: &[DVec2], height: f64, bevel: f64) -> Mesh {
    let n = outline.len();
    let out = |i: usize| {
        let along = outline[(i + 1) % n] - outline[(i + n - 1) % n];
        DVec2::new(along.y, -along.x).normalize()
    };
    let rows = [
        (bevel, 0.0, -1.0, 0.2),
        (0.0, bevel, -0.3, 1.0),
        (0.0, height - bevel, 0.3, 1.0),
        (bevel, height, 1.0, 0.2),
    ];
    let mut mesh = Mesh::default();
    for (inset, y, up, side) in rows {
        for (i, p) in outline.iter().enumerate() {
            let (q, o) = (*p - out(i) * inset, out(i) * side);
            mesh.push(DVec3::new(q.x, y, q.y), DVec3::new(o.x, up, o.y));
        }
    }
    let at = |row: usize, i: usize| (row * n + i % n) as u32;
    for i in 0..n {
        for row in 0..3 {
            mesh.quad(at(row, i), at(row + 1, i), at(row + 1, i + 1), at(row, i + 1));
        }
    }
    for (row, y, up) in [(0, 0.0, DVec3::NEG_Y), (3, height, DVec3::Y)] {
        let centre = mesh.push(DVec3::Y * y, up);
        let rim: Vec<u32> = (0..n).map(|i| mesh.push(mesh.positions[at(row, i) as usize], up)).collect();
        for i in 0..n {
            let (a, b) = (rim[i], rim[(i + 1) % n]);
            mesh.triangles.push(if row == 0 { [centre, a, b] } else { [centre, b, a] });
        }
    }
    mesh
}
