//! What keys and mouse buttons do. One table: the window obeys it and the help panel shows it, so that they cannot differ.

use crate::navigation::Flight;
use eframe::egui::{Key, KeyboardShortcut, Modifiers};
use glam::Vec3;

/// Something a key asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Action {
    /// Opens a scene, by the file dialog.
    Open,
    /// Saves the picture as it is.
    SavePicture,
    /// Saves what was changed.
    SaveEdits,
    /// Takes back the last change.
    Undo,
    /// Makes it again.
    Redo,
    /// Everything in view.
    FrameAll,
    /// What is picked in view.
    FramePicked,
    /// The next of the file's cameras.
    NextCamera,
    /// Where the camera was before the last move.
    ViewBack,
    /// And after it.
    ViewForward,
    /// Goes to a bookmark, 0 to 8.
    GoTo(u8),
    /// Makes a bookmark, 0 to 8.
    Bookmark(u8),
    /// The next click on the picture says what is sharp.
    FocusByClick,
    /// A stop brighter or darker, in thirds.
    Brighter,
    /// The other way.
    Darker,
    /// Exposure by itself, or held as it is.
    AutoExposure,
    /// The next layer: picture, albedo, normal, …
    NextLayer,
    /// The quick preview by normals, and back.
    Preview,
    /// Rests and goes on.
    Pause,
    /// Begins anew.
    Restart,
    /// Picks nothing.
    Deselect,
    /// Hides what is picked, or shows it again.
    Hide,
    /// Removes the light that is picked.
    Remove,
    /// All keys.
    Help,
    /// All panels away, and back.
    Panels,
    /// The window fills the screen, and back.
    FullScreen,
    /// Closes the window.
    Quit,
}

/// Under what heading the help shows a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Moving about.
    Camera,
    /// What is seen.
    View,
    /// Picking and changing.
    Scene,
    /// Files and the window.
    Program,
}

impl Group {
    /// All of them, in the order of the help.
    pub const ALL: [Group; 4] = [Group::Camera, Group::View, Group::Scene, Group::Program];

    /// Its heading.
    pub fn name(self) -> &'static str {
        match self {
            Group::Camera => "Camera",
            Group::View => "View",
            Group::Scene => "Scene",
            Group::Program => "Program",
        }
    }
}

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Binding {
    /// What is done.
    pub action: Action,
    /// The keys that ask for it, any of them.
    pub keys: &'static [KeyboardShortcut],
    /// What is done, for people.
    pub help: &'static str,
    /// Where the help shows it.
    pub group: Group,
}

const fn key(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}
const fn ctrl(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}
const fn ctrl_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), key)
}
const fn alt(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::ALT, key)
}

const fn row(group: Group, action: Action, keys: &'static [KeyboardShortcut], help: &'static str) -> Binding {
    Binding { action, keys, help, group }
}

/// All keys but those that fly and those of bookmarks.
#[rustfmt::skip]
pub const BINDINGS: &[Binding] = &[
    row(Group::Camera, Action::FrameAll, &[key(Key::F)], "Bring everything into view"),
    row(Group::Camera, Action::FramePicked, &[key(Key::Z)], "Bring what is picked into view"),
    row(Group::Camera, Action::NextCamera, &[key(Key::C)], "The next of the scene's cameras"),
    row(Group::Camera, Action::ViewBack, &[alt(Key::ArrowLeft)], "Back to where the camera was"),
    row(Group::Camera, Action::ViewForward, &[alt(Key::ArrowRight)], "Forward again"),
    row(Group::Camera, Action::FocusByClick, &[key(Key::T)], "Focus on what is clicked next"),
    row(Group::View, Action::Brighter, &[key(Key::Plus), key(Key::Equals)], "Brighter by a third of a stop"),
    row(Group::View, Action::Darker, &[key(Key::Minus)], "Darker by a third of a stop"),
    row(Group::View, Action::AutoExposure, &[key(Key::X)], "Automatic exposure on or off"),
    row(Group::View, Action::NextLayer, &[key(Key::V)], "Show the next layer: albedo, normal, depth, …"),
    row(Group::View, Action::Preview, &[key(Key::N)], "Quick preview by normals, and back"),
    row(Group::View, Action::Pause, &[key(Key::Space)], "Pause and go on"),
    row(Group::View, Action::Restart, &[key(Key::R)], "Begin anew"),
    row(Group::Scene, Action::Deselect, &[key(Key::Escape)], "Pick nothing"),
    row(Group::Scene, Action::Hide, &[key(Key::H)], "Hide what is picked, or show it"),
    row(Group::Scene, Action::Remove, &[key(Key::Delete)], "Remove the light that is picked"),
    row(Group::Scene, Action::Undo, &[ctrl(Key::Z)], "Undo"),
    row(Group::Scene, Action::Redo, &[ctrl_shift(Key::Z), ctrl(Key::Y)], "Redo"),
    row(Group::Program, Action::Open, &[ctrl(Key::O)], "Open a scene, an environment or edits"),
    row(Group::Program, Action::SavePicture, &[ctrl(Key::S)], "Save the picture"),
    row(Group::Program, Action::SaveEdits, &[ctrl_shift(Key::S)], "Save the edits"),
    row(Group::Program, Action::Help, &[key(Key::F1)], "This help"),
    row(Group::Program, Action::Panels, &[key(Key::F10)], "Hide all panels, or show them"),
    row(Group::Program, Action::FullScreen, &[key(Key::F11)], "Fill the screen"),
    row(Group::Program, Action::Quit, &[ctrl(Key::Q)], "Quit"),
];

/// The keys of bookmarks: alone they go there, with Ctrl they are set.
pub const BOOKMARK_KEYS: [Key; 9] =
    [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8, Key::Num9];

/// Keys that fly while they are held, and where to: right, up, forward.
pub const FLIGHT_KEYS: [(Key, Vec3); 6] = [
    (Key::W, Vec3::Z),
    (Key::S, Vec3::NEG_Z),
    (Key::A, Vec3::NEG_X),
    (Key::D, Vec3::X),
    (Key::E, Vec3::Y),
    (Key::Q, Vec3::NEG_Y),
];

/// What the mouse does, and what is not one key: for the help.
pub const GESTURES: &[(Group, &str, &str)] = &[
    (Group::Camera, "Left drag", "Orbit"),
    (Group::Camera, "Right drag", "Look around"),
    (Group::Camera, "Middle drag, Shift + left drag", "Pan"),
    (Group::Camera, "Wheel", "Come closer, go back"),
    (Group::Camera, "Ctrl + wheel", "Narrow or widen the view"),
    (Group::Camera, "W A S D, Q E", "Fly; Shift faster, Alt slower"),
    (Group::Camera, "1 … 9", "Go to a bookmark; with Ctrl set it"),
    (Group::Scene, "Click", "Pick an object and its material"),
    (Group::Scene, "Double click", "Pick it and bring it into view"),
    (Group::Scene, "Drag an arrow", "Move the object that is picked"),
    (Group::Program, "Drop a file", "Open a scene, an environment or edits"),
];

/// The action of a key press, if it has one.
pub fn action(pressed: Key, with: Modifiers) -> Option<Action> {
    let asked = |shortcut: &KeyboardShortcut| {
        shortcut.logical_key == pressed && with.matches_exact(shortcut.modifiers)
    };
    // Plus needs shift on many keyboards.
    let asked_with_shift = |shortcut: &KeyboardShortcut| {
        pressed == Key::Plus && shortcut.logical_key == pressed && with.shift_only()
    };
    let bound = BINDINGS.iter().find(|b| b.keys.iter().any(|k| asked(k) || asked_with_shift(k)));
    bound.map(|b| b.action).or_else(|| bookmark(pressed, with))
}

fn bookmark(pressed: Key, with: Modifiers) -> Option<Action> {
    let place = BOOKMARK_KEYS.iter().position(|k| *k == pressed)? as u8;
    match (with.is_none(), with.matches_exact(Modifiers::COMMAND)) {
        (true, _) => Some(Action::GoTo(place)),
        (_, true) => Some(Action::Bookmark(place)),
        _ => None,
    }
}

/// Where the keys that are held fly to. Ctrl makes them something else.
pub fn flight(held: impl Fn(Key) -> bool, with: Modifiers) -> Flight {
    let keys = FLIGHT_KEYS.iter().filter(|(key, _)| held(*key) && !with.command);
    let direction = keys.map(|(_, direction)| *direction).sum();
    Flight { direction, fast: with.shift, slow: with.alt }
}

/// The keys of a row for people: `Ctrl+Shift+Z, Ctrl+Y`.
pub fn keys_text(keys: &[KeyboardShortcut]) -> String {
    let one = |k: &KeyboardShortcut| {
        let with = k.modifiers;
        let held = [(with.command, "Ctrl+"), (with.shift, "Shift+"), (with.alt, "Alt+")];
        let held: String = held.iter().filter(|(on, _)| *on).map(|(_, name)| *name).collect();
        format!("{held}{}", key_text(k.logical_key))
    };
    keys.iter().map(one).collect::<Vec<_>>().join(", ")
}

fn key_text(key: Key) -> &'static str {
    match key {
        Key::ArrowLeft => "Left",
        Key::ArrowRight => "Right",
        Key::Plus => "+",
        Key::Equals => "=",
        Key::Minus => "-",
        other => other.name(),
    }
}

/// The keys of an action for people; empty if it has none.
pub fn keys_of(action: Action) -> String {
    BINDINGS.iter().find(|b| b.action == action).map(|b| keys_text(b.keys)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_key_does_one_thing() {
        let mut taken: HashSet<(Key, bool, bool, bool)> = HashSet::new();
        let mut take = |k: &KeyboardShortcut| {
            let with = k.modifiers;
            assert!(taken.insert((k.logical_key, with.command, with.shift, with.alt)), "{k:?} twice");
        };
        BINDINGS.iter().flat_map(|b| b.keys).for_each(&mut take);
        FLIGHT_KEYS.iter().for_each(|(k, _)| take(&key(*k)));
        for k in BOOKMARK_KEYS {
            take(&key(k));
            take(&ctrl(k));
        }
        let actions: HashSet<Action> = BINDINGS.iter().map(|b| b.action).collect();
        assert_eq!(actions.len(), BINDINGS.len(), "an action in two rows");
    }

    #[test]
    fn rows_are_found_by_their_keys_and_no_others() {
        for b in BINDINGS {
            for k in b.keys {
                assert_eq!(action(k.logical_key, k.modifiers), Some(b.action));
            }
        }
        assert_eq!(action(Key::Plus, Modifiers::SHIFT), Some(Action::Brighter));
        assert_eq!(action(Key::Z, Modifiers::NONE), Some(Action::FramePicked));
        assert_eq!(action(Key::Z, Modifiers::COMMAND), Some(Action::Undo));
        assert_eq!(action(Key::Z, Modifiers::COMMAND | Modifiers::SHIFT), Some(Action::Redo));
        assert_eq!(action(Key::F, Modifiers::COMMAND), None);
        assert_eq!(action(Key::Num3, Modifiers::NONE), Some(Action::GoTo(2)));
        assert_eq!(action(Key::Num3, Modifiers::COMMAND), Some(Action::Bookmark(2)));
        assert_eq!(action(Key::Num3, Modifiers::ALT), None);
    }

    #[test]
    fn held_keys_fly() {
        let held = |keys: &'static [Key]| move |k: Key| keys.contains(&k);
        assert_eq!(flight(held(&[Key::W, Key::D]), Modifiers::NONE).direction, Vec3::new(1.0, 0.0, 1.0));
        assert!(!flight(held(&[Key::W, Key::S]), Modifiers::NONE).moves());
        assert!(!flight(held(&[Key::S]), Modifiers::COMMAND).moves(), "Ctrl+S saves");
        let fast = flight(held(&[Key::Q]), Modifiers::SHIFT);
        assert!(fast.fast && !fast.slow && fast.direction == Vec3::NEG_Y);
    }

    #[test]
    fn keys_are_named_for_people() {
        assert_eq!(keys_of(Action::Redo), "Ctrl+Shift+Z, Ctrl+Y");
        assert_eq!(keys_of(Action::ViewBack), "Alt+Left");
        assert_eq!(keys_of(Action::Brighter), "+, =");
        assert_eq!(keys_of(Action::GoTo(1)), "");
    }
}
