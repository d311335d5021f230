//! Acceleration structures: what building them takes and what they hold. Of the scenes that are named, or of a displaced grid that is made
//! here, so that the figures do not depend on files.

use super::measure::median;
use super::place::Place;
use super::table::{Cell, Column, Table};
use crate::exit::Failure;
use crate::flags::bench::BenchArgs;
use crate::{console, device};
use lumbre::AccelReport;
use lumbre::core::math::Vec3;
use lumbre::scene::{CompiledScene, Mesh, Node, Primitive, Scene};
use std::time::Instant;

/// Builds whose medians count.
const RUNS: usize = 7;

const COLUMNS: [Column; 8] = [
    ("scene", "scene"),
    ("triangles", "triangles"),
    ("bytes_built", "bytes a triangle as built"),
    ("bytes", "bytes a triangle"),
    ("build_ms", "ms to build"),
    ("compact_ms", "ms to compact"),
    ("top_build_ms", "ms for the top level"),
    ("ready_ms", "ms until ready"),
];

pub(super) fn table(args: &BenchArgs) -> Result<Table, Failure> {
    let (mut rows, mut device) = (Vec::new(), String::new());
    for path in &args.scenes {
        let place = Place::open(path, args)?;
        rows.push(row(place.name.clone(), &measured(args, &place.compiled, &mut device)?));
    }
    if args.scenes.is_empty() {
        for &triangles in &args.triangles {
            let scene = lumbre::compile(&grid(triangles))?.scene;
            rows.push(row("grid".into(), &measured(args, &scene, &mut device)?));
        }
    }
    let settings = vec![("device", device), ("builds", format!("median of {RUNS} after 1"))];
    Ok(Table { columns: COLUMNS.into(), rows, settings })
}

/// What one build takes.
struct Built {
    /// Of the scene, where the device does not count its own.
    triangles: u64,
    bytes: u64,
    /// By the device, where it says so.
    report: Option<AccelReport>,
    /// From the compiled scene to one that can be drawn: all that goes to the device, too.
    ready_ms: f64,
}

fn measured(args: &BenchArgs, scene: &CompiledScene, name: &mut String) -> Result<Vec<Built>, Failure> {
    let mut all = Vec::new();
    for run in 0..=RUNS {
        let (open, scene) = (device::open(&args.device)?.alone(), scene.clone());
        let triangles = scene.triangles.len() as u64;
        let began = Instant::now();
        let backend = open.prepare(scene)?.backend;
        let ready_ms = 1e3 * began.elapsed().as_secs_f64();
        // The first one wakes the device.
        if run > 0 {
            all.push(Built { triangles, bytes: backend.memory(), report: backend.accel(), ready_ms });
        }
        *name = backend.device();
        device::validation(&*backend);
    }
    Ok(all)
}

fn row(name: String, all: &[Built]) -> Vec<Cell> {
    let last = all.last().expect("some builds");
    let (report, triangles) = (last.report, last.report.map_or(last.triangles, |r| r.triangles));
    let each = |bytes: u64| Cell::Number(bytes as f64 / triangles.max(1) as f64);
    let times = |time: fn(&AccelReport) -> f64| -> Cell {
        let times: Vec<f64> = all.iter().filter_map(|b| Some(time(b.report.as_ref()?))).collect();
        // A device without a clock says 0.
        Some(median(&times)).filter(|ms| *ms > 0.0).into()
    };
    let ready_ms = median(&all.iter().map(|b| b.ready_ms).collect::<Vec<_>>());
    console::note(format_args!("{name}, {triangles} triangles: {ready_ms:.2} ms until ready"));
    vec![
        Cell::Text(name),
        Cell::Whole(triangles),
        report.map_or(Cell::None, |r| each(r.bytes_built)),
        each(report.map_or(last.bytes, |r| r.bytes)),
        times(|r| r.build_ms),
        times(|r| r.compact_ms),
        times(|r| r.top_build_ms),
        Cell::Number(ready_ms),
    ]
}

/// Rolling hills of at least so many triangles, seen as one mesh.
fn grid(triangles: u32) -> Scene {
    let side = f64::from(triangles.div_ceil(2)).sqrt().ceil() as u32;
    let height =
        |x: f32, y: f32| 0.05 * (11.0 * x).sin() * (7.0 * y).cos() + 0.01 * (97.0 * x + 61.0 * y).sin();
    let corner = |i: u32| {
        let [x, y] = [i % (side + 1), i / (side + 1)].map(|n| n as f32 / side as f32);
        Vec3::new(x, height(x, y), y)
    };
    let positions = (0..(side + 1) * (side + 1)).map(corner).collect();
    let quad = |i: u32| {
        let a = i / side * (side + 1) + i % side;
        let b = a + side + 1;
        [a, b, a + 1, a + 1, b, b + 1]
    };
    let indices = (0..side * side).flat_map(quad).collect();
    let primitive = Primitive { positions, indices, ..Primitive::default() };
    let mut scene = Scene::default();
    let mesh = Some(scene.add_mesh(Mesh { name: "grid".into(), primitives: vec![primitive] }));
    scene.add_root(Node { mesh, ..Node::default() });
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_have_the_triangles_that_are_asked_for() {
        for (asked, made) in [(1, 2), (2, 2), (3, 8), (1000, 1058), (1_000_000, 1_002_528)] {
            let scene = grid(asked);
            let Mesh { primitives, .. } = &scene.meshes[0];
            assert_eq!(primitives[0].indices.len(), 3 * made, "{asked}");
            let most = *primitives[0].indices.iter().max().unwrap() as usize;
            assert_eq!(most + 1, primitives[0].positions.len(), "{asked}");
        }
        assert_eq!(lumbre::compile(&grid(50)).unwrap().scene.triangles.len(), 50);
    }

    #[test]
    fn what_a_device_does_not_say_is_left_out() {
        let built = |ready_ms, report| Built { triangles: 10, bytes: 500, report, ready_ms };
        let cpu = row("a".into(), &[built(1.0, None), built(3.0, None), built(2.0, None)]);
        assert_eq!((&cpu[2], &cpu[3], &cpu[4]), (&Cell::None, &Cell::Number(50.0), &Cell::None));
        assert_eq!(cpu[7], Cell::Number(2.0));
        let report = AccelReport {
            triangles: 20,
            bytes_built: 200,
            bytes: 100,
            build_ms: 4.0,
            ..AccelReport::default()
        };
        let gpu = row("a".into(), &[built(1.0, Some(report))]);
        assert_eq!((&gpu[1], &gpu[2], &gpu[3]), (&Cell::Whole(20), &Cell::Number(10.0), &Cell::Number(5.0)));
        assert_eq!((&gpu[4], &gpu[5]), (&Cell::Number(4.0), &Cell::None));
        assert_eq!((cpu.len(), gpu.len()), (COLUMNS.len(), COLUMNS.len()));
    }
}
