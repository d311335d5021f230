//! What the window does, as lines of JSON: for those who look for what is slow, and for programs that drive a window and want to know
//! where its controls are. A line for each step:
//!
//! | key | |
//! |---|---|
//! | `at` | seconds since the report began, when the step began |
//! | `interface_ms` | what this step took in the panels, the picture and the edits |
//! | `last_ms` | the step before, as a whole but for the wait for the display: also triangles and textures on their way to OpenGL |
//! | `again` | another step follows without a pause |
//! | `spp`, `scale`, `number`, `device` | samples of each pixel of the frame that is shown, its roughness, which wish it shows, and what drew it |
//! | `wish` | the last wish that was told to the render thread |
//! | `log` | lines of the log that are new; absent without any |
//! | `widgets` | all controls, where they differ from those of the line before: role, name, value, and `[left, top, right, bottom]` in points of the window |

use crate::log::Log;
use eframe::egui::accesskit::{Node, NodeId, Role, TreeUpdate};
use eframe::egui::{Context, FullOutput, Plugin, ViewportId};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::fmt;
use std::io::Write;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// What a step of the interface says of itself.
#[derive(Clone, Debug, Default)]
pub struct Step {
    /// When it began.
    pub began: Option<Instant>,
    /// How long panels, picture and edits took.
    pub interface: Duration,
    /// How long the last step took as a whole.
    pub last: Duration,
    /// Samples of each pixel of the frame that is shown.
    pub spp: u32,
    /// Pixels of the view for one of it, along each axis.
    pub scale: u32,
    /// The wish that it shows.
    pub number: u64,
    /// The last wish.
    pub wish: u64,
    /// What drew it.
    pub device: String,
    /// Lines of the log that are new.
    pub log: Vec<String>,
}

/// A report that is being written.
#[derive(Clone)]
pub struct Report(Arc<Mutex<Lines>>);

struct Lines {
    /// `None` once it could not be written.
    to: Option<Box<dyn Write + Send>>,
    began: Instant,
    step: Step,
    widgets: Vec<Value>,
    /// Lines of the log so far.
    logged: usize,
}

impl Report {
    /// Begins a report, which goes where `to` leads, line by line.
    pub fn new(to: Box<dyn Write + Send>) -> Self {
        let began = Instant::now();
        let lines = Lines { to: Some(to), began, step: Step::default(), widgets: Vec::new(), logged: 0 };
        Report(Arc::new(Mutex::new(lines)))
    }

    fn lines(&self) -> MutexGuard<'_, Lines> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Follows the steps of a window.
    pub fn follow(&self, window: &Context) {
        window.enable_accesskit();
        window.add_plugin(Follow(self.clone()));
    }

    /// Says what the step was that ends now; its line is written when all of it has been laid out.
    pub fn step(&self, step: Step, log: &Log) {
        let mut lines = self.lines();
        let new = log.since(lines.logged).map(|l| l.text.clone()).collect();
        lines.logged = log.count();
        lines.step = Step { log: new, ..step };
    }
}

impl fmt::Debug for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Report")
    }
}

/// Sees what a window puts out.
struct Follow(Report);

impl Plugin for Follow {
    fn debug_name(&self) -> &'static str {
        "report"
    }

    fn output_hook(&mut self, _: &Context, output: &mut FullOutput) {
        let again = output.viewport_output.get(&ViewportId::ROOT).is_some_and(|v| v.repaint_delay.is_zero());
        let mut lines = self.0.lines();
        let widgets = output.platform_output.accesskit_update.as_ref().map(widgets);
        lines.write(again, widgets.unwrap_or_default());
    }
}

impl Lines {
    fn write(&mut self, again: bool, widgets: Vec<Value>) {
        let Some(to) = &mut self.to else { return };
        let step = std::mem::take(&mut self.step);
        // What egui lays out twice is one step.
        let Some(began) = step.began else { return };
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        let mut line = json!({
            "at": began.saturating_duration_since(self.began).as_secs_f64(),
            "interface_ms": ms(step.interface),
            "last_ms": ms(step.last),
            "again": again,
            "spp": step.spp,
            "scale": step.scale,
            "number": step.number,
            "wish": step.wish,
            "device": step.device,
        });
        if !step.log.is_empty() {
            line["log"] = step.log.into();
        }
        if widgets != self.widgets {
            line["widgets"] = widgets.clone().into();
            self.widgets = widgets;
        }
        if to.write_all(format!("{line}\n").as_bytes()).is_err() {
            self.to = None;
        }
    }
}

/// The controls that a window has, from top to bottom.
fn widgets(update: &TreeUpdate) -> Vec<Value> {
    let texts: HashMap<NodeId, &str> =
        update.nodes.iter().filter_map(|(id, node)| Some((*id, node.label().or(node.value())?))).collect();
    // Runs of letters are parts of what is listed by itself.
    let all = update.nodes.iter().filter(|(_, node)| node.role() != Role::TextRun);
    let mut all: Vec<_> = all.filter_map(|(_, node)| widget(node, &texts)).collect();
    all.sort_by(|(a, _), (b, _)| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0])));
    all.into_iter().map(|(_, widget)| widget).collect()
}

/// A control, by its place and as JSON. Its name is its own or that of what labels it.
fn widget(node: &Node, texts: &HashMap<NodeId, &str>) -> Option<([f64; 4], Value)> {
    let rect = node.bounds()?;
    let name = node.label().or_else(|| node.labelled_by().first().and_then(|id| texts.get(id).copied()));
    let value = node.value().map(str::to_owned).or_else(|| node.numeric_value().map(|v| v.to_string()));
    let place = [rect.x0, rect.y0, rect.x1, rect.y1].map(|v| (v * 10.0).round() / 10.0);
    let role = format!("{:?}", node.role());
    (name.is_some() || value.is_some())
        .then(|| (place, json!({ "role": role, "name": name, "value": value, "rect": place })))
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{RawInput, Rect, pos2};

    #[test]
    fn each_step_is_a_line_with_what_is_new() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("report.jsonl");
        let report = Report::new(Box::new(std::fs::File::create(&path).unwrap()));
        let window = Context::default();
        report.follow(&window);
        let mut log = Log::default();
        for i in 0..3 {
            let screen = Rect::from_min_max(pos2(0.0, 0.0), pos2(300.0, 200.0));
            let input = RawInput { screen_rect: Some(screen), ..RawInput::default() };
            let _ = window.run_ui(input, |ui| {
                let _ = ui.button(if i < 2 { "Open" } else { "Close" });
                if i == 1 {
                    log.note("opened");
                }
                report.step(Step { began: Some(Instant::now()), spp: i, ..Step::default() }, &log);
            });
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let lines: Vec<Value> = text.lines().map(|l| serde_json::from_str(l).unwrap()).collect();
        assert_eq!(lines.len(), 3);
        let named = |line: &Value, name: &str| {
            let all = line["widgets"].as_array().cloned().unwrap_or_default();
            all.into_iter().find(|w| w["name"] == name)
        };
        let open = named(&lines[0], "Open").unwrap();
        assert_eq!(open["role"], "Button");
        assert!(open["rect"][2].as_f64().unwrap() > open["rect"][0].as_f64().unwrap());
        assert!(lines[1].get("widgets").is_none(), "they are the same");
        assert_eq!(lines[1]["log"], json!(["opened"]));
        assert!(lines[2].get("log").is_none());
        assert!(named(&lines[2], "Close").is_some());
        assert_eq!(lines[2]["spp"], 2);
    }
}
