//! `sampler.glsl` and `sampler/sobol.glsl` against `lumbre_core::sampler`: the same bits, for both kinds of streams.

use super::columns::Numbers;
use super::{evaluate_with, kernel};
use bytemuck::{Pod, Zeroable};
use lumbre_core::sampler::{Sampler, SamplerKind};
use lumbre_vulkan::Specialisation;

/// `SAMPLER_KIND` of the shader.
const KIND_CONSTANT: u32 = 30;

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Input {
    seed: u32,
    frame: u32,
    pixel: [u32; 2],
    index: u32,
    vertex: u32,
    which: u32,
    parts: u32,
    part: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Output {
    bits: [u32; 4],
    filter: [f32; 2],
    lens: [f32; 2],
    time: f32,
    wavelength: f32,
    direction: [f32; 2],
    light_point: [f32; 2],
    second_light_point: [f32; 2],
    light_roulette: f32,
    lobe: f32,
    light: f32,
    roulette: f32,
    coverage_key: u32,
    split: [f32; 2],
}

/// Random streams; every single bit of the index, since Sobol points are linear in them; ends of ranges.
fn inputs() -> Vec<Input> {
    let random = (0..100_000).map(|row| {
        let n = &mut Numbers::new(row);
        Input {
            seed: n.below(5),
            frame: n.below(3),
            pixel: [n.below(4096), n.below(4096)],
            index: n.word() >> n.below(32),
            vertex: n.below(12),
            which: n.below(130),
            parts: 1 << n.below(7),
            part: n.below(64),
        }
    });
    let mut all: Vec<_> = random.collect();
    let first = all[0];
    all.extend((0..32).map(|bit| Input { index: 1 << bit, ..first }));
    for index in [0, u32::MAX, u32::MAX - 1] {
        for vertex in [0, 1, 65_535] {
            all.push(Input { index, vertex, pixel: [u32::MAX; 2], seed: u32::MAX, ..first });
        }
    }
    all
}

fn twin(kind: SamplerKind, i: &Input) -> Output {
    let s = Sampler::new(kind, i.seed, i.frame, i.pixel, i.index);
    let set = s.set(i.vertex);
    Output {
        bits: [0, 1, 2, 3].map(|d| set.bits(d)),
        filter: s.filter(),
        lens: s.lens(),
        time: s.time(),
        wavelength: s.wavelength(),
        direction: s.direction(i.vertex),
        light_point: s.light_point(i.vertex),
        second_light_point: s.second_light_point(i.vertex),
        light_roulette: s.light_roulette(i.vertex),
        lobe: s.lobe(i.vertex),
        light: s.light(i.vertex),
        roulette: s.roulette(i.vertex),
        coverage_key: s.coverage_key(),
        split: s.split(i.which, i.parts, i.part).direction(0),
    }
}

/// How many outputs differ in any bit; `None` without a device.
fn differing(kind: SamplerKind, rust: impl Fn(&Input) -> Output) -> Option<usize> {
    let inputs = inputs();
    let constants = Specialisation::new().uint(KIND_CONSTANT, kind as u32);
    let gpu: Vec<Output> = evaluate_with(kernel!("sampler"), &[], &constants, &inputs)?;
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
fn streams_are_the_same_bits() {
    for kind in [SamplerKind::Sobol, SamplerKind::Independent] {
        assert_eq!(differing(kind, |i| twin(kind, i)).unwrap_or(0), 0, "{kind:?}");
    }
}

/// Another kind, a dimension taken for the next or a sample too many are found.
#[test]
fn another_stream_is_found() {
    let kind = SamplerKind::Sobol;
    let Some(other) = differing(kind, |i| twin(SamplerKind::Independent, i)) else { return };
    assert!(other > 99_000, "{other}");
    let next = |i: &Input| twin(kind, &Input { index: i.index.wrapping_add(1), ..*i });
    assert!(differing(kind, next).unwrap() > 99_000);
    let turned = |i: &Input| {
        let mut o = twin(kind, i);
        o.bits.rotate_left(1);
        o
    };
    assert!(differing(kind, turned).unwrap() > 99_000);
}
