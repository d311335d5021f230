//! `warp.glsl`, `frame.glsl` and `mis.glsl` against their twins in `lumbre_core`.

use super::columns::{Columns, Numbers};
use super::{each_way, evaluate, kernel};
use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use lumbre_core::mis::power_heuristic;
use lumbre_core::{Frame, warp};

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Input {
    u: [f32; 2],
    one_minus_cos: f32,
    cos_theta: f32,
    normal: [f32; 3],
    tangent: [f32; 3],
    v: [f32; 3],
    pdfs: [f32; 2],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Output {
    disk: [f32; 2],
    cosine: [f32; 3],
    hemisphere: [f32; 3],
    sphere: [f32; 3],
    cone: [f32; 3],
    triangle: [f32; 2],
    cosine_pdf: f32,
    cone_pdf: f32,
    frame_t: [f32; 3],
    frame_b: [f32; 3],
    tangent_t: [f32; 3],
    tangent_b: [f32; 3],
    local: [f32; 3],
    world: [f32; 3],
    heuristic: f32,
}

/// Unit vectors and points of the unit square agree to a few units in the last place of 1. A direction's height is the root of 1 - r², which
/// takes the root of that error where it is small: 2⁻¹¹ at the rim, as far as cosines count.
fn columns() -> Columns {
    Columns::new()
        .then("disk", 2, 6e-7, 0.0)
        .then("cosine", 3, 8e-4, 0.0)
        .then("hemisphere", 3, 1e-6, 0.0)
        .then("sphere", 3, 1e-6, 0.0)
        .then("cone", 3, 1e-6, 0.0)
        .then("triangle", 2, 1e-7, 0.0)
        .then("cosine_pdf", 1, 0.0, 1e-6)
        .then("cone_pdf", 1, 0.0, 1e-6)
        .then("frame_t", 3, 1e-6, 0.0)
        .then("frame_b", 3, 1e-6, 0.0)
        .then("tangent_t", 3, 2e-5, 0.0)
        .then("tangent_b", 3, 2e-5, 0.0)
        .then("local", 3, 2e-6, 0.0)
        .then("world", 3, 2e-6, 0.0)
        .then("heuristic", 1, 1e-30, 2e-6)
}

fn inputs() -> Vec<Input> {
    let random = (0..100_000).map(|row| {
        let n = &mut Numbers::new(row);
        let normal = Vec3::from(n.direction());
        // Not nearer to the normal than a fiftieth of its length, where the difference has few digits left.
        let mut tangent = Vec3::from(n.direction());
        if normal.cross(tangent).length() < 0.02 {
            tangent = Frame::from_normal(normal).t;
        }
        Input {
            u: n.pair(),
            one_minus_cos: n.scale(5e-9, 1.0),
            cos_theta: n.between(-0.2, 1.0),
            normal: normal.to_array(),
            tangent: (tangent * n.scale(1e-3, 1e3)).to_array(),
            v: n.direction(),
            pdfs: [n.scale(1e-12, 1e12), n.scale(1e-12, 1e12)],
        }
    });
    let mut all: Vec<Input> = random.collect();
    let first = all[0];
    let ends = [0.0, 0.5, lumbre_core::math::ONE_MINUS_EPSILON, 0.25, 1.0 / 16_777_216.0];
    all.extend(ends.iter().flat_map(|&a| ends.map(|b| Input { u: [a, b], ..first })));
    for axis in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z] {
        // Parallel to the normal, and none: both sides fall back.
        for tangent in [axis, -axis, Vec3::ZERO, Vec3::ONE] {
            all.push(Input { normal: axis.to_array(), tangent: tangent.to_array(), ..first });
        }
    }
    for a in [0.0, 1e-38, 1.0, 1e20, 1e38] {
        for b in [0.0, 1e-38, 1.0, 1e20, 1e38] {
            all.push(Input { pdfs: [a, b], ..first });
        }
    }
    all
}

fn twin(i: &Input) -> Output {
    let (normal, tangent, v) = (Vec3::from(i.normal), Vec3::from(i.tangent), Vec3::from(i.v));
    let (frame, along) = (Frame::from_normal(normal), Frame::from_normal_tangent(normal, tangent));
    Output {
        disk: warp::concentric_disk(i.u),
        cosine: warp::cosine_hemisphere(i.u).to_array(),
        hemisphere: warp::uniform_hemisphere(i.u).to_array(),
        sphere: warp::uniform_sphere(i.u).to_array(),
        cone: warp::uniform_cone(i.u, i.one_minus_cos).to_array(),
        triangle: warp::uniform_triangle(i.u),
        cosine_pdf: warp::cosine_hemisphere_pdf(i.cos_theta),
        cone_pdf: warp::uniform_cone_pdf(i.one_minus_cos),
        frame_t: frame.t.to_array(),
        frame_b: frame.b.to_array(),
        tangent_t: along.t.to_array(),
        tangent_b: along.b.to_array(),
        local: frame.to_local(v).to_array(),
        world: frame.to_world(v).to_array(),
        heuristic: power_heuristic(i.pdfs[0], i.pdfs[1]),
    }
}

#[test]
fn warps_and_frames_agree() {
    each_way(|| {
        let inputs = inputs();
        let Some(gpu) = evaluate::<_, Output>(kernel!("warp"), &[], &inputs) else { return };
        let rust: Vec<_> = inputs.iter().map(twin).collect();
        columns().assert_near(&rust, &gpu, 0.0);
    });
}

#[test]
fn other_warps_and_frames_are_found() {
    let inputs = inputs();
    let Some(gpu) = evaluate::<_, Output>(kernel!("warp"), &[], &inputs) else { return };
    let disturbed =
        |change: fn(Input) -> Input| -> Vec<Output> { inputs.iter().map(|i| twin(&change(*i))).collect() };
    let moved =
        disturbed(|i| Input { u: [i.u[0], 0.99 * i.u[1]], one_minus_cos: 1.01 * i.one_minus_cos, ..i });
    for name in ["disk", "cosine", "hemisphere", "sphere", "triangle", "cone_pdf"] {
        columns().assert_far(name, &moved, &gpu);
    }
    let turned = disturbed(|i| {
        let n = Vec3::from(i.normal) + Vec3::new(0.0, 0.01, -0.01);
        Input { normal: n.normalize().to_array(), pdfs: [1.01 * i.pdfs[0], i.pdfs[1]], ..i }
    });
    for name in ["frame_t", "frame_b", "tangent_t", "tangent_b", "local", "world"] {
        columns().assert_far(name, &turned, &gpu);
    }
    columns().assert_far("cosine_pdf", &disturbed(|i| Input { cos_theta: 1.01 * i.cos_theta, ..i }), &gpu);
}
