//! Measuring frames: how many, which of their times count, and what they say.

use crate::flags::bench::BenchArgs;
use lumbre::core::settings::View;
use lumbre::cpu::CpuBackend;
use lumbre::cpu::observer::{PathEvent, PathObserver};
use lumbre::{Backend, Frames, RenderError};
use std::time::{Duration, Instant};

/// How to measure.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    /// Frames that count.
    pub(super) frames: u32,
    /// Frames before them.
    pub(super) warm_up: u32,
    /// Most time for those that count.
    pub(super) budget: Duration,
}

/// What frames took.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Figures {
    /// Frames that counted.
    pub(super) frames: usize,
    /// Frames over the time of all of them.
    pub(super) fps: f64,
    /// Median milliseconds of a frame.
    pub(super) frame_ms: f64,
    pub(super) mrays_per_second: f64,
    /// Rays of a path, where the device counts them.
    pub(super) path_length: Option<f64>,
    /// Milliseconds of each pass in a frame, in the mean; empty without a clock of the device.
    pub(super) passes: Vec<(&'static str, f64)>,
}

/// Frames before this time do not count either.
const CLOCK_RISES: Duration = Duration::from_millis(700);

impl Plan {
    /// As the flags say.
    pub(super) fn of(args: &BenchArgs) -> Self {
        Plan { frames: args.frames, warm_up: args.warm_up, budget: args.budget }
    }

    /// Draws frames of paths.
    pub(super) fn run(
        &self,
        backend: &dyn Backend,
        view: &View,
        size: [u32; 2],
        spp: u32,
    ) -> Result<Figures, RenderError> {
        self.run_by(|count| backend.frames(view, size, spp, count))
    }

    /// The same for frames that `draw` draws, so many of them.
    pub(super) fn run_by(
        &self,
        mut draw: impl FnMut(u32) -> Result<Frames, RenderError>,
    ) -> Result<Figures, RenderError> {
        let began = Instant::now();
        let mut warm = draw(self.warm_up)?;
        // An idle GPU's clock is a fifth of what it rises to within half a second.
        while began.elapsed() < CLOCK_RISES.min(self.budget) {
            warm = draw(self.warm_up)?;
        }
        Ok(Figures::of(&draw(self.count(&warm))?))
    }

    /// As many frames as are wanted and fit into the time, by the last one before them.
    fn count(&self, warm: &Frames) -> u32 {
        let one = warm.seconds.last().copied().unwrap_or(0.0).max(1e-9);
        // `as` saturates.
        ((self.budget.as_secs_f64() / one) as u32).clamp(1, self.frames)
    }
}

impl Figures {
    fn of(frames: &Frames) -> Self {
        let count = frames.seconds.len();
        let seconds = frames.seconds.iter().sum::<f64>().max(1e-12);
        let per_frame = |total: f64| total / count.max(1) as f64;
        let samples = frames.progress.samples.max(1) as f64;
        Figures {
            frames: count,
            fps: count as f64 / seconds,
            frame_ms: 1e3 * median(&frames.seconds),
            mrays_per_second: frames.progress.rays as f64 / seconds * 1e-6,
            path_length: frames.path_rays.map(|rays| rays as f64 / samples),
            passes: frames.passes.iter().map(|p| (p.name, per_frame(p.total_ms))).collect(),
        }
    }
}

/// The middle one, or the mean of the middle two; 0 of none.
pub(super) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => 0.0,
        n if n % 2 == 1 => sorted[n / 2],
        n => 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]),
    }
}

/// Columns and rows of the pixels whose paths are followed.
const GRID: [u32; 2] = [64, 36];

/// The mean number of rays of a path, followed by the CPU at pixels spread over the picture: on any device paths are the same.
pub(super) fn path_length(cpu: &CpuBackend, view: &View, size: [u32; 2]) -> f64 {
    let grid = [0, 1].map(|i| GRID[i].min(size[i]));
    let mut counter = PathRays(0);
    for i in 0..grid[0] * grid[1] {
        let cell = [i % grid[0], i / grid[0]];
        // The middle of the cell; in 64 bits, since a picture may have 2^30 pixels.
        let at = |axis: usize| {
            let (cell, size, grid) = (u64::from(cell[axis]), u64::from(size[axis]), u64::from(grid[axis]));
            ((2 * cell + 1) * size / (2 * grid)) as u32
        };
        cpu.replay(view, size, [at(0), at(1)], i, &mut counter);
    }
    counter.0 as f64 / f64::from(grid[0] * grid[1])
}

/// Counts the rays that go on a path, without those that ask for lights.
struct PathRays(u64);

impl PathObserver for PathRays {
    fn event(&mut self, event: PathEvent<'_>) {
        if let PathEvent::Hit { .. } | PathEvent::Miss { .. } | PathEvent::Caught { .. } = event {
            self.0 += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre::PassTime;
    use lumbre::core::Camera;
    use lumbre::core::Rgb;
    use lumbre::core::control::Progress;
    use lumbre::core::math::Vec3;
    use lumbre::core::settings::RenderSettings;
    use lumbre::scene::{Background, Material, Mesh, Node, Primitive, Scene};

    #[test]
    fn medians_are_in_the_middle() {
        assert_eq!(median(&[]), 0.0);
        assert_eq!(median(&[3.0, 1.0, 100.0]), 3.0);
        assert_eq!(median(&[4.0, 1.0, 100.0, 2.0]), 3.0);
    }

    #[test]
    fn figures_come_from_all_frames() {
        let frames = Frames {
            seconds: vec![0.01, 0.02, 0.09],
            progress: Progress { samples: 100, rays: 600 },
            path_rays: Some(250),
            passes: vec![PassTime { name: "trace", count: 6, total_ms: 90.0 }],
        };
        let f = Figures::of(&frames);
        assert_eq!((f.frames, f.path_length, f.passes.clone()), (3, Some(2.5), vec![("trace", 30.0)]));
        assert!((f.fps - 25.0).abs() < 1e-9 && (f.frame_ms - 20.0).abs() < 1e-9);
        assert!((f.mrays_per_second - 0.005).abs() < 1e-12);
    }

    #[test]
    fn the_budget_bounds_the_frames() {
        let plan = Plan { frames: 60, warm_up: 2, budget: Duration::from_secs(1) };
        let count = |seconds: &[f64]| plan.count(&Frames { seconds: seconds.into(), ..Frames::default() });
        assert_eq!((count(&[5.0, 0.1]), count(&[0.001]), count(&[7.0]), count(&[0.0])), (10, 60, 1, 60));
    }

    /// In an empty scene each path is one ray; inside of a white box, one for each event and one more.
    #[test]
    fn paths_are_as_long_as_they_are() {
        let mut scene = Scene::default();
        scene.environment.background = Background::Gradient;
        let camera = Camera::look_at(Vec3::ZERO, Vec3::Z, Vec3::Y, 1.0, 1.5);
        let view = |depth: u32| {
            let settings =
                RenderSettings { max_depth: Some(depth), roulette: None, ..RenderSettings::default() };
            View { camera, settings, frame: 0 }
        };
        let cpu = |scene: &Scene| lumbre::prepare_cpu(lumbre::compile(scene).unwrap().scene).unwrap();
        let empty = cpu(&scene);
        for size in [[3, 2], [1000, 700], [32_768, 32_768]] {
            assert_eq!(path_length(&empty, &view(5), size), 1.0);
        }
        // A tetrahedron around the eye, open to both sides.
        let white = Material { double_sided: true, ..Material::diffuse(Rgb::WHITE) };
        let material = Some(scene.add_material(white));
        let positions = [[3.0, 3.0, 3.0], [3.0, -3.0, -3.0], [-3.0, 3.0, -3.0], [-3.0, -3.0, 3.0]];
        let positions: Vec<Vec3> = positions.map(Vec3::from).into();
        let indices = vec![0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2];
        let walls = Primitive { positions, indices, material, ..Primitive::default() };
        let mesh = Some(scene.add_mesh(Mesh { name: "walls".into(), primitives: vec![walls] }));
        scene.add_root(Node { mesh, ..Node::default() });
        let closed = cpu(&scene);
        for depth in [0, 1, 7] {
            assert_eq!(path_length(&closed, &view(depth), [40, 30]), f64::from(depth + 1), "{depth}");
        }
    }
}
