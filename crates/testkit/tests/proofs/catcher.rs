//! Shadow catchers: the share of direct light that they leave of what lies behind them.

use glam::{Mat4, Vec3};
use lumbre_core::film::Film;
use lumbre_core::sampler::SamplerKind;
use lumbre_core::settings::RenderSettings;
use lumbre_core::{Camera, Rgb};
use lumbre_scene::{
    AlphaMode, Background, Environment, Light, LightId, LightKind, Material, Node, Primitive, Scene,
};
use lumbre_testkit::measure::{analytic_settings, film, grey, mean, pinhole, prepare};
use lumbre_testkit::shapes::{add, disc, rectangle};

/// A small catcher at the origin that faces up, in surroundings of radiance 1.
fn caught_under_a_sky() -> Scene {
    let environment = Environment { background: Background::Constant(grey(1.0)), ..Environment::default() };
    let mut scene = Scene { environment, ..Scene::default() };
    catcher(&mut scene);
    scene
}

fn catcher(scene: &mut Scene) {
    let material = Material { shadow_catcher: true, ..Material::diffuse(grey(0.5)) };
    add(scene, rectangle(Vec3::ZERO, Vec3::Z * 0.01, Vec3::X * 0.01), material);
}

fn black(scene: &mut Scene, shape: Primitive) {
    add(scene, shape, Material::diffuse(grey(0.0)));
}

fn camera() -> Camera {
    pinhole(Vec3::new(-1.0, 1.0, 0.1), Vec3::ZERO, 1e-4)
}

fn sobol() -> RenderSettings {
    RenderSettings { sampler: SamplerKind::Sobol, ..analytic_settings() }
}

fn seen(scene: &Scene, settings: RenderSettings, spp: u32) -> Film {
    film(&prepare(scene), camera(), settings, 16, spp)
}

/// Mean of what is seen through the catcher: the share, since all that lies behind is 1.
fn share(scene: &Scene, settings: RenderSettings) -> f64 {
    let estimate = mean(&seen(scene, settings, 512));
    assert!(estimate.error < 2e-3, "{estimate:?}");
    estimate.mean
}

fn assert_all(film: &Film, value: Rgb) {
    for p in film.pixels() {
        assert!((p.radiance() - value).map(f32::abs).max_component() < 1e-6, "{:?}", p.radiance());
    }
}

/// Where nothing is in the way it is invisible, without any noise: under a sky, under a lamp, and without any light at all.
#[test]
fn without_shadow_it_is_invisible() {
    assert_all(&seen(&caught_under_a_sky(), sobol(), 4), Rgb::WHITE);
    let mut scene = Scene::default();
    catcher(&mut scene);
    let glow = Material { unlit: true, ..Material::diffuse(grey(0.25)) };
    add(&mut scene, rectangle(Vec3::NEG_Y, Vec3::Z * 9.0, Vec3::X * 9.0), glow);
    assert_all(&seen(&scene, sobol(), 4), grey(0.25));
    let lamp = disc(Vec3::new(0.5, 1.0, 0.0), Vec3::NEG_Y, 0.3, 16);
    add(&mut scene, lamp, Material::emitter(grey(9.0), false));
    assert_all(&seen(&scene, sobol(), 4), grey(0.25));
}

/// A wall beside it hides half of the sky, by symmetry half of its light.
#[test]
fn half_of_the_sky() {
    let mut scene = caught_under_a_sky();
    black(&mut scene, rectangle(Vec3::new(0.011, 500.0, 0.0), Vec3::Y * 500.0, Vec3::Z * 500.0));
    for settings in [sobol(), analytic_settings()] {
        let s = share(&scene, settings);
        assert!((s - 0.5).abs() < 0.008, "{s}");
    }
}

/// A disc overhead hides r²/(r² + d²) of the light, most of it where the cosine is large: the case that resampling is biased in. With
/// Sobol numbers the bias stays below 0.003, with independent ones below 0.03.
#[test]
fn a_cap_of_the_sky() {
    for radius in [0.4f32, 0.8, 1.2, 2.0] {
        let mut scene = caught_under_a_sky();
        black(&mut scene, disc(Vec3::Y, Vec3::NEG_Y, radius, 128));
        // The camera stands below the disc, which the view through the catcher does not meet.
        let expected = 1.0 / (1.0 + f64::from(radius).powi(2));
        let camera = pinhole(Vec3::new(-0.3, 0.3, 0.05), Vec3::ZERO, 1e-4);
        for (settings, most) in [(sobol(), 0.003), (analytic_settings(), 0.03)] {
            let estimate = mean(&film(&prepare(&scene), camera, settings, 16, 2048));
            println!("cap of radius {radius}, {:?}: {estimate:?}, {expected}", settings.sampler);
            assert!((estimate.mean - expected).abs() < most, "{radius}: {estimate:?} {expected}");
        }
    }
}

/// Point lights, one red and one blue, of which the first is hidden: no red is left, all blue, without noise.
#[test]
fn hidden_lights_take_their_colour() {
    let environment = Environment { background: Background::Constant(grey(0.0)), ..Environment::default() };
    let mut scene = Scene { environment, ..Scene::default() };
    catcher(&mut scene);
    let glow = Material { unlit: true, ..Material::diffuse(grey(1.0)) };
    add(&mut scene, rectangle(Vec3::NEG_Y, Vec3::Z * 9.0, Vec3::X * 9.0), glow);
    for (x, color) in [(0.5, Rgb::new(5.0, 0.0, 0.0)), (-0.5, Rgb::new(0.0, 0.0, 2.0))] {
        let light = Some(LightId(scene.lights.len() as u32));
        scene.lights.push(Light { name: String::new(), kind: LightKind::Point, intensity: color });
        let transform = Mat4::from_translation(Vec3::new(x, 1.0, 0.0));
        scene.add_root(Node { light, transform, ..Node::default() });
    }
    let in_the_open = seen(&scene, sobol(), 16);
    assert_all(&in_the_open, Rgb::WHITE);
    black(&mut scene, disc(Vec3::new(0.25, 0.5, 0.0), Vec3::NEG_Y, 0.1, 16));
    for p in seen(&scene, sobol(), 16).pixels() {
        assert_eq!((p.radiance().r, p.radiance().b), (0.0, 1.0));
    }
    // Both hidden: nothing is left.
    black(&mut scene, disc(Vec3::new(-0.25, 0.5, 0.0), Vec3::NEG_Y, 0.1, 16));
    assert_all(&seen(&scene, sobol(), 16), Rgb::BLACK);
}

/// A veil over everything that is there for 40 % of the rays leaves 60 % of the light, and of the view.
#[test]
fn a_veil_casts_its_shadow_in_part() {
    let overhead = || rectangle(Vec3::Y * 0.005, Vec3::Z * 500.0, Vec3::X * 500.0);
    let mut scene = caught_under_a_sky();
    let veil = Material { alpha: 0.4, alpha_mode: AlphaMode::Blend, ..Material::diffuse(grey(0.0)) };
    add(&mut scene, overhead(), veil);
    // The veil hides the catcher from the camera too, and shows itself black.
    let s = share(&scene, sobol());
    assert!((s - 0.36).abs() < 0.008, "{s}");
}

/// Behind a thin pane it is still seen straight from the camera.
#[test]
fn it_is_seen_through_panes() {
    let mut scene = caught_under_a_sky();
    black(&mut scene, disc(Vec3::Y * 0.02, Vec3::NEG_Y, 4.0, 64));
    let pane = Material { transmission: 1.0, roughness: 0.0, ior: 1.0, ..Material::default() };
    let towards = Vec3::new(-1.0, 0.01, 0.0).normalize();
    let up = Vec3::new(0.01, 1.0, 0.0).normalize();
    add(&mut scene, rectangle(towards * 0.5, Vec3::Z * 0.3, up * 0.003), pane);
    let camera = pinhole(towards, Vec3::ZERO, 1e-4);
    let shadow = mean(&film(&prepare(&scene), camera, sobol(), 8, 64)).mean;
    assert!(shadow < 0.02, "{shadow}");
}

/// In a mirror it is the plain surface that it is.
#[test]
fn in_a_mirror_it_is_a_surface() {
    let picture = |shadow_catcher: bool| {
        let environment =
            Environment { background: Background::Constant(grey(1.0)), ..Environment::default() };
        let mut scene = Scene { environment, ..Scene::default() };
        let floor = Material { shadow_catcher, ..Material::diffuse(grey(0.5)) };
        add(&mut scene, rectangle(Vec3::ZERO, Vec3::Z * 50.0, Vec3::X * 50.0), floor);
        let mirror = rectangle(Vec3::new(2.0, 1.0, 0.0), Vec3::Y, Vec3::Z);
        add(&mut scene, mirror, Material::metal(grey(1.0), 0.0));
        let camera = pinhole(Vec3::new(0.0, 1.5, 0.0), Vec3::new(2.0, 1.0, 0.0), 0.05);
        film(&prepare(&scene), camera, sobol(), 8, 16)
    };
    let caught = picture(true);
    assert!(caught == picture(false) && (mean(&caught).mean - 0.5).abs() < 0.02, "{:?}", mean(&caught));
}
