//! The memory of frames of one size.

use super::VulkanBackend;
use crate::raster::Target;
use crate::{Buffer, Commands, Gpu, Purpose, VulkanError};
use bytemuck::bytes_of;
use lumbre_core::hybrid::{FrameReport, HybridSettings};
use lumbre_core::medium::MediumStack;
use lumbre_core::settings::View;
use lumbre_shaders::camera::CameraRecord;
use lumbre_shaders::hybrid::{FrameHeads, FrameTable, MOST_SHARP, PLANE_QUADS, RAY_QUADS, SHADOW_QUADS};
use lumbre_shaders::view::{QueueHead, ViewTable};
use std::mem::offset_of;

/// Up to so many rays there is room for all that split.
const ALL_SPLIT: u64 = 1 << 21;

/// Memory of frames of one size.
pub(super) struct Memory {
    pub(super) target: Target,
    solids: bool,
    ray_capacity: u32,
    shadow_capacity: u32,
    planes: Buffer,
    rays: Buffer,
    shadows: Buffer,
    glass: Buffer,
    sums: Buffer,
    heads: Buffer,
    view: Buffer,
    frame: Buffer,
}

/// Rays and shadow rays that there is room for.
fn capacities(size: [u32; 2], sharp_lights: u32) -> [u64; 2] {
    let pixels = u64::from(size[0]) * u64::from(size[1]);
    let rays = pixels.max((2 * pixels).min(ALL_SPLIT)).max(1);
    // A generation of rays asks for no more than these.
    [rays, rays * u64::from(sharp_lights.clamp(1, MOST_SHARP))]
}

impl Memory {
    /// Takes it.
    ///
    /// # Errors
    /// If memory is out.
    pub(super) fn new(
        gpu: &Gpu,
        size: [u32; 2],
        solids: bool,
        sharp_lights: u32,
    ) -> Result<Self, VulkanError> {
        let pixels = u64::from(size[0]) * u64::from(size[1]);
        let [rays, shadows] = capacities(size, sharp_lights);
        let data = |name, bytes| Buffer::new(gpu, name, bytes, Purpose::Data);
        let heads = size_of::<FrameHeads>() as u64;
        let kind = usize::from(solids);
        Ok(Memory {
            target: Target::new(gpu, size)?,
            solids,
            ray_capacity: rays as u32,
            shadow_capacity: shadows as u32,
            planes: data("planes", 16 * PLANE_QUADS * pixels)?,
            rays: data("rays of a frame", 2 * 16 * RAY_QUADS[kind] * rays)?,
            shadows: data("shadow rays of a frame", 2 * 16 * SHADOW_QUADS[kind] * shadows)?,
            glass: data("shadow rays through glass", 2 * 4 * shadows)?,
            sums: data("light of pixels", 3 * 8 * pixels)?,
            heads: data("lengths of lists", heads)?,
            view: data("view", size_of::<ViewTable>() as u64)?,
            frame: data("frame", size_of::<FrameTable>() as u64)?,
        })
    }

    /// Whether it is that of such frames.
    pub(super) fn suits(&self, size: [u32; 2], solids: bool, sharp_lights: u32) -> bool {
        let [_, shadows] = capacities(size, sharp_lights);
        self.target.size() == size && self.solids == solids && u64::from(self.shadow_capacity) == shadows
    }

    pub(super) fn size(&self) -> [u32; 2] {
        self.target.size()
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
        (media, previous): (&MediumStack, CameraRecord),
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
            frame: view.frame,
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
            sharp_lights: scene.sharp_lights(),
            previous_transforms: backend.scene_on_gpu().transforms(),
            sharp_light_count: scene.sharp_light_count(),
            ray_capacity: self.ray_capacity,
            shadow_capacity: self.shadow_capacity,
            depth: settings.depth,
            jitter: [0.0; 2],
            far,
            near,
            ambient: settings.ambient.unwrap_or(scene.ambient()).to_array(),
            previous,
        };
        (table, frame)
    }

    /// Writes the tables, and empties all lists.
    pub(super) fn begin(&self, commands: &Commands<'_>, [view, frame]: [&[u8]; 2]) {
        commands.update(&self.view, view);
        commands.update(&self.frame, frame);
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

fn head(list: usize, parity: u32) -> u64 {
    list as u64 + u64::from(parity) * size_of::<QueueHead>() as u64
}
