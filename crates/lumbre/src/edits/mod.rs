//! What a person changed of a scene, kept beside its file: camera, lights, materials, places of things, settings, look. A viewer edits it,
//! [`Edits::apply`] makes the scene of it that is drawn, and as a file it is small, readable, and can be written by hand (`docs/edits.md`).
//!
//! ```
//! use lumbre::edits::{Edits, Item, Value};
//! use lumbre::scene::{Material, MaterialId, Scene};
//!
//! let mut base = Scene::default();
//! base.add_material(Material { name: "brick".into(), ..Material::default() });
//! let mut edits = Edits::default();
//! edits.set(&base, Item::Material(MaterialId(0)), "roughness", Value::Number(0.25))?;
//! assert_eq!(edits.apply(&base)?.materials[0].roughness, 0.25);
//! assert_eq!(Edits::parse(&edits.to_text())?, edits);
//! // Set back to what the file says, nothing is left of it.
//! edits.set(&base, Item::Material(MaterialId(0)), "roughness", Value::Number(1.0))?;
//! assert_eq!(edits, Edits::default());
//! # Ok::<(), lumbre::edits::EditsError>(())
//! ```
//!
//! All of it is a value: undo is a stack of clones. What can be changed stands in tables, a line for each parameter ([`Row`]).

mod apply;
mod camera;
mod document;
mod error;
mod fit;
mod item;
mod json;
mod lamp;
mod material;
mod names;
mod param;
mod place;
mod settings;
mod sky;
#[cfg(test)]
mod tests;
mod value;

pub use error::EditsError;
pub use item::Item;
pub use param::{Changes, Row};
pub use settings::{LookEdits, settings_rows};
pub use value::{Kind, Value};

use lumbre_core::settings::RenderSettings;
use std::collections::BTreeMap;

/// What was changed of a scene. Empty, it changes nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Edits {
    /// Name of the scene's file, for people; may be empty.
    pub scene: String,
    /// The camera: `camera` (of the file), `eye`, `target`, `up`, `fov`, `height`, `aperture`, `focus`.
    pub camera: Changes,
    /// Cameras to come back to, each of another name.
    pub bookmarks: Vec<Named>,
    sun: Changes,
    sky: Changes,
    /// By key, as all that follow.
    lights: BTreeMap<String, Changes>,
    /// Lights that the file does not have; no two of one name.
    added: Vec<Named>,
    materials: BTreeMap<String, Changes>,
    nodes: BTreeMap<String, Changes>,
    settings: Changes,
    look: Changes,
}

/// Changes with a name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Named {
    /// Not empty.
    pub name: String,
    /// What differs from what it would be by itself.
    pub changes: Changes,
}

impl Edits {
    /// Whether nothing is changed and nothing kept.
    pub fn is_empty(&self) -> bool {
        *self == Edits { scene: self.scene.clone(), ..Edits::default() }
    }

    /// Settings with what was changed of them.
    pub fn settings(&self, base: RenderSettings) -> RenderSettings {
        self.settings.on(settings::SETTINGS, base)
    }

    /// The look with what was changed of it.
    pub fn look(&self, base: LookEdits) -> LookEdits {
        self.look.on(settings::LOOK, base)
    }

    /// The bookmark of a name.
    pub fn bookmark(&self, name: &str) -> Option<&Named> {
        self.bookmarks.iter().find(|b| b.name == name)
    }

    /// The camera with which the picture is taken, in the terms of [`crate::find_camera`].
    pub fn camera_options(&self) -> crate::CameraOptions {
        self.camera.camera_options()
    }
}
