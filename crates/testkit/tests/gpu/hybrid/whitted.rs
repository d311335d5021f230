//! Mirrors, glass and one directional light: what Whitted's method draws is what paths draw that do not go on from rough surfaces.

use super::{centred, frame};
use crate::common::{Both, compile};
use glam::Vec3;
use lumbre_core::hybrid::{AntiAliasing, HybridSettings};
use lumbre_core::settings::{RenderSettings, View};
use lumbre_core::{Camera, Film, Rgb, Spectrum};
use lumbre_scene::{Light, LightId, LightKind, Material, Node, Scene};
use lumbre_testkit::measure::grey;
use lumbre_testkit::shapes::{add, cuboid, rectangle, smooth_icosphere};

const SIZE: [u32; 2] = [64, 48];
/// Camera samples of each pixel on the CPU.
const SPP: u32 = 1024;

/// A floor of two colours, a mirror and a tinted one, a ball of glass, a pane, a pool of tinted glass and something smooth over a diffuse base.
fn scene() -> Scene {
    let mut scene = Scene::default();
    let tiles = [(-1.0, grey(0.7)), (1.0, Rgb::new(0.7, 0.3, 0.2))];
    for (x, color) in tiles {
        let floor = rectangle(Vec3::new(2.0 * x, 0.0, 0.0), Vec3::Z * 4.0, Vec3::X * 2.0);
        add(&mut scene, floor, Material::diffuse(color));
    }
    let mirror = |color| Material { roughness: 0.0, ..Material::metal(color, 0.0) };
    add(&mut scene, rectangle(Vec3::new(0.0, 1.0, -2.0), Vec3::X * 2.0, Vec3::Y), mirror(grey(0.95)));
    add(&mut scene, smooth_icosphere(Vec3::new(-1.3, 0.6, -0.4), 0.6, 4), mirror(Rgb::new(0.9, 0.6, 0.3)));
    add(&mut scene, smooth_icosphere(Vec3::new(0.2, 0.6, 0.6), 0.6, 4), Material::glass(1.5, 0.0));
    let pane = Material {
        transmission: 1.0,
        roughness: 0.0,
        base_color: Rgb::new(0.7, 0.9, 0.8),
        ..Material::default()
    };
    add(&mut scene, rectangle(Vec3::new(1.2, 0.7, 1.0), Vec3::X * 0.5, Vec3::Y * 0.7), pane);
    let varnished = Material { roughness: 0.0, ..Material::diffuse(Rgb::new(0.2, 0.3, 0.8)) };
    let varnished = Material { specular: 1.0, ior: 1.5, ..varnished };
    add(&mut scene, cuboid(Vec3::new(1.0, 0.0, -1.2), Vec3::new(1.8, 0.8, -0.4)), varnished);
    let kind = LightKind::Directional;
    scene.lights.push(Light { name: String::new(), kind, intensity: grey(3.0) });
    let rotation = glam::Quat::from_rotation_arc(Vec3::NEG_Z, Vec3::new(0.4, -1.0, -0.3).normalize());
    let transform = glam::Mat4::from_quat(rotation);
    scene.add_root(Node { light: Some(LightId(0)), transform, ..Node::default() });
    scene
}

fn view() -> View {
    let aspect = SIZE[0] as f32 / SIZE[1] as f32;
    let camera = Camera::look_at(Vec3::new(0.3, 1.6, 4.2), Vec3::new(0.0, 0.5, 0.0), Vec3::Y, 0.7, aspect);
    let settings = RenderSettings {
        max_depth: Some(6),
        rough_bounces: Some(0),
        roulette: None,
        ..RenderSettings::default()
    };
    centred(&View { camera, settings, frame: 0 })
}

const SHARP: HybridSettings = HybridSettings {
    depth: 6,
    ambient: Some(Spectrum::BLACK),
    anti_aliasing: AntiAliasing::None,
    ..HybridSettings::THESIS
};

/// Pixels that differ by more than 4.5 standard errors and 0.2 %, and the difference of the means over that of the paths.
fn compare(paths: &Film, frame: &Film) -> (usize, f64) {
    let mut far = 0;
    let mut sums = [0.0f64; 2];
    for (a, b) in paths.pixels().iter().zip(frame.pixels()) {
        let [x, y] = [a, b].map(|p| p.radiance().luminance());
        sums[0] += f64::from(x);
        sums[1] += f64::from(y);
        far += usize::from((x - y).abs() > 4.5 * a.error() + 2e-3 * x.max(0.05));
    }
    (far, (sums[1] - sums[0]) / sums[0])
}

#[test]
fn frames_are_what_whitted_draws() {
    let Some(both) = Both::new(compile(&scene())) else { return };
    let view = view();
    let mut paths = Film::new(SIZE[0], SIZE[1]);
    both.cpu.render(&view, 0..SPP, &mut paths, &());
    let drawn = frame(&both.vulkan, &view, SIZE, &SHARP);
    let pixels = paths.pixels().len();
    let (far, bias) = compare(&paths, &drawn);
    println!("{far} of {pixels} pixels differ, means by {bias:.2e}");
    // Silhouettes, also those in mirrors and glass, fall on one side or the other.
    assert!(far <= pixels / 100 && bias.abs() < 2e-3, "{far} of {pixels} pixels differ, means by {bias:.2e}");
    // One reflection less, or other surfaces, would be seen.
    let shorter = frame(&both.vulkan, &view, SIZE, &HybridSettings { depth: 2, ..SHARP });
    let (far, bias) = compare(&paths, &shorter);
    assert!(far > pixels / 100 && bias.abs() > 2e-3, "depth 2 is not seen: {far} pixels, {bias:.2e}");
    let mut deeper = view.clone();
    deeper.settings.rough_bounces = Some(1);
    let mut paths = Film::new(SIZE[0], SIZE[1]);
    both.cpu.render(&deeper, 0..SPP / 8, &mut paths, &());
    let (far, bias) = compare(&paths, &drawn);
    assert!(far > pixels / 100 && bias.abs() > 2e-3, "rough bounces are not seen: {far}, {bias:.2e}");
}
