//! The file dialog, in the window itself: it looks the same everywhere and needs nothing of the system. A path may be typed, a folder
//! entered, a file picked; what was opened before stands on top.

use crate::folder::{Folder, Listing, has_ending};
use eframe::egui::{self, Context, Key, RichText, ScrollArea, TextEdit};
use std::path::{Path, PathBuf};

/// What the dialog is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Opening a scene, a picture of surroundings or edits.
    Open,
    /// Choosing a picture of surroundings.
    Environment,
    /// Saving the picture.
    SavePicture,
    /// Saving edits.
    SaveEdits,
}

impl Purpose {
    fn title(self) -> &'static str {
        match self {
            Purpose::Open => "Open",
            Purpose::Environment => "Choose an environment",
            Purpose::SavePicture => "Save the picture",
            Purpose::SaveEdits => "Save the edits",
        }
    }

    fn endings(self) -> &'static [&'static str] {
        match self {
            Purpose::Open => &["gltf", "glb", "obj", "ply", "stl", "hdr", "exr", "json"],
            Purpose::Environment => crate::open::ENVIRONMENT_ENDINGS,
            Purpose::SavePicture => &["png", "jpg", "jpeg", "exr"],
            Purpose::SaveEdits => crate::open::EDITS_ENDINGS,
        }
    }

    /// Whether the file is to be written.
    pub fn saves(self) -> bool {
        matches!(self, Purpose::SavePicture | Purpose::SaveEdits)
    }
}

/// The dialog while it is open.
pub struct Dialog {
    purpose: Purpose,
    folder: Folder,
    /// As typed: a name in the folder, or a path.
    name: String,
    /// The file is there, and was asked for once already.
    replaces: Option<PathBuf>,
    fresh: bool,
}

/// How it ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Choice {
    /// With a file.
    File(Purpose, PathBuf),
    /// With nothing.
    Cancelled,
}

impl Dialog {
    /// Opens it in a folder, or in that of a file, whose name is then the first proposal.
    pub fn open(purpose: Purpose, at: &Path, window: &Context) -> Self {
        let (folder, name) = match (purpose.saves(), at.parent(), at.file_name()) {
            (true, Some(folder), Some(name)) => (folder.into(), name.to_string_lossy().into_owned()),
            (false, Some(folder), Some(_)) if has_ending(&at.to_string_lossy(), purpose.endings()) => {
                (folder.into(), String::new())
            }
            _ => (at.to_path_buf(), String::new()),
        };
        let folder = std::path::absolute(&folder).unwrap_or(folder);
        let folder = Folder::read(&folder, purpose.endings(), window);
        Dialog { purpose, folder, name, replaces: None, fresh: true }
    }

    /// Shows it; the choice, once there is one.
    pub fn show(&mut self, ctx: &Context, recent: &[PathBuf]) -> Option<Choice> {
        let mut choice = None;
        let mut open = true;
        egui::Window::new(self.purpose.title())
            .open(&mut open)
            .collapsible(false)
            .default_size([560.0, 420.0])
            .pivot(egui::Align2::CENTER_CENTER)
            .default_pos(ctx.content_rect().center())
            .show(ctx, |ui| choice = self.contents(ui, recent));
        if !open || ctx.input(|i| i.key_pressed(Key::Escape)) {
            choice = choice.or(Some(Choice::Cancelled));
        }
        choice
    }

    fn contents(&mut self, ui: &mut egui::Ui, recent: &[PathBuf]) -> Option<Choice> {
        if self.purpose == Purpose::Open && !recent.is_empty() {
            if let Some(path) = recent_list(ui, recent) {
                return Some(Choice::File(self.purpose, path));
            }
            ui.separator();
        }
        self.where_it_is(ui);
        let picked = self.entries(ui);
        ui.separator();
        let (asked, cancelled) = self.name_row(ui);
        if cancelled {
            return Some(Choice::Cancelled);
        }
        let path = match picked {
            Some(path) => path,
            None if asked && !self.name.trim().is_empty() => self.folder.path.join(self.name.trim()),
            None => return None,
        };
        self.settle(path, ui.ctx())
    }

    /// The folder, and the way up.
    fn where_it_is(&mut self, ui: &mut egui::Ui) {
        ui.horizontal(|ui| {
            let up = self.folder.path.parent().map(Path::to_path_buf);
            let button = ui.add_enabled(up.is_some(), egui::Button::new("Up"));
            if let (true, Some(up)) = (button.on_hover_text("The folder above").clicked(), up) {
                self.enter(&up, ui.ctx());
            }
            ui.add(
                egui::Label::new(RichText::new(self.folder.path.display().to_string()).monospace())
                    .truncate(),
            );
        });
    }

    /// What is in the folder; a file that was chosen.
    fn entries(&mut self, ui: &mut egui::Ui) -> Option<PathBuf> {
        let (mut entered, mut picked) = (None, None);
        let height = (ui.available_height() - 48.0).max(80.0);
        let listing = self.folder.listing().cloned();
        ScrollArea::vertical().max_height(height).auto_shrink(false).show(ui, |ui| match listing {
            None => {
                ui.spinner();
            }
            Some(Err(error)) => {
                ui.colored_label(ui.visuals().error_fg_color, error);
            }
            Some(Ok(Listing { entries, left_out })) => {
                for entry in &entries {
                    let sign = if entry.is_folder { "/" } else { "" };
                    let selected = !entry.is_folder && entry.name == self.name;
                    let row = ui.selectable_label(selected, format!("{}{sign}", entry.name));
                    let chosen = row.double_clicked();
                    match (entry.is_folder, row.clicked()) {
                        (true, true) => entered = Some(self.folder.path.join(&entry.name)),
                        (false, true) => self.name.clone_from(&entry.name),
                        _ => {}
                    }
                    if chosen && !entry.is_folder {
                        picked = Some(self.folder.path.join(&entry.name));
                    }
                }
                if entries.is_empty() {
                    ui.weak("nothing that fits here");
                }
                if left_out > 0 {
                    ui.weak(format!("and {left_out} more: type the name"));
                }
            }
        });
        if let Some(folder) = entered {
            self.enter(&folder, ui.ctx());
        }
        picked
    }

    /// The name, and whether it is meant: the button was pressed, or Enter. And whether all is called off.
    fn name_row(&mut self, ui: &mut egui::Ui) -> (bool, bool) {
        let verb = match (self.purpose.saves(), &self.replaces) {
            (true, Some(_)) => "Replace it",
            (true, None) => "Save",
            (false, _) => "Open",
        };
        let mut meant = (false, false);
        ui.horizontal(|ui| {
            let label = ui.label("File");
            let width = (ui.available_width() - 170.0).max(80.0);
            let field = TextEdit::singleline(&mut self.name).desired_width(width).hint_text("name or path");
            let field = ui.add(field).labelled_by(label.id);
            if std::mem::take(&mut self.fresh) {
                field.request_focus();
            }
            if field.changed() {
                self.replaces = None;
            }
            let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
            meant = (entered || ui.button(verb).clicked(), ui.button("Cancel").clicked());
        });
        if self.replaces.is_some() {
            ui.colored_label(ui.visuals().warn_fg_color, "A file of this name is there already.");
        }
        meant
    }

    /// What comes of a path: a folder is entered, a file that would be replaced is asked for once more.
    fn settle(&mut self, path: PathBuf, ctx: &Context) -> Option<Choice> {
        if path.is_dir() {
            self.enter(&path, ctx);
            self.name.clear();
            return None;
        }
        if !self.purpose.saves() {
            return Some(Choice::File(self.purpose, path));
        }
        let path = with_ending(path, self.purpose.endings());
        if path.exists() && self.replaces.as_ref() != Some(&path) {
            self.replaces = Some(path);
            return None;
        }
        Some(Choice::File(self.purpose, path))
    }

    fn enter(&mut self, folder: &Path, ctx: &Context) {
        self.folder = Folder::read(folder, self.purpose.endings(), ctx);
        self.replaces = None;
    }
}

/// What was opened before; one that was clicked.
fn recent_list(ui: &mut egui::Ui, recent: &[PathBuf]) -> Option<PathBuf> {
    ui.strong("Recent");
    let mut picked = None;
    ScrollArea::vertical().id_salt("recent").max_height(96.0).show(ui, |ui| {
        for path in recent {
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
            if ui.link(name).on_hover_text(path.display().to_string()).clicked() {
                picked = Some(path.clone());
            }
        }
    });
    picked
}

/// The path with the first of the endings, if it has none of them.
fn with_ending(path: PathBuf, endings: &[&str]) -> PathBuf {
    if has_ending(&path.to_string_lossy(), endings) {
        return path;
    }
    let mut name = path.into_os_string();
    name.push(".");
    name.push(endings[0]);
    name.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_gets_the_ending_that_it_lacks() {
        for (name, want) in [("a", "a.png"), ("a.png", "a.png"), ("a.EXR", "a.EXR"), ("a.b", "a.b.png")] {
            assert_eq!(with_ending(name.into(), Purpose::SavePicture.endings()), Path::new(want));
        }
    }

    #[test]
    fn a_file_that_is_there_is_asked_for_twice() {
        let (folder, ctx) = (tempfile::tempdir().unwrap(), Context::default());
        let path = folder.path().join("a.png");
        let mut dialog = Dialog::open(Purpose::SavePicture, &path, &ctx);
        assert_eq!(dialog.name, "a.png");
        let chosen = Some(Choice::File(Purpose::SavePicture, path.clone()));
        assert_eq!(dialog.settle(folder.path().join("a"), &ctx), chosen);
        std::fs::write(&path, "").unwrap();
        assert_eq!(dialog.settle(path.clone(), &ctx), None);
        assert_eq!(dialog.settle(path, &ctx), chosen);
    }

    #[test]
    fn a_folder_is_entered() {
        let (folder, ctx) = (tempfile::tempdir().unwrap(), Context::default());
        let mut dialog = Dialog::open(Purpose::Open, Path::new("/"), &ctx);
        assert_eq!(dialog.settle(folder.path().into(), &ctx), None);
        assert_eq!(dialog.folder.path, folder.path());
        let file = folder.path().join("new.glb");
        assert_eq!(dialog.settle(file.clone(), &ctx), Some(Choice::File(Purpose::Open, file)));
    }
}
