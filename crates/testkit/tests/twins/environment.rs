//! `light/environment.glsl` and `distribution.glsl` against their twins in `lumbre_core`: small maps, each with a few questions.

use super::columns::{Columns, Numbers};
use super::{each_way, evaluate, kernel};
use bytemuck::{Pod, Zeroable};
use lumbre_core::distribution::sample_cdf;
use lumbre_core::light::environment::{EnvironmentLight, build_distribution};
use lumbre_core::rgb::Rgb;

const QUESTIONS: usize = 16;
/// Most texels, rows and cells of a map.
const TEXELS: usize = 32;
const ROWS: usize = 5;
const CELLS: usize = 36;

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Input {
    u: [[f32; 2]; QUESTIONS],
    direction: [[f32; 3]; QUESTIONS],
    width: u32,
    height: u32,
    rotation: f32,
    pixels: [Rgb; TEXELS],
    row_cdf: [f32; ROWS],
    cell_cdf: [f32; CELLS],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
struct Answer {
    radiance: Rgb,
    pdf: f32,
    found: u32,
    wi: [f32; 3],
    sample_pdf: f32,
    found_row: u32,
    row: u32,
    probability: f32,
    remainder: f32,
}

/// Which cell is drawn is decided by comparisons of equal bits, so choices are exact. Where in the map a direction points depends on the
/// last digits of its angles: on rims of cells (1e-4 of all) the density may be that of the neighbour, and radiance, up to 10, moves
/// by these digits times the slope between texels. The remainder is one quotient, of equal bits: off by 2.5 units in the last place there and
/// half a unit here. Near the poles a direction is the root of 1 - y², as in `warp.rs`.
fn columns() -> Columns {
    Columns::new()
        .then("radiance", 3, 3e-5, 0.0)
        .then("pdf", 1, 0.0, 3e-6)
        .exact("found", 1)
        .then("wi", 3, 8e-4, 0.0)
        .then("sample_pdf", 1, 0.0, 3e-6)
        .exact("found_row and row", 2)
        .exact("probability", 1)
        .then("remainder", 1, 0.0, 3.6e-7)
}

fn input(row: u32) -> Input {
    let n = &mut Numbers::new(row);
    let [width, height] = n.one_of(&[[8, 4], [7, 3], [1, 1], [2, 1], [1, 3]]);
    // Among them maps with black places, and black ones.
    let lit = n.one_of(&[1.0, 0.4, 0.0]);
    let mut texel = || {
        let scale = if n.unit() < lit { 1.0 } else { 0.0 };
        Rgb::new(n.scale(0.01, 10.0), n.unit(), n.unit()) * scale
    };
    let pixels: Vec<Rgb> = (0..width * height).map(|_| texel()).collect();
    let (rows, cells, _) = build_distribution(width, height, &pixels);
    let mut input = Input {
        u: [(); QUESTIONS].map(|()| n.pair()),
        direction: [(); QUESTIONS].map(|()| n.direction()),
        width,
        height,
        rotation: n.one_of(&[0.0, 0.7, -3.0, 6.0]),
        pixels: [Rgb::BLACK; TEXELS],
        row_cdf: [0.0; ROWS],
        cell_cdf: [0.0; CELLS],
    };
    // Ends of the unit square, and the poles.
    input.u[0] = [0.0, 0.0];
    input.u[1] = [lumbre_core::math::ONE_MINUS_EPSILON; 2];
    input.direction[0] = [0.0, 1.0, 0.0];
    input.direction[1] = [0.0, -1.0, 0.0];
    input.pixels[..pixels.len()].copy_from_slice(&pixels);
    input.row_cdf[..rows.len()].copy_from_slice(&rows);
    input.cell_cdf[..cells.len()].copy_from_slice(&cells);
    input
}

fn twin(i: &Input) -> [Answer; QUESTIONS] {
    let (width, height) = (i.width as usize, i.height as usize);
    let light = EnvironmentLight {
        width: i.width,
        height: i.height,
        rotation: i.rotation,
        pixels: &i.pixels[..width * height],
        row_cdf: &i.row_cdf[..=height],
        cell_cdf: &i.cell_cdf[..height * (width + 1)],
    };
    core::array::from_fn(|k| {
        let (u, d) = (i.u[k], i.direction[k].into());
        let (sample, row) = (light.sample(u), sample_cdf(light.row_cdf, u[1]));
        let (wi, sample_pdf) = sample.unwrap_or_default();
        Answer {
            radiance: light.radiance(d),
            pdf: light.pdf(d),
            found: sample.is_some().into(),
            wi: wi.to_array(),
            sample_pdf,
            found_row: row.is_some().into(),
            row: row.map_or(0, |r| r.index as u32),
            probability: row.map_or(0.0, |r| r.probability),
            remainder: row.map_or(0.0, |r| r.remainder),
        }
    })
}

fn both(change: fn(&mut Input)) -> Option<(Vec<Answer>, Vec<Answer>)> {
    let inputs: Vec<Input> = (0..6_250).map(input).collect();
    let gpu: Vec<[Answer; QUESTIONS]> = evaluate(kernel!("environment"), &[], &inputs)?;
    let rust = inputs.into_iter().flat_map(|mut i| {
        change(&mut i);
        twin(&i)
    });
    Some((rust.collect(), gpu.into_iter().flatten().collect()))
}

#[test]
fn environments_agree() {
    each_way(|| {
        let Some((rust, gpu)) = both(|_| ()) else { return };
        columns().assert_near(&rust, &gpu, 1e-4);
        let found = rust.iter().filter(|a| a.found == 1).count();
        assert!((50_000..90_000).contains(&found), "black maps occur: {found}");
    });
}

#[test]
fn other_environments_are_found() {
    let Some((rust, gpu)) = both(|i| {
        i.rotation += 0.01;
        i.u = i.u.map(|[a, b]| [0.99 * a, 0.99 * b]);
    }) else {
        return;
    };
    for name in ["wi", "remainder"] {
        columns().assert_far(name, &rust, &gpu);
    }
    // A turn shows in maps of several columns that are not black; densities jump at the rims of their cells.
    let differing = columns().differing(&rust, &gpu);
    let count = |name| differing.iter().find(|d| d.0 == name).unwrap().1;
    assert!(count("radiance") > rust.len() / 4, "{differing:?}");
    assert!(count("pdf") > rust.len() / 200, "{differing:?}");
}
