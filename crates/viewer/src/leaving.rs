//! Edits that are not saved are not lost by a window that closes or another scene that is opened: both wait for an answer.

use crate::dialog::Purpose;
use crate::open::FileKind;
use crate::state::State;
use eframe::egui::{Context, ViewportCommand};
use std::path::PathBuf;

/// What waits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Leaving {
    /// The window is to be closed.
    Close,
    /// Another scene is to be opened.
    Open(PathBuf),
}

/// What becomes of the edits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leave {
    /// They are saved first.
    Save,
    /// They are of no use.
    Discard,
    /// All stays as it is.
    Stay,
}

impl State {
    /// Opens a file; a scene only if nothing is lost by that.
    pub fn open_file(&mut self, path: PathBuf) {
        if FileKind::of(&path) == FileKind::Scene && self.is_unsaved() {
            self.leaving = Some(Leaving::Open(path));
        } else {
            self.loader.open(&path);
        }
    }

    /// The window was asked to close. Whether it may.
    pub fn may_close(&mut self) -> bool {
        // What is being written is waited for.
        if self.is_unsaved() || self.writing {
            self.leaving = Some(Leaving::Close);
        }
        self.leaving.is_none()
    }

    /// Whether there are edits that are in no file.
    pub fn is_unsaved(&self) -> bool {
        self.document.as_ref().is_some_and(|d| d.is_unsaved())
    }

    /// The answer.
    pub fn leave(&mut self, how: Leave, window: &Context) {
        match how {
            Leave::Stay => {
                self.leaving = None;
                self.with_scene = None;
            }
            Leave::Discard => {
                // A scene that cannot be opened leaves them as they are.
                if let (Some(Leaving::Close), Some(document)) = (&self.leaving, &mut self.document) {
                    document.mark_saved();
                }
                self.leave_now(window);
            }
            Leave::Save => match self.edits_file.clone() {
                Some(path) => self.save_edits(path),
                None => self.ask_for_file(Purpose::SaveEdits, window),
            },
        }
    }

    /// Does what waited, now that nothing is lost by it.
    pub(crate) fn leave_now(&mut self, window: &Context) {
        match self.leaving.take() {
            Some(Leaving::Close) => window.send_viewport_cmd(ViewportCommand::Close),
            Some(Leaving::Open(path)) => self.loader.open(&path),
            None => {}
        }
    }
}
