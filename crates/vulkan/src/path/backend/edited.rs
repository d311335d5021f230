//! A scene that was edited: what changed goes to the device, and the rest stays.

use super::VulkanBackend;
use crate::hybrid::HybridScene;
use crate::path::variant::SceneConstants;
use crate::{Upload, VulkanError};
use lumbre_scene::{CompiledScene, Part, SceneChanges};
use std::sync::PoisonError;

impl VulkanBackend {
    /// Takes an edited scene, which differs from the present one in `changes`: what it then draws is what a new backend with the same
    /// options would draw. What changed goes to the device; pipelines are made again only when the scene needs a feature that those there are
    /// lack, and acceleration structures of meshes only where [`crate::SceneOnGpu::update`] says so.
    ///
    /// # Errors
    /// If memory is out or the device is lost. Nothing can be drawn then until another update succeeds.
    pub fn update(&mut self, scene: &CompiledScene, changes: SceneChanges) -> Result<(), VulkanError> {
        // What a failure left is made anew.
        let changes = if self.failed.is_some() { SceneChanges::all() } else { changes };
        self.failed = self.take(scene, changes).err();
        self.failed.clone().map_or(Ok(()), Err)
    }

    fn take(&mut self, scene: &CompiledScene, changes: SceneChanges) -> Result<(), VulkanError> {
        let work = self.work.get_mut().unwrap_or_else(PoisonError::into_inner);
        if self.scene.update(scene, changes)? {
            work.variants.clear();
            work.hybrid.clear();
            work.frames = None;
        }
        let moved = changes.geometry() || changes.any(&[Part::Instances, Part::Transforms]);
        if moved || changes.has(Part::Materials) {
            self.solids.update(scene, moved);
            work.media = None;
        }
        self.constants = SceneConstants::new(scene);
        self.version += 1;
        let mut upload = Upload::new(&self.gpu);
        self.hybrid = HybridScene::new(&mut upload, scene)?;
        upload.finish()
    }
}
