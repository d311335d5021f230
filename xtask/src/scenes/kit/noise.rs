//! Noise that repeats: gradient noise (after Perlin 1985) and cells (after Worley 1996) on a lattice whose indices wrap, and the hash
//! behind them.

use glam::DVec2;

/// A number in [0, 1) from a seed and an index, by the finaliser of SplitMix64 (Steele, Lea and Flood 2014).
pub(crate) fn hash01(seed: u64, index: u64) -> f64 {
    (hash(seed, index) >> 11) as f64 / (1u64 << 53) as f64
}

fn hash(seed: u64, index: u64) -> u64 {
    let mut z = seed.wrapping_mul(0xD134_2543_DE82_EF95) ^ index.wrapping_mul(0x9E37_79B9_7F4A_7C15);
    for _ in 0..2 {
        z = (z ^ z >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
    }
    z
}

/// Noise over the plane that repeats after `period` lattice cells in each direction.
#[derive(Clone, Copy)]
pub(crate) struct Noise {
    seed: u64,
    period: [i64; 2],
}

impl Noise {
    /// Noise of its own for each seed; (u, v) in [0, 1)² covers `period` cells.
    pub(crate) fn new(seed: u64, period: [i64; 2]) -> Self {
        Noise { seed, period }
    }

    fn cell(&self, x: i64, y: i64) -> u64 {
        let (x, y) = (x.rem_euclid(self.period[0]), y.rem_euclid(self.period[1]));
        (y as u64) << 32 | x as u64
    }

    /// Smooth noise, about -1 to 1 with mean 0.
    pub(crate) fn at(&self, u: f64, v: f64) -> f64 {
        let p = DVec2::new(u * self.period[0] as f64, v * self.period[1] as f64);
        let base = p.floor();
        let f = p - base;
        let corner = |dx: i64, dy: i64| {
            // The two halves of the hash as a slope in [-1, 1]².
            let bits = hash(self.seed, self.cell(base.x as i64 + dx, base.y as i64 + dy));
            let half = |bits: u64| f64::from(bits as u32) / f64::from(1u32 << 31) - 1.0;
            DVec2::new(half(bits), half(bits >> 32)).dot(f - DVec2::new(dx as f64, dy as f64))
        };
        let fade = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
        let row = |dy| corner(0, dy) + (corner(1, dy) - corner(0, dy)) * fade.x;
        (row(0) + (row(1) - row(0)) * fade.y) * 1.6
    }

    /// Sum of `octaves` of noise, each twice as fine and half as strong; about -1 to 1.
    pub(crate) fn fbm(&self, u: f64, v: f64, octaves: u32) -> f64 {
        let (mut sum, mut weight, mut total) = (0.0, 1.0, 0.0);
        for octave in 0..octaves {
            let finer = Noise {
                seed: self.seed + 7919 * u64::from(octave),
                period: self.period.map(|p| p << octave),
            };
            sum += weight * finer.at(u, v);
            total += weight;
            weight *= 0.5;
        }
        sum / total
    }

    /// Distances to the nearest and the second nearest of one random point in each cell, in cells, and a random number of the nearest.
    pub(crate) fn cells(&self, u: f64, v: f64) -> [f64; 3] {
        let p = DVec2::new(u * self.period[0] as f64, v * self.period[1] as f64);
        let base = p.floor();
        let mut best = [f64::MAX, f64::MAX, 0.0];
        for dy in -1..=1 {
            for dx in -1..=1 {
                let cell = self.cell(base.x as i64 + dx, base.y as i64 + dy);
                let point = DVec2::new(hash01(self.seed + 1, cell), hash01(self.seed + 2, cell));
                let d = (base + DVec2::new(dx as f64, dy as f64) + point - p).length();
                if d < best[0] {
                    best = [d, best[0], hash01(self.seed + 3, cell)];
                } else if d < best[1] {
                    best[1] = d;
                }
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_repeats_without_a_seam_and_is_centred() {
        let noise = Noise::new(5, [4, 6]);
        let (mut sum, mut low, mut high) = (0.0, f64::MAX, f64::MIN);
        for i in 0..64 {
            let x = f64::from(i) / 64.0;
            assert!((noise.fbm(x, 0.0, 4) - noise.fbm(x, 1.0, 4)).abs() < 1e-9);
            assert!((noise.cells(0.0, x)[0] - noise.cells(1.0, x)[0]).abs() < 1e-9);
            for j in 0..64 {
                let value = noise.at(x, f64::from(j) / 64.0);
                (sum, low, high) = (sum + value, low.min(value), high.max(value));
            }
        }
        assert!((sum / 4096.0).abs() < 0.1 && low < -0.4 && high > 0.4 && low > -1.1 && high < 1.1);
    }

    #[test]
    fn hashes_are_spread() {
        let mean = (0..1000).map(|i| hash01(3, i)).sum::<f64>() / 1000.0;
        assert!((mean - 0.5).abs() < 0.03, "{mean}");
        assert!(hash01(0, 0) != hash01(0, 1) && hash01(0, 1) != hash01(1, 0));
    }
}
