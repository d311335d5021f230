//! A scene that was compiled before, for one that differs little from it.

use super::{Placed, walk};
use crate::compiled::CompiledScene;
use crate::compiled::geometry::{InstanceRecord, TransformKey};
use crate::{Background, Environment, Scene};
use bytemuck::{Pod, cast_slice};
use std::sync::Arc;

/// A scene and what was made of it. Its meshes and images are those of the scene that is being compiled.
pub(super) struct Earlier<'a> {
    pub(super) authored: &'a Scene,
    pub(super) compiled: &'a CompiledScene,
    /// What its nodes placed.
    pub(super) placed: Vec<Placed>,
}

impl<'a> Earlier<'a> {
    /// `None` where nothing of it is of use for `after`.
    pub(super) fn new(before: &'a Scene, compiled: &'a CompiledScene, after: &Scene) -> Option<Self> {
        let shared = Arc::ptr_eq(&before.meshes, &after.meshes) && Arc::ptr_eq(&before.images, &after.images);
        let (placed, _) = shared.then(|| walk(before, &mut Vec::new()).ok()).flatten()?;
        Some(Earlier { authored: before, compiled, placed })
    }

    /// Whether instances with these records and transforms stand where they stood.
    pub(super) fn stands(&self, instances: &[InstanceRecord], transforms: &[TransformKey]) -> bool {
        let mesh = |i: &InstanceRecord| i.mesh;
        same(&self.compiled.transforms, transforms)
            && self.compiled.instances.iter().map(mesh).eq(instances.iter().map(mesh))
    }

    /// Whether they are as visible as they were.
    pub(super) fn shows(&self, instances: &[InstanceRecord]) -> bool {
        let mask = |i: &InstanceRecord| i.mask;
        self.compiled.instances.iter().map(mask).eq(instances.iter().map(mask))
    }

    /// Whether a map had these texels, of this strength. Other backgrounds are soon made anew.
    pub(super) fn has_map(&self, environment: &Environment) -> bool {
        let before = &self.authored.environment;
        match (&before.background, &environment.background) {
            (Background::Map(a), Background::Map(b)) => {
                let strength = before.strength.to_bits() == environment.strength.to_bits();
                strength && (a.width, a.height) == (b.width, b.height) && Arc::ptr_eq(&a.pixels, &b.pixels)
            }
            _ => false,
        }
    }
}

/// Whether the bits are the same: numbers may be equal and differ in them (0 and -0).
pub(super) fn same<T: Pod>(a: &[T], b: &[T]) -> bool {
    cast_slice::<T, u8>(a) == cast_slice::<T, u8>(b)
}

/// Takes the arrays of `earlier` wherever those that were made are the same, so that clones of both share them.
pub(super) fn share(earlier: &CompiledScene, made: &mut CompiledScene) {
    fn one<T: Pod>(earlier: &Arc<[T]>, made: &mut Arc<[T]>) {
        if !Arc::ptr_eq(earlier, made) && same(earlier, made) {
            *made = earlier.clone();
        }
    }
    one(&earlier.positions, &mut made.positions);
    one(&earlier.normals, &mut made.normals);
    one(&earlier.vertices, &mut made.vertices);
    one(&earlier.triangles, &mut made.triangles);
    one(&earlier.triangle_materials, &mut made.triangle_materials);
    one(&earlier.emissive_ranks, &mut made.emissive_ranks);
    one(&earlier.instances, &mut made.instances);
    one(&earlier.transforms, &mut made.transforms);
    one(&earlier.texels, &mut made.texels);
    one(&earlier.lights, &mut made.lights);
    one(&earlier.near_light_cdf, &mut made.near_light_cdf);
    one(&earlier.far_light_cdf, &mut made.far_light_cdf);
    one(&earlier.triangle_lights, &mut made.triangle_lights);
    one(&earlier.environment_pixels, &mut made.environment_pixels);
    one(&earlier.environment_row_cdf, &mut made.environment_row_cdf);
    one(&earlier.environment_cell_cdf, &mut made.environment_cell_cdf);
    one(&earlier.light_powers, &mut made.light_powers);
}
