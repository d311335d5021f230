//! Owen-scrambled Sobol points in four dimensions.
//!
//! Direction numbers: Joe and Kuo 2008, "Constructing Sobol sequences with better two-dimensional projections", the first
//! four dimensions of their table D(6). Scrambling and shuffling: Burley 2020, "Practical Hash-based Owen Scrambling" (JCGT
//! 9.4), with the improved hash constants of Vegdahl 2021, "Building a Better LK Hash".

use crate::hash::hash_combine;

/// Primitive polynomials (degree, interior coefficients) and initial direction numbers of dimensions 1 to 3.
const POLYNOMIALS: [(usize, u32, [u32; 3]); 3] = [(1, 0, [1, 0, 0]), (2, 1, [1, 3, 0]), (3, 1, [1, 3, 1])];

/// Column `j` of each generator matrix, as a binary fraction in 32 bits: index bit `j` toggles it.
///
/// Scrambling works on bits in reverse order, so the tables below hold these columns reversed and are addressed by the
/// reversed index: nothing is turned around in between.
const fn direction_numbers() -> [[u32; 4]; 32] {
    let mut v = [[0u32; 4]; 32];
    let mut j = 0;
    while j < 32 {
        v[j][0] = 1 << (31 - j);
        j += 1;
    }
    let mut d = 0;
    while d < 3 {
        let (s, a, m) = POLYNOMIALS[d];
        let mut j = 0;
        while j < 32 {
            v[j][d + 1] = if j < s {
                m[j] << (31 - j)
            } else {
                let mut x = v[j - s][d + 1] ^ (v[j - s][d + 1] >> s);
                let mut k = 1;
                while k < s {
                    if (a >> (s - 1 - k)) & 1 == 1 {
                        x ^= v[j - k][d + 1];
                    }
                    k += 1;
                }
                x
            };
            j += 1;
        }
        d += 1;
    }
    v
}

/// The points of every value of each byte of the index: four look-ups replace 32 conditional steps.
const fn byte_tables() -> [[[u32; 4]; 256]; 4] {
    let v = direction_numbers();
    let mut t = [[[0u32; 4]; 256]; 4];
    let mut byte = 0;
    while byte < 4 {
        let mut value = 1;
        while value < 256 {
            let low = (value as u32).trailing_zeros() as usize;
            let rest = value & (value - 1);
            let mut d = 0;
            while d < 4 {
                t[byte][value][d] = t[byte][rest][d] ^ v[31 - (byte * 8 + low)][d].reverse_bits();
                d += 1;
            }
            value += 1;
        }
        byte += 1;
    }
    t
}

static TABLES: [[[u32; 4]; 256]; 4] = byte_tables();

/// Point of the plain Sobol sequence with the bits of its coordinates reversed, of the index with its bits reversed.
#[inline]
fn sobol_reversed(reversed_index: u32) -> [u32; 4] {
    let [b0, b1, b2, b3] = reversed_index.to_le_bytes();
    let mut x = TABLES[0][b0 as usize];
    for (t, b) in [(1, b1), (2, b2), (3, b3)] {
        let row = &TABLES[t][b as usize];
        for d in 0..4 {
            x[d] ^= row[d];
        }
    }
    x
}

/// Point `index` of the plain Sobol sequence, as binary fractions.
pub fn sobol(index: u32) -> [u32; 4] {
    sobol_reversed(index.reverse_bits()).map(u32::reverse_bits)
}

/// A hash in which each bit is moved only by those below it: an Owen scramble of the bit-reversed value.
#[inline]
fn laine_karras(mut x: u32, seed: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

/// Point `index` of the Sobol sequence in an order shuffled by `key` (nested uniform scramble of the index, Owen 1995), its coordinates
/// not yet scrambled and their bits reversed. Every aligned power-of-two block of indices stays a Sobol net.
#[inline]
pub(super) fn shuffled(index: u32, key: u32) -> [u32; 4] {
    sobol_reversed(laine_karras(index.reverse_bits(), key))
}

/// Coordinate `d` of such a point, scrambled by `key`: a binary fraction.
#[inline]
pub(super) fn scrambled(reversed: u32, key: u32, d: u32) -> u32 {
    laine_karras(reversed, hash_combine(key ^ 0xa511_e9b3, d)).reverse_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// First points of Joe and Kuo's sequence in natural (not Gray-code) order, dimensions 0 to 3.
    #[test]
    fn first_points_are_the_published_ones() {
        let f = |i: u32| sobol(i).map(|x| x as f64 / 4294967296.0);
        assert_eq!(f(0), [0.0; 4]);
        assert_eq!(f(1), [0.5; 4]);
        assert_eq!(f(2), [0.25, 0.75, 0.75, 0.75]);
        assert_eq!(f(3), [0.75, 0.25, 0.25, 0.25]);
        assert_eq!(f(4), [0.125, 0.625, 0.375, 0.125]);
        assert_eq!(f(6), [0.375, 0.375, 0.625, 0.875]);
    }

    /// Of 64 points of dimensions 2 and 3 no more than two fall into any of 8 x 8 cells.
    #[test]
    fn the_second_pair_is_stratified_too() {
        let mut seen = [0; 64];
        for i in 0..64 {
            let p = shuffled(i, 5);
            let [x, y] = [2, 3].map(|d| scrambled(p[d], 5, d as u32));
            seen[((x >> 29) << 3 | y >> 29) as usize] += 1;
        }
        let empty = seen.iter().filter(|&&n| n == 0).count();
        assert!(empty <= 32 && seen.iter().all(|&n| n <= 2), "{seen:?}");
    }

    /// Every pair of the first two dimensions is a (0, m, 2)-net in each aligned block, scrambled or not.
    #[test]
    fn blocks_are_nets() {
        for key in [1u32, 77, 0xdead_beef] {
            for block in [0u32, 3] {
                for log in 0..=8 {
                    let (a, b) = (log, 8 - log);
                    let mut seen = [false; 256];
                    for i in 0..256 {
                        let p = [0, 1].map(|d| scrambled(shuffled(block * 256 + i, key)[d], key, d as u32));
                        let x = if a == 0 { 0 } else { p[0] >> (32 - a) };
                        let y = if b == 0 { 0 } else { p[1] >> (32 - b) };
                        let cell = ((x << b) | y) as usize;
                        assert!(
                            !seen[cell],
                            "key {key} block {block}: cell {cell} of {a}+{b} bits hit twice"
                        );
                        seen[cell] = true;
                    }
                }
            }
        }
    }
}
