//! `--pixel --sample`, and the messages that lead there.

use crate::common::*;

#[test]
fn a_replayed_path_is_the_one_in_the_picture() {
    let dir = folder();
    let words = format!("{CORNELL} --size 12x9 --seed 3");
    let image = picture(dir.path(), &format!("{words} --spp 1"));
    for (x, y) in [(0, 0), (5, 4), (11, 8), (6, 6)] {
        let run = lumbre(&format!("render {words} --pixel {x},{y} --sample 0")).exits(0);
        let found = triple(run.line("result"), "radiance");
        let stored = image.pixels[y * 12 + x].to_array();
        assert!(found.iter().zip(stored).all(|(a, b)| (a - b).abs() < 2e-6), "{found:?} {stored:?}");
        assert!(run.line("sample").contains(&format!("pixel {x},{y} of 12x9, index 0, seed 3")));
        assert!(run.line("camera") < run.line("hit"), "each step has its line");
    }
    let of = |sample: u32| lumbre(&format!("render {words} --pixel 5,4 --sample {sample}")).exits(0).stdout;
    assert_eq!(of(0), lumbre(&format!("render {words} --pixel 5,4")).stdout);
    assert_ne!(of(0), of(1));
}

#[test]
fn a_replay_writes_nothing_and_stays_inside() {
    let dir = folder();
    let out = dir.path().join("a.png");
    lumbre(&format!("render {SMOOTH} --size 8x8 --pixel 2,2 -o {}", out.display()))
        .exits(0)
        .says("no picture is written");
    assert!(!out.exists());
    lumbre(&format!("render {SMOOTH} --size 8x8 --pixel 8,2")).exits(2).says("outside the picture of 8x8");
    lumbre(&format!("render {SMOOTH} --size 8x8 --sample 2")).exits(2).says("--pixel");
}

#[test]
fn samples_that_are_not_finite_are_counted_and_named() {
    let dir = folder();
    // So bright that what is found and what is sampled can add up to more than a float holds.
    const GLOW: &str = r#"{"pbrMetallicRoughness":{"metallicFactor":0},"emissiveFactor":[1,1,1],"extensions":{
        "KHR_materials_specular":{"specularFactor":0},"KHR_materials_emissive_strength":{"emissiveStrength":2e38}}}"#;
    let plates = scene(dir.path(), &[(square(0.0, 4.0), GLOW), (square(2.0, -4.0), GLOW)]);
    let words = format!("{plates} --size 4x4 --spp 8 --look-from 0,1,0.1 --look-at 0,0,0");
    let (run, image) = exr(dir.path(), &words);
    let run = run.says("samples were not finite and count as black").says("brighter than the film can hold");
    assert!(image.layers.iter().flat_map(|l| &l.channels).flat_map(|(_, v)| v).all(|v| !v.is_nan()));
    // The command that is named shows the same.
    let line = run.stderr.lines().find(|l| l.contains("--pixel")).expect("a command");
    assert!(!line.contains("-o "), "{line}");
    let (_, rest) = line.split_once(" render ").unwrap();
    let again = lumbre(&format!("render {rest}")).exits(0);
    assert!(again.line("result").ends_with("(not finite: it counts as black)"), "{}", again.stdout);
}
