//! Editing thing by thing, as a panel does it: whatever is edited is an [`Item`], and its parameters are rows.

use super::camera::{SHOT, Shot};
use super::lamp::{LAMP, Lamp};
use super::material::{MATERIAL, Painted};
use super::names::{Named as Kind, Names};
use super::param::{Changes, Row};
use super::place::{PLACE, Place};
use super::settings::{LOOK, LookEdits, SETTINGS};
use super::sky::{Heaven, SKY, SUN, Sunlight};
use super::{Edits, EditsError, Named, Value};
use lumbre_core::Camera;
use lumbre_core::settings::RenderSettings;
use lumbre_scene::{MaterialId, NodeId, Scene};
use std::collections::BTreeMap;

/// Something that has parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Item {
    /// The camera that looks.
    Camera,
    /// A bookmark, by its place in [`Edits::bookmarks`].
    Bookmark(usize),
    /// The sun.
    Sun,
    /// The sky.
    Sky,
    /// The light that a node of the file holds.
    Light(NodeId),
    /// A light that was added, by its place in [`Edits::added_lights`].
    Added(usize),
    /// A material of the file.
    Material(MaterialId),
    /// A node of the file.
    Node(NodeId),
    /// How paths are traced.
    Settings,
    /// How the film is developed.
    Look,
}

fn gone(what: &str, index: usize) -> EditsError {
    EditsError::new("", format!("there is no {what} {index}"))
}

/// The key of one of the scene's things.
fn key(base: &Scene, kind: Kind, what: &str, index: usize) -> Result<String, EditsError> {
    Names::of(base, kind).key(index).ok_or_else(|| gone(what, index))
}

/// Edits one of many things that are known by key; of what is unchanged nothing is kept.
fn edit(
    all: &mut BTreeMap<String, Changes>,
    key: String,
    with: impl FnOnce(&mut Changes) -> Result<(), EditsError>,
) -> Result<(), EditsError> {
    let mut changes = all.get(&key).cloned().unwrap_or_default();
    with(&mut changes)?;
    if changes.is_empty() {
        all.remove(&key);
    } else {
        all.insert(key, changes);
    }
    Ok(())
}

impl Edits {
    /// Sets a parameter of a thing. Set to what it is without that, it leaves the document. (Of a camera nothing leaves by itself: it is not
    /// known here what it would be. [`Edits::unset`] does it.)
    ///
    /// # Errors
    /// If the scene has no such thing, the thing no such parameter, or the parameter may not hold that.
    pub fn set(&mut self, base: &Scene, item: Item, name: &str, value: Value) -> Result<(), EditsError> {
        match item {
            Item::Camera => self.camera.set_shot(name, value),
            Item::Bookmark(i) => named(&mut self.bookmarks, "bookmark", i)?.set_shot(name, value),
            Item::Sun => self.sun.set(SUN, &Sunlight::from(base.environment.sun), name, value),
            Item::Sky => self.sky.set(SKY, &Heaven::from(&base.environment), name, value),
            Item::Light(node) => {
                let lamp = lamp(base, node)?;
                let key = key(base, Kind::Lights, "light", node.index())?;
                edit(&mut self.lights, key, |c| c.set(LAMP, &lamp, name, value))
            }
            Item::Added(i) => {
                named(&mut self.added, "added light", i)?.set(LAMP, &Lamp::default(), name, value)
            }
            Item::Material(id) => {
                let painted = painted(base, id)?;
                let key = key(base, Kind::Materials, "material", id.index())?;
                edit(&mut self.materials, key, |c| c.set(MATERIAL, &painted, name, value))
            }
            Item::Node(id) => {
                let place = place(base, id)?;
                let key = key(base, Kind::Nodes, "node", id.index())?;
                edit(&mut self.nodes, key, |c| c.set(PLACE, &place, name, value))
            }
            Item::Settings => self.settings.set(SETTINGS, &RenderSettings::default(), name, value),
            Item::Look => self.look.set(LOOK, &LookEdits::default(), name, value),
        }
    }

    /// All parameters of a thing as they are with these edits. `shown` is the camera that the picture is taken with, edits and all.
    ///
    /// # Errors
    /// If there is no such thing.
    pub fn rows(&self, base: &Scene, shown: &Camera, item: Item) -> Result<Vec<Row>, EditsError> {
        let none = Changes::default();
        let changes = self.changes(base, item)?.unwrap_or(&none);
        Ok(match item {
            Item::Camera | Item::Bookmark(_) => changes.rows(SHOT, Shot::from(shown)),
            Item::Sun => changes.rows(SUN, base.environment.sun.into()),
            Item::Sky => changes.rows(SKY, (&base.environment).into()),
            Item::Light(node) => changes.rows(LAMP, lamp(base, node)?),
            Item::Added(_) => changes.rows(LAMP, Lamp::default()),
            Item::Material(id) => changes.rows(MATERIAL, painted(base, id)?),
            Item::Node(id) => changes.rows(PLACE, place(base, id)?),
            Item::Settings => changes.rows(SETTINGS, RenderSettings::default()),
            Item::Look => changes.rows(LOOK, LookEdits::default()),
        })
    }

    /// What is changed of a thing; `None`: nothing.
    ///
    /// # Errors
    /// If there is no such thing.
    pub fn changes(&self, base: &Scene, item: Item) -> Result<Option<&Changes>, EditsError> {
        let of = |all: &'_ [Named], what, i: usize| -> Result<(), EditsError> {
            all.get(i).map(|_| ()).ok_or_else(|| gone(what, i))
        };
        let changes = match item {
            Item::Camera => Some(&self.camera),
            Item::Bookmark(i) => {
                of(&self.bookmarks, "bookmark", i)?;
                Some(&self.bookmarks[i].changes)
            }
            Item::Sun => Some(&self.sun),
            Item::Sky => Some(&self.sky),
            Item::Light(node) => self.lights.get(&key(base, Kind::Lights, "light", node.index())?),
            Item::Added(i) => {
                of(&self.added, "added light", i)?;
                Some(&self.added[i].changes)
            }
            Item::Material(id) => self.materials.get(&key(base, Kind::Materials, "material", id.index())?),
            Item::Node(id) => self.nodes.get(&key(base, Kind::Nodes, "node", id.index())?),
            Item::Settings => Some(&self.settings),
            Item::Look => Some(&self.look),
        };
        Ok(changes.filter(|c| !c.is_empty()))
    }

    /// Takes a change back.
    ///
    /// # Errors
    /// If there is no such thing.
    pub fn unset(&mut self, base: &Scene, item: Item, name: &str) -> Result<(), EditsError> {
        self.with(base, item, |changes| changes.remove(name))
    }

    /// Takes all changes of a thing back.
    ///
    /// # Errors
    /// If there is no such thing.
    pub fn reset(&mut self, base: &Scene, item: Item) -> Result<(), EditsError> {
        self.with(base, item, |changes| *changes = Changes::default())
    }

    fn with(&mut self, base: &Scene, item: Item, with: impl FnOnce(&mut Changes)) -> Result<(), EditsError> {
        let done = |changes: &mut Changes| {
            with(changes);
            Ok(())
        };
        match item {
            Item::Camera => done(&mut self.camera),
            Item::Bookmark(i) => done(named(&mut self.bookmarks, "bookmark", i)?),
            Item::Sun => done(&mut self.sun),
            Item::Sky => done(&mut self.sky),
            Item::Light(node) => {
                edit(&mut self.lights, key(base, Kind::Lights, "light", node.index())?, done)
            }
            Item::Added(i) => done(named(&mut self.added, "added light", i)?),
            Item::Material(id) => {
                edit(&mut self.materials, key(base, Kind::Materials, "material", id.index())?, done)
            }
            Item::Node(id) => edit(&mut self.nodes, key(base, Kind::Nodes, "node", id.index())?, done),
            Item::Settings => done(&mut self.settings),
            Item::Look => done(&mut self.look),
        }
    }

    /// Lights that the file does not have.
    pub fn added_lights(&self) -> &[Named] {
        &self.added
    }

    /// Adds a light, a point light at the origin until it is set otherwise. Its name is `wanted` or, where one has that already, the same
    /// with a number.
    pub fn add_light(&mut self, wanted: &str) -> Item {
        let name = free_name(&self.added, if wanted.is_empty() { "light" } else { wanted });
        self.added.push(Named { name, changes: Changes::default() });
        Item::Added(self.added.len() - 1)
    }

    /// Removes a light: one that was added leaves the document, one of the file is switched off.
    ///
    /// # Errors
    /// If there is no such light.
    pub fn remove_light(&mut self, base: &Scene, item: Item) -> Result<(), EditsError> {
        match item {
            Item::Added(i) if i < self.added.len() => {
                self.added.remove(i);
                Ok(())
            }
            Item::Added(i) => Err(gone("added light", i)),
            _ => self.set(base, item, "on", Value::Flag(false)),
        }
    }

    /// Keeps a camera under a name, or under the same with a number where one has that already.
    pub fn add_bookmark(&mut self, wanted: &str, camera: Changes) -> Item {
        let name = free_name(&self.bookmarks, if wanted.is_empty() { "view" } else { wanted });
        self.bookmarks.push(Named { name, changes: camera });
        Item::Bookmark(self.bookmarks.len() - 1)
    }
}

fn free_name(all: &[Named], wanted: &str) -> String {
    let taken = |name: &str| all.iter().any(|n| n.name == name);
    let numbered = (2..).map(|i| format!("{wanted} {i}"));
    std::iter::once(wanted.to_owned()).chain(numbered).find(|name| !taken(name)).unwrap_or_default()
}

fn named<'n>(all: &'n mut [Named], what: &str, index: usize) -> Result<&'n mut Changes, EditsError> {
    all.get_mut(index).map(|n| &mut n.changes).ok_or_else(|| gone(what, index))
}

fn lamp(base: &Scene, node: NodeId) -> Result<Lamp, EditsError> {
    Lamp::of(base, node).ok_or_else(|| gone("light", node.index()))
}

fn painted(base: &Scene, id: MaterialId) -> Result<Painted, EditsError> {
    base.materials.get(id.index()).cloned().map(Painted::from).ok_or_else(|| gone("material", id.index()))
}

fn place(base: &Scene, id: NodeId) -> Result<Place, EditsError> {
    base.nodes.get(id.index()).map(Place::from).ok_or_else(|| gone("node", id.index()))
}
