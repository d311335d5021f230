//! The bar on top.

use crate::command::Command;
use crate::dialog::Purpose;
use crate::input::{Action, keys_of};
use crate::state::State;
use eframe::egui::{Button, MenuBar, Ui};

/// Shows the bar.
pub fn show(ui: &mut Ui, state: &State, out: &mut Vec<Command>) {
    MenuBar::new().ui(ui, |ui| {
        ui.menu_button("File", |ui| file(ui, state, out));
        ui.menu_button("Edit", |ui| {
            let history = state.document.as_ref().map(|d| &d.history);
            item(ui, "Undo", Action::Undo, history.is_some_and(|h| h.can_undo()), out);
            item(ui, "Redo", Action::Redo, history.is_some_and(|h| h.can_redo()), out);
            ui.separator();
            let picked = state.selection.item.is_some();
            item(ui, "Hide or show what is picked", Action::Hide, picked, out);
            item(ui, "Pick nothing", Action::Deselect, picked, out);
        });
        ui.menu_button("Camera", |ui| {
            let open = state.document.is_some();
            item(ui, "Everything into view", Action::FrameAll, open, out);
            item(ui, "What is picked into view", Action::FramePicked, state.selection.item.is_some(), out);
            item(ui, "Next camera of the scene", Action::NextCamera, open, out);
            item(ui, "Back", Action::ViewBack, open, out);
            item(ui, "Forward", Action::ViewForward, open, out);
            item(ui, "Focus by a click", Action::FocusByClick, open, out);
        });
        ui.menu_button("View", |ui| {
            item(ui, "Next layer", Action::NextLayer, true, out);
            item(ui, "Quick preview", Action::Preview, true, out);
            item(ui, "Automatic exposure", Action::AutoExposure, state.document.is_some(), out);
            ui.separator();
            item(ui, "Hide all panels", Action::Panels, true, out);
            item(ui, "Full screen", Action::FullScreen, true, out);
        });
        ui.menu_button("Help", |ui| item(ui, "Keys and mouse", Action::Help, true, out));
    });
}

fn file(ui: &mut Ui, state: &State, out: &mut Vec<Command>) {
    let open = state.document.is_some();
    item(ui, "Open…", Action::Open, true, out);
    ui.menu_button("Recent", |ui| {
        if state.recent.paths().is_empty() {
            ui.weak("nothing yet");
        }
        for path in state.recent.paths() {
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
            if ui.button(name).on_hover_text(path.display().to_string()).clicked() {
                out.push(Command::Open(path.clone()));
            }
        }
    });
    if ui.add_enabled(open, Button::new("Environment…")).clicked() {
        out.push(Command::Ask(Purpose::Environment));
    }
    let mut watching = state.watching;
    if ui.checkbox(&mut watching, "Reload when the file changes").changed() {
        out.push(Command::Watch(watching));
    }
    ui.separator();
    item(ui, "Save the picture…", Action::SavePicture, open, out);
    item(ui, "Save the edits…", Action::SaveEdits, open, out);
    if ui.add_enabled(open, Button::new("Copy the command that renders this")).clicked() {
        out.push(Command::CopyCommand);
    }
    ui.separator();
    item(ui, "Quit", Action::Quit, true, out);
}

fn item(ui: &mut Ui, text: &str, action: Action, enabled: bool, out: &mut Vec<Command>) {
    let button = Button::new(text).shortcut_text(keys_of(action));
    if ui.add_enabled(enabled, button).clicked() {
        out.push(Command::Do(action));
        ui.close();
    }
}
