//! The device beside the CPU: what each makes of the same time, films read back.

use super::render;
use super::sweep::Sweep;
use super::table::{Cell, Column, Table};
use crate::device;
use crate::exit::{Code, Failure};
use crate::flags::bench::BenchArgs;
use lumbre::{Backend, Device, Outcome, Targets};

const COLUMNS: [Column; 5] = [
    ("device", "device"),
    ("seconds", "s"),
    ("spp", "samples per pixel"),
    ("error", "estimated relMSE"),
    ("times_less", "CPU's relMSE over it"),
];

pub(super) fn table(args: &BenchArgs) -> Result<Table, Failure> {
    let open = device::open(&args.device)?;
    // The CPU beside itself is a measure of the measure; but only where it is asked for.
    if !open.is_gpu() && args.device.device != Device::Cpu {
        let message = format!("equal-time: no GPU to be held beside the CPU ({})", open.why());
        return Err(Failure::new(Code::Unavailable, message));
    }
    drop(open);
    let targets = Targets::time(args.time);
    Sweep::of(args).walk(args, &COLUMNS, |spot| {
        let view = spot.view(spot.settings())?;
        let cpu = spot.cpu()?;
        let first = render(spot.backend, &view, spot.size, targets)?;
        let second = render(cpu, &view, spot.size, targets)?;
        spot.note(format_args!("{} and {} samples per pixel", first.spp, second.spp));
        let beside = [(spot.backend.device(), &first), (Backend::device(cpu), &second)];
        Ok(beside.map(|(device, outcome)| row(device, outcome, &second)).into())
    })
}

fn row(device: String, o: &Outcome, cpu: &Outcome) -> Vec<Cell> {
    let less = cpu.error.zip(o.error).filter(|(_, own)| *own > 0.0).map(|(cpu, own)| cpu / own);
    let spp = Cell::Whole(o.spp.into());
    vec![Cell::Text(device), Cell::Number(o.seconds), spp, o.error.into(), less.into()]
}
