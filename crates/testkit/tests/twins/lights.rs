//! `light/{point,spot,directional,sun,triangle}.glsl` against `lumbre_core::light`.

use super::columns::{Columns, Numbers};
use super::{each_way, evaluate, kernel};
use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use lumbre_core::light::spot::Cone;
use lumbre_core::light::sun::SunDisc;
use lumbre_core::light::triangle::{TriangleLight, TriangleSample};
use lumbre_core::light::{DeltaSample, directional, point, spot};
use lumbre_core::rgb::Rgb;

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Input {
    position: [f32; 3],
    intensity: Rgb,
    axis: [f32; 3],
    cos_inner: f32,
    cos_outer: f32,
    sun_direction: [f32; 3],
    sun_one_minus_cos: f32,
    sun_radiance: Rgb,
    p0: [f32; 3],
    e1: [f32; 3],
    e2: [f32; 3],
    p: [f32; 3],
    wi: [f32; 3],
    u: [f32; 2],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
struct Delta {
    wi: [f32; 3],
    distance: f32,
    irradiance: Rgb,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
struct Triangle {
    point: [f32; 3],
    barycentrics: [f32; 2],
    wi: [f32; 3],
    distance: f32,
    pdf: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
struct Output {
    found_point: u32,
    point: Delta,
    found_spot: u32,
    spot: Delta,
    directional: Delta,
    on_sun: [f32; 3],
    sun_pdf: f32,
    found_triangle: u32,
    triangle: Triangle,
}

/// Directions to a root of a device (4.5 units in the last place, 1.2e-7 each at most), a quotient (2.5) and roundings; irradiance and densities to those of their factors. A spot's irradiance is compared as
/// a share of the point light's, the falloff: the cosine's last digits count over the width of its slope, here a hundredth and more. A triangle seen at a slant of 1/500 or more
/// has a density to five digits. A direction on the rim of the sun may fall to either side: `sun_pdf` has a share of its own.
fn columns() -> Columns {
    Columns::new()
        .exact("found_point", 1)
        .then("point.wi", 3, 1e-6, 0.0)
        .then("point", 4, 0.0, 2e-6)
        .exact("found_spot", 1)
        .then("spot.wi", 3, 1e-6, 0.0)
        .then("spot.distance", 1, 0.0, 2e-6)
        .then("spot.falloff", 3, 5e-5, 0.0)
        .exact("directional", 7)
        .then("on_sun", 3, 1e-6, 0.0)
        .then("sun_pdf", 1, 0.0, 1e-6)
        .exact("found_triangle", 1)
        .then("triangle.point", 3, 3e-6, 0.0)
        .then("triangle.barycentrics", 2, 1e-7, 0.0)
        .then("triangle.wi", 3, 1e-6, 0.0)
        .then("triangle", 2, 0.0, 1e-4)
}

fn input(row: u32) -> Input {
    let n = &mut Numbers::new(row);
    let vector = |n: &mut Numbers, low, high| (Vec3::from(n.direction()) * n.scale(low, high)).to_array();
    let (p, axis, sun) = (vector(n, 0.01, 3.0), n.direction(), n.direction());
    let cos_outer = n.between(-0.2, 0.98);
    let cos_inner = n.between(cos_outer + 0.01, 1.0);
    let one_minus_cos = n.scale(5e-9, 1.0);
    // Half of the directions lie near the sun.
    let near = Vec3::from(sun) + Vec3::from(n.direction()) * (2.0 * one_minus_cos * n.unit()).sqrt();
    let wi = if n.below(2) == 0 { near.normalize().to_array() } else { n.direction() };
    // A triangle that is no splinter, at a distance and not edge-on.
    let (p0, e1) = (Vec3::from(vector(n, 0.5, 5.0)), Vec3::from(vector(n, 0.1, 3.0)));
    let across = e1.any_orthogonal_vector() * n.between(0.5, 1.5) + e1 * n.between(-1.0, 1.0);
    let normal = e1.cross(across).normalize();
    let slant = |q: Vec3| ((q - Vec3::from(p)).dot(normal) / (q - Vec3::from(p)).length()).abs();
    let seen = [p0, p0 + e1, p0 + across].map(slant).into_iter().fold(1.0, f32::min) > 0.002;
    let p0 = if seen { p0 } else { Vec3::from(p) + normal * 2.0 - e1 * 0.5 };
    Input {
        position: if n.below(64) == 0 { p } else { vector(n, 1e-2, 10.0) },
        intensity: Rgb::new(n.scale(1e-2, 1e4), n.scale(1e-2, 1e4), 0.0),
        axis,
        cos_inner,
        cos_outer,
        sun_direction: sun,
        sun_one_minus_cos: one_minus_cos,
        sun_radiance: Rgb::splat(n.scale(1.0, 1e6)),
        p0: p0.to_array(),
        e1: e1.to_array(),
        e2: across.to_array(),
        p,
        wi,
        u: n.pair(),
    }
}

fn inputs() -> Vec<Input> {
    let mut all: Vec<Input> = (0..100_000).map(input).collect();
    let first = all[0];
    // From a point of the triangle's plane, and from one of its corners with the number that draws it.
    let inside = Vec3::from(first.p0) + 3.0 * Vec3::from(first.e1);
    all.push(Input { p0: [0.0; 3], e1: [1.0, 0.0, 0.0], e2: [0.0, 1.0, 0.0], p: [2.0, 3.0, 0.0], ..first });
    all.push(Input { p: first.p0, u: [0.0; 2], ..first });
    all.push(Input { position: inside.to_array(), p: [1e20; 3], ..first });
    all
}

fn delta(s: Option<DeltaSample>) -> (u32, Delta) {
    let of = |s: DeltaSample| Delta { wi: s.wi.to_array(), distance: s.distance, irradiance: s.irradiance };
    (s.is_some().into(), s.map_or_else(Delta::default, of))
}

/// The irradiance of a spot as a share of that of the point light in its place, in the bands that have any.
fn falloff(spot: Delta, point: &Delta) -> Delta {
    let [s, p] = [spot, *point].map(|d| d.irradiance.to_array());
    let share = [0, 1, 2].map(|i| if p[i] > 0.0 { s[i] / p[i] } else { s[i] });
    Delta { irradiance: Rgb::from_array(share), ..spot }
}

fn twin(i: &Input) -> Output {
    let (position, p) = (Vec3::from(i.position), Vec3::from(i.p));
    let cone = Cone { axis: i.axis.into(), cos_inner: i.cos_inner, cos_outer: i.cos_outer };
    let sun = SunDisc {
        direction: i.sun_direction.into(),
        one_minus_cos: i.sun_one_minus_cos,
        radiance: i.sun_radiance,
    };
    let triangle = TriangleLight { p0: i.p0.into(), e1: i.e1.into(), e2: i.e2.into() };
    let (found_point, point) = delta(point::sample(position, i.intensity, p));
    let (found_spot, spot) = delta(spot::sample(position, i.intensity, &cone, p));
    let spot = falloff(spot, &point);
    let on_triangle = triangle.sample(p, i.u);
    let of = |s: TriangleSample| Triangle {
        point: s.point.to_array(),
        barycentrics: s.barycentrics,
        wi: s.wi.to_array(),
        distance: s.distance,
        pdf: s.pdf_solid_angle,
    };
    Output {
        found_point,
        point,
        found_spot,
        spot,
        directional: delta(Some(directional::sample(cone.axis, i.intensity))).1,
        on_sun: sun.sample(i.u).to_array(),
        sun_pdf: sun.pdf(i.wi.into()),
        found_triangle: on_triangle.is_some().into(),
        triangle: on_triangle.map_or_else(Triangle::default, of),
    }
}

/// Both sides, after `change` of the inputs of one. What was not found says nothing.
fn both(change: fn(Input) -> Input) -> Option<(Vec<Output>, Vec<Output>)> {
    let inputs = inputs();
    let mut gpu: Vec<Output> = evaluate(kernel!("lights"), &[], &inputs)?;
    for o in &mut gpu {
        let found = |found: u32, o: Delta| if found == 1 { o } else { Delta::default() };
        o.point = found(o.found_point, o.point);
        o.spot = falloff(found(o.found_spot, o.spot), &o.point);
        o.triangle = if o.found_triangle == 1 { o.triangle } else { Triangle::default() };
    }
    Some((inputs.into_iter().map(|i| twin(&change(i))).collect(), gpu))
}

#[test]
fn lights_agree() {
    each_way(|| {
        let Some((rust, gpu)) = both(|i| i) else { return };
        // On rims the sides may differ: of the sun, and of a cone, where the light is 0 on both but not found on one.
        columns().assert_near(&rust, &gpu, 1e-4);
        let found = |f: fn(&Output) -> u32| rust.iter().map(|o| f(o) as usize).sum::<usize>();
        let inside = [found(|o| o.found_point), found(|o| o.found_spot), found(|o| o.found_triangle)];
        assert!(inside.iter().all(|n| (10_000..rust.len()).contains(n)), "both cases occur: {inside:?}");
        assert!(rust.iter().filter(|o| o.sun_pdf > 0.0).count() > 10_000);
    });
}

#[test]
fn other_lights_are_found() {
    let Some((rust, gpu)) = both(|i| Input {
        position: i.position.map(|x| 1.01 * x),
        sun_direction: Vec3::from(i.sun_direction).rotate_y(0.01).to_array(),
        p0: i.p0.map(|x| 1.01 * x),
        u: i.u.map(|u| 0.99 * u),
        axis: i.axis.map(|x| 1.01 * x),
        ..i
    }) else {
        return;
    };
    let names = ["point.wi", "point", "directional", "on_sun", "triangle.point", "triangle.wi", "triangle"];
    for name in names {
        columns().assert_far(name, &rust, &gpu);
    }
    // A third of the points lie in the cone; the sun's density shows in the half of directions near it.
    let (rust, gpu) = both(|i| Input {
        cos_inner: i.cos_inner + 0.05,
        sun_one_minus_cos: 1.01 * i.sun_one_minus_cos,
        intensity: i.intensity * 1.01,
        ..i
    })
    .expect("a device, as before");
    let differing = columns().differing(&rust, &gpu);
    for (name, least) in [("spot.falloff", 10_000), ("sun_pdf", 10_000)] {
        let count = differing.iter().find(|d| d.0 == name).unwrap().1;
        assert!(count > least, "{name}: {differing:?}");
    }
}
