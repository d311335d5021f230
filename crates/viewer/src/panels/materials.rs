//! The material that is picked, by a click on the picture or in the list: every parameter of it.

use super::table;
use crate::command::Command;
use crate::state::State;
use eframe::egui::{ComboBox, Ui};
use lumbre::edits::Item;
use lumbre::scene::{MaterialId, Scene};

pub(super) fn show(ui: &mut Ui, state: &State, out: &mut Vec<Command>) {
    let Some(document) = &state.document else { return };
    let base = &document.base;
    if base.materials.is_empty() {
        ui.weak("The scene has no materials.");
        return;
    }
    let picked = state.selection.material.filter(|id| id.index() < base.materials.len());
    ui.horizontal(|ui| {
        let text = picked.map_or_else(|| "pick one, or click on the picture".to_owned(), |id| name(base, id));
        let list = ComboBox::from_id_salt("material").width(220.0).truncate().selected_text(text);
        list.show_ui(ui, |ui| {
            for i in 0..base.materials.len() as u32 {
                let id = MaterialId(i);
                if ui.selectable_label(picked == Some(id), name(base, id)).clicked() {
                    out.push(Command::PickMaterial(id));
                }
            }
        });
    });
    let Some(id) = picked else { return };
    let item = Item::Material(id);
    let changed = document.edits.changes(base, item).is_ok_and(|c| c.is_some());
    if ui.add_enabled(changed, eframe::egui::Button::new("As in the file")).clicked() {
        out.push(Command::Reset(item));
    }
    table(ui, state, item, out);
}

fn name(base: &Scene, id: MaterialId) -> String {
    let name = &base.materials[id.index()].name;
    if name.is_empty() { format!("material {}", id.0) } else { name.clone() }
}
