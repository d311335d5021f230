//! Pictures from the GPU, and what becomes of them when it fails. On Mesa's CPU driver too, so pictures are tiny.

use crate::common::*;
use lumbre::io::{Limits, read_exr};
use std::path::Path;

/// Whether there is a GPU; says so, or fails where one is required, if not.
fn gpu() -> bool {
    let output = with_gpus().args(["devices", "--json"]).output().unwrap();
    let line = Run::from(output).exits(0).last_json();
    let list = line["devices"].as_array().unwrap();
    let found = list.iter().any(|d| d["device"] != "cpu" && d["lacks"].as_array().unwrap().is_empty());
    if !found {
        assert!(std::env::var("LUMBRE_REQUIRE_GPU").as_deref() != Ok("1"), "no GPU: {line}");
        println!("skipped: no Vulkan ray tracing device");
    }
    found
}

/// Draws the floor under its lamp into `dir/name`, with the variables set.
fn draw(dir: &Path, name: &str, words: &str, variables: &[(&str, &str)]) -> Run {
    let mut c = with_gpus();
    c.args(["render", SMOOTH, "--size", "12x8", "-o"]).arg(dir.join(name)).args(words.split_whitespace());
    c.envs(variables.iter().copied());
    c.output().unwrap().into()
}

/// Camera samples of each pixel of `dir/name`, which must be the same.
fn samples(dir: &Path, name: &str) -> f32 {
    let image = read_exr(dir.join(name), &Limits::default()).unwrap();
    let counts = image.layers.iter().find(|l| l.name == "samples").unwrap().channel("Y").unwrap();
    assert!(counts.iter().all(|n| *n == counts[0]), "pixels differ in their samples: {counts:?}");
    counts[0]
}

/// `dir/b.exr` is `dir/a.exr` but for roundings; a picture with other samples is not.
fn assert_alike(dir: &Path, a: &str, b: &str) {
    let d = dir.display();
    lumbre(&format!("compare {d}/{a} {d}/{b} --fail-above relmse=1e-10")).exits(0);
    let other = draw(dir, "other.exr", "--device cpu --spp 64 --seed 9", &[]);
    other.exits(0);
    lumbre(&format!("compare {d}/{a} {d}/other.exr --fail-above relmse=1e-10")).exits(1);
}

#[test]
fn the_gpu_draws_what_the_cpu_draws() {
    if !gpu() {
        return;
    }
    let dir = folder();
    let run = draw(dir.path(), "gpu.exr", "--device gpu --spp 64 --stats --validation", &[]).exits(0);
    let run = run
        .says("(as --device asks)")
        .says("GPU ms of `trace + shadow`")
        .does_not_say("warning: validation:");
    assert!(!run.stderr.contains("device: CPU ("), "{}", run.stderr);
    draw(dir.path(), "cpu.exr", "--device cpu --spp 64", &[]).exits(0).does_not_say("GPU ms");
    assert_eq!(samples(dir.path(), "gpu.exr"), 64.0);
    assert_alike(dir.path(), "cpu.exr", "gpu.exr");
}

/// In the midst of the render: setting up takes some twenty submissions, each pass two or more.
const LOST: (&str, &str) = ("LUMBRE_TEST_LOSE_DEVICE", "80");
/// More samples than a device that is lost then can have taken; an error that is never reached keeps passes short.
const LONG: &str = "--spp 2000 --target-error 1e-12";

#[test]
fn a_lost_gpu_leaves_an_even_picture_and_69() {
    if !gpu() {
        return;
    }
    let dir = folder();
    let run = draw(dir.path(), "lost.exr", &format!("{LONG} --device gpu"), &[LOST]).exits(69);
    let spp = samples(dir.path(), "lost.exr");
    assert!((1.0..2000.0).contains(&spp), "{spp}");
    let said = format!(": the picture so far is written, {spp} samples per pixel");
    let error = run.stderr.lines().find(|l| l.starts_with("error: ")).unwrap();
    assert!(error.contains("lost") && error.ends_with(&said), "{error}");
    // Before the first sample there is nothing to keep.
    let at_once = [(LOST.0, "1")];
    draw(dir.path(), "none.exr", &format!("{LONG} --device gpu"), &at_once).exits(69).says("lost");
    assert!(!dir.path().join("none.exr").exists());
}

#[test]
fn auto_goes_on_with_the_cpu() {
    if !gpu() {
        return;
    }
    let (dir, auto) = (folder(), ("LUMBRE_TEST_SOFTWARE_GPU", "1"));
    let run = draw(dir.path(), "auto.exr", LONG, &[auto, LOST]).exits(0);
    let run = run.says("(auto: the best GPU that traces rays)");
    let warnings: Vec<&str> = run.stderr.lines().filter(|l| l.starts_with("warning: ")).collect();
    assert_eq!(warnings.len(), 1, "{}", run.stderr);
    assert!(
        warnings[0].contains("lost") && warnings[0].contains("; going on with the CPU ("),
        "{warnings:?}"
    );
    assert_eq!(samples(dir.path(), "auto.exr"), 2000.0);
    draw(dir.path(), "cpu.exr", &format!("{LONG} --device cpu"), &[]).exits(0);
    assert_alike(dir.path(), "cpu.exr", "auto.exr");
}

#[test]
fn a_scene_that_does_not_fit_is_said_with_what_there_is() {
    if !gpu() {
        return;
    }
    let (dir, little) = (folder(), ("LUMBRE_TEST_GPU_MEMORY", "1"));
    let run = draw(dir.path(), "a.exr", "--spp 1 --device gpu", &[little]).exits(69);
    let error = run.stderr.lines().find(|l| l.starts_with("error: ")).unwrap();
    assert!(error.contains("not enough GPU memory") && error.contains("available"), "{error}");
    let auto = ("LUMBRE_TEST_SOFTWARE_GPU", "1");
    let run = draw(dir.path(), "a.exr", "--spp 1", &[little, auto]).exits(0);
    run.says("not enough GPU memory").says("; taking the CPU (").says("device: CPU (");
}

/// The device's own figures: what compaction leaves, and what building took.
#[test]
fn structures_on_the_gpu_are_compacted() {
    if !gpu() {
        return;
    }
    let mut c = with_gpus();
    c.args(["bench", "build", "--triangles", "300", "--device", "gpu", "--json"]);
    let line = Run::from(c.output().unwrap()).exits(0).last_json();
    let (row, number) = (&line["rows"][0], |key: &str| line["rows"][0][key].as_f64().unwrap());
    assert!(row["triangles"] == 338 && number("bytes") <= number("bytes_built"), "{row}");
    assert!(["build_ms", "compact_ms", "top_build_ms", "ready_ms"].iter().all(|k| number(k) > 0.0), "{row}");
    let mut c = with_gpus();
    c.args(["bench", "first-frame", SMOOTH, "--sizes", "16x12", "--device", "gpu", "--json"]);
    let line = Run::from(c.output().unwrap()).exits(0).last_json();
    let number = |key: &str| line["rows"][0][key].as_f64().unwrap();
    assert!(number("pipelines_ms") > 0.0 && number("build_ms") > 0.0 && number("upload_ms") > 0.0, "{line}");
}

#[test]
fn frames_of_the_gpu_have_its_own_times() {
    if !gpu() {
        return;
    }
    let mut c = with_gpus();
    c.args(["bench", "path", SMOOTH, "--device", "gpu", "--json", "--sizes", "16x12", "--depths", "3"]);
    let line = Run::from(c.args(["--frames", "2", "--warm-up", "1"]).output().unwrap()).exits(0).last_json();
    let row = &line["rows"][0];
    assert!(row["gpu_ms"]["trace + shadow"].as_f64().is_some_and(|ms| ms > 0.0), "{row}");
    // The same paths as on the CPU, though not of the same pixels.
    let cpu = lumbre(&format!("bench path {SMOOTH} --json --sizes 16x12 --depths 3 --frames 2")).exits(0);
    let length = |row: &serde_json::Value| row["path_length"].as_f64().unwrap();
    let ratio = length(row) / length(&cpu.last_json()["rows"][0]);
    assert!((0.9..1.1).contains(&ratio), "{ratio}");
}

#[test]
fn a_share_of_the_frame_is_that_of_its_rays() {
    lumbre(&format!("bench share {SMOOTH}"))
        .exits(69)
        .says("share: no GPU whose rays could be replayed (auto: ");
    lumbre(&format!("bench share {SMOOTH} --device cpu")).exits(69).says("share: no GPU");
    if !gpu() {
        return;
    }
    let mut c = with_gpus();
    c.args(["bench", "share", SMOOTH, "--device", "gpu", "--json", "--sizes", "16x12", "--frames", "2"]);
    let line = Run::from(c.args(["--warm-up", "1"]).output().unwrap()).exits(0).last_json();
    let rows = line["rows"].as_array().unwrap();
    let depths: Vec<&serde_json::Value> = rows.iter().map(|r| &r["depth"]).collect();
    assert_eq!(depths, [4, 10]);
    for row in rows {
        let number = |key: &str| row[key].as_f64().unwrap_or_else(|| panic!("no {key} in {row}"));
        assert!((number("replay_ms") / number("frame_ms") / number("share") - 1.0).abs() < 1e-9, "{row}");
        assert!(number("path_rays") >= 16.0 * 12.0 && number("shadow_rays") > 0.0, "{row}");
        let passes = row["gpu_ms"].as_object().unwrap();
        let traces = passes.iter().filter(|(name, _)| name.starts_with("trace"));
        assert!(traces.map(|(_, ms)| ms.as_f64().unwrap()).sum::<f64>() > 0.0, "{row}");
    }
}

/// A hybrid frame of each set, its planes, and pictures along a way.
#[test]
fn hybrid_frames_become_pictures() {
    if !gpu() {
        return;
    }
    let dir = folder();
    let thesis = "--mode hybrid --hybrid thesis --device gpu --validation --planes";
    let planes = dir.path().join("planes");
    std::fs::create_dir(&planes).unwrap();
    let words = format!("{thesis} {}", planes.display());
    let run = draw(dir.path(), "thesis.exr", &words, &[]).exits(0);
    run.says("1 frames in").says("wrote 17 planes").does_not_say("warning: validation:");
    assert_eq!(samples(dir.path(), "thesis.exr"), 1.0);
    for plane in lumbre::Plane::ALL {
        assert!(planes.join(format!("{}.png", plane.name())).is_file(), "{plane:?}");
    }
    draw(dir.path(), "all.exr", "--mode hybrid --device gpu --frames 3", &[]).exits(0).says("3 frames in");
    // They are other pictures.
    let d = dir.path().display();
    lumbre(&format!("compare {d}/thesis.exr {d}/all.exr --fail-above relmse=1e-4")).exits(1);
    let way = dir.path().join("way.txt");
    std::fs::write(&way, "0,1,4 0,0,0\n1,1,4 0,0,0 # aside\n").unwrap();
    let words = format!("--mode hybrid --device gpu --frames 2 --camera-path {}", way.display());
    draw(dir.path(), "walk.exr", &words, &[]).exits(0).says("walk-0002.exr");
    lumbre(&format!("compare {d}/walk-0001.exr {d}/walk-0002.exr --fail-above relmse=1e-4")).exits(1);
}
