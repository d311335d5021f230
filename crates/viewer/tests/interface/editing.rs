//! Changing things, and taking changes back.

use crate::camera::shown_node;
use crate::kit::Window;
use eframe::egui::{Key, Modifiers, PointerButton};
use lumbre::edits::{Item, Value};
use lumbre::scene::MaterialId;
use std::sync::Arc;

fn roughness(window: &Window) -> f32 {
    window.fake.wanted().scene.materials[0].roughness
}

#[test]
fn a_material_is_edited_in_its_panel_and_undone() {
    let mut window = Window::with("cornell.glb");
    window.state_mut().selection.material = Some(MaterialId(0));
    window.unfold("Material");
    let (before, scene) = (roughness(&window), window.fake.wanted().scene);
    window.set_number("Roughness", 0.25);
    assert_eq!(roughness(&window), 0.25);
    assert!(!Arc::ptr_eq(&scene, &window.fake.wanted().scene));
    assert!(Arc::ptr_eq(&scene.meshes, &window.fake.wanted().scene.meshes), "meshes are shared");
    window.rest();
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(roughness(&window), before);
    window.press(Modifiers::COMMAND, Key::Y);
    assert_eq!(roughness(&window), 0.25);
    window.click_on("Reset Roughness");
    assert_eq!(roughness(&window), before);
}

#[test]
fn a_drag_of_a_slider_is_one_step() {
    let mut window = Window::with("cornell.glb");
    window.state_mut().selection.material = Some(MaterialId(0));
    window.unfold("Material");
    let before = roughness(&window);
    let slider = window.scrolled_to("Roughness");
    // To the left: it stands at its most.
    let (from, to) = (slider.center(), slider.center() - eframe::egui::vec2(60.0, 0.0));
    let mut passed = 0;
    let told = window.fake.count();
    window.drag(from, to, PointerButton::Primary, |w| passed = w.fake.count() - told);
    assert!(passed > 3, "the picture follows the slider: {passed}");
    window.rest();
    assert_ne!(roughness(&window), before);
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(roughness(&window), before);
    assert!(!window.state().document.as_ref().unwrap().history.can_undo());
}

#[test]
fn a_look_changes_no_scene() {
    let mut window = Window::with("cornell.glb");
    let before = window.fake.wanted();
    window.press(Modifiers::NONE, Key::Minus);
    let after = window.fake.wanted();
    assert!((after.look.offset_ev + 1.0 / 3.0).abs() < 1e-5);
    assert!(Arc::ptr_eq(&before.scene, &after.scene));
    assert_eq!(
        (before.camera, before.settings, before.restarts),
        (after.camera, after.settings, after.restarts)
    );
    window.press(Modifiers::NONE, Key::X);
    // The exposure of the frame that was shown.
    assert_eq!(window.fake.wanted().look.look.exposure, lumbre::core::color::Exposure::Ev(1.5));
}

#[test]
fn lights_are_added_picked_moved_and_removed() {
    let mut window = Window::with("cornell.glb");
    let before = window.fake.wanted().scene;
    window.unfold("Lights");
    window.click_on("Point");
    window.rest();
    let scene = window.fake.wanted().scene;
    assert_eq!(scene.lights.len(), before.lights.len() + 1);
    assert_eq!(window.state().selection.item, Some(Item::Added(0)));
    assert!(scene.lights.last().unwrap().intensity.max_component() > 0.0);
    let at = window.state().place_of(Item::Added(0)).unwrap();
    window.click_on("Remove");
    assert_eq!(window.fake.wanted().scene.lights.len(), before.lights.len());
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.fake.wanted().scene.lights.len(), before.lights.len() + 1);
    assert_eq!(window.state().place_of(Item::Added(0)), Some(at));
}

#[test]
fn an_arrow_moves_what_is_picked() {
    let mut window = Window::with("cornell.glb");
    let node = shown_node(&window);
    window
        .state_mut()
        .obey(lumbre_viewer::command::Command::Pick(Item::Node(node)), &eframe::egui::Context::default());
    window.steps(2);
    let place = |w: &Window| w.fake.wanted().scene.nodes[node.index()].transform.w_axis.truncate();
    let (before, camera) = (place(&window), window.fake.wanted().camera);
    let screen = lumbre_viewer::gizmo::Screen {
        camera,
        size: glam::Vec2::new(window.picture().width(), window.picture().height()),
    };
    let origin = window.state().place_of(Item::Node(node)).unwrap();
    let [a, b] = screen.arrows(origin)[1].expect("the y axis is seen from the side");
    let corner = window.picture().min;
    let on = |v: glam::Vec2| corner + eframe::egui::vec2(v.x, v.y);
    let (from, to) = (on(a.lerp(b, 0.7)), on(a.lerp(b, 0.7) + (b - a) * 0.5));
    window.drag(from, to, PointerButton::Primary, |_| {});
    window.rest();
    let after = place(&window);
    assert!(after.y > before.y + 1e-4 && (after - before).x.abs() < 1e-6, "{before} {after}");
    assert_eq!(window.fake.wanted().camera, camera, "the camera stays");
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(place(&window), before);
}

#[test]
fn what_is_hidden_is_not_drawn() {
    let mut window = Window::with("cornell.glb");
    let node = shown_node(&window);
    window.state_mut().selection.item = Some(Item::Node(node));
    window.press(Modifiers::NONE, Key::H);
    assert!(!window.fake.wanted().scene.nodes[node.index()].visible);
    window.press(Modifiers::NONE, Key::H);
    assert!(window.fake.wanted().scene.nodes[node.index()].visible);
}

#[test]
fn settings_begin_anew_and_pace_does_not() {
    let mut window = Window::with("cornell.glb");
    window.state_mut().set(Item::Settings, "maxDepth", Value::Whole(3));
    window.steps(2);
    assert_eq!(window.fake.wanted().settings.max_depth, Some(3));
    window.set_number("Samples per frame", 8.0);
    assert_eq!(window.fake.wanted().samples_per_frame, 8);
    window.press(Modifiers::NONE, Key::Space);
    assert!(window.fake.wanted().paused);
    window.press(Modifiers::NONE, Key::R);
    assert_eq!(window.fake.wanted().restarts, 1);
    window.press(Modifiers::NONE, Key::N);
    assert_eq!(window.fake.wanted().settings.max_depth, Some(0), "the preview has no light");
    assert_eq!(window.fake.wanted().layer, lumbre::session::Layer::Normal);
    window.press(Modifiers::NONE, Key::N);
    assert_eq!(window.fake.wanted().settings.max_depth, Some(3));
}

#[test]
fn what_has_not_come_to_rest_is_undone_first() {
    let mut window = Window::with("cornell.glb");
    let depth = |w: &Window| w.fake.wanted().settings.max_depth;
    let first = depth(&window);
    window.state_mut().set(Item::Settings, "maxDepth", Value::Whole(3));
    window.rest();
    window.state_mut().set(Item::Settings, "maxDepth", Value::Whole(5));
    window.state_mut().stir();
    window.steps(1);
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(depth(&window), Some(3));
    window.press(Modifiers::COMMAND, Key::Z);
    assert_eq!(depth(&window), first);
}
