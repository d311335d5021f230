//! `pool.glb`: the project's benchmark scene. An outdoor pool of 25 m between low concrete buildings under a low sun, and a changing
//! room. Metres; the origin is the middle of the water's edge line at deck height, x runs along the lanes, y up. Dimensions and
//! patterns are this project's own.

mod basin;
mod buildings;
mod canopies;
mod deck;
mod fence;
mod green;
mod interior;
mod joinery;
mod lanes;
mod props;
mod surfaces;
mod wet;

use super::kit::{Document, Material, Placement, Texture};
use glam::DVec3;
use serde_json::json;
use std::collections::BTreeMap;

/// Half the length and the width of the water, its height, and the depths of the floor at both ends.
const HALF_LENGTH: f64 = 12.5;
const HALF_WIDTH: f64 = LANES as f64 * LANE_WIDTH / 2.0;
const LANES: usize = 5;
const LANE_WIDTH: f64 = 2.5;
const WATER: f64 = -0.03;
const DEPTH: [f64; 2] = [-1.35, -1.95];

/// Elevation of the sun and its azimuth from -z towards +x, degrees; the illuminance of its brightest band, lux.
const SUN: [f64; 3] = [25.0, 128.0, 23.5];

/// The scene under construction.
#[derive(Default)]
pub(super) struct Pool {
    pub(super) document: Document,
    materials: BTreeMap<&'static str, usize>,
    textures: BTreeMap<&'static str, Texture>,
    /// What the openings of the buildings are filled with.
    joinery: joinery::Joinery,
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
const PARTS: &[fn(&mut Pool)] = &[
    cameras,
    basin::basin,
    basin::kerb,
    deck::slabs,
    deck::drain,
    wet::puddles,
    wet::footprints,
    wet::cracks,
    deck::land,
    lanes::ropes,
    lanes::ladders,
    lanes::blocks,
    lanes::flags,
    buildings::buildings,
    joinery::joinery,
    interior::interior,
    canopies::canopies,
    props::props,
    fence::fence,
    green::trees,
    green::palms,
    green::hills,
];

/// The scene as a `.glb` file.
pub(super) fn pool() -> Vec<u8> {
    build().document.to_glb()
}

fn build() -> Pool {
    let mut pool = Pool::default();
    PARTS.iter().for_each(|part| part(&mut pool));
    pool
}

/// The cameras, of which the first is the default, and the light of a late afternoon.
fn cameras(pool: &mut Pool) {
    let view = [DVec3::new(-21.2, 2.3, 9.2), DVec3::new(-2.5, 0.5, -2.2)];
    pool.document.camera("exterior", view, 35.0, 16.0 / 9.0);
    pool.document.sky("gradient");
    // A light without a disc: what flat water and chrome mirror of a disc are caustics that a path tracer finds once in millions of
    // paths, each then a white dot.
    let (sin_e, cos_e) = libm::sincos(SUN[0].to_radians());
    let (sin_a, cos_a) = libm::sincos(SUN[1].to_radians());
    let from = DVec3::new(cos_e * sin_a, sin_e, -cos_e * cos_a);
    let sun = json!({ "type": "directional", "color": [1.0, 0.93, 0.82], "intensity": SUN[2] });
    pool.document.light("sun", sun, &Placement::looking(from * 40.0, DVec3::ZERO));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scene_is_as_rich_as_it_should_be() {
        let census = build().document.census();
        println!("{census:#?}");
        assert!((80_000..=150_000).contains(&census.triangles), "{} triangles", census.triangles);
        assert!(census.meshes >= 40, "{} meshes", census.meshes);
        assert!(census.textured >= 12, "{} textured materials", census.textured);
        assert!(census.normal_mapped >= 6, "{} materials with normal maps", census.normal_mapped);
        let (name, share) = census.largest();
        assert!(share <= 0.15, "{name} has {:.1} % of the triangles", share * 100.0);
    }
}
