//! A hand on the mouse and the keys, and an eye on the window: what it shows and where its controls are comes from its own report.

use crate::display::Display;
use serde_json::Value;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longest wait for anything.
const PATIENCE: Duration = Duration::from_secs(120);
/// Between two moves of the mouse: a hundred a second.
const MOVE: Duration = Duration::from_millis(10);

/// A control.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Widget {
    pub(crate) role: String,
    pub(crate) name: String,
    pub(crate) value: String,
    /// Left, top, right, bottom.
    pub(crate) rect: [f64; 4],
}

impl Widget {
    /// A place of it, 0 to 1 along each axis.
    pub(crate) fn at(&self, x: f64, y: f64) -> [f64; 2] {
        let [left, top, right, bottom] = self.rect;
        [left + x * (right - left), top + y * (bottom - top)]
    }
}

/// A step of the window, as it reported it.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    /// Seconds since it began.
    pub(crate) at: f64,
    /// Milliseconds of the step before as a whole.
    pub(crate) last_ms: f64,
    pub(crate) interface_ms: f64,
    /// Whether the next one followed without a pause.
    pub(crate) again: bool,
}

/// `lumbre view` under a hand.
pub(crate) struct Hand {
    display: Display,
    program: Child,
    pub(crate) folder: TempDir,
    /// Where pictures go.
    album: PathBuf,
    shots: usize,
    read: u64,
    rest: String,
    /// What it shows now.
    pub(crate) widgets: Vec<Widget>,
    pub(crate) last: Value,
    pub(crate) log: Vec<String>,
    /// All steps, and the names of the parts of the tour with the step at which each began.
    pub(crate) steps: Vec<Step>,
    pub(crate) parts: Vec<(&'static str, usize)>,
}

impl Hand {
    /// Opens a scene in a window; `None` where there can be no display.
    pub(crate) fn open(scene: &Path, album: &str, size: [u32; 2], words: &[&str]) -> Option<Self> {
        let display = Display::start(size)?;
        let folder = tempfile::tempdir().unwrap();
        let album = Path::new(env!("CARGO_TARGET_TMPDIR")).join("window").join(album);
        let _ = std::fs::remove_dir_all(&album);
        std::fs::create_dir_all(&album).unwrap();
        let size = format!("{}x{}", size[0], size[1]);
        let program = Command::new(env!("CARGO_BIN_EXE_lumbre"))
            .arg("view")
            .arg(scene)
            .args(["--size", &size, "--report"])
            .arg(folder.path().join("report.jsonl"))
            .args(words)
            .env("DISPLAY", &display.name)
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("RAYON_NUM_THREADS")
            // What was opened before is a matter of this test.
            .env("XDG_STATE_HOME", folder.path())
            .env("XDG_CONFIG_HOME", folder.path())
            .env("HOME", folder.path())
            .spawn()
            .expect("the program starts");
        let mut hand = Hand {
            display,
            program,
            folder,
            album,
            shots: 0,
            read: 0,
            rest: String::new(),
            widgets: Vec::new(),
            last: Value::Null,
            log: Vec::new(),
            steps: Vec::new(),
            parts: Vec::new(),
        };
        hand.until("the window", |h| !h.widgets.is_empty());
        // No window manager gives it the keys.
        let id = hand.xdotool(&["search", "--sync", "--onlyvisible", "--name", "Lumbre"]);
        hand.xdotool(&["windowfocus", "--sync", id.lines().next().unwrap_or_default().trim()]);
        Some(hand)
    }

    /// Reads what the window reported since.
    pub(crate) fn look(&mut self) {
        let Ok(mut file) = File::open(self.folder.path().join("report.jsonl")) else { return };
        file.seek(SeekFrom::Start(self.read)).unwrap();
        let mut text = String::new();
        self.read += file.read_to_string(&mut text).unwrap() as u64;
        self.rest.push_str(&text);
        let Some(end) = self.rest.rfind('\n') else { return };
        let lines: String = self.rest.drain(..=end).collect();
        for line in lines.lines() {
            self.take(serde_json::from_str(line).unwrap());
        }
    }

    fn take(&mut self, mut line: Value) {
        let number = |name: &str| line[name].as_f64().unwrap();
        self.steps.push(Step {
            at: number("at"),
            last_ms: number("last_ms"),
            interface_ms: number("interface_ms"),
            again: line["again"] == true,
        });
        let text = |v: &Value| v.as_str().unwrap_or_default().to_owned();
        if let Some(Value::Array(all)) = line.get("widgets") {
            let widget = |w: &Value| Widget {
                role: text(&w["role"]),
                name: text(&w["name"]),
                value: text(&w["value"]),
                rect: [0, 1, 2, 3].map(|i| w["rect"][i].as_f64().unwrap()),
            };
            self.widgets = all.iter().map(widget).collect();
        }
        if let Some(Value::Array(lines)) = line.get("log") {
            self.log.extend(lines.iter().map(text));
        }
        line.as_object_mut().unwrap().remove("widgets");
        self.last = line;
    }

    /// Waits until something is so.
    #[track_caller]
    pub(crate) fn until(&mut self, what: &str, so: impl Fn(&Self) -> bool) {
        let began = Instant::now();
        loop {
            self.look();
            if so(self) {
                return;
            }
            let ended = self.program.try_wait().unwrap();
            if began.elapsed() > PATIENCE || ended.is_some() {
                self.photograph("failed");
                let widgets: Vec<String> = self
                    .widgets
                    .iter()
                    .map(|w| format!("{} {:?} {:?} {:?}", w.role, w.name, w.value, w.rect))
                    .collect();
                panic!(
                    "waiting for {what} (ended: {ended:?}): {}\n{}\n{}",
                    self.last,
                    self.log.join("\n"),
                    widgets.join("\n")
                );
            }
            sleep(Duration::from_millis(5));
        }
    }

    /// Waits until a frame shows all that was asked for, at rest and whole.
    #[track_caller]
    pub(crate) fn settled(&mut self) {
        // What the hand did last is still on its way to the window.
        sleep(Duration::from_millis(100));
        self.until("a frame of it", |h| {
            h.last["scale"] == 1 && h.last["spp"].as_u64() > Some(0) && h.last["number"] == h.last["wish"]
        });
    }

    /// The same once the picture in the window has as many samples as people want to look at.
    #[track_caller]
    pub(crate) fn photograph_whole(&mut self, name: &str) {
        self.settled();
        let samples =
            std::env::var("LUMBRE_WINDOW_SAMPLES").ok().and_then(|v| v.parse().ok()).unwrap_or(1u64);
        self.until("samples", |h| h.last["spp"].as_u64() >= Some(samples));
        self.photograph(name);
    }

    /// Begins a part of the tour.
    pub(crate) fn part(&mut self, name: &'static str) {
        self.look();
        self.parts.push((name, self.steps.len()));
    }

    /// Takes a picture of the display, once what glides has come to rest.
    pub(crate) fn photograph(&mut self, name: &str) {
        sleep(Duration::from_millis(250));
        self.shots += 1;
        self.display.photograph(&self.album.join(format!("{:02}-{name}.png", self.shots)));
    }

    fn xdotool(&self, words: &[&str]) -> String {
        let done = Command::new("xdotool").args(words).env("DISPLAY", &self.display.name).output().unwrap();
        assert!(done.status.success(), "xdotool {words:?}: {}", String::from_utf8_lossy(&done.stderr));
        String::from_utf8(done.stdout).unwrap()
    }

    fn go(&self, to: [f64; 2]) {
        self.xdotool(&["mousemove", &to[0].round().to_string(), &to[1].round().to_string()]);
    }

    /// Presses the left button somewhere.
    pub(crate) fn click(&mut self, at: [f64; 2]) {
        self.go(at);
        sleep(3 * MOVE);
        self.xdotool(&["mousedown", "1"]);
        sleep(3 * MOVE);
        self.xdotool(&["mouseup", "1"]);
        sleep(3 * MOVE);
        self.look();
    }

    /// Drags with a button from one place to another, a hundred moves a second.
    pub(crate) fn drag(&mut self, button: &str, from: [f64; 2], to: [f64; 2], moves: u32) {
        self.go(from);
        sleep(3 * MOVE);
        self.xdotool(&["mousedown", button]);
        for i in 1..=moves {
            let t = f64::from(i) / f64::from(moves);
            self.go([0, 1].map(|k| from[k] + t * (to[k] - from[k])));
            sleep(MOVE);
        }
        self.xdotool(&["mouseup", button]);
        self.look();
    }

    /// Presses a key, in xdotool's names: `ctrl+z`.
    pub(crate) fn key(&mut self, key: &str) {
        self.xdotool(&["key", key]);
        sleep(3 * MOVE);
        self.look();
    }

    /// Types over what stands in the field that has the keys.
    pub(crate) fn write(&mut self, text: &str) {
        self.key("ctrl+a");
        self.xdotool(&["type", "--delay", "5", text]);
        sleep(3 * MOVE);
        self.look();
    }

    /// The last control of this name that meets a condition.
    pub(crate) fn find(&self, name: &str, is: impl Fn(&Widget) -> bool) -> Option<Widget> {
        self.widgets.iter().rev().find(|w| w.name == name && is(w)).cloned()
    }

    /// The control of this name once it is there.
    #[track_caller]
    pub(crate) fn control(&mut self, name: &str) -> Widget {
        self.until(name, |h| h.find(name, |_| true).is_some());
        self.find(name, |_| true).unwrap()
    }

    /// The picture.
    #[track_caller]
    pub(crate) fn picture(&mut self) -> Widget {
        self.control("Picture")
    }

    /// A control of the side bar, brought into view by the wheel.
    #[track_caller]
    pub(crate) fn in_bar(&mut self, name: &str, is: impl Fn(&Widget) -> bool) -> Widget {
        let left = self.picture().rect[2];
        let [width, height] = self.display.size.map(f64::from);
        let bar = [0.5 * (left + width), 0.5 * height];
        let in_bar = |h: &Self| h.find(name, |w| w.rect[0] >= left && is(w));
        self.until(name, |h| in_bar(h).is_some());
        for _ in 0..100 {
            let widget = in_bar(self).expect("it stays there");
            // What unfolds glides.
            sleep(Duration::from_millis(60));
            self.look();
            if in_bar(self).as_ref() != Some(&widget) {
                continue;
            }
            let [_, y] = widget.at(0.5, 0.5);
            let (top, bottom) = (32.0, height - 40.0);
            if (top..bottom).contains(&y) {
                return widget;
            }
            self.go(bar);
            self.xdotool(&["click", if y < top { "4" } else { "5" }]);
        }
        panic!("the wheel does not bring {name} into view");
    }

    /// Clicks on a control of the side bar.
    #[track_caller]
    pub(crate) fn press(&mut self, name: &str) {
        let widget = self.in_bar(name, |_| true);
        self.click(widget.at(0.5, 0.5));
    }

    /// Closes the window, which must end the program as it should.
    pub(crate) fn close(mut self) -> Vec<Step> {
        self.key("ctrl+q");
        let began = Instant::now();
        let ended = loop {
            if let Some(ended) = self.program.try_wait().unwrap() {
                break ended;
            }
            assert!(began.elapsed() < PATIENCE, "it does not close");
            sleep(MOVE);
        };
        assert!(ended.success(), "{ended}");
        self.look();
        std::mem::take(&mut self.steps)
    }
}

impl Drop for Hand {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}
