//! `hash.glsl` against `lumbre_core::hash`: the same bits.

use super::{evaluate, kernel};
use bytemuck::{Pod, Zeroable};
use lumbre_core::hash::{hash_combine, to_unit};

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Input {
    a: u32,
    b: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Output {
    combined: u32,
    unit: f32,
}

fn inputs() -> Vec<Input> {
    let corners = [0, 1, 2, 0x7fff_ffff, 0x8000_0000, 0xffff_fffe, 0xffff_ffff];
    let pairs = corners.iter().flat_map(|&a| corners.iter().map(move |&b| Input { a, b }));
    let random = (0..100_000).map(|i| Input { a: hash_combine(1, i), b: hash_combine(2, i) });
    pairs.chain(random).collect()
}

fn twin(i: &Input) -> Output {
    let combined = hash_combine(i.a, i.b);
    Output { combined, unit: to_unit(combined) }
}

/// How many outputs differ in any bit; `None` without a device.
fn differing(rust: impl Fn(&Input) -> Output) -> Option<usize> {
    let inputs = inputs();
    let gpu: Vec<Output> = evaluate(kernel!("hash"), &[], &inputs)?;
    assert_eq!(gpu.len(), inputs.len());
    Some(
        inputs
            .iter()
            .zip(&gpu)
            .filter(|(i, o)| bytemuck::bytes_of(&rust(i)) != bytemuck::bytes_of(*o))
            .count(),
    )
}

#[test]
fn hashes_are_the_same_bits() {
    assert_eq!(differing(twin).unwrap_or(0), 0);
}

/// Another order of the two words, or one bit more in the unit number, is found.
#[test]
fn another_hash_is_found() {
    let swapped = |i: &Input| twin(&Input { a: i.b, b: i.a });
    let Some(found) = differing(swapped) else { return };
    assert!(found > 99_000, "{found}");
    let shifted = |i: &Input| Output { unit: twin(i).unit + f32::EPSILON, ..twin(i) };
    assert!(differing(shifted).unwrap() > 99_000);
}
