//! Flags on light from far away.

use crate::common::*;
use lumbre::core::Rgb;
use lumbre::io::{ExrImage, ExrLayer, write_exr};
use std::f32::consts::PI;
use std::path::Path;

fn floor(dir: &Path) -> String {
    scene(dir, &[(square(0.0, 4.0), GREY)])
}

const UP: &str = "--look-from 0,1,0 --look-at 0,9,0 --fov 20 --size 4x4 --spp 4";
const DOWN: &str = "--look-from 0,1,0 --look-at 0,0,0 --fov 20 --size 4x4 --spp 16";

#[test]
fn the_sky_is_a_colour_a_gradient_or_nothing() {
    let dir = folder();
    let scene = floor(dir.path());
    let of = |sky: &str| mean(&picture(dir.path(), &format!("{scene} {UP} --sky {sky}")));
    assert_eq!(of("0.5,1,2"), Rgb::new(0.5, 1.0, 2.0));
    let orange = of("#ff8000");
    assert!(orange.r == 1.0 && (orange.g - 0.2159).abs() < 1e-3 && orange.b == 0.0);
    let zenith = of("gradient");
    assert!(zenith.b > 2.0 * zenith.r && zenith.r > 0.1, "blue overhead");
    assert_eq!(of("off"), Rgb::BLACK);
    lumbre(&format!("render {scene} -o a.png --sky -1,0,0")).exits(2).says("none negative");
}

#[test]
fn a_scene_without_light_gets_the_gradient_sky_and_is_told() {
    let dir = folder();
    let scene = floor(dir.path());
    let said = "gradient sky added";
    let run = |light: &str| exr(dir.path(), &format!("{scene} {UP} {light}")).0;
    run("").says(said);
    run("--sky off").does_not_say(said).says("the picture will be black");
    run("--sky 1,1,1").does_not_say(said);
    run("--sun 40,10").does_not_say(said);
    exr(dir.path(), &format!("{SMOOTH} --size 4x4 --spp 1")).0.does_not_say(said);
}

#[test]
fn lamps_alone_bring_a_hint() {
    let dir = folder();
    let hint = "light: emissive surfaces only; --sky gradient adds a sky";
    let run = |scene: &str, more: &str| exr(dir.path(), &format!("{scene} --size 4x3 --spp 1 {more}")).0;
    let said = run(CORNELL, "").says(hint).stderr;
    assert_eq!(said.matches("light: ").count(), 1, "{said}");
    for light in ["--sky gradient", "--sky off", "--sun 40,10"] {
        run(CORNELL, light).does_not_say(hint);
    }
    run(&floor(dir.path()), "").does_not_say(hint);
}

#[test]
fn unlit_surfaces_are_not_black() {
    const UNLIT: &str = r#"{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1]},"extensions":{"KHR_materials_unlit":{}}}"#;
    let dir = folder();
    let scene = scene(dir.path(), &[(square(0.0, 4.0), UNLIT)]);
    let words = format!("{scene} {DOWN} --sky off");
    let (run, _) = exr(dir.path(), &words);
    run.says("nothing gives light: only unlit surfaces will be seen").does_not_say("black");
    assert!(mean(&picture(dir.path(), &words)).g > 0.4);
}

#[test]
fn the_sun_has_a_place_a_strength_and_a_colour() {
    let dir = folder();
    let scene = floor(dir.path());
    let of = |sun: &str| mean(&picture(dir.path(), &format!("{scene} {DOWN} --sun {sun}")));
    let close = |c: Rgb, lux: f32| (c.luminance() / (lux * 0.5 / PI) - 1.0).abs() < 0.01;
    let zenith = of("90,0");
    assert!(close(zenith, 15.0), "{zenith:?}");
    assert!(zenith.r > 1.1 * zenith.b, "slightly warm");
    assert!(close(of("90,0,30"), 30.0) && close(of("30,70,30"), 15.0));
    assert!(of("-10,0").luminance() == 0.0, "below the horizon");
    for (sun, towards) in
        [("30,90", [0.866, 0.5, 0.0]), ("30,-90", [-0.866, 0.5, 0.0]), ("0,0", [0.0, 0.0, -1.0])]
    {
        let run = lumbre(&format!("render {scene} {DOWN} --sun {sun} --pixel 1,1")).exits(0);
        let found = triple(run.line("light"), "towards");
        assert!(found.iter().zip(towards).all(|(a, b)| (a - b).abs() < 0.01), "{sun}: {found:?}");
    }
    lumbre(&format!("render {scene} -o a.png --sun 91,0")).exits(2).says("between -90 and 90");
}

#[test]
fn a_scene_brings_its_sky_and_sun_and_flags_stand_above_them() {
    let dir = folder();
    let scene = floor(dir.path());
    let mut doc: serde_json::Value = serde_json::from_slice(&std::fs::read(&scene).unwrap()).unwrap();
    let light = serde_json::json!({ "sky": [0.5, 0.5, 0.5], "sun": { "elevation": 90, "strength": 30 } });
    doc["scenes"][0]["extras"] = serde_json::json!({ "lumbre": light });
    std::fs::write(&scene, doc.to_string()).unwrap();
    let of = |words: &str| mean(&picture(dir.path(), &format!("{scene} {words}"))).luminance();
    let close =
        |got: f32, expected: f32| assert!((got / expected - 1.0).abs() < 0.02, "{got}, not {expected}");
    assert_eq!(of(UP), 0.5);
    assert_eq!(of(&format!("{UP} --sky 2,2,2")), 2.0);
    // The floor returns half of what falls on it, over π.
    let sky = 0.5 * 0.5;
    close(of(DOWN), sky + 30.0 * 0.5 / PI);
    close(of(&format!("{DOWN} --sky off")), 30.0 * 0.5 / PI);
    close(of(&format!("{DOWN} --sun 90,0,0")), sky);
    let env = dir.path().join("env.exr");
    let layers = vec![ExrLayer::rgb("", [Rgb::WHITE; 8].into_iter(), false)];
    write_exr(&env, ExrImage { width: 4, height: 2, layers, ..ExrImage::default() }).unwrap();
    close(of(&format!("{DOWN} --env {}", env.display())), 0.5);
}

#[test]
fn a_map_surrounds_the_scene_and_turns() {
    let dir = folder();
    let scene = floor(dir.path());
    // Red around -z, blue elsewhere.
    let red = |x: usize| (6..10).contains(&x);
    let pixels =
        (0..16 * 8).map(|i| if red(i % 16) { Rgb::new(4.0, 0.0, 0.0) } else { Rgb::new(0.0, 0.0, 1.0) });
    let layers = vec![ExrLayer::rgb("", pixels, false)];
    let env = dir.path().join("env.exr");
    write_exr(&env, ExrImage { width: 16, height: 8, layers, ..ExrImage::default() }).unwrap();
    let of = |at: &str, more: &str| {
        let view = format!("--look-from 0,1,0 --look-at {at} --fov 10 --size 2x2 --spp 1");
        mean(&picture(dir.path(), &format!("{scene} {view} --env {} {more}", env.display())))
    };
    assert_eq!(of("0,1,-1", ""), Rgb::new(4.0, 0.0, 0.0), "its centre lies at -z");
    assert_eq!(of("1,1,0", ""), Rgb::new(0.0, 0.0, 1.0));
    assert_eq!(of("1,1,0", "--env-rotate 90"), Rgb::new(4.0, 0.0, 0.0));
    assert_eq!(of("-1,1,0", "--env-rotate -90"), Rgb::new(4.0, 0.0, 0.0));
    assert_eq!(of("1,1,0", "--env-strength 0.5"), Rgb::new(0.0, 0.0, 0.5));
    lumbre(&format!("render {scene} -o a.png --env none.hdr")).exits(66).says("none.hdr: cannot open");
    lumbre(&format!("render {scene} -o a.png --env {} --sky gradient", env.display())).exits(2);
    lumbre(&format!("render {scene} -o a.png --env-rotate 5")).exits(2).says("--env <FILE>");
    lumbre(&format!("render {scene} -o a.png --env {} --env-strength -1", env.display()))
        .exits(2)
        .says("negative");
}
