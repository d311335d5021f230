//! The camera: those of the file, bookmarks, the lens, and how fast one flies.

use super::table_of;
use crate::command::Command;
use crate::input::{Action, keys_of};
use crate::state::State;
use eframe::egui::{ComboBox, Grid, Slider, Ui};
use lumbre::edits::Item;

pub(super) fn show(ui: &mut Ui, state: &State, out: &mut Vec<Command>) {
    Grid::new("camera").num_columns(2).spacing([8.0, 5.0]).min_col_width(104.0).show(ui, |ui| {
        of_file(ui, state, out);
        let label = ui.label("Flying speed");
        let mut speed = state.speed;
        let slider = Slider::new(&mut speed, 0.05..=20.0).logarithmic(true).max_decimals(2).suffix(" x");
        if ui.add(slider).labelled_by(label.id).changed() {
            out.push(Command::Speed(speed));
        }
        ui.end_row();
    });
    ui.horizontal_wrapped(|ui| {
        for (text, action) in [
            ("Frame all", Action::FrameAll),
            ("Frame picked", Action::FramePicked),
            ("Back", Action::ViewBack),
            ("Forward", Action::ViewForward),
        ] {
            if ui.button(text).on_hover_text(keys_of(action)).clicked() {
                out.push(Command::Do(action));
            }
        }
        let chosen = ui.selectable_label(state.focus_by_click, "Focus by a click");
        if chosen.on_hover_text(keys_of(Action::FocusByClick)).clicked() {
            out.push(Command::Do(Action::FocusByClick));
        }
    });
    table_of(ui, state, Item::Camera, &["camera", "up"], out);
    bookmarks(ui, state, out);
}

fn of_file(ui: &mut Ui, state: &State, out: &mut Vec<Command>) {
    let Some(document) = &state.document else { return };
    let label = ui.label("Of the file");
    let names = &document.cameras;
    if names.is_empty() {
        ui.weak("none");
        return ui.end_row();
    }
    let changes = &document.edits.camera;
    let chosen = document.camera();
    let walked = changes.get("eye").is_some();
    let text = names.get(chosen).map_or("", String::as_str);
    let text = if walked { format!("from {text}") } else { text.to_owned() };
    let list =
        ComboBox::from_id_salt("file camera").width(150.0).truncate().selected_text(text).show_ui(ui, |ui| {
            for (i, name) in names.iter().enumerate() {
                if ui.selectable_label(i == chosen && !walked, name).clicked() {
                    out.push(Command::FileCamera(i));
                }
            }
        });
    list.response.labelled_by(label.id);
    ui.end_row();
}

fn bookmarks(ui: &mut Ui, state: &State, out: &mut Vec<Command>) {
    let Some(document) = &state.document else { return };
    ui.horizontal_wrapped(|ui| {
        ui.label("Bookmarks");
        for (i, bookmark) in document.edits.bookmarks.iter().enumerate() {
            let key = if i < 9 { format!("key {}", i + 1) } else { String::new() };
            let button = ui.button(&bookmark.name).on_hover_text(format!("{key}; right click removes it"));
            if button.clicked() {
                out.push(Command::GoTo(i));
            }
            if button.secondary_clicked() {
                out.push(Command::Forget(i));
            }
        }
        let next = document.edits.bookmarks.len().min(usize::from(u8::MAX)) as u8;
        if ui.button("+").on_hover_text("Keep this view (Ctrl+1 … Ctrl+9)").clicked() {
            out.push(Command::Do(Action::Bookmark(next)));
        }
    });
}
