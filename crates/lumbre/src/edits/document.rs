//! Edits as a file: JSON of which each member is optional but the first.

use super::apply::{
    ADDED_KEY, BOOKMARKS_KEY, CAMERA_KEY, LIGHTS_KEY, LOOK_KEY, MATERIALS_KEY, NODES_KEY, SETTINGS_KEY,
    SKY_KEY, SUN_KEY,
};
use super::camera::SHOT;
use super::error::under;
use super::json::{self, Json, Node, Writer, quoted};
use super::lamp::LAMP;
use super::material::MATERIAL;
use super::param::{Changes, Param, members};
use super::place::PLACE;
use super::settings::{LOOK, SETTINGS};
use super::sky::{SKY, SUN};
use super::{Edits, EditsError, Named, Value};
use lumbre_io::{IoError, read_text, write_text};
use std::collections::BTreeMap;
use std::path::Path;

/// The member that tells such a file from others, and its value.
const VERSION_KEY: &str = "lumbreEdits";
const VERSION: u32 = 1;
const SCENE_KEY: &str = "scene";

/// All members, in their order.
const MEMBERS: [&str; 12] = [
    VERSION_KEY,
    SCENE_KEY,
    CAMERA_KEY,
    BOOKMARKS_KEY,
    SUN_KEY,
    SKY_KEY,
    LIGHTS_KEY,
    ADDED_KEY,
    MATERIALS_KEY,
    NODES_KEY,
    SETTINGS_KEY,
    LOOK_KEY,
];

impl Edits {
    /// Most bytes of a file: more than a hundred thousand edited things.
    pub const MAX_BYTES: u64 = 16 << 20;

    /// Reads a file. The path of a sky is taken from the file's folder.
    ///
    /// # Errors
    /// If it cannot be read, is too large, is no such document, or holds what the tables do not know.
    pub fn read(path: impl AsRef<Path>) -> Result<Edits, IoError> {
        let path = path.as_ref();
        let text = read_text(path, Self::MAX_BYTES)?;
        let mut edits = Edits::parse(&text).map_err(|e| e.in_file(path))?;
        edits.move_sky(|file| {
            path.parent().unwrap_or(Path::new("")).join(file).to_string_lossy().into_owned()
        });
        Ok(edits)
    }

    /// Writes a file in one step. The path of a sky in its folder, or below, is written from there.
    ///
    /// # Errors
    /// If it cannot be written; an older file is then as it was.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), IoError> {
        let path = path.as_ref();
        let full = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
        let whole = full(path);
        let folder = whole.parent().unwrap_or(Path::new(""));
        let mut edits = self.clone();
        edits.move_sky(|file| {
            let file = full(Path::new(file));
            file.strip_prefix(folder).unwrap_or(&file).to_string_lossy().into_owned()
        });
        write_text(path, &edits.to_text())
    }

    fn move_sky(&mut self, to: impl FnOnce(&str) -> String) {
        if let Some(file) = self.sky.get("file").and_then(Value::as_text).map(to) {
            // A path that was not empty does not become so.
            self.sky.insert(SKY, "file", Value::Text(file)).unwrap_or_default();
        }
    }

    /// Reads a text.
    ///
    /// # Errors
    /// One, with line and place, for the first thing that is wrong.
    pub fn parse(text: &str) -> Result<Edits, EditsError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.len() as u64 > Self::MAX_BYTES {
            let reason = format!("{} bytes exceed the limit of {}", text.len(), Self::MAX_BYTES);
            return Err(EditsError { place: String::new(), line: None, reason });
        }
        let wrong =
            |e: json::Wrong| EditsError { place: String::new(), line: Some(e.line), reason: e.reason };
        let root = json::parse(text).map_err(wrong)?;
        version(&root)?;
        let mut edits = Edits::default();
        for (key, json) in members(&root, "")? {
            edits.member(key, json)?;
        }
        Ok(edits)
    }

    fn member(&mut self, key: &str, json: &Json<'_>) -> Result<(), EditsError> {
        let place = under("", key);
        match key {
            VERSION_KEY => {}
            SCENE_KEY => self.scene = string(key, json)?,
            CAMERA_KEY => self.camera = shot(json, &place)?,
            BOOKMARKS_KEY => self.bookmarks = named(json, &place, shot)?,
            SUN_KEY => self.sun = Changes::read(SUN, json, &place)?,
            SKY_KEY => self.sky = Changes::read(SKY, json, &place)?,
            LIGHTS_KEY => self.lights = keyed(LAMP, json, &place)?,
            ADDED_KEY => self.added = named(json, &place, |json, place| Changes::read(LAMP, json, place))?,
            MATERIALS_KEY => self.materials = keyed(MATERIAL, json, &place)?,
            NODES_KEY => self.nodes = keyed(PLACE, json, &place)?,
            SETTINGS_KEY => self.settings = Changes::read(SETTINGS, json, &place)?,
            LOOK_KEY => self.look = Changes::read(LOOK, json, &place)?,
            _ => {
                let reason = format!("there is no such key here; there are {}", MEMBERS.join(", "));
                return Err(EditsError::new(key, reason).at_line(json.line));
            }
        }
        Ok(())
    }

    /// As a text: indented, in an order that does not change.
    pub fn to_text(&self) -> String {
        Writer::document(|w| {
            w.member(VERSION_KEY, &VERSION.to_string());
            if !self.scene.is_empty() {
                w.member(SCENE_KEY, &quoted(&self.scene));
            }
            one(w, CAMERA_KEY, &self.camera, SHOT);
            many(w, BOOKMARKS_KEY, self.bookmarks.iter().map(|b| (&*b.name, &b.changes)), SHOT);
            one(w, SUN_KEY, &self.sun, SUN);
            one(w, SKY_KEY, &self.sky, SKY);
            many(w, LIGHTS_KEY, by_key(&self.lights), LAMP);
            many(w, ADDED_KEY, self.added.iter().map(|l| (&*l.name, &l.changes)), LAMP);
            many(w, MATERIALS_KEY, by_key(&self.materials), MATERIAL);
            many(w, NODES_KEY, by_key(&self.nodes), PLACE);
            one(w, SETTINGS_KEY, &self.settings, SETTINGS);
            one(w, LOOK_KEY, &self.look, LOOK);
        })
    }
}

/// Refuses what is no such document, or a newer one, before anything in it is looked at.
fn version(root: &Json<'_>) -> Result<(), EditsError> {
    let members = members(root, "")?;
    let Some((_, json)) = members.iter().find(|(key, _)| key == VERSION_KEY) else {
        let reason = format!("these are no edits of lumbre: \"{VERSION_KEY}\": {VERSION} is missing");
        return Err(EditsError { place: String::new(), line: Some(root.line), reason });
    };
    let wrong = |reason: String| Err(EditsError::new(VERSION_KEY, reason).at_line(json.line));
    match &json.node {
        Node::Number(text) => match text.parse::<u32>() {
            Ok(VERSION) => Ok(()),
            Ok(newer) if newer > VERSION => {
                wrong(format!("version {newer} is newer than this program, which reads {VERSION}"))
            }
            _ => wrong(format!("expected {VERSION}")),
        },
        _ => wrong(format!("expected {VERSION}")),
    }
}

fn string(key: &str, json: &Json<'_>) -> Result<String, EditsError> {
    match &json.node {
        Node::Text(text) => Ok(text.to_string()),
        _ => Err(EditsError::new(key, "expected a string").at_line(json.line)),
    }
}

fn shot(json: &Json<'_>, place: &str) -> Result<Changes, EditsError> {
    let changes = Changes::read(SHOT, json, place)?;
    changes.check_shot().map_err(|e| e.under(place).at_line(json.line))?;
    Ok(changes)
}

fn keyed<T>(
    table: &'static [Param<T>],
    json: &Json<'_>,
    place: &str,
) -> Result<BTreeMap<String, Changes>, EditsError> {
    let one = |(key, json): &(std::borrow::Cow<'_, str>, Json<'_>)| {
        Ok((key.to_string(), Changes::read(table, json, &under(place, key))?))
    };
    // An object without members changes nothing and is not kept.
    let all: Result<Vec<_>, EditsError> = members(json, place)?.iter().map(one).collect();
    Ok(all?.into_iter().filter(|(_, changes)| !changes.is_empty()).collect())
}

fn named(
    json: &Json<'_>,
    place: &str,
    read: impl Fn(&Json<'_>, &str) -> Result<Changes, EditsError>,
) -> Result<Vec<Named>, EditsError> {
    let one = |(key, json): &(std::borrow::Cow<'_, str>, Json<'_>)| {
        if key.is_empty() {
            return Err(EditsError::new(key, "it needs a name").under(place).at_line(json.line));
        }
        Ok(Named { name: key.to_string(), changes: read(json, &under(place, key))? })
    };
    members(json, place)?.iter().map(one).collect()
}

fn by_key(all: &BTreeMap<String, Changes>) -> impl ExactSizeIterator<Item = (&str, &Changes)> {
    all.iter().map(|(key, changes)| (&**key, changes))
}

fn one<T>(w: &mut Writer, key: &str, changes: &Changes, table: &[Param<T>]) {
    if !changes.is_empty() {
        w.object(key, |w| changes.write(table, w));
    }
}

fn many<'c, T>(
    w: &mut Writer,
    key: &str,
    all: impl ExactSizeIterator<Item = (&'c str, &'c Changes)>,
    table: &[Param<T>],
) {
    if all.len() > 0 {
        w.object(key, |w| all.for_each(|(name, changes)| w.object(name, |w| changes.write(table, w))));
    }
}
