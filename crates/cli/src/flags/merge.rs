//! Flags of `lumbre merge`.

use super::loading::LimitArgs;
use super::output::LookArgs;
use clap::Args;
use std::path::PathBuf;

/// Shown below the flags.
pub(crate) const EXAMPLES: &str = "\
A part is an .exr by `lumbre render --first-sample N` or `--keep-sums`. All flags that decide
the picture must be the same for all parts, but --spp may differ; machines, threads and the
order of the parts do not matter (a GPU rounds in its own way: the last bits). The parts must follow on one another without gap or overlap.

Examples:
  lumbre render scene.glb --first-sample 0 --spp 256 -o a.exr
  lumbre render scene.glb --first-sample 256 --spp 256 -o b.exr
  lumbre merge picture.exr a.exr b.exr
      the same bytes as `lumbre render scene.glb --spp 512 -o picture.exr`
  lumbre merge picture.png a.exr b.exr --exposure 1 --tone agx
      to look at
  lumbre merge ab.exr a.exr b.exr --keep-sums
      a part again, of 512 samples

Exit codes:
  0 done, 2 wrong usage, 65 a part is damaged or does not fit the others, 66 cannot open,
  71 too little memory, 74 cannot write";

/// Flags of `lumbre merge`.
#[derive(Args, Debug)]
pub(crate) struct MergeArgs {
    /// File to write: .png, .jpg, .hdr or .exr; - is standard output.
    #[arg(value_name = "OUT", allow_hyphen_values = true)]
    pub(crate) output: PathBuf,

    /// Parts of one render, in any order.
    #[arg(value_name = "PARTS", required = true)]
    pub(crate) parts: Vec<PathBuf>,

    /// The .exr carries the exact sums, so that it can be merged again.
    #[arg(long)]
    pub(crate) keep_sums: bool,

    #[command(flatten)]
    pub(crate) look: LookArgs,

    // Last, since its heading holds for all that follows.
    #[command(flatten)]
    pub(crate) limits: LimitArgs,
}
