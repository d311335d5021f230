//! The passes of the path tracer over all paths of a slice, and the memory in which these are under way.
//!
//! ```text
//! generate; for each scattering event: trace, beside it advance and the shadow rays of the
//! event before; shade, beside it glass; catch. At the end shadow, glass, gather
//! ```
//!
//! The left half of a slice's columns is a step ahead of the right one, so that while one half traces the other shades: the few long rays
//! that a launch ends with leave the device to others' shading.
//!
//! One ray generation shader that follows a path to its end, as the theses have it, was the first form of this: simple, and slow where rays
//! are traced in software. On an H100 the pool at 1280x720 and depth 4 took 36.8 ms a frame (92 Mrays/s, of 1300 that a bare loop reaches there).
//! The first surface took 5.2 ms, the second step 4.7, each further one 7 to 11 although few paths were left (0.36, 0.23 and 0.05 of the pixels): a warp
//! takes as long for one path as for 32, and shading holds registers while rays are traced. So paths wait in memory between passes, lists say
//! which go on, launches are as long as the lists, and rays are traced by shaders that do nothing else. (Laine, Karras and Aila 2013, "Megakernels
//! Considered Harmful".)

use super::code::{Code, Kinds};
use super::slices::Slice;
use super::variant::Needs;
use crate::compute::ComputePipeline;
use crate::{
    Buffer, Commands, Gpu, PipelineCache, Purpose, RayPipeline, SceneOnGpu, Specialisation, Timer,
    VulkanError,
};
use bytemuck::bytes_of;
use lumbre_shaders::view::{BLOCK, Push, QUEUES, QueueHead, QueueHeads, STATE_QUADS, queue};
use std::mem::offset_of;

/// Most paths under way at a time: a frame of 2560x1440.
pub(super) const MOST_PATHS: u64 = 1 << 22;
/// Fewest that there is always room for.
pub(super) const LEAST_PATHS: u64 = 1 << 12;

/// Invocations of a work group.
const GROUP: u32 = 64;

/// Memory of paths under way.
pub(super) struct Paths {
    capacity: u32,
    solids: bool,
    /// Less than was asked for.
    short: bool,
    state: Buffer,
    queues: Buffer,
    /// Of each half.
    heads: [Buffer; 2],
}

impl Paths {
    /// Room for `paths`.
    ///
    /// # Errors
    /// If memory is out.
    pub(super) fn new(gpu: &Gpu, paths: u64, solids: bool) -> Result<Self, VulkanError> {
        let quads = STATE_QUADS[usize::from(solids)];
        let heads = || Buffer::new(gpu, "lengths of lists", size_of::<QueueHeads>() as u64, Purpose::Data);
        Ok(Paths {
            capacity: paths as u32,
            solids,
            short: false,
            state: Buffer::new(gpu, "paths under way", paths * quads * 16, Purpose::Data)?,
            queues: Buffer::new(gpu, "lists of paths", paths * QUEUES as u64 * 4, Purpose::Data)?,
            heads: [heads()?, heads()?],
        })
    }

    /// Whether this is room for `paths`, or all that there was, and not far too much.
    pub(super) fn suits(&self, paths: u64, solids: bool) -> bool {
        let capacity = u64::from(self.capacity);
        (capacity >= paths || self.short) && capacity <= 8 * paths.max(1 << 16) && self.solids == solids
    }

    /// Notes that there was not room for more.
    pub(super) fn short(self) -> Self {
        Paths { short: true, ..self }
    }

    /// Paths that there is room for.
    pub(super) fn capacity(&self) -> u32 {
        self.capacity
    }

    /// Addresses of state, lists and heads, of each half: the second's places begin in the middle. A slice that is not halved has all
    /// places of the first.
    pub(super) fn addresses(&self) -> [[u64; 3]; 2] {
        let middle = u64::from(self.capacity) / 2;
        let half = |i: u64| {
            let (state, queues) =
                (self.state.address() + i * middle * 16, self.queues.address() + i * middle * 4);
            [state, queues, self.heads[i as usize].address()]
        };
        [half(0), half(1)]
    }

    /// The halves of a slice, or the whole where it has too few columns.
    pub(super) fn halves(&self, slice: &Slice) -> Vec<Slice> {
        halves(slice, u64::from(self.capacity) / 2)
    }
}

/// Left and right half of a slice if they have the room each; else the whole.
fn halves(slice: &Slice, room: u64) -> Vec<Slice> {
    let ([x, y], [width, height]) = (slice.first_pixel, slice.size);
    let left = width.div_ceil(2).next_multiple_of(BLOCK[0]);
    let part =
        |x, width| Slice { first_pixel: [x, y], size: [width, height], samples: slice.samples.clone() };
    if left >= width || part(x, left).paths() > room {
        return vec![slice.clone()];
    }
    vec![part(x, left), part(x + left, width - left)]
}

/// Paths of one sample of so many pixels.
pub(super) fn paths_per_sample([width, height]: [u32; 2]) -> u64 {
    let blocks = |n: u32, side: u32| u64::from(n.div_ceil(side)) * u64::from(side);
    blocks(width, BLOCK[0]) * blocks(height, BLOCK[1])
}

/// Where the host reads the heads of the lists of both halves.
pub(super) struct HeadsReadback(Buffer);

impl HeadsReadback {
    pub(super) fn new(gpu: &Gpu) -> Result<Self, VulkanError> {
        Ok(HeadsReadback(Buffer::new(
            gpu,
            "lengths on the host",
            2 * size_of::<QueueHeads>() as u64,
            Purpose::Readback,
        )?))
    }

    /// Those of the submission that copied them here; the second are nothing where it had one part only.
    pub(super) fn read(&self) -> [QueueHeads; 2] {
        let both = self.0.read_as();
        [both[0], both[1]]
    }
}

/// The pipelines of all passes that a scene needs.
pub(super) struct Passes {
    needs: Needs,
    generate: ComputePipeline,
    advance: ComputePipeline,
    trace: RayPipeline,
    shade: ComputePipeline,
    shadow: Option<RayPipeline>,
    glass: Option<RayPipeline>,
    catch: Option<RayPipeline>,
    gather: ComputePipeline,
}

/// What is done for a part between two barriers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    Generate,
    /// The closest surfaces; beside them, after another step, its shadow rays.
    Trace {
        after_another: bool,
    },
    /// What has been met; beside it, after another step, its shadow rays through glass.
    Shade {
        after_another: bool,
    },
    Catch,
    /// The shadow rays of the last step.
    Shadow,
    /// Those of them through glass.
    Glass,
    Gather,
}

/// `a + b` for each of some words and each of the same words again.
macro_rules! pairs {
    ($($a:literal)*; $all:tt) => { [$(pairs!(@ $a $all)),*] };
    (@ $a:literal [$($b:literal)*]) => { [$(concat!($a, " + ", $b)),*] };
}

/// Names of phases that run alone, with what runs beside them in the same half.
const ALONE: [&str; 7] =
    ["generate", "trace + shadow", "shade + glass", "catch", "last shadow", "last glass", "gather"];
/// Names of phases of both halves that run at once.
const TOGETHER: [[&str; 7]; 7] = pairs!(
    "generate" "trace" "shade" "catch" "shadow" "glass" "gather";
    ["generate" "trace" "shade" "catch" "shadow" "glass" "gather"]
);

impl Phase {
    fn index(self) -> usize {
        match self {
            Phase::Generate => 0,
            Phase::Trace { .. } => 1,
            Phase::Shade { .. } => 2,
            Phase::Catch => 3,
            Phase::Shadow => 4,
            Phase::Glass => 5,
            Phase::Gather => 6,
        }
    }

    fn traces(self) -> bool {
        !matches!(self, Phase::Generate | Phase::Shade { .. } | Phase::Gather)
    }
}

/// What the time between two barriers is called.
fn name(phases: &[Phase]) -> &'static str {
    match phases.iter().map(|p| p.index()).collect::<Vec<_>>()[..] {
        [one] => ALONE[one],
        [a, b] => TOGETHER[a.min(b)][a.max(b)],
        _ => "nothing",
    }
}

/// What a recording holds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    /// The beginning of the paths.
    pub(super) begins: bool,
    /// Scattering events.
    pub(super) steps: u32,
    /// The way to the film.
    pub(super) ends: bool,
}

/// A part of a slice in a recording.
struct Part<'a> {
    commands: &'a Commands<'a>,
    push: Push,
    heads: &'a Buffer,
    most: u32,
}

impl Part<'_> {
    /// Where a list's length stands.
    fn head(&self, list: u32) -> (&Buffer, u64) {
        (self.heads, offset_of!(QueueHeads, at) as u64 + u64::from(list) * size_of::<QueueHead>() as u64)
    }

    fn rays(&self, pipeline: &RayPipeline, list: u32) {
        pipeline.trace_indirect(self.commands, bytes_of(&self.push), self.head(list), self.most);
    }
}

impl Passes {
    /// Makes them.
    ///
    /// # Errors
    /// If the driver refuses one or memory is out.
    pub(super) fn new(
        scene: &SceneOnGpu,
        code: &Code,
        constants: &Specialisation,
        (needs, light_sampling): (Needs, bool),
        cache: &PipelineCache,
    ) -> Result<Self, VulkanError> {
        let push = size_of::<Push>() as u32;
        let compute = |code: &[u8]| ComputePipeline::of_scene(scene, code, constants, push, cache);
        let rays = |raygen: &[u8], kinds| {
            RayPipeline::new(scene, &code.rays(raygen, kinds, &needs), constants, push, cache)
        };
        let rays_if = |needed: bool, raygen, kinds| needed.then(|| rays(raygen, kinds)).transpose();
        let shadows = light_sampling && needs.lights.contains(&true);
        Ok(Passes {
            needs,
            generate: compute(&code.generate)?,
            advance: compute(&code.advance)?,
            trace: rays(&code.trace, Kinds::Radiance)?,
            shade: compute(&code.shade)?,
            shadow: rays_if(shadows, &code.shadow, Kinds::Shadow)?,
            glass: rays_if(shadows && needs.transmission, &code.glass, Kinds::Radiance)?,
            catch: rays_if(needs.catchers, &code.catch, Kinds::Both)?,
            gather: compute(&code.gather)?,
        })
    }

    /// The groups of lights that shadow rays go to.
    fn groups(&self) -> impl Iterator<Item = u32> + '_ {
        (0..2).filter(|&g| self.needs.lights[g as usize])
    }

    /// What is done for a part, one after another, each with the parity of its step.
    fn phases(&self, extent: Extent) -> Vec<(Phase, u32)> {
        let Extent { begins, steps, ends } = extent;
        let mut phases = Vec::new();
        phases.extend(begins.then_some((Phase::Generate, 0)));
        for step in 0..steps {
            let after_another = step > 0;
            phases.extend([
                (Phase::Trace { after_another }, step % 2),
                (Phase::Shade { after_another }, step % 2),
            ]);
            phases.extend(self.catch.is_some().then_some((Phase::Catch, step % 2)));
        }
        // The last step of paths that cannot be longer asks for nothing.
        if steps > 0 && !(begins && ends) {
            phases.extend([(Phase::Shadow, steps % 2), (Phase::Glass, steps % 2)]);
        }
        phases.extend(ends.then_some((Phase::Gather, steps % 2)));
        phases
    }

    /// Stamps that a recording makes, at most.
    pub(super) fn stamps(&self, extent: Extent) -> usize {
        self.phases(extent).len() + 2
    }

    /// Records what is done for the parts of a slice, each as its push constants have it and a step behind the one before. Makes all stamps
    /// of the timer; returns what is between them.
    pub(super) fn record(
        &self,
        commands: &Commands<'_>,
        paths: &Paths,
        timer: &Timer,
        (parts, extent): (&[Push], Extent),
    ) -> Vec<&'static str> {
        timer.reset(commands);
        timer.stamp(commands, 0);
        let phases = self.phases(extent);
        let mut names = Vec::new();
        for i in 0..phases.len() + parts.len() - 1 {
            let at = |(behind, push)| {
                Some((i.checked_sub(behind).and_then(|i| phases.get(i))?, push, &paths.heads[behind]))
            };
            let mut now: Vec<_> = parts.iter().enumerate().filter_map(at).collect();
            // Rays first: what is shaded beside them fills what they leave.
            now.sort_by_key(|((phase, _), ..)| !phase.traces());
            for ((phase, parity), push, heads) in &now {
                let most = paths_per_sample(push.size) as u32 * push.sample_count;
                let push = Push { parity: (push.parity + parity) % 2, ..**push };
                self.phase(&mut Part { commands, push, heads, most }, *phase);
            }
            names.push(name(&now.iter().map(|((phase, _), ..)| *phase).collect::<Vec<_>>()));
            timer.stamp(commands, names.len());
            commands.barrier();
        }
        // Stamps that are never made would be waited for.
        (names.len() + 1..timer.stamps()).for_each(|stamp| timer.stamp(commands, stamp));
        names
    }

    fn phase(&self, part: &mut Part<'_>, phase: Phase) {
        match phase {
            Phase::Generate => self.generate(part),
            Phase::Trace { after_another } => {
                // It touches no list that is read here.
                self.advance.dispatch(part.commands, bytes_of(&part.push), [1, 1]);
                part.rays(&self.trace, queue::PATHS + part.push.parity);
                if after_another {
                    self.shadows(part);
                }
            }
            Phase::Shade { after_another } => {
                if after_another {
                    self.glass(part);
                }
                let groups = (part.heads, offset_of!(QueueHeads, groups) as u64);
                self.shade.dispatch_indirect(part.commands, bytes_of(&part.push), groups);
            }
            Phase::Catch => self.catch.iter().for_each(|catch| part.rays(catch, queue::CATCHERS)),
            Phase::Shadow => self.shadows(part),
            Phase::Glass => self.glass(part),
            Phase::Gather => {
                let groups = (paths_per_sample(part.push.size) as u32).div_ceil(GROUP);
                self.gather.dispatch(part.commands, bytes_of(&part.push), [groups, 1]);
            }
        }
    }

    fn generate(&self, part: &Part<'_>) {
        let one = QueueHead { one_row: 1, one_layer: 1, ..QueueHead::default() };
        let mut heads = QueueHeads { at: [one; QUEUES], groups: [0, 1, 1], ..QueueHeads::default() };
        heads.at[queue::PATHS as usize].count = part.most;
        part.commands.update(part.heads, bytes_of(&heads));
        self.generate.dispatch(part.commands, bytes_of(&part.push), [part.most.div_ceil(GROUP), 1]);
    }

    /// The shadow rays of the step before this parity, to both groups of lights.
    fn shadows(&self, part: &mut Part<'_>) {
        if let Some(shadow) = &self.shadow {
            self.for_lights(part, |p| p.rays(shadow, queue::SHADOW + 2 * p.push.parity + p.push.group));
        }
    }

    /// Those of them that meet what lets light through.
    fn glass(&self, part: &mut Part<'_>) {
        if let Some(glass) = &self.glass {
            self.for_lights(part, |p| p.rays(glass, queue::GLASS + 2 * p.push.parity + p.push.group));
        }
    }

    /// Launches for each group of lights, for the paths of the step before.
    fn for_lights(&self, part: &mut Part<'_>, launch: impl Fn(&Part<'_>)) {
        let parity = part.push.parity;
        part.push.parity = 1 - parity;
        for group in self.groups() {
            part.push.group = group;
            launch(part);
        }
        part.push.parity = parity;
    }

    /// Copies the heads to the host.
    pub(super) fn copy_heads(&self, commands: &Commands<'_>, paths: &Paths, to: &HeadsReadback) {
        let size = size_of::<QueueHeads>() as u64;
        for (i, heads) in (0..).zip(&paths.heads) {
            commands.copy((heads, 0), (&to.0, i * size), size);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_the_whole() {
        let slice = |first_pixel, size| Slice { first_pixel, size, samples: 3..5 };
        for (size, lefts) in [([1280, 720], 640), ([9, 5], 8), ([24, 1], 16), ([100, 30], 56)] {
            let whole = slice([7, 3], size);
            let parts = halves(&whole, 1 << 30);
            assert_eq!(
                parts,
                [slice([7, 3], [lefts, size[1]]), slice([7 + lefts, 3], [size[0] - lefts, size[1]])]
            );
            assert_eq!(parts.iter().map(Slice::paths).sum::<u64>(), whole.paths());
            assert_eq!(halves(&whole, parts[0].paths()).len(), 2);
            assert_eq!(halves(&whole, parts[0].paths() - 1), [whole]);
        }
        assert_eq!(halves(&slice([0, 0], [8, 50]), 1 << 30).len(), 1, "a single column of blocks");
    }
}
