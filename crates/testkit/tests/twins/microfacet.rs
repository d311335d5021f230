//! `microfacet.glsl` against `lumbre_core::microfacet`.

use super::columns::{Columns, Numbers};
use super::{each_way, evaluate, kernel};
use bytemuck::{Pod, Zeroable};
use lumbre_core::math::Vec3;
use lumbre_core::microfacet::{ALPHA_SMOOTH, Ggx, reflect};

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Input {
    alpha: f32,
    strength: f32,
    wo: [f32; 3],
    wi: [f32; 3],
    u: [f32; 2],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Output {
    widths: [f32; 2],
    g1: f32,
    visibility: f32,
    normal: [f32; 3],
    mirrored: [f32; 3],
    d: f32,
    pdf_normal: f32,
    reflected: f32,
    pdf_reflected: f32,
}

/// A direction above the surface, down to the horizon.
fn above(n: &mut Numbers) -> [f32; 3] {
    let [any, grazing] = [n.unit().max(1e-5), n.scale(1e-6, 1.0)];
    let z = n.one_of(&[any, any, grazing, 1.0]);
    let (sin, phi) = ((1.0 - z * z).sqrt(), n.between(0.0, 6.3));
    [sin * phi.cos(), sin * phi.sin(), z]
}

/// Widths from the least to 1, stretched or not. Facets are asked for near the normal, where narrow ones are; the points of the square
/// include its corners, its middle and its diagonals.
fn inputs() -> Vec<Input> {
    let random = (0..100_000).map(|row| {
        let n = &mut Numbers::new(row);
        let any = n.scale(ALPHA_SMOOTH, 1.0);
        let alpha = n.one_of(&[any, any, any, ALPHA_SMOOTH, 1.0]);
        let strength = n.unit();
        let strength = n.one_of(&[0.0, 0.0, strength, 1.0]);
        let (spread, phi) = (alpha * n.scale(0.01, 10.0), n.between(0.0, 6.3));
        let near = Vec3::new(spread * phi.cos(), spread * phi.sin(), 1.0).normalize().to_array();
        let wi = if n.below(2) == 0 { near } else { above(n) };
        Input { alpha, strength, wo: above(n), wi, u: n.pair() }
    });
    let mut all: Vec<_> = random.collect();
    let ends = [0.0, 0.25, 0.5, 0.75, lumbre_core::math::ONE_MINUS_EPSILON];
    let first = all[0];
    for alpha in [ALPHA_SMOOTH, 0.1, 1.0] {
        for u in ends.iter().flat_map(|&x| ends.map(|y| [x, y])) {
            all.push(Input { alpha, u, ..first });
            all.push(Input { alpha, u, wo: [0.0, 0.0, 1.0], strength: 0.7, ..first });
        }
    }
    all
}

fn twin(i: &Input) -> Output {
    let ggx = if i.strength > 0.0 { Ggx::stretched(i.alpha, i.strength) } else { Ggx::isotropic(i.alpha) };
    let [wo, wi] = [i.wo, i.wi].map(Vec3::from_array);
    let normal = ggx.sample_visible_normal(wo, i.u);
    let (reflected, pdf_reflected) = ggx.reflection(wo, wi, (wo + wi).normalize());
    Output {
        widths: [ggx.alpha_x, ggx.alpha_y],
        g1: ggx.g1(wi),
        visibility: ggx.visibility(wo, wi),
        normal: normal.to_array(),
        mirrored: reflect(wo, normal).to_array(),
        d: ggx.d(wi),
        pdf_normal: ggx.pdf_visible_normal(wo, wi),
        reflected,
        pdf_reflected,
    }
}

/// Roundings; a facet that faces away by a rounding is not seen. Where a half vector is rounded before facets of width 0.001 are asked for it,
/// that is magnified a thousand times.
fn columns() -> Columns {
    Columns::new()
        .then("widths", 2, 0.0, 3e-7)
        .then("g1", 1, 0.0, 2e-6)
        .then("visibility", 1, 0.0, 2e-6)
        .then("normal", 3, 1e-5, 1e-5)
        .then("mirrored", 3, 2e-5, 1e-5)
        .then("d", 1, 0.0, 3e-6)
        .then("pdf_normal", 1, 1e-6, 1e-5)
        .then("reflected", 1, 1e-12, 1e-3)
        .then("pdf_reflected", 1, 1e-12, 1e-3)
}

/// True where a rounding of each random number and of `wo` moves the normal by many: it is drawn as the sum of two
/// unit vectors, which at grazing angles nearly cancel. Devices may be off by five roundings (of a root): a fifth of the tolerance.
fn is_unsteady(i: &Input) -> bool {
    let normal = |i: &Input| Vec3::from_array(twin(i).normal);
    let more = |x: f32| x * (1.0 + f32::EPSILON);
    let ([x, y, z], [u, v]) = (i.wo, i.u);
    let moved = [
        Input { wo: [more(x), y, z], ..*i },
        Input { wo: [x, more(y), z], ..*i },
        Input { wo: [x, y, more(z)], ..*i },
        Input { u: [u + f32::EPSILON, v], ..*i },
        Input { u: [u, v + f32::EPSILON], ..*i },
    ];
    moved.iter().map(|m| (normal(m) - normal(i)).abs().max_element()).sum::<f32>() > 2e-6
}

/// Share of rows that cards whose roots are off by several roundings move further than the limit above foresees.
const NEARLY_UNSTEADY: f64 = 1e-4;

#[test]
fn facets_are_the_same() {
    each_way(|| {
        let mut inputs = inputs();
        let all = inputs.len();
        inputs.retain(|i| !is_unsteady(i));
        assert!(inputs.len() > all - all / 20, "{} of {all} are steady", inputs.len());
        let Some(gpu) = evaluate::<_, Output>(kernel!("microfacet"), &[], &inputs) else { return };
        let rust: Vec<_> = inputs.iter().map(twin).collect();
        columns().assert_near(&rust, &gpu, NEARLY_UNSTEADY);
    });
}

/// A hundredth more in the width is found.
#[test]
fn other_facets_are_found() {
    let inputs = inputs();
    let Some(gpu) = evaluate::<_, Output>(kernel!("microfacet"), &[], &inputs) else { return };
    let wider: Vec<_> = inputs.iter().map(|i| twin(&Input { alpha: i.alpha * 1.01, ..*i })).collect();
    for column in ["widths", "visibility", "normal", "mirrored", "d", "pdf_normal", "reflected"] {
        columns().assert_far(column, &wider, &gpu);
    }
}
