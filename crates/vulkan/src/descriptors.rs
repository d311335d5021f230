//! The one set of descriptors: the top-level structure and an array of textures (`lumbre_shaders::layout::binding`).

use crate::error::{Called, VulkanError};
use crate::gpu::Gpu;
use ash::vk;
use lumbre_shaders::layout::binding;

/// Layout and set for a scene. Its pipelines share them, so that they need not be made anew when the top-level structure is.
pub(crate) struct Descriptors {
    gpu: Gpu,
    pub(crate) layout: vk::DescriptorSetLayout,
    pool: vk::DescriptorPool,
    pub(crate) set: vk::DescriptorSet,
}

/// Stages that read descriptors and push constants.
pub(crate) const STAGES: vk::ShaderStageFlags = vk::ShaderStageFlags::from_raw(
    vk::ShaderStageFlags::COMPUTE.as_raw()
        | vk::ShaderStageFlags::RAYGEN_KHR.as_raw()
        | vk::ShaderStageFlags::CLOSEST_HIT_KHR.as_raw()
        | vk::ShaderStageFlags::ANY_HIT_KHR.as_raw()
        | vk::ShaderStageFlags::MISS_KHR.as_raw(),
);

impl Descriptors {
    /// For this structure and these textures, which must live as long as what reads them runs.
    pub(crate) fn new(
        gpu: &Gpu,
        top: vk::AccelerationStructureKHR,
        views: &[vk::ImageView],
    ) -> Result<Self, VulkanError> {
        // An array has one element at least, bound or not.
        let textures = views.len().max(1) as u32;
        let mut descriptors = Descriptors {
            layout: vk::DescriptorSetLayout::null(),
            pool: vk::DescriptorPool::null(),
            set: vk::DescriptorSet::null(),
            gpu: gpu.clone(),
        };
        descriptors.make(textures)?;
        descriptors.write_top(top);
        descriptors.write_textures(views);
        Ok(descriptors)
    }

    fn make(&mut self, textures: u32) -> Result<(), VulkanError> {
        let device = &self.gpu.0.raw;
        let binding = |binding, kind, count| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(binding)
                .descriptor_type(kind)
                .descriptor_count(count)
                .stage_flags(STAGES)
        };
        let image = vk::DescriptorType::SAMPLED_IMAGE;
        let structure = vk::DescriptorType::ACCELERATION_STRUCTURE_KHR;
        let bindings = [binding(binding::TLAS, structure, 1), binding(binding::TEXTURES, image, textures)];
        // With update after bind a device offers far more textures.
        let (array, layout, pool) = if self.gpu.features().update_after_bind {
            (
                vk::DescriptorBindingFlags::PARTIALLY_BOUND | vk::DescriptorBindingFlags::UPDATE_AFTER_BIND,
                vk::DescriptorSetLayoutCreateFlags::UPDATE_AFTER_BIND_POOL,
                vk::DescriptorPoolCreateFlags::UPDATE_AFTER_BIND,
            )
        } else {
            (
                vk::DescriptorBindingFlags::PARTIALLY_BOUND,
                vk::DescriptorSetLayoutCreateFlags::empty(),
                vk::DescriptorPoolCreateFlags::empty(),
            )
        };
        let flags = [vk::DescriptorBindingFlags::empty(), array];
        let mut flags = vk::DescriptorSetLayoutBindingFlagsCreateInfo::default().binding_flags(&flags);
        let create = vk::DescriptorSetLayoutCreateInfo::default()
            .flags(layout)
            .bindings(&bindings)
            .push_next(&mut flags);
        let sizes = [
            vk::DescriptorPoolSize { ty: structure, descriptor_count: 1 },
            vk::DescriptorPoolSize { ty: image, descriptor_count: textures },
        ];
        let create_pool = vk::DescriptorPoolCreateInfo::default().flags(pool).max_sets(1).pool_sizes(&sizes);
        // SAFETY: a live device; what is made is destroyed by `drop`.
        unsafe {
            self.layout =
                device.create_descriptor_set_layout(&create, None).called("vkCreateDescriptorSetLayout")?;
            self.pool = device.create_descriptor_pool(&create_pool, None).called("vkCreateDescriptorPool")?;
            let layouts = [self.layout];
            let allocate =
                vk::DescriptorSetAllocateInfo::default().descriptor_pool(self.pool).set_layouts(&layouts);
            self.set = device.allocate_descriptor_sets(&allocate).called("vkAllocateDescriptorSets")?[0];
        }
        Ok(())
    }

    fn slot(&self, binding: u32) -> vk::WriteDescriptorSet<'_> {
        vk::WriteDescriptorSet::default().dst_set(self.set).dst_binding(binding)
    }

    /// Puts a top-level structure there. Nothing that reads the set may be under way.
    pub(crate) fn write_top(&self, top: vk::AccelerationStructureKHR) {
        let structures = [top];
        let mut top =
            vk::WriteDescriptorSetAccelerationStructureKHR::default().acceleration_structures(&structures);
        let write = self
            .slot(binding::TLAS)
            .descriptor_type(vk::DescriptorType::ACCELERATION_STRUCTURE_KHR)
            .descriptor_count(1)
            .push_next(&mut top);
        // SAFETY: nothing reads the set; the structure lives as long as the scene, or until another takes its place.
        unsafe { self.gpu.0.raw.update_descriptor_sets(&[write], &[]) };
    }

    fn write_textures(&self, views: &[vk::ImageView]) {
        if views.is_empty() {
            return;
        }
        let layout = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        let image = |&view| vk::DescriptorImageInfo::default().image_view(view).image_layout(layout);
        let images: Vec<_> = views.iter().map(image).collect();
        let kind = vk::DescriptorType::SAMPLED_IMAGE;
        let write = self.slot(binding::TEXTURES).descriptor_type(kind).image_info(&images);
        // SAFETY: the set is new; what is written lives as long as the scene.
        unsafe { self.gpu.0.raw.update_descriptor_sets(&[write], &[]) };
    }
}

impl Drop for Descriptors {
    fn drop(&mut self) {
        let (pool, layout) = (self.pool, self.layout);
        // SAFETY: nothing that uses them is under way; null handles are ignored.
        self.gpu.0.discard(move |gpu| unsafe {
            gpu.raw.destroy_descriptor_pool(pool, None);
            gpu.raw.destroy_descriptor_set_layout(layout, None);
        });
    }
}
