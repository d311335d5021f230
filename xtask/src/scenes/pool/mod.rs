//! `pool.glb`: the project's benchmark scene. An outdoor pool of 25 m between low concrete buildings under a low sun, and a changing
//! room. Metres; the origin is the middle of the water's edge line at deck height, x runs along the lanes, y up. Dimensions and
//! patterns are this project's own.

#[allow(dead_code, reason = "it joins the parts when the building stands around it")]
mod interior;

use super::kit::{Document, Material, Texture, bevel_box};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// The scene under construction.
#[derive(Default)]
pub(super) struct Pool {
    pub(super) document: Document,
    materials: BTreeMap<&'static str, usize>,
    #[allow(dead_code, reason = "the first textured part is being written")]
    textures: BTreeMap<&'static str, Texture>,
}

impl Pool {
    /// The material of that name, made on first use; `make` gets the scene for its textures.
    pub(super) fn material(&mut self, name: &'static str, make: impl FnOnce(&mut Pool) -> Material) -> usize {
        if let Some(&index) = self.materials.get(name) {
            return index;
        }
        let material = make(self);
        let index = self.document.material(material);
        self.materials.insert(name, index);
        index
    }

    #[allow(dead_code, reason = "the first textured part is being written")]
    /// The texture of that name, made on first use from a PNG and the metres that it covers.
    pub(super) fn texture(
        &mut self,
        name: &'static str,
        size: [f64; 2],
        png: impl FnOnce() -> Vec<u8>,
    ) -> Texture {
        if let Some(&texture) = self.textures.get(name) {
            return texture;
        }
        let texture = self.document.texture_of(name, &png(), size);
        self.textures.insert(name, texture);
        texture
    }
}

/// The parts of the scene, in the order in which they stand in the file.
const PARTS: &[fn(&mut Pool)] = &[cameras, ground];

/// The scene as a `.glb` file.
pub(super) fn pool() -> Vec<u8> {
    build().document.to_glb()
}

fn build() -> Pool {
    let mut pool = Pool::default();
    PARTS.iter().for_each(|part| part(&mut pool));
    pool
}

/// The cameras; the first is the default.
fn cameras(pool: &mut Pool) {
    let eye = DVec3::new(-17.0, 1.75, 9.0);
    pool.document.camera("exterior", [eye, DVec3::new(0.0, 0.9, -1.0)], 42.0, 16.0 / 9.0);
}

fn ground(pool: &mut Pool) {
    let concrete = pool.material("concrete", |_| Material::new("concrete", [0.4; 3], 0.8));
    let slab = bevel_box(DVec3::new(-20.0, -0.5, -15.0), DVec3::new(20.0, 0.0, 15.0), 0.02);
    pool.document.place("ground", &slab.box_uvs(DVec2::ZERO), concrete);
}
