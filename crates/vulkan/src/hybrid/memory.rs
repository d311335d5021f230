//! The memory of frames of one size.

use super::VulkanBackend;
use crate::raster::Target;
use crate::{Buffer, Commands, Gpu, Purpose, VulkanError};
use bytemuck::bytes_of;
use lumbre_core::hybrid::{FrameReport, HybridSettings, PixelPlanes};
use lumbre_core::medium::MediumStack;
use lumbre_core::settings::View;
use lumbre_scene::compiled::NONE;
use lumbre_shaders::camera::CameraRecord;
use lumbre_shaders::hybrid::{
    CHANNELS, FrameHeads, FrameTable, MEASURED_BYTES, MOST_SHARP, PLANE_QUADS, PREVIOUS_QUADS, RAY_QUADS,
    SHADOW_QUADS,
};
use lumbre_shaders::view::{QueueHead, ViewTable};
use std::mem::offset_of;

/// Of sums of light.
const QUANTUM: f64 = 1.0 / (1 << 24) as f64;
/// As `hybrid/filter/soft.glsl` has it: smallest albedo that soft light is divided by.
const LEAST_ALBEDO: f32 = 0.02;
/// Up to so many rays there is room for all that split.
const ALL_SPLIT: u64 = 1 << 21;

/// What was before a frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Since {
    /// The camera of the frame before.
    pub(super) camera: CameraRecord,
    /// Address of the transforms then.
    pub(super) transforms: u64,
    /// Where in their pixels this frame looks, and the one before did.
    pub(super) jitter: [f32; 2],
    pub(super) previous_jitter: [f32; 2],
    /// Which of two buffers is this frame's.
    pub(super) turn: u32,
    /// There was a frame before.
    pub(super) has_history: bool,
    /// Nothing has changed since.
    pub(super) is_still: bool,
}

/// Memory of frames of one size.
pub(super) struct Memory {
    shape: Shape,
    pub(super) target: Target,
    ray_capacity: u32,
    shadow_capacity: u32,
    planes: Buffer,
    rays: Buffer,
    shadows: Buffer,
    glass: Buffer,
    sums: Buffer,
    previous_planes: Buffer,
    measured: [Buffer; 2],
    /// Two that take turns, the history, two times moments.
    filter: [Buffer; 5],
    drawn: Buffer,
    shown: [Buffer; 2],
    heads: Buffer,
    view: Buffer,
    frame: Buffer,
}

/// What frames need memory for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shape {
    /// Columns and rows that are drawn.
    pub(super) size: [u32; 2],
    /// Columns and rows that are shown.
    pub(super) shown: [u32; 2],
    /// Rays carry the solids that they are in.
    pub(super) solids: bool,
    /// Lights with sharp shadows.
    pub(super) sharp_lights: u32,
    /// There is soft light.
    pub(super) soft: bool,
}

impl Shape {
    fn pixels(&self) -> u64 {
        u64::from(self.size[0]) * u64::from(self.size[1])
    }

    /// Rays and shadow rays that there is room for.
    fn capacities(&self) -> [u64; 2] {
        let pixels = self.pixels();
        let gathered = if self.soft { pixels } else { 0 };
        let rays = pixels.max((2 * pixels).min(ALL_SPLIT)).max(1) + gathered;
        // A generation of rays asks for no more than these: of sharp lights, of the sun's disc, of a lamp or of what occludes ambient light.
        let asked = self.sharp_lights.clamp(1, MOST_SHARP) + if self.soft { 2 } else { 0 };
        [rays, rays * u64::from(asked)]
    }
}

impl Memory {
    /// Takes it.
    ///
    /// # Errors
    /// If memory is out.
    pub(super) fn new(gpu: &Gpu, shape: &Shape) -> Result<Self, VulkanError> {
        let pixels = shape.pixels();
        let [rays, shadows] = shape.capacities();
        let data = |name, bytes| Buffer::new(gpu, name, bytes, Purpose::Data);
        let heads = size_of::<FrameHeads>() as u64;
        let kind = usize::from(shape.solids);
        // Without soft light nothing is filtered.
        let filtered = if shape.soft { 16 * pixels } else { 0 };
        let filter = || data("soft light", filtered);
        let shown_pixels = u64::from(shape.shown[0]) * u64::from(shape.shown[1]);
        let shown = || data("picture", 16 * shown_pixels);
        Ok(Memory {
            shape: *shape,
            target: Target::new(gpu, shape.size)?,
            ray_capacity: rays as u32,
            shadow_capacity: shadows as u32,
            planes: data("planes", 16 * PLANE_QUADS * pixels)?,
            rays: data("rays of a frame", 2 * 16 * RAY_QUADS[kind] * rays)?,
            shadows: data("shadow rays of a frame", 2 * 16 * SHADOW_QUADS[kind] * shadows)?,
            glass: data("shadow rays through glass", 2 * 4 * shadows)?,
            sums: data("light of pixels", CHANNELS * 3 * 8 * pixels)?,
            previous_planes: data("planes of the frame before", 16 * PREVIOUS_QUADS * pixels)?,
            filter: [filter()?, filter()?, filter()?, filter()?, filter()?],
            measured: [data("ambient light", MEASURED_BYTES)?, data("ambient light", MEASURED_BYTES)?],
            drawn: data("frame before anti-aliasing", 16 * pixels)?,
            shown: [shown()?, shown()?],
            heads: data("lengths of lists", heads)?,
            view: data("view", size_of::<ViewTable>() as u64)?,
            frame: data("frame", size_of::<FrameTable>() as u64)?,
        })
    }

    /// What it is for.
    pub(super) fn shape(&self) -> &Shape {
        &self.shape
    }

    pub(super) fn size(&self) -> [u32; 2] {
        self.shape.size
    }

    pub(super) fn view_address(&self) -> u64 {
        self.view.address()
    }

    pub(super) fn frame_address(&self) -> u64 {
        self.frame.address()
    }

    pub(super) fn heads(&self) -> &Buffer {
        &self.heads
    }

    /// Most rays, and most shadow rays, of a launch.
    pub(super) fn most(&self) -> [u32; 2] {
        [self.ray_capacity, self.shadow_capacity]
    }

    /// What shaders are told of a frame.
    pub(super) fn tables(
        &self,
        backend: &VulkanBackend,
        (view, settings): (&View, &HybridSettings),
        [film, non_finite]: [u64; 2],
        (media, since): (&MediumStack, &Since),
    ) -> (ViewTable, FrameTable) {
        let scene = backend.hybrid_scene();
        let size = self.size();
        let [near, far] = scene.range(&view.camera);
        let table = ViewTable {
            film,
            non_finite,
            state: 0,
            queues: 0,
            heads: 0,
            picture: size,
            origin: [0, 0],
            size,
            capacity: 0,
            seed: view.settings.seed,
            // The frame's number is that of its sample: points of a pixel are spread over its frames.
            frame: 0,
            max_depth: settings.depth,
            roulette: u32::MAX,
            clamp_to: f32::INFINITY,
            filter_kind: 0,
            object_colors: view.settings.object_colors.into(),
            rough_bounces: 0,
            camera: (&view.camera).into(),
            media: media.into(),
        };
        let frame = FrameTable {
            ids: self.target.numbers.address(),
            planes: self.planes.address(),
            rays: self.rays.address(),
            shadows: self.shadows.address(),
            glass: self.glass.address(),
            heads: self.heads.address(),
            sums: self.sums.address(),
            measured: [self.measured[0].address(), self.measured[1].address()],
            sharp_lights: scene.sharp_lights(),
            previous_planes: self.previous_planes.address(),
            soft: [self.filter[0].address(), self.filter[1].address()],
            soft_history: self.filter[2].address(),
            moments: [self.filter[3].address(), self.filter[4].address()],
            drawn: self.drawn.address(),
            shown: [self.shown[0].address(), self.shown[1].address()],
            previous_transforms: since.transforms,
            sharp_light_count: scene.sharp_light_count(),
            ray_capacity: self.ray_capacity,
            shadow_capacity: self.shadow_capacity,
            depth: settings.depth,
            jitter: since.jitter,
            previous_jitter: since.previous_jitter,
            far,
            near,
            ambient: settings.ambient.unwrap_or(scene.ambient()).to_array(),
            occlusion_reach: settings.occlusion_reach.unwrap_or(scene.occlusion_reach()),
            previous: since.camera,
            shown_size: self.shape.shown,
            turn: since.turn,
            has_history: since.has_history.into(),
            is_still: since.is_still.into(),
            ambient_is_given: settings.ambient.is_some().into(),
            unused: 0,
        };
        (table, frame)
    }

    /// The planes of the last frame, which filtered soft light in so many passes.
    ///
    /// # Errors
    /// If memory is out or the device is lost.
    pub(super) fn read_planes(&self, gpu: &Gpu, filters: u32) -> Result<Vec<PixelPlanes>, VulkanError> {
        let read = |from: &Buffer| -> Result<Buffer, VulkanError> {
            let host = Buffer::new(gpu, "planes on the host", from.size(), Purpose::Readback)?;
            gpu.run("reading planes", |commands| {
                commands.copy((from, 0), (&host, 0), from.size());
                Ok(())
            })?;
            Ok(host)
        };
        let words: Vec<[u32; 4]> = read(&self.planes)?.read_as();
        let sums: Vec<i64> = read(&self.sums)?.read_as();
        let filtered: Option<Vec<[f32; 4]>> = match filters {
            0 => None,
            n => Some(read(&self.filter[n as usize % 2])?.read_as()),
        };
        let pixels = self.shape.pixels() as usize;
        let light = |channel: usize, i: usize| -> [f32; 3] {
            core::array::from_fn(|band| (sums[(3 * channel + band) * pixels + i] as f64 * QUANTUM) as f32)
        };
        let pixel = |i: usize| {
            let planes = pixel_planes(|plane| words[plane * pixels + i]);
            let [sharp, soft, gathered] = [light(0, i), light(1, i), light(2, i)];
            let filtered = match &filtered {
                None => core::array::from_fn(|band| soft[band] + gathered[band]),
                Some(light) => {
                    core::array::from_fn(|band| light[i][band] * planes.albedo[band].max(LEAST_ALBEDO))
                }
            };
            PixelPlanes { sharp, soft, gathered, filtered, ..planes }
        };
        Ok((0..pixels).map(pixel).collect())
    }

    /// Keeps what the next frame wants to know of this one's planes.
    pub(super) fn keep_planes(&self, commands: &Commands<'_>) {
        let plane = 16 * self.shape.pixels();
        // Normal and distance, position and instance: PLANE_NORMAL and PLANE_POSITION.
        for (kept, from) in [(0, 0), (1, 2)] {
            commands.copy((&self.planes, from * plane), (&self.previous_planes, kept * plane), plane);
        }
    }

    /// Writes the tables, and empties all lists.
    pub(super) fn begin(&self, commands: &Commands<'_>, [view, frame]: [&[u8]; 2], turn: u32) {
        commands.update(&self.view, view);
        commands.update(&self.frame, frame);
        commands.fill(&self.measured[turn as usize], 0);
        let one = QueueHead { one_row: 1, one_layer: 1, ..QueueHead::default() };
        let heads = FrameHeads {
            rays: [one; 2],
            shadows: [one; 2],
            glass: [one; 2],
            groups: [0, 1, 1],
            ..FrameHeads::default()
        };
        commands.update(&self.heads, bytes_of(&heads));
        commands.barrier();
    }

    /// Where the length of a list of rays stands, as an indirect launch.
    pub(super) fn rays_head(parity: u32) -> u64 {
        head(offset_of!(FrameHeads, rays), parity)
    }

    /// The same for shadow rays.
    pub(super) fn shadows_head(parity: u32) -> u64 {
        head(offset_of!(FrameHeads, shadows), parity)
    }

    /// The same for those through glass.
    pub(super) fn glass_head(parity: u32) -> u64 {
        head(offset_of!(FrameHeads, glass), parity)
    }

    /// Where the host reads the counts of a frame.
    pub(super) fn readback(gpu: &Gpu) -> Result<Buffer, VulkanError> {
        Buffer::new(gpu, "lengths on the host", size_of::<FrameHeads>() as u64, Purpose::Readback)
    }

    /// Brings the counts there.
    pub(super) fn copy_heads(&self, commands: &Commands<'_>, to: &Buffer) {
        commands.copy((&self.heads, 0), (to, 0), size_of::<FrameHeads>() as u64);
    }

    /// What the counts say.
    pub(super) fn report(heads: &Buffer) -> FrameReport {
        let heads: FrameHeads = heads.read_as()[0];
        FrameReport {
            rays: heads.traced_rays.into(),
            shadow_rays: heads.traced_shadows.into(),
            dropped: heads.dropped.into(),
        }
    }
}

/// The planes of a pixel, by number: PLANE_NORMAL and so on of `hybrid/frame.glsl`.
fn pixel_planes(words: impl Fn(usize) -> [u32; 4]) -> PixelPlanes {
    let [normal, albedo, position, motion, emission, shares] = core::array::from_fn(&words);
    let floats = |w: [u32; 4]| w.map(f32::from_bits);
    let three = |w: [u32; 4]| [w[0], w[1], w[2]].map(f32::from_bits);
    let some = |id: u32| (id != NONE).then_some(id);
    PixelPlanes {
        normal: three(normal),
        distance: f32::from_bits(normal[3]),
        albedo: three(albedo),
        roughness: half(albedo[3] as u16),
        specularity: half((albedo[3] >> 16) as u16),
        position: three(position),
        instance: some(position[3]),
        material: some(emission[3]),
        motion: [floats(motion)[0], floats(motion)[1]],
        emission: three(emission),
        mirrored: floats(shares)[0],
        through: floats(shares)[1],
        index: floats(shares)[2],
        sharp: [0.0; 3],
        soft: [0.0; 3],
        gathered: [0.0; 3],
        filtered: [0.0; 3],
    }
}

/// A number of 16 bits as shaders pack it; those here lie between 0 and 1.
fn half(bits: u16) -> f32 {
    let (exponent, mantissa) = (i32::from(bits >> 10 & 31), f32::from(bits & 1023) / 1024.0);
    match exponent {
        0 => mantissa * 2f32.powi(-14),
        _ => (1.0 + mantissa) * 2f32.powi(exponent - 15),
    }
}

fn head(list: usize, parity: u32) -> u64 {
    list as u64 + u64::from(parity) * size_of::<QueueHead>() as u64
}
