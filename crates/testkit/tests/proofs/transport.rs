//! Estimators that must agree: roulette on or off, light sampling on or off, shadow rays through glass of every kind, on scenes
//! with glass, metal, thin walls, partial coverage, textured and punctual lights. (ANALYTIC row 43.)

use glam::{Mat4, Vec3};
use lumbre_core::Camera;
use lumbre_core::film::Film;
use lumbre_core::fresnel;
use lumbre_core::hash::unit;
use lumbre_core::math::{INV_PI, PI, sin_cos};
use lumbre_core::settings::{RenderSettings, TransmissiveShadows};
use lumbre_cpu::CpuBackend;
use lumbre_scene::{
    AlphaMode, Background, Environment, EnvironmentMap, Filter, Image, ImageId, Light, LightId, LightKind,
    Material, Node, Scene, Sun, Texture, TextureId, Wrap,
};
use lumbre_testkit::measure::{
    self, Estimate, OnAll, analytic_settings, film, grey, pinhole, prepare, radiance,
};
use lumbre_testkit::shapes::{add, cuboid, inside_out, rectangle, smooth_icosphere};

pub(super) const ON: RenderSettings = RenderSettings { light_sampling: true, ..BASE };
const OFF: RenderSettings = RenderSettings { light_sampling: false, seed: 2, ..BASE };
const ROULETTE: RenderSettings = RenderSettings { roulette: Some(1), seed: 3, ..BASE };

/// Independent samples, depth of 12, no roulette, glass as it is.
pub(super) const BASE: RenderSettings = RenderSettings {
    max_depth: Some(12),
    rough_bounces: None,
    roulette: None,
    sampler: lumbre_core::sampler::SamplerKind::Independent,
    seed: 1,
    filter: lumbre_core::filter::FilterKind::Box,
    light_sampling: true,
    transmissive_shadows: TransmissiveShadows::Physical,
    diffuse_sampling: lumbre_core::bsdf::DiffuseSampling::Cosine,
    shade_back_faces: false,
    clamp: None,
    transparent_background: false,
    object_colors: false,
};

/// A picture's mean at a number of samples of 24 x 24 pixels.
pub(super) fn mean(backend: &CpuBackend, camera: Camera, settings: RenderSettings, spp: u32) -> Estimate {
    measure::mean(&film(backend, camera, settings, 24, spp))
}

/// Distance of two estimates in standard errors.
fn apart(a: Estimate, b: Estimate) -> f64 {
    (a.mean - b.mean).abs() / a.error.hypot(b.error)
}

/// Two ways to draw a picture give one mean within 4.5 standard errors, which are small enough that 3 % more would not.
pub(super) fn assert_same_mean(a: Estimate, b: Estimate, what: &str) {
    println!(
        "{what}: {:.5} ± {:.5}, {:.5} ± {:.5}, {:.2} apart",
        a.mean,
        a.error,
        b.mean,
        b.error,
        apart(a, b)
    );
    assert!(apart(a, b) < 4.5, "{what}: {a:?} {b:?}");
    let brighter = Estimate { mean: 1.03 * b.mean, error: 1.03 * b.error };
    let darker = Estimate { mean: 0.97 * b.mean, error: 0.97 * b.error };
    assert!(apart(a, brighter) > 4.5 && apart(a, darker) > 4.5, "{what}: 3 % would not be seen: {a:?} {b:?}");
}

/// Light sampling and roulette change nothing but noise. `spp`: with and without light sampling.
pub(super) fn assert_ways_agree(scene: &Scene, camera: Camera, spp: [u32; 2], what: &str) {
    let backend = prepare(scene);
    let on = mean(&backend, camera, ON, spp[0]);
    assert_same_mean(on, mean(&backend, camera, OFF, spp[1]), &format!("{what}, light sampling"));
    assert_same_mean(on, mean(&backend, camera, ROULETTE, spp[0]), &format!("{what}, roulette"));
}

pub(super) fn floor(scene: &mut Scene, half: f32) {
    add(scene, rectangle(Vec3::ZERO, Vec3::Z * half, Vec3::X * half), Material::diffuse(grey(0.7)));
}

pub(super) fn look_down() -> Camera {
    pinhole(Vec3::new(0.6, 2.2, 5.0), Vec3::new(0.0, 0.6, 0.0), 0.35)
}

/// Glass, metal and a diffuse floor under an uneven sky.
#[test]
fn glass_and_metal_under_a_sky() {
    let texel = |i: u32| grey(0.3 + unit(i, 7) + if i == 37 { 12.0 } else { 0.0 });
    let map = EnvironmentMap { width: 16, height: 8, pixels: (0..128).map(texel).collect() };
    let environment =
        Environment { background: Background::Map(map), rotation: 0.3, ..Environment::default() };
    let mut scene = Scene { environment, ..Scene::default() };
    floor(&mut scene, 4.0);
    add(&mut scene, smooth_icosphere(Vec3::new(-0.9, 0.8, 0.0), 0.8, 4), Material::glass(1.5, 0.0));
    add(&mut scene, smooth_icosphere(Vec3::new(0.9, 0.7, 0.4), 0.7, 4), Material::metal(grey(0.9), 0.4));
    add(&mut scene, smooth_icosphere(Vec3::new(0.2, 0.35, 1.4), 0.35, 3), Material::glass(1.4, 0.35));
    assert_ways_agree(&scene, look_down(), [256, 512], "glass and metal under a sky");
}

pub(super) fn lamp(scene: &mut Scene, centre: Vec3, half: f32, material: Material) {
    add(scene, rectangle(centre, Vec3::X * half, Vec3::Z * half), material);
}

fn thin_glass() -> Material {
    Material {
        transmission: 1.0,
        roughness: 0.0,
        base_color: lumbre_core::Rgb::new(0.9, 0.7, 0.8),
        ..Material::default()
    }
}

/// A pane of tinted thin glass between a floor and a lamp, a second one upright beside it.
fn under_a_pane() -> Scene {
    let mut scene = Scene::default();
    floor(&mut scene, 2.0);
    lamp(&mut scene, Vec3::Y * 2.5, 0.7, Material::emitter(grey(4.0), false));
    add(&mut scene, rectangle(Vec3::Y * 1.5, Vec3::X * 1.2, Vec3::Z * 1.2), thin_glass());
    add(&mut scene, rectangle(Vec3::new(0.8, 0.6, 0.0), Vec3::Z * 0.8, Vec3::Y * 0.6), thin_glass());
    scene
}

/// Shadow rays pass thin glass, and paths that pass it meet the lamp with the weight of the vertex before.
#[test]
fn thin_glass_before_a_lamp() {
    assert_ways_agree(&under_a_pane(), look_down(), [512, 8192], "thin glass before a lamp");
}

/// Thin glass is exact, so what shadow rays do at solids does not change one bit of it.
#[test]
fn thin_glass_is_the_same_in_every_mode() {
    let backend = prepare(&under_a_pane());
    let [auto, physical, straight] = MODES.map(|m| film(&backend, look_down(), with_shadows(m), 24, 8));
    assert!(auto == physical && physical == straight);
    assert!(measure::mean(&auto).mean > 0.03);
}

const MODES: [TransmissiveShadows; 3] =
    [TransmissiveShadows::Auto, TransmissiveShadows::Physical, TransmissiveShadows::Straight];

fn with_shadows(mode: TransmissiveShadows) -> RenderSettings {
    RenderSettings { transmissive_shadows: mode, ..ON }
}

/// Surfaces that are there in part, before a lamp and as the lamp.
#[test]
fn partial_coverage_before_lamps() {
    let blend = |material: Material, alpha: f32| Material { alpha, alpha_mode: AlphaMode::Blend, ..material };
    let mut scene = Scene::default();
    floor(&mut scene, 2.0);
    lamp(&mut scene, Vec3::new(-0.6, 2.5, 0.0), 0.6, Material::emitter(grey(5.0), false));
    lamp(&mut scene, Vec3::new(1.0, 2.2, 0.3), 0.6, blend(Material::emitter(grey(5.0), true), 0.35));
    let veil = rectangle(Vec3::new(0.0, 1.6, 0.0), Vec3::X * 1.1, Vec3::Z * 1.1);
    add(&mut scene, veil, blend(Material::diffuse(grey(0.6)), 0.4));
    assert_ways_agree(&scene, look_down(), [1024, 4096], "partial coverage");
}

/// A lamp with a picture on it: dark, bright and black texels.
#[test]
fn textured_lamp() {
    let mut scene = Scene::default();
    let texel =
        |i: u32| if i.is_multiple_of(3) { [0; 3] } else { [0, 1, 2].map(|c| (255.0 * unit(i, c)) as u8) };
    let rgba8 = (0..64)
        .flat_map(|i| {
            let [r, g, b] = texel(i);
            [r, g, b, 255]
        })
        .collect();
    scene.add_image(Image { name: "lamp".into(), width: 8, height: 8, rgba8 });
    let texture =
        Texture { image: ImageId(0), wrap_s: Wrap::Repeat, wrap_t: Wrap::Repeat, filter: Filter::Linear };
    scene.textures.push(texture);
    floor(&mut scene, 2.0);
    let glow = Material { emissive_texture: Some(TextureId(0).into()), ..Material::emitter(grey(9.0), true) };
    lamp(&mut scene, Vec3::Y * 2.0, 1.0, glow);
    add(
        &mut scene,
        cuboid(Vec3::new(-0.4, 0.0, -0.4), Vec3::new(0.4, 0.8, 0.4)),
        Material::diffuse(grey(0.8)),
    );
    assert_ways_agree(&scene, look_down(), [1024, 2048], "textured lamp");
}

fn spot(scene: &mut Scene, position: Vec3, intensity: f32) {
    let kind = LightKind::Spot { inner_angle: 0.3, outer_angle: 0.7 };
    punctual(scene, kind, position, intensity);
}

/// A light that shines straight down.
fn punctual(scene: &mut Scene, kind: LightKind, position: Vec3, intensity: f32) {
    scene.lights.push(Light { name: String::new(), kind, intensity: grey(intensity) });
    let transform = Mat4::from_translation(position) * Mat4::from_rotation_x(-0.5 * PI);
    let light = Some(LightId(scene.lights.len() as u32 - 1));
    scene.add_root(Node { light, transform, ..Node::default() });
}

/// A spot light's radiance off a floor, inside its cone, in its rim and outside: ρ/π I f(cos) cos / d², with the falloff f that
/// `KHR_lights_punctual` recommends.
#[test]
fn spot_light_has_its_falloff() {
    let mut scene = Scene::default();
    floor(&mut scene, 4.0);
    spot(&mut scene, Vec3::Y * 2.0, 50.0);
    let on_all = OnAll::new(&scene);
    for angle in [0.1f32, 0.45, 0.6] {
        let (sin, cos) = sin_cos(angle);
        let [inner, outer] = [0.3f32, 0.7].map(|a| f64::from(sin_cos(a).1));
        let ramp = ((f64::from(cos) - outer) / (inner - outer)).clamp(0.0, 1.0);
        let expected = 0.7 * f64::from(INV_PI) * 50.0 * ramp * ramp * f64::from(cos).powi(3) / 4.0;
        let at = Vec3::new(2.0 * sin / cos, 0.0, 0.0);
        let camera = pinhole(at + Vec3::new(0.3, 1.0, 0.5), at, 1e-4);
        on_all.assert_radiance(camera, analytic_settings(), expected, 0.0, &format!("spot at {angle}"));
    }
    let outside = pinhole(Vec3::new(2.5, 1.0, 0.0), Vec3::new(2.0, 0.0, 0.0), 1e-4);
    assert_eq!(radiance(&prepare(&scene), outside, analytic_settings()).mean, 0.0);
}

/// Roulette changes nothing where a spot lights a closed room.
#[test]
fn spot_light_in_a_room() {
    let mut scene = Scene::default();
    let walls = Material::diffuse(grey(0.75));
    add(&mut scene, inside_out(cuboid(Vec3::new(-2.0, 0.0, -2.0), Vec3::new(2.0, 3.0, 6.0))), walls);
    spot(&mut scene, Vec3::new(0.3, 2.8, 0.0), 30.0);
    let backend = prepare(&scene);
    assert_same_mean(
        mean(&backend, look_down(), ON, 128),
        mean(&backend, look_down(), ROULETTE, 256),
        "spot in a room, roulette",
    );
}

/// A glass sphere between a floor and a light above it, seen from the side.
fn under_a_sphere(light: impl FnOnce(&mut Scene)) -> (CpuBackend, Camera) {
    let mut scene = Scene::default();
    floor(&mut scene, 0.5);
    add(&mut scene, smooth_icosphere(Vec3::Y * 1.2, 0.5, 5), Material::glass(1.5, 0.0));
    light(&mut scene);
    (prepare(&scene), pinhole(Vec3::new(1.6, 0.5, 0.0), Vec3::ZERO, 0.02))
}

/// A small square lamp, 4 m above the floor.
fn small_lamp(scene: &mut Scene) {
    lamp(scene, Vec3::Y * 4.0, 0.1, Material::emitter(grey(100.0), false));
}

/// A larger one, which paths find more often.
fn large_lamp(scene: &mut Scene) {
    lamp(scene, Vec3::Y * 4.0, 0.5, Material::emitter(grey(4.0), false));
}

/// What the floor returns of light that arrives along the axis of the sphere, times `passes` surfaces met at right angles.
fn through(irradiance: f64, passes: i32) -> f64 {
    let transmitted = 1.0 - f64::from(fresnel::dielectric(1.0, 1.5));
    0.7 * f64::from(INV_PI) * irradiance * transmitted.powi(passes)
}

/// Towards a lamp that can be hit, `physical` and `auto` are one, and make the bright spot by paths alone.
#[test]
fn caustics_of_lamps_come_from_paths() {
    let (backend, camera) = under_a_sphere(large_lamp);
    let [auto, physical] = [MODES[0], MODES[1]].map(|m| film(&backend, camera, with_shadows(m), 24, 64));
    assert!(auto == physical);
    let on = mean(&backend, camera, ON, 2048);
    assert_same_mean(on, mean(&backend, camera, OFF, 2048), "caustic of a lamp");
    let without_glass = through(4.0 / 16.0, 0);
    assert!(on.mean > 2.0 * without_glass, "the sphere gathers light: {on:?} against {without_glass}");
}

/// `straight` leaves the caustic out and lets shadow rays pass with Fresnel at both surfaces: no spot, one value.
#[test]
fn straight_shadows_have_no_caustic() {
    let (backend, camera) = under_a_sphere(small_lamp);
    let settings = with_shadows(TransmissiveShadows::Straight);
    let seen = measure::mean(&film(&backend, camera, settings, 24, 2048));
    let expected = through(100.0 * 0.04 / 16.0, 2);
    // The lamp is not quite a point, and the floor seen is not quite one either; reflections inside the sphere add some.
    assert!((seen.mean / expected - 1.0).abs() < 0.03, "{seen:?} {expected}");
}

/// Towards a light that no path can hit, `auto` and `straight` are one and let it pass; `physical` leaves the shadow black.
#[test]
fn point_lights_shine_straight_through_or_not_at_all() {
    let (backend, camera) = under_a_sphere(|s| punctual(s, LightKind::Point, Vec3::Y * 4.0, 40.0));
    let [auto, physical, straight] = MODES.map(|m| film(&backend, camera, with_shadows(m), 24, 64));
    assert!(auto == straight);
    let expected = through(40.0 / 16.0, 2);
    let seen = measure::mean(&auto).mean;
    assert!((seen / expected - 1.0).abs() < 0.01, "{seen} {expected}");
    assert_eq!(measure::mean(&physical).mean, 0.0);
}

/// Mean of (1 - F) / (1 + F), what a slab lets through in all orders, over a sun, weighted with the cosine on a floor.
fn slab_transmittance(sun: &Sun) -> f64 {
    const STEPS: usize = 64;
    let (sin_e, cos_e) = sin_cos(sun.elevation);
    let cap = 1.0 - sin_cos(sun.angular_radius).1;
    let (mut passed, mut total) = (0.0, 0.0);
    for i in 0..STEPS * STEPS {
        let [u, v] = [i % STEPS, i / STEPS].map(|k| (k as f32 + 0.5) / STEPS as f32);
        let c = 1.0 - u * cap;
        let cos = c * sin_e + (1.0 - c * c).sqrt() * sin_cos(2.0 * PI * v).1 * cos_e;
        let f = f64::from(fresnel::dielectric(cos, 1.5));
        passed += f64::from(cos) * (1.0 - f) / (1.0 + f);
        total += f64::from(cos);
    }
    passed / total
}

/// Under a wide slab of glass light keeps its direction in the end, so every mode, and paths alone, find what the slab lets through
/// of a wide sun, and all of an even sky, since what it reflects is the same sky. The floor is a small patch, so that nothing
/// comes back to it.
#[test]
fn slabs_let_through_what_they_should() {
    let sun = Sun { elevation: 0.9, azimuth: 0.4, irradiance: grey(2.0), angular_radius: 0.2 };
    let background = Background::Constant(grey(0.5));
    let environment = Environment { background, sun: Some(sun), ..Environment::default() };
    let mut scene = Scene { environment, ..Scene::default() };
    floor(&mut scene, 0.01);
    let slab = cuboid(Vec3::new(-40.0, 0.5, -40.0), Vec3::new(40.0, 0.7, 40.0));
    add(&mut scene, slab, Material::glass(1.5, 0.0));
    let camera = pinhole(Vec3::new(0.4, 0.25, 0.1), Vec3::ZERO, 1e-3);
    let backend = prepare(&scene);
    let irradiance = 2.0 * f64::from(sin_cos(0.9).0) * slab_transmittance(&sun) + 0.5 * f64::from(PI);
    let expected = 0.7 * f64::from(INV_PI) * irradiance;
    for (i, mode) in MODES.into_iter().enumerate() {
        for light_sampling in [true, false] {
            let seed = 2 * i as u32 + u32::from(light_sampling);
            let settings = RenderSettings { light_sampling, max_depth: Some(40), seed, ..with_shadows(mode) };
            let seen = mean(&backend, camera, settings, 1024);
            let what =
                format!("slab, {mode:?}, light sampling {light_sampling}: {seen:?}, expected {expected}");
            println!("{what}");
            assert!(seen.z(expected, 0.0) < 4.5, "{what}");
            assert!(seen.z(1.03 * expected, 0.0) > 4.5 && seen.z(0.97 * expected, 0.0) > 4.5, "{what}");
        }
    }
}

/// The films compared bit by bit do differ where the modes differ.
#[test]
fn modes_differ_where_they_should() {
    let (backend, camera) = under_a_sphere(small_lamp);
    let films: Vec<Film> = MODES.map(|m| film(&backend, camera, with_shadows(m), 24, 8)).into();
    assert!(films[0] == films[1] && films[1] != films[2]);
}

/// A lamp in a closed room gives the same light whether or not a sun outside, which would outshine it a thousand times, makes
/// light sampling ask for the lamp now and then only.
#[test]
fn a_lamp_beside_a_sun_that_does_not_shine_in() {
    let mut scene = Scene::default();
    let walls = inside_out(cuboid(Vec3::splat(-2.0), Vec3::splat(2.0)));
    add(&mut scene, walls, Material::diffuse(grey(0.5)));
    add(
        &mut scene,
        rectangle(Vec3::Y * 1.9, Vec3::X * 0.3, Vec3::Z * 0.3),
        Material::emitter(grey(4.0), false),
    );
    let camera = pinhole(Vec3::new(0.5, -0.5, 1.5), Vec3::new(0.0, -1.5, -0.5), 0.5);
    let alone = mean(&prepare(&scene), camera, ON, 128);
    scene.environment.sun = Some(Sun {
        elevation: 0.9,
        azimuth: 0.3,
        irradiance: grey(4000.0),
        angular_radius: Sun::ANGULAR_RADIUS,
    });
    let seeded = RenderSettings { seed: 9, ..ON };
    assert_same_mean(alone, mean(&prepare(&scene), camera, seeded, 1024), "a lamp beside a sun");
}
