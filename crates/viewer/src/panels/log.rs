//! What happened.

use crate::command::Command;
use crate::log::Grade;
use crate::state::State;
use eframe::egui::{Label, RichText, ScrollArea, Ui};

pub(super) fn show(ui: &mut Ui, state: &State, _: &mut Vec<Command>) {
    if ui.button("Copy").clicked() {
        let lines = state.log.lines().iter().map(|l| format!("{:8.2} s  {}", l.at.as_secs_f64(), l.text));
        ui.ctx().copy_text(lines.collect::<Vec<_>>().join("\n"));
    }
    ScrollArea::vertical()
        .id_salt("log")
        .max_height(220.0)
        .auto_shrink([false, true])
        .stick_to_bottom(true)
        .show(ui, |ui| {
            for line in state.log.lines() {
                let text = RichText::new(format!("{:.1} s  {}", line.at.as_secs_f64(), line.text)).small();
                let text = match line.grade {
                    Grade::Note => text,
                    Grade::Warning => text.color(ui.visuals().warn_fg_color),
                    Grade::Error => text.color(ui.visuals().error_fg_color),
                };
                ui.add(Label::new(text).wrap());
            }
        });
}
