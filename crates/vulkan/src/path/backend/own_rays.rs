//! The path tracer's own rays, collected step by step, and how long the device takes to trace them with nothing else to do: what share of a
//! frame that is, says how near the path tracer is to the device's ceiling. The collecting shader: `glsl/replay/collect.comp`.

use super::{Extent, HeadsReadback, Shot, VulkanBackend, Work};
use crate::compute::ComputePipeline;
use crate::path::slices::Slice;
use crate::{Buffer, Commands, Purpose, Replay, Timer, VulkanError};
use lumbre_core::film::Film;
use lumbre_core::measure::Replayed;
use lumbre_core::settings::View;
use lumbre_shaders::replay::{self, CollectPush, ReplayHit, ReplayRay, collect, kind};
use lumbre_shaders::view::{Push, QueueHeads, queue};

/// Invocations of a work group that collects.
const GROUP: u32 = 64;

const ONE_STEP: Extent = Extent { begins: false, steps: 1, ends: false };

/// Rays of one launch.
#[derive(Clone, Debug, PartialEq)]
pub struct RayBatch {
    /// How often their paths have scattered before this step.
    pub step: u32,
    /// To lights; else those of paths.
    pub shadow: bool,
    /// In the order of the launch.
    pub rays: Vec<ReplayRay>,
    /// What they found, but for the distance, which is 0. Of shadow rays: negative where they brought light, else 0.
    pub found: Vec<ReplayHit>,
}

/// Rays of a frame of one sample a pixel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OwnRays {
    /// In the order of the launches.
    pub batches: Vec<RayBatch>,
    /// Rays of paths as the frame counted them.
    pub path_rays: u64,
    /// Shadow rays likewise.
    pub shadow_rays: u64,
    /// Shadow rays that were traced on from one surface that lets light through to the next. In `batches` they end at what stops light.
    pub through_glass: u64,
}

/// Where rays of a list lie on the device and on the host.
struct List {
    rays: [Buffer; 2],
    found: [Buffer; 2],
}

/// What collecting needs.
struct Collector {
    pipeline: ComputePipeline,
    /// Shadow rays to far lights and to near ones; rays of paths.
    lists: [List; 3],
    heads: HeadsReadback,
    timer: Timer,
    most: u32,
}

impl OwnRays {
    /// Rays in the batches, of paths or to lights.
    pub fn count(&self, shadow: bool) -> u64 {
        self.batches.iter().filter(|b| b.shadow == shadow).map(|b| b.rays.len() as u64).sum()
    }

    /// Launches of one kind, one after another.
    fn alone(&self, shadow: bool) -> Vec<Vec<&[ReplayRay]>> {
        self.batches.iter().filter(|b| b.shadow == shadow).map(|b| vec![&*b.rays]).collect()
    }

    /// As the path tracer launches them.
    fn together(&self) -> Vec<Vec<&[ReplayRay]>> {
        let steps = self.batches.iter().map(|b| b.step).max().map_or(0, |last| last + 2);
        let in_step = |step: u32| {
            let launched = move |b: &&RayBatch| b.step + u32::from(b.shadow) == step;
            self.batches.iter().filter(launched).map(|b| &*b.rays).collect()
        };
        (0..steps).map(in_step).collect()
    }
}

impl VulkanBackend {
    /// The rays of the first frame of a view, one sample a pixel.
    ///
    /// # Errors
    /// If the picture has more pixels than there is room for paths, memory is out, or the device is lost.
    pub fn own_rays(&self, view: &View, size: [u32; 2]) -> Result<OwnRays, VulkanError> {
        let mut work = self.lock();
        let target = self.own_film(&mut work, &Film::new(size[0], size[1]))?;
        let shot = self.shot(&mut work, view, &target, 1)?;
        let paths = work.paths.as_ref().expect("the shot made them");
        let (needed, limit) = (super::paths_per_sample(size), u64::from(paths.capacity()));
        if needed > limit {
            return Err(VulkanError::TooLarge { what: "paths".to_owned(), needed, limit });
        }
        let slice = Slice { first_pixel: [0, 0], size, samples: 0..1 };
        let push = shot.of(&slice);
        let collector = Collector::new(self, &shot, needed as u32)?;
        self.gpu.run("beginning paths", |commands| {
            let extent = Extent { begins: true, steps: 0, ends: false };
            shot.passes.record(commands, paths, &collector.timer, (&push, extent));
            Ok(())
        })?;
        let mut own = OwnRays::default();
        for step in 0.. {
            let push = Push { parity: step % 2, ..push };
            let heads = self.collect_step(&work, &shot, &collector, &push)?;
            own.add(step, &collector, &heads);
            if heads.at[(queue::PATHS + 1 - push.parity) as usize].count == 0 {
                break;
            }
        }
        Ok(own)
    }

    /// Takes a step of all paths and leaves its rays on the host.
    fn collect_step(
        &self,
        work: &Work,
        shot: &Shot,
        collector: &Collector,
        push: &Push,
    ) -> Result<QueueHeads, VulkanError> {
        let paths = work.paths.as_ref().expect("the shot made them");
        self.gpu.run("collecting rays", |commands| {
            collector.collect(commands, push, collect::PATHS);
            commands.barrier();
            shot.passes.record(commands, paths, &collector.timer, (push, ONE_STEP));
            [collect::FOUND, 0, 1].into_iter().for_each(|what| collector.collect(commands, push, what));
            shot.passes.copy_heads(commands, paths, &collector.heads);
            commands.barrier();
            collector.lists.iter().for_each(|list| list.copy(commands));
            Ok(())
        })?;
        Ok(collector.heads.read())
    }

    /// Replays rays through this scene; surfaces that are there only in part are asked with the key of each ray.
    ///
    /// # Errors
    /// If the driver refuses the pipeline, or memory is out.
    pub fn replay(&self, view: &View) -> Result<Replay<'_>, VulkanError> {
        Replay::asking(&self.scene, &self.constants.with(&view.settings), &self.cache)
    }

    /// How long the rays of a view's first frame take by themselves, the median of `runs`.
    ///
    /// # Errors
    /// As [`Self::own_rays`].
    pub fn replayed(&self, view: &View, size: [u32; 2], runs: u32) -> Result<Replayed, VulkanError> {
        let (own, replay) = (self.own_rays(view, size)?, self.replay(view)?);
        let total = |groups: &[Vec<&[ReplayRay]>]| -> Result<f64, VulkanError> {
            let mut all: Vec<f64> = replay.times(groups, runs)?.iter().map(|run| run.iter().sum()).collect();
            all.sort_by(f64::total_cmp);
            Ok(all.get(all.len() / 2).copied().unwrap_or(0.0))
        };
        let (path_rays, shadow_rays) = (own.count(false), own.count(true));
        Ok(Replayed {
            path_rays,
            shadow_rays,
            left_out: own.shadow_rays.saturating_sub(shadow_rays) + own.through_glass,
            path_ms: total(&own.alone(false))?,
            shadow_ms: total(&own.alone(true))?,
            ms: total(&own.together())?,
        })
    }
}

impl OwnRays {
    /// Adds the rays of a step.
    fn add(&mut self, step: u32, collector: &Collector, heads: &QueueHeads) {
        let parity = step % 2;
        let [far, near, path] = &collector.lists;
        let shadows = queue::SHADOW + 2 * parity;
        for (list, queue) in [(path, queue::PATHS + parity), (far, shadows), (near, shadows + 1)] {
            let (shadow, count) = (queue >= queue::SHADOW, heads.at[queue as usize].count as usize);
            let (rays, found) = list.read(count);
            if shadow && rays.is_empty() {
                continue;
            }
            self.batches.push(RayBatch { step, shadow, rays, found });
        }
        let glass = queue::GLASS + 2 * parity;
        self.through_glass += (glass..glass + 2).map(|q| u64::from(heads.at[q as usize].count)).sum::<u64>();
        // Shadow rays are counted by the step after.
        let last: u32 = (shadows..shadows + 2).map(|q| heads.at[q as usize].count).sum();
        (self.path_rays, self.shadow_rays) =
            (heads.path_rays.into(), u64::from(heads.shadow_rays) + u64::from(last));
    }
}

impl Collector {
    /// For lists of at most `most` paths.
    fn new(backend: &VulkanBackend, shot: &Shot, most: u32) -> Result<Self, VulkanError> {
        let push = size_of::<CollectPush>() as u32;
        let pipeline = ComputePipeline::of_scene(
            &backend.scene,
            replay::COLLECT,
            &shot.constants,
            push,
            &backend.cache,
        )?;
        let buffers = |size: usize| -> Result<[Buffer; 2], VulkanError> {
            let new =
                |purpose| Buffer::new(&backend.gpu, "collected rays", u64::from(most) * size as u64, purpose);
            Ok([new(Purpose::Data)?, new(Purpose::Readback)?])
        };
        let list = || -> Result<List, VulkanError> {
            Ok(List { rays: buffers(size_of::<ReplayRay>())?, found: buffers(size_of::<ReplayHit>())? })
        };
        Ok(Collector {
            pipeline,
            lists: [list()?, list()?, list()?],
            heads: HeadsReadback::new(&backend.gpu)?,
            timer: Timer::new(&backend.gpu, shot.passes.stamps(ONE_STEP))?,
            most,
        })
    }

    /// Collects one thing: `what` is a group of lights or one of [`collect`].
    fn collect(&self, commands: &Commands<'_>, push: &Push, what: u32) {
        let list = &self.lists[what.min(collect::PATHS) as usize];
        let push = CollectPush {
            path: Push { group: what, ..*push },
            rays: list.rays[0].address(),
            hits: list.found[0].address(),
        };
        self.pipeline.dispatch(commands, bytemuck::bytes_of(&push), [self.most.div_ceil(GROUP), 1]);
    }
}

impl List {
    fn copy(&self, commands: &Commands<'_>) {
        for [device, host] in [&self.rays, &self.found] {
            commands.copy((device, 0), (host, 0), device.size());
        }
    }

    /// The first `count` places, but for those without a ray.
    fn read(&self, count: usize) -> (Vec<ReplayRay>, Vec<ReplayHit>) {
        let rays = values::<ReplayRay>(&self.rays[1], count);
        rays.zip(values::<ReplayHit>(&self.found[1], count)).filter(|(ray, _)| ray.kind != kind::NONE).unzip()
    }
}

/// The first `count` values of a buffer.
fn values<T: bytemuck::Pod>(buffer: &Buffer, count: usize) -> impl Iterator<Item = T> + '_ {
    buffer.read().chunks_exact(size_of::<T>()).take(count).map(bytemuck::pod_read_unaligned)
}
