//! Both backends over one scene.

use lumbre_core::Film;
use lumbre_core::settings::View;
use lumbre_cpu::CpuBackend;
use lumbre_scene::CompiledScene;
use lumbre_testkit::paired::Paired;
use lumbre_testkit::{TestGpu, gpu};
use lumbre_vulkan::{SceneOptions, VulkanBackend};

/// A scene on both devices.
pub(crate) struct Both {
    pub(crate) cpu: CpuBackend,
    pub(crate) vulkan: VulkanBackend,
    _gpu: TestGpu,
}

impl Both {
    /// `None` where there is no GPU, which has been said then.
    pub(crate) fn new(scene: CompiledScene) -> Option<Self> {
        Self::different(scene.clone(), scene)
    }

    /// With another scene on the GPU.
    pub(crate) fn different(on_cpu: CompiledScene, on_gpu: CompiledScene) -> Option<Self> {
        let gpu = gpu()?;
        let vulkan = VulkanBackend::new(&gpu, &on_gpu, SceneOptions::default()).expect("the scene fits");
        Some(Both { cpu: CpuBackend::new(on_cpu), vulkan, _gpu: gpu })
    }

    /// Renders `spp` samples of each pixel on both, one by one.
    pub(crate) fn pairs(&self, view: &View, [width, height]: [u32; 2], spp: u32) -> Vec<(Film, Film)> {
        let sample = |index: u32| {
            let (mut a, mut b) = (Film::new(width, height), Film::new(width, height));
            self.cpu.render(view, index..index + 1, &mut a, &());
            self.vulkan.render(view, index..index + 1, &mut b, &()).expect("the GPU renders");
            assert_eq!(b.non_finite_count(), 0, "{:?}", b.non_finite());
            (a, b)
        };
        (0..spp).map(sample).collect()
    }

    pub(crate) fn paired(&self, view: &View, size: [u32; 2], spp: u32) -> Paired {
        Paired::new(&self.pairs(view, size, spp))
    }
}
