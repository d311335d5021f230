//! Lights: the sun, the sky, and lamps of the file and added ones.

use super::table;
use crate::command::Command;
use crate::dialog::Purpose;
use crate::state::State;
use eframe::egui::{CollapsingHeader, ScrollArea, Ui};
use lumbre::edits::{Edits, Item};
use lumbre::scene::{NodeId, Scene};

pub(super) fn show(ui: &mut Ui, state: &State, out: &mut Vec<Command>) {
    let Some(document) = &state.document else { return };
    CollapsingHeader::new("Sun").default_open(true).show(ui, |ui| table(ui, state, Item::Sun, out));
    CollapsingHeader::new("Sky and environment").default_open(true).show(ui, |ui| {
        table(ui, state, Item::Sky, out);
        if ui.button("Choose a picture of the surroundings…").clicked() {
            out.push(Command::Ask(Purpose::Environment));
        }
    });
    ui.horizontal(|ui| {
        ui.label("Add");
        for (text, kind) in [("Point", "point"), ("Spot", "spot"), ("Directional", "directional")] {
            if ui.button(text).clicked() {
                out.push(Command::AddLight(kind));
            }
        }
    });
    list(ui, state, &document.base, &document.edits, out);
    if let Some(item @ (Item::Light(_) | Item::Added(_))) = state.selection.item {
        ui.separator();
        ui.horizontal(|ui| {
            ui.strong(name(&document.base, &document.edits, item));
            if ui.button("Remove").clicked() {
                out.push(Command::RemoveLight(item));
            }
        });
        table(ui, state, item, out);
    }
}

fn list(ui: &mut Ui, state: &State, base: &Scene, edits: &Edits, out: &mut Vec<Command>) {
    let of_file = base.nodes.iter().enumerate().filter(|(_, n)| n.light.is_some());
    let of_file = of_file.map(|(i, _)| Item::Light(NodeId(i as u32)));
    let all: Vec<Item> = of_file.chain((0..edits.added_lights().len()).map(Item::Added)).collect();
    if all.is_empty() {
        ui.weak("No lamps. Surfaces that glow are materials.");
        return;
    }
    let height = ui.text_style_height(&eframe::egui::TextStyle::Body) + 4.0;
    ScrollArea::vertical().id_salt("lights").max_height(140.0).show_rows(
        ui,
        height,
        all.len(),
        |ui, range| {
            for item in &all[range] {
                let picked = state.selection.item == Some(*item);
                if ui.selectable_label(picked, name(base, edits, *item)).clicked() {
                    out.push(Command::Pick(*item));
                }
            }
        },
    );
}

fn name(base: &Scene, edits: &Edits, item: Item) -> String {
    match item {
        Item::Light(node) => {
            let node = &base.nodes[node.index()];
            let light = node.light.and_then(|l| base.lights.get(l.index()));
            let own = light.map_or("", |l| &*l.name);
            let name = if node.name.is_empty() { own } else { &node.name };
            if name.is_empty() { "light without a name".into() } else { name.to_owned() }
        }
        Item::Added(i) => {
            edits.added_lights().get(i).map_or_else(String::new, |l| format!("{} (added)", l.name))
        }
        _ => String::new(),
    }
}
