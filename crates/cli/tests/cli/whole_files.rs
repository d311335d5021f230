//! A file is the old one or a whole new one: killed runs, full disks, folders that take nothing.
#![cfg(unix)]

use crate::common::*;
use lumbre::io::{Limits, read_exr, read_linear_image};
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// SplitMix64 (Steele et al. 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % n
    }
}

fn names(dir: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(dir).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Starts a render, waits until `ready`, then so much longer, and kills it.
fn kill_after(dir: &Path, words: &str, ready: impl Fn() -> bool, wait: Duration) {
    let mut c = command();
    c.args(["render", CORNELL]).args(words.split_whitespace());
    c.arg("-o").arg(dir.join("a.exr")).arg("-o").arg(dir.join("a.png"));
    let mut child = c.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    while !ready() {
        std::thread::sleep(Duration::from_millis(1));
    }
    std::thread::sleep(wait);
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Half of the hundred are killed while they save again and again, half around the end of a short render.
#[test]
fn a_hundred_killed_runs_leave_old_or_whole_files() {
    let dir = folder();
    let short = "--size 64x48 --spp 1 --max-depth 1 --threads 1";
    let long = "--size 64x48 --spp 1000000 --max-depth 1 --threads 1 --save-every 1ms";
    let targets = ["a.exr", "a.png"];
    let began = Instant::now();
    let d = dir.path().display();
    lumbre(&format!("render {CORNELL} {short} -o {d}/a.exr -o {d}/a.png")).exits(0);
    // What a short run takes. It follows how busy the machine is, so that some of them come to their end.
    let mut whole = began.elapsed();
    let done = targets.map(|t| fs::read(dir.path().join(t)).unwrap());
    let mut random = Random(4);
    let (mut old, mut new, mut litter) = (0, 0, 0);
    for i in 0..100 {
        for target in targets {
            fs::write(dir.path().join(target), "old").unwrap();
        }
        let share = random.below(1000) as f64 / 1000.0;
        let first = dir.path().join("a.exr");
        if i % 2 == 0 {
            kill_after(dir.path(), short, || true, whole.mul_f64(share));
            whole = whole.mul_f64(if fs::read(first).unwrap() == b"old" { 1.08 } else { 0.9 });
        } else {
            let saved = || fs::read(&first).unwrap() != b"old";
            kill_after(dir.path(), long, saved, Duration::from_millis(15).mul_f64(share));
        }
        for (target, done) in targets.iter().zip(&done) {
            let path = dir.path().join(target);
            let bytes = fs::read(&path).unwrap();
            if bytes == b"old" {
                old += 1;
                continue;
            }
            new += 1;
            if i % 2 == 0 {
                assert!(bytes == *done, "{target} is neither the old nor the new one");
            } else if *target == "a.png" {
                assert_eq!(read_linear_image(&path, None, &Limits::default()).unwrap().width, 64);
            } else {
                let image = read_exr(&path, &Limits::default()).unwrap();
                let samples =
                    image.layers.iter().find(|l| l.name == "samples").unwrap().channel("Y").unwrap();
                assert!(samples[0] > 0.0 && samples.iter().all(|s| *s == samples[0]), "an even picture");
            }
        }
        // What else lies there is hidden and named as nobody's picture.
        for name in names(dir.path()).iter().filter(|n| !targets.contains(&n.as_str())) {
            assert!(name.starts_with(".a.") && name.ends_with(".tmp"), "{name}");
            litter += 1;
        }
    }
    println!("{old} old, {new} new, {litter} times a temporary file lay there");
    assert!(old > 20 && new > 60, "{old} old, {new} new: not killed at all moments");
    // The next run that ends well leaves nothing behind.
    lumbre(&format!("render {CORNELL} {short} -o {d}/a.exr -o {d}/a.png")).exits(0);
    assert_eq!(names(dir.path()), targets);
}

/// That the test above can fail: a file that is written in place and cut off is noticed.
#[test]
fn half_a_file_is_noticed() {
    let dir = folder();
    let path = dir.path().join("a.exr");
    lumbre(&format!("render {CORNELL} --size 64x48 --spp 1 -o {}", path.display())).exits(0);
    let bytes = fs::read(&path).unwrap();
    fs::write(&path, &bytes[..bytes.len() - 1]).unwrap();
    assert!(read_exr(&path, &Limits::default()).is_err());
}

/// A shell that bounds the size of files and ignores the signal that says so; what it starts does too.
#[test]
fn a_disk_that_is_full_keeps_the_old_file() {
    let dir = folder();
    for name in ["a.exr", "a.png", "a.jpg", "a.hdr"] {
        let path = dir.path().join(name);
        fs::write(&path, "old").unwrap();
        let mut c = std::process::Command::new("sh");
        // In blocks of 512 or 1024 bytes.
        c.args(["-c", "trap '' XFSZ; ulimit -f 2; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_lumbre")]);
        c.args(["render", CORNELL, "--size", "160x120", "--spp", "1", "-o"]).arg(&path);
        let run = Run::from(c.output().unwrap()).exits(74);
        run.says(&format!("error: {}: cannot write: File too large", path.display()));
        assert_eq!(fs::read(&path).unwrap(), b"old");
    }
    assert_eq!(names(dir.path()), ["a.exr", "a.hdr", "a.jpg", "a.png"]);
}

/// On a file system of 64 KiB, where the machine lets us mount one.
#[cfg(target_os = "linux")]
#[test]
fn a_file_system_that_is_full_keeps_the_old_file() {
    let dir = folder();
    let script = "mount -t tmpfs -o size=64k none \"$1\" && echo old >\"$1/a.exr\" || exit 99
        shift; \"$@\"; code=$?; cat \"$OLD\"; ls -A \"$(dirname \"$OLD\")\"; exit $code";
    let path = dir.path().join("a.exr");
    let mut c = std::process::Command::new("unshare");
    c.args(["--user", "--map-root-user", "--mount", "sh", "-c", script, "sh"]).arg(dir.path());
    c.arg(env!("CARGO_BIN_EXE_lumbre")).args(["render", CORNELL, "--size", "160x120", "--spp", "1", "-o"]);
    c.arg(&path).env("OLD", &path);
    let Ok(output) = c.output() else {
        println!("skipped: no `unshare` on this machine");
        return;
    };
    if matches!(output.status.code(), Some(1 | 99)) {
        println!("skipped: no file system can be mounted: {}", String::from_utf8_lossy(&output.stderr));
        return;
    }
    let run = Run::from(output).exits(74).says("a.exr: cannot write: No space left on device");
    assert_eq!(run.stdout, "old\na.exr\n");
}

#[test]
fn what_cannot_be_written_is_said_before_the_work() {
    use std::os::unix::fs::PermissionsExt;
    let dir = folder();
    let d = dir.path().display();
    // The scene is not even looked for.
    let words = "render none.glb";
    lumbre(&format!("{words} -o {d}/none/a.png")).exits(74).says(&format!("there is no folder {d}/none\n"));
    fs::write(dir.path().join("file"), "").unwrap();
    lumbre(&format!("{words} -o {d}/file/a.jpg")).exits(74).says(&format!("{d}/file is no folder\n"));
    fs::create_dir(dir.path().join("b.hdr")).unwrap();
    lumbre(&format!("{words} -o {d}/b.hdr")).exits(74).says("b.hdr: cannot write: it is a folder\n");
    lumbre(&format!("{words} -o {d}/a.tiff"))
        .exits(2)
        .says("a.tiff: an output is a .png, .jpg, .hdr or .exr");
    if cfg!(target_os = "linux") {
        // Nobody may make files there, not even the administrator.
        lumbre(&format!("{words} -o /proc/a.png")).exits(74).says("the folder /proc takes no new file");
    }
    if Path::new("/dev/full").exists() {
        let link = dir.path().join("full.png");
        std::os::unix::fs::symlink("/dev/full", &link).unwrap();
        lumbre(&format!("{words} -o {}", link.display())).exits(74).says("it is not a regular file");
    }
    let closed = dir.path().join("closed");
    fs::create_dir(&closed).unwrap();
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o555)).unwrap();
    if fs::write(closed.join("try"), "").is_ok() {
        println!("skipped: this user may write into any folder");
    } else {
        lumbre(&format!("{words} -o {d}/closed/a.exr"))
            .exits(74)
            .says(&format!("the folder {d}/closed takes no new file: permission denied"));
    }
    for merge in [format!("merge {d}/none/a.png none.exr"), format!("merge {d}/b.hdr none.exr")] {
        lumbre(&merge).exits(74);
    }
}
