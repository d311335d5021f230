//! What can be said on the command line: one file per group of flags, each with its help.

pub(crate) mod bench;
pub(crate) mod camera;
pub(crate) mod compare;
pub(crate) mod device;
pub(crate) mod devices;
pub(crate) mod generate;
pub(crate) mod info;
pub(crate) mod light;
pub(crate) mod loading;
pub(crate) mod merge;
pub(crate) mod mode;
pub(crate) mod output;
pub(crate) mod render;
pub(crate) mod replay;
pub(crate) mod run;
pub(crate) mod sampling;
pub(crate) mod targets;
pub(crate) mod values;
#[cfg(feature = "viewer")]
pub(crate) mod view;

use clap::{Parser, Subcommand};

/// A physically based renderer: opens glTF 2.0 and OBJ scenes and traces the light through them.
#[derive(Debug, Parser)]
#[command(name = "lumbre", version, arg_required_else_help = true)]
#[command(max_term_width = 110, after_help = EXAMPLES)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXAMPLES: &str = "\
Examples:
  lumbre render scene.glb
      until the picture is good, into scene.png
  lumbre render scene.gltf -o picture.exr --spp 256 --sky gradient --sun 50,120
  lumbre view scene.glb
  lumbre info scene.glb
  lumbre compare reference.exr picture.exr
  lumbre merge picture.exr part-1.exr part-2.exr

`lumbre COMMAND --help` says more.";

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render a scene to a picture.
    #[command(after_help = render::EXAMPLES)]
    Render(Box<render::RenderArgs>),
    /// Look at a scene in a window, walk through it and change it.
    #[cfg(feature = "viewer")]
    #[command(after_help = view::EXAMPLES)]
    View(Box<view::ViewArgs>),
    /// Say what a scene holds, what it takes, and why its picture might be black.
    #[command(after_help = info::EXAMPLES)]
    Info(Box<info::InfoArgs>),
    /// Measure how much a picture differs from a reference.
    #[command(after_help = compare::EXAMPLES)]
    Compare(compare::CompareArgs),
    /// Add parts of one render, made apart, to the picture of one run.
    #[command(after_help = merge::EXAMPLES)]
    Merge(Box<merge::MergeArgs>),
    /// List what can render here: the CPU, and every GPU that Vulkan finds, with what it lacks.
    #[command(after_help = devices::EXAMPLES)]
    Devices(devices::DevicesArgs),
    /// Measure frames per second, rays per second and their like, as tables.
    #[command(after_help = bench::EXAMPLES)]
    Bench(Box<bench::BenchArgs>),
    /// Print what makes a shell complete the flags of this program.
    #[command(after_help = generate::COMPLETIONS_EXAMPLES)]
    Completions(generate::CompletionsArgs),
    /// Print the manual page, or write one for each command.
    #[command(after_help = generate::MAN_EXAMPLES)]
    Man(generate::ManArgs),
}
