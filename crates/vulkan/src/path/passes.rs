//! The passes of the path tracer over all paths of a slice, and the memory in which these are under way.
//!
//! ```text
//! generate; for each scattering event: trace, beside it advance and the shadow rays of the
//! event before; shade, beside it glass; catch. At the end shadow, glass, gather
//! ```
//!
//! One ray generation shader that follows a path to its end, as the theses have it, was the first form of this: simple, and slow where rays
//! are traced in software. On an H100 the pool at 1280x720 and depth 4 took 36.8 ms a frame (92 Mrays/s, of 1300 that a bare loop reaches there).
//! The first surface took 5.2 ms, the second step 4.7, each further one 7 to 11 although few paths were left (0.36, 0.23 and 0.05 of the pixels): a warp
//! takes as long for one path as for 32, and shading holds registers while rays are traced. So paths wait in memory between passes, lists say
//! which go on, launches are as long as the lists, and rays are traced by shaders that do nothing else. (Laine, Karras and Aila 2013, "Megakernels
//! Considered Harmful".)

use super::code::{Code, Kinds};
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
    heads: Buffer,
}

impl Paths {
    /// Room for `paths`.
    ///
    /// # Errors
    /// If memory is out.
    pub(super) fn new(gpu: &Gpu, paths: u64, solids: bool) -> Result<Self, VulkanError> {
        let quads = STATE_QUADS[usize::from(solids)];
        Ok(Paths {
            capacity: paths as u32,
            solids,
            short: false,
            state: Buffer::new(gpu, "paths under way", paths * quads * 16, Purpose::Data)?,
            queues: Buffer::new(gpu, "lists of paths", paths * QUEUES as u64 * 4, Purpose::Data)?,
            heads: Buffer::new(gpu, "lengths of lists", size_of::<QueueHeads>() as u64, Purpose::Data)?,
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

    /// Addresses of state, lists and heads.
    pub(super) fn addresses(&self) -> [u64; 3] {
        [self.state.address(), self.queues.address(), self.heads.address()]
    }
}

/// Paths of one sample of so many pixels.
pub(super) fn paths_per_sample([width, height]: [u32; 2]) -> u64 {
    let blocks = |n: u32, side: u32| u64::from(n.div_ceil(side)) * u64::from(side);
    blocks(width, BLOCK[0]) * blocks(height, BLOCK[1])
}

/// Where the host reads the heads of the lists.
pub(super) struct HeadsReadback(Buffer);

impl HeadsReadback {
    pub(super) fn new(gpu: &Gpu) -> Result<Self, VulkanError> {
        Ok(HeadsReadback(Buffer::new(
            gpu,
            "lengths on the host",
            size_of::<QueueHeads>() as u64,
            Purpose::Readback,
        )?))
    }

    /// Those of the submission that copied them here.
    pub(super) fn read(&self) -> QueueHeads {
        self.0.read_as()[0]
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

/// What is done between two barriers.
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

impl Phase {
    /// What the time between its barriers is called: what runs in it.
    fn name(self) -> &'static str {
        match self {
            Phase::Generate => "generate",
            Phase::Trace { .. } => "trace + shadow",
            Phase::Shade { .. } => "shade + glass",
            Phase::Catch => "catch",
            Phase::Shadow => "last shadow",
            Phase::Glass => "last glass",
            Phase::Gather => "gather",
        }
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

/// A phase in a recording.
struct Turn<'a> {
    commands: &'a Commands<'a>,
    push: Push,
    heads: &'a Buffer,
    most: u32,
}

impl Turn<'_> {
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

    /// What is done, one after another, each with the parity of its step.
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

    /// Stamps that a recording makes.
    pub(super) fn stamps(&self, extent: Extent) -> usize {
        self.phases(extent).len() + 1
    }

    /// Records what is done for a slice. Makes all stamps of the timer; returns what is between them.
    pub(super) fn record(
        &self,
        commands: &Commands<'_>,
        paths: &Paths,
        timer: &Timer,
        (push, extent): (&Push, Extent),
    ) -> Vec<&'static str> {
        timer.reset(commands);
        timer.stamp(commands, 0);
        let most = paths_per_sample(push.size) as u32 * push.sample_count;
        let mut names = Vec::new();
        for (phase, parity) in self.phases(extent) {
            let push = Push { parity: (push.parity + parity) % 2, ..*push };
            self.phase(&mut Turn { commands, push, heads: &paths.heads, most }, phase);
            names.push(phase.name());
            timer.stamp(commands, names.len());
            commands.barrier();
        }
        names
    }

    fn phase(&self, turn: &mut Turn<'_>, phase: Phase) {
        match phase {
            Phase::Generate => self.generate(turn),
            Phase::Trace { after_another } => {
                // It touches no list that is read here.
                self.advance.dispatch(turn.commands, bytes_of(&turn.push), [1, 1]);
                turn.rays(&self.trace, queue::PATHS + turn.push.parity);
                if after_another {
                    self.shadows(turn);
                }
            }
            Phase::Shade { after_another } => {
                if after_another {
                    self.glass(turn);
                }
                let groups = (turn.heads, offset_of!(QueueHeads, groups) as u64);
                self.shade.dispatch_indirect(turn.commands, bytes_of(&turn.push), groups);
            }
            Phase::Catch => self.catch.iter().for_each(|catch| turn.rays(catch, queue::CATCHERS)),
            Phase::Shadow => self.shadows(turn),
            Phase::Glass => self.glass(turn),
            Phase::Gather => {
                let groups = (paths_per_sample(turn.push.size) as u32).div_ceil(GROUP);
                self.gather.dispatch(turn.commands, bytes_of(&turn.push), [groups, 1]);
            }
        }
    }

    fn generate(&self, turn: &Turn<'_>) {
        let one = QueueHead { one_row: 1, one_layer: 1, ..QueueHead::default() };
        let mut heads = QueueHeads { at: [one; QUEUES], groups: [0, 1, 1], ..QueueHeads::default() };
        heads.at[queue::PATHS as usize].count = turn.most;
        turn.commands.update(turn.heads, bytes_of(&heads));
        self.generate.dispatch(turn.commands, bytes_of(&turn.push), [turn.most.div_ceil(GROUP), 1]);
    }

    /// The shadow rays of the step before this parity, to both groups of lights.
    fn shadows(&self, turn: &mut Turn<'_>) {
        if let Some(shadow) = &self.shadow {
            self.for_lights(turn, |t| t.rays(shadow, queue::SHADOW + 2 * t.push.parity + t.push.group));
        }
    }

    /// Those of them that meet what lets light through.
    fn glass(&self, turn: &mut Turn<'_>) {
        if let Some(glass) = &self.glass {
            self.for_lights(turn, |t| t.rays(glass, queue::GLASS + 2 * t.push.parity + t.push.group));
        }
    }

    /// Launches for each group of lights, for the paths of the step before.
    fn for_lights(&self, turn: &mut Turn<'_>, launch: impl Fn(&Turn<'_>)) {
        let parity = turn.push.parity;
        turn.push.parity = 1 - parity;
        for group in self.groups() {
            turn.push.group = group;
            launch(turn);
        }
        turn.push.parity = parity;
    }

    /// Copies the heads to the host.
    pub(super) fn copy_heads(&self, commands: &Commands<'_>, paths: &Paths, to: &HeadsReadback) {
        commands.copy((&paths.heads, 0), (&to.0, 0), size_of::<QueueHeads>() as u64);
    }
}
