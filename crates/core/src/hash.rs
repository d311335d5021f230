//! Integer hashes: the source of every random number, the same on both backends.

/// A 32-bit hash with good avalanche. Wellons 2018, "Prospecting for Hash Functions", `lowbias32`.
#[inline]
pub fn hash_u32(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// Folds one more word into a hash.
#[inline]
pub fn hash_combine(h: u32, v: u32) -> u32 {
    hash_u32(h ^ v.wrapping_mul(0x9e37_79b9).wrapping_add(0x85eb_ca6b))
}

/// The top 24 bits as a float in [0, 1).
#[inline]
pub fn to_unit(x: u32) -> f32 {
    (x >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// A float in [0, 1) from two words.
#[inline]
pub fn unit(a: u32, b: u32) -> f32 {
    to_unit(hash_combine(hash_u32(a), b))
}
