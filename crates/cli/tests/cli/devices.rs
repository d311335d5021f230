//! `lumbre devices`, `--device`, and what is said where there is no GPU.

use crate::common::*;

#[test]
fn the_cpu_is_listed_and_taken_where_there_is_no_gpu() {
    let run = lumbre("devices").exits(0);
    let said: Vec<&str> = run.stdout.lines().collect();
    assert!(said[0].starts_with("* cpu  CPU ("), "{}", run.stdout);
    assert!(said[1].contains("of memory free") || said[1].contains("memory not known"));
    assert!(run.line("no GPU: ").len() > 10);
    let last = said.last().unwrap();
    assert!(last.starts_with("* auto: "), "{last}");
}

#[test]
fn devices_for_programs() {
    let line = lumbre("devices --json").exits(0).last_json();
    let list = line["devices"].as_array().unwrap();
    assert_eq!((list.len(), &list[0]["device"], &list[0]["kind"]), (1, &"cpu".into(), &"processors".into()));
    assert_eq!(list[0]["lacks"].as_array().unwrap().len(), 0);
    assert!(line["no_gpu"].is_string() && line["auto"]["device"] == "cpu");
    assert!(line["auto"]["why"].as_str().unwrap().starts_with("auto: "));
}

/// Before the scene is looked for, in one line, with the reason.
#[test]
fn a_gpu_that_cannot_be_had_is_69() {
    let reason = lumbre("devices --json").exits(0).last_json()["no_gpu"].as_str().unwrap().to_owned();
    for device in ["gpu", "gpu:0", "gpu:7", "GeForce"] {
        let run = lumbre(&format!("render none.glb -o a.png --device {device}")).exits(69);
        assert_eq!(run.stderr, format!("error: no GPU for `{device}`: {reason}\n"));
    }
    lumbre("render none.glb -o a.png --device gpu:x").exits(2).says("\"x\" is not the number of a GPU");
    lumbre("render none.glb -o a.png --device=").exits(2).says("--device");
}

#[test]
fn one_line_says_what_is_taken_and_why() {
    let dir = folder();
    let reason = lumbre("devices --json").exits(0).last_json()["auto"]["why"].as_str().unwrap().to_owned();
    let said = |more: &str| exr(dir.path(), &format!("{SMOOTH} --size 4x4 --spp 1 {more}")).0;
    for (flags, why) in [("", &*reason), ("--device auto", &*reason), ("--device cpu", "as --device asks")] {
        let run = said(flags);
        let line = run.stderr.lines().find(|l| l.starts_with("device: ")).unwrap();
        assert!(line.starts_with("device: CPU (") && line.ends_with(&format!(" ({why})")), "{line}");
    }
    // Whatever the device, one path is told by the CPU.
    lumbre(&format!("render {SMOOTH} --size 4x4 --pixel 1,1 --device gpu"))
        .exits(0)
        .says("--pixel always runs there");
    said("--validation").says("there is nothing to validate without a GPU");
}
