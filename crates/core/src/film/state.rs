//! The exact sums of a film as plain 32-bit words, out and in again, so that a file can carry them from one machine to
//! another and parts of a render add up to the bits of the whole.

use super::{Crop, Film, NAMED, NonFinite, PixelSums};

/// Words of one pixel.
pub const WORDS: usize = 37;

/// The 64-bit sums in the order of their words, the low half of each first.
const LONG: [&str; 15] = [
    "radiance.R",
    "radiance.G",
    "radiance.B",
    "luminance.Y",
    "albedo.R",
    "albedo.G",
    "albedo.B",
    "normal.X",
    "normal.Y",
    "normal.Z",
    "position.X",
    "position.Y",
    "position.Z",
    "depth.Z",
    "alpha.A",
];

/// What follows them: the sum of squares, 128 bits from the lowest word on, and the counts.
const REST: [&str; 7] = [
    "luminanceSquared.Y0",
    "luminanceSquared.Y1",
    "luminanceSquared.Y2",
    "luminanceSquared.Y3",
    "counts.S",
    "counts.H",
    "counts.O",
];

/// What each word holds: group and channel, such as `radiance.R0` for the low half of the sum of red. `counts` are samples,
/// hits and sums that ran over.
pub fn word_names() -> impl Iterator<Item = String> {
    let halves = LONG.into_iter().flat_map(|name| [0, 1].map(|half| format!("{name}{half}")));
    halves.chain(REST.into_iter().map(String::from))
}

impl PixelSums {
    /// The sums as words.
    pub fn to_words(&self) -> [u32; WORDS] {
        // By name, so that a new sum cannot be forgotten here.
        let PixelSums {
            radiance,
            luminance,
            luminance_squared,
            albedo,
            normal,
            position,
            depth,
            alpha,
            samples,
            hits,
            saturated,
            unused: _,
        } = *self;
        let mut words = [0; WORDS];
        let long = radiance.into_iter().chain([luminance]).chain(albedo).chain(normal).chain(position);
        let long = long.chain([depth, alpha]).flat_map(|v| [v as u32, (v as u64 >> 32) as u32]);
        let squared = [0, 32, 64, 96].map(|shift| (luminance_squared >> shift) as u32);
        let all = long.chain(squared).chain([samples, hits, saturated]);
        for (word, value) in words.iter_mut().zip(all) {
            *word = value;
        }
        words
    }

    /// The sums that [`PixelSums::to_words`] gave.
    pub fn from_words(words: &[u32; WORDS]) -> Self {
        let long = |i: usize| (u64::from(words[2 * i]) | u64::from(words[2 * i + 1]) << 32) as i64;
        let three = |i: usize| [long(i), long(i + 1), long(i + 2)];
        let [squares @ .., samples, hits, saturated] = &words[2 * LONG.len()..] else {
            unreachable!("there are {WORDS} words")
        };
        PixelSums {
            radiance: three(0),
            luminance: long(3),
            luminance_squared: squares.iter().rev().fold(0, |sum, w| sum << 32 | u128::from(*w)),
            albedo: three(4),
            normal: three(7),
            position: three(10),
            depth: long(13),
            alpha: long(14),
            samples: *samples,
            hits: *hits,
            saturated: *saturated,
            unused: [0; 3],
        }
    }
}

/// Everything that a film holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilmState {
    /// Columns and rows of the whole picture.
    pub picture: [u32; 2],
    /// The part of it that the film holds.
    pub crop: Crop,
    /// Sums of its pixels, row by row.
    pub pixels: Vec<PixelSums>,
    /// How many samples were not finite.
    pub non_finite_count: u64,
    /// The first of them in reading order: all, or as many as are named.
    pub non_finite: Vec<NonFinite>,
}

impl Film {
    /// A film that was saved: its sums, and what is known of samples that were not finite. `None` if that cannot be the state
    /// of any film.
    pub fn restore(state: FilmState) -> Option<Film> {
        let FilmState { picture, crop, pixels, non_finite_count, non_finite } = state;
        let end = |i: usize| crop.origin[i].checked_add(crop.size[i]);
        let inside = |i: usize| end(i).is_some_and(|end| end <= picture[i]);
        let count = u64::from(crop.size[0]) * u64::from(crop.size[1]);
        if !(inside(0) && inside(1) && count == pixels.len() as u64) {
            return None;
        }
        if pixels.iter().any(|p| p.hits > p.samples) {
            return None;
        }
        let samples: u64 = pixels.iter().map(|p| u64::from(p.samples)).sum();
        let named = non_finite.len() as u64 == non_finite_count.min(NAMED as u64);
        let ordered = non_finite.windows(2).all(|two| two[0] < two[1]);
        let here = |n: &NonFinite| {
            let [row, column] = n.row_column;
            let at = [column, row];
            (0..2).all(|i| at[i] >= crop.origin[i] && Some(at[i]) < end(i))
        };
        if !(named && ordered && non_finite_count <= samples && non_finite.iter().all(here)) {
            return None;
        }
        let [width, height] = crop.size;
        Some(Film { width, height, picture, origin: crop.origin, pixels, non_finite_count, non_finite })
    }

    /// The part of the picture that it holds.
    pub fn crop(&self) -> Crop {
        Crop { origin: self.origin, size: [self.width, self.height] }
    }

    /// The number of samples of every pixel; `None` where they differ, as in a render that was interrupted.
    pub fn even_samples(&self) -> Option<u32> {
        let first = self.pixels.first()?.samples;
        self.pixels.iter().all(|p| p.samples == first).then_some(first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{FilmSample, FirstHit};
    use crate::rgb::Rgb;

    fn film() -> Film {
        let mut film = Film::window([9, 8], Crop { origin: [2, 3], size: [3, 2] });
        let hit = FirstHit {
            albedo: Rgb::new(0.1, 0.2, 0.3),
            normal: [-0.5, 0.25, -0.75],
            position: [-1e4, 2.0, 3e5],
            depth: 7.5,
        };
        for i in 0..6 {
            let radiance = Rgb::new(1e9 * i as f32, 0.25, 3.0);
            let sample = FilmSample { radiance, first_hit: (i != 2).then_some(hit), alpha: 0.125 };
            film.add([i % 3, i / 3], 4, &sample);
        }
        film.add([1, 1], 5, &FilmSample { radiance: Rgb::splat(1e30), first_hit: None, alpha: 1.0 });
        film.add([2, 1], 5, &FilmSample { radiance: Rgb::splat(f32::NAN), first_hit: None, alpha: 1.0 });
        film
    }

    fn state(film: &Film) -> FilmState {
        let again = film.pixels().iter().map(|p| PixelSums::from_words(&p.to_words()));
        FilmState {
            picture: film.picture_size(),
            crop: film.crop(),
            pixels: again.collect(),
            non_finite_count: film.non_finite_count(),
            non_finite: film.non_finite().to_vec(),
        }
    }

    #[test]
    fn a_film_comes_back_to_the_bit() {
        let film = film();
        assert_eq!(Film::restore(state(&film)).as_ref(), Some(&film));
        assert_eq!(film.even_samples(), None);
        assert_eq!(Film::new(3, 3).even_samples(), Some(0));
    }

    #[test]
    fn every_word_counts_and_has_a_name_of_its_own() {
        let sums = *film().pixel(1, 1);
        let words = sums.to_words();
        for i in 0..WORDS {
            let mut other = words;
            other[i] ^= 1 << 7;
            let other = PixelSums::from_words(&other);
            assert_ne!(other, sums, "word {i}");
            assert_ne!(other.to_words(), words, "word {i}");
        }
        let mut names: Vec<String> = word_names().collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), WORDS);
    }

    #[test]
    fn what_no_film_can_be_is_refused() {
        let good = state(&film());
        let refused = |change: fn(&mut FilmState)| {
            let mut bad = good.clone();
            change(&mut bad);
            Film::restore(bad).is_none()
        };
        assert!(!refused(|_| ()));
        assert!(refused(|s| s.picture[0] = 4));
        assert!(refused(|s| s.crop.origin[1] = u32::MAX));
        assert!(refused(|s| s.pixels.truncate(5)));
        assert!(refused(|s| s.pixels[0].hits = 2));
        assert!(refused(|s| s.non_finite_count = 0));
        assert!(refused(|s| s.non_finite_count = 2));
        assert!(refused(|s| s.non_finite.clear()));
        assert!(refused(|s| s.non_finite[0].row_column = [4, 5]));
        assert!(refused(|s| {
            s.non_finite.push(s.non_finite[0]);
            s.non_finite_count = 2;
        }));
    }
}
