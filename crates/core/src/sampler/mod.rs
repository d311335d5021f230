//! The one random stream: a camera sample is a pure function of (frame, pixel, sample index, dimension, seed), the same
//! integers on both backends.
//!
//! The dimensions are a fixed table. They are read in sets of at most four, each set a small Owen-scrambled Sobol sequence of
//! its own (padding): two-dimensional quantities that belong together (a direction, a point on a light) always come from
//! one set. Inserting a dimension would change every reference picture, so room for what is to come is kept.

pub mod sobol;

use crate::hash::{hash_combine, hash_u32, to_unit};

/// How the unit hypercube is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum SamplerKind {
    /// Owen-scrambled Sobol points, shuffled per pixel and set.
    #[default]
    Sobol,
    /// Independent uniform numbers.
    Independent,
}

/// Filter and lens: the first set of a camera sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSample {
    /// Position within the pixel's filter.
    pub filter: [f32; 2],
    /// Position on the lens.
    pub lens: [f32; 2],
}

/// The numbers that choose where a path goes on from a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionSample {
    /// Direction.
    pub direction: [f32; 2],
    /// Which lobe.
    pub lobe: f32,
    /// Russian roulette.
    pub roulette: f32,
}

/// The numbers that choose a light and a point on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightPointSample {
    /// Point on the light.
    pub point: [f32; 2],
    /// Which light.
    pub light: f32,
}

/// Sets before the first vertex: (filter, lens), (time, wavelength).
const CAMERA_SETS: u32 = 2;
/// Sets of a vertex: (direction, lobe, roulette), (point on light, light, medium distance), (phase, one to spare).
const VERTEX_SETS: u32 = 3;

/// The stream of one camera sample.
#[derive(Clone, Copy, Debug)]
pub struct Sampler {
    kind: SamplerKind,
    key: u32,
    index: u32,
}

impl Sampler {
    /// The stream of sample `index` at `pixel`. Streams of different pixels, seeds and frames are independent.
    #[inline]
    pub fn new(kind: SamplerKind, seed: u32, frame: u32, pixel: [u32; 2], index: u32) -> Self {
        let key = hash_combine(hash_combine(hash_combine(hash_u32(seed), frame), pixel[0]), pixel[1]);
        Sampler { kind, key, index }
    }

    /// The numbers of the camera ray.
    #[inline]
    pub fn camera(&self) -> CameraSample {
        let s = self.set(0);
        CameraSample { filter: [s[0], s[1]], lens: [s[2], s[3]] }
    }

    /// Moment in the shutter interval.
    #[inline]
    pub fn time(&self) -> f32 {
        self.set(1)[0]
    }

    /// Wavelength.
    #[inline]
    pub fn wavelength(&self) -> f32 {
        self.set(1)[1]
    }

    /// The numbers that send the path on from vertex `k` (0 is the first surface hit).
    #[inline]
    pub fn direction(&self, k: u32) -> DirectionSample {
        let s = self.set(CAMERA_SETS + VERTEX_SETS * k);
        DirectionSample { direction: [s[0], s[1]], lobe: s[2], roulette: s[3] }
    }

    /// The numbers that pick a point on a light from vertex `k`.
    #[inline]
    pub fn light(&self, k: u32) -> LightPointSample {
        let s = self.set(CAMERA_SETS + VERTEX_SETS * k + 1);
        LightPointSample { point: [s[0], s[1]], light: s[2] }
    }

    /// The key that stochastic coverage hashes together with vertex, instance and primitive.
    #[inline]
    pub fn coverage_key(&self) -> u32 {
        hash_combine(self.key, self.index ^ 0x5bd1_e995)
    }

    #[inline]
    fn set(&self, set: u32) -> [f32; 4] {
        self.set_bits(set).map(to_unit)
    }

    /// The raw integers of one set, as both backends must produce them.
    #[inline]
    pub fn set_bits(&self, set: u32) -> [u32; 4] {
        let key = hash_combine(self.key, set);
        match self.kind {
            SamplerKind::Sobol => sobol::shuffled_scrambled(self.index, key),
            SamplerKind::Independent => {
                let h = hash_combine(key, self.index);
                [h, hash_combine(h, 1), hash_combine(h, 2), hash_combine(h, 3)]
            }
        }
    }
}
