//! `math.glsl` against `lumbre_core::math`.

use super::columns::{Columns, Numbers};
use super::{each_way, evaluate, kernel};
use bytemuck::{Pod, Zeroable};
use lumbre_core::math::{acos, atan2, exp, exp2, ln, pow, sin_cos, tan};
use std::cell::RefCell;

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Input {
    x: f32,
    y: f32,
    cosine: f32,
    positive: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Output {
    sine: f32,
    cosine: f32,
    tangent: f32,
    arc_cosine: f32,
    arc_tangent: f32,
    exp: f32,
    exp2: f32,
    ln: f32,
    power: f32,
}

/// Angles of a few turns and many, both ends of what each function takes, and numbers beside the multiples of π/2. Powers stay within
/// the range of floats. No number is below the normal ones, which devices may take for 0: then either answer is right.
fn inputs() -> Vec<Input> {
    let random = (0..100_000).map(|row| {
        let n = &mut Numbers::new(row);
        let most = n.one_of(&[1.0, 7.0, 80.0, 8000.0]);
        let x = most * n.between(-1.0, 1.0);
        let (cosine, small) = (n.between(-1.0, 1.0), n.scale(1e-30, 1.0));
        let cosine = n.one_of(&[cosine, 1.0 - small, small - 1.0, small]);
        let (any, near, unit) = (n.scale(1e-37, 1e37), n.scale(0.1, 10.0), n.unit().max(1e-7));
        let positive = n.one_of(&[any, near, unit]);
        let y = n.between(-30.0, 30.0).min(80.0 / positive.ln().abs());
        Input { x, y, cosine, positive }
    });
    let specials = [0.0, -0.0, 1.0, -1.0, 0.5, -0.5, 1e-30, -1e-30, 1e-3, 0.41421356, 88.0, -87.0, 126.9];
    let turns =
        (-40..40).flat_map(|k| [0, 1, 2].map(|ulp| quarter_turns(k).to_bits() + ulp).map(f32::from_bits));
    let turns = turns.filter(|x| !x.is_subnormal());
    let corners = specials.into_iter().chain(turns).map(|x| Input {
        x,
        y: if x.abs() > 20.0 { 0.0 } else { x },
        cosine: x.clamp(-1.0, 1.0),
        positive: x.abs().clamp(1e-30, 1e30),
    });
    corners.chain(random).collect()
}

/// k π/2, rounded.
fn quarter_turns(k: i32) -> f32 {
    (f64::from(k) * std::f64::consts::FRAC_PI_2) as f32
}

fn twin(i: &Input) -> Output {
    let (sine, cosine) = sin_cos(i.x);
    Output {
        sine,
        cosine,
        tangent: tan(i.x),
        arc_cosine: acos(i.cosine),
        arc_tangent: atan2(i.y, i.x),
        exp: exp(i.x),
        exp2: exp2(i.x),
        ln: ln(i.positive),
        power: pow(i.positive, i.y),
    }
}

/// A few units in the last place, 6e-8 each (a quotient or a root of a GPU may be off by three alone); beside multiples of π/2 what is left of it in the last part that is taken away. Numbers below the normal ones may be 0 on cards; `pow` is as inexact as its exponent is large.
fn columns() -> Columns {
    Columns::new()
        .then("sine", 1, 1e-12, 3e-7)
        .then("cosine", 1, 1e-12, 3e-7)
        .then("tangent", 1, 1e-12, 2e-6)
        .then("arc cosine", 1, 1e-30, 6e-7)
        .then("arc tangent", 1, 1e-30, 1e-6)
        .then("exp", 1, 2e-38, 4e-7)
        .then("exp2", 1, 2e-38, 4e-7)
        .then("ln", 1, 2e-7, 3e-7)
        .then("power", 1, 1e-36, 1.2e-5)
}

#[test]
fn functions_are_within_a_few_roundings() {
    each_way(|| {
        let inputs = inputs();
        let Some(gpu) = evaluate::<_, Output>(kernel!("math"), &[], &inputs) else { return };
        let rust: Vec<_> = inputs.iter().map(twin).collect();
        columns().assert_near(&rust, &gpu, 0.0);
    });
}

/// A thousandth more in any argument is found (a hundredth in the one that two functions share, else an angle would not change).
#[test]
fn other_arguments_are_found() {
    let inputs = inputs();
    let Some(gpu) = evaluate::<_, Output>(kernel!("math"), &[], &inputs) else { return };
    let more = |i: &Input| Input {
        x: i.x * 1.001,
        y: i.y * 1.01,
        cosine: i.cosine * 0.999,
        positive: i.positive * 1.001,
    };
    let rust: Vec<_> = inputs.iter().map(|i| twin(&more(i))).collect();
    for column in ["sine", "cosine", "tangent", "arc cosine", "arc tangent", "exp", "exp2", "ln", "power"] {
        columns().assert_far(column, &rust, &gpu);
    }
}

/// What a device may round otherwise is another number then, and only that: sines have neither quotients nor roots, and tangents
/// end with a quotient. (Not on a card: see `each_way`.)
#[test]
fn least_precision_moves_quotients() {
    let inputs = inputs();
    let answers = RefCell::new(Vec::new());
    each_way(|| answers.borrow_mut().extend(evaluate::<_, Output>(kernel!("math"), &[], &inputs)));
    let [own, least] = &answers.into_inner()[..] else { return };
    let moved = |number: fn(&Output) -> f32| {
        own.iter().zip(least).filter(|(a, b)| number(a).to_bits() != number(b).to_bits()).count()
    };
    assert_eq!(moved(|o| o.sine), 0);
    assert!(moved(|o| o.tangent) > inputs.len() / 2);
}
