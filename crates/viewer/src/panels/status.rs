//! The line at the bottom: what draws, how far it is, and what happened last.

use crate::log::Grade;
use crate::state::State;
use eframe::egui::{Label, ProgressBar, RichText, Ui};
use std::time::Instant;

/// Frames a second, or seconds a frame where that says more.
fn pace(fps: f64) -> String {
    match fps {
        1.0.. => format!("{fps:.1} fps"),
        0.01.. => format!("{:.1} s per frame", 1.0 / fps),
        _ => String::new(),
    }
}

/// Shows the line.
pub fn show(ui: &mut Ui, state: &State) {
    ui.horizontal(|ui| {
        let stats = &state.stats;
        if let Some(path) = state.loader.under_way() {
            ui.spinner();
            let what = if state.writing { "saving" } else { "opening" };
            ui.label(format!("{what} {}", path.file_name().unwrap_or_default().to_string_lossy()));
        } else if let Some(what) = &state.preparing {
            ui.spinner();
            ui.label(what);
        } else if state.document.is_some() {
            let limit = state.running.limit.max(1);
            let share = stats.spp as f32 / limit as f32;
            let text = format!("{} / {limit} samples", stats.spp);
            ui.add(
                ProgressBar::new(share.clamp(0.0, 1.0))
                    .desired_width(150.0)
                    .text(RichText::new(text).small()),
            );
            let doing = match (state.running.paused, stats.done) {
                (true, _) => "paused".to_owned(),
                (_, true) => "done".to_owned(),
                _ => pace(state.meter.rendered_fps(Instant::now())),
            };
            ui.label(doing);
            ui.separator();
            ui.label(&stats.device);
        } else {
            ui.weak("F1: keys");
        }
        if state.focus_by_click {
            ui.separator();
            ui.colored_label(ui.visuals().warn_fg_color, "click on what is to be sharp (Esc: no)");
        }
        if let Some(line) = state.log.last() {
            ui.separator();
            let text = RichText::new(&line.text);
            let text = match line.grade {
                Grade::Note => text.weak(),
                Grade::Warning => text.color(ui.visuals().warn_fg_color),
                Grade::Error => text.color(ui.visuals().error_fg_color),
            };
            ui.add(Label::new(text).truncate());
        }
    });
}
