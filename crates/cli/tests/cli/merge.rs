//! `--first-sample`, `--keep-sums` and `lumbre merge`: parts add up to the bytes of one run, or are refused.

use crate::common::*;
use std::fs;
use std::path::Path;

const PICTURE: &str = "--size 20x15 --max-depth 4";

/// Renders a part of the Cornell box.
fn part(dir: &Path, name: &str, words: &str) -> String {
    let path = dir.join(name).display().to_string();
    lumbre(&format!("render {CORNELL} {PICTURE} {words} -o {path}")).exits(0);
    path
}

#[test]
fn eight_parts_in_any_order_are_the_bytes_of_one_run() {
    let dir = folder();
    let d = dir.path().display();
    let whole = part(dir.path(), "whole.exr", "--spp 11");
    let sums = part(dir.path(), "sums.exr", "--spp 11 --keep-sums");
    assert_eq!(
        fs::read(part(dir.path(), "zero.exr", "--spp 11 --first-sample 0")).unwrap(),
        fs::read(&sums).unwrap()
    );
    let ends = [0, 1, 2, 4, 5, 6, 8, 9, 11];
    let threads = ["", "--threads 1", "", "", "--threads 3", "", "", ""];
    let parts: Vec<String> = (0..8)
        .map(|i| {
            let (first, spp) = (ends[i], ends[i + 1] - ends[i]);
            let words = format!("--first-sample {first} --spp {spp} {}", threads[i]);
            part(dir.path(), &format!("{i}.exr"), &words)
        })
        .collect();
    // The last one once more, at the lowest SIMD level.
    let mut c = command();
    c.env("LUMBRE_SIMD", "portable").args(["render", CORNELL]).args(PICTURE.split(' '));
    c.args(["--first-sample", "9", "--spp", "2", "-o", &parts[7]]);
    Run::from(c.output().unwrap()).exits(0).says("portable");
    let order = [5, 0, 7, 3, 6, 1, 4, 2].map(|i| parts[i].as_str()).join(" ");
    lumbre(&format!("merge {d}/merged.exr {order}")).exits(0).says("merged 8 parts: samples 0 to 10");
    let read = |name: &str| fs::read(dir.path().join(name)).unwrap();
    assert!(read("merged.exr") == fs::read(&whole).unwrap(), "the plain picture");
    lumbre(&format!("merge {d}/again.exr {order} --keep-sums")).exits(0);
    assert!(read("again.exr") == fs::read(&sums).unwrap(), "the picture with its sums");
    // Sums of sums.
    lumbre(&format!("merge {d}/low.exr {} {} {} --keep-sums", parts[2], parts[0], parts[1])).exits(0);
    lumbre(&format!("merge {d}/all.exr {} {d}/low.exr", parts[3..].join(" "))).exits(0);
    assert!(read("all.exr") == fs::read(&whole).unwrap(), "by way of a sum");
    // A plain picture is smaller, and other samples make other bytes: the comparisons can fail.
    assert!(read("merged.exr").len() * 2 < read("again.exr").len());
    lumbre(&format!("merge {d}/less.exr {}", parts[..7].join(" "))).exits(0).says("samples 0 to 8");
    assert!(read("less.exr") != read("merged.exr"));
}

#[test]
fn the_output_may_have_any_format_and_look() {
    let dir = folder();
    let d = dir.path().display();
    let look = "--exposure 1 --tone agx --vignette 0.3 --aberration 1";
    let transparent = "--background transparent";
    let a = part(dir.path(), "a.exr", &format!("--spp 2 --first-sample 0 {transparent}"));
    let b = part(dir.path(), "b.exr", &format!("--spp 3 --first-sample 2 {transparent}"));
    for extension in ["png", "jpg", "hdr", "exr"] {
        let whole = part(dir.path(), &format!("whole.{extension}"), &format!("--spp 5 {transparent} {look}"));
        lumbre(&format!("merge {d}/merged.{extension} {b} {a} {look}")).exits(0).says("merged.");
        let merged = fs::read(dir.path().join(format!("merged.{extension}"))).unwrap();
        assert!(merged == fs::read(whole).unwrap(), "{extension}");
    }
    let output = command().args(["merge", "-", &a, &b]).output().unwrap();
    assert!(output.status.success() && output.stdout.starts_with(b"\x89PNG"));
}

#[test]
fn a_crop_of_a_picture_has_parts_too() {
    let dir = folder();
    let d = dir.path().display();
    let crop = "--crop 3,4,10,6";
    let a = part(dir.path(), "a.exr", &format!("--spp 2 --first-sample 0 {crop}"));
    let b = part(dir.path(), "b.exr", &format!("--spp 2 --first-sample 2 {crop}"));
    let whole = part(dir.path(), "whole.exr", &format!("--spp 4 {crop}"));
    lumbre(&format!("merge {d}/m.exr {a} {b}")).exits(0);
    assert!(fs::read(dir.path().join("m.exr")).unwrap() == fs::read(whole).unwrap());
    let other = part(dir.path(), "c.exr", "--spp 2 --first-sample 4 --crop 3,4,10,7");
    lumbre(&format!("merge {d}/m.exr {a} {b} {other}")).exits(65).says("lumbre.crop is \"3,4,10,6\" there");
}

#[test]
fn parts_that_do_not_fit_are_refused_by_name() {
    let dir = folder();
    let d = dir.path().display();
    let a = part(dir.path(), "a.exr", "--spp 2 --first-sample 0");
    let b = part(dir.path(), "b.exr", "--spp 2 --first-sample 1");
    let c = part(dir.path(), "c.exr", "--spp 2 --first-sample 6");
    let refused = |words: &str, code: i32, text: &str| {
        fs::write(dir.path().join("out.exr"), "old").unwrap();
        let run = lumbre(&format!("merge {d}/out.exr {words}")).exits(code).says(text);
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
        assert_eq!(fs::read(dir.path().join("out.exr")).unwrap(), b"old");
    };
    refused(
        &format!("{a} {b}"),
        65,
        &format!("error: {a} (samples 0 to 1) and {b} (samples 1 to 2) have samples in common\n"),
    );
    refused(
        &format!("{c} {a}"),
        65,
        &format!("error: samples 2 to 5 are missing between {a} (samples 0 to 1) and {c} (samples 6 to 7)\n"),
    );
    for (i, other) in
        ["--seed 9", "--fov 30", "--sky 1,1,1", "--filter box", "--clamp 3"].into_iter().enumerate()
    {
        let foreign =
            part(dir.path(), &format!("foreign-{i}.exr"), &format!("--spp 2 --first-sample 2 {other}"));
        refused(
            &format!("{a} {foreign}"),
            65,
            &format!("error: {foreign}: is not of the same render as {a}: lumbre."),
        );
    }
    let plain = part(dir.path(), "plain.exr", "--spp 2");
    refused(
        &plain,
        65,
        &format!(
            "{plain}: carries no exact sums; `lumbre render` writes them with --first-sample or --keep-sums\n"
        ),
    );
    refused(&format!("{a} {d}/none.exr"), 66, "none.exr: cannot open: no such file");
    fs::write(dir.path().join("text.exr"), "text").unwrap();
    refused(&format!("{d}/text.exr"), 65, "text.exr: not a sound EXR");
    refused(&format!("{a} --max-image-bytes 1K"), 65, "--max-image-bytes widens it");
    refused(&format!("{a} {d}/out.exr"), 2, "out.exr: is read and cannot be the output too");
    lumbre(&format!("merge {d}/out.exr")).exits(2).says("<PARTS>");
    let large = dir.path().join("large.exr").display().to_string();
    lumbre(&format!("render {CORNELL} --size 21x15 --max-depth 4 --spp 2 --first-sample 2 -o {large}"))
        .exits(0);
    refused(&format!("{a} {large}"), 65, "the size is \"20x15\" there and \"21x15\" here");
}

#[test]
fn sums_need_an_exr() {
    lumbre(&format!("render {CORNELL} --keep-sums -o a.png"))
        .exits(2)
        .says("--keep-sums: exact sums go into an .exr, and no output is one");
    for output in ["", "-o a.png"] {
        lumbre(&format!("render {CORNELL} --first-sample 7 {output}"))
            .exits(2)
            .says("merged from .exr files");
    }
    lumbre(&format!("render {CORNELL} --save-every 1s -o -")).exits(2).says("finished picture only");
    let dir = folder();
    part(dir.path(), "a.exr", "--spp 1 --first-sample 7");
    lumbre(&format!("merge {0}/b.png {0}/a.exr --keep-sums", dir.path().display()))
        .exits(2)
        .says("the output is none");
}

/// Other samples, other noise; the same ones, the same.
#[test]
fn the_first_sample_chooses_the_samples() {
    let dir = folder();
    let plain = picture(dir.path(), &format!("{CORNELL} {PICTURE} --spp 2"));
    let picture = |first: u32, spp: u32| {
        picture(dir.path(), &format!("{CORNELL} {PICTURE} --first-sample {first} --spp {spp}"))
    };
    assert_eq!(picture(0, 2), plain);
    assert_ne!(picture(2, 2), picture(0, 2));
    for wrong in ["-1", "4294967295", "x"] {
        lumbre(&format!("render {CORNELL} --first-sample {wrong} -o a.exr")).exits(2);
    }
}

/// What `--save-every` leaves of a run that was killed is a part like any other, and the rest can be rendered later.
#[cfg(unix)]
#[test]
fn a_killed_run_can_be_completed() {
    let dir = folder();
    let saved = dir.path().join("saved.exr");
    let mut c = command();
    c.args(["render", CORNELL]).args(PICTURE.split(' ')).args(["--spp", "1000000", "--save-every", "1ms"]);
    c.args(["--keep-sums", "-o"]).arg(&saved).stderr(std::process::Stdio::null());
    let mut child = c.spawn().unwrap();
    while !saved.exists() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let part_so_far = lumbre::merge::read_part(&saved, &lumbre::io::Limits::default()).unwrap();
    let done = part_so_far.samples.end;
    assert!(
        part_so_far.samples.start == 0 && part_so_far.metadata.iter().any(|(n, _)| n == "lumbre.interrupted")
    );
    let rest = part(dir.path(), "rest.exr", &format!("--spp 3 --first-sample {done}"));
    let whole = part(dir.path(), "whole.exr", &format!("--spp {}", done + 3));
    let merged = dir.path().join("merged.exr");
    lumbre(&format!("merge {} {rest} {}", merged.display(), saved.display())).exits(0);
    assert!(fs::read(merged).unwrap() == fs::read(whole).unwrap());
}
