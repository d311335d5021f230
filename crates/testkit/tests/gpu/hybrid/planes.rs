//! What the rasteriser sees is what camera rays through the centres of pixels find, but for silhouettes, where both round differently.

use super::{centred, frame};
use crate::common::{Both, assert_none, load, shared};
use glam::Vec3;
use lumbre_core::Film;
use lumbre_core::film::PixelSums;
use lumbre_core::hybrid::{AntiAliasing, HybridSettings};
use lumbre_core::settings::{RenderSettings, View};
use lumbre_testkit::ready::asset;
use std::path::Path;

const SIZE: [u32; 2] = [160, 120];

/// Share of pixels that may differ, all of them at silhouettes.
const SILHOUETTES: f64 = 0.01;

fn near(a: [f32; 3], b: [f32; 3], bound: f32) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= bound)
}

/// Whether two pixels show the same point of the same surface.
fn same(a: &PixelSums, b: &PixelSums) -> bool {
    if a.coverage() != b.coverage() {
        return false;
    }
    let depth = a.depth().max(1e-3);
    a.coverage() == 0.0
        || ((a.depth() - b.depth()).abs() <= 1e-4 * depth
            && near(a.position(), b.position(), 1e-4 * depth)
            && near(a.normal(), b.normal(), 2e-3)
            && near(a.albedo().to_array(), b.albedo().to_array(), 4e-3))
}

/// How many pixels differ: at silhouettes (the other picture shows something off the plane that lies there, or a neighbour does), and elsewhere.
#[derive(Debug, Default, PartialEq, Eq)]
struct Differing {
    silhouettes: usize,
    elsewhere: usize,
}

fn compare(rays: &Film, raster: &Film) -> Differing {
    let [width, height] = [rays.width(), rays.height()];
    let mut differing = Differing::default();
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let here = rays.pixel(x, y);
        if same(here, raster.pixel(x, y)) {
            continue;
        }
        let around = |x: u32, limit: u32| x.saturating_sub(1)..(x + 2).min(limit);
        let mut neighbours = around(y, height).flat_map(|y| around(x, width).map(move |x| rays.pixel(x, y)));
        let off_plane = |n: &PixelSums| {
            let to = Vec3::from(n.position()) - Vec3::from(here.position());
            to.dot(here.normal().into()).abs() > 1e-3 * here.depth()
        };
        let edge = |n: &PixelSums| {
            n.coverage() != here.coverage() || off_plane(n) || !near(n.normal(), here.normal(), 0.1)
        };
        match edge(raster.pixel(x, y)) || neighbours.any(edge) {
            true => differing.silhouettes += 1,
            false => differing.elsewhere += 1,
        }
    }
    differing
}

fn first_hits(both: &Both, view: &View) -> Film {
    let view = centred(view);
    let settings = RenderSettings { max_depth: Some(0), ..view.settings };
    let mut film = Film::new(SIZE[0], SIZE[1]);
    both.cpu.render(&View { settings, ..view }, 0..1, &mut film, &());
    film
}

fn drawn(both: &Both, view: &View) -> Film {
    frame(
        &both.vulkan,
        &centred(view),
        SIZE,
        &HybridSettings { depth: 0, anti_aliasing: AntiAliasing::None, ..HybridSettings::THESIS },
    )
}

fn check(name: &str, both: &Both, view: &View, faults: &mut Vec<String>) {
    let rays = first_hits(both, view);
    let differing = compare(&rays, &drawn(both, view));
    println!("{name}: {differing:?} of {} pixels", rays.pixels().len());
    let most = SILHOUETTES * rays.pixels().len() as f64;
    if differing.silhouettes as f64 > most || differing.elsewhere > 0 {
        faults.push(format!("{name}: {differing:?}"));
    }
}

fn check_files(root: &Path, files: &[(&str, &str)]) {
    let mut faults = Vec::new();
    for (file, camera) in files {
        let (scene, view) = load(&root.join(file), camera, SIZE[0] as f32 / SIZE[1] as f32);
        let Some(both) = Both::new(scene) else { return };
        check(&format!("{file} {camera}"), &both, &view, &mut faults);
    }
    assert_none(&faults);
}

/// A camera that stands a hundredth nearer is another.
#[test]
fn another_camera_is_found() {
    let (scene, view) = load(&asset("cornell.glb"), "", SIZE[0] as f32 / SIZE[1] as f32);
    let Some(both) = Both::new(scene) else { return };
    let mut nearer = view.clone();
    nearer.camera.origin *= 0.99;
    let differing = compare(&first_hits(&both, &view), &drawn(&both, &nearer));
    assert!(differing.elsewhere > SIZE[0] as usize * SIZE[1] as usize / 2, "{differing:?}");
}

#[test]
fn our_scenes() {
    let files = [
        ("smooth.gltf", ""),
        ("leaves.gltf", ""),
        ("plates.glb", ""),
        ("cornell.glb", ""),
        ("lanterns.glb", ""),
        ("materials.glb", "all"),
        ("pool.glb", "exterior"),
        ("pool.glb", "interior"),
    ];
    check_files(&asset(""), &files);
}

/// Alpha masks and blends, mirrored transforms, instances, normal maps.
#[test]
fn shared_scenes() {
    let files = [
        ("gltf-sample-assets/AlphaBlendModeTest/glTF-Binary/AlphaBlendModeTest.glb", ""),
        ("gltf-sample-assets/NegativeScaleTest/glTF-Binary/NegativeScaleTest.glb", ""),
        ("gltf-sample-assets/SimpleInstancing/glTF-Binary/SimpleInstancing.glb", ""),
        ("gltf-sample-assets/NormalTangentTest/glTF-Binary/NormalTangentTest.glb", ""),
        ("sponza/glTF-Draco-WebP/Sponza.glb", ""),
    ];
    if let Some(folder) = shared(&files.map(|f| f.0)) {
        check_files(&folder, &files);
    }
}
