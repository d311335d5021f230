//! The path tracer's own rays, collected and replayed: they are all of a frame's, and find what they found there.

use crate::common::{Both, load};
use lumbre_core::settings::View;
use lumbre_scene::compiled::material::flag;
use lumbre_shaders::replay::{ReplayHit, ReplayRay};
use lumbre_testkit::ready::asset;
use lumbre_vulkan::{OwnRays, RayBatch};

/// Whole blocks of pixels: places of blocks that reach outside the picture are counted as rays.
const SIZE: [u32; 2] = [32, 24];

/// `veiled`: all surfaces are there by half, as the key of a ray has it.
fn collected(file: &str, veiled: bool) -> Option<(Both, View, OwnRays)> {
    let (mut scene, view) = load(&asset(file), "", SIZE[0] as f32 / SIZE[1] as f32);
    if veiled {
        scene.materials.iter_mut().for_each(|m| {
            m.flags |= flag::ALPHA_BLEND;
            m.alpha = 0.5;
        });
    }
    let both = Both::new(scene)?;
    let own = both.vulkan.own_rays(&view, SIZE).expect("the rays are collected");
    Some((both, view, own))
}

/// Whether a replayed ray found what the path tracer's did.
fn agree(shadow: bool, then: &ReplayHit, now: &ReplayHit) -> bool {
    let missed = (then.t < 0.0) == (now.t < 0.0);
    missed && (shadow || (then.instance, then.triangle, then.b) == (now.instance, now.triangle, now.b))
}

/// Rays of a kind that find something else when they are replayed after `disturb`, and how many find something.
fn differences(
    both: &Both,
    view: &View,
    batches: &[&RayBatch],
    disturb: impl Fn(&mut ReplayRay),
) -> (usize, usize) {
    let replay = both.vulkan.replay(view).expect("a pipeline");
    let (mut different, mut found) = (0, 0);
    for batch in batches {
        let mut rays = batch.rays.clone();
        rays.iter_mut().for_each(&disturb);
        let (hits, _) = replay.run(&rays).expect("the rays are replayed");
        let pairs = || batch.found.iter().zip(&hits);
        different += pairs().filter(|(then, now)| !agree(batch.shadow, then, now)).count();
        found += batch.found.iter().filter(|hit| hit.t >= 0.0).count();
    }
    (different, found)
}

/// Plain, with surfaces there only in part, with glass that shadow rays are followed through.
#[test]
fn they_are_those_of_a_frame() {
    for (file, glass) in [("cornell.glb", false), ("leaves.gltf", false), ("materials.glb", true)] {
        let Some((both, view, own)) = collected(file, false) else { return };
        let frames = both.vulkan.frames(&view, SIZE, 1, 1).expect("a frame");
        let shadow_rays = frames.progress.rays - frames.path_rays.expect("they are counted");
        println!("{file}: {} and {} of {shadow_rays} rays", own.count(false), own.count(true));
        assert_eq!(
            (own.path_rays, own.shadow_rays),
            (frames.progress.rays - shadow_rays, shadow_rays),
            "{file}"
        );
        assert_eq!((own.count(false), own.count(true)), (own.path_rays, own.shadow_rays), "{file}");
        assert!(own.count(true) > 300, "{file}");
        assert_eq!(own.through_glass > 0, glass, "{file}");
        let first = &own.batches[0];
        assert_eq!((first.step, first.shadow, first.rays.len()), (0, false, 32 * 24), "{file}");
    }
}

#[test]
fn they_find_what_they_found() {
    for (file, veiled) in [("cornell.glb", false), ("leaves.gltf", false), ("cornell.glb", true)] {
        let Some((both, view, own)) = collected(file, veiled) else { return };
        for shadow in [false, true] {
            let batches: Vec<&RayBatch> = own.batches.iter().filter(|b| b.shadow == shadow).collect();
            let (different, found) = differences(&both, &view, &batches, |_| {});
            println!("{file}: {different} of {} differ, {found} found something", own.count(shadow));
            assert_eq!(different, 0, "{file}, shadow: {shadow}");
            assert!(found > 50, "{file}, shadow: {shadow}");
            // Were the rays others, or their keys, it would show.
            let (different, _) = differences(&both, &view, &batches, |ray| ray.dir = ray.dir.map(|x| -x));
            assert!(different > found / 4, "{file}, shadow: {shadow}: {different}");
            let (different, _) = differences(&both, &view, &batches, |ray| ray.key ^= 1);
            assert_eq!(different > 0, veiled, "{file}, shadow: {shadow}: {different}");
        }
    }
}

/// One ray among all is noticed.
#[test]
fn a_disturbed_ray_is_noticed() {
    let Some((both, view, own)) = collected("cornell.glb", false) else { return };
    let first = &own.batches[0];
    let hit = first.found.iter().position(|hit| hit.t >= 0.0).expect("a hit");
    let mut batch = first.clone();
    batch.rays[hit].origin[1] += 100.0;
    assert_eq!(differences(&both, &view, &[&batch], |_| {}).0, 1);
}

#[test]
fn they_take_time_by_themselves() {
    let Some((both, view, own)) = collected("cornell.glb", false) else { return };
    let replayed = both.vulkan.replayed(&view, SIZE, 2).expect("they are replayed");
    assert_eq!((replayed.path_rays, replayed.shadow_rays), (own.count(false), own.count(true)));
    assert_eq!(replayed.left_out, 0);
    assert!(replayed.path_ms > 0.0 && replayed.shadow_ms > 0.0 && replayed.ms > 0.0, "{replayed:?}");
}
