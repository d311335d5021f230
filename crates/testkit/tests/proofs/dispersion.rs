//! Solids whose index depends on the wavelength (KHR_materials_dispersion): where a prism sends each one, and that nothing else changes.

use crate::transport::{ON, assert_same_mean, assert_ways_agree, floor, lamp, look_down, mean};
use glam::{Mat4, Vec3};
use lumbre_core::Camera;
use lumbre_core::film::Film;
use lumbre_core::settings::{RenderSettings, View};
use lumbre_core::wavelength::dispersed_index;
use lumbre_cpu::CpuBackend;
use lumbre_cpu::observer::{PathEvent, describe};
use lumbre_scene::{Background, Environment, Light, LightId, LightKind, Material, Node, Primitive, Scene};
use lumbre_testkit::measure::{analytic_settings, film, grey, pinhole, prepare};
use lumbre_testkit::shapes::{add, smooth_icosphere};

/// Glass of index 1.5 with dispersion: 0.36 is flint's, more is for show.
fn glass(dispersion: f32, roughness: f32) -> Material {
    Material { dispersion, ..Material::glass(1.5, roughness) }
}

/// An upright prism whose apex of `angle` radians lies at z = 0, its sides along +z and ±x.
fn prism(angle: f32) -> Primitive {
    let (s, c) = lumbre_core::math::sin_cos(0.5 * angle);
    let corners = [Vec3::ZERO, Vec3::new(s, 0.0, c) * 4.0, Vec3::new(-s, 0.0, c) * 4.0];
    let positions: Vec<Vec3> =
        [-5.0, 5.0].into_iter().flat_map(|y| corners.map(|p| p + Vec3::Y * y)).collect();
    let indices = vec![0, 1, 2, 3, 5, 4, 0, 3, 4, 0, 4, 1, 1, 4, 5, 1, 5, 2, 2, 5, 3, 2, 3, 0];
    Primitive { positions, indices, ..Primitive::default() }
}

/// What happened to one camera sample: its first direction, its wavelength, the number of surfaces met, its last direction.
#[derive(Clone, Debug, Default)]
struct Passage {
    first: Vec3,
    nm: Option<f32>,
    met: u32,
    last: Option<Vec3>,
    lines: Vec<String>,
}

fn passage(backend: &CpuBackend, camera: &Camera, index: u32) -> Passage {
    let view = View { camera: *camera, settings: analytic_settings(), frame: 0 };
    let mut out = Passage::default();
    backend.replay(&view, [8, 8], [4, 4], index, &mut |e: PathEvent<'_>| {
        out.lines.push(describe(&e));
        match e {
            PathEvent::Camera { ray } => out.first = ray.dir,
            PathEvent::Wavelength { nm, .. } => out.nm = Some(nm),
            PathEvent::Hit { .. } => out.met += 1,
            PathEvent::Miss { dir, .. } => out.last = Some(dir),
            _ => {}
        }
    });
    out
}

/// A prism turns light of each wavelength by θ + asin(n sin(A - asin(sin θ / n))) - A, with the index of that wavelength.
#[test]
fn a_prism_turns_each_wavelength_by_its_index() {
    let (angle, dispersion) = (0.7f32, 1.0);
    let mut scene = Scene::default();
    let environment = Environment { background: Background::Constant(grey(1.0)), ..Environment::default() };
    scene.environment = environment;
    add(&mut scene, prism(angle), glass(dispersion, 0.0));
    let backend = prepare(&scene);
    // At the side that faces +x, from 0.6 radians off its normal, from the base.
    let (s, c) = lumbre_core::math::sin_cos(0.5 * angle);
    let (normal, along) = (Vec3::new(c, 0.0, -s), Vec3::new(s, 0.0, c));
    let at = along * 2.0;
    let (s0, c0) = lumbre_core::math::sin_cos(0.6);
    let camera = pinhole(at + (normal * c0 + along * s0) * 2.0, at, 1e-3);
    let (mut shortest, mut longest) = ((f32::INFINITY, 0.0), (0.0f32, 0.0));
    let mut counted = 0;
    for index in 0..2_000 {
        let p = passage(&backend, &camera, index);
        let Passage { nm: Some(nm), met: 2, last: Some(last), .. } = p else {
            // Reflected at once: all wavelengths still. Reflected inside: one.
            assert!(p.met != 1 || p.nm.is_none(), "{p:?}");
            continue;
        };
        let theta = f64::from(-p.first.dot(normal)).acos();
        let n = f64::from(dispersed_index(1.5, dispersion, nm));
        let a = f64::from(angle);
        let expected = theta + (n * (a - (theta.sin() / n).asin()).sin()).asin() - a;
        let turned = f64::from(p.first.dot(last)).clamp(-1.0, 1.0).acos();
        assert!((turned - expected).abs() < 2e-5, "{nm} nm: {turned} {expected}");
        assert!(p.lines.iter().any(|l| l.starts_with("hue") && l.contains("nm")), "{:?}", p.lines);
        if nm < shortest.0 {
            shortest = (nm, turned);
        }
        if nm > longest.0 {
            longest = (nm, turned);
        }
        counted += 1;
    }
    assert!(counted > 1_500 && shortest.0 < 410.0 && longest.0 > 670.0, "{counted} {shortest:?} {longest:?}");
    assert!(shortest.1 > longest.1 + 0.02, "blue is turned more: {shortest:?} {longest:?}");
}

fn under_a_sky(material: Material) -> Scene {
    let environment = Environment { background: Background::Constant(grey(1.0)), ..Environment::default() };
    let mut scene = Scene { environment, ..Scene::default() };
    add(&mut scene, smooth_icosphere(Vec3::ZERO, 1.0, 4), material);
    scene
}

/// Mean of each band.
fn bands(film: &Film) -> [f64; 3] {
    let n = film.pixels().len() as f64;
    [0, 1, 2].map(|band| film.pixels().iter().map(|p| f64::from(p.radiance()[band])).sum::<f64>() / n)
}

/// In a furnace it stays white in every band: from outside, and from inside, where radiance is n² of each wavelength.
#[test]
fn white_stays_white() {
    let backend = prepare(&under_a_sky(glass(2.0, 0.0)));
    let settings = RenderSettings { sampler: Default::default(), ..analytic_settings() };
    let outside = bands(&film(&backend, pinhole(Vec3::Z * 4.0, Vec3::ZERO, 0.2), settings, 16, 1024));
    assert!(outside.iter().all(|v| (v - 1.0).abs() < 2e-3), "{outside:?}");
    let inside = pinhole(Vec3::new(0.05, 0.1, 0.0), Vec3::new(1.0, 0.2, 0.1), 0.2);
    let [red, green, blue] = bands(&film(&backend, inside, settings, 16, 1024));
    let n2 = |nm| f64::from(dispersed_index(1.5, 2.0, nm)).powi(2);
    assert!((red / n2(610.0) - 1.0).abs() < 0.01, "{red} {}", n2(610.0));
    assert!((green / n2(545.0) - 1.0).abs() < 0.01, "{green} {}", n2(545.0));
    assert!((blue / n2(455.0) - 1.0).abs() < 0.01, "{blue} {}", n2(455.0));
}

/// A dispersion of 0 is none, to the bit; a very small one shows the same.
#[test]
fn no_dispersion_changes_nothing() {
    let picture = |dispersion: f32| {
        let mut scene = Scene::default();
        floor(&mut scene, 2.0);
        lamp(&mut scene, Vec3::Y * 2.5, 0.7, Material::emitter(grey(4.0), false));
        add(&mut scene, smooth_icosphere(Vec3::new(-0.8, 0.7, 0.0), 0.7, 4), glass(dispersion, 0.0));
        add(&mut scene, smooth_icosphere(Vec3::new(0.8, 0.7, 0.0), 0.7, 4), glass(dispersion, 0.4));
        prepare(&scene)
    };
    let plain = picture(0.0);
    let same = film(&plain, look_down(), ON, 24, 8);
    assert!(same == film(&picture(f32::NAN), look_down(), ON, 24, 8), "not a number is none");
    assert!(same != film(&picture(1e-5), look_down(), ON, 24, 8));
    let (a, b) = (mean(&plain, look_down(), ON, 2048), mean(&picture(1e-5), look_down(), ON, 4096));
    assert_same_mean(a, b, "hardly any dispersion");
}

/// Light sampling finds through rough glass that disperses what scattered paths find.
#[test]
fn rough_glass_that_disperses() {
    let mut scene = Scene::default();
    floor(&mut scene, 2.0);
    lamp(&mut scene, Vec3::Y * 2.5, 0.8, Material::emitter(grey(4.0), false));
    add(&mut scene, smooth_icosphere(Vec3::Y * 0.8, 0.8, 4), glass(2.0, 0.5));
    assert_ways_agree(&scene, look_down(), [2048, 4096], "rough glass that disperses");
}

/// Straight shadow rays do not separate colours: what a point light sends through the glass is the light of the d line.
#[test]
fn straight_shadows_keep_their_colour() {
    let picture = |dispersion: f32| {
        let mut scene = Scene::default();
        floor(&mut scene, 0.5);
        add(&mut scene, smooth_icosphere(Vec3::Y * 1.2, 0.5, 5), glass(dispersion, 0.0));
        scene.lights.push(Light { name: String::new(), kind: LightKind::Point, intensity: grey(40.0) });
        let transform = Mat4::from_translation(Vec3::Y * 4.0);
        scene.add_root(Node { light: Some(LightId(0)), transform, ..Node::default() });
        let settings = RenderSettings { max_depth: Some(1), ..analytic_settings() };
        film(&prepare(&scene), pinhole(Vec3::new(1.6, 0.5, 0.0), Vec3::ZERO, 0.02), settings, 8, 8)
    };
    let seen = picture(3.0);
    assert!(seen == picture(0.0) && bands(&seen)[0] > 0.1);
}
