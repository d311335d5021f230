//! What hybrid frames take from the path tracer's backend: the scene, the tables, pipelines that are kept from frame to frame.

use super::{VARIANTS, VulkanBackend};
use crate::hybrid::{HybridPasses, HybridScene, KeptFrames};
use crate::{PipelineCache, SceneOnGpu, VulkanError};
use lumbre_core::hybrid::HybridSettings;
use lumbre_core::medium::MediumStack;
use lumbre_core::settings::{RenderSettings, View};
use std::sync::Arc;

impl VulkanBackend {
    pub(crate) fn scene_on_gpu(&self) -> &SceneOnGpu {
        &self.scene
    }

    pub(crate) fn hybrid_scene(&self) -> &HybridScene {
        &self.hybrid
    }

    /// Updates of the scene so far.
    pub(crate) fn version(&self) -> u64 {
        self.version
    }

    /// What the last frames left, for those to come.
    pub(crate) fn take_frames(&self) -> Option<KeptFrames> {
        self.lock().frames.take()
    }

    pub(crate) fn keep_frames(&self, frames: KeptFrames) {
        self.lock().frames = Some(frames);
    }

    pub(crate) fn pipeline_cache(&self) -> &PipelineCache {
        &self.cache
    }

    /// Address of the tables of numbers.
    pub(crate) fn tables_address(&self) -> u64 {
        self.tables.address()
    }

    /// The passes for a view's settings, made if there are none yet, and the solids around its camera.
    ///
    /// # Errors
    /// If an update failed before, the driver refuses a pipeline or memory is out.
    pub(crate) fn hybrid_parts(
        &self,
        view: &View,
        hybrid: &HybridSettings,
    ) -> Result<(Arc<HybridPasses>, MediumStack), VulkanError> {
        self.failed.clone().map_or(Ok(()), Err)?;
        let mut work = self.lock();
        let media = self.media_around(&mut work, view.camera.origin);
        // Of settings that only paths have nothing is compiled.
        let path = RenderSettings::default();
        let settings =
            RenderSettings { sampler: path.sampler, light_sampling: true, clamp: None, ..view.settings };
        let constants = self
            .constants
            .with(&settings)
            .bool(70, hybrid.soft_shadows)
            .bool(71, hybrid.global_illumination)
            .bool(72, hybrid.ambient_occlusion);
        if let Some(found) = work.hybrid.iter().position(|p| p.0 == constants) {
            work.hybrid[..=found].rotate_right(1);
            return Ok((work.hybrid[0].1.clone(), media));
        }
        let told = (&constants, settings.shade_back_faces);
        let passes = HybridPasses::new(&self.scene, &work.code, told, self.constants.needs, &self.cache)?;
        self.cache.save();
        work.hybrid.truncate(VARIANTS - 1);
        work.hybrid.insert(0, (constants, Arc::new(passes)));
        Ok((work.hybrid[0].1.clone(), media))
    }
}
