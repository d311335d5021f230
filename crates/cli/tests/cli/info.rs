//! `lumbre info`: what it prints, for people and for programs, and how it ends.

use crate::common::*;
use serde_json::{Value, json};
use std::fs;

fn info(words: &str) -> Run {
    lumbre(&format!("info {words}"))
}

fn json_of(words: &str) -> Value {
    info(&format!("{words} --json")).exits(0).last_json()
}

/// Changes the JSON of a glTF and returns its path.
fn changed(path: &str, change: impl FnOnce(&mut Value)) -> String {
    let mut doc = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    change(&mut doc);
    fs::write(path, doc.to_string()).unwrap();
    path.into()
}

fn hint_kinds(report: &Value) -> Vec<&str> {
    report["hints"].as_array().unwrap().iter().map(|h| h["kind"].as_str().unwrap()).collect()
}

#[test]
fn a_scene_is_told_in_words() {
    let run = info(CORNELL).exits(0);
    assert_eq!(run.stderr, "");
    assert!(run.line("file ").ends_with("cornell.glb"));
    assert!(run.line("format ").starts_with("format      glTF 2.0, binary, "));
    assert!(run.line("geometry ").contains("triangles"), "{}", run.stdout);
    assert!(run.line("lights ").contains("emissive triangles of 1 material"), "{}", run.stdout);
    assert!(run.line("cameras ").contains("perspective, "), "{}", run.stdout);
    assert!(run.line("memory ").contains("MiB: scene "), "{}", run.stdout);
    assert_eq!(run.line("hints "), "hints       none");
}

#[test]
fn lines_have_at_most_80_columns_and_nothing_steers_the_terminal() {
    let dir = folder();
    let scene = scene(dir.path(), &[(square(0.0, 1.0), GREY)]);
    let long = "a very long name of a material, with \u{1b}[31m in it and then more words ".repeat(4);
    changed(&scene, |doc| {
        doc["materials"][0]["name"] = json!(long);
        doc["asset"]["generator"] = json!(long);
        doc["cameras"] =
            json!([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}, "name": long}]);
        doc["nodes"][0]["camera"] = json!(0);
        doc["extensionsUsed"] = json!(["KHR_materials_specular", "EXT_of_no_kind\n"]);
    });
    // Run in its folder, so that the path is short.
    let mut c = command();
    c.args(["info", "scene.gltf"]).current_dir(dir.path());
    let run = Run::from(c.output().unwrap()).exits(0);
    for line in run.stdout.lines() {
        assert!(line.chars().count() <= 80, "{line}");
        assert!(!line.chars().any(char::is_control), "{line:?}");
        assert_eq!(line, line.trim_end());
    }
    assert!(run.stdout.contains("\\u{1b}[31m"), "{}", run.stdout);
    assert!(run.stdout.contains("EXT_of_no_kind   used, not supported, ignored"), "{}", run.stdout);
}

#[test]
fn a_scene_is_told_to_programs() {
    let report = json_of(CORNELL);
    assert_eq!(report["format"], "glTF 2.0, binary");
    assert_eq!(report["geometry"]["drawn_triangles"], report["geometry"]["triangles"]);
    assert_eq!(report["cameras"].as_array().unwrap().len(), 1);
    assert_eq!(report["cameras"][0]["projection"], "perspective");
    assert!(report["lights"]["emissive_triangles"].as_u64() > Some(0));
    assert!(report["materials"].as_array().unwrap().iter().all(|m| m["used"] == true));
    assert_eq!(report["hints"], json!([]));
    let [small, large] = ["64x64", "640x640"].map(|size| {
        let memory = json_of(&format!("{CORNELL} --size {size}"))["memory"].clone();
        let part = |name: &str| memory[name].as_u64().unwrap();
        assert_eq!(part("rendering"), part("scene") + part("acceleration") + part("film"));
        part("film")
    });
    assert_eq!(large, 100 * small);
}

#[test]
fn hints_come_with_advice() {
    let dir = folder();
    let scene = scene(dir.path(), &[(square(0.0, 1.0), GREY)]);
    let run = info(&scene).exits(0);
    assert_eq!(run.line("hints "), "hints       - nothing in the scene gives light");
    let words: Vec<&str> = run.stdout.split_whitespace().collect();
    assert!(words.join(" ").contains("→ lumbre render adds a gradient sky; --sky, "), "{}", run.stdout);
    assert_eq!(hint_kinds(&json_of(&scene)), ["no-light"]);
    // From below a single-sided square is invisible.
    let below = changed(&scene, |doc| {
        doc["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]);
        let looks_up = [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, -3, 0, 1];
        doc["nodes"] = json!([{"mesh": 0}, {"camera": 0, "matrix": looks_up}]);
        doc["scenes"] = json!([{"nodes": [0, 1]}]);
    });
    assert_eq!(hint_kinds(&json_of(&below)), ["back-faces-only", "no-light"]);
    assert!(info(&below).exits(0).stdout.contains("--back-faces shade shows them"));
}

#[test]
fn extensions_have_a_verdict_and_a_required_one_is_65() {
    let dir = folder();
    let path = scene(dir.path(), &[(square(0.0, 1.0), GREY)]);
    changed(&path, |doc| {
        doc["extensionsUsed"] = json!(["KHR_materials_specular", "EXT_unheard_of"]);
        doc["extensionsRequired"] = json!(["EXT_unheard_of"]);
    });
    let run = info(&path).exits(65).says("EXT_unheard_of");
    let lines: Vec<&str> = run.stdout.lines().collect();
    assert!(
        lines.contains(&"extensions  EXT_unheard_of  required, NOT SUPPORTED: the scene cannot be drawn")
    );
    assert!(lines.contains(&"            KHR_materials_specular  used, supported"), "{}", run.stdout);
    assert!(run.line("lists ").contains("nodes 1, meshes 1, "), "{}", run.stdout);
    let report = info(&format!("{path} --json")).exits(65).last_json();
    assert_eq!(report["extensions"][0]["name"], "EXT_unheard_of");
    assert_eq!(report["extensions"][0]["required"], true);
    assert_eq!(report["extensions"][0]["supported"], false);
    assert_eq!(report["lists"]["meshes"], 1);
    assert_eq!(report.get("geometry"), None);
}

#[test]
fn scenes_and_variants_are_listed() {
    let dir = folder();
    let path = scene(dir.path(), &[(square(0.0, 1.0), GREY)]);
    changed(&path, |doc| {
        doc["scenes"] = json!([{"nodes": [0], "name": "day"}, {"nodes": [], "name": "night"}]);
        doc["extensionsUsed"] = json!(["KHR_materials_variants"]);
        doc["extensions"] =
            json!({"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "blue"}]}});
    });
    let run = info(&path).exits(0);
    assert_eq!(run.line("scenes "), "scenes      0  day  (shown)");
    assert_eq!(run.line("variants "), "variants    0  red");
    let report = json_of(&format!("{path} --scene night"));
    assert_eq!((&report["scenes"], &report["shown_scene"]), (&json!(["day", "night"]), &json!(1)));
    assert_eq!(report["variants"], json!(["red", "blue"]));
    assert_eq!(report["bounds"], Value::Null);
    assert_eq!(hint_kinds(&report), ["nothing-drawn"]);
    info(&format!("{path} --scene dusk")).exits(2).says("dusk");
    info(&format!("{path} --variant green")).exits(2).says("green");
}

#[test]
fn what_does_not_open_has_its_code() {
    let dir = folder();
    let d = dir.path().display();
    info(&format!("{d}/none.glb")).exits(66).says("no such file");
    info("").exits(2).says("SCENE");
    info(&format!("{SMOOTH} --size big")).exits(2).says("--size");
    fs::write(dir.path().join("a.gltf"), "{").unwrap();
    assert_eq!(info(&format!("{d}/a.gltf")).exits(65).says("a.gltf: JSON").stdout, "");
    fs::write(dir.path().join("a.blend"), "BLENDER").unwrap();
    info(&format!("{d}/a.blend")).exits(65).says("what opens");
    // The head is told even where a file that it names is not there.
    let scene = scene(dir.path(), &[(square(0.0, 1.0), GREY)]);
    fs::remove_file(dir.path().join("scene.bin")).unwrap();
    let run = info(&scene).exits(66).says("scene.bin");
    assert!(run.line("format ").starts_with("format      glTF 2.0, "));
}

#[test]
fn an_obj_has_the_same_codes() {
    let dir = folder();
    let path = dir.path().join("a.obj");
    let named = path.display().to_string();
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    fs::write(&path, triangle).unwrap();
    let report = json_of(&named);
    assert_eq!((&report["format"], &report["geometry"]["triangles"]), (&json!("Wavefront OBJ"), &json!(1)));
    for command in ["info", "render --size 4x4 --spp 1 -o a.png"] {
        let of = |scene: &str| {
            let mut c = crate::common::command();
            c.args(command.split(' ')).arg(scene).current_dir(dir.path());
            Run::from(c.output().unwrap())
        };
        of(&named).exits(0);
        of("none.obj").exits(66).says("none.obj");
        fs::write(dir.path().join("bad.obj"), "v 0 0 0\nf 1 2 9\n").unwrap();
        of("bad.obj").exits(65).says("bad.obj").says("2");
    }
}

#[test]
fn a_black_picture_points_to_info() {
    let dir = folder();
    let scene = scene(dir.path(), &[(square(0.0, 1.0), GREY)]);
    let words = format!("{scene} --size 8x8 --spp 1");
    exr(dir.path(), &format!("{words} --sky off")).0.says("the picture is black all over; `lumbre info ");
    exr(dir.path(), &words).0.does_not_say("lumbre info");
}

#[test]
fn the_help_has_examples() {
    let help = lumbre("info --help").exits(0).stdout;
    for part in ["Examples:", "Exit codes:", "--json", "--size", "--asset-dir", "--max-file-bytes"] {
        assert!(help.contains(part), "{part}");
    }
    assert!(lumbre("--help").exits(0).stdout.contains("info"));
}
