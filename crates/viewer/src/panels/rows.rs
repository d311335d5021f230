//! Parameters as widgets: the tables of [`lumbre::edits`] say all there is to know of a parameter, and this says how a kind of value is
//! edited. Nothing here knows any parameter by name.

use eframe::egui::{
    self, Button, Color32, ComboBox, DragValue, Grid, Response, RichText, Slider, SliderClamping, Ui,
};
use glam::Vec3;
use lumbre::core::Rgb;
use lumbre::edits::{Item, Kind, Row, Value};
use std::ops::RangeInclusive;

/// What a person did to a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Done {
    /// Gave it another value.
    Set(&'static str, Value),
    /// Gave it back the file's.
    Unset(&'static str),
    /// Wants to choose a file for it.
    Browse(&'static str),
}

/// Shows the rows that apply, group by group, and says what was done.
pub fn rows(ui: &mut Ui, item: Item, rows: &[Row]) -> Option<Done> {
    let mut done = None;
    let mut rest = rows;
    while let Some(first) = rest.first() {
        let (group, after) = rest.split_at(rest.iter().take_while(|r| r.group == first.group).count());
        rest = after;
        let shown: Vec<&Row> = group.iter().filter(|r| r.applies).collect();
        if shown.is_empty() {
            continue;
        }
        if first.group.is_empty() {
            done = done.or(grid(ui, (item, ""), &shown));
            continue;
        }
        let changed = shown.iter().any(|r| r.changed);
        let heading = if changed { format!("{} •", first.group) } else { first.group.to_owned() };
        let header = egui::CollapsingHeader::new(heading).id_salt((item, first.group)).default_open(false);
        let inside = header.show(ui, |ui| grid(ui, (item, first.group), &shown));
        done = done.or(inside.body_returned.flatten());
    }
    done
}

fn grid(ui: &mut Ui, salt: (Item, &str), rows: &[&Row]) -> Option<Done> {
    let mut done = None;
    Grid::new(ui.make_persistent_id(salt)).num_columns(2).spacing([8.0, 5.0]).show(ui, |ui| {
        for row in rows {
            done = done.take().or(one(ui, row));
            ui.end_row();
        }
    });
    done
}

/// Width of a column of labels, points.
const LABEL: f32 = 104.0;

/// A row: its name, marked where it differs from the file, and its value.
fn one(ui: &mut Ui, row: &Row) -> Option<Done> {
    let label = ui
        .allocate_ui_with_layout(
            egui::vec2(LABEL, ui.spacing().interact_size.y),
            egui::Layout::left_to_right(egui::Align::Center),
            |ui| {
                ui.set_min_width(LABEL);
                let text = RichText::new(row.label);
                let text = if row.changed { text.strong() } else { text };
                ui.add(egui::Label::new(text).truncate())
            },
        )
        .inner;
    ui.horizontal(|ui| {
        let mut value = row.value.clone();
        let outcome = widget(ui, row, &mut value, &label);
        let mut done = match outcome {
            Outcome::Same => None,
            Outcome::Browse => Some(Done::Browse(row.name)),
            Outcome::Changed => row.kind.check(&value).is_ok().then_some(Done::Set(row.name, value)),
        };
        if row.changed {
            let back = ui.add(Button::new("×").small().frame(false)).on_hover_text("As in the file");
            name(&back, &format!("Reset {}", row.label));
            if back.clicked() {
                done = Some(Done::Unset(row.name));
            }
        }
        done
    })
    .inner
}

/// Gives a widget a name for those who hear instead of see, and for tests.
fn name(response: &Response, text: &str) {
    let text = text.to_owned();
    response.widget_info(move || egui::WidgetInfo::labeled(egui::Role::Button, true, &text));
}

enum Outcome {
    Same,
    Changed,
    Browse,
}

impl From<bool> for Outcome {
    fn from(changed: bool) -> Self {
        if changed { Outcome::Changed } else { Outcome::Same }
    }
}

/// The widget of a kind. Values that the kind would refuse are brought into its range.
fn widget(ui: &mut Ui, row: &Row, value: &mut Value, label: &Response) -> Outcome {
    let words = row.kind.words();
    match (&row.kind, value) {
        (Kind::Flag, Value::Flag(on)) => {
            let text = if *on { "yes" } else { "no" };
            ui.checkbox(on, text).labelled_by(label.id).changed().into()
        }
        (Kind::Choice(words), Value::Word(word)) => choice(ui, row.name, words, word, label).into(),
        (Kind::Color { most }, Value::Color(color)) => self::color(ui, color, *most, label).into(),
        (Kind::Vector { unit, range }, Value::Vector(v)) => vector(ui, v, unit, *range, label).into(),
        (Kind::File, Value::Text(path)) => file(ui, path),
        (Kind::Camera, Value::Text(text)) => {
            ui.weak(if text.is_empty() { "first" } else { text });
            Outcome::Same
        }
        (Kind::Aperture, value) => aperture(ui, row, value, label).into(),
        (_, value) if words.is_empty() => number(ui, &row.kind, value, label).into(),
        (_, value) => number_or_word(ui, row, value, label).into(),
    }
}

fn choice(
    ui: &mut Ui,
    salt: &str,
    words: &[&'static str],
    word: &mut &'static str,
    label: &Response,
) -> bool {
    let before = *word;
    let shown = ComboBox::from_id_salt(salt).selected_text(*word).show_ui(ui, |ui| {
        for other in words {
            ui.selectable_value(word, other, *other);
        }
    });
    shown.response.labelled_by(label.id);
    *word != before
}

/// A number or a whole number: a slider over what makes sense, and a field that takes all that is allowed.
fn number(ui: &mut Ui, kind: &Kind, value: &mut Value, label: &Response) -> bool {
    match (kind, value) {
        (Kind::Number { range, slider, log, unit, .. }, Value::Number(v)) => {
            let (low, high) = (slider[0], slider[1]);
            let widget = Slider::new(v, low..=high)
                .logarithmic(*log)
                .clamping(SliderClamping::Never)
                .smallest_positive(f64::from(low.abs().max(1e-4)))
                .max_decimals(4)
                .suffix(suffix(unit));
            let changed = sized(ui, widget).labelled_by(label.id).changed();
            *v = v.clamp(range[0], range[1]);
            changed
        }
        (Kind::Whole { range, slider, .. }, Value::Whole(v)) => {
            let widget = Slider::new(v, slider[0]..=slider[1]).clamping(SliderClamping::Never);
            let changed = sized(ui, widget).labelled_by(label.id).changed();
            *v = (*v).clamp(range[0], range[1]);
            changed
        }
        (_, value) => {
            ui.weak(value.to_string());
            false
        }
    }
}

/// A slider that leaves room for its number and the sign that resets it.
fn sized(ui: &mut Ui, slider: Slider<'_>) -> Response {
    ui.spacing_mut().slider_width = (ui.available_width() - 92.0).clamp(40.0, 220.0);
    ui.add(slider)
}

fn suffix(unit: &str) -> String {
    match unit {
        "" => String::new(),
        "°" | "%" => unit.to_owned(),
        // Units of several kinds of light stand in the tooltip of the table, not after each number.
        unit if unit.contains(' ') => String::new(),
        unit => format!(" {unit}"),
    }
}

/// A number that may be a word instead: a list of the words and "value", and the number if it is one.
fn number_or_word(ui: &mut Ui, row: &Row, value: &mut Value, label: &Response) -> bool {
    let before = value.clone();
    let shown = match value {
        Value::Word(word) => *word,
        _ => "value",
    };
    let list =
        ComboBox::from_id_salt((row.name, "word")).width(72.0).selected_text(shown).show_ui(ui, |ui| {
            for word in row.kind.words() {
                ui.selectable_value(value, Value::Word(word), *word);
            }
            if ui.selectable_label(!matches!(value, Value::Word(_)), "value").clicked()
                && matches!(value, Value::Word(_))
            {
                *value = start(&row.kind);
            }
        });
    if matches!(value, Value::Word(_)) {
        list.response.labelled_by(label.id);
    } else {
        compact(ui, &row.kind, value, label);
    }
    *value != before
}

/// A number without a slider.
fn compact(ui: &mut Ui, kind: &Kind, value: &mut Value, label: &Response) {
    match (kind, value) {
        (Kind::Number { range, unit, log, slider, .. }, Value::Number(v)) => {
            let speed = if *log {
                f64::from(v.abs()).max(1e-4) * 0.02
            } else {
                f64::from(slider[1] - slider[0]) * 0.003
            };
            let field = DragValue::new(v)
                .range(range[0]..=range[1])
                .speed(speed)
                .max_decimals(4)
                .suffix(suffix(unit));
            ui.add(field).labelled_by(label.id);
        }
        (Kind::Whole { range, .. }, Value::Whole(v)) => {
            ui.add(DragValue::new(v).range(range[0]..=range[1]).speed(0.1)).labelled_by(label.id);
        }
        _ => {}
    }
}

/// Where a number begins that was a word: in the middle of what makes sense.
fn start(kind: &Kind) -> Value {
    match kind {
        Kind::Number { slider: [a, b], log: true, .. } => Value::Number((a.max(1e-4) * b).sqrt()),
        Kind::Number { slider: [a, b], .. } => {
            Value::Number(if *a <= 0.0 && *b >= 0.0 { 0.0 } else { 0.5 * (a + b) })
        }
        Kind::Whole { slider: [a, b], .. } => Value::Whole((a + b) / 3),
        _ => Value::Number(0.0),
    }
}

/// A colour. One brighter than white keeps its strength while its hue is chosen.
fn color(ui: &mut Ui, color: &mut Rgb, most: f32, label: &Response) -> bool {
    let strength = color.max_component().max(1.0);
    let mut shown = (*color * (1.0 / strength)).to_array();
    // A swatch, three numbers, and the sign that resets them.
    ui.spacing_mut().item_spacing.x = 4.0;
    let mut changed = ui.color_edit_button_rgb(&mut shown).labelled_by(label.id).changed();
    if changed {
        *color = Rgb::from_array(shown.map(|v| (v * strength).clamp(0.0, most)));
    }
    let mut bands = color.to_array();
    for band in &mut bands {
        let field = DragValue::new(band).range(0.0..=most).speed(0.005).max_decimals(3);
        changed |= ui.add_sized([44.0, ui.spacing().interact_size.y], field).changed();
    }
    *color = Rgb::from_array(bands);
    changed
}

fn vector(ui: &mut Ui, v: &mut Vec3, unit: &str, range: [f32; 2], label: &Response) -> bool {
    let speed = match unit {
        "°" => 0.5,
        // As fine as its size.
        _ => (f64::from(v.abs().max_element()) * 0.004).clamp(0.002, 10.0),
    };
    let allowed: RangeInclusive<f32> = range[0]..=range[1];
    let mut changed = false;
    for (component, tint) in [&mut v.x, &mut v.y, &mut v.z].into_iter().zip(AXIS_COLORS) {
        // No sign before nothing.
        *component += 0.0;
        let field = DragValue::new(component).range(allowed.clone()).speed(speed).max_decimals(3);
        let response = ui.scope(|ui| {
            ui.visuals_mut().widgets.inactive.bg_stroke = egui::Stroke::new(1.0, tint.gamma_multiply(0.5));
            ui.add_sized([58.0, ui.spacing().interact_size.y], field)
        });
        changed |= response.inner.labelled_by(label.id).changed();
    }
    changed
}

/// Colours of x, y and z, here and of the arrows in the picture.
pub const AXIS_COLORS: [Color32; 3] =
    [Color32::from_rgb(235, 87, 87), Color32::from_rgb(111, 207, 101), Color32::from_rgb(86, 145, 245)];

fn file(ui: &mut Ui, path: &str) -> Outcome {
    let name = std::path::Path::new(path).file_name().unwrap_or_default().to_string_lossy();
    let asked = ui.button("…").on_hover_text("Choose a file").clicked();
    ui.add(egui::Label::new(if name.is_empty() { "none".into() } else { name }).truncate())
        .on_hover_text(path);
    if asked { Outcome::Browse } else { Outcome::Same }
}

/// The opening of the lens: closed, an f-number, or a diameter.
fn aperture(ui: &mut Ui, row: &Row, value: &mut Value, label: &Response) -> bool {
    let before = value.clone();
    let shown = match value {
        Value::FNumber(_) => "f-number",
        Value::Number(_) => "diameter",
        _ => "off",
    };
    let list = ComboBox::from_id_salt(row.name).width(72.0).selected_text(shown).show_ui(ui, |ui| {
        for (name, start) in [
            ("off", Value::Word("off")),
            ("f-number", Value::FNumber(2.8)),
            ("diameter", Value::Number(0.05)),
        ] {
            if ui.selectable_label(shown == name, name).clicked() && shown != name {
                *value = start;
            }
        }
    });
    match value {
        Value::FNumber(n) => {
            let field = DragValue::new(n).prefix("f/").range(0.1..=64.0).speed(0.05).max_decimals(2);
            ui.add(field).labelled_by(label.id);
        }
        Value::Number(metres) => {
            let speed = f64::from(*metres) * 0.02 + 1e-5;
            let field = DragValue::new(metres).range(1e-6..=1e3).speed(speed).max_decimals(5).suffix(" m");
            ui.add(field).labelled_by(label.id);
        }
        _ => {
            list.response.labelled_by(label.id);
        }
    }
    *value != before
}
