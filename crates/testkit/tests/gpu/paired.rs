//! The paired test: the same samples on both devices, path by path.

use crate::common::Both;
use lumbre_testkit::paired::Bounds;
use lumbre_testkit::ready::{asset, open};

/// Compares a scene of `assets/scenes`.
fn check(name: &str, bounds: &Bounds, size: [u32; 2], spp: u32) {
    let ready = open(&asset(name), size[0] as f32 / size[1] as f32);
    let Some(both) = Both::new(ready.backend.scene().clone()) else { return };
    let began = std::time::Instant::now();
    let paired = both.paired(&ready.view, size, spp);
    println!("{name}: {paired}, {:.1} s", began.elapsed().as_secs_f32());
    let faults = paired.faults(bounds);
    assert!(faults.is_empty(), "{name}: {}", faults.join("; "));
}

#[test]
fn smooth() {
    check("smooth.gltf", &Bounds::PLAIN, [48, 48], 4);
}

#[test]
fn cornell() {
    check("cornell.glb", &Bounds::TEXTURED, [64, 48], 4);
}

#[test]
fn prism() {
    check("prism.gltf", &Bounds::PLAIN, [48, 48], 4);
}

#[test]
fn leaves() {
    check("leaves.gltf", &Bounds::TEXTURED, [48, 48], 4);
}

#[test]
fn pool() {
    check("pool.glb", &Bounds::TEXTURED, [64, 36], 4);
}
