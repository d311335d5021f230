//! The work of a render in pieces that take about a tenth of a second each, so that it can be cancelled, tells how far it is and never holds
//! the device for long.

use super::passes::paths_per_sample;
use lumbre_shaders::view::BLOCK;
use std::ops::Range;

/// Seconds that a piece should take.
const GOAL: f64 = 0.1;
/// Camera samples of the first piece, before anything is known of the device.
const FIRST: u64 = 4096;
/// A piece may be so many times as large as the one before: what was measured may have been the easy part of the picture.
const GROWTH: f64 = 4.0;

/// One piece: some pixels of the film, some samples of each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Slice {
    /// Column and row of the film.
    pub(super) first_pixel: [u32; 2],
    /// Columns and rows.
    pub(super) size: [u32; 2],
    /// Sample indices.
    pub(super) samples: Range<u32>,
}

impl Slice {
    /// Camera samples that it takes.
    pub(super) fn count(&self) -> u64 {
        u64::from(self.size[0]) * u64::from(self.size[1]) * self.samples.len() as u64
    }

    /// Paths that these take, with those of blocks that reach outside.
    pub(super) fn paths(&self) -> u64 {
        paths_per_sample(self.size) * self.samples.len() as u64
    }
}

/// How many camera samples fit into a piece, as measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    room: u64,
}

impl Default for Pace {
    fn default() -> Self {
        Pace { room: FIRST }
    }
}

impl Pace {
    /// Pieces as large as there is room for.
    pub(super) fn unbounded() -> Self {
        Pace { room: u64::MAX }
    }

    /// Learns from a piece of `count` samples that took `seconds`.
    pub(super) fn learn(&mut self, count: u64, seconds: f64) {
        let fits = count as f64 * GOAL / seconds.max(1e-6);
        self.room = fits.min(count.max(FIRST) as f64 * GROWTH).max(1.0) as u64;
    }
}

/// The pieces of a render, in order: sample by sample over the whole film where that is long, several samples of each pixel at once
/// where it is short.
#[derive(Clone, Debug)]
pub(super) struct Slices {
    size: [u32; 2],
    samples: Range<u32>,
    /// Most paths of a piece.
    capacity: u64,
    /// Where the current sample (or the whole, before it has begun) goes on.
    at: [u32; 2],
}

impl Slices {
    /// Of a film of `size` pixels. `capacity`: most paths of a piece, at least 4096.
    pub(super) fn new(size: [u32; 2], samples: Range<u32>, capacity: u64) -> Self {
        let samples = if size.contains(&0) { 0..0 } else { samples };
        Slices { size, samples, capacity, at: [0, 0] }
    }

    /// The next piece, about of the size that the pace allows; whole blocks of pixels.
    pub(super) fn next(&mut self, pace: &Pace) -> Option<Slice> {
        if self.samples.is_empty() {
            return None;
        }
        let room = pace.room.min(self.capacity);
        let [width, height] = self.size;
        let (paths, first) = (paths_per_sample(self.size), self.samples.start);
        if self.at == [0, 0] && room >= paths {
            let most = u64::from(self.samples.end - first);
            let count = (room / paths).min(most) as u32;
            self.samples.start += count;
            return Some(Slice { first_pixel: [0, 0], size: self.size, samples: first..first + count });
        }
        // Some rows of blocks, or of a very wide picture a part of one.
        let [x, y] = self.at;
        let columns = (self.capacity / u64::from(BLOCK[1])).min(u64::from(width - x)) as u32;
        let across = u64::from(columns.next_multiple_of(BLOCK[0]));
        let rows = (room / across).min(1 << 30) as u32 / BLOCK[1] * BLOCK[1];
        let rows = if columns < width { BLOCK[1] } else { rows.max(BLOCK[1]) }.min(height - y);
        self.at = if x + columns < width { [x + columns, y] } else { [0, y + rows] };
        if self.at[1] == height {
            self.at = [0, 0];
            self.samples.start += 1;
        }
        Some(Slice { first_pixel: [x, y], size: [columns, rows], samples: first..first + 1 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every sample of every pixel once, whatever the pace.
    #[test]
    fn slices_cover_all_once() {
        for (size, samples, rooms, capacity) in [
            ([7, 5], 0..3, vec![1], 4096),
            ([7, 5], 2..9, vec![3, 10, 35, 64, 1000], 4096),
            ([64, 64], 5..6, vec![4096], 4096),
            ([33, 9], 0..40, vec![40, 100, 480, 4800, 1], 4096),
            ([3001, 9], 0..2, vec![1, 4096, 1 << 20], 4096),
            ([9, 5000], 0..2, vec![4096, u64::MAX], 4096),
            ([1, 9000], 0..3, vec![4096], 4096),
            ([1, 1], 0..1, vec![1], 4096),
        ] {
            let mut seen = vec![0u32; size[0] as usize * size[1] as usize * samples.len()];
            let mut slices = Slices::new(size, samples.clone(), capacity);
            let mut rooms = rooms.into_iter().cycle();
            while let Some(s) = slices.next(&Pace { room: rooms.next().unwrap() }) {
                assert!(s.count() > 0 && s.paths() <= capacity);
                for index in s.samples.clone() {
                    for y in s.first_pixel[1]..s.first_pixel[1] + s.size[1] {
                        for x in s.first_pixel[0]..s.first_pixel[0] + s.size[0] {
                            let pixel = (y * size[0] + x) as usize;
                            seen[pixel * samples.len() + (index - samples.start) as usize] += 1;
                        }
                    }
                }
            }
            assert!(seen.iter().all(|&n| n == 1), "{size:?} {samples:?}");
        }
        assert_eq!(Slices::new([0, 5], 0..9, 4096).next(&Pace::default()), None);
        assert_eq!(Slices::new([5, 5], 3..3, 4096).next(&Pace::default()), None);
    }

    #[test]
    fn the_pace_finds_a_tenth_of_a_second() {
        let mut pace = Pace::default();
        assert_eq!(pace.room, FIRST);
        // Ten million samples a second.
        for _ in 0..10 {
            pace.learn(pace.room, pace.room as f64 / 1e7);
        }
        assert_eq!(pace.room, 1_000_000);
        pace.learn(1_000_000, 10.0);
        assert_eq!(pace.room, 10_000, "slower work at once");
        pace.learn(10_000, 1e-9);
        assert_eq!(pace.room, 40_000, "faster work by and by");
        pace.learn(1, 1e3);
        assert_eq!(pace.room, 1);
    }
}
