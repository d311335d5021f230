//! How fast it goes: frames rendered and shown, rays, passes of the GPU, memory, and a plot of frame times.

use crate::command::Command;
use crate::meter::{LIMIT, PLOTTED};
use crate::state::State;
use eframe::egui::{self, Color32, Grid, Pos2, Sense, Stroke, Ui};
use std::time::Instant;

pub(super) fn show(ui: &mut Ui, state: &State, _: &mut Vec<Command>) {
    let (stats, meter, now) = (&state.stats, &state.meter, Instant::now());
    plot(ui, state);
    Grid::new("statistics").num_columns(2).spacing([8.0, 3.0]).min_col_width(104.0).show(ui, |ui| {
        let mut row = |name: &str, value: String| {
            ui.label(name);
            ui.monospace(value);
            ui.end_row();
        };
        row("Rendered", format!("{:.1} fps, {:.1} ms", meter.rendered_fps(now), meter.mean_ms()));
        row("Shown", format!("{:.1} fps", meter.shown_fps(now)));
        let (rays, samples) = meter.millions();
        row("Rays", format!("{rays:.2} M/s"));
        row("Camera samples", format!("{samples:.2} M/s"));
        row("Samples so far", format!("{} per pixel", stats.spp));
        row("Since the start", count(meter.samples()));
        row("Time", format!("{:.1} s", stats.since));
        row("Error (relMSE)", stats.error.map_or_else(|| "not known yet".into(), |e| format!("{e:.5}")));
        row("Resolution", resolution(state));
        row("Memory", format!("{:.1} MiB", stats.memory as f64 / f64::from(1 << 20)));
        row("Exposure", format!("{:+.2} EV", stats.exposure_ev));
        if stats.non_finite > 0 {
            row("Not finite", stats.non_finite.to_string());
        }
        for pass in &stats.passes {
            row(pass.name, format!("{:.2} ms", pass.total_ms));
        }
        let (last, longest) = meter.updates();
        let ms = |d: std::time::Duration| d.as_secs_f64() * 1e3;
        row("Interface", format!("{:.1} ms, at most {:.1} ms", ms(last), ms(longest)));
        row("Answer", format!("{:.0} ms", ms(meter.answer())));
        let (all, long) = meter.update_counts();
        if long > 0 {
            row("Interface, slow", format!("{long} of {all} over {} ms", LIMIT.as_millis()));
        }
    });
    ui.weak(&stats.device);
}

/// Pixels of the picture, and how rough the frame is.
fn resolution(state: &State) -> String {
    let [width, height] = state.size;
    match state.stats.scale {
        0 | 1 => format!("{width} x {height}"),
        scale => format!("{width} x {height} / {scale}"),
    }
}

fn count(n: u64) -> String {
    match n {
        0..10_000 => format!("{n} samples"),
        10_000..10_000_000 => format!("{:.2} M samples", n as f64 * 1e-6),
        _ => format!("{:.1} M samples", n as f64 * 1e-6),
    }
}

/// Times of the last frames as bars, with a line at a 60th of a second.
fn plot(ui: &mut Ui, state: &State) {
    let size = egui::vec2(ui.available_width(), 56.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 3.0, ui.visuals().extreme_bg_color);
    let times = state.meter.plot();
    if times.len() == 0 {
        return;
    }
    let most = state.meter.plot().fold(1.0f32, f32::max) * 1.1;
    let width = rect.width() / PLOTTED as f32;
    let height = |ms: f32| rect.max.y - rect.height() * ms / most;
    // The newest stands at the right edge.
    let left = rect.max.x - width * times.len() as f32;
    for (i, ms) in times.enumerate() {
        let x = left + width * i as f32;
        let bar =
            egui::Rect::from_min_max(Pos2::new(x, height(ms)), Pos2::new(x + width.max(1.0), rect.max.y));
        painter.rect_filled(bar, 0.0, Color32::from_rgb(110, 160, 230));
    }
    if most > 1000.0 / 60.0 {
        let y = height(1000.0 / 60.0);
        painter.line_segment(
            [Pos2::new(rect.min.x, y), Pos2::new(rect.max.x, y)],
            Stroke::new(1.0, Color32::from_gray(110)),
        );
    }
    let text = format!("{most:.0} ms");
    painter.text(
        rect.min + egui::vec2(4.0, 2.0),
        egui::Align2::LEFT_TOP,
        text,
        egui::FontId::proportional(10.0),
        ui.visuals().weak_text_color(),
    );
    response.on_hover_text("Milliseconds that each of the last frames took; the line is a 60th of a second");
}
