//! Flags of `lumbre bench`.

use super::device::DeviceArgs;
use super::light::LightArgs;
use super::loading::LoadingArgs;
use super::sampling::SamplingArgs;
use super::values::{Depth, Size, depth, duration, fov, size, vec3};
use clap::{Args, ValueEnum};
use lumbre::core::math::Vec3;
use lumbre::core::settings::RenderSettings;
use std::path::PathBuf;
use std::time::Duration;

/// Shown below the flags.
pub(crate) const EXAMPLES: &str = "\
A frame adds samples to sums that stay on the device; nothing is read back but counters. So
frames per second are those of a program that only draws. Figures are medians over --frames
frames after --warm-up frames that do not count, or over as many as fit into --budget. Path
length is the mean number of rays of a path, that of the camera too, without shadow rays.
`share` traces the rays of a frame again by themselves, in the same launches: what is left of
the frame goes to shading and to waiting.
Times of two runs are only comparable on the same quiet machine.

Examples:
  lumbre bench path
      the pool's cameras (and Sponza, where it is found), 1280x720 and 1920x1080, depth 4 to 10
  lumbre bench path scene.glb --camera hall --device gpu --markdown
  lumbre bench depth scene.glb --depths 1,10,50 --roulette off
  lumbre bench equal-time --time 30s --json
      this device beside the CPU, each for half a minute
  lumbre bench build --triangles 20000,1000000
  lumbre bench first-frame scene.glb
  lumbre bench view scene.glb --sizes 1280x720 --device cpu

Exit codes:
  0 done, 2 wrong usage, 65 bad data, 66 a file cannot be opened, 69 the GPU cannot be had or
  failed, 74 cannot write";

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Table {
    /// Frames per second at each size and depth (1280x720, 1920x1080; 4, 6, 8, 10)
    Path,
    /// Time of a frame over samples per frame (1 to 20)
    Samples,
    /// Time of a frame over depth (1 to 50)
    Depth,
    /// Time of a frame over size (720, 1080 and 1440 rows)
    Size,
    /// Uniform against cosine-weighted diffuse directions: time and noise
    Hemisphere,
    /// A whole picture of --spp samples per pixel, films read back
    Still,
    /// Share of a GPU's frame that its rays take by themselves, nothing shaded (1280x720; 4, 10)
    Share,
    /// Hybrid frames per second at each size and depth (1280x720, 1920x1080; 4, 6, 8, 10)
    Hybrid,
    /// The device beside the CPU, each for --time
    EqualTime,
    /// Time to build acceleration structures, and their bytes: of a grid of --triangles, or of scenes
    Build,
    /// Time from the start of the process to the first frame of a scene, step by step
    FirstFrame,
    /// How soon a view answers, without a window: to moves of the camera, and to edits for --time
    View,
}

/// Flags of `lumbre bench`.
#[derive(Args, Debug)]
pub(crate) struct BenchArgs {
    /// What to measure.
    #[arg(value_name = "TABLE")]
    pub(crate) table: Table,

    /// Scenes, as for `lumbre render`. [default: assets/scenes/pool.glb, and Sponza beneath $LUMBRE_SCENES or ../shared/scenes]
    #[arg(value_name = "SCENE")]
    pub(crate) scenes: Vec<PathBuf>,

    /// Camera of the scenes, by name. May be given several times. [default: each camera; the whole scene in view where there is
    /// none]
    #[arg(long, value_name = "NAME")]
    pub(crate) camera: Vec<String>,

    /// Puts the eye here, metres.
    #[arg(long, value_name = "X,Y,Z", value_parser = vec3, allow_hyphen_values = true)]
    pub(crate) look_from: Option<Vec3>,

    /// Turns the camera to this point, metres.
    #[arg(long, value_name = "X,Y,Z", value_parser = vec3, allow_hyphen_values = true)]
    pub(crate) look_at: Option<Vec3>,

    /// Vertical field of view, degrees.
    #[arg(long, value_name = "DEG", value_parser = fov, allow_hyphen_values = true)]
    pub(crate) fov: Option<f32>,

    /// Sizes of the picture. [default: those of the table, else 1280x720]
    #[arg(long, value_name = "WxH,...", value_parser = size, value_delimiter = ',')]
    pub(crate) sizes: Option<Vec<Size>>,

    /// Depths, each the most scattering events on a path. [default: those of the table, else --max-depth]
    #[arg(long, value_name = "N,...", value_parser = depth, value_delimiter = ',')]
    pub(crate) depths: Option<Vec<Depth>>,

    /// Samples of each pixel in a frame. [default: those of the table, else 1]
    #[arg(long, value_name = "N,...", value_delimiter = ',')]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(crate) samples: Option<Vec<u32>>,

    /// Frames that count.
    #[arg(long, value_name = "N", default_value_t = 60)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) frames: u32,

    /// Frames before them; frames of the first 0.7 s do not count in any case.
    #[arg(long, value_name = "N", default_value_t = 3)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) warm_up: u32,

    /// Most time for the frames of one figure; one frame is always taken.
    #[arg(long, value_name = "TIME", value_parser = duration, default_value = "10s")]
    pub(crate) budget: Duration,

    /// Samples per pixel of `still` and of the noise of `hemisphere`. [default: 1000, 64]
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=1 << 24))]
    pub(crate) spp: Option<u32>,

    /// Triangles of the grids of `build`, at least.
    #[arg(long, value_name = "N,...", value_delimiter = ',', default_value = "1000000")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1 << 26))]
    pub(crate) triangles: Vec<u32>,

    /// Time for each device in `equal-time`, and of the edits of `view`.
    #[arg(long, value_name = "TIME", value_parser = duration, default_value = "10s")]
    pub(crate) time: Duration,

    /// Prints the table as Markdown.
    #[arg(long)]
    pub(crate) markdown: bool,

    /// Prints one JSON object; times in seconds or, where the key says so, milliseconds.
    #[arg(long, conflicts_with = "markdown")]
    pub(crate) json: bool,

    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    #[command(flatten)]
    pub(crate) light: LightArgs,
    #[command(flatten)]
    pub(crate) device: DeviceArgs,
    // Last, since its heading holds for all that follows.
    #[command(flatten)]
    pub(crate) loading: LoadingArgs,
}

impl BenchArgs {
    /// What the integrator honours.
    pub(crate) fn settings(&self) -> RenderSettings {
        self.sampling.settings(self.loading.edited.settings(RenderSettings::default()))
    }
}
