//! When a render ends, where its picture goes when nobody said so, and what is saved on the way.

use crate::common::*;
use lumbre::io::{Limits, read_exr, read_linear_image};
use std::time::{Duration, Instant};

/// The least and the most samples of a pixel of an EXR.
fn samples(path: &std::path::Path) -> [f32; 2] {
    let image = read_exr(path, &Limits::default()).unwrap();
    let layer = image.layers.iter().find(|l| l.name == "samples").unwrap().channel("Y").unwrap();
    [layer.iter().copied().fold(f32::MAX, f32::min), layer.iter().copied().fold(0.0, f32::max)]
}

#[test]
fn nothing_but_a_scene_is_enough() {
    let dir = folder();
    let scene = dir.path().join("room.glb");
    std::fs::copy(CORNELL, &scene).unwrap();
    // (A small picture, or the test would take a minute.)
    let words = format!("render {} --size 16x12", scene.display());
    lumbre(&words).exits(0).says("target: error 0.005").says("good enough: ").says("room.png");
    let picture = read_linear_image(dir.path().join("room.png"), None, &Limits::default()).unwrap();
    assert_eq!((picture.width, picture.height), (16, 12));
    // What is there already may be a texture.
    std::fs::write(dir.path().join("room.png"), "texture").unwrap();
    lumbre(&format!("{words} --spp 1")).exits(0).says("room-2.png").does_not_say("target: ");
    assert_eq!(std::fs::read(dir.path().join("room.png")).unwrap(), b"texture");
    assert_eq!(std::fs::read(&scene).unwrap(), std::fs::read(CORNELL).unwrap());
}

#[test]
fn an_error_ends_it_at_the_same_sample_every_time() {
    let dir = folder();
    let of = |more: &str| {
        let run = exr(dir.path(), &format!("{CORNELL} --size 32x24 {more} --progress json")).0;
        let line = run.last_json();
        assert_eq!(samples(&dir.path().join("test.exr")), [line["spp"].as_f64().unwrap() as f32; 2]);
        line
    };
    let coarse = of("--target-error 0.1");
    assert_eq!(coarse["ended_by"], "error");
    assert!(coarse["error"].as_f64().is_some_and(|e| e > 0.0 && e <= 0.1), "{coarse}");
    assert_eq!(coarse["spp"], of("--target-error 0.1 --threads 1")["spp"]);
    let fine = of("--target-error 0.02");
    assert!(fine["spp"].as_u64() > coarse["spp"].as_u64());
    let capped = of("--target-error 0.0001 --spp 20");
    assert_eq!((&capped["ended_by"], &capped["spp"]), (&"spp".into(), &20.into()));
    // What `compare` finds against a better picture is what was promised.
    let reference = dir.path().join("reference.exr");
    let words = format!("render {CORNELL} --size 32x24 --seed 5 --spp 2048 -o {}", reference.display());
    lumbre(&words).exits(0);
    of("--target-error 0.02");
    let (r, t) = (reference.display(), dir.path().join("test.exr"));
    let measured = lumbre(&format!("compare {r} {} --json", t.display())).exits(0).last_json();
    let measured = measured["relmse"].as_f64().unwrap();
    let promised = fine["error"].as_f64().unwrap();
    assert!((0.5..2.0).contains(&(measured / promised)), "{measured} for {promised}");
}

#[test]
fn time_ends_it_with_an_even_picture() {
    let dir = folder();
    let began = Instant::now();
    let (run, image) = exr(dir.path(), &format!("{CORNELL} --size 64x48 --time 1.5s --progress json"));
    let line = run.last_json();
    assert_eq!(line["ended_by"], "time");
    let spp = line["spp"].as_f64().unwrap() as f32;
    assert_eq!(samples(&dir.path().join("test.exr")), [spp; 2]);
    assert!(image.metadata.iter().any(|(n, v)| n == "lumbre.spp" && *v == spp.to_string()));
    // (Hours off would be a fault; seconds may be the machine's.)
    assert!(began.elapsed() < Duration::from_secs(60) && spp >= 1.0);
    let first: serde_json::Value = serde_json::from_str(run.stdout.lines().next().unwrap()).unwrap();
    assert!(first["target_seconds"].as_f64().is_some_and(|s| s > 0.0 && s <= 1.5), "load counts: {first}");
    // Even where there is none at all.
    let (run, _) = exr(dir.path(), &format!("{CORNELL} --size 16x12 --time 1ms"));
    run.says("time is up: 1 samples per pixel");
}

#[test]
fn targets_are_refused_that_are_none() {
    for (flag, value) in [("--time", "30"), ("--time", "0s"), ("--target-error", "0"), ("--save-every", "x")]
    {
        let mut c = command();
        c.args(["render", SMOOTH, "-o", "a.png", flag, value]);
        Run::from(c.output().unwrap()).exits(2).says(flag);
    }
}

#[test]
fn what_there_is_so_far_is_saved_on_the_way() {
    let dir = folder();
    let path = dir.path().join("a.exr");
    let mut c = command();
    c.args(["render", CORNELL, "--size", "16x12", "--spp", "10000000", "--save-every", "50ms", "-o"]);
    let mut child = c.arg(&path).stderr(std::process::Stdio::null()).spawn().unwrap();
    let patience = Instant::now();
    while !path.exists() {
        assert!(child.try_wait().unwrap().is_none() && patience.elapsed() < Duration::from_secs(60));
        std::thread::sleep(Duration::from_millis(5));
    }
    // Without a chance to finish.
    child.kill().unwrap();
    child.wait().unwrap();
    let image = read_exr(&path, &Limits::default()).unwrap();
    assert!(image.metadata.iter().any(|(n, _)| n == "lumbre.interrupted"));
    let [least, most] = samples(&path);
    assert!(least >= 1.0 && least == most, "even: {least} to {most}");
}

#[test]
fn saving_changes_nothing_at_the_end() {
    let dir = folder();
    let words = format!("{CORNELL} --size 32x24 --spp 24");
    assert_eq!(bytes(dir.path(), &words), bytes(dir.path(), &format!("{words} --save-every 1ms")));
}

#[test]
fn stats_are_a_table_or_part_of_the_json() {
    let dir = folder();
    let words = format!("{CORNELL} --size 16x12 --spp 2 --stats");
    let (run, _) = exr(dir.path(), &words);
    for row in ["load", "build", "write", "of the acceleration structure", "Mrays/s", "estimated error"] {
        assert!(run.stderr.lines().any(|l| l.starts_with(&format!("  {row} "))), "{row}: {}", run.stderr);
    }
    let (run, _) = exr(dir.path(), &format!("{words} --progress json"));
    let stats = &run.does_not_say("estimated error  ").last_json()["stats"];
    for key in ["scene", "acceleration", "film"] {
        assert!(stats["memory"][key].as_u64().is_some_and(|b| b > 1000), "{key}: {stats}");
    }
    assert!(stats["speed"]["rays_per_sample"].as_f64().is_some_and(|r| r > 1.0));
    if cfg!(target_os = "linux") {
        assert!(stats["memory"]["peak"].as_u64().is_some_and(|b| b > 1 << 20));
    }
}
