//! Small scenes for what files do not reach, and for planting errors.

use glam::{Mat4, Vec3};
use lumbre_core::Rgb;
use lumbre_core::settings::{RenderSettings, View};
use lumbre_scene::{
    AlphaMode, Background, Environment, EnvironmentMap, Light, LightId, LightKind, Material, Node, Primitive,
    Scene, Sun, Volume,
};
use lumbre_testkit::measure::grey;
use lumbre_testkit::shapes::{add, cuboid, disc, rectangle, smooth_icosphere};

/// A view with default settings.
pub(crate) fn look(eye: Vec3, target: Vec3, yfov: f32, aspect: f32) -> View {
    let camera = lumbre_core::Camera::look_at(eye, target, Vec3::Y, yfov, aspect);
    View { camera, settings: RenderSettings::default(), frame: 0 }
}

/// An uneven sky, turned, of this strength.
pub(crate) fn sky(strength: f32) -> Environment {
    let texel = |i: u32| {
        let bright = if i == 11 { 6.0 } else { 0.2 + 0.05 * (i % 7) as f32 };
        Rgb::new(bright, 0.9 * bright, 0.3 + 0.5 * bright)
    };
    let pixels = (0..16 * 8).map(texel).collect();
    let background = Background::Map(EnvironmentMap { width: 16, height: 8, pixels });
    Environment { background, rotation: 0.7, strength, sun: None }
}

/// A punctual light with this place and direction.
pub(crate) fn lamp(scene: &mut Scene, kind: LightKind, intensity: Rgb, transform: Mat4) {
    let light = Some(LightId(scene.lights.len() as u32));
    scene.lights.push(Light { name: String::new(), kind, intensity });
    scene.add_root(Node { light, transform, ..Node::default() });
}

/// A solid that takes light on the way.
pub(crate) fn solid(ior: f32, roughness: f32, color: Rgb) -> Material {
    let volume = Some(Volume { thickness: 1.0, attenuation_color: color, attenuation_distance: 0.8 });
    Material { volume, ..Material::glass(ior, roughness) }
}

/// Every kind of light over a floor with a box, a ball and a sheet that shows its back: materials 0 floor, 1 box, 2 ball, 3 lamp, 4 sheet.
pub(crate) fn lamps() -> Scene {
    let sun = Sun { elevation: 0.9, azimuth: 0.6, irradiance: Rgb::new(1.5, 1.4, 1.2), angular_radius: 0.05 };
    let mut scene = Scene { environment: Environment { sun: Some(sun), ..sky(1.0) }, ..Scene::default() };
    let floor = rectangle(Vec3::ZERO, Vec3::Z * 4.0, Vec3::X * 4.0);
    add(&mut scene, floor, Material::diffuse(Rgb::new(0.7, 0.6, 0.5)));
    let block = cuboid(Vec3::new(-1.6, 0.0, -0.8), Vec3::new(-0.6, 1.0, 0.2));
    add(&mut scene, block, Material::diffuse(Rgb::new(0.3, 0.5, 0.8)));
    let ball = smooth_icosphere(Vec3::new(0.7, 0.6, 0.0), 0.6, 3);
    add(&mut scene, ball, Material { roughness: 0.3, base_color: grey(0.6), ..Material::default() });
    let shine = rectangle(Vec3::new(0.0, 2.2, -1.5), Vec3::X * 0.5, Vec3::new(0.0, 0.2, 0.3));
    add(&mut scene, shine, Material::emitter(Rgb::new(9.0, 7.0, 5.0), true));
    let away = rectangle(Vec3::new(0.2, 0.4, 1.2), Vec3::X * -0.3, Vec3::Y * 0.3);
    add(&mut scene, away, Material { double_sided: false, ..Material::diffuse(Rgb::new(0.8, 0.2, 0.2)) });
    let at = |x, y, z| Mat4::from_translation(Vec3::new(x, y, z));
    lamp(&mut scene, LightKind::Point, Rgb::new(2.0, 2.0, 3.0), at(1.8, 1.5, 1.0));
    let spot = LightKind::Spot { inner_angle: 0.2, outer_angle: 0.6 };
    let down = Mat4::from_rotation_x(-1.2);
    lamp(&mut scene, spot, Rgb::new(9.0, 8.0, 3.0), at(-1.0, 2.5, 1.2) * down);
    lamp(&mut scene, LightKind::Directional, Rgb::new(0.6, 0.9, 0.7), Mat4::from_rotation_x(-0.8));
    scene
}

/// The view of [`lamps`].
pub(crate) fn lamps_view(aspect: f32) -> View {
    look(Vec3::new(0.4, 1.8, 4.6), Vec3::new(0.0, 0.7, 0.0), 0.8, aspect)
}

/// Solids in solids, rough and tinted glass, thin panes and a veil before a wall, under a lamp, a sky and a shining disc.
pub(crate) fn media() -> Scene {
    let mut scene = Scene { environment: sky(0.7), ..Scene::default() };
    let floor = rectangle(Vec3::ZERO, Vec3::Z * 4.0, Vec3::X * 4.0);
    add(&mut scene, floor, Material::diffuse(grey(0.6)));
    let nest = Vec3::new(-0.9, 0.7, 0.0);
    add(&mut scene, smooth_icosphere(nest, 0.7, 3), solid(1.5, 0.0, Rgb::new(0.9, 0.5, 0.4)));
    add(&mut scene, smooth_icosphere(nest, 0.4, 3), solid(1.33, 0.0, Rgb::new(0.3, 0.7, 0.9)));
    add(&mut scene, smooth_icosphere(Vec3::new(0.6, 0.5, 0.4), 0.5, 3), solid(1.6, 0.3, grey(0.8)));
    let pane = Material { transmission: 1.0, roughness: 0.0, double_sided: true, ..Material::default() };
    let tinted = Material { base_color: Rgb::new(0.4, 0.9, 0.5), ..pane.clone() };
    add(&mut scene, rectangle(Vec3::new(1.6, 0.7, 0.2), Vec3::X * 0.35, Vec3::Y * 0.7), tinted);
    let frosted = Material { roughness: 0.4, ..pane };
    add(&mut scene, rectangle(Vec3::new(0.2, 1.6, -0.5), Vec3::X * 0.6, Vec3::Y * 0.35), frosted);
    let veil = Material { alpha: 0.4, alpha_mode: AlphaMode::Blend, ..Material::diffuse(grey(0.8)) };
    add(&mut scene, rectangle(Vec3::new(-0.9, 1.8, 0.6), Vec3::X * 0.4, Vec3::Y * 0.3), veil);
    let shine = disc(Vec3::new(0.8, 2.6, 0.5), Vec3::NEG_Y, 0.3, 16);
    add(&mut scene, shine, Material::emitter(grey(12.0), false));
    lamp(&mut scene, LightKind::Point, grey(3.0), Mat4::from_translation(Vec3::new(-1.5, 2.4, 1.0)));
    scene
}

/// The view of [`media`].
pub(crate) fn media_view(aspect: f32) -> View {
    look(Vec3::new(0.3, 1.3, 5.0), Vec3::new(0.2, 1.0, 0.0), 0.7, aspect)
}

/// A ball of each material, or a square facing the camera where it is for thin things, three in a row, before a wall under a lamp and a
/// sky: the materials are 1, 2, … of the scene.
pub(crate) fn samples(materials: &[(bool, Material)]) -> Scene {
    assert!(materials.len() <= 6, "more lie outside the picture");
    let mut scene = Scene { environment: sky(0.8), ..Scene::default() };
    let wall = rectangle(Vec3::new(0.0, 0.0, -1.2), Vec3::X * 4.0, Vec3::Y * 3.0);
    add(&mut scene, wall, Material::diffuse(grey(0.6)));
    for (i, (thin, material)) in materials.iter().enumerate() {
        let centre = Vec3::new(1.1 * (i % 3) as f32 - 1.1, 0.55 - 1.1 * (i / 3) as f32, 0.0);
        add(&mut scene, sample(*thin, centre), material.clone());
    }
    lamp(&mut scene, LightKind::Point, grey(6.0), Mat4::from_translation(Vec3::new(-0.4, 0.3, 2.5)));
    scene
}

fn sample(thin: bool, centre: Vec3) -> Primitive {
    if thin {
        return rectangle(centre, Vec3::new(0.4, 0.0, 0.25), Vec3::Y * 0.48);
    }
    smooth_icosphere(centre, 0.52, 3)
}

/// The view of [`samples`].
pub(crate) fn samples_view(aspect: f32) -> View {
    look(Vec3::new(0.0, 0.0, 7.0), Vec3::ZERO, 0.31, aspect)
}
