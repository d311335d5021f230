//! What stands where the picture will be while there is none, and errors above it.

use crate::command::Command;
use crate::dialog::Purpose;
use crate::state::State;
use eframe::egui::{self, Align2, Area, Color32, Frame, Id, Order, Rect, RichText, Stroke, Ui};

/// What to do first, or what is under way.
pub fn show(ctx: &egui::Context, state: &State, rect: Rect, out: &mut Vec<Command>) {
    let area = Area::new(Id::unique("welcome"))
        .order(Order::Middle)
        .pivot(Align2::CENTER_CENTER)
        .fixed_pos(rect.center());
    area.show(ctx, |ui| {
        ui.set_width(rect.width().clamp(120.0, 420.0));
        ui.vertical_centered(|ui| match waiting(state) {
            Some(what) => {
                ui.add(egui::Spinner::new().size(36.0));
                ui.add_space(8.0);
                ui.label(what);
            }
            None => invite(ui, state, out),
        });
    });
}

/// What is waited for.
fn waiting(state: &State) -> Option<String> {
    if let Some(path) = state.loader.under_way() {
        return Some(format!("opening {}", path.display()));
    }
    let first = || "the first frame is on its way".to_owned();
    state.document.as_ref().map(|_| state.preparing.clone().unwrap_or_else(first))
}

fn invite(ui: &mut Ui, state: &State, out: &mut Vec<Command>) {
    ui.label(RichText::new("Lumbre").size(34.0).strong());
    ui.add_space(6.0);
    ui.label("Drop a scene here: glTF, OBJ, PLY or STL.");
    ui.add_space(10.0);
    if ui.button(RichText::new("Open a scene…").size(16.0)).clicked() {
        out.push(Command::Ask(Purpose::Open));
    }
    ui.add_space(14.0);
    for path in state.recent.paths().iter().take(6) {
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        if ui.link(name).on_hover_text(path.display().to_string()).clicked() {
            out.push(Command::Open(path.clone()));
        }
    }
}

/// The last error, until it is put away.
pub fn banner(ctx: &egui::Context, state: &State, rect: Rect, out: &mut Vec<Command>) {
    let Some(error) = state.log.pending() else { return };
    let width = (rect.width() - 40.0).clamp(120.0, 640.0);
    Area::new(Id::unique("error"))
        .order(Order::Foreground)
        .pivot(Align2::CENTER_TOP)
        .fixed_pos(rect.center_top() + egui::vec2(0.0, 12.0))
        .show(ctx, |ui| {
            Frame::popup(ui.style())
                .fill(Color32::from_rgb(84, 26, 26))
                .stroke(Stroke::new(1.0, Color32::from_rgb(200, 80, 80)))
                .show(ui, |ui| {
                    ui.set_width(width);
                    ui.horizontal(|ui| {
                        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                            if ui.button("Dismiss").clicked() {
                                out.push(Command::PutAway);
                            }
                            ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                                ui.add(egui::Label::new(RichText::new(error).color(Color32::WHITE)).wrap());
                            });
                        });
                    });
                });
        });
}
