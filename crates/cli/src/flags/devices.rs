//! Flags of `lumbre devices`.

use clap::Args;

/// Shown below the flags.
pub(crate) const EXAMPLES: &str = "\
A GPU draws by Vulkan's ray tracing pipelines; what it lacks for that is listed with it. The
line with * is what `--device auto` takes.

Examples:
  lumbre devices
  lumbre devices --json | jq '.devices[] | select(.lacks == []) | .name'
      for programs
  lumbre render scene.glb --device gpu:1
      on the second GPU, or an error (exit code 69)

Exit codes:
  0 done (whatever is found), 2 wrong usage, 74 cannot write";

/// Flags of `lumbre devices`.
#[derive(Args, Debug)]
pub(crate) struct DevicesArgs {
    /// Prints one JSON object; memory in bytes.
    #[arg(long)]
    pub(crate) json: bool,
}
