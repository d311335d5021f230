//! `--edits`: the picture is that of the flags, or of the scene, that say the same; flags stand above the file; mistakes are told.

use crate::common::*;
use lumbre::io::{ExrImage, ExrLayer, write_exr};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Writes edits with these members.
fn edits(dir: &Path, mut members: Value) -> String {
    members["lumbreEdits"] = json!(1);
    let path = dir.join("scene.edits.json");
    std::fs::write(&path, members.to_string()).unwrap();
    path.display().to_string()
}

/// What is in a picture, but not what was said of how it came about.
fn pixels(dir: &Path, words: &str) -> Vec<ExrLayer> {
    exr(dir, &format!("{words} --size 16x12 --spp 4")).1.layers
}

#[track_caller]
fn same(dir: &Path, one: &str, other: &str, unlike: &str) {
    let first = pixels(dir, one);
    // Compared by bits, since depths may be infinite and normals absent.
    let bits = |layers: &[ExrLayer]| -> Vec<u32> {
        let values = layers.iter().flat_map(|l| l.channels.iter().flat_map(|(_, v)| v));
        values.map(|v| v.to_bits()).collect()
    };
    assert!(bits(&first) == bits(&pixels(dir, other)), "{one}\n{other}");
    assert!(bits(&first) != bits(&pixels(dir, unlike)), "{one}\n{unlike}");
}

#[test]
fn camera_and_settings_are_those_of_the_flags() {
    let dir = folder();
    let file = edits(
        dir.path(),
        json!({
            "camera": {"eye": [0.5, 1, 4], "target": [0, 1, 0], "fov": 30.5, "aperture": "f/2", "focus": 3.7},
            "bookmarks": {"high up": {"eye": [0, 2.25, 4]}, "in the dark": {"fov": 10}},
            "settings": {"maxDepth": 3, "roulette": "off", "sampler": "independent", "seed": 4000000000u32,
                "filter": "tent", "clamp": 0.5, "transmissiveShadows": "physical", "hemisphere": "uniform"}
        }),
    );
    let camera = "--look-from 0.5,1,4 --look-at 0,1,0 --fov 30.5 --aperture f/2 --focus 3.7";
    let settings = "--max-depth 3 --roulette off --sampler independent --seed 4000000000 --filter tent --clamp 0.5 \
                    --transmissive-shadows physical --hemisphere uniform";
    let with = format!("{CORNELL} --edits {file}");
    same(dir.path(), &with, &format!("{CORNELL} {camera} {settings}"), &format!("{CORNELL} {camera}"));
    // What is given stands above, one by one.
    let other = camera.replace("30.5", "40").replace("3.7", "2.5");
    let over = format!("{with} --fov 40 --focus 2.5 --seed 5 --filter blackman-harris");
    let all = settings.replace("4000000000", "5").replace("tent", "blackman-harris");
    same(dir.path(), &over, &format!("{CORNELL} {other} {all}"), &with);
    // Another camera replaces all of the file's, and a bookmark is one.
    let by_name = format!("{with} --camera camera");
    same(dir.path(), &by_name, &format!("{CORNELL} {settings}"), &with);
    let bookmark = dir.path().join("b.exr");
    let mut c = command();
    c.args([
        "render", CORNELL, "--edits", &file, "--camera", "high up", "--size", "16x12", "--spp", "4", "-o",
    ]);
    Run::from(c.arg(&bookmark).output().unwrap()).exits(0);
    let (_, flags) =
        exr(dir.path(), &format!("{CORNELL} --look-from 0,2.25,4 {settings} --size 16x12 --spp 4"));
    let read = lumbre::io::read_exr(&bookmark, &Default::default()).unwrap();
    assert_eq!(read.layers[0].channels, flags.layers[0].channels);
    // Both say how the picture was made.
    let said = |image: &ExrImage, name: &str| {
        image.metadata.iter().find(|(n, _)| n == name).map(|(_, v)| v.clone()).unwrap_or_default()
    };
    assert_eq!((said(&read, "lumbre.maxDepth"), said(&read, "lumbre.filter")), ("3".into(), "tent".into()));
    assert_eq!(
        (said(&read, "lumbre.clamp"), said(&read, "lumbre.edits")),
        ("0.5".into(), "scene.edits.json".into())
    );
}

/// A copy of the box as text and buffer, to be edited by hand.
fn copy_of_cornell(dir: &Path, edit: impl FnOnce(&mut Value)) -> String {
    let bytes = std::fs::read(CORNELL).unwrap();
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let mut doc: Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    edit(&mut doc);
    let mut text = doc.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut out = bytes[..12].to_vec();
    out.extend((text.len() as u32).to_le_bytes());
    out.extend(b"JSON");
    out.extend(&text);
    out.extend(&bytes[20 + length..]);
    let total = out.len() as u32;
    out[8..12].copy_from_slice(&total.to_le_bytes());
    let path = dir.join("by-hand.glb");
    std::fs::write(&path, out).unwrap();
    path.display().to_string()
}

#[test]
fn the_scene_is_that_of_a_file_edited_by_hand() {
    let dir = folder();
    let file = edits(
        dir.path(),
        json!({
            "scene": "cornell.glb",
            "materials": {"copper": {"roughness": 0.125, "baseColor": [0.25, 0.5, 1]},
                "white glaze": {"emissionColor": [1, 0.5, 0.25], "emissionStrength": 2}},
            "nodes": {"vase": {"visible": false}, "plinth": {"translation": [0.125, 0, 0.25], "rotation": [0, 0, 0],
                "scale": [1, 0.5, 1]}},
            "addedLights": {"fill": {"kind": "point", "position": [0, 1, 1.5], "color": [1, 0.5, 0.25], "intensity": 4}}
        }),
    );
    let by_hand = copy_of_cornell(dir.path(), |doc| {
        let index = |doc: &Value, list: &str, name: &str| {
            doc[list].as_array().unwrap().iter().position(|v| v["name"] == name).unwrap()
        };
        let copper = index(doc, "materials", "copper");
        let pbr = &mut doc["materials"][copper]["pbrMetallicRoughness"];
        pbr["roughnessFactor"] = json!(0.125);
        pbr["baseColorFactor"] = json!([0.25, 0.5, 1, 1]);
        let white = index(doc, "materials", "white glaze");
        doc["materials"][white]["emissiveFactor"] = json!([1, 0.5, 0.25]);
        let strength = json!({"emissiveStrength": 2});
        doc["materials"][white]["extensions"]["KHR_materials_emissive_strength"] = strength;
        let vase = index(doc, "nodes", "vase");
        doc["nodes"][vase]["extensions"]["KHR_node_visibility"] = json!({"visible": false});
        let plinth = index(doc, "nodes", "plinth");
        let node = doc["nodes"][plinth].as_object_mut().unwrap();
        ["matrix", "rotation"].iter().for_each(|key| drop(node.remove(*key)));
        node.insert("translation".into(), json!([0.125, 0, 0.25]));
        node.insert("scale".into(), json!([1, 0.5, 1]));
        let light = json!({"type": "point", "color": [1, 0.5, 0.25], "intensity": 4});
        doc["extensions"]["KHR_lights_punctual"] = json!({"lights": [light]});
        let lamp = json!({"translation": [0, 1, 1.5], "extensions": {"KHR_lights_punctual": {"light": 0}}});
        let at = doc["nodes"].as_array().unwrap().len();
        doc["nodes"].as_array_mut().unwrap().push(lamp);
        doc["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(at));
        let used = doc["extensionsUsed"].as_array().cloned().unwrap_or_default();
        let new = ["KHR_lights_punctual", "KHR_node_visibility", "KHR_materials_emissive_strength"];
        doc["extensionsUsed"] = used.into_iter().chain(new.map(Value::from)).collect();
    });
    same(dir.path(), &format!("{CORNELL} --edits {file}"), &by_hand, CORNELL);
}

#[test]
fn sky_sun_and_look_are_those_of_the_flags() {
    let dir = folder();
    let scene = scene(dir.path(), &[(square(0.0, 4.0), GREY)]);
    let pixels = (0..8).map(|i| lumbre::core::Rgb::splat(i as f32));
    let layers = vec![ExrLayer::rgb("", pixels, false)];
    std::fs::create_dir(dir.path().join("maps")).unwrap();
    let map = dir.path().join("maps/sky.exr");
    write_exr(&map, ExrImage { width: 4, height: 2, layers, ..ExrImage::default() }).unwrap();
    let sun = json!({"on": true, "elevation": 50, "azimuth": -120.5, "strength": 30});
    let sky = json!({"kind": "file", "file": "maps/sky.exr", "rotation": 30, "strength": 0.5});
    let file = edits(dir.path(), json!({"sun": sun, "sky": sky}));
    let with = format!("{scene} --edits {file}");
    let env = format!("--env {} --env-rotate 30 --env-strength 0.5", map.display());
    same(dir.path(), &with, &format!("{scene} {env} --sun 50,-120.5,30"), &format!("{scene} {env}"));
    // A sky of the flags makes the file needless, and a map brings its own sun.
    std::fs::rename(&map, dir.path().join("sky.exr")).unwrap();
    lumbre(&format!("render {with} -o {}", dir.path().join("a.png").display()))
        .exits(66)
        .says("sky.exr: cannot open");
    let over = format!("{with} --sky gradient");
    same(
        dir.path(),
        &over,
        &format!("{scene} --sky gradient --sun 50,-120.5,30"),
        &format!("{scene} --sky gradient"),
    );
    let over = format!("{with} --env {}", dir.path().join("sky.exr").display());
    same(dir.path(), &over, &over.replace(&format!("--edits {file}"), ""), &scene);
    // The gradient sky that a dark scene gets is there before it is edited.
    let lamp = json!({"addedLights": {"lamp": {"position": [0, 1, 0]}}});
    let with = format!("{scene} --edits {}", edits(dir.path(), lamp));
    exr(dir.path(), &format!("{with} --size 4x4 --spp 1")).0.says("gradient sky added");
    same(dir.path(), &with, &format!("{with} --sky gradient"), &scene);
    let off = edits(dir.path(), json!({"sky": {"kind": "off"}}));
    exr(dir.path(), &format!("{scene} --edits {off} --size 4x4 --spp 1")).0.says("the picture will be black");
}

#[test]
fn the_look_is_developed() {
    let dir = folder();
    let png = |words: &str| {
        let out = dir.path().join("a.png");
        lumbre(&format!("render {CORNELL} --size 16x12 --spp 4 {words} -o {}", out.display())).exits(0);
        std::fs::read(&out).unwrap()
    };
    let look = json!({"exposure": -1.5, "tone": "agx", "vignette": 0.5, "aberration": 1.25});
    let file = edits(dir.path(), json!({"look": look, "settings": {"background": "transparent"}}));
    let flags = "--exposure -1.5 --tone agx --vignette 0.5 --aberration 1.25 --background transparent";
    assert!(png(&format!("--edits {file}")) == png(flags));
    let over = png(&format!("--edits {file} --tone srgb --exposure 1 --background scene"));
    assert!(over == png("--exposure 1 --vignette 0.5 --aberration 1.25") && over != png(flags));
    // An offset is one of an exposure that finds itself.
    let of = |look: Value, words: &str| {
        png(&format!("--edits {} {words}", edits(dir.path(), json!({"look": look}))))
    };
    let (plain, brighter) = (png(""), of(json!({"exposureOffset": 1}), ""));
    let sum = |png: &[u8]| {
        let path = dir.path().join("b.png");
        std::fs::write(&path, png).unwrap();
        mean(&lumbre::io::read_linear_image(&path, None, &Default::default()).unwrap()).luminance()
    };
    assert!(sum(&brighter) > 1.2 * sum(&plain), "{} {}", sum(&brighter), sum(&plain));
    assert!(of(json!({"exposureOffset": 1}), "--exposure auto") == plain, "who says `auto` means just that");
}

#[test]
fn mistakes_are_told_with_file_and_place() {
    let dir = folder();
    let out = dir.path().join("a.png");
    let run = |file: &str| {
        lumbre(&format!("render {CORNELL} --size 4x3 --spp 1 --edits {file} -o {}", out.display()))
    };
    run("none.json").exits(66).says("none.json: cannot open: no such file");
    let file = edits(dir.path(), json!({"materials": {"coper": {"roughness": 0.5}}}));
    run(&file)
        .exits(65)
        .says("scene.edits.json: /materials/coper: there is no such material; the scene has back wall");
    let file = edits(dir.path(), json!({"materials": {"copper": {"roughness": 5}}}));
    run(&file)
        .exits(65)
        .says("scene.edits.json: line 1: /materials/copper/roughness: expected a number from 0 to 1, not 5");
    let file = edits(dir.path(), json!({"camera": {"camera": "nobody"}}));
    run(&file).exits(2).says("no camera \"nobody\"; the scene has camera");
    assert!(!out.exists());
    let file = edits(dir.path(), json!({"scene": "pool.glb", "sun": {"elevation": 20}}));
    run(&file)
        .exits(0)
        .says("made for pool.glb, not for cornell.glb")
        .says("/sun/elevation: does not show, as things are");
    let over = PathBuf::from(&file);
    lumbre(&format!("render {CORNELL} --edits {file} -o {}", over.display())).exits(2);
}

#[test]
fn info_and_bench_see_the_edited_scene() {
    let dir = folder();
    let all =
        json!({"nodes": {"lamp": {"visible": false}}, "camera": {"fov": 20}, "settings": {"maxDepth": 2}});
    let file = edits(dir.path(), all);
    lumbre(&format!("info {CORNELL}")).exits(0);
    let said = lumbre(&format!("info {CORNELL} --edits {file}")).exits(0).stdout;
    assert!(said.contains("light"), "{said}");
    assert_ne!(said, lumbre(&format!("info {CORNELL}")).exits(0).stdout);
    let words = format!("bench size {CORNELL} --edits {file} --sizes 16x12 --frames 1 --warm-up 1 --json");
    let table = lumbre(&words).exits(0).last_json();
    let row = &table["rows"][0];
    assert_eq!((&row["camera"], &row["depth"]), (&json!("of the edits"), &json!(2)), "{row}");
}
