//! `fresnel.glsl` against `lumbre_core::fresnel`.

use super::columns::{Columns, Numbers};
use super::{each_way, evaluate, kernel};
use bytemuck::{Pod, Zeroable};
use lumbre_core::Spectrum;
use lumbre_core::fresnel::{conductor, dielectric_refracted, f0_from_ior, refract, schlick, schlick_weight};
use lumbre_core::math::Vec3;

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Input {
    cosine: f32,
    eta: f32,
    k: f32,
    f90: f32,
    f0: Spectrum,
    wo: [f32; 3],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Output {
    reflected: f32,
    cos_t: f32,
    refracted: [f32; 3],
    conductor: f32,
    weight: f32,
    schlick: Spectrum,
    f0: f32,
}

fn input(cosine: f32, eta: f32, n: &mut Numbers) -> Input {
    let sin = (1.0 - cosine * cosine).max(0.0).sqrt();
    let phi = n.between(0.0, 6.3);
    Input {
        cosine,
        eta,
        k: n.between(0.0, 8.0),
        f90: n.unit(),
        f0: Spectrum::new(n.unit(), n.unit(), n.unit()),
        wo: [sin * phi.cos(), sin * phi.sin(), cosine],
    }
}

/// Any angle and index on both sides of 1; normal and grazing incidence; both sides of the critical angle, and that angle itself.
fn inputs() -> Vec<Input> {
    let random = (0..100_000).map(|row| {
        let n = &mut Numbers::new(row);
        let (any, grazing, eta) = (n.unit(), n.scale(1e-6, 1.0), n.between(1.0, 3.0));
        input(n.one_of(&[any, any, grazing]), n.one_of(&[eta, 1.0 / eta]), n)
    });
    let mut all: Vec<_> = random.collect();
    let n = &mut Numbers::new(0x0100_0000);
    for eta in [0.2, 1.0 / 1.5, 0.99, 1.0 - f32::EPSILON, 1.0, 1.0 + f32::EPSILON, 1.01, 1.5, 2.4, 20.0] {
        for cosine in [0.0, 1e-30, 1e-6, 1e-3, 0.5, 1.0 - f32::EPSILON, 1.0] {
            all.push(input(cosine, eta, n));
        }
        if eta < 1.0 {
            let critical = (1.0 - eta * eta).sqrt();
            all.extend([-1e-3, -1e-6, 0.0, 1e-6, 1e-3].map(|d| input(critical + d, eta, n)));
        }
    }
    all
}

fn twin(i: &Input) -> Output {
    let (reflected, cos_t) = dielectric_refracted(i.cosine, i.eta);
    Output {
        reflected,
        cos_t,
        refracted: refract(Vec3::from_array(i.wo), Vec3::Z, cos_t, i.eta).to_array(),
        conductor: conductor(i.cosine, i.eta, i.k),
        weight: schlick_weight(i.cosine),
        schlick: schlick(i.f0, i.f90, i.cosine),
        f0: f0_from_ior(i.eta),
    }
}

/// Roundings, where differences cancel (Brewster's angle, indices beside each other) of what cancels. At the critical angle the curve is vertical: a
/// rounding there is √ε = 3e-4, and such angles are so rare that only the share of rows set below is that near. A conductor of small index and
/// large absorption magnifies the rounding of k², 64 at most.
fn columns() -> Columns {
    Columns::new()
        .then("reflected", 1, 1e-6, 1e-5)
        .then("cos_t", 1, 1e-6, 1e-5)
        .then("refracted", 3, 2e-6, 1e-5)
        .then("conductor", 1, 5e-5, 1e-5)
        .then("weight", 1, 1e-12, 2e-6)
        .then("schlick", 3, 1e-7, 1e-6)
        .then("f0", 1, 1e-9, 1e-5)
}

/// Share of rows at the critical angle.
const AT_CRITICAL_ANGLE: f64 = 1e-4;

#[test]
fn reflectances_are_the_same() {
    each_way(|| {
        let inputs = inputs();
        let Some(gpu) = evaluate::<_, Output>(kernel!("fresnel"), &[], &inputs) else { return };
        let rust: Vec<_> = inputs.iter().map(twin).collect();
        columns().assert_near(&rust, &gpu, AT_CRITICAL_ANGLE);
    });
}

/// A hundredth more in the angle or an index is found.
#[test]
fn other_surfaces_are_found() {
    let inputs = inputs();
    let Some(gpu) = evaluate::<_, Output>(kernel!("fresnel"), &[], &inputs) else { return };
    let with = |change: fn(&Input) -> Input| inputs.iter().map(|i| twin(&change(i))).collect::<Vec<_>>();
    let turned = with(|i| Input { cosine: i.cosine * 0.99, ..*i });
    for column in ["conductor", "weight", "schlick"] {
        columns().assert_far(column, &turned, &gpu);
    }
    let denser = with(|i| Input { eta: i.eta * 1.01, ..*i });
    for column in ["reflected", "refracted", "conductor", "f0"] {
        columns().assert_far(column, &denser, &gpu);
    }
    columns().assert_far("conductor", &with(|i| Input { k: i.k * 1.01, ..*i }), &gpu);
    columns().assert_far("schlick", &with(|i| Input { f0: i.f0 * 1.01, ..*i }), &gpu);
}
