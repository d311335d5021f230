//! All keys, and what the mouse does: the same table that the window obeys.

use crate::input::{BINDINGS, GESTURES, Group, keys_text};
use eframe::egui::{self, Context, Grid, RichText, ScrollArea, Ui, Window};

/// Shows the help; whether it stays open.
pub fn show(ctx: &Context) -> bool {
    let mut open = true;
    Window::new("Keys and mouse")
        .open(&mut open)
        .collapsible(false)
        .pivot(egui::Align2::CENTER_CENTER)
        .default_pos(ctx.content_rect().center())
        .default_size([700.0, 610.0])
        .show(ctx, |ui| {
            ScrollArea::vertical().show(ui, |ui| {
                ui.columns(2, |columns| {
                    for (i, group) in Group::ALL.into_iter().enumerate() {
                        // The camera has as many rows as the others together.
                        self::group(&mut columns[usize::from(i > 1)], group);
                    }
                });
            });
        });
    open
}

fn group(ui: &mut Ui, group: Group) {
    ui.heading(group.name());
    Grid::new(group.name()).num_columns(2).spacing([14.0, 4.0]).striped(true).show(ui, |ui| {
        for (_, keys, help) in GESTURES.iter().filter(|(g, ..)| *g == group) {
            row(ui, keys, help);
        }
        for binding in BINDINGS.iter().filter(|b| b.group == group) {
            row(ui, &keys_text(binding.keys), binding.help);
        }
    });
    ui.add_space(10.0);
}

fn row(ui: &mut Ui, keys: &str, help: &str) {
    ui.label(RichText::new(keys).strong());
    ui.label(help);
    ui.end_row();
}
