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

    /// Whether instances with these records and transforms stand where they stood, and are as visible.
    pub(super) fn stands(&self, instances: &[InstanceRecord], transforms: &[TransformKey]) -> bool {
        let mask = |i: &InstanceRecord| (i.mesh, i.mask);
        same(&self.compiled.transforms, transforms)
            && self.compiled.instances.iter().map(mask).eq(instances.iter().map(mask))
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

/// What was made, or what was there before if it is the same, so that it is shared.
pub(super) fn share<T: Pod>(made: Vec<T>, earlier: Option<&Arc<[T]>>) -> Arc<[T]> {
    match earlier {
        Some(earlier) if same(earlier, &made) => earlier.clone(),
        _ => made.into(),
    }
}
