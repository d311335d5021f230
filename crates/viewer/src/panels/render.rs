//! How the picture is made: device, pace, and the settings of the integrator.

use super::table;
use crate::command::Command;
use crate::input::{Action, keys_of};
use crate::state::{Running, State};
use eframe::egui::{ComboBox, DragValue, Grid, Slider, Ui};
use lumbre::Device;
use lumbre::edits::Item;

pub(super) fn show(ui: &mut Ui, state: &State, out: &mut Vec<Command>) {
    let mut running = state.running.clone();
    buttons(ui, &running, out);
    Grid::new("pace").num_columns(2).spacing([8.0, 5.0]).min_col_width(104.0).show(ui, |ui| {
        device(ui, state, &mut running);
        pace(ui, &mut running);
    });
    ui.checkbox(&mut running.vsync, "Wait for the display (vsync)")
        .on_hover_text("The window is opened anew, which takes a moment.");
    if running != state.running {
        out.push(Command::Run(running));
    }
    if state.document.is_some() {
        ui.separator();
        table(ui, state, Item::Settings, out);
        ui.separator();
        keep(ui, out);
    }
}

/// What is kept of it all.
fn keep(ui: &mut Ui, out: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        for (text, action) in [("Save picture…", Action::SavePicture), ("Save edits…", Action::SaveEdits)]
        {
            if ui.button(text).on_hover_text(keys_of(action)).clicked() {
                out.push(Command::Do(action));
            }
        }
        let copy = ui.button("Copy command");
        if copy.on_hover_text("The line that makes `lumbre render` draw this").clicked() {
            out.push(Command::CopyCommand);
        }
    });
}

fn buttons(ui: &mut Ui, running: &Running, out: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        let text = if running.paused { "▶ Go on" } else { "⏸ Pause" };
        if ui.button(text).on_hover_text(keys_of(Action::Pause)).clicked() {
            out.push(Command::Do(Action::Pause));
        }
        if ui.button("⟲ Begin anew").on_hover_text(keys_of(Action::Restart)).clicked() {
            out.push(Command::Do(Action::Restart));
        }
        if ui.selectable_label(running.preview, "Preview").on_hover_text(keys_of(Action::Preview)).clicked() {
            out.push(Command::Do(Action::Preview));
        }
    });
}

fn device(ui: &mut Ui, state: &State, running: &mut Running) {
    let label = ui.label("Device");
    let known = [("Automatic".to_owned(), Device::Auto), ("CPU".to_owned(), Device::Cpu)];
    let gpus = state.devices.iter().filter(|(_, device)| *device != Device::Cpu).cloned();
    let all: Vec<(String, Device)> = known.into_iter().chain(gpus).collect();
    let chosen = all.iter().find(|(_, device)| *device == running.device);
    let text = chosen.map_or_else(|| running.device.to_string(), |(name, _)| name.clone());
    let list =
        ComboBox::from_id_salt("device").width(150.0).truncate().selected_text(text).show_ui(ui, |ui| {
            for (name, device) in all {
                ui.selectable_value(&mut running.device, device, name);
            }
        });
    list.response.labelled_by(label.id).on_hover_text(&state.stats.device);
    ui.end_row();
}

fn pace(ui: &mut Ui, running: &mut Running) {
    let label = ui.label("Samples per frame");
    ui.add(Slider::new(&mut running.samples_per_frame, 1..=64).logarithmic(true)).labelled_by(label.id);
    ui.end_row();
    let label = ui.label("Samples in all");
    ui.add(DragValue::new(&mut running.limit).range(1..=1_000_000).speed(4.0)).labelled_by(label.id);
    ui.end_row();
}
