//! How long the first picture takes, from the start of the process on, step by step. What is cached (files by the system, pipelines by the
//! driver and by us) is as the runs before left it.

use super::place::{Place, scenes};
use super::settings;
use super::sweep::HD;
use super::table::{Cell, Column, Table};
use crate::exit::Failure;
use crate::flags::bench::BenchArgs;
use crate::flags::values::Size;
use crate::{console, device};
use lumbre::core::Film;
use lumbre::output::{Look, develop};
use std::time::Instant;

const COLUMNS: [Column; 13] = [
    ("scene", "scene"),
    ("camera", "camera"),
    ("size", "size"),
    ("before_ms", "ms before"),
    ("device_ms", "device"),
    ("load_ms", "load"),
    ("compile_ms", "compile"),
    ("upload_ms", "upload"),
    ("build_ms", "build"),
    ("pipelines_ms", "pipelines"),
    ("frame_ms", "frame"),
    ("develop_ms", "develop"),
    ("total_ms", "ms in all"),
];

/// A stopwatch for steps that follow one another.
struct Steps {
    last: Instant,
    ms: Vec<f64>,
}

impl Steps {
    /// A step is over.
    fn done(&mut self) {
        let now = Instant::now();
        self.ms.push(1e3 * (now - self.last).as_secs_f64());
        self.last = now;
    }
}

/// `started`: when the process began.
pub(super) fn table(args: &BenchArgs, started: Instant) -> Result<Table, Failure> {
    let mut steps = Steps { last: started, ms: Vec::new() };
    let path = scenes(args)?.swap_remove(0);
    let Size(size) = args.sizes.as_ref().map_or(Size(HD), |sizes| sizes[0]);
    steps.done();
    let open = device::open(&args.device)?.alone();
    steps.done();
    let lit = crate::lit::load(&path, &args.loading, &args.light)?;
    steps.done();
    let place = Place::of(&path, lit, args)?;
    let eye = place.eyes().next().expect("a camera, or the whole in view");
    let view = eye.view(size, args.settings())?;
    steps.done();
    let backend = device::prepare(open, place.compiled.clone())?;
    steps.done();
    backend.warm_up(&view)?;
    steps.done();
    let mut film = Film::new(size[0], size[1]);
    backend.render(&view, 0..1, &mut film, &())?;
    steps.done();
    let picture = develop(&film, &Look::default());
    steps.done();
    let total_ms = 1e3 * started.elapsed().as_secs_f64();
    device::validation(&*backend);
    console::note(format_args!("{} bytes of picture after {total_ms:.0} ms", picture.bytes.len()));
    // What the device itself took to build is not the way there.
    let build_ms = backend.accel().map(|r| r.build_ms + r.compact_ms + r.top_build_ms);
    let mut cells: Vec<Cell> = steps.ms.iter().map(|ms| Cell::Number(*ms)).collect();
    cells[4] = Cell::Number(steps.ms[4] - build_ms.unwrap_or(0.0));
    cells.insert(5, build_ms.into());
    let [width, height] = size;
    let names = [place.name.clone(), eye.name.to_owned(), format!("{width}x{height}")].map(Cell::Text);
    let row: Vec<Cell> = names.into_iter().chain(cells).chain([Cell::Number(total_ms)]).collect();
    Ok(Table { columns: COLUMNS.into(), rows: vec![row], settings: settings(args, &backend.device()) })
}
