//! The question what becomes of edits that are not saved.

use crate::command::Command;
use crate::leaving::{Leave, Leaving};
use crate::state::State;
use eframe::egui::{Context, Id, Key, Modal, Ui};

/// Asks, while something waits for the answer and no file is being chosen.
pub fn show(window: &Context, state: &State, out: &mut Vec<Command>) {
    let (Some(leaving), Some(document), None, false) =
        (&state.leaving, &state.document, &state.dialog, state.writing)
    else {
        return;
    };
    let name = document.path.file_name().unwrap_or_default().to_string_lossy();
    let asked = Modal::new(Id::unique("leaving")).show(window, |ui| {
        ui.set_width(360.0);
        ui.heading("Save the edits?");
        ui.label(match leaving {
            Leaving::Close => format!("What was changed of {name} is in no file yet."),
            Leaving::Open(path) => {
                let other = path.file_name().unwrap_or_default().to_string_lossy();
                format!("What was changed of {name} is in no file yet, and {other} takes its place.")
            }
        });
        ui.add_space(8.0);
        ui.horizontal(buttons).inner
    });
    let away = asked.should_close() || window.input(|i| i.key_pressed(Key::Escape));
    let how = asked.inner.or(away.then_some(Leave::Stay));
    out.extend(how.map(Command::Leave));
}

fn buttons(ui: &mut Ui) -> Option<Leave> {
    let all = [("Save", Leave::Save), ("Discard", Leave::Discard), ("Stay", Leave::Stay)];
    all.into_iter().filter(|(text, _)| ui.button(*text).clicked()).map(|(_, how)| how).last()
}
