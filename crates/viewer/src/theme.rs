//! How the window looks: dark and without colour, so that the picture is seen as it is.

use eframe::egui::{Context, CornerRadius, Theme, ThemePreference, Visuals};

/// Dresses a window.
pub fn set(window: &Context) {
    window.set_theme(ThemePreference::Dark);
    let mut visuals = Visuals::dark();
    for widget in [
        &mut visuals.widgets.noninteractive,
        &mut visuals.widgets.inactive,
        &mut visuals.widgets.hovered,
        &mut visuals.widgets.active,
        &mut visuals.widgets.open,
    ] {
        widget.corner_radius = CornerRadius::same(3);
    }
    // Text that is read, not guessed.
    visuals.widgets.noninteractive.fg_stroke.color = eframe::egui::Color32::from_gray(190);
    visuals.slider_trailing_fill = true;
    window.set_visuals_of(Theme::Dark, visuals);
    window.style_mut_of(Theme::Dark, |style| {
        style.spacing.item_spacing = [8.0, 5.0].into();
        style.spacing.slider_width = 120.0;
    });
}
