//! What the path tracer's shaders are told of a view. Twin: `glsl/path/push.glsl`.

use crate::camera::CameraRecord;
use crate::medium::MediumStackRecord;
use bytemuck::{Pod, Zeroable};

/// Lists of paths.
pub const QUEUES: usize = 11;
/// How many times four words a path takes: without solids, and with them.
pub const STATE_QUADS: [u64; 2] = [26, 36];
/// Side of the blocks in which pixels are taken.
pub const BLOCK: [u32; 2] = [8, 4];

/// Places of the lists.
pub mod queue {
    /// Paths under way; and 1: one is read while the other is written.
    pub const PATHS: u32 = 0;
    /// Shadow rays to the far lights and to the near ones, of paths of either list: four lists.
    pub const SHADOW: u32 = 2;
    /// Those of them that meet what lets light through: four lists.
    pub const GLASS: u32 = 6;
    /// Paths that meet shadow catchers.
    pub const CATCHERS: u32 = 10;
}

/// A list of paths: its length, as an indirect launch of one ray each (`VkTraceRaysIndirectCommandKHR`).
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct QueueHead {
    /// How many.
    pub count: u32,
    /// 1.
    pub one_row: u32,
    /// 1.
    pub one_layer: u32,
    /// Nothing.
    pub unused: u32,
}

/// Lengths of all lists, and what is counted.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct QueueHeads {
    /// The lists.
    pub at: [QueueHead; QUEUES],
    /// Groups that shade: `VkDispatchIndirectCommand`.
    pub groups: [u32; 3],
    /// Rays of paths since the slice began.
    pub path_rays: u32,
    /// Shadow rays since then.
    pub shadow_rays: u32,
}

/// The view, where its film lies, and the memory in which paths are under way.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ViewTable {
    /// Address of the film's sums.
    pub film: u64,
    /// Address of the list of samples that were not finite.
    pub non_finite: u64,
    /// Address of the state of paths.
    pub state: u64,
    /// Address of the lists: [`QUEUES`] times `capacity` numbers of paths.
    pub queues: u64,
    /// Address of the [`QueueHeads`].
    pub heads: u64,
    /// Size of the picture, pixels.
    pub picture: [u32; 2],
    /// The film's top left pixel in the picture.
    pub origin: [u32; 2],
    /// The film's size, pixels.
    pub size: [u32; 2],
    /// Paths that there is room for.
    pub capacity: u32,
    /// Seed of the random stream.
    pub seed: u32,
    /// Number of the frame.
    pub frame: u32,
    /// Most scattering events on a path.
    pub max_depth: u32,
    /// First event after which roulette may end a path; `u32::MAX`: never.
    pub roulette: u32,
    /// Most that light which scattered twice or more may add to a sample at a time.
    pub clamp_to: f32,
    /// The filter: `FilterKind` in its order.
    pub filter_kind: u32,
    /// 1: the plane of albedo holds a colour for each object.
    pub object_colors: u32,
    /// Most scattering events at lobes that are not delta lobes before the last one.
    pub rough_bounces: u32,
    /// The camera.
    pub camera: CameraRecord,
    /// The media around it.
    pub media: MediumStackRecord,
}

/// Push constants of the path tracer.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct Push {
    /// Address of the tables of numbers.
    pub tables: u64,
    /// Address of the [`crate::layout::SceneTable`].
    pub scene: u64,
    /// Address of the [`ViewTable`].
    pub view: u64,
    /// First pixel of the slice in the film.
    pub first_pixel: [u32; 2],
    /// Its columns and rows.
    pub size: [u32; 2],
    /// First sample index.
    pub first_sample: u32,
    /// Samples of each pixel.
    pub sample_count: u32,
    /// Which of the two lists of paths is read.
    pub parity: u32,
    /// Which group of lights shadow rays go to: 0 far, 1 near.
    pub group: u32,
}
