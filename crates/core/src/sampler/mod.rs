//! The one random stream: a camera sample is a pure function of (frame, pixel, sample index, dimension, seed), the same
//! integers on both backends.
//!
//! The dimensions are a fixed table. They are read in sets of four, each set a small Owen-scrambled Sobol sequence of its own
//! (padding): two-dimensional quantities (a direction, a point on a light) always come from one set, and those that follow one
//! another on a path share it: the place in the pixel and the point on the light seen from the first vertex; the direction from
//! a vertex and the point on the light seen from the next. Only the numbers that are asked for are scrambled. Inserting a dimension would
//! change every reference picture, so room for what is to come is kept.
//!
//! | set | its four dimensions |
//! |---|---|
//! | 0 | filter x, y; point on the light from vertex 0, x, y |
//! | 1 | lens x, y; time; wavelength |
//! | 2 + 3k | direction from vertex k, x, y; point on the light from vertex k + 1, x, y |
//! | 3 + 3k | lobe; light; roulette; medium distance, at vertex k |
//! | 4 + 3k | phase function at vertex k, x, y; point on a light of the second group, x, y |

pub mod sobol;

use crate::hash::{hash_combine, hash_u32, to_unit};

/// How the unit hypercube is sampled. Shaders number the kinds in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum SamplerKind {
    /// Owen-scrambled Sobol points, shuffled per pixel and set.
    #[default]
    Sobol,
    /// Independent uniform numbers.
    Independent,
}

/// Sets before the first vertex.
const CAMERA_SETS: u32 = 2;
/// Sets of a vertex.
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

    /// Position within the pixel's filter.
    #[inline]
    pub fn filter(&self) -> [f32; 2] {
        self.set(0).pair(0)
    }

    /// Position on the lens.
    #[inline]
    pub fn lens(&self) -> [f32; 2] {
        self.set(1).pair(0)
    }

    /// Moment in the shutter interval.
    #[inline]
    pub fn time(&self) -> f32 {
        self.set(1).number(2)
    }

    /// Wavelength.
    #[inline]
    pub fn wavelength(&self) -> f32 {
        self.set(1).number(3)
    }

    /// Direction in which the path goes on from vertex `k` (0 is the first surface hit).
    #[inline(always)]
    pub fn direction(&self, k: u32) -> [f32; 2] {
        self.set(CAMERA_SETS + VERTEX_SETS * k).pair(0)
    }

    /// Point on a light as seen from vertex `k`.
    #[inline(always)]
    pub fn light_point(&self, k: u32) -> [f32; 2] {
        self.set(if k == 0 { 0 } else { CAMERA_SETS + VERTEX_SETS * (k - 1) }).pair(2)
    }

    /// Point on a light of the second group as seen from vertex `k`, where both groups have lights.
    #[inline]
    pub fn second_light_point(&self, k: u32) -> [f32; 2] {
        self.set(CAMERA_SETS + VERTEX_SETS * k + 2).pair(2)
    }

    /// Whether light of a faint group is asked for at vertex `k`. Apart from the table, since it is rarely needed.
    #[inline]
    pub fn light_roulette(&self, k: u32) -> f32 {
        to_unit(hash_combine(self.coverage_key() ^ 0x3c6e_f372, k))
    }

    /// Which lobe scatters at vertex `k`.
    #[inline]
    pub fn lobe(&self, k: u32) -> f32 {
        self.choices(k).number(0)
    }

    /// Where on a light of small probability, as seen from vertex `k`: see `sample_light` of the backends.
    #[inline]
    pub fn light(&self, k: u32) -> f32 {
        self.choices(k).number(1)
    }

    /// Russian roulette after vertex `k`.
    #[inline]
    pub fn roulette(&self, k: u32) -> f32 {
        self.choices(k).number(2)
    }

    #[inline(always)]
    fn choices(&self, k: u32) -> Set {
        self.set(CAMERA_SETS + VERTEX_SETS * k + 1)
    }

    /// The key that stochastic coverage hashes together with vertex, instance and primitive.
    #[inline]
    pub fn coverage_key(&self) -> u32 {
        hash_combine(self.key, self.index ^ 0x5bd1_e995)
    }

    /// Stream `which` of the `part`-th of `parts` draws that this sample takes apart from the table, for what needs many numbers at one vertex.
    /// Where `parts` is a power of two, those of one sample are stratified among themselves.
    #[inline]
    pub fn split(&self, which: u32, parts: u32, part: u32) -> Self {
        let key = hash_combine(self.key, hash_u32(which ^ 0x9e37_79b9));
        Sampler { key, index: self.index.wrapping_mul(parts).wrapping_add(part), ..*self }
    }

    /// One set of the table. Always inlined: callers use one or two of its numbers, and the others need not be made.
    #[inline(always)]
    pub fn set(&self, set: u32) -> Set {
        let key = hash_combine(self.key, set);
        match self.kind {
            SamplerKind::Sobol => Set { kind: self.kind, bits: sobol::shuffled(self.index, key), key },
            SamplerKind::Independent => {
                Set { kind: self.kind, bits: [hash_combine(key, self.index); 4], key }
            }
        }
    }
}

/// Four numbers of the stream, of which those are finished that are asked for.
#[derive(Clone, Copy, Debug)]
pub struct Set {
    kind: SamplerKind,
    bits: [u32; 4],
    key: u32,
}

impl Set {
    /// The raw integer of dimension `d` (0 to 3), as both backends must produce it.
    #[inline]
    pub fn bits(&self, d: u32) -> u32 {
        let bits = self.bits[d as usize];
        match self.kind {
            SamplerKind::Sobol => sobol::scrambled(bits, self.key, d),
            SamplerKind::Independent => hash_combine(bits, d),
        }
    }

    /// Dimension `d` as a number in [0, 1).
    #[inline]
    pub fn number(&self, d: u32) -> f32 {
        to_unit(self.bits(d))
    }

    /// Dimensions `d` and `d + 1`.
    #[inline]
    pub fn pair(&self, d: u32) -> [f32; 2] {
        [self.number(d), self.number(d + 1)]
    }
}
