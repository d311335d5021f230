//! `tone.glsl` and `color.glsl` against `lumbre_core::tone` and `lumbre_core::color`.

use super::columns::{Columns, Numbers};
use super::{each_way, evaluate, kernel};
use bytemuck::{Pod, Zeroable};
use lumbre_core::color::{exposure_eased, srgb_decode, srgb_encode};
use lumbre_core::rgb::Rgb;
use lumbre_core::tone::{ToneCurve, vignette};

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Input {
    color: [f32; 3],
    strength: f32,
    at: [f32; 2],
    exposure: [f32; 3],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Output {
    display: [Rgb; 6],
    vignette: f32,
    encoded: f32,
    decoded: f32,
    eased: f32,
}

/// A hundredth of a code of 8 bits is 4e-5. AgX has a polynomial with coefficients up to 40, Neutral a difference of its largest band and what
/// that is compressed to.
fn columns() -> Columns {
    Columns::new()
        .then("linear", 3, 2e-6, 0.0)
        .then("srgb", 3, 2e-6, 0.0)
        .then("reinhard", 3, 2e-6, 0.0)
        .then("aces", 3, 4e-6, 0.0)
        .then("agx", 3, 2e-5, 0.0)
        .then("neutral", 3, 2e-5, 0.0)
        .then("vignette", 1, 5e-7, 0.0)
        .then("srgb_encode", 1, 2e-6, 0.0)
        .then("srgb_decode", 1, 0.0, 2e-6)
        .then("eased", 1, 0.0, 1e-5)
}

fn inputs() -> Vec<Input> {
    let odd = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        -1.0,
        0.0,
        1e-40,
        0.003_130_8,
        0.04,
        0.08,
        0.76,
        1.0,
        1e6,
        f32::MAX,
    ];
    let random = (0..100_000).map(|row| {
        let n = &mut Numbers::new(row);
        // A grey, a colour of like bands, or any colour.
        let base = n.scale(1e-5, 1e7);
        let color = match n.below(4) {
            0 => [base; 3],
            1 => [0; 3].map(|_| n.scale(1e-5, 1e7)),
            2 => [0; 3].map(|_| if n.below(8) == 0 { n.one_of(&odd) } else { n.unit() }),
            _ => [0; 3].map(|_| base * n.between(0.2, 1.0)),
        };
        Input {
            color,
            strength: n.unit(),
            at: n.pair(),
            exposure: [n.scale(1e-6, 1e6), n.scale(1e-6, 1e6), n.one_of(&[0.0, 0.01, 0.3, 1.0])],
        }
    });
    random.collect()
}

fn twin(i: &Input) -> Output {
    let [previous, target, share] = i.exposure;
    Output {
        display: ToneCurve::ALL.map(|curve| curve.display(Rgb::from_array(i.color))),
        vignette: vignette(i.strength, i.at),
        encoded: if i.color[0].is_nan() { 0.0 } else { srgb_encode(i.color[0]) },
        decoded: srgb_decode(i.at[0]),
        eased: exposure_eased(previous, target, share),
    }
}

/// Both sides, after `change` of the inputs of one.
fn both(change: fn(Input) -> Input) -> Option<(Vec<Output>, Vec<Output>)> {
    let inputs = inputs();
    let mut gpu: Vec<Output> = evaluate(kernel!("tone"), &[], &inputs)?;
    // The curve alone is not for what is no number: `display` has taken care of that.
    gpu.iter_mut().zip(&inputs).filter(|(_, i)| i.color[0].is_nan()).for_each(|(o, _)| o.encoded = 0.0);
    Some((inputs.into_iter().map(|i| twin(&change(i))).collect(), gpu))
}

#[test]
fn curves_agree() {
    each_way(|| {
        let Some((rust, gpu)) = both(|i| i) else { return };
        columns().assert_near(&rust, &gpu, 0.0);
    });
}

/// Light that is brighter by a hundredth is found, except where it is clipped anyway.
#[test]
fn other_curves_are_found() {
    let Some((rust, gpu)) = both(|i| Input {
        color: i.color.map(|x| 1.01 * x),
        strength: 1.01 * i.strength,
        at: i.at.map(|x| 1.01 * x),
        exposure: [1.01 * i.exposure[0], 1.01 * i.exposure[1], i.exposure[2]],
    }) else {
        return;
    };
    for name in ["vignette", "srgb_decode", "eased", "neutral"] {
        columns().assert_far(name, &rust, &gpu);
    }
    let differing = columns().differing(&rust, &gpu);
    assert!(differing.iter().all(|(_, n)| *n > rust.len() / 4), "{differing:?}");
    // A curve taken for its neighbour.
    let Some((mut rust, gpu)) = both(|i| i) else { return };
    rust.iter_mut().for_each(|o| o.display.rotate_left(1));
    for (name, n) in &columns().differing(&rust, &gpu)[..6] {
        assert!(*n > rust.len() / 2, "{name}: {n}");
    }
}
