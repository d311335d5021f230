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

#[test]
fn debug() {
    let name = std::env::var("SCENE").unwrap();
    let mut ready = open(&asset(&name), 1.0);
    let Some(both) = Both::new(ready.backend.scene().clone()) else { return };
    for depth in [0, 1, 2, 3] {
        ready.view.settings.max_depth = Some(depth);
        let pairs = both.pairs(&ready.view, [32, 32], 1);
        println!("depth {depth}: {}", lumbre_testkit::paired::Paired::new(&pairs));
        let (a, b) = &pairs[0];
        if depth == 0 {
            let mut diff = [0; 4];
            for (p, q) in a.pixels().iter().zip(b.pixels()) {
                let d =
                    |x: [f32; 3], y: [f32; 3]| x.iter().zip(y).any(|(x, y)| (x - y).abs() > 1e-3) as usize;
                diff[0] += d(p.albedo().to_array(), q.albedo().to_array());
                diff[1] += d(p.normal(), q.normal());
                diff[2] += d(p.position(), q.position());
                diff[3] += ((p.alpha() - q.alpha()).abs() > 1e-3) as usize;
            }
            println!("albedo normal position alpha differ: {diff:?}");
        }
        let mut shown = 0;
        for (i, (p, q)) in a.pixels().iter().zip(b.pixels()).enumerate() {
            let (x, y) = (p.radiance().to_array(), q.radiance().to_array());
            if x.iter().zip(y).any(|(x, y)| (x - y).abs() > 1e-3 * x.abs().max(0.01)) && shown < 6 {
                shown += 1;
                println!("  {i}: {x:?} {y:?} albedo {:?} {:?}", p.albedo(), q.albedo());
            }
        }
    }
}
