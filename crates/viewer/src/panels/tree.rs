//! The tree of the scene: what stands in it, what is visible, and where what is picked stands.

use super::table;
use crate::command::Command;
use crate::document::Document;
use crate::panels::rows::Done;
use crate::state::State;
use eframe::egui::{Id, ScrollArea, TextEdit, TextStyle, Ui};
use lumbre::edits::{Item, Value};
use lumbre::scene::NodeId;
use std::collections::HashSet;

/// Which nodes are unfolded, and what is searched for.
#[derive(Clone, Default)]
struct Unfolded {
    nodes: HashSet<NodeId>,
    search: String,
}

/// A line of the tree.
struct Line {
    node: NodeId,
    depth: usize,
}

pub(super) fn show(ui: &mut Ui, state: &State, out: &mut Vec<Command>) {
    let Some(document) = &state.document else { return };
    let id = Id::unique("unfolded");
    let mut unfolded: Unfolded = ui.data(|d| d.get_temp(id)).unwrap_or_default();
    ui.add(
        TextEdit::singleline(&mut unfolded.search).hint_text("search by name").desired_width(f32::INFINITY),
    );
    let lines = lines(document, &unfolded);
    let height = ui.text_style_height(&TextStyle::Body) + 4.0;
    ScrollArea::vertical().id_salt("tree").max_height(260.0).auto_shrink([false, true]).show_rows(
        ui,
        height,
        lines.len(),
        |ui, range| {
            for line in &lines[range] {
                self::line(ui, state, document, line, &mut unfolded, out);
            }
        },
    );
    if lines.is_empty() {
        ui.weak("nothing");
    }
    ui.data_mut(|d| d.insert_temp(id, unfolded));
    if let Some(item @ Item::Node(node)) = state.selection.item {
        ui.separator();
        ui.horizontal(|ui| {
            ui.strong(name(document, node));
            if ui.small_button("Into view").clicked() {
                out.push(Command::Frame(node));
            }
        });
        table(ui, state, item, out);
    }
}

/// The lines that are unfolded, or those that are searched for.
fn lines(document: &Document, unfolded: &Unfolded) -> Vec<Line> {
    let scene = &document.base;
    if !unfolded.search.trim().is_empty() {
        let wanted = unfolded.search.trim().to_lowercase();
        let all = (0..scene.nodes.len() as u32).map(NodeId);
        let found = all.filter(|n| name(document, *n).to_lowercase().contains(&wanted));
        return found.map(|node| Line { node, depth: 0 }).collect();
    }
    let mut lines = Vec::new();
    let mut stack: Vec<Line> = scene.roots.iter().rev().map(|&node| Line { node, depth: 0 }).collect();
    while let Some(line) = stack.pop() {
        let Some(node) = scene.nodes.get(line.node.index()) else { continue };
        // A circle of nodes has no end.
        if unfolded.nodes.contains(&line.node) && line.depth < 64 {
            stack.extend(node.children.iter().rev().map(|&node| Line { node, depth: line.depth + 1 }));
        }
        lines.push(line);
    }
    lines
}

fn line(
    ui: &mut Ui,
    state: &State,
    document: &Document,
    line: &Line,
    unfolded: &mut Unfolded,
    out: &mut Vec<Command>,
) {
    let Some(node) = document.scene.nodes.get(line.node.index()) else { return };
    ui.horizontal(|ui| {
        ui.add_space(14.0 * line.depth as f32);
        let open = unfolded.nodes.contains(&line.node);
        let sign = if node.children.is_empty() {
            "·"
        } else if open {
            "−"
        } else {
            "+"
        };
        if ui.add(eframe::egui::Button::new(sign).frame(false).min_size([14.0, 0.0].into())).clicked() {
            if open {
                unfolded.nodes.remove(&line.node);
            } else {
                unfolded.nodes.insert(line.node);
            }
        }
        let mut visible = node.visible;
        if ui.checkbox(&mut visible, "").on_hover_text("Visible, with all below it").changed() {
            out.push(Command::Row(Item::Node(line.node), Done::Set("visible", Value::Flag(visible))));
        }
        let picked = state.selection.item == Some(Item::Node(line.node));
        let row = ui.selectable_label(picked, name(document, line.node));
        if row.double_clicked() {
            out.push(Command::Frame(line.node));
        } else if row.clicked() {
            out.push(Command::Pick(Item::Node(line.node)));
        }
    });
}

fn name(document: &Document, node: NodeId) -> String {
    let Some(n) = document.base.nodes.get(node.index()) else { return String::new() };
    let of_mesh = || n.mesh.and_then(|m| document.base.meshes.get(m.index())).map(|m| m.name.clone());
    let named = [n.name.clone(), of_mesh().unwrap_or_default()].into_iter().find(|name| !name.is_empty());
    named.unwrap_or_else(|| format!("node {}", node.0))
}
