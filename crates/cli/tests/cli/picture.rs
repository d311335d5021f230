//! Flags on the picture: -o, --size, --exposure, and what the files hold.

use crate::common::*;
use lumbre::io::{Limits, read_linear_image};

#[test]
fn exr_has_layers_and_what_made_it() {
    let dir = folder();
    let (run, image) =
        exr(dir.path(), &format!("{CORNELL} --size 12x9 --spp 5 --seed 7 --max-depth unlimited"));
    run.says("device: CPU").says("wrote ").does_not_say("warning");
    assert_eq!((image.width, image.height), (12, 9));
    let names: Vec<&str> = image.layers.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(names, ["", "albedo", "depth", "error", "normal", "position", "samples"]);
    let layer = |name: &str| image.layers.iter().find(|l| l.name == name).unwrap();
    assert!(layer("samples").channel("Y").unwrap().iter().all(|n| *n == 5.0));
    assert!(layer("depth").channel("Z").unwrap().iter().all(|z| (1.0..9.0).contains(z)));
    assert!(layer("").channel("R").unwrap().iter().all(|r| *r >= 0.0));
    assert_eq!(layer("normal").channels.len(), 3);
    let meta = |name: &str| image.metadata.iter().find(|(n, _)| n == name).map(|(_, v)| v.as_str());
    assert_eq!(meta("lumbre.scene"), Some("cornell.glb"));
    assert_eq!(meta("lumbre.version"), Some(env!("CARGO_PKG_VERSION")));
    let settings = ["spp", "seed", "sampler", "maxDepth"].map(|n| meta(&format!("lumbre.{n}")));
    assert_eq!(settings, [Some("5"), Some("7"), Some("sobol"), Some("unlimited")]);
    assert_eq!(meta("lumbre.interrupted"), None);
}

#[test]
fn exr_says_which_camera_and_light_made_it() {
    let dir = folder();
    let of = |words: &str| {
        let metadata = exr(dir.path(), &format!("{words} --size 4x4 --spp 1")).1.metadata;
        let names = ["camera", "lookFrom", "lookAt", "fov", "sky", "sun", "env", "envRotate", "envStrength"];
        let find = |n: &str| metadata.iter().find(|(m, _)| *m == format!("lumbre.{n}"));
        names.into_iter().filter_map(|n| Some(format!("{n}={}", find(n)?.1))).collect::<Vec<_>>()
    };
    assert_eq!(of(SMOOTH), [""; 0], "the scene decides");
    assert_eq!(
        of(&format!(
            "{SMOOTH} --camera 0 --look-from 1,2.5,-3 --look-at 0,0.1,0 --fov 33.3 --sky #ff0000 --sun 40,-10"
        )),
        ["camera=0", "lookFrom=1,2.5,-3", "lookAt=0,0.1,0", "fov=33.3", "sky=1,0,0", "sun=40,-10,15"]
    );
    let env = dir.path().join("env.exr");
    exr(dir.path(), &format!("{SMOOTH} --size 4x2 --spp 1"));
    std::fs::rename(dir.path().join("test.exr"), &env).unwrap();
    let lit = format!("{SMOOTH} --env {} --env-rotate 90", env.display());
    assert_eq!(of(&lit), ["env=env.exr", "envRotate=90", "envStrength=1"]);
    let dark = scene(dir.path(), &[(square(0.0, 1.0), GREY)]);
    assert_eq!(of(&dark), ["sky=gradient"], "added, since the scene has no light");
    assert_eq!(of(&format!("{dark} --sky off")), ["sky=off"]);
}

#[test]
fn several_outputs_are_one_render() {
    let dir = folder();
    let d = dir.path().display();
    lumbre(&format!("render {CORNELL} --size 16x12 --spp 4 -o {d}/a.png --output {d}/b.EXR -o {d}/c.exr"))
        .exits(0);
    let read = |name: &str| read_linear_image(dir.path().join(name), None, &Limits::default()).unwrap();
    assert_eq!(read("b.EXR"), read("c.exr"));
    assert_eq!((read("a.png").width, read("a.png").height), (16, 12));
    lumbre(&format!("compare {d}/b.EXR {d}/a.png --fail-above rmse=0.01")).exits(0);
}

#[test]
fn the_default_size_has_the_shape_of_the_camera() {
    let dir = folder();
    let size =
        |scene: &str| lumbre(&format!("render {scene} --pixel 0,0")).exits(0).line("sample").to_string();
    assert!(size(CORNELL).contains("of 960x720"));
    assert!(size(SMOOTH).contains("of 720x720"));
    assert!(size(&scene(dir.path(), &[(square(0.0, 1.0), GREY)])).contains("of 1280x720"));
}

/// Codes of the red channel of a PNG of a sky of one radiance, 0.25.
fn code(exposure: &str) -> u8 {
    let dir = folder();
    let scene = scene(dir.path(), &[(square(0.0, 1.0), GREY)]);
    let away = "--look-from 0,1,0 --look-at 0,9,0 --size 4x4 --spp 1 --sky 0.25,0.25,0.25";
    let path = dir.path().join("a.png");
    lumbre(&format!("render {scene} {away} --exposure {exposure} -o {}", path.display())).exits(0);
    let image = read_linear_image(&path, None, &Limits::default()).unwrap();
    assert!(image.pixels.iter().all(|p| *p == image.pixels[0]));
    lumbre::core::color::srgb_encode_u8(image.pixels[0].r)
}

#[test]
fn exposure_makes_png_brighter_or_darker() {
    // sRGB codes of 0.25, 0.5, 0.125, 0.18 and 0.5 / 0.25 · 0.25.
    let codes = ["0", "1", "-1", "auto", "thesis"].map(code);
    assert_eq!(codes, [137, 188, 99, 118, 188]);
}

#[test]
fn a_picture_that_cannot_be_written_is_refused_before_the_work() {
    let dir = folder();
    let long = format!("render {CORNELL} --spp 1000000 -o {}", dir.path().display());
    let missing = dir.path().join("none").display().to_string();
    lumbre(&format!("{long}/none/a.png"))
        .exits(74)
        .says(&format!("cannot write: there is no folder {missing}\n"))
        .does_not_say(".a.png.");
    lumbre(&long).exits(2).says("an output is a .png, .jpg, .hdr or .exr");
    lumbre(&format!("{long}/a.bmp")).exits(2).says("an output is a .png, .jpg, .hdr or .exr");
    std::fs::create_dir(dir.path().join("b.png")).unwrap();
    lumbre(&format!("{long}/b.png")).exits(74).says("it is a folder");
    let names: Vec<_> = std::fs::read_dir(dir.path()).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(names, ["b.png"], "checks leave nothing behind");
}

#[test]
fn an_input_is_not_overwritten() {
    let dir = folder();
    let env = dir.path().join("sky.exr");
    lumbre(&format!("render {SMOOTH} --size 4x2 --spp 1 -o {}", env.display())).exits(0);
    let before = std::fs::read(&env).unwrap();
    lumbre(&format!("render {SMOOTH} --size 4x2 --spp 1 --env {0} -o {0}", env.display()))
        .exits(2)
        .says("is read and cannot be the output too");
    assert_eq!(std::fs::read(&env).unwrap(), before);
}
