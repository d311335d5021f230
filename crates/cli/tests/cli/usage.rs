//! Help, version, and what is refused with which code.

use crate::common::*;

#[test]
fn help_and_version() {
    let all = lumbre("--help").exits(0).stdout;
    assert!(all.contains("render") && all.contains("compare") && all.contains("Examples:"));
    lumbre("").exits(2).says("Usage: lumbre <COMMAND>");
    assert_eq!(lumbre("--version").exits(0).stdout, concat!("lumbre ", env!("CARGO_PKG_VERSION"), "\n"));
    let render = lumbre("render --help").exits(0).stdout;
    for heading in
        ["Picture:", "Sampling:", "Camera:", "Light:", "Running:", "One path:", "Examples:", "Exit codes:"]
    {
        assert!(render.contains(&format!("\n{heading}")), "{heading}");
    }
    let compare = lumbre("compare --help").exits(0).stdout;
    assert!(compare.contains("Examples:") && compare.contains("<REFERENCE> <TEST>"));
}

#[test]
fn wrong_usage_is_2() {
    lumbre("draw").exits(2).says("draw");
    lumbre("render").exits(2).says("SCENE");
    for (flag, value) in [
        ("--size", "0x5"),
        ("--size", "5"),
        ("--spp", "0"),
        ("--spp", "x"),
        ("--max-depth", "-1"),
        ("--roulette", "never"),
        ("--sampler", "halton"),
        ("--seed", "-1"),
        ("--filter", "mitchell"),
        ("--light-sampling", "maybe"),
        ("--transmissive-shadows", "no"),
        ("--back-faces", "hide"),
        ("--hemisphere", "north"),
        ("--rough-bounces", "-1"),
        ("--mode", "raster"),
        ("--hybrid", "some"),
        ("--render-scale", "0.2"),
        ("--ambient", "-1,0,0"),
        ("--frames", "3"),
        ("--planes", "somewhere"),
        ("--exposure", "bright"),
        ("--progress", "loud"),
        ("--pixel", "1"),
        ("--camera", ""),
    ] {
        let mut c = command();
        c.args(["render", SMOOTH, "-o", "a.png", flag, value]);
        Run::from(c.output().unwrap()).exits(2).says(flag);
    }
}

#[test]
fn scenes_that_do_not_open_have_their_codes() {
    let dir = folder();
    let d = dir.path().display();
    lumbre(&format!("render {d}/none.glb -o {d}/a.png"))
        .exits(66)
        .says("none.glb: cannot open: no such file");
    for (name, content) in [("a.glb", "glTF but no more"), ("b.gltf", "{"), ("c.blend", "BLENDER")] {
        std::fs::write(dir.path().join(name), content).unwrap();
        lumbre(&format!("render {d}/{name} -o {d}/a.png")).exits(65).says(name);
    }
    let scene = scene(dir.path(), &[(square(0.0, 1.0), GREY)]);
    std::fs::remove_file(dir.path().join("scene.bin")).unwrap();
    lumbre(&format!("render {scene} -o {d}/a.png")).exits(66).says("scene.bin");
    assert!(!dir.path().join("a.png").exists());
}

#[test]
fn what_a_loader_doubts_is_one_line_each() {
    let dir = folder();
    let odd = r#"{"pbrMetallicRoughness":{"roughnessFactor":7}}"#;
    let scene = scene(dir.path(), &[(square(0.0, 1.0), odd)]);
    let (run, _) = exr(dir.path(), &format!("{scene} --size 4x4 --spp 1"));
    assert_eq!(run.stderr.lines().filter(|l| l.starts_with("warning: ")).count(), 1, "{}", run.stderr);
    run.says("/materials/0");
}

#[cfg(target_os = "linux")]
#[test]
fn results_that_cannot_be_delivered_are_74() {
    let dir = folder();
    let out = dir.path().join("a.exr");
    exr(dir.path(), &format!("{SMOOTH} --size 4x4 --spp 1"));
    std::fs::rename(dir.path().join("test.exr"), &out).unwrap();
    let full = || std::fs::File::create("/dev/full").unwrap();
    let mut c = command();
    c.arg("compare").arg(&out).arg(&out).stdout(full());
    Run::from(c.output().unwrap()).exits(74).says("standard output");
    let mut c = command();
    c.args(["render", SMOOTH, "--size", "4x4", "--pixel", "1,1"]).stdout(full());
    Run::from(c.output().unwrap()).exits(74).says("standard output");
    // Messages are not the result.
    let mut c = command();
    c.args(["render", SMOOTH, "--size", "4x4", "--spp", "1", "-o"]).arg(&out).stderr(full());
    Run::from(c.output().unwrap()).exits(0);
}
