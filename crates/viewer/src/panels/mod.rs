//! The panels: each reads the state and says what is to be done; none changes anything.

mod camera;
mod help;
mod leaving;
mod lights;
mod log;
mod materials;
mod menu;
mod render;
pub mod rows;
mod statistics;
mod status;
mod tree;
mod view;
mod welcome;

pub use help::show as help;
pub use leaving::show as leaving;
pub use menu::show as menu;
pub use status::show as status;
pub use welcome::{banner, show as welcome};

use crate::command::Command;
use crate::state::State;
use eframe::egui::{CollapsingHeader, RichText, ScrollArea, Ui};
use lumbre::edits::Item;

/// A panel of the side bar.
type Panel = fn(&mut Ui, &State, &mut Vec<Command>);

/// All of them: what most people want stands on top, and open.
const PANELS: [(&str, bool, Panel); 8] = [
    ("Render", true, render::show),
    ("Camera", false, camera::show),
    ("View", true, view::show),
    ("Lights", false, lights::show),
    ("Scene", false, tree::show),
    ("Material", false, materials::show),
    ("Statistics", true, statistics::show),
    ("Log", false, log::show),
];

/// The side bar.
pub fn side_bar(ui: &mut Ui, state: &State, out: &mut Vec<Command>) {
    // In both directions: a row that is too long must not widen the bar, which would begin the picture anew.
    ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        ui.add_space(2.0);
        for (name, open, show) in PANELS {
            let heading = RichText::new(name).strong();
            // The panel of what was picked comes into view by itself.
            let wanted = state.unfold == Some(name);
            let header = CollapsingHeader::new(heading).id_salt(name).default_open(open);
            let shown = header.open(wanted.then_some(true)).show(ui, |ui| {
                if state.document.is_some() || matches!(name, "Render" | "Statistics" | "Log") {
                    show(ui, state, out);
                } else {
                    ui.weak("Open a scene first.");
                }
            });
            if wanted {
                shown.header_response.scroll_to_me(None);
            }
            ui.separator();
        }
    });
}

/// The table of a thing.
fn table(ui: &mut Ui, state: &State, item: Item, out: &mut Vec<Command>) {
    table_of(ui, state, item, &[], out);
}

/// The same without some of its rows, which are shown in another way.
fn table_of(ui: &mut Ui, state: &State, item: Item, without: &[&str], out: &mut Vec<Command>) {
    let (Some(document), Some(camera)) = (&state.document, state.camera()) else { return };
    match document.edits.rows(&document.base, &camera, item) {
        Ok(mut all) => {
            all.retain(|row| !without.contains(&row.name));
            if let Some(done) = rows::rows(ui, item, &all) {
                out.push(Command::Row(item, done));
            }
        }
        Err(e) => {
            ui.weak(e.to_string());
        }
    }
}
