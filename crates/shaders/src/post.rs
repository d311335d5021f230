//! What the passes from a film to what a display is sent are told. Twins: `glsl/post/post.glsl`; of what the passes do,
//! `lumbre/src/output.rs`.

use bytemuck::{Pod, Zeroable};
use lumbre_core::color::{Exposure, block_side};
use lumbre_core::film::Crop;
use lumbre_core::tone::{MAX_ABERRATION, ToneCurve, aberration_shrinks};

/// Values of [`PostPush::exposure`].
pub mod exposure {
    /// `Exposure::Auto`.
    pub const AUTO: u32 = 0;
    /// `Exposure::Thesis`.
    pub const THESIS: u32 = 1;
    /// A factor that the host gives.
    pub const FACTOR: u32 = 2;
}

/// Pixels along each side of a work group of the last pass.
pub const DEVELOP_GROUP: u32 = 8;
/// Bytes of the exposure that is kept from frame to frame, all zero before the first: the factor, and 1 once there was one.
pub const STATE_BYTES: u64 = 8;

/// How a film is developed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PostLook {
    /// Brightness.
    pub exposure: Exposure,
    /// Factor on an exposure that follows the picture; 1 for none.
    pub offset: f32,
    /// How far it goes from the last frame's to this one's, 0 to 1 (`lumbre_core::color::ease_share`); 1 for a single picture.
    pub ease: f32,
    /// Tone curve.
    pub tone: ToneCurve,
    /// Darkening towards the corners, 0 to 1.
    pub vignette: f32,
    /// Chromatic aberration, per cent.
    pub aberration: f32,
    /// Colours are those of what is there, with alpha; otherwise before black, and alpha is full.
    pub transparent: bool,
}

/// Where the passes find and put what they work on: addresses on the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PostBuffers {
    /// `PixelSums` of the film, row by row.
    pub film: u64,
    /// Room for the sums of blocks: [`PostPush::block_bytes`].
    pub blocks: u64,
    /// The exposure: [`STATE_BYTES`].
    pub state: u64,
    /// Four bytes for each pixel: red, green, blue, alpha.
    pub display: u64,
}

/// Push constants of all passes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct PostPush {
    /// [`PostBuffers::film`].
    pub film: u64,
    /// [`PostBuffers::blocks`].
    pub blocks: u64,
    /// [`PostBuffers::state`].
    pub state: u64,
    /// [`PostBuffers::display`].
    pub display: u64,
    /// Size of the film, pixels.
    pub size: [u32; 2],
    /// Side of a block, pixels.
    pub block_side: u32,
    /// Blocks along each axis: work groups of the first pass.
    pub block_count: [u32; 2],
    /// One of [`exposure`].
    pub exposure: u32,
    /// The factor of [`exposure::FACTOR`]; on the others, a factor on what they find.
    pub factor: f32,
    /// [`PostLook::ease`].
    pub ease: f32,
    /// The curve: `ToneCurve` in its order.
    pub tone: u32,
    /// [`PostLook::vignette`].
    pub vignette: f32,
    /// From the film's top left corner to the centre of the picture, pixels.
    pub center: [f32; 2],
    /// Half the diagonal of the picture, pixels.
    pub half_diagonal: f32,
    /// 1 where bands are enlarged.
    pub aberrates: u32,
    /// One over how much.
    pub shrinks: [f32; 3],
    /// 1: with alpha.
    pub transparent: u32,
}

impl PostPush {
    /// For a film that holds `crop` of a picture of `picture` pixels.
    pub fn new(buffers: &PostBuffers, picture: [u32; 2], crop: Crop, look: &PostLook) -> Self {
        let (size, origin) = (picture.map(|n| n as f32), crop.origin.map(|n| n as f32));
        let side = block_side(crop.size[0] as usize) as u32;
        let (exposure, factor) = match look.exposure {
            Exposure::Auto => (exposure::AUTO, look.offset),
            Exposure::Thesis => (exposure::THESIS, look.offset),
            // The factor does not depend on the picture.
            ev @ Exposure::Ev(_) => (exposure::FACTOR, ev.factor(&[], 1)),
        };
        let aberration = look.aberration.clamp(-MAX_ABERRATION, MAX_ABERRATION);
        PostPush {
            film: buffers.film,
            blocks: buffers.blocks,
            state: buffers.state,
            display: buffers.display,
            size: crop.size,
            block_side: side,
            block_count: crop.size.map(|n| n.div_ceil(side)),
            exposure,
            factor,
            ease: look.ease.clamp(0.0, 1.0),
            tone: look.tone as u32,
            vignette: look.vignette.clamp(0.0, 1.0),
            center: [0, 1].map(|i| 0.5 * size[i] - origin[i]),
            half_diagonal: 0.5 * (size[0] * size[0] + size[1] * size[1]).sqrt(),
            aberrates: u32::from(aberration != 0.0),
            shrinks: aberration_shrinks(aberration),
            transparent: u32::from(look.transparent),
        }
    }

    /// Bytes that the sums of the blocks of a film of this size take.
    pub fn block_bytes(size: [u32; 2]) -> u64 {
        let side = block_side(size[0] as usize) as u64;
        size.iter().map(|n| u64::from(*n).div_ceil(side)).product::<u64>() * 8
    }

    /// Work groups of the last pass.
    pub fn develop_groups(&self) -> [u32; 2] {
        self.size.map(|n| n.div_ceil(DEVELOP_GROUP))
    }
}
