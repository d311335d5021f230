//! `lumbre render`: from flags to a picture, or to one path.

mod frame;
mod job;
mod naming;
mod outputs;
mod replay;
mod report;
mod saving;
mod scene;
#[cfg(test)]
mod tests;

use crate::device;
use crate::exit::{Code, Failure};
use crate::flags::mode::Mode;
use crate::flags::render::RenderArgs;
use crate::flags::values::Size;
use crate::interrupt;
use crate::memory::Picture;
use crate::outputs::Outputs;
use job::{Job, Prepared};
use lumbre::core::film::Crop;
use lumbre::cpu::CpuOptions;
use lumbre::fingerprint::SceneHash;
use lumbre::prelude::*;
use scene::Opened;
use std::time::Instant;

/// Runs the command.
pub(crate) fn run(args: &mut RenderArgs) -> Result<Code, Failure> {
    let began = Instant::now();
    args.loading.read_edits()?;
    // Whatever can be known to fail is found before the work begins.
    let device = match args.replay.pixel {
        Some(_) => Device::Cpu.open(&args.run.device.options())?,
        None => device::open(&args.run.device)?,
    };
    if args.replay.pixel.is_none() && args.output.output.is_empty() {
        args.output.output.push(naming::default_output(&args.scene));
    }
    let args = &*args;
    let outputs = if args.replay.pixel.is_some() { Outputs::default() } else { outputs::check(args)? };
    let camera = args.camera.options(&args.loading.edited)?;
    let way = frame::camera_path(args)?;
    if let Some(Size(size)) = args.output.size {
        picture(args, &outputs, args.camera.part(size)?).check(args.run.memory_limit)?;
    }
    let cancel = interrupt::install()?;
    device::pool(&args.run.device)?.install(|| {
        let Opened { compiled, camera: eye, size, sky_added, load_seconds } = scene::open(args, &camera)?;
        let part = args.camera.part(size)?;
        let scene_bytes = compiled.bytes();
        picture(args, &outputs, part).check_with(&compiled, device.is_gpu(), args.run.memory_limit)?;
        let view = View { camera: eye, settings: args.settings(), frame: 0 };
        let scene = args.output.keeps_sums().then(|| SceneHash::new(&compiled));
        let mut job = Job { args, outputs, view, size, part, scene, sky_added, began };
        if let Some(pixel) = args.replay.pixel {
            let merge = args.loading.edits.is_none();
            let backend = lumbre::prepare_cpu_with(compiled, CpuOptions { merge })?;
            device::said(&backend, "--pixel always runs there");
            scene::focus(&camera, &backend, &mut job.view)?;
            return replay::run(&job, &backend, pixel);
        }
        let start = Instant::now();
        // As a viewer draws it, to the bit: meshes that are merged are rounded a little differently.
        let device = if args.loading.edits.is_some() { device.editable() } else { device };
        let device = if args.mode == Mode::Hybrid { device.alone() } else { device };
        let backend = device::prepare(device, compiled)?;
        let build_seconds = start.elapsed().as_secs_f64();
        scene::focus(&camera, &*backend, &mut job.view)?;
        let prepared = Prepared { backend: &*backend, load_seconds, build_seconds, scene_bytes };
        if let Some(way) = &way {
            return frame::walk(&job, &prepared, way, &cancel);
        }
        match args.mode {
            Mode::Path => job.picture(&prepared, &cancel),
            Mode::Hybrid => frame::still(&job, &prepared, &cancel),
        }
    })
}

/// What a picture of this size will take.
fn picture(args: &RenderArgs, outputs: &Outputs, part: Crop) -> Picture {
    let saved = args.targets.save_every.is_some();
    Picture {
        size: part.size,
        output_per_pixel: outputs.bytes_per_pixel(args.output.keeps_sums()),
        films: if saved { 2 } else { 1 },
    }
}
