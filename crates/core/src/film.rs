//! The film: exact sums of camera samples. Sums are integers (fixed point, saturating and counted), so that they add in any
//! order to the same bits; a picture then depends neither on threads nor on tiles, pauses or shards.

pub mod state;

use crate::rgb::Rgb;
use bytemuck::{Pod, Zeroable};

/// Fractional bits of the sums: a quantum of 6e-8, a range of 5e11.
const FRACTION_BITS: i32 = 24;
const SCALE: f64 = (1u64 << FRACTION_BITS) as f64;

/// What one camera sample brings to its pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FilmSample {
    /// Radiance along the camera ray.
    pub radiance: Rgb,
    /// What the ray met first; `None`: it left the scene.
    pub first_hit: Option<FirstHit>,
    /// How much the background is covered along the straight line from the camera: 1 less the throughput with which the ray
    /// left the scene, 1 where it did not. Its mean is the picture's alpha.
    pub alpha: f32,
}

/// Auxiliary values of the first hit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FirstHit {
    /// Directional albedo, 0 to 1.
    pub albedo: Rgb,
    /// Shading normal, world space, towards the camera.
    pub normal: [f32; 3],
    /// Metres, world space.
    pub position: [f32; 3],
    /// Distance from the camera along the ray, metres.
    pub depth: f32,
}

/// Sums of one pixel, in quanta of 2⁻²⁴ (squares: 2⁻⁴⁸). Laid out in memory as shaders write it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct PixelSums {
    radiance: [i64; 3],
    luminance: i64,
    luminance_squared: u128,
    albedo: [i64; 3],
    normal: [i64; 3],
    position: [i64; 3],
    depth: i64,
    alpha: i64,
    samples: u32,
    hits: u32,
    saturated: u32,
    /// Always 0: what the alignment of 128 bits leaves over.
    unused: [u32; 3],
}

/// A camera sample that was thrown away because its radiance was not finite. Laid out in memory as shaders write it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Pod, Zeroable)]
pub struct NonFinite {
    /// Row and column in the whole picture (row first, so that they sort in reading order).
    pub row_column: [u32; 2],
    /// Sample index.
    pub sample: u32,
}

/// Most non-finite samples that are named; all are counted.
const NAMED: usize = 16;

/// A part of a picture: a rectangle of its pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crop {
    /// Column and row of its top left pixel, from the top left of the picture.
    pub origin: [u32; 2],
    /// Columns and rows.
    pub size: [u32; 2],
}

/// Sums over a picture, or over a part of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Film {
    width: u32,
    height: u32,
    picture: [u32; 2],
    origin: [u32; 2],
    pixels: Vec<PixelSums>,
    non_finite_count: u64,
    non_finite: Vec<NonFinite>,
}

/// A piece of the work of [`Film::merge_tasks`].
#[derive(Debug)]
pub struct MergeTask<'a> {
    to: &'a mut [PixelSums],
    from: &'a [PixelSums],
}

impl MergeTask<'_> {
    /// Does it.
    pub fn run(self) {
        self.to.iter_mut().zip(self.from).for_each(|(a, b)| a.merge(b));
    }
}

fn quantise(x: f32) -> i64 {
    // Rounds half away from zero, without a call where the processor has no instruction for it. `as` saturates; NaN cannot
    // come here.
    let x = f64::from(x) * SCALE;
    (x + 0.5f64.copysign(x)) as i64
}

impl PixelSums {
    fn add_to(sum: &mut i64, value: i64, saturated: &mut u32) {
        let (total, overflow) = sum.overflowing_add(value);
        *sum = if overflow { sum.saturating_add(value) } else { total };
        *saturated = saturated.saturating_add(u32::from(overflow || value == i64::MAX || value == i64::MIN));
    }

    /// Adds a finite sample.
    fn add(&mut self, s: &FilmSample) {
        let mut saturated = 0;
        for (sum, v) in self.radiance.iter_mut().zip(s.radiance.to_array()) {
            Self::add_to(sum, quantise(v), &mut saturated);
        }
        let y = quantise(s.radiance.luminance());
        Self::add_to(&mut self.luminance, y, &mut saturated);
        let y = u128::from(y.unsigned_abs());
        self.luminance_squared = self.luminance_squared.saturating_add(y * y);
        Self::add_to(&mut self.alpha, quantise(s.alpha), &mut saturated);
        self.samples += 1;
        if let Some(hit) = &s.first_hit {
            self.hits += 1;
            let planes = [
                (&mut self.albedo, hit.albedo.to_array()),
                (&mut self.normal, hit.normal),
                (&mut self.position, hit.position),
            ];
            for (sums, values) in planes {
                for (sum, v) in sums.iter_mut().zip(values) {
                    Self::add_to(sum, quantise(v), &mut saturated);
                }
            }
            Self::add_to(&mut self.depth, quantise(hit.depth), &mut saturated);
        }
        self.saturated = self.saturated.saturating_add(saturated);
    }

    /// Adds the sums of other samples of the same pixel.
    fn merge(&mut self, o: &PixelSums) {
        let mut saturated = 0;
        let pairs = self
            .radiance
            .iter_mut()
            .chain(&mut self.albedo)
            .chain(&mut self.normal)
            .chain(&mut self.position);
        let others = o.radiance.iter().chain(&o.albedo).chain(&o.normal).chain(&o.position);
        for (a, &b) in pairs.zip(others) {
            Self::add_to(a, b, &mut saturated);
        }
        Self::add_to(&mut self.luminance, o.luminance, &mut saturated);
        Self::add_to(&mut self.depth, o.depth, &mut saturated);
        Self::add_to(&mut self.alpha, o.alpha, &mut saturated);
        self.luminance_squared = self.luminance_squared.saturating_add(o.luminance_squared);
        self.samples += o.samples;
        self.hits += o.hits;
        self.saturated = self.saturated.saturating_add(o.saturated).saturating_add(saturated);
    }

    fn mean(sum: i64, n: u32) -> f32 {
        if n == 0 { 0.0 } else { (sum as f64 / SCALE / f64::from(n)) as f32 }
    }
    fn mean3(sums: [i64; 3], n: u32) -> [f32; 3] {
        sums.map(|s| Self::mean(s, n))
    }
    /// Mean radiance.
    pub fn radiance(&self) -> Rgb {
        Rgb::from_array(Self::mean3(self.radiance, self.samples))
    }
    /// Mean albedo of the samples that hit something, times coverage.
    pub fn albedo(&self) -> Rgb {
        Rgb::from_array(Self::mean3(self.albedo, self.samples))
    }
    /// Mean normal of the samples that hit something, times coverage; shorter than 1 where normals differ.
    pub fn normal(&self) -> [f32; 3] {
        Self::mean3(self.normal, self.samples)
    }
    /// Mean position of the samples that hit something, metres.
    pub fn position(&self) -> [f32; 3] {
        Self::mean3(self.position, self.hits)
    }
    /// Mean distance of the samples that hit something, metres; infinite where none did.
    pub fn depth(&self) -> f32 {
        if self.hits == 0 { f32::INFINITY } else { Self::mean(self.depth, self.hits) }
    }
    /// Samples taken.
    pub fn samples(&self) -> u32 {
        self.samples
    }
    /// How much of the background is covered, 0 to 1.
    pub fn alpha(&self) -> f32 {
        Self::mean(self.alpha, self.samples).clamp(0.0, 1.0)
    }
    /// Share of samples that hit something.
    pub fn coverage(&self) -> f32 {
        if self.samples == 0 { 0.0 } else { self.hits as f32 / self.samples as f32 }
    }
    /// Sums that ran out of range.
    pub fn saturated(&self) -> u32 {
        self.saturated
    }
    /// Standard error of the mean luminance, from the spread of the samples taken as independent (for Sobol points an
    /// upper estimate); infinite below two samples.
    pub fn error(&self) -> f32 {
        if self.samples < 2 {
            return f32::INFINITY;
        }
        let n = f64::from(self.samples);
        let mean = self.luminance as f64 / SCALE / n;
        let second = self.luminance_squared as f64 / (SCALE * SCALE) / n;
        ((second - mean * mean).max(0.0) / (n - 1.0)).sqrt() as f32
    }
}

impl Film {
    /// An empty film. Memory is 160 bytes a pixel, whatever the number of samples.
    pub fn new(width: u32, height: u32) -> Self {
        let size = [width, height];
        Self::window(size, Crop { origin: [0, 0], size })
    }
    /// An empty film of a part of a picture. Its pixels are the same, to the bit, as in the whole.
    ///
    /// # Panics
    /// If the part reaches outside.
    pub fn window(picture: [u32; 2], crop: Crop) -> Self {
        let Crop { origin, size: [width, height] } = crop;
        let inside = |i: usize| crop.origin[i].checked_add(crop.size[i]).is_some_and(|end| end <= picture[i]);
        assert!(inside(0) && inside(1), "{crop:?} reaches outside of {picture:?}");
        let pixels = vec![PixelSums::default(); width as usize * height as usize];
        Film { width, height, picture, origin, pixels, non_finite_count: 0, non_finite: Vec::new() }
    }
    /// Bytes that a film of this size takes.
    pub fn bytes(width: u32, height: u32) -> u64 {
        u64::from(width) * u64::from(height) * size_of::<PixelSums>() as u64
    }
    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }
    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }
    /// Columns and rows of the whole picture.
    pub fn picture_size(&self) -> [u32; 2] {
        self.picture
    }
    /// Column and row of the film's top left pixel in the whole picture.
    pub fn origin(&self) -> [u32; 2] {
        self.origin
    }
    /// All pixels, row by row, row 0 on top.
    pub fn pixels(&self) -> &[PixelSums] {
        &self.pixels
    }
    /// Sums of one pixel.
    pub fn pixel(&self, x: u32, y: u32) -> &PixelSums {
        &self.pixels[self.index(x, y)]
    }

    fn index(&self, x: u32, y: u32) -> usize {
        y as usize * self.width as usize + x as usize
    }

    /// Adds one camera sample to a pixel of the film (its own columns and rows). One that is not finite is counted and named instead: it enters the sample count as black, so
    /// that the count stays that of the samples taken.
    pub fn add(&mut self, pixel: [u32; 2], index: u32, sample: &FilmSample) {
        let at = self.index(pixel[0], pixel[1]);
        let sums = &mut self.pixels[at];
        let finite = sample.radiance.is_finite()
            && sample.alpha.is_finite()
            && sample.first_hit.is_none_or(|h| {
                h.albedo.is_finite()
                    && h.depth.is_finite()
                    && h.normal.iter().chain(&h.position).all(|v| v.is_finite())
            });
        if finite {
            sums.add(sample);
        } else {
            sums.add(&FilmSample::default());
            self.non_finite_count += 1;
            let [column, row] = [0, 1].map(|i| self.origin[i] + pixel[i]);
            self.name_non_finite(NonFinite { row_column: [row, column], sample: index });
        }
    }

    fn name_non_finite(&mut self, n: NonFinite) {
        // The smallest few are kept, whatever the order they come in.
        if let Err(at) = self.non_finite.binary_search(&n) {
            self.non_finite.insert(at, n);
            self.non_finite.truncate(NAMED);
        }
    }

    /// How many samples were not finite.
    pub fn non_finite_count(&self) -> u64 {
        self.non_finite_count
    }
    /// The first of them in reading order.
    pub fn non_finite(&self) -> &[NonFinite] {
        &self.non_finite
    }

    /// Adds a film of the same part of the same picture, made of other samples.
    ///
    /// # Panics
    /// If it is not of the same part.
    pub fn merge(&mut self, other: &Film) {
        let place = |f: &Film| (f.picture, f.origin, f.width, f.height);
        assert_eq!(place(self), place(other), "films of different places");
        self.merge_tile(other);
    }

    /// Adds a film of a part (a tile) of what this one holds.
    ///
    /// # Panics
    /// If the tile reaches outside.
    pub fn merge_tile(&mut self, tile: &Film) {
        let crop = Crop { origin: tile.origin, size: [tile.width, tile.height] };
        self.merge_sums(crop, &tile.pixels);
        self.merge_non_finite(tile.non_finite_count, &tile.non_finite);
    }

    /// Adds sums that a backend made of other samples of a part of this film, row by row. Samples that were not finite are in their
    /// counts; [`Film::merge_non_finite`] names them.
    ///
    /// # Panics
    /// If the part reaches outside, or has another number of pixels.
    pub fn merge_sums(&mut self, part: Crop, sums: &[PixelSums]) {
        let at = [0, 1].map(|i| part.origin[i].wrapping_sub(self.origin[i]));
        let fits = |at: u32, size: u32, room: u32| at.checked_add(size).is_some_and(|end| end <= room);
        let [width, height] = part.size;
        assert!(fits(at[0], width, self.width) && fits(at[1], height, self.height), "tile outside the film");
        assert_eq!(sums.len() as u64, u64::from(width) * u64::from(height), "sums of {part:?}");
        for (y, row) in sums.chunks_exact(width.max(1) as usize).enumerate() {
            let to = self.index(at[0], at[1] + y as u32);
            MergeTask { to: &mut self.pixels[to..to + row.len()], from: row }.run();
        }
    }

    /// The same for a part that is the whole film, in about `tasks` pieces of work that may be done at the same time.
    ///
    /// # Panics
    /// If `sums` has another number of pixels.
    pub fn merge_tasks<'a>(
        &'a mut self,
        sums: &'a [PixelSums],
        tasks: usize,
    ) -> impl Iterator<Item = MergeTask<'a>> {
        assert_eq!(sums.len(), self.pixels.len(), "sums of a film");
        let piece = sums.len().div_ceil(tasks.max(1)).max(1);
        self.pixels.chunks_mut(piece).zip(sums.chunks(piece)).map(|(to, from)| MergeTask { to, from })
    }

    /// Counts `count` samples that were not finite and names those of `some` that come first in reading order. `some` must be all of
    /// them, or more than a film names.
    pub fn merge_non_finite(&mut self, count: u64, some: &[NonFinite]) {
        self.non_finite_count += count;
        some.iter().for_each(|n| self.name_non_finite(*n));
    }

    /// Mean radiance of each pixel, row by row.
    pub fn radiance(&self) -> Vec<Rgb> {
        self.pixels.iter().map(PixelSums::radiance).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::unit;

    fn sample(i: u32) -> FilmSample {
        let hit = FirstHit {
            albedo: Rgb::splat(unit(i, 3)),
            normal: [0.0, unit(i, 4), 0.0],
            position: [unit(i, 5); 3],
            depth: 2.0,
        };
        FilmSample {
            radiance: Rgb::new(unit(i, 0), 1e3 * unit(i, 1), unit(i, 2)),
            first_hit: (!i.is_multiple_of(3)).then_some(hit),
            alpha: unit(i, 6),
        }
    }

    #[test]
    fn sums_do_not_depend_on_order_or_parts() {
        let mut whole = Film::new(2, 1);
        let (mut a, mut b) = (Film::new(2, 1), Film::new(2, 1));
        for i in 0..1000 {
            whole.add([1, 0], i, &sample(i));
        }
        for i in (0..1000).rev() {
            if i % 7 < 3 { &mut a } else { &mut b }.add([1, 0], i, &sample(i));
        }
        b.merge(&a);
        assert_eq!(b, whole);
    }

    #[test]
    fn means_and_errors_are_those_of_the_samples() {
        let mut film = Film::new(1, 1);
        let n = 4000;
        let (mut sum, mut squares) = (0.0f64, 0.0f64);
        for i in 0..n {
            let s = sample(i);
            film.add([0, 0], i, &s);
            let y = f64::from(s.radiance.luminance());
            sum += y;
            squares += y * y;
        }
        let (n, p) = (f64::from(n), film.pixel(0, 0));
        let error = ((squares / n - (sum / n) * (sum / n)) / (n - 1.0)).sqrt();
        assert!((f64::from(p.radiance().luminance()) / (sum / n) - 1.0).abs() < 1e-5);
        assert!((f64::from(p.error()) / error - 1.0).abs() < 1e-5);
        assert_eq!(p.depth(), 2.0);
    }

    #[test]
    fn non_finite_and_saturating_samples_are_counted_not_added() {
        let mut film = Film::new(4, 4);
        let bad = FilmSample { radiance: Rgb::new(1.0, f32::NAN, 0.0), first_hit: None, alpha: 0.0 };
        film.add([3, 2], 5, &bad);
        film.add([3, 2], 6, &FilmSample { radiance: Rgb::WHITE, first_hit: None, alpha: 0.5 });
        assert_eq!(film.non_finite_count(), 1);
        assert_eq!(film.non_finite(), [NonFinite { row_column: [2, 3], sample: 5 }]);
        assert_eq!(film.pixel(3, 2).radiance(), Rgb::splat(0.5));
        film.add([0, 0], 0, &FilmSample { radiance: Rgb::splat(1e30), first_hit: None, alpha: 1.0 });
        assert!(film.pixel(0, 0).saturated() > 0 && film.pixel(0, 0).radiance().is_finite());
    }

    #[test]
    fn a_part_keeps_its_place_in_the_picture() {
        let mut part = Film::window([8, 8], Crop { origin: [4, 3], size: [4, 4] });
        assert_eq!((part.width(), part.height(), part.origin(), part.picture_size()), (4, 4, [4, 3], [8, 8]));
        part.add([3, 2], 5, &FilmSample { radiance: Rgb::new(1.0, f32::NAN, 0.0), ..sample(0) });
        part.add([1, 0], 0, &sample(1));
        let mut whole = Film::new(8, 8);
        whole.merge_tile(&part);
        assert_eq!(whole.pixel(5, 3), part.pixel(1, 0));
        assert_eq!(whole.non_finite(), [NonFinite { row_column: [5, 7], sample: 5 }]);
        assert!((whole.pixel(5, 3).alpha() - unit(1, 6)).abs() < 1e-6);
    }

    /// What a backend hands over as memory adds up like a film of its own.
    #[test]
    fn sums_come_in_as_memory_too() {
        assert_eq!(size_of::<PixelSums>(), 160);
        let crop = Crop { origin: [4, 3], size: [2, 3] };
        let mut part = Film::window([8, 8], crop);
        for i in 0..60 {
            part.add([i % 2, i / 2 % 3], i, &sample(i));
        }
        part.add([1, 2], 60, &FilmSample { radiance: Rgb::new(1.0, f32::NAN, 0.0), ..sample(0) });
        let mut whole = Film::new(8, 8);
        whole.add([5, 5], 99, &sample(1));
        let mut other = whole.clone();
        whole.merge_tile(&part);
        let memory: &[u8] = bytemuck::cast_slice(part.pixels());
        other.merge_sums(crop, bytemuck::cast_slice(memory));
        assert_ne!(other, whole, "one is not named yet");
        other.merge_non_finite(1, &[NonFinite { row_column: [5, 5], sample: 60 }]);
        assert_eq!(other, whole);
        for tasks in [0, 1, 7, 64, 1000] {
            let mut pieces = Film::new(8, 8);
            pieces.merge_tasks(whole.pixels(), tasks).for_each(MergeTask::run);
            assert_eq!(pieces.pixels(), whole.pixels(), "{tasks} pieces");
        }
    }

    #[test]
    #[should_panic(expected = "sums of")]
    fn sums_must_be_as_many_as_pixels() {
        let mut film = Film::new(8, 8);
        film.merge_sums(Crop { origin: [0, 0], size: [2, 2] }, &[PixelSums::default(); 3]);
    }

    #[test]
    #[should_panic(expected = "tile outside")]
    fn a_part_of_elsewhere_is_not_added() {
        let mut film = Film::window([8, 8], Crop { origin: [4, 4], size: [4, 4] });
        film.merge_tile(&Film::window([8, 8], Crop { origin: [3, 4], size: [2, 2] }));
    }
}
