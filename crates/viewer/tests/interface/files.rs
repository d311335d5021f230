//! Opening and saving.

use crate::kit::{Window, asset};
use eframe::egui::{self, Key, Modifiers};
use lumbre::edits::{Item, Value};
use lumbre::session::Event;
use lumbre_viewer::command::Command;
use lumbre_viewer::dialog::{Choice, Purpose};
use std::path::Path;
use std::sync::Arc;

fn write(folder: &Path, name: &str, text: &str) -> std::path::PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn a_broken_scene_leaves_the_good_one_and_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let broken = write(folder.path(), "broken.glb", "glTF and then nothing");
    let mut window = Window::with("cornell.glb");
    let (good, told) = (window.fake.wanted().scene, window.fake.count());
    window.state_mut().loader.open(&broken);
    window.until("an error", |w| w.state().log.pending().is_some());
    window.steps(2);
    assert!(window.shows("broken.glb"), "the error is in view");
    assert_eq!(window.state().document.as_ref().unwrap().path, asset("cornell.glb"));
    assert_eq!(window.fake.count(), told, "nothing is begun anew");
    assert!(Arc::ptr_eq(&good, &window.fake.wanted().scene));
    window.click_on("Dismiss");
    assert!(window.state().log.pending().is_none());
}

#[test]
fn a_scene_that_cannot_be_prepared_gives_way_to_the_one_before() {
    let mut window = Window::with("cornell.glb");
    let good = window.fake.wanted().scene;
    window.fake.prepared("Stand-in", 0.1);
    window.steps(1);
    window.open(&asset("prism.gltf"));
    window.fake.happens(Event::Preparing("compiling the scene".into()));
    window.fake.refuses("prism.gltf: material 7 of 3");
    window.steps(2);
    assert!(window.shows("material 7 of 3"));
    assert_eq!(window.state().document.as_ref().unwrap().path, asset("cornell.glb"));
    assert!(Arc::ptr_eq(&good, &window.fake.wanted().scene));
    // One that is refused late takes no other with it, and what was never drawn is nothing to go back to.
    window.open(&asset("prism.gltf"));
    let prism = window.fake.wanted().scene;
    window.open(&asset("smooth.gltf"));
    window.fake.happens(Event::Refused { scene: prism, reason: "prism.gltf: too late".into() });
    window.steps(2);
    assert_eq!(window.state().document.as_ref().unwrap().path, asset("smooth.gltf"));
    window.fake.refuses("smooth.gltf: neither");
    window.steps(2);
    assert_eq!(window.state().document.as_ref().unwrap().path, asset("cornell.glb"));
}

#[test]
fn scenes_without_camera_and_without_anything_are_shown() {
    let folder = tempfile::tempdir().unwrap();
    let triangle = "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n";
    let mut window = Window::empty();
    window.open(&write(folder.path(), "triangle.obj", triangle));
    let camera = window.fake.wanted().camera;
    let towards = (glam::Vec3::new(1.0, 0.5, 0.0) - camera.origin).normalize();
    assert!(towards.dot(camera.forward) > 0.999, "all of it is in view");
    let empty = r#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": []}], "scene": 0}"#;
    window.open(&write(folder.path(), "empty.gltf", empty));
    assert!(window.fake.wanted().camera.origin.is_finite());
    window.press(Modifiers::NONE, Key::F);
    window.press(Modifiers::NONE, Key::Z);
    window.press(Modifiers::NONE, Key::H);
    assert!(window.fake.wanted().camera.origin.is_finite());
}

#[test]
fn edits_are_saved_opened_and_named_by_a_command() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("my edits.json");
    let mut window = Window::with("cornell.glb");
    window.state_mut().selection.material = Some(lumbre::scene::MaterialId(0));
    window.unfold("Material");
    window.set_number("Roughness", 0.125);
    window.press(Modifiers::NONE, Key::F);
    window.rest();
    window.press(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    let choice = lumbre_viewer::dialog::Choice::File(lumbre_viewer::dialog::Purpose::SaveEdits, file.clone());
    window.state_mut().chosen(choice);
    window.until("a file", |w| w.state().edits_file.is_some());
    let line = window.state().command_line().unwrap();
    assert!(
        line.starts_with("lumbre render ") && line.contains(&format!("--edits '{}'", file.display())),
        "{line}"
    );
    // It says what is shown, or nothing; to copy it writes the file anew.
    window.press(Modifiers::NONE, Key::C);
    window.rest();
    window.state_mut().set(Item::Settings, "maxDepth", Value::Whole(3));
    window.steps(2);
    assert_eq!(window.state().command_line(), None);
    window.state_mut().obey(Command::CopyCommand, &egui::Context::default());
    window.until("the command", |w| w.state().command_line().is_some());
    assert!(window.state().log.lines().iter().any(|l| l.text.starts_with("copied: lumbre render")));
    let wanted = window.fake.wanted();
    // Another window, another day.
    let mut again = Window::with("cornell.glb");
    again.state_mut().loader.open(&file);
    again.until("edits", |w| w.state().edits_file.is_some());
    again.rest();
    assert_eq!(again.fake.wanted().camera, wanted.camera);
    assert_eq!(*again.fake.wanted().scene, *wanted.scene);
    again.press(Modifiers::COMMAND, Key::Z);
    assert_ne!(*again.fake.wanted().scene, *wanted.scene, "opening edits can be undone");
}

#[test]
fn pictures_are_saved_by_the_session() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = Window::with("cornell.glb");
    window.press(Modifiers::COMMAND, Key::S);
    assert!(window.shows("Save the picture"));
    let field = "File";
    let path = folder.path().join("picture.exr");
    {
        use egui_kittest::kittest::Queryable;
        let field =
            window.ui.get_all_by_label(field).find(|n| n.value().is_some()).expect("the name of the file");
        field.focus();
        field.set_text_value_accesskit(&path.to_string_lossy());
    }
    window.steps(2);
    window.click_on("Save");
    assert_eq!(window.fake.told(|t| t.saves.clone()), [path]);
    assert!(window.state().dialog.is_none());
}

#[test]
fn an_environment_becomes_the_sky_and_a_missing_one_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x80\x80\x81\x80\x80\x80\x81".to_vec();
    let sky = folder.path().join("sky.hdr");
    std::fs::write(&sky, hdr).unwrap();
    let mut window = Window::with("cornell.glb");
    let before = window.fake.wanted().scene;
    window.state_mut().loader.open(&sky);
    let lit = |w: &Window| {
        matches!(w.fake.wanted().scene.environment.background, lumbre::scene::Background::Map(_))
    };
    window.until("a sky", lit);
    window.rest();
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.fake.wanted().scene.environment, before.environment);
    window.press(Modifiers::COMMAND, Key::Y);
    assert!(lit(&window));
    let edits = write(
        folder.path(),
        "edits.json",
        r#"{"lumbreEdits": 1, "sky": {"kind": "file", "file": "gone.hdr"}}"#,
    );
    window.state_mut().loader.open(&edits);
    window.until("an error", |w| w.state().log.pending().is_some());
    window.rest();
    assert!(lit(&window), "the sky is what it was");
}

#[test]
fn a_file_that_changes_is_opened_again_with_the_edits() {
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "triangle.obj", "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n");
    let mut window = Window::empty();
    window.state_mut().watching = true;
    window.open(&path);
    window.press(Modifiers::NONE, Key::Minus);
    window.rest();
    let camera = window.fake.wanted().camera;
    std::thread::sleep(std::time::Duration::from_millis(600));
    std::fs::write(&path, "v 0 0 0\nv 3 0 0\nv 0 1 0\nv 3 1 0\nf 1 2 3\nf 2 4 3\n").unwrap();
    let triangles = |w: &Window| w.fake.wanted().scene.meshes[0].primitives[0].indices.len() / 3;
    window.until("the new file", |w| triangles(w) == 2);
    window.rest();
    assert_eq!(window.fake.wanted().camera, camera, "the camera stays");
    assert!(window.fake.wanted().look.offset_ev < 0.0, "the edits stay");
}

#[test]
fn edits_that_are_not_saved_are_not_lost() {
    let mut window = Window::with("cornell.glb");
    let other = asset("smooth.gltf");
    window.state_mut().open_file(other.clone());
    window.until("another scene", |w| w.state().document.as_ref().is_some_and(|d| d.path == other));
    window.rest();
    assert!(window.state().leaving.is_none(), "nothing was changed");
    window.state_mut().set(Item::Settings, "maxDepth", Value::Whole(3));
    window.steps(2);
    // Another scene waits for the answer.
    window.state_mut().open_file(asset("cornell.glb"));
    window.steps(2);
    assert!(window.shows("Save the edits?") && window.state().loader.under_way().is_none());
    window.press(Modifiers::NONE, Key::Space);
    assert!(!window.fake.wanted().paused, "keys are for the question");
    window.click_on("Stay");
    assert!(!window.shows("Save the edits?"));
    // And so does the window.
    assert!(!window.state_mut().may_close());
    window.steps(2);
    window.click_on("Save");
    window.steps(2);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kept.edits.json");
    window.state_mut().chosen(Choice::File(Purpose::SaveEdits, path.clone()));
    window.until("a file", |w| w.state().leaving.is_none());
    assert!(path.exists());
    assert!(window.state_mut().may_close());
    // What is of no use is let go.
    window.state_mut().set(Item::Settings, "maxDepth", Value::Whole(4));
    window.steps(2);
    window.state_mut().open_file(asset("cornell.glb"));
    window.steps(2);
    window.click_on("Discard");
    window
        .until("the scene", |w| w.state().document.as_ref().is_some_and(|d| d.path == asset("cornell.glb")));
}

#[test]
fn edits_that_do_not_fit_take_no_file_for_theirs() {
    let folder = tempfile::tempdir().unwrap();
    let text = r#"{"lumbreEdits": 1, "camera": {"fov": 20}, "sky": {"kind": "file", "file": "gone.hdr"}}"#;
    let path = write(folder.path(), "sky.edits.json", text);
    let mut window = Window::with("cornell.glb");
    let camera = window.fake.wanted().camera;
    window.state_mut().loader.open(&path);
    window.until("an error", |w| w.state().log.pending().is_some());
    window.steps(3);
    assert!(window.state().edits_file.is_none() && !window.state().is_unsaved());
    assert_eq!(window.fake.wanted().camera, camera);
}

/// A scene of two triangles with materials of these names.
fn of_materials(folder: &Path, names: [&str; 2]) -> std::path::PathBuf {
    write(folder, "a.mtl", &names.map(|n| format!("newmtl {n}\nKd 0.5 0.5 0.5\n")).concat());
    let faces = names.map(|n| format!("usemtl {n}\nf 1 2 3\n")).concat();
    write(folder, "a.obj", &format!("mtllib a.mtl\nv 0 0 0\nv 2 0 0\nv 0 1 0\n{faces}"))
}

#[test]
fn what_a_changed_file_has_lost_takes_its_edits_along_and_no_others() {
    let folder = tempfile::tempdir().unwrap();
    let path = of_materials(folder.path(), ["brick", "wood"]);
    let mut window = Window::empty();
    window.state_mut().watching = true;
    window.open(&path);
    for material in 0..2 {
        let item = Item::Material(lumbre::scene::MaterialId(material));
        window.state_mut().set(item, "roughness", Value::Number(0.125));
    }
    window.state_mut().set(Item::Settings, "maxDepth", Value::Whole(3));
    window.press(Modifiers::COMMAND, Key::Num3);
    window.rest();
    std::thread::sleep(std::time::Duration::from_millis(600));
    of_materials(folder.path(), ["wood", "slate"]);
    // The file that is watched is the scene's.
    std::fs::write(&path, std::fs::read_to_string(&path).unwrap() + "# again\n").unwrap();
    let roughness = |w: &Window, name: &str| {
        let scene = w.fake.wanted().scene;
        scene.materials.iter().find(|m| m.name == name).map(|m| m.roughness)
    };
    window.until("the new file", |w| roughness(w, "slate").is_some());
    window.rest();
    assert_eq!(roughness(&window, "wood"), Some(0.125), "edits of what is there stay");
    assert_ne!(roughness(&window, "slate"), Some(0.125));
    assert_eq!(window.fake.wanted().settings.max_depth, Some(3));
    assert_eq!(window.state().document.as_ref().unwrap().edits.bookmarks.len(), 1);
    assert!(window.shows("brick"), "it is told what was taken back");
    // Steps that do not fit any more are passed over, there and back.
    window.press(Modifiers::COMMAND, Key::Z);
    window.rest();
    assert_ne!(roughness(&window, "wood"), Some(0.125));
    window.press(Modifiers::COMMAND, Key::Y);
    window.rest();
    assert_eq!(roughness(&window, "wood"), Some(0.125));
    // A file that can be read and not be drawn leaves what there was.
    let good = window.fake.wanted().scene;
    window.fake.prepared("Stand-in", 0.1);
    window.steps(1);
    of_materials(folder.path(), ["wood", "glass"]);
    std::fs::write(&path, std::fs::read_to_string(&path).unwrap() + "# once more\n").unwrap();
    window.until("the next file", |w| roughness(w, "glass").is_some());
    window.fake.happens(Event::Preparing("compiling the scene".into()));
    window.fake.refuses("a.obj: too many triangles");
    window.steps(2);
    assert!(Arc::ptr_eq(&good, &window.fake.wanted().scene));
    assert_eq!(roughness(&window, "wood"), Some(0.125));
}

#[test]
fn what_is_dropped_with_a_scene_is_for_that_scene() {
    let folder = tempfile::tempdir().unwrap();
    let edits = write(folder.path(), "e.json", r#"{"lumbreEdits": 1, "settings": {"maxDepth": 3}}"#);
    let mut window = Window::with("cornell.glb");
    window.state_mut().dropped(vec![edits, asset("smooth.gltf")]);
    window.until("the edits", |w| w.state().edits_file.is_some());
    window.rest();
    assert_eq!(window.state().document.as_ref().unwrap().path, asset("smooth.gltf"));
    assert_eq!(window.fake.wanted().settings.max_depth, Some(3));
}

#[test]
fn a_picture_is_saved_where_something_else_is_rendered() {
    use lumbre::session::Layer;
    let mut window = Window::with("cornell.glb");
    let settings = window.fake.wanted().settings;
    window.state_mut().running.layer = Layer::Objects;
    window.state_mut().running.preview = true;
    window.steps(2);
    assert_ne!(window.fake.wanted().settings, settings);
    window.state_mut().chosen(Choice::File(Purpose::SavePicture, "a.exr".into()));
    window.steps(2);
    assert_eq!(window.fake.told(|t| t.saves.clone()), [Path::new("a.exr")]);
    let wanted = window.fake.wanted();
    assert_eq!((wanted.settings, wanted.layer), (settings, Layer::Picture));
}

#[test]
fn parallel_rays_come_closer_in_the_edits() {
    let folder = tempfile::tempdir().unwrap();
    let text = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"camera": 0}],
        "cameras": [{"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 0.1, "zfar": 10}}]}"#;
    let mut window = Window::empty();
    window.open(&write(folder.path(), "parallel.gltf", text));
    let at = window.at(0.5, 0.5);
    window.ui.event(egui::Event::PointerMoved(at));
    let before = window.fake.wanted().camera.projection;
    let mut pose = window.state().pose().unwrap();
    pose.camera.projection = pose.camera.projection.scaled(0.5);
    window.state_mut().set_pose(pose);
    window.rest();
    let camera = window.fake.wanted().camera;
    assert_eq!(camera.projection, before.scaled(0.5));
    // As `lumbre render --edits` finds it.
    let document = window.state().document.as_ref().unwrap();
    let text = document.edits.to_text();
    let options = lumbre::edits::Edits::parse(&text).unwrap().camera_options();
    let compiled = lumbre::compile(&document.base).unwrap().scene;
    let found = lumbre::find_camera(&document.base, &compiled, &options, camera.aspect).unwrap();
    assert_eq!(found.camera, camera);
}
