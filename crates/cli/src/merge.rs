//! `lumbre merge`: parts of one render, made anywhere, to the picture of one run.

use crate::exit::{Code, Failure};
use crate::flags::merge::MergeArgs;
use crate::flags::output::{BACKGROUND, TRANSPARENT};
use crate::outputs::{Developed, Outputs, PartOf};
use crate::{console, memory};
use lumbre::core::film::state::WORDS;
use lumbre::edits::LookEdits;
use lumbre::merge::{Merge, MergeError, Part, Samples, read_part};
use std::path::Path;

/// Runs the command.
pub(crate) fn run(args: &MergeArgs) -> Result<Code, Failure> {
    let inputs: Vec<&Path> = args.parts.iter().map(|p| &**p).collect();
    let look = args.look.look(LookEdits::default());
    let outputs = Outputs::check(std::slice::from_ref(&args.output), &inputs, look, args.look.quality)?;
    if args.keep_sums && !outputs.has_exr() {
        return Err(Failure::usage("--keep-sums: exact sums go into an .exr, and the output is none"));
    }
    let part = added(args, &outputs)?;
    let Part { fingerprint, samples, film, mut metadata } = part;
    let (n, s) = (args.parts.len(), if args.parts.len() == 1 { "" } else { "s" });
    console::note(format_args!("merged {n} part{s}: {}", Samples(&samples)));
    if film.non_finite_count() > 0 {
        let count = film.non_finite_count();
        console::warning(format_args!("{count} samples were not finite and count as black"));
    }
    // A part that was stopped early, or is not the whole, says so; what they add up to is complete.
    metadata.retain(|(name, _)| name != "lumbre.interrupted" && name != "lumbre.spp");
    metadata.push(("lumbre.spp".into(), samples.len().to_string()));
    let background = format!("lumbre.{BACKGROUND}");
    let transparent = metadata.iter().any(|(name, value)| *name == background && value == TRANSPARENT);
    let part = args.keep_sums.then_some(PartOf { fingerprint, first_sample: samples.start });
    outputs.with_alpha(transparent).write(&Developed { film: &film, metadata: &metadata, part })?;
    Ok(Code::Done)
}

/// The sum of the parts.
fn added(args: &MergeArgs, outputs: &Outputs) -> Result<Part, Failure> {
    let limits = args.limits.limits();
    let mut merge = Merge::default();
    for (i, path) in args.parts.iter().enumerate() {
        let part = read_part(path, &limits)?;
        if i == 0 {
            // A film and a file to add to it, before more is read.
            let file = 4 * (16 + WORDS as u64);
            let output_per_pixel = outputs.bytes_per_pixel(args.keep_sums).max(file);
            let size = part.film.crop().size;
            memory::Picture { size, output_per_pixel, films: 2 }.check(None)?;
        }
        merge.add(path, part)?;
    }
    Ok(merge.finish()?)
}

impl From<MergeError> for Failure {
    fn from(e: MergeError) -> Self {
        match e {
            MergeError::Io(e) => e.into(),
            MergeError::NoSums { .. } => {
                let hint = "`lumbre render` writes them with --first-sample or --keep-sums";
                Failure::new(Code::BadData, format_args!("{e}; {hint}"))
            }
            other => Failure::new(Code::BadData, other),
        }
    }
}
