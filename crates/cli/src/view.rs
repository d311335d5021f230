//! `lumbre view`: the interactive window.

use crate::device;
use crate::exit::{Code, Failure};
use crate::flags::values::Size;
use crate::flags::view::ViewArgs;
use lumbre::edits::Edits;
use lumbre_viewer::{Options, Report, ViewError};
use std::path::Path;

/// Runs the command.
pub(crate) fn run(args: &ViewArgs) -> Result<Code, Failure> {
    // What can be known to fail is told here, where it was asked for; all else is told in the window.
    args.scene.as_deref().map_or(Ok(()), is_there)?;
    if let Some(edits) = &args.loading.edits {
        if args.scene.is_none() {
            return Err(Failure::usage("--edits: of which scene?"));
        }
        Edits::read(edits)?;
    }
    device::common_pool(&args.device)?;
    let report = args.report.as_deref().map(report).transpose()?;
    lumbre_viewer::run(Options {
        scene: args.scene.clone(),
        load: args.loading.options(),
        edits: args.loading.edits.clone(),
        device: args.device.device.clone(),
        gpu: args.device.options(),
        watch: args.watch,
        report,
        size: args.size.map(|Size(size)| size.map(|n| n as f32)),
    })?;
    Ok(Code::Done)
}

fn report(path: &Path) -> Result<Report, Failure> {
    let file = std::fs::File::create(path);
    let file = file.map_err(|e| Failure::new(Code::CannotWrite, format!("{}: {e}", path.display())))?;
    Ok(Report::new(Box::new(file)))
}

fn is_there(scene: &Path) -> Result<(), Failure> {
    let found = std::fs::metadata(scene);
    found.map(|_| ()).map_err(|e| Failure::new(Code::CannotOpen, format!("{}: {e}", scene.display())))
}

impl From<ViewError> for Failure {
    fn from(e: ViewError) -> Self {
        Self::new(Code::Unavailable, e)
    }
}
