//! What is seen of the window itself.

use crate::kit::{Window, asset};
use eframe::egui::{Key, Modifiers};
use lumbre::session::{Event, Layer};

#[test]
fn an_empty_window_invites() {
    let mut window = Window::empty();
    assert!(window.shows("Drop a scene here"));
    window.click_on("Open a scene…");
    assert!(window.state().dialog.is_some());
    window.press(Modifiers::NONE, Key::Escape);
    assert!(window.state().dialog.is_none());
    assert_eq!(window.fake.count(), 0, "there is nothing to draw");
}

#[test]
fn f10_leaves_the_picture_alone_and_f1_helps() {
    let mut window = Window::with("cornell.glb");
    let with_panels = window.fake.wanted().size;
    window.press(Modifiers::NONE, Key::F10);
    window.steps(3);
    let rect = window.picture();
    assert!(rect.width() > 1250.0 && rect.height() > 770.0, "{rect:?}");
    assert_eq!(window.fake.wanted().size, [rect.width(), rect.height()].map(|n| n.round() as u32));
    assert!(!window.shows("Render"));
    window.press(Modifiers::NONE, Key::F10);
    window.steps(3);
    assert_eq!(window.fake.wanted().size, with_panels);
    window.press(Modifiers::NONE, Key::F1);
    assert!(window.shows("Keys and mouse"));
    for binding in lumbre_viewer::input::BINDINGS {
        assert!(window.shows(binding.help), "{}", binding.help);
    }
    window.press(Modifiers::NONE, Key::F1);
    assert!(!window.state().shown.help);
}

#[test]
fn every_panel_unfolds() {
    let mut window = Window::with("lanterns.glb");
    for panel in ["Camera", "Lights", "Scene", "Material", "Log"] {
        window.unfold(panel);
    }
    // One thing of each.
    for text in ["Flying speed", "Sky and environment", "Copy", "opened in"] {
        assert!(window.shows(text), "{text}");
    }
}

#[test]
fn layers_are_views_of_the_same_samples() {
    let mut window = Window::with("cornell.glb");
    let before = window.fake.wanted();
    for layer in Layer::ALL.into_iter().skip(1).chain([Layer::Picture]) {
        window.press(Modifiers::NONE, Key::V);
        assert_eq!(window.fake.wanted().layer, layer);
    }
    let after = window.fake.wanted();
    assert_eq!((before.camera, before.settings, before.size), (after.camera, after.settings, after.size));
}

#[test]
fn the_picture_has_the_pixels_of_the_screen() {
    for scale in [1.0, 1.5, 2.0] {
        let mut window = Window::sized([900.0, 600.0], scale);
        window.open(&asset("cornell.glb"));
        let rect = window.picture();
        let want = [rect.width() * scale, rect.height() * scale].map(|n| n.round() as u32);
        assert_eq!(window.fake.wanted().size, want, "{scale}");
        assert!((window.fake.wanted().camera.aspect - want[0] as f32 / want[1] as f32).abs() < 1e-5);
        window.ui.set_size(eframe::egui::vec2(1100.0, 500.0));
        window.steps(3);
        assert_ne!(window.fake.wanted().size, want, "it follows the window");
        // So small that nothing is left of the picture.
        window.ui.set_size(eframe::egui::vec2(60.0, 30.0));
        window.steps(3);
        assert!(!window.fake.wanted().size.contains(&0));
    }
}

#[test]
fn statistics_tell_what_the_frames_said() {
    let mut window = Window::with("cornell.glb");
    for spp in 2..30 {
        window.fake.draw(spp);
        window.steps(1);
    }
    assert!(window.shows("29 per pixel") && window.shows("Stand-in"));
    assert!(window.shows("29 / 4096 samples"));
    let (all, _) = window.state().meter.update_counts();
    let (_, longest) = window.state().meter.updates();
    assert!(all > 30);
    println!("longest step of the interface: {longest:?}");
}

#[test]
fn what_the_session_says_is_told() {
    let mut window = Window::with("cornell.glb");
    window.fake.happens(Event::Notice("device lost; going on with the CPU".into()));
    window.steps(2);
    assert!(window.shows("going on with the CPU"));
    window.fake.happens(Event::Preparing("compiling the scene".into()));
    window.steps(2);
    assert!(window.shows("compiling the scene"));
}

#[test]
fn another_device_is_wanted_where_it_is_chosen() {
    let mut window = Window::with("cornell.glb");
    let running =
        lumbre_viewer::state::Running { device: lumbre::Device::Cpu, ..window.state().running.clone() };
    let context = eframe::egui::Context::default();
    window.state_mut().obey(lumbre_viewer::command::Command::Run(running), &context);
    window.steps(2);
    assert_eq!(window.fake.wanted().device, lumbre::Device::Cpu);
    window.fake.prepared("CPU (2 threads)", 0.2);
    window.steps(2);
    assert!(window.shows("on CPU (2 threads)"));
}
