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
