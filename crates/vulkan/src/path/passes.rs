//! The passes of the path tracer over all paths of a slice, and the memory in which these are under way.
//!
//! ```text
//! generate; for each scattering event: advance; trace, beside it the shadow rays of the
//! event before; shade, beside it glass; catch. At the end shadow, glass, gather
//! ```
//!
//! One ray generation shader that follows a path to its end, as the theses have it, was the first form of this: simple, and slow where rays
//! are traced in software. On an H100 the pool at 1280x720 and depth 4 took 36.8 ms a frame (92 Mrays/s, of 1300 that a bare loop reaches there).
//! The first surface took 5.2 ms, the second step 4.7, each further one 7 to 11 although few paths were left (0.36, 0.23 and 0.05 of the pixels): a warp
//! takes as long for one path as for 32, and shading holds registers while rays are traced. So paths wait in memory between passes, lists say
//! which go on, launches are as long as the lists, and rays are traced by shaders that do nothing else. (Laine, Karras and Aila 2013, "Megakernels
//! Considered Harmful".)

use super::code::Code;
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

/// Names of the passes, in order.
pub(super) const NAMES: [&str; 8] = [
    "generate",
    "advance",
    "trace + shadow",
    "shade + glass",
    "last shadow",
    "last glass",
    "catch",
    "gather",
];

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

/// A recording of passes: what follows from step to step.
struct Recording<'a> {
    commands: &'a Commands<'a>,
    timer: &'a Timer,
    stamps: usize,
    push: Push,
    heads: &'a Buffer,
    most: u32,
}

impl Recording<'_> {
    /// What follows waits for all before: notes when.
    fn done(&mut self) {
        self.timer.stamp(self.commands, self.stamps);
        self.stamps += 1;
        self.commands.barrier();
    }

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
        let rays = |raygen: &[u8]| RayPipeline::new(scene, &code.rays(raygen), constants, push, cache);
        let rays_if = |needed: bool, raygen| needed.then(|| rays(raygen)).transpose();
        let shadows = light_sampling && needs.lights.contains(&true);
        Ok(Passes {
            needs,
            generate: compute(&code.generate)?,
            advance: compute(&code.advance)?,
            trace: rays(&code.trace)?,
            shade: compute(&code.shade)?,
            shadow: rays_if(shadows, &code.shadow)?,
            glass: rays_if(shadows && needs.transmission, &code.glass)?,
            catch: rays_if(needs.catchers, &code.catch)?,
            gather: compute(&code.gather)?,
        })
    }

    /// The pass of each stamp of a recording with so many steps, the first stamp left out.
    pub(super) fn stamps(&self, begins: bool, steps: u32, ends: bool) -> Vec<usize> {
        let mut stamps = Vec::new();
        stamps.extend(begins.then_some(0));
        for _ in 0..steps {
            stamps.extend([1, 2, 3]);
            stamps.extend(self.catch.is_some().then_some(6));
        }
        // The last step of paths that cannot be longer asks for nothing.
        if steps > 0 && !(begins && ends) {
            stamps.extend([4, 5]);
        }
        stamps.extend(ends.then_some(7));
        stamps
    }

    /// The groups of lights that shadow rays go to.
    fn groups(&self) -> impl Iterator<Item = u32> + '_ {
        (0..2).filter(|&g| self.needs.lights[g as usize])
    }

    /// Records the beginning of a slice's paths.
    pub(super) fn begin(&self, commands: &Commands<'_>, paths: &Paths, push: &Push) {
        let one = QueueHead { one_row: 1, one_layer: 1, ..QueueHead::default() };
        let mut heads = QueueHeads { at: [one; QUEUES], groups: [0, 1, 1], ..QueueHeads::default() };
        let count = paths_per_sample(push.size) as u32 * push.sample_count;
        heads.at[queue::PATHS as usize].count = count;
        commands.update(&paths.heads, bytes_of(&heads));
        self.generate.dispatch(commands, bytes_of(push), [count.div_ceil(GROUP), 1]);
    }

    /// Records the beginning of a slice's paths if it `begins`, `steps` scattering events, and if it `ends` the way to the film. Stamps as
    /// [`Self::stamps`] says.
    pub(super) fn record(
        &self,
        commands: &Commands<'_>,
        paths: &Paths,
        timer: &Timer,
        (push, begins, steps, ends): (&Push, bool, u32, bool),
    ) {
        timer.reset(commands);
        timer.stamp(commands, 0);
        let most = paths_per_sample(push.size) as u32 * push.sample_count;
        let mut r = Recording { commands, timer, stamps: 1, push: *push, heads: &paths.heads, most };
        if begins {
            self.begin(commands, paths, push);
            r.done();
        }
        for step in 0..steps {
            self.step(&mut r, step > 0);
            r.push.parity = 1 - r.push.parity;
        }
        if steps > 0 && !(begins && ends) {
            self.shadows(&mut r);
            r.done();
            self.glass(&mut r);
            r.done();
        }
        if ends {
            let groups = (paths_per_sample(push.size) as u32).div_ceil(GROUP);
            self.gather.dispatch(commands, bytes_of(&r.push), [groups, 1]);
            r.done();
        }
        assert_eq!(r.stamps, self.stamps(begins, steps, ends).len() + 1, "each stamp has a name");
    }

    /// One scattering event of all paths. The shadow rays of the one before are traced beside its rays, and those of them that meet glass are
    /// followed while it shades: what few rays leave idle, other work fills.
    fn step(&self, r: &mut Recording<'_>, after_another: bool) {
        self.advance.dispatch(r.commands, bytes_of(&r.push), [1, 1]);
        r.done();
        r.rays(&self.trace, queue::PATHS + r.push.parity);
        if after_another {
            self.shadows(r);
        }
        r.done();
        if after_another {
            self.glass(r);
        }
        let groups = (r.heads, offset_of!(QueueHeads, groups) as u64);
        self.shade.dispatch_indirect(r.commands, bytes_of(&r.push), groups);
        r.done();
        if let Some(catch) = &self.catch {
            r.rays(catch, queue::CATCHERS);
            r.done();
        }
    }

    /// The shadow rays of the step before this parity, to both groups of lights.
    fn shadows(&self, r: &mut Recording<'_>) {
        if let Some(shadow) = &self.shadow {
            self.for_lights(r, |r| r.rays(shadow, queue::SHADOW + 2 * r.push.parity + r.push.group));
        }
    }

    /// Those of them that meet what lets light through.
    fn glass(&self, r: &mut Recording<'_>) {
        if let Some(glass) = &self.glass {
            self.for_lights(r, |r| r.rays(glass, queue::GLASS + 2 * r.push.parity + r.push.group));
        }
    }

    /// Launches for each group of lights, for the paths of the step before.
    fn for_lights(&self, r: &mut Recording<'_>, launch: impl Fn(&Recording<'_>)) {
        let parity = r.push.parity;
        r.push.parity = 1 - parity;
        for group in self.groups() {
            r.push.group = group;
            launch(r);
        }
        r.push.parity = parity;
    }

    /// Copies the heads to the host.
    pub(super) fn copy_heads(&self, commands: &Commands<'_>, paths: &Paths, to: &HeadsReadback) {
        commands.copy((&paths.heads, 0), (&to.0, 0), size_of::<QueueHeads>() as u64);
    }
}
