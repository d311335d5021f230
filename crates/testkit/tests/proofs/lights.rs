//! Chi-square of the directions that lights are sampled in against the densities that multiple importance sampling asks for: each
//! kind of light by itself, and the choice among all lights of a scene.

use glam::{DVec3, Vec3};
use lumbre_core::hash::unit;
use lumbre_core::light::environment::{EnvironmentLight, build_distribution};
use lumbre_core::light::sun::SunDisc;
use lumbre_core::light::triangle::TriangleLight;
use lumbre_core::{Frame, Rgb};
use lumbre_cpu::light_sampling::{
    LightSample, pdf_environment, pdf_sun, pdf_triangle, sample_light, triangle,
};
use lumbre_scene::compiled::lights::LightGroup;
use lumbre_scene::{
    Background, CompiledScene, Environment, EnvironmentMap, Light, LightId, LightKind, Material, Node, Scene,
    Sun, compile,
};
use lumbre_testkit::chi_square::{self, ChiSquare, Grid};
use lumbre_testkit::measure::grey;
use lumbre_testkit::shapes::add;
use lumbre_testkit::square::{self, Bins};
use std::f64::consts::PI;

const DRAWS: usize = 1_000_000;
const SIGNIFICANCE: f64 = 0.01;
/// Tests that share it: 4 triangles, 3 suns, 4 environments, 4 of the whole sampler, 1 of the choice.
const TESTS: usize = 16;

fn point(k: u32, stream: u32) -> [f32; 2] {
    [unit(k, 2 * stream), unit(k, 2 * stream + 1)]
}

/// Squared distance, in units of |w|, at which a line from `p` crosses a triangle (Möller and Trumbore 1997, in double precision).
fn crossing(t: &TriangleLight, p: Vec3, w: Vec3) -> Option<f32> {
    let [p0, e1, e2, p, w]: [DVec3; 5] = [t.p0, t.e1, t.e2, p, w].map(|v| v.as_dvec3());
    let h = w.cross(e2);
    let s = (p - p0) / e1.dot(h);
    let (b1, q) = (s.dot(h), s.cross(e1));
    let (b2, d) = (w.dot(q), e2.dot(q));
    (b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0 && d > 0.0).then_some((d * d) as f32)
}

struct TriangleRow {
    what: &'static str,
    light: TriangleLight,
    p: Vec3,
}

fn triangles() -> [TriangleRow; 4] {
    let light = |p0: [f32; 3], p1: [f32; 3], p2: [f32; 3]| {
        let [p0, p1, p2] = [p0, p1, p2].map(Vec3::from);
        TriangleLight { p0, e1: p1 - p0, e2: p2 - p0 }
    };
    let square = light([-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, 1.0]);
    let sliver = light([0.0, 0.0, 0.0], [4.0, 0.1, 0.2], [4.0, 0.3, 0.0]);
    [
        TriangleRow { what: "overhead", light: square, p: Vec3::new(-0.3, -1.0, -0.2) },
        TriangleRow { what: "far", light: square, p: Vec3::new(20.0, 15.0, -25.0) },
        TriangleRow { what: "grazing", light: square, p: Vec3::new(2.0, 0.15, 0.3) },
        TriangleRow { what: "a sliver, close", light: sliver, p: Vec3::new(1.0, -0.4, 0.5) },
    ]
}

/// Directions to a triangle in coordinates (s, t) of the unit square that it fills: the direction points at
/// p0 + s ((1 - t) e1 + t e2), and dω = s |q · (e1 × e2)| / |q|³ ds dt with q from the point to there, in double precision.
fn triangle_test(row: &TriangleRow, stream: u32, wrong: impl Fn(Vec3, f32) -> f32) -> ChiSquare {
    let light = &row.light;
    let [o, e1, e2] = [light.p0 - row.p, light.e1, light.e2].map(|v| v.as_dvec3());
    let volume = o.dot(e1.cross(e2));
    let draw = |k: u32| {
        let w = light.sample(row.p, point(k, stream))?.wi.as_dvec3();
        // w is parallel to o + b1 e1 + b2 e2: Cramer's rule.
        let along = w.dot(e1.cross(e2));
        let (b1, b2) = (o.dot(e2.cross(w)) / -along, o.dot(w.cross(e1)) / -along);
        // The rim may round to either side.
        let snap = |v: f64| if (-1e-4..1.0 + 1e-4).contains(&v) { v.clamp(0.0, 1.0) } else { v };
        (along * volume > 0.0).then(|| [snap(b1 + b2), snap(b2 / (b1 + b2))])
    };
    square::test(Bins { columns: 20, rows: 20 }, DRAWS, draw, |s, t| {
        let q = o + (e1 * (1.0 - t) + e2 * t) * s;
        let (w, d2) = (q.normalize().as_vec3(), q.length_squared());
        let jacobian = s * volume.abs() / (d2 * d2.sqrt());
        jacobian * f64::from(wrong(w, d2 as f32) * light.pdf_solid_angle(w, d2 as f32))
    })
}

#[test]
fn triangle_lights() {
    for (i, row) in triangles().iter().enumerate() {
        let r = triangle_test(row, 10 + i as u32, |_, _| 1.0);
        assert!(r.accept(SIGNIFICANCE, TESTS) && r.degrees > 50, "{}: {r:?}", row.what);
        // The density that comes with a sample is the one asked for later.
        for k in 0..1000 {
            let s = row.light.sample(row.p, point(k, 3)).expect("seen from its side");
            let again = row.light.pdf_solid_angle(s.wi, s.distance * s.distance);
            assert!((again / s.pdf_solid_angle - 1.0).abs() < 1e-5, "{}", row.what);
        }
    }
}

/// A density 1 % too large, and one that falls off a little too slowly with the distance over the light, are seen.
#[test]
fn triangle_densities_that_are_a_little_wrong_are_found() {
    for (i, row) in triangles().iter().enumerate() {
        let r = triangle_test(row, 10 + i as u32, |_, _| 1.01);
        assert!(!r.accept(SIGNIFICANCE, TESTS), "{}: {r:?}", row.what);
    }
    // d^1.8 for d², scaled so that the integral is right: only the shape tells.
    let [row, ..] = triangles();
    let slow = |d2: f32| lumbre_core::math::pow(d2, -0.1);
    let mean = triangle_test(&row, 10, |_, d2| slow(d2)).integral as f32;
    let r = triangle_test(&row, 10, |_, d2| slow(d2) / mean);
    assert!(!r.accept(SIGNIFICANCE, TESTS), "{r:?}");
}

/// Directions to a sun against the density of the one that is claimed, in coordinates (share of the disc's area, azimuth); a margin of a quarter lies outside the rim.
fn sun_test(sun: &SunDisc, claimed: &SunDisc, stream: u32, wrong: impl Fn(f64) -> f64) -> ChiSquare {
    let frame = Frame::from_normal(sun.direction);
    let full = 1.25 * f64::from(sun.one_minus_cos);
    let draw = |k: u32| {
        let w = frame.to_local(sun.sample(point(k, stream)));
        let [x, y, z] = w.to_array().map(f64::from);
        let h = (x * x + y * y) / (1.0 + z); // 1 - cos
        // The rim may round to either side.
        let t = h / full;
        let t = if t > 0.8 && t < 0.8 + 1e-3 { 0.8 - 1e-9 } else { t };
        Some([t, (y.atan2(x) / (2.0 * PI)).rem_euclid(1.0)])
    };
    square::test(Bins { columns: 25, rows: 36 }, DRAWS, draw, |t, v| {
        let (h, (sin, cos)) = (t * full, (2.0 * PI * v).sin_cos());
        let r = (h * (2.0 - h)).sqrt();
        let w = Vec3::new((r * cos) as f32, (r * sin) as f32, (1.0 - h) as f32);
        wrong(t) * 2.0 * PI * full * f64::from(claimed.pdf(frame.to_world(w)))
    })
}

fn suns() -> [SunDisc; 3] {
    [(0.02, 1.0, 0.1), (0.3, 0.4, 2.5), (Sun::ANGULAR_RADIUS, 0.7, -1.0)].map(
        |(radius, elevation, azimuth)| {
            SunDisc::new(SunDisc::direction_of(elevation, azimuth), radius, Rgb::WHITE)
        },
    )
}

#[test]
fn sun_cones() {
    for (i, sun) in suns().iter().enumerate() {
        let r = sun_test(sun, sun, 20 + i as u32, |_| 1.0);
        assert!(r.accept(SIGNIFICANCE, TESTS), "{sun:?}: {r:?}");
    }
}

/// A cone 1 % too wide in solid angle, or limb darkening of 3 %, is seen.
#[test]
fn sun_cones_that_are_a_little_wrong_are_found() {
    for (i, sun) in suns().iter().enumerate() {
        let stream = 20 + i as u32;
        let wide = SunDisc { one_minus_cos: 1.01 * sun.one_minus_cos, ..*sun };
        let claimed = sun_test(sun, &wide, stream, |_| 1.0);
        assert!(!claimed.accept(SIGNIFICANCE, TESTS), "{sun:?}: {claimed:?}");
        let dark = sun_test(sun, sun, stream, |t| 1.03 - 0.06 * t / 0.8);
        assert!(!dark.accept(SIGNIFICANCE, TESTS), "{sun:?}: {dark:?}");
    }
}

/// A map with its tables.
struct Map {
    width: u32,
    height: u32,
    pixels: Vec<Rgb>,
    rows: Vec<f32>,
    cells: Vec<f32>,
}

impl Map {
    fn new(width: u32, height: u32, texel: impl Fn(u32) -> f32) -> Self {
        let pixels: Vec<Rgb> = (0..width * height).map(|i| grey(texel(i))).collect();
        let (rows, cells, _) = build_distribution(width, height, &pixels);
        Map { width, height, pixels, rows, cells }
    }
    fn light(&self, rotation: f32) -> EnvironmentLight<'_> {
        EnvironmentLight {
            width: self.width,
            height: self.height,
            rotation,
            pixels: &self.pixels,
            row_cdf: &self.rows,
            cell_cdf: &self.cells,
        }
    }
}

/// A map of one texel, an even one, one with a texel that holds nearly all light, and one with a black half.
fn maps() -> [(&'static str, Map); 4] {
    let noise = |i: u32| unit(i, 41) + 0.05;
    [
        ("one texel", Map::new(1, 1, |_| 2.0)),
        ("noise", Map::new(20, 10, noise)),
        ("a peak", Map::new(20, 10, |i| if i == 67 { 5e4 } else { noise(i) })),
        ("half black", Map::new(8, 12, |i| if i % 8 < 4 { 0.0 } else { noise(i) })),
    ]
}

const ROTATION: f32 = 0.9;

/// Directions in coordinates (longitude, latitude) with three by three bins in each texel, each of which has a density of its own.
fn environment_test(map: &Map, stream: u32, wrong: impl Fn(f64, f64) -> f64) -> ChiSquare {
    let light = map.light(ROTATION);
    let bins = match map.width {
        1 => Bins { columns: 36, rows: 24 },
        w => Bins { columns: 3 * w as usize, rows: 3 * map.height as usize },
    };
    let draw = |k: u32| {
        let (w, _) = light.sample(point(k, stream))?;
        let [x, y, z] = w.to_array().map(f64::from);
        let phi = x.atan2(-z) - f64::from(ROTATION);
        Some([(0.5 + phi / (2.0 * PI)).rem_euclid(1.0), x.hypot(z).atan2(y) / PI])
    };
    square::test(bins, DRAWS, draw, |u, v| {
        let ((sp, cp), (st, ct)) =
            ((2.0 * PI * (u - 0.5) + f64::from(ROTATION)).sin_cos(), (PI * v).sin_cos());
        let w = DVec3::new(st * sp, ct, -st * cp).as_vec3();
        wrong(u, v) * 2.0 * PI * PI * st * f64::from(light.pdf(w))
    })
}

#[test]
fn environment_maps() {
    for (i, (what, map)) in maps().iter().enumerate() {
        let r = environment_test(map, 30 + i as u32, |_, _| 1.0);
        assert!(r.accept(SIGNIFICANCE, TESTS) && r.accepted == 1.0, "{what}: {r:?}");
    }
}

/// Densities 1 % too large, tilted by 3 % along either coordinate, or those of a map turned by a tenth of a texel are seen.
#[test]
fn environment_densities_that_are_a_little_wrong_are_found() {
    for (i, (what, map)) in maps().iter().enumerate() {
        let test = |wrong: &dyn Fn(f64, f64) -> f64| environment_test(map, 30 + i as u32, wrong);
        assert!(!test(&|_, _| 1.01).accept(SIGNIFICANCE, TESTS), "{what}");
        if *what != "a peak" {
            // Nearly all light comes from one texel, over which this is flat.
            assert!(!test(&|u, _| 1.0 + 0.03 * (2.0 * PI * u).sin()).accept(SIGNIFICANCE, TESTS), "{what}");
        }
    }
    let [_, (_, noise), (_, peak), _] = maps();
    for map in [noise, peak] {
        let turned =
            Map { rows: map.rows.clone(), cells: map.cells.clone(), pixels: map.pixels.clone(), ..map };
        let light = turned.light(ROTATION + 0.1 * 2.0 * lumbre_core::math::PI / 20.0);
        let right = map.light(ROTATION);
        // The ratio of the two densities, planted into the test.
        let r = environment_test(&map, 31, |u, v| {
            let phi = 2.0 * PI * (u - 0.5) + f64::from(ROTATION);
            let (st, ct) = (PI * v).sin_cos();
            let w = DVec3::new(st * phi.sin(), ct, -st * phi.cos()).as_vec3();
            f64::from(light.pdf(w) / right.pdf(w))
        });
        assert!(!r.accept(SIGNIFICANCE, TESTS), "{r:?}");
    }
}

/// Two triangles of different power that face the point, a third that turns its dark back to it, an uneven sky and a wide sun.
fn lit_scene() -> CompiledScene {
    let pixels = (0..16 * 8).map(|i| grey(0.3 * unit(i, 51) + 0.05)).collect();
    let environment = Environment {
        background: Background::Map(EnvironmentMap { width: 16, height: 8, pixels }),
        rotation: 0.4,
        sun: Some(Sun { elevation: 0.8, azimuth: 2.0, irradiance: grey(0.8), angular_radius: 0.25 }),
        ..Environment::default()
    };
    let mut scene = Scene { environment, ..Scene::default() };
    let corners = |a: [f32; 3], b: [f32; 3], c: [f32; 3]| lumbre_scene::Primitive {
        positions: [a, b, c].map(Vec3::from).to_vec(),
        indices: vec![0, 1, 2],
        ..lumbre_scene::Primitive::default()
    };
    let glow = |v: f32| Material::emitter(grey(v), false);
    add(&mut scene, corners([-1.0, 1.5, -1.0], [1.0, 1.5, -1.0], [-1.0, 1.6, 1.0]), glow(5.0));
    add(&mut scene, corners([1.5, 0.5, -1.0], [1.5, -0.5, 1.0], [1.5, 1.0, 0.8]), glow(9.0));
    add(&mut scene, corners([-1.0, -1.5, -1.0], [1.0, -1.5, -1.0], [-1.0, -1.5, 1.0]), glow(3.0));
    compile(&scene).expect("a test scene compiles").scene
}

fn draw_light(scene: &CompiledScene, group: LightGroup, p: Vec3, k: u32, stream: u32) -> Option<LightSample> {
    sample_light(scene, group, p, point(k, stream), || unit(k, 900 + stream))
}

const GROUPS: [LightGroup; 2] = [LightGroup::Near, LightGroup::Far];

/// Density of all lights of a group together in a direction; `wrong` scales that of one light.
fn pdf_all(scene: &CompiledScene, group: LightGroup, p: Vec3, w: Vec3, wrong: impl Fn(u32) -> f32) -> f32 {
    if group == LightGroup::Far {
        return wrong(scene.sun.light) * pdf_sun(scene, w)
            + wrong(scene.environment.light) * pdf_environment(scene, w);
    }
    let mut sum = 0.0;
    for (i, record) in scene.triangle_lights.iter().enumerate() {
        let t = triangle(record);
        if let Some(d2) = crossing(&t, p, w).filter(|_| record.side * t.scaled_normal().dot(w) < 0.0) {
            sum += wrong(i as u32) * pdf_triangle(scene, i as u32, w, d2);
        }
    }
    sum
}

fn whole_test(
    scene: &CompiledScene,
    group: LightGroup,
    p: Vec3,
    stream: u32,
    wrong: impl Fn(u32) -> f32,
) -> ChiSquare {
    let grid = Grid::broad().with_edges();
    let draw = |k: u32| draw_light(scene, group, p, k, stream).map(|s| s.wi);
    chi_square::test(&grid, DRAWS, draw, |w| pdf_all(scene, group, p, w, &wrong))
}

/// The scene has what the test is about.
fn assert_is_rich(scene: &CompiledScene) {
    assert_eq!((scene.triangle_lights.len(), scene.lights.len()), (3, 5));
    for light in 0..5 {
        let prob = scene.prob_light(light);
        assert!((0.06..0.9).contains(&prob), "light {light} is chosen with probability {prob}");
    }
}

#[test]
fn all_lights_of_a_scene_together() {
    let scene = lit_scene();
    assert_is_rich(&scene);
    for (i, p) in [Vec3::new(0.1, 0.2, -0.1), Vec3::new(-2.0, -1.0, 1.0)].into_iter().enumerate() {
        for group in GROUPS {
            let r = whole_test(&scene, group, p, 60 + i as u32, |_| 1.0);
            assert!(r.accept(SIGNIFICANCE, TESTS), "{group:?} {p}: {r:?}");
            let all = group == LightGroup::Far;
            assert!((r.accepted == 1.0) == all, "the near light that faces away gives nothing: {r:?}");
        }
    }
}

/// The density that comes with each sample is the one that the light it came from is weighed with.
#[test]
fn samples_carry_the_density_they_are_weighed_with() {
    let scene = lit_scene();
    let p = Vec3::new(0.1, 0.2, -0.1);
    let mut seen = [0; 5];
    let mut off = 0;
    for k in 0..20_000 {
        let Some(s) = draw_light(&scene, GROUPS[k as usize % 2], p, k, 70) else { continue };
        seen[s.light as usize] += 1;
        let pdf = if s.light == scene.sun.light {
            pdf_sun(&scene, s.wi)
        } else if s.light == scene.environment.light {
            pdf_environment(&scene, s.wi)
        } else {
            let record = &scene.triangle_lights[scene.lights[s.light as usize].index as usize];
            crossing(&triangle(record), p, s.wi).map_or(0.0, |d2| pdf_triangle(&scene, s.light, s.wi, d2))
        };
        off += u32::from((pdf / s.pdf - 1.0).abs() > 1e-3);
    }
    // On rims, directions round to the other side.
    assert!(off < 20, "{off} densities disagree");
    assert!(seen[0] > 1000 && seen[1] > 1000 && seen[3] > 500 && seen[4] > 500 && seen[2] == 0, "{seen:?}");
}

/// The density of any one light off by 2 or 3 %, the rarest included, is seen.
#[test]
fn one_light_that_is_a_little_wrong_is_found() {
    let scene = lit_scene();
    let p = Vec3::new(0.1, 0.2, -0.1);
    for light in [0, 1, scene.sun.light, scene.environment.light] {
        let wrong = |l: u32| if l == light { 1.03 } else { 1.0 };
        let group = GROUPS[usize::from(light >= scene.sun.light)];
        let r = whole_test(&scene, group, p, 60, wrong);
        assert!(!r.accept(SIGNIFICANCE, TESTS), "light {light}, {}: {r:?}", scene.prob_light(light));
    }
}

/// Lights that cannot be hit are chosen as often as their probability says, mostly by power.
#[test]
fn lights_are_chosen_by_power() {
    let mut scene = Scene::default();
    add(&mut scene, lumbre_testkit::shapes::cuboid(-Vec3::ONE, Vec3::ONE), Material::diffuse(grey(0.5)));
    let kinds = [
        (LightKind::Point, 10.0),
        (LightKind::Point, 25.0),
        (LightKind::Spot { inner_angle: 0.4, outer_angle: 2.0 }, 40.0),
    ];
    for (i, (kind, intensity)) in kinds.into_iter().enumerate() {
        scene.lights.push(Light { name: String::new(), kind, intensity: grey(intensity) });
        let transform = glam::Mat4::from_translation(Vec3::new(i as f32 - 1.5, 4.0, 0.0))
            * glam::Mat4::from_rotation_x(-1.5);
        scene.add_root(Node { light: Some(LightId(i as u32)), transform, ..Node::default() });
    }
    let scene = compile(&scene).expect("a test scene compiles").scene;
    let p = Vec3::new(0.2, 1.0, 0.3);
    let mut counts = vec![0u64; 4];
    for k in 0..DRAWS as u32 {
        let s = draw_light(&scene, LightGroup::Near, p, k, 80);
        counts[s.map_or(3, |s| s.light as usize)] += 1;
        assert!(s.is_none_or(|s| s.is_delta && s.pdf == scene.prob_light(s.light)));
    }
    let shares: Vec<f64> = (0..3).map(|l| f64::from(scene.prob_light(l))).collect();
    let r = chi_square::compare(&counts, &shares, DRAWS);
    assert!(r.accept(SIGNIFICANCE, TESTS), "{counts:?} {shares:?} {r:?}");
    // A fifth goes evenly to all; the rest by power.
    let by_power = |i: usize| shares[i] - 0.2 / 3.0;
    assert!((by_power(1) / by_power(0) - 2.5).abs() < 1e-3, "{shares:?}");
    let wrong = [shares[0] * 1.02, shares[1] - 0.02 * shares[0], shares[2]];
    assert!(!chi_square::compare(&counts, &wrong, DRAWS).accept(SIGNIFICANCE, TESTS));
}
