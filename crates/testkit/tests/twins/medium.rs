//! `medium.glsl` against `lumbre_core::medium`: stacks that solids enter and leave in any order.

use super::columns::{Columns, Numbers};
use super::{each_way, evaluate, kernel};
use bytemuck::{Pod, Zeroable};
use lumbre_core::Spectrum;
use lumbre_core::medium::{Medium, MediumStack};
use lumbre_shaders::medium::MediumStackRecord;

const STEPS: usize = 12;

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Step {
    kind: u32,
    material: u32,
    ior: f32,
    asked: u32,
    front: u32,
    distance: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Input {
    start: MediumStackRecord,
    steps: [Step; STEPS],
}

/// A medium without what it absorbs.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Bare {
    ior: f32,
    material: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct State {
    current: Bare,
    here: Bare,
    beyond: Bare,
    transmittance: [f32; 3],
}

fn columns() -> Columns {
    Columns::new()
        .exact("current", 2)
        .exact("here", 2)
        .exact("beyond", 2)
        // The exponent, up to 80, carries an error of half a unit in its last place.
        .then("transmittance", 3, 1e-37, 1e-5)
}

/// As the kernel has it.
fn medium(material: u32, ior: f32) -> Medium {
    let a = (material % 3) as f32;
    Medium { ior, absorption: Spectrum::new(0.0, 0.5 * a, a * a), material }
}

fn input(row: u32) -> (MediumStack, Input) {
    let n = &mut Numbers::new(row);
    let mut start = MediumStack::default();
    for _ in 0..n.below(4) {
        start.enter(medium(n.below(6), n.between(1.0, 2.0)));
    }
    let steps = [(); STEPS].map(|()| Step {
        // More go in than come out, so that stacks run full.
        kind: n.one_of(&[0, 0, 1, 2, 3]),
        material: n.below(6),
        ior: n.between(1.0, 2.0),
        asked: n.below(6),
        front: n.below(2),
        distance: if n.below(8) == 0 { f32::INFINITY } else { n.scale(1e-3, 20.0) },
    });
    (start, Input { start: MediumStackRecord::from(&start), steps })
}

fn twin(start: &MediumStack, input: &Input) -> [State; STEPS] {
    let mut stack = *start;
    input.steps.map(|s| {
        let medium_of_step = medium(s.material, s.ior);
        match s.kind {
            0 => stack.enter(medium_of_step),
            1 => stack.leave(s.material),
            kind => stack.cross(medium_of_step, s.material, kind == 2),
        }
        let (here, beyond) = stack.sides(medium(s.asked, s.ior), s.front == 1);
        let bare = |m: Medium| Bare { ior: m.ior, material: m.material };
        State {
            current: bare(*stack.current()),
            here: bare(here),
            beyond: bare(beyond),
            transmittance: stack.current().transmittance(s.distance).to_array(),
        }
    })
}

/// The states of both sides, after `change` of the inputs of one.
fn both(change: fn(&mut Input)) -> Option<(Vec<State>, Vec<State>)> {
    let (starts, inputs): (Vec<_>, Vec<_>) = (0..10_000).map(input).unzip();
    let gpu: Vec<[State; STEPS]> = evaluate(kernel!("medium"), &[], &inputs)?;
    let rust = starts.iter().zip(&inputs).flat_map(|(start, input)| {
        let mut input = *input;
        change(&mut input);
        twin(start, &input)
    });
    Some((rust.collect(), gpu.into_iter().flatten().collect()))
}

#[test]
fn stacks_agree() {
    each_way(|| {
        let Some((rust, gpu)) = both(|_| ()) else { return };
        columns().assert_near(&rust, &gpu, 0.0);
    });
}

#[test]
fn other_media_are_found() {
    let Some((rust, gpu)) = both(|i| {
        for s in &mut i.steps {
            (s.ior, s.distance) = (1.01 * s.ior, 1.01 * s.distance);
        }
    }) else {
        return;
    };
    for name in ["current", "here", "beyond"] {
        columns().assert_far(name, &rust, &gpu);
    }
    // A third of the materials absorb nothing, and so does empty space.
    let differing = columns().differing(&rust, &gpu);
    assert!(differing[3].1 > rust.len() / 4, "{differing:?}");
    let Some((rust, gpu)) = both(|i| i.steps[0].kind = 1 - i.steps[0].kind % 2) else { return };
    let differing = columns().differing(&rust, &gpu);
    assert!(differing[0].1 > rust.len() / 20, "a step more or less: {differing:?}");
}
