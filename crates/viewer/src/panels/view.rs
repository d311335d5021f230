//! What is shown of the picture: its layers, exposure, tone curve and lens.

use super::table;
use crate::command::Command;
use crate::state::State;
use eframe::egui::{ComboBox, Grid, Ui};
use lumbre::edits::Item;
use lumbre::session::Layer;

pub(super) fn show(ui: &mut Ui, state: &State, out: &mut Vec<Command>) {
    let mut running = state.running.clone();
    Grid::new("layer").num_columns(2).spacing([8.0, 5.0]).min_col_width(104.0).show(ui, |ui| {
        let label = ui.label("Layer");
        let list = ComboBox::from_id_salt("layer").selected_text(running.layer.name()).show_ui(ui, |ui| {
            for layer in Layer::ALL {
                ui.selectable_value(&mut running.layer, layer, layer.name());
            }
        });
        list.response.labelled_by(label.id).on_hover_text(meaning(running.layer));
        ui.end_row();
    });
    table(ui, state, Item::Look, out);
    ui.checkbox(&mut running.eased, "Exposure follows slowly, as an eye does");
    let mut signs = state.shown.signs;
    if ui.checkbox(&mut signs, "Show lights in the picture").changed() {
        out.push(Command::Signs(signs));
    }
    if running != state.running {
        running.preview = false;
        out.push(Command::Run(running));
    }
}

/// What a layer shows, for people.
fn meaning(layer: Layer) -> &'static str {
    match layer {
        Layer::Picture => "The picture",
        Layer::Albedo => "How much light the surface reflects, in which colour",
        Layer::Normal => "Where the surface faces",
        Layer::Depth => "How far it is: white is near",
        Layer::Error => "How noisy it still is: black is clean, yellow noisy",
        Layer::Samples => "How many samples each pixel has",
        Layer::Objects => "A colour for each object",
        Layer::NonFinite => "Pixels with samples that were no numbers, in red",
    }
}
