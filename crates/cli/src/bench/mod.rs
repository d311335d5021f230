//! `lumbre bench`: tables of what a device does. One file a table; [`measure`] takes the figures, [`sweep`] varies one thing after
//! another, [`table`] prints.

mod build;
mod depth;
mod equal_time;
mod first_frame;
mod hemisphere;
mod hybrid;
mod measure;
mod path;
mod place;
mod samples;
mod share;
mod size;
mod still;
mod sweep;
mod table;
mod view;

use crate::exit::{Code, Failure};
use crate::flags::bench::{BenchArgs, Table as Which};
use crate::flags::sampling;
use crate::{console, device};
use lumbre::core::Film;
use lumbre::core::settings::View;
use lumbre::{Backend, Outcome, Targets};
use place::Place;
use std::time::Instant;

/// Runs the command. `started`: when the process began.
pub(crate) fn run(args: &mut BenchArgs, started: Instant) -> Result<Code, Failure> {
    args.loading.read_edits()?;
    let args = &*args;
    if args.table == Which::View {
        // As in the window, where nobody says which threads.
        device::common_pool(&args.device)?;
    }
    // An unavailable device is said before a scene is opened; but opening it belongs to the first frame.
    if args.table != Which::FirstFrame {
        drop(device::open(&args.device)?);
    }
    let table = device::pool(&args.device)?.install(|| match args.table {
        Which::Path => path::table(args),
        Which::Samples => samples::table(args),
        Which::Depth => depth::table(args),
        Which::Size => size::table(args),
        Which::Hemisphere => hemisphere::table(args),
        Which::Still => still::table(args),
        Which::Share => share::table(args),
        Which::Hybrid => hybrid::table(args),
        Which::EqualTime => equal_time::table(args),
        Which::Build => build::table(args),
        Which::FirstFrame => first_frame::table(args, started),
        Which::View => view::table(args),
    })?;
    console::result(match (args.json, args.markdown) {
        (true, _) => table.json(),
        (_, true) => table.markdown(),
        _ => table.plain(),
    })?;
    Ok(Code::Done)
}

/// How the paths of a table are made, for those who read it.
fn settings(args: &BenchArgs, device: &str) -> Vec<(&'static str, String)> {
    let all = sampling::described(&args.settings());
    let own = |name: &str| all.iter().find(|(n, _)| *n == name).map(|(_, v)| v.clone());
    let mut lines = vec![("device", device.to_owned())];
    let roulette = own("roulette").unwrap_or_default();
    let roulette = if roulette == "off" { roulette } else { format!("from event {roulette}") };
    lines.push(("roulette", roulette));
    for (name, key) in [("sampler", "sampler"), ("filter", "filter"), ("light sampling", "lightSampling")] {
        lines.extend(own(key).map(|value| (name, value)));
    }
    lines
}

/// Brings a place to the device, and to no other if that fails: figures are of one device.
fn bring(args: &BenchArgs, place: &Place) -> Result<Box<dyn Backend>, Failure> {
    device::prepare(device::open(&args.device)?.alone(), place.compiled.clone())
}

/// A whole picture until the targets are met, its film read back after each pass. What a device does once for the settings is done
/// before.
fn render(backend: &dyn Backend, view: &View, size: [u32; 2], targets: Targets) -> Result<Outcome, Failure> {
    backend.warm_up(view)?;
    let mut film = Film::new(size[0], size[1]);
    lumbre::render(backend, view, targets, &mut film, &()).map_err(|failed| failed.error.into())
}
