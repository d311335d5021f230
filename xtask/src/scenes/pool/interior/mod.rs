//! The changing room: 6 x 5 x 2.8 m of concrete, lit by one tube lamp, by the sun through the open door and by the sky through two
//! high windows. It is a building of its own, closed on all sides.
//!
//! The room's coordinates: x to the right and z towards the viewer, the floor at y = 0; [`Room`] brings them into the scene's.

mod cloth;
mod fittings;
mod furniture;
mod parts;
mod shell;
mod stage;
mod textures;
mod things;

use super::Pool;
use crate::scenes::kit::{Mesh, Placement};
use glam::DVec3;
use shell::{Opening, ROOM, WALL, Wall};
use stage::{Finish, Room};

/// Where the room's corner (0, 0, 0) stands in the scene: on the deck behind the starting blocks, a step above it, its door towards the
/// water and the afternoon sun, out of the exterior's view.
const CORNER: DVec3 = DVec3::new(-24.3, 0.035, -4.0);

/// The windows in the back wall and the door in the right one, along each wall and up.
const WINDOWS: [[[f64; 2]; 2]; 2] = [[[0.75, 2.02], [2.05, 2.58]], [[2.35, 2.02], [3.65, 2.58]]];
const DOOR: [[f64; 2]; 2] = [[2.35, 0.0], [3.35, 2.10]];

/// Adds the changing room and its camera.
pub(super) fn interior(pool: &mut Pool) {
    let mut room = Room::new(pool, CORNER);
    shell(&mut room);
    windows(&mut room);
    door(&mut room);
    lamp(&mut room);
    shelf(&mut room);
    benches(&mut room);
    cabinet(&mut room);
    mats(&mut room);
    pallets_and_buckets(&mut room);
    hooks(&mut room);
    sandals(&mut room);
    let [eye, target] = [DVec3::new(0.42, 1.38, 4.72), DVec3::new(3.75, 1.30, 0.75)];
    room.camera("interior", [eye, target], 56.0);
}

/// The four walls, seen from the room, left to right each: back, right, front, left.
fn walls() -> [Wall; 4] {
    let openings =
        |list: &[[[f64; 2]; 2]]| list.iter().map(|[low, high]| Opening::new(*low, *high)).collect();
    let wall = |corner: DVec3, u: DVec3, length: f64, openings: Vec<Opening>, shift: f64| Wall {
        corner,
        u,
        length,
        openings,
        shift,
    };
    [
        wall(DVec3::ZERO, DVec3::X, ROOM.x, openings(&WINDOWS), 0.0),
        wall(DVec3::new(ROOM.x, 0.0, 0.0), DVec3::Z, ROOM.z, openings(&[DOOR]), 0.6),
        wall(DVec3::new(ROOM.x, 0.0, ROOM.z), DVec3::NEG_X, ROOM.x, Vec::new(), 0.3),
        wall(DVec3::new(0.0, 0.0, ROOM.z), DVec3::NEG_Z, ROOM.z, Vec::new(), 1.1),
    ]
}

fn shell(room: &mut Room) {
    let [mut lower, mut upper, mut outer] = [(); 3].map(|()| Mesh::default());
    for wall in walls() {
        wall.lower(&mut lower);
        wall.upper(&mut upper);
        wall.outer(&mut outer);
    }
    room.place("room lower walls", &lower, Finish::Formwork);
    room.place("room upper walls", &upper, Finish::Concrete);
    room.place("room outer walls", &outer, Finish::Outside);
    room.place("room floor", &shell::floor(), Finish::Screed);
    room.place("room ceiling", &shell::ceiling(), Finish::Concrete);
    room.place("room roof", &shell::roof(), Finish::Roof);
    room.put("gully", &fittings::gully(), Finish::Steel, &[Placement::xyz(2.0, 0.0, 3.86)]);
}

fn windows(room: &mut Room) {
    let places = WINDOWS.map(|[[x, y], _]| Placement::xyz(x, y, 0.0));
    let [[x0, y0], [x1, y1]] = WINDOWS[0];
    let size = [x1 - x0, y1 - y0];
    let [frame, panes] = fittings::window(size, 0.07);
    room.put("window frame", &frame, Finish::Paint, &places);
    room.put("window panes", &panes, Finish::Glass, &places);
    room.put("window wire", &fittings::wire_sheet(size, 0.035), Finish::Wire, &places);
}

fn door(room: &mut Room) {
    let [[z, _], [end, height]] = DOOR;
    let width = end - z;
    let opening = Placement::xyz(ROOM.x, 0.0, z).turned_y(-90.0);
    room.put("door frame", &fittings::door_frame([width, height], WALL), Finish::Paint, &[opening]);
    // Folded back towards the corner of the room.
    let leaf = [width - 0.076, height - 0.042];
    let hinge = Placement::xyz(ROOM.x - 0.03, 0.012, z + 0.034).turned_y(-90.0 - 163.0);
    room.put("door leaf", &fittings::door_leaf(leaf), Finish::DoorPaint, &[hinge]);
    room.put("door metal", &fittings::door_metal(leaf), Finish::Steel, &[hinge]);
    room.put(
        "switch",
        &fittings::switch(),
        Finish::White,
        &[Placement::xyz(ROOM.x, 1.15, end + 0.22).turned_y(-90.0)],
    );
}

fn lamp(room: &mut Room) {
    let at = DVec3::new(3.0, ROOM.y - fittings::LAMP_DROP, 2.25);
    room.put("lamp body", &fittings::lamp_body(), Finish::Enamel, &[Placement::at(at)]);
    room.put("lamp cover", &fittings::lamp_cover(), Finish::Light, &[Placement::at(at)]);
    // A conduit leads along the ceiling to the switch beside the door.
    let y = ROOM.y - 0.0115;
    let z = DOOR[1][0] + 0.22;
    let path = [
        DVec3::new(3.0 + 0.62 * 0.5 * fittings::LAMP[0], y, at.z),
        DVec3::new(3.465, y, z),
        DVec3::new(ROOM.x - 0.0115, y, z),
        DVec3::new(ROOM.x - 0.0115, 1.18, z),
    ];
    let clips = [
        (DVec3::new(3.465, y, 2.9), DVec3::Z),
        (DVec3::new(4.2, y, z), DVec3::X),
        (DVec3::new(5.0, y, z), DVec3::X),
        (DVec3::new(5.7, y, z), DVec3::X),
        (DVec3::new(ROOM.x - 0.0115, 2.4, z), DVec3::Y),
        (DVec3::new(ROOM.x - 0.0115, 1.6, z), DVec3::Y),
    ];
    room.place("conduit", &fittings::conduit(&path, &clips), Finish::White);
}

/// Where the shelf stands, and the benches: their middle on the floor.
const SHELF: DVec3 = DVec3::new(2.05, 0.0, 0.19);
const BENCHES: [(DVec3, f64); 2] = [(DVec3::new(1.75, 0.0, 2.05), 1.2), (DVec3::new(4.05, 0.0, 1.55), -0.8)];

/// The middle of the floor of a cell of the shelf, moved by (x, z).
fn cell(column: usize, row: usize, [x, z]: [f64; 2]) -> Placement {
    Placement::at(SHELF + furniture::cell_floor(column, row) + DVec3::new(x, 0.0, z))
}

fn shelf(room: &mut Room) {
    room.put("shelf", &furniture::shelf(), Finish::Birch, &[Placement::at(SHELF)]);
    let high = [cell(1, 2, [0.0, 0.02]), cell(4, 1, [0.01, 0.01])];
    room.put("folded towels", &cloth::folded(5, 3), Finish::TowelWhite, &high);
    let low = [cell(2, 1, [0.0, 0.02]), cell(6, 2, [-0.01, 0.02])];
    room.put("folded towels, low", &cloth::folded(3, 8), Finish::TowelTeal, &low);
    let single = [cell(0, 1, [0.0, 0.02]), cell(7, 0, [0.0, 0.02])];
    room.put("folded towel", &cloth::folded(2, 5), Finish::TowelCoral, &single);
    let bolts = [cell(3, 2, [-0.07, 0.0]), cell(3, 2, [0.07, 0.005])];
    room.put("rolled towel", &cloth::rolled(), Finish::TowelCoral, &bolts);
    let bottles = [cell(5, 2, [-0.05, 0.08]).turned_y(20.0), cell(0, 2, [0.06, 0.09]).turned_y(-15.0)];
    room.put("bottle", &things::bottle(), Finish::Bottle, &bottles);
    room.put("bottle cap", &things::bottle_cap(), Finish::White, &bottles);
    // Swimming boards stand on edge, leaning a little against an upright.
    let leaning = |column: usize, row: usize, x: f64| {
        let upright = Placement::at(DVec3::ZERO).turned(DVec3::Z, 86.0);
        Placement { translation: cell(column, row, [x, 0.04]).translation + DVec3::Y * 0.142, ..upright }
    };
    room.put("board", &things::board(), Finish::FoamBlue, &[leaning(8, 1, -0.098), leaning(8, 1, -0.063)]);
    room.put(
        "board, red",
        &things::board(),
        Finish::FoamRed,
        &[leaning(8, 1, -0.028), leaning(5, 0, -0.098)],
    );
    let pairs = [(2, 0, 8.0), (6, 0, -5.0)];
    let feet: Vec<Placement> =
        pairs.iter().flat_map(|&(c, r, turn)| pair(cell(c, r, [0.0, 0.03]), turn, 0.06)).collect();
    room.put("sandal sole", &things::sandal_sole(), Finish::Rubber, &feet);
    room.put("sandal strap", &things::sandal_strap(), Finish::RubberBlue, &feet);
}

/// A left and a right sandal side by side.
fn pair(at: Placement, turn: f64, apart: f64) -> [Placement; 2] {
    [-1.0, 1.0].map(|side| {
        let (s, c) = libm::sincos(turn.to_radians());
        let offset = DVec3::new(c, 0.0, -s) * side * apart;
        let foot = Placement { translation: at.translation + offset, ..Placement::at(DVec3::ZERO) };
        foot.turned_y(turn - side * 4.0).stretched(DVec3::new(-side, 1.0, 1.0))
    })
}

fn benches(room: &mut Room) {
    let places = BENCHES.map(|(at, turn)| Placement::at(at).turned_y(turn));
    room.put("bench seat", &furniture::bench_seat(), Finish::Turquoise, &places);
    room.put("bench frame", &furniture::bench_frame(), Finish::White, &places);
    room.put("bench feet", &furniture::bench_feet(), Finish::Rubber, &places);
    let bag = Placement::at(BENCHES[1].0 + DVec3::new(-0.5, furniture::BENCH[1], 0.0)).turned_y(9.0);
    room.put("bag", &things::bag(), Finish::Canvas, &[bag]);
    room.put("bag handles", &things::bag_handles(), Finish::Rubber, &[bag]);
    let towel = cloth::thrown(0.62, furniture::BENCH[2], 0.30, 0.20);
    let (at, turn) = BENCHES[0];
    room.put(
        "towel on bench",
        &towel,
        Finish::Striped,
        &[Placement::at(at + DVec3::new(-0.32, furniture::BENCH[1], 0.0)).turned_y(turn)],
    );
}

fn cabinet(room: &mut Room) {
    let at = Placement::xyz(4.32, 0.0, 0.26);
    room.put("cabinet", &furniture::cabinet(), Finish::CabinetPaint, &[at]);
    room.put("cabinet metal", &furniture::cabinet_metal(), Finish::Steel, &[at]);
    let clock = Placement::xyz(4.32, 2.28, 0.0).turned(DVec3::X, 90.0);
    let [case, hands] = things::clock();
    room.put("clock", &case, Finish::Enamel, &[clock]);
    room.put("clock hands", &hands, Finish::Rubber, &[clock]);
}

fn mats(room: &mut Room) {
    let [length, width] = furniture::MAT;
    let mut places = Vec::new();
    for (row, columns) in [(0, 4), (1, 3)] {
        for i in 0..columns {
            let jitter = |k: u64| crate::scenes::kit::hash01(17 + k, row * 10 + i) - 0.5;
            let x = 5.36 - (length + 0.012) * i as f64 + 0.006 * jitter(0);
            let z = 2.72 + (width + 0.012) * row as f64 + 0.006 * jitter(1);
            places.push(Placement::xyz(x, 0.0, z).turned_y(0.8 * jitter(2)));
        }
    }
    room.put("mat", &furniture::mat(), Finish::Mat, &places);
}

fn pallets_and_buckets(room: &mut Room) {
    let [_, height, depth] = furniture::PALLET;
    room.put("pallet", &furniture::pallet(4), Finish::Pallet, &[Placement::xyz(5.42, 0.0, 0.52)]);
    // The second leans against the left wall, standing on its long edge.
    let lean = Placement::xyz(0.17, depth / 2.0 + 0.035, 0.98)
        .turned(DVec3::X, 90.0)
        .turned_y(90.0)
        .turned(DVec3::Z, 8.0);
    room.put("pallet, leaning", &furniture::pallet(9), Finish::Pallet, &[lean]);
    let on_pallet = |x: f64, z: f64, turn: f64| Placement::xyz(x, height, z).turned_y(turn);
    let on_floor = |x: f64, z: f64, turn: f64| Placement::xyz(x, 0.0, z).turned_y(turn);
    let buckets = [
        (Finish::BucketBlue, on_pallet(5.20, 0.44, 30.0), 100.0),
        (Finish::BucketYellow, on_pallet(5.58, 0.58, -25.0), 96.0),
        (Finish::BucketRed, on_floor(3.02, 2.16, 65.0), 98.0),
    ];
    for (finish, place, tilt) in buckets {
        room.put("bucket", &things::bucket(), finish, &[place]);
        room.put("bucket handle", &things::bucket_handle(tilt), Finish::Steel, &[place]);
    }
}

fn hooks(room: &mut Room) {
    // On the right wall, between the corner and the door's leaf.
    let at = Placement::xyz(ROOM.x, 1.62, 0.75).turned_y(-90.0);
    room.put("hook rail", &furniture::hook_rail(1.1), Finish::Birch, &[at]);
    let hook = |along: f64| Placement { translation: at.translation + DVec3::new(-0.02, 0.0, along), ..at };
    room.put("hook", &furniture::hook(), Finish::Steel, &[-0.42, -0.14, 0.14, 0.42].map(hook));
    let towel =
        |along: f64| Placement { translation: at.translation + DVec3::new(-0.012, 0.03, along), ..at };
    room.put("hung towel", &cloth::hung(0.55, 0.95, 1), Finish::TowelTeal, &[towel(-0.42)]);
    room.put("hung towel, striped", &cloth::hung(0.6, 1.10, 4), Finish::Striped, &[towel(0.14)]);
}

fn sandals(room: &mut Room) {
    let at = |x: f64, z: f64| Placement::xyz(x, 0.0, z);
    let feet: Vec<Placement> =
        [pair(at(1.25, 2.42), 172.0, 0.065), pair(at(2.35, 1.80), 20.0, 0.07)].concat();
    room.put("sandal sole, floor", &things::sandal_sole(), Finish::RubberBlue, &feet);
    room.put("sandal strap, floor", &things::sandal_strap(), Finish::White, &feet);
    // One pair on the mats, kicked off.
    let y = 0.014;
    let loose = [
        Placement::xyz(3.42, y, 2.62).turned_y(-62.0),
        Placement::xyz(3.68, y, 2.78).turned_y(-96.0).stretched(DVec3::new(-1.0, 1.0, 1.0)),
    ];
    room.put("sandal sole, mats", &things::sandal_sole(), Finish::FoamRed, &loose);
    room.put("sandal strap, mats", &things::sandal_strap(), Finish::Rubber, &loose);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_room_is_rich_enough_and_not_too_rich() {
        let mut pool = Pool::default();
        interior(&mut pool);
        let census = pool.document.census();
        println!("{census:#?}");
        assert!((20_000..=46_000).contains(&census.triangles), "{} triangles", census.triangles);
        assert!(census.meshes >= 14, "{} meshes", census.meshes);
        assert!(census.textured >= 5, "{} textured materials", census.textured);
        assert!(census.normal_mapped >= 2, "{} materials with normal maps", census.normal_mapped);
        let (name, share) = census.largest();
        assert!(share <= 0.25, "{name} has {:.1} % of the triangles", share * 100.0);
    }
}
