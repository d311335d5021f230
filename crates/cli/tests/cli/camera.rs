//! Flags on where the picture is taken from.

use crate::common::*;

/// Origin and direction of the camera ray of a pixel.
fn ray(words: &str) -> ([f32; 3], [f32; 3]) {
    let run = lumbre(&format!("render {words}")).exits(0);
    let line = run.line("camera");
    (triple(line, "origin"), triple(line, "direction"))
}

fn close(a: [f32; 3], b: [f32; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 2e-3)
}

#[test]
fn cameras_go_by_name_and_number() {
    let default = ray(&format!("{CORNELL} --pixel 3,3 --size 8x6"));
    assert!(close(default.0, [0.0, 1.45, 4.9]));
    assert_eq!(ray(&format!("{CORNELL} --pixel 3,3 --size 8x6 --camera 0")), default);
    assert_eq!(ray(&format!("{CORNELL} --pixel 3,3 --size 8x6 --camera camera")), default);
    for wrong in ["1", "nobody"] {
        lumbre(&format!("render {CORNELL} -o a.png --camera {wrong}")).exits(2).says("the scene has camera");
    }
}

#[test]
fn the_eye_moves_and_turns() {
    let words = format!("{CORNELL} --pixel 0,0 --size 1x1 --fov 0.1");
    let (origin, direction) = ray(&format!("{words} --look-from -1,2,-3.5 --look-at -1,0,-3.5"));
    assert!(close(origin, [-1.0, 2.0, -3.5]) && close(direction, [0.0, -1.0, 0.0]));
    let (origin, direction) = ray(&format!("{words} --look-at 0,1.45,0"));
    assert!(close(origin, [0.0, 1.45, 4.9]) && close(direction, [0.0, 0.0, -1.0]), "the place stays");
    lumbre(&format!("render {CORNELL} -o a.png --look-from 1,2,3 --look-at 1,2,3"))
        .exits(2)
        .says("same point");
    lumbre(&format!("render {CORNELL} -o a.png --look-from 1,2")).exits(2).says("three numbers");
}

#[test]
fn the_field_of_view_is_vertical() {
    let up = |fov: &str| {
        let view = "--look-from 0,1,4 --look-at 0,1,0 --size 100x200 --pixel 50,0 --filter box";
        let (_, d) = ray(&format!("{CORNELL} {view} --fov {fov}"));
        d[1].atan2(-d[2]).to_degrees()
    };
    assert!((up("60") - 30.0).abs() < 0.3 && (up("20") - 10.0).abs() < 0.2);
    lumbre(&format!("render {CORNELL} -o a.png --fov 180")).exits(2).says("between 0 and 180");
    lumbre(&format!("render {CORNELL} -o a.png --fov -5")).exits(2).says("between 0 and 180");
}

#[test]
fn a_scene_without_camera_is_put_in_view() {
    let dir = folder();
    let scene = scene(dir.path(), &[(square(0.0, 1.0), GREY)]);
    let (run, image) = exr(dir.path(), &format!("{scene} --size 32x18 --spp 4"));
    run.says("camera: the scene has none").says("gradient sky added");
    let depth = image.layers.iter().find(|l| l.name == "depth").unwrap().channel("Z").unwrap();
    let seen = depth.iter().filter(|z| z.is_finite()).count();
    assert!(seen > 60 && seen < 32 * 18, "{seen} pixels show the square");
    assert!(!depth[0].is_finite() && !depth[32 * 18 - 1].is_finite(), "all of it is in view");
}

/// A lamp of 2 m by 2 m at the origin that faces up, under an orthographic camera that sees `wide` by `high` metres.
fn under_parallel_rays(dir: &std::path::Path, wide: f32, high: f32) -> String {
    let lamp = r#"{"emissiveFactor":[1,1,1],"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]}}"#;
    let path = scene(dir, &[(square(0.0, 1.0), lamp)]);
    let mut doc: serde_json::Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    let half = std::f32::consts::FRAC_1_SQRT_2;
    doc["cameras"] = serde_json::json!([{"type": "orthographic", "name": "flat",
        "orthographic": {"xmag": 0.5 * wide, "ymag": 0.5 * high, "znear": 1, "zfar": 2}}]);
    doc["nodes"] = serde_json::json!([{"mesh": 0},
        {"camera": 0, "translation": [0, 7, 0], "rotation": [-half, 0, 0, half], "scale": [3, 3, 3]}]);
    doc["scenes"] = serde_json::json!([{"nodes": [0, 1]}]);
    std::fs::write(&path, doc.to_string()).unwrap();
    path
}

#[test]
fn orthographic_cameras_show_what_their_magnification_says() {
    let dir = folder();
    let path = under_parallel_rays(dir.path(), 8.0, 4.0);
    // The lamp covers the eighth part of the view, whatever its distance.
    for more in ["", "--look-from 0,100,0 --look-at 0,0,0 --camera flat"] {
        let image = picture(dir.path(), &format!("{path} --size 32x16 --spp 1 --filter box {more}"));
        assert_eq!(mean(&image).g, 0.125, "{more}");
        let lit = |x: usize, y: usize| image.pixels[32 * y + x].g > 0.0;
        assert!(lit(12, 4) && lit(19, 11) && !lit(11, 8) && !lit(20, 8) && !lit(16, 3) && !lit(16, 12));
    }
    // A wider picture keeps the height, a higher one the width.
    assert_eq!(mean(&picture(dir.path(), &format!("{path} --size 64x16 --spp 1 --filter box"))).g, 0.0625);
    assert_eq!(mean(&picture(dir.path(), &format!("{path} --size 32x32 --spp 1 --filter box"))).g, 0.0625);
    // Without a size the picture has the camera's shape.
    lumbre(&format!("render {path} --pixel 0,0")).exits(0).says("1440x720");
    let (a, b) = (
        ray(&format!("{path} --size 32x16 --pixel 0,0")),
        ray(&format!("{path} --size 32x16 --pixel 31,15")),
    );
    assert!(close(a.1, [0.0, -1.0, 0.0]) && close(b.1, a.1), "rays are parallel");
    assert!((b.0[0] - a.0[0] - 8.0).abs() < 0.8 && (b.0[2] - a.0[2] - 4.0).abs() < 0.8 && a.0[1] == 7.0);
    let (_, perspective) = ray(&format!("{path} --size 32x16 --pixel 0,0 --fov 40"));
    assert!(!close(perspective, a.1));
}

/// What is in focus keeps its edge, what is not loses it; a smaller f-number loses more.
#[test]
fn the_lens_blurs_what_is_not_in_focus() {
    let dir = folder();
    // A lamp 4 m away, across the left half of the picture: its edge is the picture.
    let lamp = vec![
        -2.0, -2.0, -4.0, 0.0, -2.0, -4.0, 0.0, 2.0, -4.0, -2.0, -2.0, -4.0, 0.0, 2.0, -4.0, -2.0, 2.0, -4.0,
    ];
    let glows = r#"{"emissiveFactor":[1,1,1],"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]}}"#;
    let scene = scene(dir.path(), &[(lamp, glows)]);
    let edge = |flags: &str| {
        let view = "--look-from 0,0,0 --look-at 0.05,0,-4 --fov 1.5 --size 40x2 --spp 256 --filter box --sampler sobol";
        let image = picture(dir.path(), &format!("{scene} {view} --sky off --max-depth 0 {flags}"));
        // Columns neither lit nor dark.
        image.pixels[..40].iter().filter(|p| (0.02..0.98).contains(&p.g)).count()
    };
    assert!(edge("") <= 1, "{}", edge(""));
    assert!(edge("--aperture 0.4 --focus 4") <= 2, "{}", edge("--aperture 0.4 --focus 4"));
    let (open, wide) = (edge("--aperture 0.2 --focus 1"), edge("--aperture 0.4 --focus 1"));
    assert!(open > 4 && wide > open + 4, "{open} {wide}");
    // f = 12 mm / tan 0.75° = 916.7 mm, so that f/4.5834 is 0.2 m wide.
    assert!(edge("--aperture f/4.5834 --focus 1").abs_diff(open) <= 1);
}

#[test]
fn focus_is_found_in_the_centre_of_the_picture() {
    let dir = folder();
    let scene = scene(dir.path(), &[(square(0.0, 1.0), GREY)]);
    let out = dir.path().join("a.png");
    let run = |more: &str| {
        let words = "--size 8x8 --spp 1 --sky 1,1,1 --aperture 0.01";
        lumbre(&format!("render {scene} {words} -o {} {more}", out.display())).exits(0)
    };
    run("--look-from 0,3,0 --look-at 0,0,0.001").says("focus: 3.000 m");
    run("--look-from 0,3,0 --look-at 0,0,0.001 --focus auto").says("focus: 3.000 m");
    run("--look-from 0,3,0 --look-at 0,0,0.001 --focus 2").does_not_say("focus:");
    run("--look-from 0,3,9 --look-at 0,4,9").says("nothing lies in the centre");
}

#[test]
fn the_lens_flags_say_what_they_want() {
    for (words, says) in [
        ("--focus 2", "--aperture"),
        ("--aperture 0", "not above 0"),
        ("--aperture f/0", "not above 0"),
        ("--aperture f2", "f/N"),
        ("--aperture 0.1 --focus near", "auto"),
        ("--aperture 0.1 --focus -1", "not above 0"),
        ("--aperture 1e38", "not within"),
        ("--aperture f/1e-30", "not within"),
        ("--aperture 0.1 --focus 1e20", "not within"),
    ] {
        lumbre(&format!("render {CORNELL} -o a.png {words}")).exits(2).says(says);
    }
}

/// A crop holds the pixels of the whole picture.
#[test]
fn a_crop_is_cut_from_the_picture() {
    let dir = folder();
    let whole = picture(dir.path(), &format!("{CORNELL} --size 24x18 --spp 2"));
    let part = picture(dir.path(), &format!("{CORNELL} --size 24x18 --spp 2 --crop 5,3,10,7"));
    assert_eq!((part.width, part.height), (10, 7));
    for (i, p) in part.pixels.iter().enumerate() {
        assert_eq!(*p, whole.pixels[(3 + i / 10) * 24 + 5 + i % 10]);
    }
    for (words, says) in [
        ("--size 8x8 --crop 1,1,8,7", "reaches outside"),
        ("--size 8x8 --crop 4294967295,0,2,2", "reaches outside"),
        ("--crop 1,1,0,7", "X,Y,W,H"),
        ("--crop 1,1,7", "X,Y,W,H"),
        ("--crop -1,1,7,7", "X,Y,W,H"),
    ] {
        lumbre(&format!("render {CORNELL} -o a.png {words}")).exits(2).says(says);
    }
}

/// Pictures along a way, numbered; a way that is none says which line.
#[test]
fn pictures_along_a_way() {
    let dir = folder();
    let way = dir.path().join("way.txt");
    std::fs::write(&way, "0,1,4 0,0,0\n1,1,4 0,0,0 40\n").unwrap();
    let d = dir.path().display();
    let command = format!("render {SMOOTH} --size 8x6 --spp 1 -o {d}/p.png --camera-path {}", way.display());
    lumbre(&format!("{command} --frames 3")).exits(0).says("p-0003.png");
    let names: Vec<bool> = (0..=4).map(|i| dir.path().join(format!("p-000{i}.png")).is_file()).collect();
    assert_eq!(names, [false, true, true, true, false]);
    assert!(!dir.path().join("p.png").exists());
    lumbre(&format!("{command} --keep-sums")).exits(2);
    for (text, what) in [("0,1,4\n", "line 1: "), ("0,0,1 0,0,0\n", "two places")] {
        std::fs::write(&way, text).unwrap();
        lumbre(&command).exits(65).says("way.txt: ").says(what);
    }
    std::fs::remove_file(&way).unwrap();
    lumbre(&command).exits(66).says("way.txt");
}
