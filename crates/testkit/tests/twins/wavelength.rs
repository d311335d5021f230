//! `wavelength.glsl` against `lumbre_core::wavelength`.

use super::columns::{Columns, Numbers};
use super::{each_way, evaluate, kernel};
use bytemuck::{Pod, Zeroable};
use lumbre_core::wavelength::{Table, Wavelength, dispersed_index};
use lumbre_shaders::tables::tables;

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Input {
    u: f32,
    ior: f32,
    dispersion: f32,
    nm: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Output {
    nm: f32,
    weight: [f32; 3],
    index: f32,
}

/// Wavelengths to a few units in the last place, where the density is not almost 0 too (the first cells: a number's last digit moves the
/// wavelength by much); weights are the quotient of a difference.
fn columns() -> Columns {
    Columns::new().then("nm", 1, 0.0, 5e-7).then("weight", 3, 2e-5, 0.0).then("index", 1, 0.0, 1e-6)
}

fn inputs() -> Vec<Input> {
    let random = (0..100_000).map(|row| {
        let n = &mut Numbers::new(row);
        Input {
            u: n.unit(),
            ior: n.between(1.0, 3.0),
            dispersion: n.between(0.0, 5.0),
            nm: n.between(390.0, 700.0),
        }
    });
    let mut all: Vec<Input> = random.collect();
    let first = all[0];
    // Nodes, and the numbers beside them.
    for &c in &Table::get().cdf {
        let ends = [c, c + f32::EPSILON, c - f32::EPSILON];
        let inside = ends.into_iter().filter(|u| (0.0..1.0).contains(u));
        all.extend(inside.map(|u| Input { u, ..first }));
    }
    all.push(Input { u: lumbre_core::math::ONE_MINUS_EPSILON, ior: 1.0, ..first });
    all
}

fn twin(i: &Input) -> Output {
    let w = Wavelength::sample(i.u);
    let index = dispersed_index(i.ior, i.dispersion, i.nm);
    Output { nm: w.nm, weight: w.weight.to_array(), index }
}

#[test]
fn wavelengths_agree() {
    each_way(|| {
        let inputs = inputs();
        let Some(gpu) = evaluate::<_, Output>(kernel!("wavelength"), &tables(), &inputs) else { return };
        columns().assert_near(&inputs.iter().map(twin).collect::<Vec<_>>(), &gpu, 0.0);
    });
}

#[test]
fn other_wavelengths_are_found() {
    let inputs = inputs();
    let Some(gpu) = evaluate::<_, Output>(kernel!("wavelength"), &tables(), &inputs) else { return };
    let change = |i: &Input| twin(&Input { u: 0.99 * i.u, dispersion: 1.01 * i.dispersion, ..*i });
    let rust: Vec<_> = inputs.iter().map(change).collect();
    for name in ["nm", "weight", "index"] {
        columns().assert_far(name, &rust, &gpu);
    }
}
