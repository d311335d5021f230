//! Moving about.

use crate::kit::Window;
use eframe::egui::{self, Key, Modifiers, PointerButton};
use glam::Vec3;
use lumbre::scene::{MaterialId, NodeId};
use lumbre::session::{Event, Picked};
use std::sync::Arc;

#[test]
fn the_first_picture_is_that_of_the_files_camera() {
    let window = Window::with("cornell.glb");
    let wanted = window.fake.wanted();
    let compiled = lumbre::compile(&wanted.scene).unwrap().scene;
    let aspect = wanted.size[0] as f32 / wanted.size[1] as f32;
    let found =
        lumbre::find_camera(&wanted.scene, &compiled, &lumbre::CameraOptions::default(), aspect).unwrap();
    assert!(!found.framed);
    assert_eq!(wanted.camera, found.camera, "to the bit what `lumbre render` draws");
    assert!(wanted.size[0] > 800 && wanted.size[1] > 600, "{:?}", wanted.size);
}

#[test]
fn a_left_drag_orbits_about_what_is_looked_at() {
    let mut window = Window::with("cornell.glb");
    let before = window.state().pose().unwrap();
    let (from, to) = (window.at(0.5, 0.5), window.at(0.6, 0.5));
    window.drag(from, to, PointerButton::Primary, |w| {
        assert!(w.fake.wanted().moving, "rough frames while it moves")
    });
    let after = window.state().pose().unwrap();
    assert!((after.pivot() - before.pivot()).length() < 1e-3 * before.reach);
    let aside = (after.camera.origin - before.camera.origin).dot(before.camera.right);
    assert!(aside < -0.05 * before.reach, "the scene follows the mouse: {aside}");
    window.rest();
    assert_eq!(window.fake.wanted().camera, after.camera);
}

#[test]
fn other_buttons_look_around_and_pan() {
    let mut window = Window::with("cornell.glb");
    let before = window.state().pose().unwrap().camera;
    let (from, to) = (window.at(0.5, 0.5), window.at(0.6, 0.5));
    window.drag(from, to, PointerButton::Secondary, |_| {});
    let looked = window.state().pose().unwrap().camera;
    assert!((looked.origin - before.origin).length() < 1e-5 && looked.forward != before.forward);
    window.drag(from, to, PointerButton::Middle, |_| {});
    let panned = window.state().pose().unwrap().camera;
    assert!((panned.forward - looked.forward).length() < 1e-4 && panned.origin != looked.origin);
}

#[test]
fn the_wheel_comes_closer_and_keys_fly() {
    let mut window = Window::with("cornell.glb");
    let before = window.state().pose().unwrap();
    let middle = window.at(0.5, 0.5);
    window.ui.event(egui::Event::PointerMoved(middle));
    window.ui.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        delta: egui::vec2(0.0, 3.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    window.steps(30);
    let near = window.state().pose().unwrap();
    assert!(near.reach < 0.9 * before.reach, "{} {}", near.reach, before.reach);
    window.rest();
    window.ui.key_down(Key::W);
    window.steps(10);
    window.ui.key_up(Key::W);
    window.steps(1);
    let flown = window.state().pose().unwrap().camera;
    assert!((flown.origin - near.camera.origin).dot(near.camera.forward) > 0.0);
    window.rest();
    window.steps(5);
    assert_eq!(window.state().pose().unwrap().camera, flown, "keys that were let go do nothing");
}

#[test]
fn framing_undoes_being_lost_and_views_can_be_taken_back() {
    let mut window = Window::with("cornell.glb");
    let first = window.fake.wanted().camera;
    window.press(Modifiers::NONE, Key::F);
    window.rest();
    let framed = window.fake.wanted().camera;
    assert_ne!(first, framed);
    window.press(Modifiers::ALT, Key::ArrowLeft);
    window.rest();
    assert_eq!(window.fake.wanted().camera, first);
    window.press(Modifiers::ALT, Key::ArrowRight);
    window.rest();
    assert_eq!(window.fake.wanted().camera, framed);
}

#[test]
fn bookmarks_come_back_to_a_view() {
    let mut window = Window::with("cornell.glb");
    window.press(Modifiers::NONE, Key::F);
    window.rest();
    let kept = window.fake.wanted().camera;
    window.press(Modifiers::COMMAND, Key::Num1);
    let (from, to) = (window.at(0.5, 0.5), window.at(0.8, 0.4));
    window.drag(from, to, PointerButton::Primary, |_| {});
    window.rest();
    assert_ne!(window.fake.wanted().camera, kept);
    window.press(Modifiers::NONE, Key::Num1);
    window.rest();
    assert_eq!(window.fake.wanted().camera, kept);
}

#[test]
fn a_double_click_brings_what_it_meets_scrolled_to() {
    let mut window = Window::with("cornell.glb");
    let before = window.fake.wanted().camera;
    let place = window.at(0.4, 0.6);
    window.click(place);
    window.click(place);
    assert_eq!(window.fake.told(|t| t.picks.len()), 1, "one question at a time");
    let asked = window.fake.told(|t| t.picks[0]);
    assert!((asked[0] - 0.4).abs() < 0.01 && (asked[1] - 0.6).abs() < 0.01, "{asked:?}");
    let node = shown_node(&window);
    let picked = Picked {
        node,
        material: Some(MaterialId(0)),
        triangle: 0,
        point: Vec3::ZERO,
        normal: Vec3::Y,
        distance: 1.0,
    };
    assert!(!window.shows("Roughness"));
    window.fake.happens(Event::Picked(Some(picked)));
    window.steps(40);
    assert_eq!(window.state().selection.material, Some(MaterialId(0)));
    assert!(window.shows("Roughness"), "its material unfolds");
    assert_eq!(window.fake.wanted().camera, before, "a click alone leaves the camera");
    window.fake.happens(Event::Picked(Some(picked)));
    window.rest();
    assert_ne!(window.fake.wanted().camera, before);
}

/// A node that has a shape.
pub(crate) fn shown_node(window: &Window) -> NodeId {
    let scene = &window.fake.wanted().scene;
    let shown = scene.nodes.iter().position(|n| n.mesh.is_some()).unwrap();
    NodeId(shown as u32)
}

#[test]
fn focus_follows_a_click_and_the_centre() {
    let mut window = Window::with("cornell.glb");
    window.unfold("Camera");
    window.state_mut().set(lumbre::edits::Item::Camera, "aperture", lumbre::edits::Value::Number(0.1));
    window.state_mut().stir();
    window.rest();
    assert!(window.fake.wanted().camera.lens_radius > 0.0);
    assert_eq!(window.fake.told(|t| t.picks.clone()), [[0.5, 0.5]], "automatic: what lies in the centre");
    let camera = window.fake.wanted().camera;
    let answer = |metres: f32| Picked {
        node: NodeId(0),
        material: None,
        triangle: 0,
        point: camera.origin + camera.forward * metres,
        normal: Vec3::Y,
        distance: metres,
    };
    window.fake.happens(Event::Picked(Some(answer(2.0))));
    window.steps(2);
    assert!((window.fake.wanted().camera.focus_distance - 2.0).abs() < 1e-4);
    window.press(Modifiers::NONE, Key::T);
    let place = window.at(0.2, 0.2);
    window.click(place);
    window.fake.happens(Event::Picked(Some(answer(3.5))));
    window.steps(2);
    assert!((window.fake.wanted().camera.focus_distance - 3.5).abs() < 1e-4);
    assert_eq!(window.state().selection.item, None, "it picks nothing");
}

#[test]
fn moving_the_camera_leaves_the_scene_as_it_is() {
    let mut window = Window::with("cornell.glb");
    let before = window.fake.wanted().scene;
    let (from, to) = (window.at(0.5, 0.5), window.at(0.6, 0.7));
    window.drag(from, to, PointerButton::Primary, |_| {});
    window.rest();
    assert!(Arc::ptr_eq(&before, &window.fake.wanted().scene));
    assert!(!window.state().document.as_ref().unwrap().history.can_undo(), "looking around is no edit");
}
