//! What is left of a picture without its background, and the bound on what scattered light may add.

use glam::Vec3;
use lumbre_core::film::Film;
use lumbre_core::sampler::SamplerKind;
use lumbre_core::settings::RenderSettings;
use lumbre_scene::{AlphaMode, Background, Environment, Material, Scene, Volume};
use lumbre_testkit::measure::{analytic_settings, film, grey, mean, pinhole, prepare};
use lumbre_testkit::shapes::{add, cuboid, rectangle, smooth_icosphere};

/// Radiance all around.
const SKY: f32 = 0.7;

/// A box, a veil of alpha 0.4, a grey pane and a solid glass ball, side by side under an even sky, with sky between them.
fn scene() -> Scene {
    let environment = Environment { background: Background::Constant(grey(SKY)), ..Environment::default() };
    let mut scene = Scene { environment, ..Scene::default() };
    let upright = |x: f32| rectangle(Vec3::new(x, 0.5, 0.0), Vec3::X * 0.4, Vec3::Y * 0.4);
    add(
        &mut scene,
        cuboid(Vec3::new(-2.0, 0.0, -0.5), Vec3::new(-1.0, 1.0, 0.5)),
        Material::diffuse(grey(0.5)),
    );
    let veil = Material { alpha: 0.4, alpha_mode: AlphaMode::Blend, ..Material::diffuse(grey(0.3)) };
    add(&mut scene, upright(-0.5), Material { double_sided: true, ..veil });
    let pane = Material { transmission: 1.0, roughness: 0.0, ..Material::diffuse(grey(0.6)) };
    add(&mut scene, upright(0.5), Material { double_sided: true, ..pane.clone() });
    let volume = Volume { thickness: 1.0, attenuation_color: grey(1.0), attenuation_distance: f32::INFINITY };
    let solid = Material { volume: Some(volume), ..pane };
    add(&mut scene, smooth_icosphere(Vec3::new(1.5, 0.5, 0.0), 0.4, 3), solid);
    scene
}

fn draw(transparent_background: bool) -> Film {
    let camera = pinhole(Vec3::new(0.0, 0.5, 6.0), Vec3::new(0.0, 0.5, 0.0), 0.35);
    let settings = RenderSettings {
        sampler: SamplerKind::Sobol,
        max_depth: Some(8),
        transparent_background,
        ..analytic_settings()
    };
    film(&prepare(&scene()), camera, settings, 32, 64)
}

/// Put before the sky again, the picture without it is the picture with it, pixel by pixel: what was taken away is what alpha says.
#[test]
fn before_the_same_sky_it_is_the_same_picture() {
    let (with, without) = (draw(false), draw(true));
    for (a, b) in with.pixels().iter().zip(without.pixels()) {
        assert_eq!(a.alpha(), b.alpha(), "alpha does not depend on what is shown");
        let over = b.radiance() + grey(SKY) * (1.0 - b.alpha());
        let off = (over - a.radiance()).map(f32::abs).max_component();
        assert!(off < 2e-5, "{:?} {:?} {}", a.radiance(), b.radiance(), b.alpha());
    }
}

/// Alpha is 1 on solids, the share that is there on veils, what does not pass straight at panes, and 0 on nothing.
#[test]
fn alpha_is_the_share_that_hides_the_background() {
    let film = draw(true);
    // 32 pixels see ±0.35 rad at 6 m: x from -2.19 to 2.19.
    let column = |x: f32| ((x / 6.0 / libm::tanf(0.35) + 1.0) * 16.0) as u32;
    let at = |x: f32| film.pixel(column(x), 16);
    // Partial coverage is a matter of chance: the mean of 9 pixels.
    let around = |x: f32| {
        let nine = (0..9).map(|i| film.pixel(column(x) + i % 3 - 1, 15 + i / 3).alpha());
        nine.sum::<f32>() / 9.0
    };
    assert_eq!(at(-1.5).alpha(), 1.0);
    assert!((around(-0.5) - 0.4).abs() < 0.06, "{}", around(-0.5));
    let pane = around(0.5);
    assert!(pane > 0.35 && pane < 0.6, "a grey pane of 0.6 and its reflections: {pane}");
    assert_eq!(at(1.5).alpha(), 1.0, "glass that bends rays shows what it bends");
    assert!(at(1.5).radiance().max_component() > 0.1);
    let nothing = film.pixel(16, 1);
    assert_eq!((nothing.alpha(), nothing.radiance()), (0.0, grey(0.0)));
}

/// The bound takes light that scattered more than once, and no other; above all that there is, it does nothing.
#[test]
fn the_clamp_takes_light_that_scattered_twice() {
    // A lamp of radiance 50 before a white wall, and a white ceiling over both: light comes over the ceiling too.
    let mut scene = Scene::default();
    add(&mut scene, rectangle(Vec3::ZERO, Vec3::X * 3.0, Vec3::Y * 3.0), Material::diffuse(grey(0.8)));
    add(
        &mut scene,
        rectangle(Vec3::new(0.0, 3.0, 3.0), Vec3::X * 3.0, Vec3::Z * 3.0),
        Material { double_sided: true, ..Material::diffuse(grey(0.8)) },
    );
    let lamp = rectangle(Vec3::new(0.0, 0.5, 1.0), Vec3::X * 0.2, Vec3::Z * 0.2);
    add(&mut scene, lamp, Material::emitter(grey(50.0), true));
    let backend = prepare(&scene);
    let camera = pinhole(Vec3::new(0.0, 1.0, 5.0), Vec3::ZERO, 0.3);
    let draw = |max_depth, clamp| {
        let settings = RenderSettings { max_depth: Some(max_depth), clamp, ..analytic_settings() };
        film(&backend, camera, settings, 24, 64)
    };
    let (direct, all) = (draw(1, None), draw(4, None));
    assert_eq!(draw(4, Some(1e9)), all);
    assert_eq!(draw(1, Some(1e-3)), direct, "light that scattered once is not bounded");
    assert_ne!(draw(1, None), draw(2, None));
    let clamped = mean(&draw(4, Some(0.05))).mean;
    let (direct, all) = (mean(&direct).mean, mean(&all).mean);
    assert!(clamped > 1.01 * direct && clamped < 0.99 * all, "{direct} {clamped} {all}");
}
