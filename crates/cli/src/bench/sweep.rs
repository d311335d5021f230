//! Sizes, depths and samples per frame, at every camera of every scene: what a table walks over. Most tables are of frames.

use super::measure::{self, Figures, Plan};
use super::place::{Eye, Place, scenes};
use super::table::{Cell, Column, Table};
use super::{bring, settings};
use crate::exit::Failure;
use crate::flags::bench::BenchArgs;
use crate::flags::values::{Depth, Size};
use crate::{console, device};
use lumbre::Backend;
use lumbre::core::settings::{RenderSettings, View};
use lumbre::cpu::CpuBackend;
use std::cell::OnceCell;

/// What is varied; each list has at least one entry.
pub(super) struct Sweep {
    pub(super) sizes: Vec<[u32; 2]>,
    pub(super) depths: Vec<Option<u32>>,
    pub(super) samples: Vec<u32>,
}

/// Where no size is said.
pub(super) const HD: [u32; 2] = [1280, 720];

impl Sweep {
    /// What the flags say; else one size, one depth, one sample.
    pub(super) fn of(args: &BenchArgs) -> Self {
        let sizes = args.sizes.as_ref().map(|all| all.iter().map(|Size(size)| *size).collect());
        let depths = args.depths.as_ref().map(|all| all.iter().map(|Depth(depth)| *depth).collect());
        Sweep {
            sizes: sizes.unwrap_or_else(|| vec![HD]),
            depths: depths.unwrap_or_else(|| vec![args.settings().max_depth]),
            samples: args.samples.clone().unwrap_or_else(|| vec![1]),
        }
    }

    /// Other sizes, where the flags say none.
    pub(super) fn or_sizes(self, args: &BenchArgs, sizes: &[[u32; 2]]) -> Self {
        if args.sizes.is_some() { self } else { Sweep { sizes: sizes.into(), ..self } }
    }

    /// Other depths, where the flags say none.
    pub(super) fn or_depths(self, args: &BenchArgs, depths: impl IntoIterator<Item = u32>) -> Self {
        if args.depths.is_some() {
            return self;
        }
        Sweep { depths: depths.into_iter().map(Some).collect(), ..self }
    }

    /// Other numbers of samples, where the flags say none.
    pub(super) fn or_samples(self, args: &BenchArgs, samples: impl IntoIterator<Item = u32>) -> Self {
        if args.samples.is_some() { self } else { Sweep { samples: samples.into_iter().collect(), ..self } }
    }

    /// Goes through scenes, cameras, sizes and depths; `each` makes rows, which stand behind scene, camera, size and depth.
    pub(super) fn walk(
        &self,
        args: &BenchArgs,
        columns: &[Column],
        mut each: impl FnMut(&Spot<'_>) -> Result<Vec<Vec<Cell>>, Failure>,
    ) -> Result<Table, Failure> {
        let (mut rows, mut device) = (Vec::new(), String::new());
        for path in scenes(args)? {
            let place = Place::open(&path, args)?;
            let (backend, cpu) = (bring(args, &place)?, OnceCell::new());
            device = backend.device();
            for eye in place.eyes() {
                for (size, depth) in self.shapes() {
                    let spot = Spot { args, place: &place, eye, backend: &*backend, cpu: &cpu, size, depth };
                    rows.extend(each(&spot)?.into_iter().map(|row| spot.row(row)));
                }
            }
            device::validation(&*backend);
        }
        let columns = PLACES.iter().chain(columns).copied().collect();
        Ok(Table { columns, rows, settings: settings(args, &device) })
    }

    fn shapes(&self) -> impl Iterator<Item = ([u32; 2], Option<u32>)> {
        self.sizes.iter().flat_map(|size| self.depths.iter().map(|depth| (*size, *depth)))
    }

    /// Frames for each number of samples.
    pub(super) fn frames(&self, args: &BenchArgs) -> Result<Table, Failure> {
        let plan = Plan::of(args);
        let table = self.walk(args, &FRAMES, |spot| {
            let view = spot.view(spot.settings())?;
            let row = |spp: &u32| {
                let figures = plan.run(spot.backend, &view, spot.size, *spp)?;
                spot.note(format_args!("{spp} a frame, {:.3} ms", figures.frame_ms));
                let length = match figures.path_length {
                    Some(length) => length,
                    None => measure::path_length(spot.cpu()?, &view, spot.size),
                };
                Ok(frame_row(*spp, length, &figures))
            };
            self.samples.iter().map(row).collect()
        })?;
        Ok(table.with("frames", format!("median of up to {} after {}", args.frames, args.warm_up)))
    }
}

const PLACES: [Column; 4] = [("scene", "scene"), ("camera", "camera"), ("size", "size"), ("depth", "depth")];

const FRAMES: [Column; 7] = [
    ("spp", "samples a frame"),
    ("fps", "fps"),
    ("frame_ms", "ms a frame"),
    ("mrays_per_second", "Mrays/s"),
    ("path_length", "path length"),
    ("frames", "frames"),
    ("gpu_ms", "GPU ms"),
];

fn frame_row(spp: u32, length: f64, f: &Figures) -> Vec<Cell> {
    vec![
        Cell::Whole(spp.into()),
        Cell::Number(f.fps),
        Cell::Number(f.frame_ms),
        Cell::Number(f.mrays_per_second),
        Cell::Number(length),
        Cell::Whole(f.frames as u64),
        Cell::Passes(f.passes.clone()),
    ]
}

/// One picture of a table.
pub(super) struct Spot<'a> {
    args: &'a BenchArgs,
    place: &'a Place,
    eye: Eye<'a>,
    pub(super) backend: &'a dyn Backend,
    /// Made when it is asked for.
    cpu: &'a OnceCell<CpuBackend>,
    pub(super) size: [u32; 2],
    depth: Option<u32>,
}

impl Spot<'_> {
    /// The settings of the flags at this depth.
    pub(super) fn settings(&self) -> RenderSettings {
        RenderSettings { max_depth: self.depth, ..self.args.settings() }
    }

    /// What the camera sees.
    pub(super) fn view(&self, settings: RenderSettings) -> Result<View, Failure> {
        self.eye.view(self.size, settings)
    }

    /// The scene on the CPU.
    pub(super) fn cpu(&self) -> Result<&CpuBackend, Failure> {
        if let Some(cpu) = self.cpu.get() {
            return Ok(cpu);
        }
        let made = lumbre::prepare_cpu(self.place.compiled.clone())?;
        Ok(self.cpu.get_or_init(|| made))
    }

    /// A line on the way.
    pub(super) fn note(&self, what: impl std::fmt::Display) {
        let ([width, height], depth) = (self.size, Depth(self.depth));
        let (scene, camera) = (&self.place.name, self.eye.name);
        console::note(format_args!("{scene} {camera}, {width}x{height}, depth {depth}: {what}"));
    }

    fn row(&self, figures: Vec<Cell>) -> Vec<Cell> {
        let [width, height] = self.size;
        let depth = self.depth.map_or_else(|| Cell::Text(Depth(None).to_string()), |d| Cell::Whole(d.into()));
        let names = [self.place.name.clone(), self.eye.name.to_owned(), format!("{width}x{height}")];
        names.map(Cell::Text).into_iter().chain([depth]).chain(figures).collect()
    }
}
