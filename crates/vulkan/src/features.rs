//! What a device must have, and what is used where it is there.

use ash::vk;
use std::ffi::CStr;

/// Extensions that a device must have.
pub(crate) const REQUIRED_EXTENSIONS: [&CStr; 3] = [
    ash::khr::acceleration_structure::NAME,
    ash::khr::ray_tracing_pipeline::NAME,
    ash::khr::deferred_host_operations::NAME, // asked for by the first
];

/// What a device has beyond what it must.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Features {
    /// Says how much memory is free (`VK_EXT_memory_budget`).
    pub memory_budget: bool,
    /// Says what its compiler made of shaders (`VK_KHR_pipeline_executable_properties`).
    pub pipeline_statistics: bool,
    /// Descriptors may be written while command buffers that use them are recorded.
    pub update_after_bind: bool,
    /// The device can decide itself how many rays are launched.
    pub indirect_launch: bool,
    /// Its queue draws, too.
    pub graphics: bool,
    /// It has what hybrid frames need.
    pub hybrid: bool,
}

/// What a device must have for hybrid frames, for people.
pub(crate) const HYBRID_NEEDS: [&str; 5] = [
    "a queue that draws",
    "multiDrawIndirect",
    "drawIndirectFirstInstance",
    "shaderBufferInt64Atomics",
    "arithmetic of subgroups",
];

/// The feature structures of a device, to be filled by a query or to be enabled.
#[derive(Default)]
pub(crate) struct Chain {
    v11: vk::PhysicalDeviceVulkan11Features<'static>,
    v12: vk::PhysicalDeviceVulkan12Features<'static>,
    acceleration: vk::PhysicalDeviceAccelerationStructureFeaturesKHR<'static>,
    pipeline: vk::PhysicalDeviceRayTracingPipelineFeaturesKHR<'static>,
    executables: vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR<'static>,
}

/// What a device offers.
pub(crate) struct Offer {
    extensions: Vec<vk::ExtensionProperties>,
    core: vk::PhysicalDeviceFeatures,
    chain: Chain,
    subgroups: vk::SubgroupFeatureFlags,
}

impl Offer {
    /// Asks a device of Vulkan 1.2 or newer.
    pub(crate) fn of(
        instance: &ash::Instance,
        device: vk::PhysicalDevice,
        extensions: Vec<vk::ExtensionProperties>,
    ) -> Self {
        let mut v11 = vk::PhysicalDeviceVulkan11Properties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut v11);
        // SAFETY: a device of this instance; the chain is alive.
        unsafe { instance.get_physical_device_properties2(device, &mut properties) };
        let in_compute = v11.subgroup_supported_stages.contains(vk::ShaderStageFlags::COMPUTE);
        let mut offer = Offer {
            extensions,
            core: vk::PhysicalDeviceFeatures::default(),
            chain: Chain::default(),
            subgroups: if in_compute { v11.subgroup_supported_operations } else { Default::default() },
        };
        let mut chain = Chain::default();
        let mut all =
            vk::PhysicalDeviceFeatures2::default().push_next(&mut chain.v11).push_next(&mut chain.v12);
        // Structures of extensions that a device does not have must not be in the query.
        if offer.has(ash::khr::acceleration_structure::NAME) {
            all = all.push_next(&mut chain.acceleration);
        }
        if offer.has(ash::khr::ray_tracing_pipeline::NAME) {
            all = all.push_next(&mut chain.pipeline);
        }
        if offer.has(ash::khr::pipeline_executable_properties::NAME) {
            all = all.push_next(&mut chain.executables);
        }
        // SAFETY: a device of this instance; the chain is alive.
        unsafe { instance.get_physical_device_features2(device, &mut all) };
        offer.core = all.features;
        offer.chain = chain.unlinked();
        offer
    }

    /// Whether it has an extension.
    pub(crate) fn has(&self, extension: &CStr) -> bool {
        self.extensions.iter().any(|e| e.extension_name_as_c_str() == Ok(extension))
    }

    /// Names of what it lacks of that which is required.
    pub(crate) fn missing(&self) -> Vec<String> {
        let extensions = REQUIRED_EXTENSIONS.iter().filter(|e| !self.has(e));
        let mut missing: Vec<String> = extensions.map(|e| e.to_string_lossy().into_owned()).collect();
        let v12 = &self.chain.v12;
        let features = [
            ("shaderInt64", self.core.shader_int64),
            ("bufferDeviceAddress", v12.buffer_device_address),
            ("scalarBlockLayout", v12.scalar_block_layout),
            ("runtimeDescriptorArray", v12.runtime_descriptor_array),
            (
                "shaderSampledImageArrayNonUniformIndexing",
                v12.shader_sampled_image_array_non_uniform_indexing,
            ),
            ("descriptorBindingPartiallyBound", v12.descriptor_binding_partially_bound),
            ("accelerationStructure", self.chain.acceleration.acceleration_structure),
            ("rayTracingPipeline", self.chain.pipeline.ray_tracing_pipeline),
        ];
        missing.extend(features.iter().filter(|f| f.1 == vk::FALSE).map(|f| f.0.to_owned()));
        missing
    }

    /// What of [`HYBRID_NEEDS`] it lacks.
    pub(crate) fn lacks_for_hybrid(&self, graphics: bool) -> Vec<String> {
        let subgroups = vk::SubgroupFeatureFlags::ARITHMETIC | vk::SubgroupFeatureFlags::BALLOT;
        let has = [
            graphics,
            self.core.multi_draw_indirect == vk::TRUE,
            self.core.draw_indirect_first_instance == vk::TRUE,
            self.chain.v12.shader_buffer_int64_atomics == vk::TRUE,
            self.subgroups.contains(subgroups),
        ];
        HYBRID_NEEDS.iter().zip(has).filter(|(_, has)| !has).map(|(name, _)| (*name).to_owned()).collect()
    }

    /// What it has beyond that.
    pub(crate) fn features(&self, graphics: bool) -> Features {
        Features {
            memory_budget: self.has(ash::ext::memory_budget::NAME),
            pipeline_statistics: self.has(ash::khr::pipeline_executable_properties::NAME)
                && self.chain.executables.pipeline_executable_info == vk::TRUE,
            indirect_launch: self.chain.pipeline.ray_tracing_pipeline_trace_rays_indirect == vk::TRUE,
            update_after_bind: self.chain.v12.descriptor_binding_sampled_image_update_after_bind == vk::TRUE,
            graphics,
            hybrid: self.lacks_for_hybrid(graphics).is_empty(),
        }
    }
}

impl Features {
    /// Extensions to enable.
    pub(crate) fn extensions(&self) -> Vec<&'static CStr> {
        let optional = [
            (ash::ext::memory_budget::NAME, self.memory_budget),
            (ash::khr::pipeline_executable_properties::NAME, self.pipeline_statistics),
        ];
        REQUIRED_EXTENSIONS.into_iter().chain(optional.into_iter().filter(|e| e.1).map(|e| e.0)).collect()
    }

    /// Features to enable: those required, and these.
    pub(crate) fn chain(&self) -> Chain {
        Chain {
            v11: vk::PhysicalDeviceVulkan11Features::default(),
            v12: vk::PhysicalDeviceVulkan12Features::default()
                .buffer_device_address(true)
                .scalar_block_layout(true)
                .runtime_descriptor_array(true)
                .shader_sampled_image_array_non_uniform_indexing(true)
                .descriptor_binding_partially_bound(true)
                .shader_buffer_int64_atomics(self.hybrid)
                .descriptor_binding_sampled_image_update_after_bind(self.update_after_bind),
            acceleration: vk::PhysicalDeviceAccelerationStructureFeaturesKHR::default()
                .acceleration_structure(true),
            pipeline: vk::PhysicalDeviceRayTracingPipelineFeaturesKHR::default()
                .ray_tracing_pipeline(true)
                .ray_tracing_pipeline_trace_rays_indirect(self.indirect_launch),
            executables: vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default()
                .pipeline_executable_info(self.pipeline_statistics),
        }
    }

    /// Core features to enable.
    pub(crate) fn core(&self) -> vk::PhysicalDeviceFeatures {
        vk::PhysicalDeviceFeatures::default()
            .shader_int64(true)
            .multi_draw_indirect(self.hybrid)
            .draw_indirect_first_instance(self.hybrid)
    }
}

impl Chain {
    /// The same values, pointing nowhere.
    fn unlinked(mut self) -> Self {
        let nowhere = std::ptr::null_mut();
        self.v11.p_next = nowhere;
        self.v12.p_next = nowhere;
        self.acceleration.p_next = nowhere;
        self.pipeline.p_next = nowhere;
        self.executables.p_next = nowhere;
        self
    }

    /// Adds all to what creates a device.
    pub(crate) fn enable<'a>(
        &'a mut self,
        features: &Features,
        create: vk::DeviceCreateInfo<'a>,
    ) -> vk::DeviceCreateInfo<'a> {
        let mut create = create
            .push_next(&mut self.v11)
            .push_next(&mut self.v12)
            .push_next(&mut self.acceleration)
            .push_next(&mut self.pipeline);
        if features.pipeline_statistics {
            create = create.push_next(&mut self.executables);
        }
        create
    }
}
