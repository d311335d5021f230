//! The files of a render: what `-o` and its kin ask for, and what is said in them.

use crate::exit::Failure;
use crate::flags::output::{BACKGROUND, TRANSPARENT};
use crate::flags::render::RenderArgs;
use crate::flags::run::ProgressFlag;
use crate::flags::sampling;
use crate::flags::values::{Sky, file_name};
use crate::outputs::Outputs;
use lumbre::io::STANDARD_OUTPUT;
use std::path::Path;

/// Checks whatever can be known before the render.
pub(super) fn check(args: &RenderArgs) -> Result<Outputs, Failure> {
    let inputs = [Some(&args.scene), args.light.env.as_ref(), args.loading.edits.as_ref()];
    let inputs: Vec<&Path> = inputs.into_iter().flatten().map(|p| &**p).collect();
    let quality = args.output.look.quality;
    let outputs = Outputs::check(&args.output.output, &inputs, args.look(), quality)?;
    if outputs.uses_stdout() && args.run.progress == ProgressFlag::Json {
        return Err(Failure::usage(format!(
            "--progress json and the picture cannot both go to {STANDARD_OUTPUT}"
        )));
    }
    if args.output.keep_sums && !outputs.has_exr() {
        return Err(Failure::usage("--keep-sums: exact sums go into an .exr, and no output is one"));
    }
    if args.output.first_sample.is_some() && !outputs.has_exr() {
        return Err(Failure::usage(
            "--first-sample: parts are merged from .exr files, and no output is one (-o part.exr)",
        ));
    }
    if args.targets.save_every.is_some() && !outputs.has_file() {
        return Err(Failure::usage("--save-every: standard output takes the finished picture only"));
    }
    Ok(outputs)
}

/// What made the picture. Nothing that differs from run to run, so that the same command writes the same bytes. Flags on camera
/// and light that were not given are left out: the scene decided. `sky_added`: that it had no light and got the gradient.
/// `interrupted` is the number of samples after which the render stopped too early.
pub(super) fn metadata(
    args: &RenderArgs,
    sky_added: bool,
    interrupted: Option<u64>,
) -> Vec<(String, String)> {
    let mut all = vec![("version", env!("CARGO_PKG_VERSION").into()), ("scene", file_name(&args.scene))];
    let settings = args.settings();
    all.extend(sampling::described(&settings));
    all.extend(args.loading.described());
    all.extend(args.camera.described());
    all.extend(args.light.described());
    if settings.transparent_background {
        all.push((BACKGROUND, TRANSPARENT.into()));
    }
    if sky_added {
        all.push(("sky", Sky::Gradient.to_string()));
    }
    if let Some(samples) = interrupted {
        all.push(("interrupted", format!("after {samples} camera samples")));
    }
    all.into_iter().map(|(name, value)| (format!("lumbre.{name}"), value)).collect()
}
