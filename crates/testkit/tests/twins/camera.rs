//! `camera.glsl`, `filter.glsl` and `ray.glsl` against their twins in `lumbre_core`.

use super::columns::{Columns, Numbers};
use super::{each_way, evaluate, kernel};
use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use lumbre_core::camera::{Camera, Projection};
use lumbre_core::filter::{Filter, FilterKind};
use lumbre_core::ray::offset_ray_origin;
use lumbre_shaders::camera::CameraRecord;
use lumbre_shaders::tables::tables;

const FILTERS: [FilterKind; 5] =
    [FilterKind::Box, FilterKind::Tent, FilterKind::Gaussian, FilterKind::BlackmanHarris, FilterKind::Point];

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Input {
    camera: CameraRecord,
    film: [f32; 2],
    lens: [f32; 2],
    time: f32,
    filter_kind: u32,
    in_pixel: [f32; 2],
    p: [f32; 3],
    ng: [f32; 3],
    towards: [f32; 3],
    extent: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Output {
    origin: [f32; 3],
    dir: [f32; 3],
    t_min: f32,
    t_max: f32,
    time: f32,
    offset: [f32; 2],
    left: [f32; 3],
}

/// Directions and offsets in a pixel agree to a few units in the last place of 1; places to those of their largest coordinate, here up to
/// 100 m. A filter's knots are near each other at its rim, where the root of 1 - |2u - 1| has few digits: 2⁻¹² of a pixel and less. A step off a surface that leads through a plane of
/// coordinates leaves what rounding leaves of the step.
fn columns() -> Columns {
    Columns::new()
        .then("origin", 3, 1e-5, 2e-6)
        .then("dir", 3, 1e-6, 0.0)
        .exact("t_min, t_max, time", 3)
        .then("offset", 2, 2e-6, 0.0)
        .then("left", 3, 2e-10, 3e-7)
}

fn camera(n: &mut Numbers) -> Camera {
    let eye = Vec3::from(n.direction()) * n.scale(0.1, 100.0);
    let (aspect, up) = (n.between(0.5, 2.5), Vec3::from(n.direction()));
    let mut camera = Camera::look_at(eye, Vec3::from(n.direction()), up, n.between(0.1, 2.5), aspect);
    if n.below(3) == 0 {
        camera.projection = Projection::Orthographic { half_height: n.scale(0.01, 100.0) };
    }
    if n.below(2) == 0 {
        camera.lens_radius = n.scale(1e-4, 0.3);
        camera.focus_distance = n.scale(0.5, 1e3);
    }
    camera
}

fn input(row: u32) -> (Camera, Input) {
    let n = &mut Numbers::new(row);
    let camera = camera(n);
    let ends = [0.0, 0.5, lumbre_core::math::ONE_MINUS_EPSILON];
    let number = |n: &mut Numbers| if n.below(8) == 0 { n.one_of(&ends) } else { n.unit() };
    // Near and far from the origin, where rays are moved off a surface in two ways, and on its planes.
    let size = n.scale(1e-4, 1e5);
    let p = [0; 3].map(|_| if n.below(16) == 0 { 0.0 } else { n.between(-size, size) });
    let input = Input {
        camera: CameraRecord::from(&camera),
        film: [number(n), number(n)],
        lens: [number(n), number(n)],
        time: n.unit(),
        filter_kind: n.below(5),
        in_pixel: [number(n), number(n)],
        p,
        ng: n.direction(),
        towards: n.direction(),
        extent: n.scale(1e-3, 1e3) * f32::from(u8::from(n.below(2) == 0)),
    };
    (camera, input)
}

fn twin(camera: &Camera, i: &Input, filters: &[Filter; 5]) -> Output {
    let ray = camera.ray(i.film, i.lens, i.time);
    Output {
        origin: ray.origin.to_array(),
        dir: ray.dir.to_array(),
        t_min: ray.t_min,
        t_max: ray.t_max,
        time: ray.time,
        offset: filters[i.filter_kind as usize].sample(i.in_pixel),
        left: offset_ray_origin(i.p.into(), i.ng.into(), i.towards.into(), i.extent).to_array(),
    }
}

fn both(change: fn(&mut Camera, &mut Input)) -> Option<(Vec<Output>, Vec<Output>)> {
    let (cameras, inputs): (Vec<Camera>, Vec<Input>) = (0..100_000).map(input).unzip();
    let gpu = evaluate(kernel!("camera"), &tables(), &inputs)?;
    let filters = FILTERS.map(Filter::new);
    let rust = cameras.iter().zip(&inputs).map(|(camera, input)| {
        let (mut camera, mut input) = (*camera, *input);
        change(&mut camera, &mut input);
        twin(&camera, &input, &filters)
    });
    Some((rust.collect(), gpu))
}

#[test]
fn rays_and_filters_agree() {
    each_way(|| {
        let Some((rust, gpu)) = both(|_, _| ()) else { return };
        columns().assert_near(&rust, &gpu, 0.0);
    });
}

#[test]
fn other_cameras_and_filters_are_found() {
    let Some((rust, gpu)) = both(|camera, input| {
        camera.projection = camera.projection.scaled(1.01);
        camera.aspect *= 1.01;
        camera.origin *= 1.01;
        input.filter_kind = (input.filter_kind + 1) % 5;
        input.ng = input.ng.map(|x| -1.5 * x);
    }) else {
        return;
    };
    for name in ["origin", "dir", "offset", "left"] {
        columns().assert_far(name, &rust, &gpu);
    }
}

/// A lens too small by a hundredth is found where there is one: that is half of the cameras, so origins move in most of these.
#[test]
fn another_lens_is_found() {
    let Some((rust, gpu)) = both(|camera, _| camera.lens_radius *= 0.99) else { return };
    let differing = columns().differing(&rust, &gpu);
    assert!(differing[0].1 > rust.len() / 4, "{differing:?}");
}
