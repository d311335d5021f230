//! Flags on how a scene is read.

use crate::common::*;
use serde_json::{Value, json};

/// A lamp that looks down on the whole of the view in one scene, and one half as bright in another; each is twice as bright
/// in the variant "bright".
fn two_lamps(dir: &std::path::Path) -> String {
    let lamp = |v: f32| {
        format!(
            r#"{{"pbrMetallicRoughness":{{"baseColorFactor":[0,0,0,1],"metallicFactor":0}},"emissiveFactor":[{v},{v},{v}]}}"#
        )
    };
    let materials = [lamp(0.25), lamp(0.5), lamp(1.0)];
    let parts: Vec<_> = materials.iter().map(|m| (square(0.0, 9.0), m.as_str())).collect();
    let path = scene(dir, &parts);
    let mut doc: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    let part = |i: usize| {
        let mut part = doc["meshes"][0]["primitives"][i].clone();
        part["extensions"] = json!({"KHR_materials_variants": {"mappings": [
            {"material": i, "variants": [0]}, {"material": i + 1, "variants": [1, 2]}
        ]}});
        part
    };
    doc["meshes"] = json!([{"primitives": [part(1)]}, {"primitives": [part(0)]}]);
    doc["nodes"] = json!([{"mesh": 0}, {"mesh": 1}]);
    doc["scenes"] = json!([{"nodes": [0], "name": "day ñ"}, {"nodes": [1], "name": "night"}, {"nodes": [1]}]);
    doc["extensionsUsed"] = json!(["KHR_materials_variants"]);
    doc["extensions"] =
        json!({"KHR_materials_variants": {"variants": [{"name": "dim"}, {"name": "bright"}, {"name": "x"}]}});
    std::fs::write(&path, doc.to_string()).unwrap();
    path
}

#[test]
fn scene_and_variant_are_chosen() {
    let dir = folder();
    let path = two_lamps(dir.path());
    let seen = |flags: &[&str]| {
        let out = dir.path().join("test.exr");
        let view = "--look-from 0,2,0.001 --look-at 0,0,0 --size 4x4 --spp 1";
        let mut c = command();
        c.arg("render").arg(&path).args(view.split(' ')).args(flags).arg("-o").arg(&out);
        let run = Run::from(c.output().unwrap()).exits(0);
        let image = lumbre::io::read_linear_image(&out, None, &Default::default()).unwrap();
        (mean(&image).g, run)
    };
    let (day, run) = seen(&[]);
    assert_eq!(day, 0.5);
    run.says("there are 3; scene 0 is shown");
    for (flags, radiance) in [
        (&["--scene", "1"][..], 0.25),
        (&["--scene", "night"], 0.25),
        (&["--scene", "day ñ"], 0.5),
        (&["--variant", "dim"], 0.5),
        (&["--variant", "bright"], 1.0),
        (&["--variant", "bright", "--scene", "night"], 0.5),
        (&["--variant", "x", "--scene", "2"], 0.5),
    ] {
        let (seen, run) = seen(flags);
        assert_eq!(seen, radiance, "{flags:?}");
        if flags.contains(&"--scene") {
            run.does_not_say("is shown");
        }
    }
}

#[test]
fn what_is_not_there_is_listed() {
    let dir = folder();
    let render = format!("render {} -o a.png", two_lamps(dir.path()));
    let scenes = r#"there are "day ñ", "night", "2""#;
    lumbre(&format!("{render} --scene 3")).exits(2).says("no scene 3; ").says(scenes);
    lumbre(&format!("{render} --scene dusk")).exits(2).says("no scene \"dusk\"; ").says(scenes);
    let variants = r#"no variant "red"; there are "dim", "bright", "x""#;
    lumbre(&format!("{render} --variant red")).exits(2).says(variants);
    lumbre(&format!("render {CORNELL} -o a.png --variant red")).exits(2).says("there are none");
    lumbre(&format!("{render} --scene=")).exits(2).says("a name or a number");
}

/// An OBJ under a white sky whose only texture, of a quarter of white, lies in another folder and is named in the way of another system.
#[test]
fn textures_are_found_in_the_folders_that_are_named() {
    let dir = folder();
    let write = |name: &str, bytes: &[u8]| {
        let path = dir.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    };
    write(
        "scene/floor.obj",
        b"mtllib floor.mtl\nv -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1 4/1\n",
    );
    write("scene/floor.mtl", b"newmtl m\nKd 0.5 0.5 0.5\nKe 1 1 1\nmap_Ke C:\\textures\\grey.png\n");
    // sRGB 137 is linear 0.25.
    lumbre::io::write_png(dir.path().join("grey.png"), 1, 1, &[137; 3]).unwrap();
    write("textures/grey.png", &std::fs::read(dir.path().join("grey.png")).unwrap());
    let at = |name: &str| dir.path().join(name).display().to_string();
    let (scene, textures) = (at("scene/floor.obj"), at("textures"));
    let view = "--look-from 0,2,0.001 --look-at 0,0,0 --size 4x4 --spp 1 --max-depth 0";
    let (run, _) = exr(dir.path(), &format!("{scene} {view}"));
    run.says("floor.mtl: line 4: refused path").says("the material goes without it");
    let shown = |flags: &str| mean(&picture(dir.path(), &format!("{scene} {view} {flags}"))).g;
    assert_eq!(shown(""), 1.0);
    assert!((shown(&format!("--asset-dir {textures}")) - 0.25).abs() < 0.002);
    let both = format!("--asset-dir {} --asset-dir {textures}", at("scene"));
    let (run, _) = exr(dir.path(), &format!("{scene} {view} {both}"));
    run.says("textures/grey.png is taken instead");
    lumbre(&format!("render {scene} -o a.png --asset-dir {}", at("none")))
        .exits(66)
        .says("none: cannot open");
}
