//! From a scene and its edits to the scene that is drawn.

use super::camera::{SHOT, Shot};
use super::error::under;
use super::lamp::{LAMP, Lamp};
use super::material::{MATERIAL, Painted};
use super::names::{Named as Kind, Names};
use super::param::{Changes, Param};
use super::place::{PLACE, Place};
use super::settings::{LOOK, LookEdits};
use super::sky::{Heaven, SKY, SUN, Sunlight};
use super::{Edits, EditsError};
use lumbre_core::Camera;
use lumbre_core::camera::Projection;
use lumbre_scene::{EnvironmentMap, NodeId, Scene};
use std::collections::BTreeMap;

// Members of the document.
pub(super) const SUN_KEY: &str = "sun";
pub(super) const SKY_KEY: &str = "sky";
pub(super) const LIGHTS_KEY: &str = "lights";
pub(super) const ADDED_KEY: &str = "addedLights";
pub(super) const MATERIALS_KEY: &str = "materials";
pub(super) const NODES_KEY: &str = "nodes";
pub(super) const CAMERA_KEY: &str = "camera";
pub(super) const BOOKMARKS_KEY: &str = "bookmarks";
pub(super) const SETTINGS_KEY: &str = "settings";
pub(super) const LOOK_KEY: &str = "look";

impl Edits {
    /// The scene with these edits. Nothing but the arguments decides it, and an empty document makes a copy.
    ///
    /// # Errors
    /// If they name what the scene does not have, or a file for the sky: [`Edits::apply_with`] takes what was read from it.
    pub fn apply(&self, base: &Scene) -> Result<Scene, EditsError> {
        self.apply_with(base, None)
    }

    /// The same; `map` is what [`Edits::sky_file`] holds.
    ///
    /// # Errors
    /// If they name what the scene does not have, or a file for the sky that was not read.
    pub fn apply_with(&self, base: &Scene, map: Option<&EnvironmentMap>) -> Result<Scene, EditsError> {
        let mut scene = base.clone();
        // Places first: those of lights are in the world.
        for (index, _, changes) in found(base, Kind::Nodes, &self.nodes, NODES_KEY)? {
            let node = &mut scene.nodes[index];
            changes.on(PLACE, Place::from(&*node)).put(node);
        }
        for (index, _, changes) in found(base, Kind::Lights, &self.lights, LIGHTS_KEY)? {
            let node = NodeId(index as u32);
            if let Some(lamp) = Lamp::of(&scene, node) {
                changes.on(LAMP, lamp).put(&mut scene, node);
            }
        }
        for light in &self.added {
            light.changes.on(LAMP, Lamp::default()).add(&mut scene, &light.name);
        }
        for (index, _, changes) in found(base, Kind::Materials, &self.materials, MATERIALS_KEY)? {
            let material = &mut scene.materials[index];
            *material = changes.on(MATERIAL, Painted::from(material.clone())).material;
        }
        if !self.sun.is_empty() {
            scene.environment.sun = self.sun.on(SUN, Sunlight::from(scene.environment.sun)).sun();
        }
        if !self.sky.is_empty() {
            let heaven = self.sky.on(SKY, Heaven::from(&scene.environment));
            heaven.put(&mut scene.environment, map).map_err(|e| e.under(&under("", SKY_KEY)))?;
        }
        Ok(scene)
    }

    /// The file from which the sky's map is to be read, as it was named.
    pub fn sky_file(&self) -> Option<std::path::PathBuf> {
        // Of any scene: whether it is a file does not hang on what the scene has.
        self.sky.on(SKY, Heaven::from(&Default::default())).file().map(Into::into)
    }

    /// Changes that do not show as things are, each as a line with its place: the angle of a light that is no spot, the elevation of a sun
    /// that is off. Not an error: what was set stays when it is switched off.
    ///
    /// # Errors
    /// As [`Edits::apply`].
    pub fn idle(&self, base: &Scene) -> Result<Vec<String>, EditsError> {
        let mut out = Vec::new();
        let camera = Camera {
            // Which kind it is stands in the scene: what means something to either is not idle.
            projection: Projection::Orthographic { half_height: 1.0 },
            ..Camera::look_at(glam::Vec3::ZERO, glam::Vec3::NEG_Z, glam::Vec3::Y, 1.0, 1.0)
        };
        idle(&mut out, &under("", CAMERA_KEY), &self.camera, SHOT, Shot::from(&camera));
        idle(&mut out, &under("", SUN_KEY), &self.sun, SUN, Sunlight::from(base.environment.sun));
        // All of a node shows, but it must be there.
        found(base, Kind::Nodes, &self.nodes, NODES_KEY)?;
        idle(&mut out, &under("", SKY_KEY), &self.sky, SKY, Heaven::from(&base.environment));
        for (index, key, changes) in found(base, Kind::Lights, &self.lights, LIGHTS_KEY)? {
            if let Some(lamp) = Lamp::of(base, NodeId(index as u32)) {
                idle(&mut out, &under(&under("", LIGHTS_KEY), key), changes, LAMP, lamp);
            }
        }
        for light in &self.added {
            let place = under(&under("", ADDED_KEY), &light.name);
            idle(&mut out, &place, &light.changes, LAMP, Lamp::default());
        }
        for (index, key, changes) in found(base, Kind::Materials, &self.materials, MATERIALS_KEY)? {
            let painted = Painted::from(base.materials[index].clone());
            idle(&mut out, &under(&under("", MATERIALS_KEY), key), changes, MATERIAL, painted);
        }
        idle(&mut out, &under("", LOOK_KEY), &self.look, LOOK, LookEdits::default());
        Ok(out)
    }
}

fn idle<T>(out: &mut Vec<String>, place: &str, changes: &Changes, table: &'static [Param<T>], base: T) {
    let names = changes.idle(table, base);
    out.extend(names.into_iter().map(|name| format!("{}: does not show, as things are", under(place, name))));
}

type Found<'e> = (usize, &'e str, &'e Changes);

/// Edited things with their numbers.
fn found<'e>(
    base: &Scene,
    kind: Kind,
    all: &'e BTreeMap<String, Changes>,
    member: &str,
) -> Result<Vec<Found<'e>>, EditsError> {
    let numbers = Names::of(base, kind).find(all.keys().map(|key| &**key));
    let one = |((key, changes), number): ((&'e String, &'e Changes), Result<usize, EditsError>)| {
        number.map(|n| (n, &**key, changes)).map_err(|e| e.under(&under("", member)))
    };
    all.iter().zip(numbers).map(one).collect()
}
