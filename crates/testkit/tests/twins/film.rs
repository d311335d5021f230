//! `film.glsl` against `lumbre_core::film`: the same bits, whatever is added to whatever sums.

use super::columns::Numbers;
use super::{evaluate, kernel};
use bytemuck::{Pod, Zeroable};
use lumbre_core::film::state::{FilmState, WORDS};
use lumbre_core::film::{Crop, Film, FilmSample, FirstHit, NonFinite, PixelSums};
use lumbre_core::rgb::Rgb;

/// Samples that each pixel gets.
const SAMPLES: usize = 8;
/// Number of the first of them.
const FIRST: u32 = 7;

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Sample {
    radiance: [f32; 3],
    has_hit: u32,
    albedo: [f32; 3],
    normal: [f32; 3],
    position: [f32; 3],
    depth: f32,
    alpha: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Input {
    start: PixelSums,
    pixel: [u32; 2],
    samples: [Sample; SAMPLES],
    unused: [u32; 2],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Output {
    sums: PixelSums,
    count: u32,
    named: [NonFinite; SAMPLES],
    unused: [u32; 3],
}

/// Numbers of every size, and what lies at the ends of rounding and of ranges.
fn number(n: &mut Numbers, kind: u32) -> f32 {
    const QUANTUM: f32 = 1.0 / 16_777_216.0;
    let corners = [
        0.0,
        -0.0,
        QUANTUM,
        0.5 * QUANTUM,
        -0.5 * QUANTUM,
        0.499_999_97 * QUANTUM,
        1.5 * QUANTUM,
        -2.5 * QUANTUM,
        f32::MIN_POSITIVE,
        1e-42,
        1.0,
        549_755_780_000.0, // the last below 2^39, where sums end
        549_755_813_888.0,
        -549_755_813_888.0,
        -549_755_900_000.0,
        f32::MAX,
        f32::MIN,
    ];
    match kind {
        0 => n.unit(),
        1 => n.between(-1.0, 1.0) * n.scale(1e-8, 1e8),
        // Halfway between quanta.
        2 => (n.below(4096) as f32 - 2047.5) * QUANTUM,
        3 => n.one_of(&corners),
        // Any bits: one in 256 is no number.
        _ => f32::from_bits(n.word()),
    }
}

fn start(n: &mut Numbers) -> PixelSums {
    let mut words = [0u32; WORDS];
    if n.below(3) == 0 {
        words.iter_mut().for_each(|w| *w = n.word());
        // Sums about to run over, at both ends.
        for high in words[..30].chunks_exact_mut(2) {
            let end = n.one_of(&[0x7fff_ffff, 0x8000_0000, 0x7fff_fff0, 0x8000_000f, high[1], 0, u32::MAX]);
            high[1] = end;
        }
        if n.below(2) == 0 {
            words[30..34].fill(u32::MAX);
        }
        let samples = n.below(1 << 30);
        words[34..].copy_from_slice(&[
            samples,
            n.below(samples + 1),
            n.one_of(&[0, 5, u32::MAX - 3, u32::MAX]),
        ]);
    }
    PixelSums::from_words(&words)
}

fn inputs() -> Vec<Input> {
    (0..12_500)
        .map(|row| {
            let n = &mut Numbers::new(row);
            let kind = n.below(5);
            let three = |n: &mut Numbers| [0; 3].map(|_| number(n, kind));
            let start = start(n);
            let pixel = [n.below(4096), n.below(4096)];
            let samples = [(); SAMPLES].map(|()| Sample {
                radiance: three(n),
                has_hit: n.below(2),
                albedo: three(n),
                normal: three(n),
                position: three(n),
                depth: number(n, kind),
                alpha: number(n, kind),
            });
            Input { start, pixel, samples, unused: [0; 2] }
        })
        .collect()
}

fn twin(i: &Input) -> Output {
    let picture = i.pixel.map(|p| p + 1);
    let crop = Crop { origin: i.pixel, size: [1, 1] };
    let state =
        FilmState { picture, crop, pixels: vec![i.start], non_finite_count: 0, non_finite: Vec::new() };
    let mut film = Film::restore(state).expect("a film of one pixel");
    for (index, s) in (FIRST..).zip(&i.samples) {
        let hit = FirstHit {
            albedo: Rgb::from_array(s.albedo),
            normal: s.normal,
            position: s.position,
            depth: s.depth,
        };
        let first_hit = (s.has_hit == 1).then_some(hit);
        let sample = FilmSample { radiance: Rgb::from_array(s.radiance), first_hit, alpha: s.alpha };
        film.add([0, 0], index, &sample);
    }
    let mut named = [NonFinite::zeroed(); SAMPLES];
    named[..film.non_finite().len()].copy_from_slice(film.non_finite());
    Output { sums: *film.pixel(0, 0), count: film.non_finite_count() as u32, named, unused: [0; 3] }
}

/// How many outputs differ in any bit; `None` without a device.
fn differing(rust: impl Fn(&Input) -> Output) -> Option<usize> {
    let inputs = inputs();
    let mut gpu: Vec<Output> = evaluate(kernel!("film"), &[], &inputs)?;
    for o in &mut gpu {
        // What the list has no entries for was never written.
        o.named[o.count as usize..].fill(NonFinite::zeroed());
        o.unused = [0; 3];
    }
    let differ = |(i, gpu): (&Input, &Output)| {
        let here = rust(i);
        let differs = bytemuck::bytes_of(&here) != bytemuck::bytes_of(gpu);
        differs.then_some((*i, here, *gpu))
    };
    let all: Vec<_> = inputs.iter().zip(&gpu).filter_map(differ).collect();
    if let Some(first) = all.first() {
        println!("{first:#?}");
    }
    Some(all.len())
}

#[test]
fn sums_are_the_same_bits() {
    assert_eq!(differing(twin).unwrap_or(0), 0);
}

/// Inputs are what they are meant to be: some run over, some are no numbers, most are neither.
#[test]
fn inputs_reach_the_ends() {
    let all: Vec<(Input, Output)> = inputs().into_iter().map(|i| (i, twin(&i))).collect();
    let share =
        |f: fn(&(Input, Output)) -> bool| all.iter().filter(|io| f(io)).count() as f64 / all.len() as f64;
    let over = share(|(i, o)| o.sums.saturated() > i.start.saturated());
    let bad = share(|(_, o)| o.count > 0);
    assert!((0.3..0.8).contains(&over) && (0.03..0.5).contains(&bad), "{over} {bad}");
}

/// A quantum more in one band, a sample left out, or its number taken for the next are found.
#[test]
fn other_sums_are_found() {
    let more = |i: &Input| {
        let mut i = *i;
        i.samples[3].radiance[1] += 1e-3;
        twin(&i)
    };
    let Some(found) = differing(more) else { return };
    assert!(found > 4_000, "{found}");
    let fewer = |i: &Input| {
        let mut words = twin(i).sums.to_words();
        words[34] = words[34].saturating_sub(1);
        Output { sums: PixelSums::from_words(&words), ..twin(i) }
    };
    assert!(differing(fewer).unwrap() > 12_000);
    let misnamed = |i: &Input| {
        let mut o = twin(i);
        o.named.iter_mut().for_each(|n| n.sample ^= 1);
        o
    };
    assert!(differing(misnamed).unwrap() > 400);
}
