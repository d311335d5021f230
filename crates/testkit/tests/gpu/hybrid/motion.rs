//! Over frames: where points were before, and that what moves leaves no trail.

use super::centred;
use crate::common::compile;
use glam::{Mat4, Vec3};
use lumbre_core::hybrid::{AntiAliasing, FrameView, HybridSettings, PixelPlanes};
use lumbre_core::settings::{RenderSettings, View};
use lumbre_core::{Camera, Film};
use lumbre_scene::{Background, Environment, Material, Node, Scene, recompile};
use lumbre_testkit::measure::grey;
use lumbre_testkit::shapes::{add, cuboid, rectangle};
use lumbre_testkit::{TestGpu, gpu};
use lumbre_vulkan::{SceneOptions, VulkanBackend};

const SIZE: [u32; 2] = [96, 72];

/// A floor under a grey sky, and a dark box on it that stands at `x`.
fn scene(x: f32) -> Scene {
    let environment = Environment { background: Background::Constant(grey(1.0)), ..Environment::default() };
    let mut scene = Scene { environment, ..Scene::default() };
    let floor = rectangle(Vec3::ZERO, Vec3::Z * 6.0, Vec3::X * 6.0);
    add(&mut scene, floor, Material::diffuse(grey(0.7)));
    add(
        &mut scene,
        cuboid(Vec3::new(-0.4, 0.05, -0.4), Vec3::new(0.4, 0.85, 0.4)),
        Material::diffuse(grey(0.03)),
    );
    let moved = Mat4::from_translation(Vec3::new(x, 0.0, 0.0));
    let node = scene.nodes.last_mut().expect("the box");
    *node = Node { transform: moved * node.transform, ..node.clone() };
    scene
}

fn view(eye: Vec3) -> View {
    let aspect = SIZE[0] as f32 / SIZE[1] as f32;
    let camera = Camera::look_at(eye, Vec3::new(0.0, 0.3, 0.0), Vec3::Y, 0.8, aspect);
    centred(&View { camera, settings: RenderSettings::default(), frame: 0 })
}

const EYE: Vec3 = Vec3::new(0.5, 2.4, 4.0);

struct Moving {
    backend: VulkanBackend,
    scene: Scene,
    compiled: lumbre_scene::CompiledScene,
    _gpu: TestGpu,
}

impl Moving {
    fn new() -> Option<Self> {
        let gpu = gpu()?;
        let scene = scene(0.0);
        let compiled = compile(&scene);
        let apart = SceneOptions { merge: false, ..SceneOptions::default() };
        let backend = VulkanBackend::new(&gpu, &compiled, apart).expect("the scene fits");
        Some(Moving { backend, scene, compiled, _gpu: gpu })
    }

    fn to(&mut self, x: f32) {
        let after = scene(x);
        let (made, changes) = recompile(&self.scene, &self.compiled, &after).expect("it compiles");
        self.backend.update(&made.scene, changes).expect("there is room");
        (self.scene, self.compiled) = (after, made.scene);
    }

    fn frame(&self, view: &View, settings: &HybridSettings) -> (Vec<PixelPlanes>, Film) {
        let mut hybrid = self.backend.hybrid().expect("the device draws hybrid frames");
        hybrid.frame(&FrameView { view, size: SIZE, settings }).expect("the GPU draws");
        (hybrid.planes().expect("they are there"), hybrid.film().expect("it is there").clone())
    }
}

/// Compares motion with where the points were in the frame before: pixels of surfaces that were inside the picture and not hidden, and those of
/// them of which the frame before showed another point, by more than a tenth of a pixel. `moved`: how far the box, instance 1, has moved since.
fn compare(before: &[PixelPlanes], after: &[PixelPlanes], pixel: f32, moved: Vec3) -> (usize, usize) {
    let (mut seen, mut wrong) = (0, 0);
    for (i, here) in after.iter().enumerate().filter(|(_, p)| p.instance.is_some()) {
        let [x, y] = [i % SIZE[0] as usize, i / SIZE[0] as usize].map(|v| v as f32);
        let [u, v] = [x + here.motion[0], y + here.motion[1]];
        let [x0, y0] = [u.floor(), v.floor()];
        if x0 < 0.0 || y0 < 0.0 || x0 + 1.0 >= SIZE[0] as f32 || y0 + 1.0 >= SIZE[1] as f32 {
            continue;
        }
        let at = |x: f32, y: f32| &before[y as usize * SIZE[0] as usize + x as usize];
        let four = [at(x0, y0), at(x0 + 1.0, y0), at(x0, y0 + 1.0), at(x0 + 1.0, y0 + 1.0)];
        let same = |p: &&PixelPlanes| p.instance == here.instance && p.normal == here.normal;
        if !four.iter().all(same) {
            continue;
        }
        let [a, b, c, d] = four.map(|p| Vec3::from(p.position));
        // Points of a plane seen in perspective: nearly, over one pixel.
        let then = a.lerp(b, u - x0).lerp(c.lerp(d, u - x0), v - y0);
        let now = if here.instance == Some(1) { then + moved } else { then };
        // Seen at a slant a pixel spans more of a surface.
        let slant = Vec3::from(here.normal).dot((EYE - now).normalize()).abs().max(0.1);
        seen += 1;
        wrong +=
            usize::from((now - Vec3::from(here.position)).length() > 0.1 * pixel * here.distance / slant);
    }
    (seen, wrong)
}

#[test]
fn motion_leads_to_where_points_were() {
    let Some(mut moving) = Moving::new() else { return };
    let settings = HybridSettings { depth: 1, anti_aliasing: AntiAliasing::None, ..HybridSettings::THESIS };
    let pixel = 2.0 * (0.5f32 * 0.8).tan() / SIZE[1] as f32;
    let (first, _) = moving.frame(&view(EYE), &settings);
    assert!(first.iter().all(|p| p.motion[0].abs().max(p.motion[1].abs()) < 1e-3), "nothing moves at first");
    // The camera moves and turns, then the box moves, then both.
    let aside = view(EYE + Vec3::new(0.15, -0.1, 0.2));
    let (second, _) = moving.frame(&aside, &settings);
    let moved = Vec3::new(0.22, 0.0, 0.0);
    moving.to(moved.x);
    let (third, _) = moving.frame(&aside, &settings);
    moving.to(0.0);
    let (fourth, _) = moving.frame(&view(EYE), &settings);
    for (name, before, after, moved) in [
        ("the camera", &first, &second, Vec3::ZERO),
        ("the box", &second, &third, moved),
        ("both", &third, &fourth, -moved),
    ] {
        let (seen, wrong) = compare(before, after, pixel, moved);
        println!("{name}: {wrong} of {seen} wrong");
        assert!(seen > 2000 && wrong * 200 <= seen, "{name}: {wrong} of {seen}");
    }
    // Motion that knows nothing of the box, or of the camera, is wrong.
    assert!(compare(&second, &third, pixel, Vec3::ZERO).1 > 50);
    assert!(compare(&first, &third, pixel, moved).1 > 1000);
}

/// The box jumps aside. The floor where it stood, which was hidden, looks at once as it does after many frames; and the box is not seen where it was.
#[test]
fn what_moves_leaves_no_trail() {
    let Some(mut moving) = Moving::new() else { return };
    let settings = HybridSettings { depth: 3, ..HybridSettings::ALL };
    let frames = |moving: &Moving, from: u32, count: u32| {
        let at = |frame| View { frame, ..view(EYE) };
        (from..from + count).map(|f| moving.frame(&at(f), &settings)).last().expect("a frame")
    };
    let (planes_before, before) = frames(&moving, 0, 24);
    moving.to(1.1);
    let (planes, after) = frames(&moving, 24, 2);
    let (_, settled) = frames(&moving, 26, 40);
    let mean = |film: &Film, which: &dyn Fn(usize) -> bool| {
        let some: Vec<f32> = (0..planes.len())
            .filter(|&i| which(i))
            .map(|i| film.pixels()[i].radiance().luminance())
            .collect();
        assert!(some.len() > 100, "{} pixels", some.len());
        some.iter().sum::<f32>() / some.len() as f32
    };
    let uncovered = |i: usize| planes_before[i].instance == Some(1) && planes[i].instance == Some(0);
    let covered = |i: usize| planes_before[i].instance == Some(0) && planes[i].instance == Some(1);
    for (name, which) in [("uncovered", &uncovered as &dyn Fn(usize) -> bool), ("covered", &covered)] {
        let [was, is, will] = [&before, &after, &settled].map(|film| mean(film, which));
        println!("{name}: {was} before, {is} after 2 frames, {will} in the end");
        // What was there before is another thing by far, so that a trail would be seen.
        assert!((was - will).abs() > 0.5 * was.max(will), "{name}: {was} {will}");
        assert!((is - will).abs() < 0.1 * (was - will).abs(), "{name}: {was}, {is}, {will}");
    }
}
