//! Edits and pictures on their way to files, and the command that draws what is shown.

use crate::dialog::Purpose;
use crate::state::State;
use eframe::egui::Context;
use lumbre::edits::{Edits, Item, Value};
use lumbre::session::Layer;
use std::path::{Path, PathBuf};

impl State {
    /// Begins to write the edits; what waits for that is done [when they are written](State::edits_written). One file at a time.
    pub(crate) fn save_edits(&mut self, path: PathBuf) {
        if self.writing {
            self.next_file = Some(path);
        } else if let Some(edits) = self.edits_to_save() {
            self.writing = true;
            self.loader.write_edits(path, edits);
        }
    }

    /// The edits as a file has them: what focuses by itself here would focus a little otherwise there.
    fn edits_to_save(&self) -> Option<Edits> {
        let document = self.document.as_ref()?;
        let mut edits = document.edits.clone();
        if let (true, Some(metres)) = (self.focuses_by_itself(), self.auto_focus) {
            let set = edits.set(&document.base, Item::Camera, "focus", Value::Number(metres));
            debug_assert!(set.is_ok(), "{set:?}");
        }
        Some(edits)
    }

    /// They are in a file now: those of the scene of this number.
    pub(crate) fn edits_written(&mut self, path: PathBuf, edits: Edits, number: u64, window: &Context) {
        self.writing = false;
        self.log.note(format!("saved {}", path.display()));
        if let Some(document) = self.document.as_mut().filter(|d| d.number == number) {
            document.mark_saved_as(&edits);
            self.edits_file = Some(path);
            self.filed = Some(edits);
        }
        if let Some(next) = self.next_file.take() {
            return self.save_edits(next);
        }
        if std::mem::take(&mut self.copies) {
            self.copy_command(window);
        }
        self.leave_now(window);
    }

    /// They cannot be written: nothing that waited for it is done.
    pub(crate) fn edits_not_written(&mut self, reason: String) {
        self.log.error(reason);
        (self.writing, self.copies) = (false, false);
        (self.leaving, self.with_scene, self.next_file) = (None, None, None);
    }

    /// The edits that were opened are shown, unless something of them is still being read.
    pub fn accept_edits(&mut self) {
        let Some(document) = &mut self.document else { return };
        if let Some(arrived) = self.arriving.take_if(|_| document.is_settled()) {
            let mut edits = arrived.edits;
            edits.scene.clone_from(&document.edits.scene);
            document.mark_saved_as(&edits);
            self.log.note(format!("{} opened", arrived.path.display()));
            self.filed = Some(edits);
            self.edits_file = Some(arrived.path);
        }
    }

    /// They do not fit: the camera goes back too.
    pub fn refuse_edits(&mut self) {
        if let (Some(refused), Some(document)) = (self.arriving.take(), &mut self.document) {
            document.edits.camera = refused.camera;
        }
    }

    /// Copies the command that draws what is shown. The file that it names is written first where it does not say all of that.
    pub(crate) fn copy_command(&mut self, window: &Context) {
        if let Some(line) = self.command_line() {
            window.copy_text(line.clone());
            return self.log.note(format!("copied: {line}"));
        }
        self.copies = true;
        match self.edits_file.clone() {
            Some(path) => self.save_edits(path),
            None => {
                self.log.note("the edits are saved first, so that the command can name their file");
                self.ask_for_file(Purpose::SaveEdits, window);
            }
        }
    }

    /// The command that draws what is shown; `None` without a scene, or where no file holds what is changed of it.
    pub fn command_line(&self) -> Option<String> {
        let document = self.document.as_ref()?;
        let edits = self.edits_file.as_ref().filter(|_| self.filed == self.edits_to_save())?;
        let [width, height] = self.size;
        let flags: String =
            flags(&document.options).iter().map(|flag| format!(" {}", quoted(flag))).collect();
        Some(format!(
            "lumbre render {}{flags} --edits {} --size {width}x{height} --spp {}",
            quoted_path(&document.path),
            quoted_path(edits),
            self.running.limit
        ))
    }

    /// Saves the picture, once [the session](crate::app::App) is told what is wanted. Normals alone, or objects in colours of their own, are rendered
    /// in the place of the picture and are no files: the picture comes back.
    pub(crate) fn save_picture(&mut self, path: PathBuf) {
        if self.running.preview || self.running.layer == Layer::Objects {
            self.running.preview = false;
            self.running.layer = Layer::Picture;
            self.log.note("back to the picture: that is what is saved");
        }
        self.picture_file = Some(path.clone());
        self.picture_to_save = Some(path);
    }
}

/// Flags of `lumbre render` by which a scene was read.
fn flags(options: &lumbre::LoadOptions) -> Vec<String> {
    use lumbre::io::SceneChoice;
    let scene = match &options.scene {
        SceneChoice::Default => None,
        SceneChoice::Index(index) => Some(index.to_string()),
        SceneChoice::Name(name) => Some(name.clone()),
    };
    let named = [("--scene", scene), ("--variant", options.variant.clone())];
    let named = named.into_iter().filter_map(|(flag, value)| Some([flag.to_owned(), value?]));
    let folders = options.asset_dirs.iter().map(|dir| ["--asset-dir".to_owned(), dir.display().to_string()]);
    named.chain(folders).flatten().collect()
}

fn quoted_path(path: &Path) -> String {
    quoted(&path.display().to_string())
}

/// A word as a shell takes it.
fn quoted(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+,:=@%".contains(c);
    if !text.is_empty() && text.chars().all(plain) {
        return text.to_owned();
    }
    format!("'{}'", text.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre::LoadOptions;
    use lumbre::io::SceneChoice;

    #[test]
    fn words_are_as_a_shell_takes_them() {
        assert_eq!(quoted("a/b.glb"), "a/b.glb");
        assert_eq!(quoted("it's mine.glb"), r"'it'\''s mine.glb'");
        assert_eq!(quoted(""), "''");
    }

    #[test]
    fn flags_say_how_a_scene_was_read() {
        assert!(flags(&LoadOptions::default()).is_empty());
        let options = LoadOptions {
            scene: SceneChoice::Index(1),
            variant: Some("red shoe".into()),
            asset_dirs: vec!["maps".into()],
            ..LoadOptions::default()
        };
        let all = ["--scene", "1", "--variant", "red shoe", "--asset-dir", "maps"];
        assert_eq!(flags(&options), all);
    }
}
