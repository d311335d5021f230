//! Scenes whose radiance is known in closed form, rendered by the path tracer. Each row names what is computed; the numbers are
//! derived beside it.

use glam::Vec3;
use lumbre_core::Camera;
use lumbre_core::math::{INV_PI, PI};
use lumbre_core::sampler::SamplerKind;
use lumbre_core::settings::RenderSettings;
use lumbre_scene::{
    Background, Environment, Light, LightId, LightKind, Material, Mesh, Node, Primitive, Scene, Volume,
};
use lumbre_testkit::measure::{OnAll, analytic_settings, film, grey, mean, pinhole, prepare};
use lumbre_testkit::shapes::{
    add, bumpy_icosphere, cuboid, disc, icosphere, inside_out, rectangle, smooth_icosphere,
};

/// Relative error of the shapes: an icosphere of level 5 lies up to 4e-4 of its radius inside its sphere.
const GEOMETRY: f64 = 4e-4;

fn furnace() -> Scene {
    let environment = Environment { background: Background::Constant(grey(1.0)), ..Environment::default() };
    Scene { environment, ..Scene::default() }
}

/// Every way of sampling that must give the same radiance.
fn variants(base: RenderSettings) -> [(&'static str, RenderSettings); 4] {
    [
        ("light sampling on", base),
        ("light sampling off", RenderSettings { light_sampling: false, ..base }),
        ("roulette from the first event", RenderSettings { roulette: Some(1), ..base }),
        ("Sobol", RenderSettings { sampler: SamplerKind::Sobol, ..base }),
    ]
}

/// Checks a scene in every variant. Lights that cannot be hit are only found with light sampling.
fn check(scene: &Scene, camera: Camera, base: RenderSettings, expected: f64, what: &str) {
    let has_delta_lights = !scene.lights.is_empty();
    let on_all = OnAll::new(scene);
    for (name, settings) in variants(base) {
        if has_delta_lights && !settings.light_sampling {
            continue;
        }
        on_all.assert_radiance(camera, settings, expected, GEOMETRY, &format!("{what}, {name}"));
    }
}

/// Row 1: albedo 1 in an environment of 1 is invisible, whatever the shape.
#[test]
fn white_furnace_of_closed_bodies() {
    for shape in
        [icosphere(Vec3::ZERO, 1.0, 2), bumpy_icosphere(Vec3::ZERO, 1.0, 4), cuboid(-Vec3::ONE, Vec3::ONE)]
    {
        let mut scene = furnace();
        add(&mut scene, shape, Material::diffuse(grey(1.0)));
        let camera = pinhole(Vec3::new(1.0, 2.0, 4.0), Vec3::ZERO, 0.4);
        let found = RenderSettings { light_sampling: false, ..analytic_settings() };
        for p in film(&prepare(&scene), camera, found, 24, 4).pixels() {
            assert!((p.radiance().luminance() - 1.0).abs() < 1e-4, "{:?}", p.radiance());
        }
        check(&scene, camera, analytic_settings(), 1.0, "white furnace");
    }
}

/// Row 1 with interpolated normals: energy is lost where they point below the surface, never gained.
#[test]
fn white_furnace_with_interpolated_normals() {
    let mut scene = furnace();
    add(&mut scene, smooth_icosphere(Vec3::ZERO, 1.0, 3), Material::diffuse(grey(1.0)));
    let found = RenderSettings { light_sampling: false, ..analytic_settings() };
    let seen = film(&prepare(&scene), pinhole(Vec3::Z * 4.0, Vec3::ZERO, 0.2), found, 24, 64);
    for p in seen.pixels() {
        assert!(p.radiance().luminance() < 1.0001, "{:?}", p.radiance());
    }
    let mean = mean(&seen).mean;
    assert!((0.98..1.0001).contains(&mean), "{mean}");
}

/// Row 2.
#[test]
fn grey_sphere_in_a_furnace() {
    let mut scene = furnace();
    add(&mut scene, icosphere(Vec3::ZERO, 1.0, 3), Material::diffuse(grey(0.5)));
    check(&scene, pinhole(Vec3::Z * 4.0, Vec3::ZERO, 0.1), analytic_settings(), 0.5, "grey sphere");
}

/// The inside of a sphere that emits and reflects.
fn glowing_sphere(le: f32, albedo: f32) -> Scene {
    let mut scene = Scene::default();
    let material = Material { emission: grey(le), ..Material::diffuse(grey(albedo)) };
    add(&mut scene, inside_out(icosphere(Vec3::ZERO, 1.0, 3)), Material { double_sided: false, ..material });
    scene
}

/// Row 3: Le / (1 - ρ).
#[test]
fn inside_a_glowing_sphere() {
    let camera = pinhole(Vec3::new(0.1, 0.2, 0.3), Vec3::new(1.0, 0.3, -0.2), 0.3);
    check(&glowing_sphere(0.5, 0.5), camera, analytic_settings(), 1.0, "glowing sphere");
}

/// Row 4: partial sums of the geometric series.
#[test]
fn depth_counts_scattering_events() {
    let scene = glowing_sphere(1.0, 0.8);
    let camera = pinhole(Vec3::new(0.1, 0.2, 0.3), Vec3::new(1.0, 0.3, -0.2), 0.3);
    for (depth, expected) in [(1, 1.8), (2, 2.44), (3, 2.952), (4, 3.3616)] {
        let settings = RenderSettings { max_depth: Some(depth), ..analytic_settings() };
        check(&scene, camera, settings, expected, &format!("depth {depth}"));
    }
}

/// The same by the number of rough bounces before the one that the camera sees; a clear window in the way does not count.
#[test]
fn rough_bounces_are_counted() {
    let mut scene = glowing_sphere(1.0, 0.8);
    let window = Material { transmission: 1.0, roughness: 0.0, ior: 1.0, ..Material::default() };
    add(&mut scene, icosphere(Vec3::new(0.1, 0.2, 0.3), 0.2, 2), window);
    let camera = pinhole(Vec3::new(0.1, 0.2, 0.3), Vec3::new(1.0, 0.3, -0.2), 0.3);
    for (rough_bounces, expected) in [(0, 1.8), (1, 2.44), (2, 2.952)] {
        let settings = RenderSettings { rough_bounces: Some(rough_bounces), ..analytic_settings() };
        check(&scene, camera, settings, expected, &format!("{rough_bounces} rough bounces"));
    }
}

/// Row 5: a point light of intensity π: direct ρ I / π, then the series.
#[test]
fn point_light_inside_a_sphere() {
    let mut scene = Scene::default();
    add(&mut scene, inside_out(icosphere(Vec3::ZERO, 1.0, 5)), Material::diffuse(grey(0.5)));
    scene.lights.push(Light { name: String::new(), kind: LightKind::Point, intensity: grey(PI) });
    scene.add_root(Node { light: Some(LightId(0)), ..Node::default() });
    let camera = pinhole(Vec3::new(0.2, 0.1, 0.0), Vec3::new(0.5, 0.6, -0.4), 0.3);
    check(&scene, camera, analytic_settings(), 1.0, "point light in a sphere");
}

/// Row 6: plates 1 apart, 1000 wide, the lower one emitting 1, both of albedo ½: L0 = 4/3, L1 = 2/3.
#[test]
fn parallel_plates() {
    const WIDE: f32 = 1000.0;
    let mut scene = Scene::default();
    let lower = rectangle(Vec3::ZERO, Vec3::Z * WIDE, Vec3::X * WIDE);
    let upper = rectangle(Vec3::Y, Vec3::X * WIDE, Vec3::Z * WIDE);
    let glow = Material { emission: grey(1.0), double_sided: false, ..Material::diffuse(grey(0.5)) };
    add(&mut scene, lower, glow);
    add(&mut scene, upper, Material::diffuse(grey(0.5)));
    let eye = Vec3::new(0.0, 0.5, 0.0);
    check(
        &scene,
        pinhole(eye, Vec3::new(0.1, 0.0, 0.0), 0.1),
        analytic_settings(),
        4.0 / 3.0,
        "emitting plate",
    );
    check(
        &scene,
        pinhole(eye, Vec3::new(0.1, 1.0, 0.0), 0.1),
        analytic_settings(),
        2.0 / 3.0,
        "reflecting plate",
    );
}

/// Radiance that leaves a Lambert floor of albedo 0.8 at the origin under lights above it: 0.8 E / π.
fn check_irradiance(lights: Vec<Primitive>, irradiance: f64, what: &str) {
    let mut scene = Scene::default();
    add(&mut scene, rectangle(Vec3::ZERO, Vec3::Z * 0.01, Vec3::X * 0.01), Material::diffuse(grey(0.8)));
    for light in lights {
        add(&mut scene, light, Material::emitter(grey(1.0), false));
    }
    let camera = pinhole(Vec3::new(0.6, 0.3, 0.0), Vec3::ZERO, 1e-4);
    let settings = RenderSettings { max_depth: Some(1), ..analytic_settings() };
    check(&scene, camera, settings, 0.8 * irradiance / f64::from(PI), what);
}

/// Row 7: π (r/d)².
#[test]
fn sphere_light() {
    check_irradiance(vec![icosphere(Vec3::Y * 2.0, 1.0, 5)], std::f64::consts::FRAC_PI_4, "sphere light");
}

/// Row 10: π r² / (r² + d²).
#[test]
fn disc_lights() {
    for (d, e) in [(1.0, std::f64::consts::FRAC_PI_2), (2.0, 0.628_319)] {
        check_irradiance(vec![disc(Vec3::Y * d, Vec3::NEG_Y, 1.0, 256)], e, "disc light");
    }
}

/// Rows 11 and 12: E = 4 (a/√(1+a²)) atan(b/√(1+a²)) at height 1 for a half square a = b (twice, over 2).
#[test]
fn rectangle_lights() {
    let light = |half: f32, y: f32| rectangle(Vec3::Y * y, Vec3::X * half, Vec3::Z * half);
    let expected = |a: f64| 4.0 * (a / (1.0 + a * a).sqrt()) * (a / (1.0 + a * a).sqrt()).atan();
    assert!((expected(1.0) - 1.7408).abs() < 5e-5 && (expected(0.25) - 0.2308).abs() < 5e-5);
    check_irradiance(vec![light(1.0, 1.0)], expected(1.0), "2x2 at height 1");
    check_irradiance(vec![light(0.5, 2.0)], expected(0.25), "1x1 at height 2");
}

/// Row 15: the mean irradiance of a unit square over π is the form factor. The camera looks down from afar; a light's back is
/// invisible to it.
#[test]
fn form_factors_of_squares() {
    let half = 0.5;
    let parallel = |d: f32| rectangle(Vec3::Y * d, Vec3::X * half, Vec3::Z * half);
    let beside = rectangle(Vec3::new(-half, half, 0.0), Vec3::Y * half, Vec3::Z * half);
    for (light, expected, what) in [
        (parallel(1.0), 0.199_825, "parallel, d = 1"),
        (parallel(2.0), 0.068_590, "parallel, d = 2"),
        (beside, 0.200_044, "perpendicular"),
    ] {
        let mut scene = Scene::default();
        add(&mut scene, rectangle(Vec3::ZERO, Vec3::Z * half, Vec3::X * half), Material::diffuse(grey(1.0)));
        add(&mut scene, light, Material::emitter(grey(1.0), false));
        let camera = pinhole(Vec3::Y * 2000.0, Vec3::ZERO, (half / 2000.0).atan());
        let settings = RenderSettings { max_depth: Some(1), ..analytic_settings() };
        check(&scene, camera, settings, expected, what);
    }
}

/// Row 20: 100 cd at 2 m, and 1 lx from 60°.
#[test]
fn punctual_lights_keep_their_units() {
    let light = |kind, intensity: f32| Light { name: String::new(), kind, intensity: grey(intensity) };
    let tilt = glam::Mat4::from_rotation_x(-PI / 6.0); // -z turned 30° below the horizon: 60° from the normal
    for (kind, intensity, node, e) in [
        (LightKind::Point, 100.0, glam::Mat4::from_translation(Vec3::Y * 2.0), 25.0),
        (LightKind::Directional, 1.0, tilt, 0.5),
    ] {
        let mut scene = Scene::default();
        add(&mut scene, rectangle(Vec3::ZERO, Vec3::Z, Vec3::X), Material::diffuse(grey(1.0)));
        scene.lights.push(light(kind, intensity));
        scene.add_root(Node { light: Some(LightId(0)), transform: node, ..Node::default() });
        let camera = pinhole(Vec3::new(0.6, 0.3, 0.0), Vec3::ZERO, 1e-4);
        check(&scene, camera, analytic_settings(), e * f64::from(INV_PI), "punctual light");
    }
}

/// Row 28: a slab of glass before a wall that emits 1 shows its transmittance, all orders of reflection; as a solid and as a thin wall.
#[test]
fn glass_slabs() {
    let thin = Material { transmission: 1.0, roughness: 0.0, ..Material::default() };
    let slab = cuboid(Vec3::new(-50.0, -50.0, -0.1), Vec3::new(50.0, 50.0, 0.1));
    let pane = rectangle(Vec3::ZERO, Vec3::X * 50.0, Vec3::Y * 50.0);
    for (shape, glass, what) in [(slab, Material::glass(1.5, 0.0), "solid"), (pane, thin, "thin")] {
        for (angle, t) in [(0.0f32, 0.923_077), (PI / 3.0, 0.836_2)] {
            let mut scene = Scene::default();
            add(&mut scene, shape.clone(), glass.clone());
            let wall = rectangle(Vec3::Z * -2.0, Vec3::X * 200.0, Vec3::Y * 200.0);
            add(&mut scene, wall, Material::emitter(grey(1.0), false));
            let (s, c) = lumbre_core::math::sin_cos(angle);
            let camera = pinhole(Vec3::new(3.0 * s, 0.0, 3.0 * c), Vec3::ZERO, 1e-3);
            check(&scene, camera, analytic_settings(), t, what);
        }
    }
}

/// Row 39: clear glass in a furnace is invisible: solid, rough within its loss, and from inside a nest of two.
#[test]
fn glass_in_a_furnace() {
    let camera = pinhole(Vec3::Z * 4.0, Vec3::ZERO, 0.3);
    let mut scene = furnace();
    add(&mut scene, icosphere(Vec3::ZERO, 1.0, 4), Material::glass(1.5, 0.0));
    check(&scene, camera, analytic_settings(), 1.0, "clear glass sphere");
    add(&mut scene, icosphere(Vec3::ZERO, 0.5, 4), Material::glass(1.33, 0.0));
    check(&scene, camera, analytic_settings(), 1.0, "water inside glass");
}

/// Row 39 for solids that overlap: two boxes of one glass, and water drawn a little into the glass around it.
#[test]
fn overlapping_solids_in_a_furnace() {
    let camera = pinhole(Vec3::new(0.1, 0.2, 4.0), Vec3::new(0.1, 0.2, 0.0), 0.1);
    let block = |z: f32| cuboid(Vec3::new(-1.0, -1.0, z - 0.5), Vec3::new(1.0, 1.0, z + 0.5));
    for second in [1.5, 1.33] {
        let mut scene = furnace();
        let glass = scene.add_material(Material::glass(1.5, 0.0));
        let other = if second == 1.5 { glass } else { scene.add_material(Material::glass(second, 0.0)) };
        for (shape, material) in [(block(0.0), glass), (block(0.7), other)] {
            let primitives = vec![Primitive { material: Some(material), ..shape }];
            let mesh = scene.add_mesh(Mesh { name: String::new(), primitives });
            scene.add_root(Node { mesh: Some(mesh), ..Node::default() });
        }
        check(&scene, camera, analytic_settings(), 1.0, "overlapping solids");
    }
}

/// A pane that claims to be solid but is open does not put the camera inside it.
#[test]
fn an_open_solid_does_not_enclose_the_camera() {
    let mut scene = furnace();
    let dark = Volume { thickness: 1.0, attenuation_color: grey(0.01), attenuation_distance: 0.1 };
    let pane = rectangle(Vec3::Y, Vec3::X * 50.0, Vec3::NEG_Z * 50.0);
    add(&mut scene, pane, Material { volume: Some(dark), ..Material::glass(1.5, 0.0) });
    let camera = pinhole(Vec3::ZERO, Vec3::new(0.0, -1.0, 0.1), 0.1);
    check(&scene, camera, analytic_settings(), 1.0, "below an open pane");
}

/// A lamp in a closed room is found, whatever shines outside: ρ I / (π d²) beside a sun of 100 000 lx on a plain of 4 km.
#[test]
fn a_lamp_does_not_vanish_beside_a_sun_outside() {
    let mut scene = Scene::default();
    add(&mut scene, inside_out(cuboid(Vec3::splat(-2.0), Vec3::splat(2.0))), Material::diffuse(grey(0.5)));
    add(
        &mut scene,
        rectangle(Vec3::Y * -3.0, Vec3::Z * 2000.0, Vec3::X * 2000.0),
        Material::diffuse(grey(0.5)),
    );
    for (kind, intensity) in [(LightKind::Directional, 1e5), (LightKind::Point, 100.0)] {
        let light = Some(LightId(scene.lights.len() as u32));
        scene.lights.push(Light { name: String::new(), kind, intensity: grey(intensity) });
        let transform = glam::Mat4::from_rotation_x(-0.5 * PI);
        scene.add_root(Node { light, transform, ..Node::default() });
    }
    let settings = RenderSettings { max_depth: Some(1), ..analytic_settings() };
    let camera = pinhole(Vec3::new(0.5, 0.0, 0.0), Vec3::Y * -2.0, 1e-4);
    check(&scene, camera, settings, 0.5 * 100.0 / (4.0 * f64::from(PI)), "lamp beside a sun");
}

/// Row 40: a Lambert surface of albedo 1, cosine sampling, no light sampling: every sample is 1.
#[test]
fn cosine_sampling_has_no_variance_in_a_furnace() {
    let mut scene = furnace();
    add(&mut scene, icosphere(Vec3::ZERO, 1.0, 2), Material::diffuse(grey(1.0)));
    let settings = RenderSettings { light_sampling: false, ..analytic_settings() };
    let spp = 256;
    let seen = film(&prepare(&scene), pinhole(Vec3::Z * 4.0, Vec3::ZERO, 0.1), settings, 8, spp);
    for p in seen.pixels() {
        let variance = f64::from(p.error()).powi(2) * f64::from(spp);
        assert!(variance <= 1e-10 && (p.radiance().g - 1.0).abs() < 1e-5, "{variance:e} {:?}", p.radiance());
    }
}

/// Row 46: radiance inside glass is n² times that outside; the camera finds out for itself that it is inside.
#[test]
fn camera_inside_glass() {
    let mut scene = furnace();
    add(&mut scene, icosphere(Vec3::ZERO, 1.0, 4), Material::glass(1.5, 0.0));
    let camera = pinhole(Vec3::new(0.05, 0.1, 0.0), Vec3::new(1.0, 0.2, 0.1), 0.2);
    check(&scene, camera, analytic_settings(), 2.25, "inside glass");
}

/// The checks above can fail: a light 1 % too bright is seen.
#[test]
#[should_panic(expected = "grey sphere")]
fn one_per_cent_too_much_fails() {
    let environment = Environment { background: Background::Constant(grey(1.01)), ..Environment::default() };
    let mut scene = Scene { environment, ..Scene::default() };
    add(&mut scene, icosphere(Vec3::ZERO, 1.0, 3), Material::diffuse(grey(0.5)));
    check(&scene, pinhole(Vec3::Z * 4.0, Vec3::ZERO, 0.1), analytic_settings(), 0.5, "grey sphere");
}
