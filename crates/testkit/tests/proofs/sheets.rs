//! Sheets that let diffuse light through (KHR_materials_diffuse_transmission), and solids of such a boundary.

use crate::transport::{assert_ways_agree, floor, lamp, look_down};
use glam::{Mat4, Vec3};
use lumbre_core::math::PI;
use lumbre_core::settings::RenderSettings;
use lumbre_scene::{
    Background, DiffuseTransmission, Environment, Light, LightId, LightKind, Material, Node, Scene, Volume,
};
use lumbre_testkit::measure::{OnAll, analytic_settings, grey, pinhole};
use lumbre_testkit::shapes::{add, cuboid, disc, icosphere, rectangle, smooth_icosphere};

/// A sheet of base colour `base` of which a share passes in `color`, without an interface.
fn sheet(base: f32, share: f32, color: f32) -> Material {
    let diffuse_transmission =
        Some(DiffuseTransmission { factor: share, texture: None, color: grey(color), color_texture: None });
    Material { diffuse_transmission, ..Material::diffuse(grey(base)) }
}

/// The boundary of a solid of index 1.5 that absorbs nothing.
fn wax(share: f32) -> Material {
    let volume = Volume { thickness: 1.0, attenuation_color: grey(1.0), attenuation_distance: f32::INFINITY };
    Material { volume: Some(volume), ior: 1.5, ..sheet(1.0, share, 1.0) }
}

const SHOWN: fn(f64, f64) -> f64 =
    |share_times_color, irradiance| share_times_color * irradiance / std::f64::consts::PI;

/// A sheet lit from behind by a point light, t c E / π from any side of it; lit from the front it gives (1 - t) ρ E / π.
#[test]
fn a_sheet_before_a_point_light() {
    let mut scene = Scene::default();
    add(&mut scene, rectangle(Vec3::ZERO, Vec3::X, Vec3::Y), sheet(0.5, 0.4, 0.9));
    scene.lights.push(Light { name: String::new(), kind: LightKind::Point, intensity: grey(8.0) });
    let transform = Mat4::from_translation(Vec3::NEG_Z * 2.0);
    scene.add_root(Node { light: Some(LightId(0)), transform, ..Node::default() });
    let on_all = OnAll::new(&scene);
    for (eye, expected) in [
        (Vec3::new(0.3, 0.2, 2.0), SHOWN(0.4 * 0.9, 2.0)),
        (Vec3::new(-2.0, 0.0, 0.5), SHOWN(0.4 * 0.9, 2.0)),
        (Vec3::new(0.5, 0.0, -1.0), SHOWN(0.6 * 0.5, 2.0)),
    ] {
        let camera = pinhole(eye, Vec3::ZERO, 1e-4);
        on_all.assert_radiance(camera, analytic_settings(), expected, 0.0, &format!("sheet from {eye}"));
    }
}

/// A disc light behind it: t c π r²/(r² + d²) / π, found by light sampling and by scattering alike.
#[test]
fn a_sheet_before_a_lamp() {
    let mut scene = Scene::default();
    add(&mut scene, rectangle(Vec3::ZERO, Vec3::X * 0.01, Vec3::Z * 0.01), sheet(0.7, 0.6, 0.8));
    add(&mut scene, disc(Vec3::Y, Vec3::NEG_Y, 1.0, 256), Material::emitter(grey(1.0), false));
    let on_all = OnAll::new(&scene);
    let camera = pinhole(Vec3::new(0.3, -1.0, 0.2), Vec3::ZERO, 1e-4);
    for light_sampling in [true, false] {
        let settings = RenderSettings { light_sampling, max_depth: Some(1), ..analytic_settings() };
        let expected = SHOWN(0.6 * 0.8, f64::from(PI) / 2.0);
        on_all.assert_radiance(camera, settings, expected, 4e-4, "sheet before a lamp");
    }
}

/// A closed white sheet, and white wax of index 1.5, are invisible in a furnace; inside the wax radiance is n².
#[test]
fn white_sheets_in_a_furnace() {
    let outside = pinhole(Vec3::Z * 4.0, Vec3::ZERO, 0.3);
    let inside = pinhole(Vec3::new(0.1, 0.0, 0.2), Vec3::X, 0.3);
    for (material, camera, expected) in [
        (sheet(1.0, 0.3, 1.0), outside, 1.0),
        (sheet(1.0, 0.3, 1.0), inside, 1.0),
        (wax(0.6), outside, 1.0),
        (wax(0.6), inside, 2.25),
    ] {
        let background = Background::Constant(grey(1.0));
        let environment = Environment { background, ..Environment::default() };
        let mut scene = Scene { environment, ..Scene::default() };
        add(&mut scene, icosphere(Vec3::ZERO, 1.0, 3), material);
        let on_all = OnAll::new(&scene);
        for light_sampling in [true, false] {
            let settings = RenderSettings { light_sampling, ..analytic_settings() };
            on_all.assert_radiance(camera, settings, expected, 4e-4, "white sheet in a furnace");
        }
    }
}

/// Light sampling changes nothing but noise: leaves between a lamp and a floor, rough, glossy, and wax.
#[test]
fn leaves_and_wax_under_a_lamp() {
    let mut scene = Scene::default();
    floor(&mut scene, 2.0);
    lamp(&mut scene, Vec3::Y * 2.5, 0.7, Material::emitter(grey(4.0), false));
    let leaf = Material { specular: 1.0, roughness: 0.4, ..sheet(0.3, 0.6, 0.8) };
    add(&mut scene, rectangle(Vec3::new(-0.6, 1.4, 0.0), Vec3::X * 0.7, Vec3::Z * 0.7), leaf);
    let rough = Material { diffuse_roughness: 0.8, ..sheet(0.6, 0.5, 0.7) };
    add(&mut scene, rectangle(Vec3::new(0.9, 0.6, 0.0), Vec3::Z * 0.8, Vec3::Y * 0.6), rough);
    add(&mut scene, smooth_icosphere(Vec3::new(0.1, 0.4, 0.8), 0.4, 3), wax(0.8));
    add(&mut scene, cuboid(Vec3::new(-0.9, 0.0, 0.6), Vec3::new(-0.5, 0.4, 1.0)), wax(0.3));
    assert_ways_agree(&scene, look_down(), [1024, 12288], "leaves and wax");
}
