//! `lumbre bench`: tables with plausible figures. How fast it is, no test says.

use crate::common::*;
use serde_json::Value;

/// Small, so that it is over soon.
const SMALL: &str = "--sizes 16x12 --frames 3 --warm-up 1";

fn rows(words: &str) -> (Value, Vec<Value>) {
    let line = lumbre(&format!("bench {words} --json")).exits(0).last_json();
    let rows = line["rows"].as_array().unwrap().clone();
    (line, rows)
}

#[track_caller]
fn number(row: &Value, key: &str) -> f64 {
    row[key].as_f64().unwrap_or_else(|| panic!("no {key} in {row}"))
}

#[test]
fn frames_over_size_and_depth() {
    let (line, all) =
        rows(&format!("path {CORNELL} --sizes 16x12,24x12 --depths 0,6 --frames 3 --roulette off"));
    let shapes: Vec<(&str, u64)> =
        all.iter().map(|r| (r["size"].as_str().unwrap(), r["depth"].as_u64().unwrap())).collect();
    assert_eq!(shapes, [("16x12", 0), ("16x12", 6), ("24x12", 0), ("24x12", 6)]);
    for row in &all {
        assert_eq!(
            (&row["scene"], &row["spp"], &row["frames"]),
            (&"cornell.glb".into(), &1.into(), &3.into())
        );
        // Frames per second are those of the median, more or less.
        let (fps, ms) = (number(row, "fps"), number(row, "frame_ms"));
        assert!(fps > 0.0 && ms > 0.0 && number(row, "mrays_per_second") > 0.0, "{row}");
        assert!(row["gpu_ms"].is_null());
    }
    assert_eq!(number(&all[0], "path_length"), 1.0, "the camera's ray alone");
    assert!((3.0..7.0).contains(&number(&all[1], "path_length")), "{}", all[1]);
    assert_eq!(line["settings"]["roulette"], "off");
    assert!(line["settings"]["device"].as_str().unwrap().starts_with("CPU ("));
}

/// Each table varies what it is named after; what the flags say holds for the rest.
#[test]
fn each_table_has_its_own_list() {
    let list = |words: &str, key: &str| -> Vec<Value> {
        let (_, rows) = rows(&format!("{words} {SMOOTH} --frames 1 --warm-up 1 --max-depth 2"));
        rows.iter().map(|r| r[key].clone()).collect()
    };
    let samples = list("samples --sizes 4x4", "spp");
    assert_eq!(samples, (1..=20).map(Value::from).collect::<Vec<_>>());
    assert_eq!(list("samples --sizes 4x4 --samples 3,5", "spp"), [3, 5]);
    let depths = list("depth --sizes 4x4", "depth");
    assert_eq!((&depths[0], depths.last().unwrap()), (&1.into(), &50.into()));
    assert_eq!(list("path --sizes 4x4", "depth"), [4, 6, 8, 10]);
    assert_eq!(list("size --sizes 4x4,8x8", "depth"), [2, 2]);
    assert_eq!(list("path --sizes 4x4 --depths unlimited", "depth"), ["unlimited"]);
}

#[test]
fn pictures_and_their_noise() {
    let (_, still) = rows(&format!("still {CORNELL} --sizes 16x12 --spp 80"));
    assert_eq!((still.len(), &still[0]["spp"]), (1, &80.into()));
    assert!((1e-3..1.0).contains(&number(&still[0], "error")) && number(&still[0], "seconds") > 0.0);
    let (_, both) = rows(&format!("hemisphere {CORNELL} {SMALL}"));
    let noise = |i: usize| number(&both[i], "error");
    assert_eq!((&both[0]["hemisphere"], &both[1]["hemisphere"]), (&"cosine".into(), &"uniform".into()));
    assert!(noise(1) > 1.1 * noise(0), "uniform directions are noisier: {both:?}");
    let product = noise(0) * 64.0 * number(&both[0], "frame_ms") * 1e-3;
    assert!((number(&both[0], "error_seconds") / product - 1.0).abs() < 1e-9);
}

#[test]
fn two_devices_at_equal_time() {
    let words = format!("equal-time {CORNELL} --sizes 16x12 --time 1s");
    // The CPU beside itself.
    let (_, both) = rows(&format!("{words} --device cpu"));
    assert_eq!((both.len(), number(&both[1], "times_less")), (2, 1.0));
    for row in &both {
        assert!((0.5..60.0).contains(&number(row, "seconds")) && number(row, "spp") >= 1.0, "{row}");
    }
    let ratio = number(&both[1], "error") / number(&both[0], "error");
    assert!((number(&both[0], "times_less") / ratio - 1.0).abs() < 1e-9);
    lumbre(&format!("bench {words}")).exits(69).says("no GPU to be held beside the CPU (auto: ");
    lumbre(&format!("bench {words} --device gpu")).exits(69).says("no GPU for `gpu`: ");
}

/// Of grids that are made for it, or of a scene; the CPU says how long it took and what it holds, no more.
#[test]
fn structures_have_their_bytes() {
    let (line, grids) = rows("build --triangles 200,5000 --device cpu");
    let triangles: Vec<_> = grids.iter().map(|r| (r["scene"].clone(), r["triangles"].clone())).collect();
    assert_eq!(triangles, [("grid".into(), 200.into()), ("grid".into(), 5000.into())]);
    for row in &grids {
        assert!((8.0..400.0).contains(&number(row, "bytes")) && number(row, "ready_ms") > 0.0, "{row}");
        assert!(row["bytes_built"].is_null() && row["build_ms"].is_null(), "{row}");
    }
    assert!(line["settings"]["device"].as_str().unwrap().starts_with("CPU ("));
    let (_, named) = rows(&format!("build {CORNELL} --device cpu"));
    assert_eq!((named.len(), &named[0]["scene"]), (1, &"cornell.glb".into()));
    lumbre("bench build --triangles 0").exits(2);
}

/// Steps add to the whole.
#[test]
fn the_first_frame_is_made_of_its_steps() {
    let (_, all) = rows(&format!("first-frame {SMOOTH} --sizes 16x12 --device cpu"));
    let row = &all[0];
    assert_eq!((all.len(), &row["scene"], &row["size"]), (1, &"smooth.gltf".into(), &"16x12".into()));
    let steps = ["before", "device", "load", "compile", "upload", "pipelines", "frame", "develop"];
    let sum: f64 = steps.iter().map(|step| number(row, &format!("{step}_ms"))).sum();
    assert!(row["build_ms"].is_null() && number(row, "load_ms") > 0.0, "{row}");
    assert!((number(row, "total_ms") - sum).abs() < 1.0 + 0.01 * sum, "{row}");
}

#[test]
fn tables_for_people_and_for_pages() {
    let text = lumbre(&format!("bench path {SMOOTH} {SMALL} --depths 1")).exits(0).says("depth 1: 1 a frame");
    assert!(text.line("scene ").contains("path length") && text.line("smooth.gltf ").contains("16x12"));
    assert!(text.line("frames: ").ends_with("median of up to 3 after 1"));
    let page = lumbre(&format!("bench path {SMOOTH} {SMALL} --depths 1 --markdown")).exits(0);
    assert!(page.line("| scene | camera |").ends_with(" | GPU ms |"));
    assert!(
        page.line("| --- |").contains("---:") && page.line("device: ").contains("; roulette: from event 4;")
    );
    lumbre("bench path a.glb --markdown --json").exits(2);
}

#[test]
fn cameras_are_those_of_the_scene_or_of_the_flags() {
    let pool = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/scenes/pool.glb");
    let names = |more: &str| -> Vec<String> {
        let (_, rows) = rows(&format!("path {pool} {SMALL} --depths 1 {more}"));
        rows.iter().map(|r| r["camera"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(names(""), ["exterior", "interior"]);
    assert_eq!(names("--camera interior"), ["interior"]);
    assert_eq!(names("--look-from 1,2,3"), ["of the flags"]);
    lumbre(&format!("bench path {pool} {SMALL} --camera roof"))
        .exits(2)
        .says("roof")
        .says("exterior, interior");
}

/// Without a scene: the pool, from the folder of the sources; Sponza only where it is found.
#[test]
fn the_pool_is_what_is_measured_by_default() {
    let mut c = command();
    c.current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).env("LUMBRE_SCENES", "/nonexistent");
    c.args(["bench", "path", "--sizes", "8x4", "--frames", "1", "--warm-up", "1", "--depths", "1", "--json"]);
    let run = Run::from(c.output().unwrap()).exits(0).says("no Sponza: /nonexistent/sponza/");
    let scenes: Vec<_> =
        run.last_json()["rows"].as_array().unwrap().iter().map(|r| r["scene"].clone()).collect();
    assert_eq!(scenes, ["pool.glb", "pool.glb"]);
}

#[test]
fn what_cannot_be_measured_is_said() {
    let dir = folder();
    let mut c = command();
    c.args(["bench", "path"]).current_dir(dir.path());
    Run::from(c.output().unwrap()).exits(66).says("assets/scenes/pool.glb is not here; name a scene");
    lumbre("bench path none.glb").exits(66).says("none.glb");
    lumbre("bench speed").exits(2).says("possible values: path, samples");
    for wrong in ["--sizes 0x4", "--depths -1", "--samples 0", "--frames 0", "--warm-up 0", "--spp 1"] {
        lumbre(&format!("bench path a.glb {wrong}")).exits(2);
    }
}
