//! What the path tracer's shaders are told of a view. Twin: `glsl/path/push.glsl`.

use crate::camera::CameraRecord;
use crate::medium::MediumStackRecord;
use bytemuck::{Pod, Zeroable};

/// Numbers of rays are spread over this many counters of each kind, so that threads do not wait for each other.
pub const RAY_COUNTERS: usize = 4096;

/// The view, and where its film lies.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ViewTable {
    /// Address of the film's sums.
    pub film: u64,
    /// Address of the list of samples that were not finite.
    pub non_finite: u64,
    /// Address of [`RAY_COUNTERS`] numbers of rays of paths, then as many of shadow rays.
    pub rays: u64,
    /// Size of the picture, pixels.
    pub picture: [u32; 2],
    /// The film's top left pixel in the picture.
    pub origin: [u32; 2],
    /// The film's size, pixels.
    pub size: [u32; 2],
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
    /// The camera.
    pub camera: CameraRecord,
    /// The media around it.
    pub media: MediumStackRecord,
    /// Nothing: keeps the addresses aligned.
    pub unused: u32,
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
    /// Pixel of the film at launch index 0, 0.
    pub first_pixel: [u32; 2],
    /// First sample index.
    pub first_sample: u32,
    /// Samples to take of each pixel.
    pub sample_count: u32,
}
