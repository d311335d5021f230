//! All flags of `lumbre render`.

use super::camera::CameraArgs;
use super::light::LightArgs;
use super::loading::LoadingArgs;
use super::mode::{HybridArgs, Mode};
use super::output::OutputArgs;
use super::replay::ReplayArgs;
use super::run::RunArgs;
use super::sampling::SamplingArgs;
use super::targets::TargetArgs;
use clap::Args;
use lumbre::core::settings::RenderSettings;
use lumbre::edits::LookEdits;
use lumbre::output::Look;
use std::path::PathBuf;

/// Shown below the flags.
pub(crate) const EXAMPLES: &str = "\
Examples:
  lumbre render scene.glb
      with the scene's own camera and lights until the picture is good, into scene.png
  lumbre render scene.glb -o picture.png --time 1min --save-every 10s
      as good as it gets in a minute, with a look at it now and then
  lumbre render scene.glb -o picture.png --target-error 0.001 --spp 4096
      very clean, but at most 4096 samples per pixel
  lumbre render scene.glb -o picture.png -o picture.exr --size 1920x1080 --spp 512
      a PNG to look at, and an EXR with linear radiance, albedo, normal, position, depth and error
  lumbre render scene.glb -o sunny.png --sky gradient --sun 55,130 --exposure -1
      a clear day, one stop darker
  lumbre render scene.glb -o lit.png --env studio.hdr --env-rotate 90
      lit by a photograph
  lumbre render scene.glb -o view.png --look-from -3,1.6,4 --look-at 0,1,0 --fov 35
      from elsewhere
  lumbre render scene.glb -o frame.png --mode hybrid
      as a game would draw it: rasterised, with rays for shadows, reflections and light between surfaces
  lumbre render scene.glb -o walk.png --mode hybrid --camera-path walk.txt --frames 120
      a walk, into walk-0001.png to walk-0120.png
  lumbre render scene.glb --edits scene.edits.json
      as it was left in the viewer; flags stand above what the file says
  lumbre render scene.glb --device gpu
      on the best GPU, or an error; without the flag on the CPU where there is none
  lumbre render scene.glb --pixel 310,204 --sample 7
      one path, vertex by vertex, instead of a picture

Exit codes:
  0 done, 2 wrong usage, 65 bad data in a file, 66 a file cannot be opened, 69 the GPU that was
  asked for cannot be had or failed (the picture so far is written), 70 a bug, 71 too little memory,
  74 cannot write, 75 interrupted with the picture so far written,
  130 interrupted with nothing written";

/// Flags of `lumbre render`.
#[derive(Args, Debug)]
pub(crate) struct RenderArgs {
    /// Scene to open: glTF 2.0 (.gltf, .glb), Wavefront OBJ (.obj), PLY (.ply) or STL (.stl).
    #[arg(value_name = "SCENE")]
    pub(crate) scene: PathBuf,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    /// How the picture is drawn.
    #[arg(long, value_name = "MODE", default_value = "path")]
    pub(crate) mode: Mode,
    /// Moves the camera along a way, a line for each place: eye X,Y,Z, what it looks at X,Y,Z, degrees of view if they change. --frames
    /// pictures are written, numbered: NAME-0001.png and so on.
    #[arg(long, value_name = "FILE")]
    pub(crate) camera_path: Option<PathBuf>,
    /// With --camera-path: pictures on the way [default: 60]. Else of a hybrid picture: frames before it is written, over which light and edges
    /// are gathered [default: 32, or 1 where nothing is].
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(crate) frames: Option<u32>,
    #[command(flatten)]
    pub(crate) hybrid: HybridArgs,
    #[command(flatten)]
    pub(crate) targets: TargetArgs,
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    #[command(flatten)]
    pub(crate) camera: CameraArgs,
    #[command(flatten)]
    pub(crate) light: LightArgs,
    #[command(flatten)]
    pub(crate) run: RunArgs,
    #[command(flatten)]
    pub(crate) replay: ReplayArgs,
    #[command(flatten)]
    pub(crate) loading: LoadingArgs,
}

impl RenderArgs {
    /// What the integrator honours.
    pub(crate) fn settings(&self) -> RenderSettings {
        let base = self.loading.edited.settings(RenderSettings::default());
        self.output.settings(self.sampling.settings(base))
    }

    /// How the film is developed.
    pub(crate) fn look(&self) -> LookEdits {
        let look = self.output.look.look(self.loading.edited.look(LookEdits::default()));
        LookEdits { look: Look { transparent: self.settings().transparent_background, ..look.look }, ..look }
    }
}
