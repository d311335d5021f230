//! Ctrl-C: the first saves what there is, the second kills.
#![cfg(unix)]

use crate::common::*;
use lumbre::io::{Limits, read_exr, read_linear_image};
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, ChildStderr, ChildStdout, Command, Stdio};

struct Running {
    child: Child,
    stdout: BufReader<ChildStdout>,
    stderr: BufReader<ChildStderr>,
}

impl Running {
    fn start(words: &str) -> Self {
        let mut c = command();
        c.args(words.split_whitespace()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = c.spawn().unwrap();
        let stdout = BufReader::new(child.stdout.take().unwrap());
        let stderr = BufReader::new(child.stderr.take().unwrap());
        Running { child, stdout, stderr }
    }
    fn signal(&self, name: &str) {
        let id = self.child.id().to_string();
        assert!(Command::new("kill").args([name, &id]).status().unwrap().success());
    }
    /// Reads lines until one holds a text.
    fn until(reader: &mut impl BufRead, text: &str) {
        let mut line = String::new();
        while !line.contains(text) {
            line.clear();
            assert!(reader.read_line(&mut line).unwrap() > 0, "ended before it said {text:?}");
        }
    }
    fn end(mut self) -> Run {
        let (mut stdout, mut stderr) = (String::new(), String::new());
        self.stdout.read_to_string(&mut stdout).unwrap();
        self.stderr.read_to_string(&mut stderr).unwrap();
        Run { code: self.child.wait().unwrap().code().unwrap_or(-1), stdout, stderr }
    }
}

#[test]
fn the_first_interrupt_writes_what_there_is() {
    for signal in ["-INT", "-TERM"] {
        let dir = folder();
        let d = dir.path().display();
        let words = format!("{CORNELL} --size 16x12 --spp 1000000 --progress json -o {d}/a.exr -o {d}/a.png");
        let mut running = Running::start(&format!("render {words}"));
        Running::until(&mut running.stdout, "\"progress\"");
        running.signal(signal);
        let run = running.end().exits(75).says("interrupted: the picture has");
        assert_eq!(run.last_json()["interrupted"], true);
        let image = read_exr(dir.path().join("a.exr"), &Limits::default()).unwrap();
        let samples = image.layers.iter().find(|l| l.name == "samples").unwrap().channel("Y").unwrap();
        let (least, most) = samples.iter().fold((f32::MAX, 0.0f32), |(l, m), s| (l.min(*s), m.max(*s)));
        assert!((1.0..1e6).contains(&most) && most - least <= 16.0, "even: {least} to {most}");
        assert!(image.metadata.iter().any(|(n, _)| n == "lumbre.interrupted"));
        assert!(read_linear_image(dir.path().join("a.png"), None, &Limits::default()).is_ok());
        assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 2, "nothing else is left");
    }
}

/// A part that is interrupted ends with even pixels: it can be merged as far as it got.
#[test]
fn an_interrupted_part_is_a_shorter_part() {
    let dir = folder();
    let d = dir.path().display();
    let words = format!("{CORNELL} --size 64x48 --first-sample 3 --spp 1000000 --progress json -o {d}/a.exr");
    let mut running = Running::start(&format!("render {words}"));
    Running::until(&mut running.stdout, "\"progress\"");
    running.signal("-INT");
    running.end().exits(75).does_not_say("no exact sums");
    lumbre(&format!("merge {d}/b.exr {d}/a.exr")).exits(0).says("merged 1 part: sample");
}

#[test]
fn the_second_interrupt_ends_at_once() {
    let dir = folder();
    // Two perfect mirrors face each other: each path takes 65536 bounces, a tile minutes.
    let mirror = r#"{"pbrMetallicRoughness":{"metallicFactor":1,"roughnessFactor":0}}"#;
    let mirrors = [square(0.0, 1e3), square(1.0, -1e3)].concat();
    let scene = scene(dir.path(), &[(mirrors, mirror)]);
    let view = "--look-from 0,0.5,0 --look-at 0,0,0 --fov 0.001 --size 16x16 --roulette off --sky 1,1,1";
    let path = lumbre(&format!("render {scene} {view} --max-depth 50 --pixel 8,8")).exits(0).stdout;
    assert!(path.matches("\nhit").count() > 50, "the path does not stay between the mirrors:\n{path}");
    let out = dir.path().join("a.png");
    let words = format!("{scene} {view} --max-depth unlimited --progress json -o {}", out.display());
    let mut running = Running::start(&format!("render {words}"));
    Running::until(&mut running.stdout, "\"start\"");
    running.signal("-INT");
    Running::until(&mut running.stderr, "stopping at the next tile");
    running.signal("-INT");
    running.end().exits(130);
    assert!(!out.exists());
}
