//! Flags on how light is sampled.

use crate::common::*;

fn rays(words: &str) -> u64 {
    let dir = folder();
    let out = dir.path().join("a.png");
    let line = format!("render {words} --progress json -o {}", out.display());
    lumbre(&line).exits(0).last_json()["rays"].as_u64().unwrap()
}

#[test]
fn seeds_give_other_noise_and_the_same_seed_the_same_bits() {
    let dir = folder();
    let of = |seed: u32| bytes(dir.path(), &format!("{SMOOTH} --size 8x8 --spp 2 --seed {seed}"));
    assert_eq!(of(0), bytes(dir.path(), &format!("{SMOOTH} --size 8x8 --spp 2")));
    let pixels =
        |seed: u32| picture(dir.path(), &format!("{SMOOTH} --size 8x8 --spp 2 --seed {seed}")).pixels;
    assert_ne!(pixels(0), pixels(1));
}

#[test]
fn depth_ends_paths() {
    let dir = folder();
    let of = |depth: &str| {
        let words = format!("{CORNELL} --size 16x12 --spp 16 --max-depth {depth}");
        (mean(&picture(dir.path(), &words)).luminance(), rays(&words))
    };
    let ((m1, r1), (m3, r3), (all, _)) = (of("1"), of("3"), of("unlimited"));
    assert!(m1 < 0.9 * m3 && m3 < all, "{m1} {m3} {all}");
    assert!(r1 < r3);
    // One hit and one question to the lights per sample, and the look where the path would go on.
    assert!(r1 <= 16 * 12 * 16 * 3, "{r1}");
}

#[test]
fn roulette_ends_paths_early() {
    let of = |first: &str| rays(&format!("{CORNELL} --size 16x12 --spp 4 --roulette {first}"));
    let (at_once, later, off) = (of("0"), of("4"), of("off"));
    assert!(at_once < later && later < off, "{at_once} {later} {off}");
}

/// Mean squared difference of the pictures of two seeds: twice the variance.
fn spread(words: &str) -> f32 {
    let dir = folder();
    let of = |seed: u32| picture(dir.path(), &format!("{words} --seed {seed}"));
    let (a, b) = (of(1), of(2));
    let squares = a.pixels.iter().zip(&b.pixels).map(|(a, b)| (a.luminance() - b.luminance()).powi(2));
    squares.sum::<f32>() / a.pixels.len() as f32
}

#[test]
fn sobol_points_are_less_noisy_than_independent_ones() {
    let of =
        |sampler: &str| spread(&format!("{SMOOTH} --size 16x16 --spp 16 --max-depth 1 --sampler {sampler}"));
    let (sobol, independent) = (of("sobol"), of("independent"));
    assert!(10.0 * sobol < independent, "{sobol} {independent}");
}

#[test]
fn filters_differ_in_how_much_they_blur() {
    let dir = folder();
    let of = |filter: &str| {
        noise(&picture(
            dir.path(),
            &format!("{CORNELL} --size 24x18 --spp 64 --max-depth 1 --filter {filter}"),
        ))
    };
    let [one, tent, gaussian, harris] = ["box", "tent", "gaussian", "blackman-harris"].map(of);
    assert!(one > tent && tent > gaussian, "{one} {tent} {gaussian}");
    assert!(harris != tent && harris != gaussian && harris < one);
}

#[test]
fn without_light_sampling_lights_are_found_by_chance() {
    let of = |switch: &str| spread(&format!("{SMOOTH} --size 16x16 --spp 16 --light-sampling {switch}"));
    let (on, off) = (of("on"), of("off"));
    assert!(100.0 * on < off, "{on} {off}");
}

#[test]
fn a_cosine_hemisphere_has_no_noise_under_an_even_sky() {
    let dir = folder();
    let scene = scene(dir.path(), &[(square(0.0, 1.0), GREY)]);
    let of = |way: &str| {
        let view = "--look-from 0,1,0 --look-at 0,0,0 --fov 20 --size 8x8 --spp 4 --max-depth 1";
        let words = format!("{scene} {view} --sky 1,1,1 --light-sampling off --hemisphere {way}");
        picture(dir.path(), &words)
    };
    let (cosine, uniform) = (of("cosine"), of("uniform"));
    assert!(cosine.pixels.iter().all(|p| (p.g - 0.5).abs() < 1e-5));
    assert!(noise(&cosine) < 1e-9 && noise(&uniform) > 1e-3);
    assert!((mean(&uniform).g - 0.5).abs() < 0.1);
}

#[test]
fn back_faces_are_invisible_unless_asked_for() {
    let dir = folder();
    let scene = scene(dir.path(), &[(square(0.0, 1.0), GREY)]);
    let of = |way: &str| {
        let view = "--look-from 0,-1,0 --look-at 0,0,0 --fov 20 --size 4x4 --spp 1 --sky 1,1,1 --max-depth 1";
        mean(&picture(dir.path(), &format!("{scene} {view} --back-faces {way}"))).g
    };
    assert_eq!(of("cull"), 1.0);
    assert!(of("shade") < 0.9);
}

#[test]
fn shadows_of_glass_are_as_asked() {
    const GLASS: &str = r#"{"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},"extensions":{
        "KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_volume":{"thicknessFactor":1}}}"#;
    let dir = folder();
    let slab = [square(1.0, -4.0), square(1.1, 4.0)].concat();
    let scene = scene(dir.path(), &[(square(0.0, 4.0), GREY), (slab, GLASS)]);
    let of = |way: &str, light: &str| {
        let view = "--look-from 0,0.5,0.01 --look-at 0,0,0 --fov 20 --size 4x4 --spp 4";
        mean(&picture(dir.path(), &format!("{scene} {view} {light} --transmissive-shadows {way}"))).g
    };
    let sun = "--sun 90,0,10 --max-depth 1";
    // What a bare floor would show, less two Fresnel reflections of 4 %.
    let expected = 10.0 * 0.5 / std::f32::consts::PI * 0.96 * 0.96;
    assert!((of("auto", sun) / expected - 1.0).abs() < 0.02, "{} {expected}", of("auto", sun));
    assert!((of("straight", sun) / expected - 1.0).abs() < 0.02);
    assert_eq!(of("physical", sun), 0.0);
    let sky = "--sky 1,1,1 --max-depth 1";
    let (auto, straight, physical) = (of("auto", sky), of("straight", sky), of("physical", sky));
    assert!(straight > 0.3 && auto == physical && auto < 0.5 * straight, "{auto} {straight} {physical}");
}

#[test]
fn the_clamp_takes_light_away_and_is_off_by_default() {
    let dir = folder();
    let words = format!("{CORNELL} --size 16x12 --spp 8");
    let (free, loose) = (picture(dir.path(), &words), picture(dir.path(), &format!("{words} --clamp 1e9")));
    let tight = picture(dir.path(), &format!("{words} --clamp 0.01"));
    assert_eq!(free.pixels, loose.pixels);
    assert!(mean(&tight).luminance() < 0.95 * mean(&free).luminance());
    for wrong in ["0", "-1", "off"] {
        lumbre(&format!("render {CORNELL} -o a.png --clamp {wrong}")).exits(2).says("--clamp");
    }
}
