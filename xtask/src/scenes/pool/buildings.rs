//! Three low buildings of board-marked concrete under flat roofs that hang over: changing rooms, a bar, the plant.

use super::{Pool, joinery, surfaces};
use crate::scenes::kit::{Material, Mesh, Picture, Placement, bevel_box, lettering, smoothstep};
use glam::{DVec2, DVec3};

/// What fills an opening of a front.
#[derive(Clone, Copy, PartialEq)]
enum Fill {
    Door,
    Window,
    Shutter,
}

/// An opening: its middle along the front and its kind.
type Opening = (f64, Fill);

impl Fill {
    /// Width, and lower and upper edge.
    fn size(self) -> (f64, [f64; 2]) {
        match self {
            Fill::Door => (joinery::DOOR.x, [0.0, joinery::DOOR.y]),
            Fill::Window => (joinery::WINDOW.x, [1.95, 1.95 + joinery::WINDOW.y]),
            Fill::Shutter => (joinery::SHUTTER.x, [1.0, 1.0 + joinery::SHUTTER.y]),
        }
    }
}

/// A building in its own place: the front along x from 0 at z = 0, towards +z; the rest behind it.
struct Building {
    name: &'static str,
    place: Placement,
    /// Length, height up to the roof, depth.
    size: DVec3,
    front: &'static [Opening],
    /// How far the roof hangs over the front.
    eaves: f64,
}

const WALL: f64 = 0.28;
const ROOF: f64 = 0.27;

/// All three.
pub(super) fn buildings(pool: &mut Pool) {
    use Fill::{Door, Shutter, Window};
    let all = [
        Building {
            name: "changing rooms",
            place: Placement::xyz(-13.0, 0.0, -15.3),
            size: DVec3::new(21.0, 2.95, 5.2),
            front: &[
                (1.5, Window),
                (3.4, Door),
                (5.3, Window),
                (7.0, Window),
                (8.9, Door),
                (12.1, Door),
                (14.0, Window),
                (15.7, Window),
                (17.6, Door),
                (19.5, Window),
            ],
            eaves: 1.35,
        },
        Building {
            name: "bar",
            place: Placement::xyz(21.6, 0.0, -9.5).turned_y(-90.0),
            size: DVec3::new(12.5, 3.15, 5.0),
            front: &[(1.6, Door), (4.6, Shutter), (8.4, Shutter), (11.2, Door)],
            eaves: 1.9,
        },
        Building {
            name: "plant",
            place: Placement::xyz(11.6, 0.0, -16.0),
            size: DVec3::new(6.4, 2.45, 4.2),
            front: &[(1.3, Window), (3.1, Door), (5.0, Window)],
            eaves: 0.8,
        },
    ];
    for building in &all {
        shell(pool, building);
        openings(pool, building);
    }
    sign(pool, &all[0]);
}

/// Walls with their openings, plinth and roof.
fn shell(pool: &mut Pool, b: &Building) {
    let (boards, plain) = (surfaces::board_concrete(pool), surfaces::plain_concrete(pool));
    let mut walls = front(b.size.x, b.size.y, b.front);
    let d = -b.size.z;
    for (low, high) in [
        (DVec3::new(0.0, 0.0, d), DVec3::new(WALL, b.size.y, -WALL)),
        (DVec3::new(b.size.x - WALL, 0.0, d), DVec3::new(b.size.x, b.size.y, -WALL)),
        (DVec3::new(WALL, 0.0, d), DVec3::new(b.size.x - WALL, b.size.y, d + WALL)),
    ] {
        walls.append(&bevel_box(low, high, 0.01));
    }
    // Rain darkens the foot of a wall; what lies under the eaves stays pale.
    let height = b.size.y;
    let walls = walls.box_uvs(DVec2::new(0.0, b.size.x)).colored(|p| {
        let foot = smoothstep(0.9, 0.0, p.y);
        let top = smoothstep(height - 0.5, height, p.y);
        DVec3::new(1.0, 0.99, 0.97) * (1.0 - 0.20 * foot - 0.06 * top)
    });
    put(pool, &format!("{} walls", b.name), &walls, boards, &b.place);

    let (x, z, y) = (b.size.x, b.eaves, b.size.y);
    let mut roof = bevel_box(DVec3::new(-0.45, y, d - 0.45), DVec3::new(x + 0.45, y + ROOF, z), 0.018);
    // A drip under the edge, and a kerb of sheet around the gravel on top.
    roof.append(&bevel_box(
        DVec3::new(-0.36, y + ROOF - 0.002, d - 0.36),
        DVec3::new(x + 0.36, y + ROOF + 0.09, z - 0.09),
        0.012,
    ));
    roof.append(&bevel_box(
        DVec3::new(-0.42, y - 0.025, z - 0.06),
        DVec3::new(x + 0.42, y + 0.01, z - 0.025),
        0.006,
    ));
    put(pool, &format!("{} roof", b.name), &roof.box_uvs(DVec2::new(x, y)), plain, &b.place);
    let step = bevel_box(DVec3::new(-0.12, -0.08, -0.05), DVec3::new(x + 0.12, 0.035, 0.10), 0.012);
    let mut plinth = step;
    for end in [-0.05, x - 0.07] {
        plinth.append(&bevel_box(
            DVec3::new(end, -0.08, d - 0.05),
            DVec3::new(end + 0.12, 0.16, -0.06),
            0.012,
        ));
    }
    put(pool, &format!("{} plinth", b.name), &plinth.box_uvs(DVec2::new(y, x)), plain, &b.place);
}

/// A front of `length` and `height` with holes, as thick as a wall: cells between the edges of the openings, and their reveals.
fn front(length: f64, height: f64, openings: &[Opening]) -> Mesh {
    let holes: Vec<[f64; 4]> = openings
        .iter()
        .map(|(x, fill)| {
            let (width, [low, high]) = fill.size();
            [x - width / 2.0, x + width / 2.0, low, high]
        })
        .collect();
    let cuts = |ends: [f64; 2], pick: [usize; 2]| {
        let mut all: Vec<f64> = holes.iter().flat_map(|h| pick.map(|i| h[i])).chain(ends).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    };
    let (xs, mut ys) = (cuts([0.0, length], [0, 1]), cuts([0.0, height], [2, 3]));
    // More rows, for the colours at the vertices.
    ys.extend([0.3, 0.65, height - 0.4]);
    ys.sort_by(f64::total_cmp);
    ys.dedup();
    let none = [DVec2::ZERO; 4];
    let mut mesh = Mesh::default();
    for x in xs.windows(2) {
        for y in ys.windows(2) {
            let (mx, my) = ((x[0] + x[1]) / 2.0, (y[0] + y[1]) / 2.0);
            if holes.iter().any(|h| mx > h[0] && mx < h[1] && my > h[2] && my < h[3]) {
                continue;
            }
            let p = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
            mesh.flat_quad(
                [p(x[0], y[0], 0.0), p(x[1], y[0], 0.0), p(x[1], y[1], 0.0), p(x[0], y[1], 0.0)],
                none,
            );
            let b = -WALL;
            mesh.flat_quad([p(x[1], y[0], b), p(x[0], y[0], b), p(x[0], y[1], b), p(x[1], y[1], b)], none);
        }
    }
    for [x0, x1, y0, y1] in holes {
        let p = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
        let b = -WALL;
        mesh.flat_quad([p(x0, y0, 0.0), p(x0, y1, 0.0), p(x0, y1, b), p(x0, y0, b)], none);
        mesh.flat_quad([p(x1, y0, b), p(x1, y1, b), p(x1, y1, 0.0), p(x1, y0, 0.0)], none);
        mesh.flat_quad([p(x0, y1, 0.0), p(x1, y1, 0.0), p(x1, y1, b), p(x0, y1, b)], none);
        mesh.flat_quad([p(x0, y0, b), p(x1, y0, b), p(x1, y0, 0.0), p(x0, y0, 0.0)], none);
    }
    for x in [0.0, length] {
        let p = |y: f64, z: f64| DVec3::new(x, y, z);
        let corners = [p(0.0, -WALL), p(0.0, 0.0), p(height, 0.0), p(height, -WALL)];
        let corners = if x > 0.0 { [corners[1], corners[0], corners[3], corners[2]] } else { corners };
        mesh.flat_quad(corners, none);
    }
    mesh
}

/// Adds a mesh with its node.
fn put(pool: &mut Pool, name: &str, mesh: &Mesh, material: usize, place: &Placement) {
    pool.document.scatter(name, mesh, material, &[*place]);
}

/// Where a thing stands that has a place of its own inside a building.
fn inside(b: &Building, at: DVec3) -> Placement {
    Placement { translation: b.place.translation + b.place.rotation * at, ..b.place }
}

/// Doors with a lamp over each, windows, shutters.
fn openings(pool: &mut Pool, b: &Building) {
    for &(x, fill) in b.front {
        let (_, [low, _]) = fill.size();
        let place = inside(b, DVec3::new(x, low, 0.0));
        match fill {
            Fill::Door => {
                pool.joinery.doors.push(place);
                pool.joinery.lamps.push(inside(b, DVec3::new(x, joinery::DOOR.y + 0.2, 0.0)));
            }
            Fill::Window => pool.joinery.windows.push(place),
            Fill::Shutter => pool.joinery.shutters.push(place),
        }
    }
}

/// The name of the place on the edge of the roof.
fn sign(pool: &mut Pool, b: &Building) {
    let size = DVec2::new(3.6, 0.44);
    let enamel = pool.material("sign", |pool| {
        let color = pool.texture("sign", [1.0; 2], || {
            let text = lettering("PISCINA MUNICIPAL");
            let at = |u: f64, v: f64| {
                let p = DVec2::new(u - 0.5, v - 0.5) * size / 0.21;
                let d = text.distance(p + DVec2::new(text.width / 2.0, 0.5)) * 0.21;
                let edge = DVec2::new((0.5 - (u - 0.5).abs()) * size.x, (0.5 - (v - 0.5).abs()) * size.y);
                let line = smoothstep(0.006, 0.004, (edge.min_element() - 0.03).abs());
                let paint = smoothstep(0.020, 0.015, d).max(line);
                DVec3::new(0.012, 0.085, 0.33).lerp(DVec3::new(0.82, 0.82, 0.79), paint)
            };
            Picture::from_fn([1024, 126], at).png()
        });
        Material::new("sign", [1.0; 3], 0.3).color_texture(color)
    });
    let half = size.extend(0.03) / 2.0;
    let mut plate = bevel_box(-half, half, 0.006);
    plate.uvs = plate.positions.iter().map(|p| DVec2::new(p.x / size.x + 0.5, 0.5 - p.y / size.y)).collect();
    let at = inside(b, DVec3::new(10.5, b.size.y + ROOF + 0.30, b.eaves - 0.25));
    put(pool, "sign", &plate, enamel, &at);
    let steel = joinery::galvanised(pool);
    let mut feet = Mesh::default();
    for x in [-1.3, 1.3] {
        feet.append(&bevel_box(
            DVec3::new(x - 0.02, -0.36, -0.05),
            DVec3::new(x + 0.02, 0.15, -0.014),
            0.004,
        ));
    }
    put(pool, "sign feet", &feet.box_uvs(DVec2::ZERO), steel, &at);
}
