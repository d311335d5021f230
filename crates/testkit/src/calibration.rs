//! Whether the estimated error of a picture is its error: predictions of [`lumbre::Estimator`] beside relMSE measured against the
//! mean of renders with other seeds.

use crate::ready::asset;
use lumbre::compare::{ImageView, rel_mse};
use lumbre::io::Limits;
use lumbre::prelude::*;
use lumbre::{LoadOptions, SoFar, Watch};
use lumbre_core::sampler::SamplerKind;
use lumbre_scene::Background;
use std::path::PathBuf;
use std::sync::Mutex;

/// Where a scene is found.
#[derive(Clone, Copy, Debug)]
pub enum Place {
    /// In `assets/scenes`.
    Ours,
    /// In the folder that `LUMBRE_SCENES` names, or `shared/scenes` next to the workspace.
    Shared,
}

/// A scene to be measured on.
#[derive(Clone, Copy, Debug)]
pub struct Subject {
    /// Short name.
    pub name: &'static str,
    /// Whose.
    pub place: Place,
    /// File in that place.
    pub file: &'static str,
    /// Environment map to light it, in the shared place.
    pub environment: Option<&'static str>,
}

impl Subject {
    const fn ours(name: &'static str, file: &'static str) -> Self {
        Subject { name, place: Place::Ours, file, environment: None }
    }
    const fn shared(name: &'static str, file: &'static str, environment: Option<&'static str>) -> Self {
        Subject { name, place: Place::Shared, file, environment }
    }
}

/// What is held to the factor that is promised: interreflection and caustics, dispersion, a scene of many materials out of doors,
/// a large hall under the sky, cloth in a studio.
pub const SUBJECTS: [Subject; 5] = [
    Subject::ours("cornell", "cornell.glb"),
    Subject::ours("prism", "prism.gltf"),
    Subject::ours("pool", "pool.glb"),
    Subject::shared("sponza", "sponza/glTF-512/Sponza.gltf", None),
    Subject::shared("cloth", "gltf-sample-assets/SheenCloth/glTF/SheenCloth.gltf", Some("hdri/studio.hdr")),
];

/// Smooth all over: scrambled Sobol points do better there than any estimate dares to say.
pub const SMOOTH: Subject = Subject::ours("smooth", "smooth.gltf");

/// A file of the shared scenes.
fn shared(file: &str) -> PathBuf {
    let named = std::env::var_os("LUMBRE_SCENES").map(PathBuf::from);
    named
        .unwrap_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/scenes"))
        .join(file)
}

impl Subject {
    fn path(&self) -> PathBuf {
        match self.place {
            Place::Ours => asset(self.file),
            Place::Shared => shared(self.file),
        }
    }

    /// Opens it as the command does: framed if it has no camera, under a gradient sky if it has no light. `None` if it is shared
    /// and not there.
    ///
    /// # Panics
    /// If it does not open or compile.
    pub fn open(&self, size: [u32; 2]) -> Option<(Box<dyn Backend>, View)> {
        let path = self.path();
        if matches!(self.place, Place::Shared) && !path.exists() {
            return None;
        }
        let mut scene =
            lumbre::load_scene(&path, &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}")).scene;
        if let Some(file) = self.environment {
            let map = lumbre::io::read_environment(shared(file), &Limits::default())
                .unwrap_or_else(|e| panic!("{e}"))
                .map;
            scene.environment.background = Background::Map(map);
        } else if !lumbre::light_kinds(&scene).any() {
            scene.environment.background = Background::Gradient;
        }
        let compiled = lumbre::compile(&scene).expect("the scene compiles").scene;
        let aspect = size[0] as f32 / size[1] as f32;
        let found =
            lumbre::find_camera(&scene, &compiled, &CameraOptions::default(), aspect).expect("a camera");
        let view = View { camera: found.camera, settings: RenderSettings::default(), frame: 0 };
        Some((lumbre::prepare(compiled, Device::Cpu).expect("a processor"), view))
    }
}

/// What to measure.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Columns and rows.
    pub size: [u32; 2],
    /// Random stream.
    pub sampler: SamplerKind,
    /// Renders, at least two, each with a seed of its own.
    pub seeds: u32,
    /// Samples per pixel at which to look, rising; at the last the renders end.
    pub counts: Vec<u32>,
    /// Index of the first sample of each pixel.
    pub first_sample: u32,
}

/// Means over the seeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Samples per pixel.
    pub spp: u32,
    /// What the estimator said.
    pub predicted: f64,
    /// What the spread of the samples alone says.
    pub by_spread: f64,
    /// relMSE against the mean of the other seeds' last pictures, less what that mean's own error adds.
    pub measured: f64,
}

impl Row {
    /// How far off a prediction is, in whichever direction: 1 is perfect.
    pub fn factor(&self, predicted: f64) -> f64 {
        let ratio = predicted / self.measured;
        ratio.max(1.0 / ratio)
    }
}

/// One picture on the way.
struct Shot {
    spp: u32,
    picture: Vec<Rgb>,
    predicted: f64,
    by_spread: f64,
}

/// Keeps the pictures at some counts.
struct Shots<'a>(&'a [u32], Mutex<Vec<Shot>>);

impl Control for Shots<'_> {}
impl Watch for Shots<'_> {
    fn passed(&self, film: &Film, so_far: &SoFar) {
        if self.0.contains(&so_far.spp) {
            self.1.lock().expect("one thread").push(Shot {
                spp: so_far.spp,
                picture: film.radiance(),
                predicted: so_far.error.unwrap_or(f64::NAN),
                by_spread: lumbre::estimate::from_spread(film).unwrap_or(f64::NAN),
            });
        }
    }
}

/// Renders and measures; `None` where the scene is not there.
///
/// # Panics
/// If the scene does not open, or a count is none at which a render looks at its picture.
pub fn measure(subject: &Subject, plan: &Plan) -> Option<Vec<Row>> {
    let (backend, mut view) = subject.open(plan.size)?;
    view.settings.sampler = plan.sampler;
    let last = *plan.counts.last().expect("a count");
    let renders: Vec<Vec<Shot>> = (1..=plan.seeds)
        .map(|seed| {
            view.settings.seed = seed;
            let mut film = Film::new(plan.size[0], plan.size[1]);
            let shots = Shots(&plan.counts, Mutex::default());
            // An error that is never reached: looks are then the same on fast machines and slow ones.
            let targets = Targets::error(f64::MIN_POSITIVE).or_spp(last).from_sample(plan.first_sample);
            lumbre::render(&*backend, &view, targets, &mut film, &shots).expect("the CPU does not fail");
            shots.1.into_inner().expect("one thread")
        })
        .collect();
    Some(rows(&renders, plan))
}

fn rows(renders: &[Vec<Shot>], plan: &Plan) -> Vec<Row> {
    let seeds = renders.len() as f64;
    // The mean over seeds of relMSE against the mean of the other seeds' last pictures.
    let raw = |i: usize| {
        let one = |s: usize| {
            let others = renders
                .iter()
                .enumerate()
                .filter(|(o, _)| *o != s)
                .map(|(_, r)| &r.last().expect("a shot").picture);
            let mut mean = vec![Rgb::BLACK; renders[s][i].picture.len()];
            for other in others {
                mean.iter_mut().zip(other).for_each(|(m, p)| *m += *p * (1.0 / (seeds as f32 - 1.0)));
            }
            let view = |pixels| {
                ImageView::new(plan.size[0] as usize, plan.size[1] as usize, pixels).expect("the size")
            };
            rel_mse(view(&mean), view(&renders[s][i].picture)).expect("finite").value
        };
        (0..renders.len()).map(one).sum::<f64>() / seeds
    };
    let shots = plan.counts.len();
    assert!(renders.iter().all(|r| r.len() == shots), "a count at which nobody looks");
    // Of the last pictures, raw is V (1 + 1 / (seeds - 1)).
    let reference = raw(shots - 1) / seeds;
    let mean = |i: usize, f: fn(&Shot) -> f64| renders.iter().map(|r| f(&r[i])).sum::<f64>() / seeds;
    (0..shots)
        .map(|i| Row {
            spp: renders[0][i].spp,
            predicted: mean(i, |s| s.predicted),
            by_spread: mean(i, |s| s.by_spread),
            measured: raw(i) - reference,
        })
        .collect()
}
