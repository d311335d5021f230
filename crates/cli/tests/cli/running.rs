//! Flags and surroundings that must not change the picture, progress, and memory.

use crate::common::*;
use lumbre::cpu::bvh::SimdLevel;

#[test]
fn the_same_bits_with_any_number_of_threads_and_in_two_runs() {
    let dir = folder();
    let of = |more: &str| bytes(dir.path(), &format!("{CORNELL} --size 36x27 --spp 4 {more}"));
    let one = of("--threads 1");
    assert_eq!(of("--threads 1"), one, "two runs");
    assert_eq!(of("--threads 2"), one);
    assert_eq!(of("--threads 5"), one);
    assert_eq!(of("--device cpu --progress off"), one);
}

#[test]
fn the_same_bits_at_every_simd_level() {
    let dir = folder();
    let of = |level: &str| {
        let path = dir.path().join(format!("{level}.exr"));
        let mut c = command();
        c.env("LUMBRE_SIMD", level)
            .args(["render", CORNELL, "--size", "36x27", "--spp", "4", "-o"])
            .arg(&path);
        Run::from(c.output().unwrap()).exits(0).says(level);
        std::fs::read(path).unwrap()
    };
    let portable = of("portable");
    for level in [SimdLevel::Avx2, SimdLevel::Avx512] {
        if level.is_supported() {
            assert!(of(level.name()) == portable, "{} draws another picture", level.name());
        } else {
            println!("skipped: this processor has no {}", level.name());
        }
    }
    let with = |level: &str, words: &[&str]| {
        let mut c = command();
        c.env("LUMBRE_SIMD", level).arg("render").args(words);
        Run::from(c.output().unwrap())
    };
    with("portable", &[CORNELL, "--pixel", "1,1"]).exits(0).says("device: CPU (portable,");
    // Before the scene is looked for.
    with("mmx", &["none.glb", "-o", "a.png"]).exits(2).says("LUMBRE_SIMD");
    with("mmx", &["none.glb", "--pixel", "1,1"]).exits(2).says("LUMBRE_SIMD");
}

#[test]
fn threads_and_device_are_said() {
    let dir = folder();
    let said = |more: &str| exr(dir.path(), &format!("{SMOOTH} --size 4x4 --spp 1 {more}")).0;
    said("--threads 1 --device cpu").says("1 thread)").says("as --device asks");
    said("--threads 3 --device auto").says("3 threads)").says("(auto: ");
    lumbre(&format!("render {SMOOTH} -o a.png --threads 0")).exits(2);
}

#[test]
fn json_progress_ends_with_the_times() {
    let dir = folder();
    let words = format!("{SMOOTH} --size 8x6 --spp 3 --progress json");
    let (run, _) = exr(dir.path(), &words);
    let lines: Vec<serde_json::Value> =
        run.stdout.lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    assert_eq!(lines[0]["event"], "start");
    assert!(lines[1..lines.len() - 1].iter().all(|l| l["event"] == "progress") && lines.len() > 2);
    let last = lines.last().unwrap();
    for (key, value) in [("width", 8), ("height", 6), ("spp", 3), ("samples", 8 * 6 * 3)] {
        assert_eq!(last[key], value, "{key}");
    }
    for key in ["render_seconds", "load_seconds", "build_seconds", "write_seconds"] {
        assert!(last[key].as_f64().is_some_and(|s| (0.0..60.0).contains(&s)), "{key}");
    }
    assert!(last["rays"].as_u64().is_some_and(|r| r >= 8 * 6 * 3));
    assert_eq!((&last["event"], &last["interrupted"]), (&"done".into(), &false.into()));
}

#[test]
fn progress_is_words_or_nothing() {
    let dir = folder();
    let said = |more: &str| exr(dir.path(), &format!("{SMOOTH} --size 4x4 --spp 1 {more}")).0;
    for plain in ["", "--progress auto", "--progress plain"] {
        assert_eq!(said(plain).says("render: ").does_not_say("\u{1b}").stdout, "");
    }
    said("--progress off").does_not_say("render: ").says("device: ");
    let help = lumbre("render --help").exits(0).stdout;
    let help: Vec<&str> = help.split_whitespace().collect();
    assert!(help.join(" ").contains("No progress (notes and warnings still appear)"));
}

#[test]
fn memory_is_predicted_before_anything_is_opened() {
    let big = "--size 32768x32768 -o a.exr";
    lumbre(&format!("render none.glb {big} --memory-limit 100G"))
        .exits(71)
        .says("--memory-limit is 100.0 GiB");
    let dir = folder();
    let words =
        format!("render {SMOOTH} --size 64x64 --spp 1 -o {}/a.png --memory-limit", dir.path().display());
    lumbre(&format!("{words} 100K")).exits(71).says("64x64");
    lumbre(&format!("{words} 100M")).exits(0);
    // The size that the camera chooses is checked too.
    lumbre(&format!("render {SMOOTH} -o a.png --memory-limit 1M")).exits(71).says("720x720");
    lumbre("render none.glb -o a.png --memory-limit lots").exits(2).says("800M");
}

/// Through `script`, which gives the program a terminal and is part of every Debian.
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_gets_a_bar_that_goes_away() {
    let dir = folder();
    let program = env!("CARGO_BIN_EXE_lumbre");
    let words = format!("render {CORNELL} --size 32x24 --spp 16 -o {}/a.png", dir.path().display());
    let mut c = std::process::Command::new("script");
    c.args(["-qec", &format!("'{program}' {words}"), "/dev/null"]).env("TERM", "xterm");
    let Ok(output) = c.output() else {
        println!("skipped: no `script` on this machine");
        return;
    };
    let run = Run::from(output).exits(0);
    let last = run.stdout.rfind("Mrays/s, ").expect("figures beside the bar");
    assert!(run.stdout[..last].contains(" %  ") && run.stdout[last..].contains(" left"), "{}", run.stdout);
    let (bar, summary) = run.stdout[last..].split_once("render: ").expect("a summary after it");
    assert!(bar.contains("\u{1b}[2K") && !summary.contains('\u{1b}'), "the bar is wiped: {:?}", run.stdout);
}
