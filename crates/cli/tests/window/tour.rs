//! Once through the window: opens the pool, orbits, picks and edits a material, adds a light, moves an object, changes the camera and the
//! device, undoes, saves; and what was saved is what was seen.

use crate::hand::{Hand, Step, Widget};
use std::path::Path;
use std::process::Command;

const POOL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/scenes/pool.glb");
/// Samples of each pixel at which it rests in the end.
const SAMPLES: &str = "2";
/// Longest that a step of the interface may take, milliseconds.
const LIMIT: f64 = 50.0;

#[test]
fn the_window_on_the_cpu() {
    tour("cpu", "gpu", [1280, 800]);
}

#[test]
fn the_window_on_the_gpu() {
    // On a driver that runs on the CPU each pixel takes its time.
    tour("gpu", "cpu", [800, 600]);
}

fn slider(w: &Widget) -> bool {
    w.role == "Slider"
}

fn number(w: &Widget) -> bool {
    w.role == "SpinButton"
}

fn tour(device: &str, other: &str, size: [u32; 2]) {
    let Some(mut hand) = Hand::open(Path::new(POOL), device, size, &["--device", device]) else { return };
    let h = &mut hand;
    h.part("open");
    h.until("the first frame", |h| h.last["spp"].as_u64() > Some(0));
    println!("{device}: the first frame {:.2} s after the window", h.steps.last().unwrap().at);
    h.photograph_whole("opened");

    h.part("orbit");
    let picture = h.picture();
    h.drag("1", picture.at(0.5, 0.5), picture.at(0.42, 0.54), 60);
    h.photograph_whole("orbited");

    h.part("pick");
    // Folded, they make room for those below.
    for panel in ["Render", "View", "Statistics"] {
        h.press(panel);
    }
    h.click(picture.at(0.5, 0.7));
    h.until("a material", |h| h.find("Roughness", slider).is_some());
    h.photograph_whole("picked");

    h.part("edit a material");
    let before = h.in_bar("Roughness", slider);
    h.drag("1", before.at(0.1, 0.5), before.at(0.8, 0.5), 40);
    h.settled();
    let after = h.in_bar("Roughness", slider);
    assert_ne!(before.value, after.value);
    h.photograph("edited");
    h.key("ctrl+z");
    h.until("the old roughness", |h| h.find("Roughness", slider).is_some_and(|w| w.value == before.value));
    h.key("ctrl+y");
    h.until("the new roughness", |h| h.find("Roughness", slider).is_some_and(|w| w.value == after.value));
    h.press("Material");

    h.part("add a light");
    h.press("Lights");
    h.press("Point");
    h.until("the light", |h| h.widgets.iter().any(|w| w.name.ends_with("(added)")));
    h.photograph_whole("lit");
    h.press("Lights");

    h.part("move an object");
    h.click(picture.at(0.5, 0.7));
    h.press("Scene");
    let place = h.in_bar("Place", number);
    h.drag("1", place.at(0.5, 0.5), place.at(2.0, 0.5), 40);
    h.settled();
    assert_ne!(h.in_bar("Place", number).value, place.value);
    h.photograph("moved");
    h.press("Scene");

    h.part("switch the camera");
    // Back to the one that was left, and on to the next.
    h.key("c");
    h.key("c");
    h.photograph_whole("inside");

    h.part("switch the device");
    switch(h, other);
    h.photograph("switched");
    switch(h, device);

    h.part("undo");
    h.key("ctrl+z");
    h.photograph_whole("undone");
    h.key("ctrl+y");
    h.settled();

    h.part("save");
    let limit = h.in_bar("Samples in all", number);
    h.click(limit.at(0.5, 0.5));
    h.write(SAMPLES);
    h.key("Return");
    // What is held is what is saved.
    h.key("x");
    h.until("all samples", |h| h.widgets.iter().any(|w| w.value == "done"));
    h.photograph("done");
    let edits = save(h, "ctrl+shift+s", "tour.edits.json");
    let seen = save(h, "ctrl+s", "tour.png");

    h.part("help");
    h.key("F1");
    h.until("the help", |h| h.widgets.iter().any(|w| w.value == "Orbit"));
    h.photograph("help");
    h.key("F1");
    h.key("F10");
    h.until("no panels", |h| h.find("Material", |_| true).is_none());
    h.photograph("bare");

    let [width, height] = [0, 1].map(|k| (picture.rect[k + 2] - picture.rect[k]) as u32);
    let again = h.folder.path().join("again.png");
    let rendered = Command::new(env!("CARGO_BIN_EXE_lumbre"))
        .args(["render", POOL, "--device", device, "--spp", SAMPLES, "--edits"])
        .arg(&edits)
        .args(["--size", &format!("{width}x{height}"), "-o"])
        .arg(&again)
        .output()
        .unwrap();
    assert!(rendered.status.success(), "{}", String::from_utf8_lossy(&rendered.stderr));
    assert_eq!(
        std::fs::read(&seen).unwrap(),
        std::fs::read(&again).unwrap(),
        "what was seen is not what is rendered"
    );

    let parts = h.parts.clone();
    tell(device, &parts, &hand.close());
}

/// Chooses what draws.
fn switch(h: &mut Hand, device: &str) {
    if h.find("Begin anew", |_| true).is_none() {
        h.press("Render");
    }
    let list = h.in_bar("Device", |w| w.role == "ComboBox");
    h.click(list.at(0.5, 0.5));
    // Those that are no words of ours, below "CPU", are GPUs.
    let entry = move |h: &Hand| {
        let cpu = h.find("CPU", |w| w.role == "Button")?;
        let below = |w: &&Widget| w.role == "Button" && w.rect[0] == cpu.rect[0] && w.rect[1] > cpu.rect[1];
        if device == "cpu" { Some(cpu.clone()) } else { h.widgets.iter().find(below).cloned() }
    };
    h.until("the list of devices", |h| entry(h).is_some());
    let entry = entry(h).unwrap();
    h.click(entry.at(0.5, 0.5));
    let on_cpu = device == "cpu";
    h.until("the device", |h| h.last["device"].as_str().unwrap_or_default().starts_with("CPU") == on_cpu);
    h.settled();
}

/// Saves by the dialog that a key opens.
fn save(h: &mut Hand, key: &str, name: &str) -> std::path::PathBuf {
    let path = h.folder.path().join(name);
    h.key(key);
    h.until("the dialog", |h| h.find("Cancel", |_| true).is_some());
    h.write(path.to_str().unwrap());
    h.photograph("saving");
    h.key("Return");
    let text = path.to_str().unwrap().to_owned();
    h.until("the file", |h| path.exists() && h.log.iter().any(|line| line.contains(&text)));
    path
}

/// Says how long the steps took.
fn tell(device: &str, parts: &[(&'static str, usize)], steps: &[Step]) {
    let ends = parts.iter().skip(1).map(|(_, first)| *first).chain([steps.len()]);
    println!(
        "{device}: part, steps, longest step in ms, longest of our own, longest turn of the loop without a pause"
    );
    let most = |of: &dyn Fn(&Step) -> f64, steps: &[Step]| steps.iter().map(of).fold(0.0, f64::max);
    for ((name, first), end) in parts.iter().zip(ends) {
        let part = &steps[*first..end];
        let turns =
            part.windows(2).filter(|w| w[0].again).map(|w| 1e3 * (w[1].at - w[0].at)).fold(0.0, f64::max);
        println!(
            "{name}: {}, {:.1}, {:.1}, {turns:.1}",
            part.len(),
            most(&|s| s.last_ms, part),
            most(&|s| s.interface_ms, part)
        );
    }
    let long: Vec<String> = steps
        .iter()
        .filter(|s| s.last_ms > LIMIT)
        .map(|s| format!("{:.1} before {:.2} s", s.last_ms, s.at))
        .collect();
    println!("{device}: {} of {} steps longer than {LIMIT} ms: {}", long.len(), steps.len(), long.join(", "));
}
