//! An open device: handle, queue, memory; and what becomes of it when it is lost.

use crate::adapters::{self, Adapter, Kind, Wanted};
use crate::cache::Kept;
use crate::commands::Slot;
use crate::error::{Called, VulkanError};
use crate::features::Features;
use crate::instance::{Instance, Validation};
use crate::memory::{Memory, MemoryUse};
use ash::vk;
use std::ffi::CString;
use std::mem::ManuallyDrop;
use std::sync::atomic::{AtomicBool, AtomicI64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

/// How a device is opened.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Whether the validation layer listens.
    pub validation: Validation,
    /// Whether pipelines keep what the driver's compiler says of them, where it says anything: [`crate::RayPipeline::statistics`].
    pub pipeline_statistics: bool,
    /// A submission that takes longer counts as a hang; ten times that on a driver that computes on the processor.
    pub patience: Duration,
}

impl Default for Options {
    fn default() -> Self {
        Options { validation: Validation::Off, pipeline_statistics: false, patience: Duration::from_secs(60) }
    }
}

/// An open device. Clones are the same device; it is closed when the last clone and the last thing made with it are gone.
#[derive(Clone)]
pub struct Gpu(pub(crate) Arc<Shared>);

/// What all that is made with a device holds on to.
pub(crate) struct Shared {
    pub(crate) adapter: Adapter,
    pub(crate) limits: Limits,
    pub(crate) raw: ash::Device,
    pub(crate) acceleration: ash::khr::acceleration_structure::Device,
    pub(crate) pipelines: ash::khr::ray_tracing_pipeline::Device,
    /// If pipelines keep statistics.
    pub(crate) executables: Option<ash::khr::pipeline_executable_properties::Device>,
    pub(crate) queue: Mutex<vk::Queue>,
    /// Command buffers that wait for work.
    pub(crate) idle: Mutex<Vec<Slot>>,
    pub(crate) memory: ManuallyDrop<Memory>,
    /// What the driver remembers of pipelines, from the first that is made on.
    pub(crate) cache: OnceLock<Kept>,
    pub(crate) patience: Duration,
    work: Mutex<Work>,
    names: Option<ash::ext::debug_utils::Device>,
    state: State,
    pub(crate) instance: ManuallyDrop<Arc<Instance>>,
}

/// How large things may be, and how they must lie.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Limits {
    pub(crate) largest_allocation: u64,
    pub(crate) max_groups: u32,
    pub(crate) max_invocations: u32,
    pub(crate) timestamp_period_ns: f32,
    pub(crate) handle_size: u32,
    pub(crate) handle_alignment: u32,
    pub(crate) base_alignment: u32,
    pub(crate) max_sampled_images: u32,
    pub(crate) max_image_side: u32,
    pub(crate) max_draws: u32,
    pub(crate) pipeline_cache_uuid: [u8; 16],
    pub(crate) vendor: u32,
    pub(crate) device: u32,
}

/// Whether the device still is what it was.
#[derive(Default)]
struct State {
    lost: AtomicBool,
    /// Lost while it was working: nothing that it may be using can be freed.
    hangs: AtomicBool,
    /// Submissions until it plays lost, if positive.
    loses_after: AtomicI64,
}

/// What is under way, and what is freed when nothing is.
#[derive(Default)]
struct Work {
    submissions: usize,
    discarded: Vec<Discarded>,
}

/// Frees a thing that the device may have been using when it was dropped.
type Discarded = Box<dyn FnOnce(&Shared) + Send>;

impl std::fmt::Debug for Gpu {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Gpu").field(&self.0.adapter.name).finish()
    }
}

impl Gpu {
    /// Opens the adapter that is meant.
    ///
    /// # Errors
    /// If there is no Vulkan or no such adapter, if it lacks something, or if its driver refuses.
    pub fn open(wanted: &Wanted, options: Options) -> Result<Self, VulkanError> {
        let instance = Instance::get(options.validation)?;
        let adapters = adapters::list(&instance.raw)?;
        let mut adapter = adapters::choose(&adapters, wanted)?.clone();
        adapter.features.pipeline_statistics &= options.pipeline_statistics;
        let raw = create_device(&instance, &adapter)?;
        // SAFETY: nothing was made with the device yet.
        let memory = Memory::new(&instance.raw, &raw, &adapter)
            .inspect_err(|_| unsafe { raw.destroy_device(None) })?;
        let gpu = Shared {
            limits: limits(&instance.raw, &adapter),
            acceleration: ash::khr::acceleration_structure::Device::new(&instance.raw, &raw),
            pipelines: ash::khr::ray_tracing_pipeline::Device::new(&instance.raw, &raw),
            executables: adapter
                .features
                .pipeline_statistics
                .then(|| ash::khr::pipeline_executable_properties::Device::new(&instance.raw, &raw)),
            // SAFETY: the device was created with one queue of this family.
            queue: Mutex::new(unsafe { raw.get_device_queue(adapter.queue_family, 0) }),
            idle: Mutex::default(),
            memory: ManuallyDrop::new(memory),
            cache: OnceLock::new(),
            patience: options.patience * if adapter.kind == Kind::Cpu { 10 } else { 1 },
            names: instance.validates().then(|| ash::ext::debug_utils::Device::new(&instance.raw, &raw)),
            state: State::default(),
            work: Mutex::default(),
            instance: ManuallyDrop::new(instance),
            adapter,
            raw,
        };
        let gpu = Gpu(Arc::new(gpu));
        let test = |name: &str| std::env::var(name).ok()?.parse::<i64>().ok();
        if let Some(n) = test("LUMBRE_TEST_LOSE_DEVICE") {
            gpu.lose_after(n);
        }
        if let Some(n) = test("LUMBRE_TEST_GPU_MEMORY") {
            gpu.limit_memory(n as u64);
        }
        Ok(gpu)
    }

    /// What it is.
    pub fn adapter(&self) -> &Adapter {
        &self.0.adapter
    }

    /// What it has beyond what it must.
    pub fn features(&self) -> Features {
        self.0.adapter.features
    }

    /// Whether the validation layer listens.
    pub fn validates(&self) -> bool {
        self.0.instance.validates()
    }

    /// What the validation layer has said so far, oldest first.
    pub fn messages(&self) -> Vec<String> {
        lock(&self.0.instance.messages).clone()
    }

    /// How much memory is in use.
    pub fn memory(&self) -> MemoryUse {
        self.0.memory.report()
    }

    /// For tests: the `n`-th submission from now on finds the device lost; 0 takes that back as long as it has not happened. The
    /// environment variable `LUMBRE_TEST_LOSE_DEVICE=n` does the same from the start.
    #[doc(hidden)]
    pub fn lose_after(&self, n: i64) {
        self.0.state.loses_after.store(n, Ordering::Relaxed);
    }

    /// For tests: plays a device with this many bytes of memory. The environment variable `LUMBRE_TEST_GPU_MEMORY=n` does the same from
    /// the start.
    #[doc(hidden)]
    pub fn limit_memory(&self, bytes: u64) {
        self.0.memory.limit(bytes);
    }
}

impl Shared {
    /// An error if the device was lost before; counts a submission for the test hook.
    pub(crate) fn alive(&self) -> Result<(), VulkanError> {
        let loses_now = self.state.loses_after.load(Ordering::Relaxed) > 0
            && self.state.loses_after.fetch_sub(1, Ordering::Relaxed) == 1;
        if loses_now {
            self.state.lost.store(true, Ordering::Relaxed);
        }
        if self.state.lost.load(Ordering::Relaxed) { Err(VulkanError::DeviceLost) } else { Ok(()) }
    }

    /// Remembers an error after which the device is of no use.
    pub(crate) fn remember<T>(&self, result: Result<T, VulkanError>) -> Result<T, VulkanError> {
        if let Err(error) = &result {
            self.state.lost.fetch_or(error.is_lost(), Ordering::Relaxed);
            self.state.hangs.fetch_or(matches!(error, VulkanError::Hang { .. }), Ordering::Relaxed);
        }
        result
    }

    /// The device may still be using what it was given: that is leaked.
    fn hangs(&self) -> bool {
        self.state.hangs.load(Ordering::Relaxed)
    }

    /// A submission is being recorded: what is dropped from now on may be part of it.
    pub(crate) fn begin(&self) {
        lock(&self.work).submissions += 1;
    }

    /// The device has finished with a submission, or never got it.
    pub(crate) fn end(&self) {
        let discarded = {
            let mut work = lock(&self.work);
            work.submissions -= 1;
            if work.submissions > 0 { Vec::new() } else { std::mem::take(&mut work.discarded) }
        };
        discarded.into_iter().for_each(|free| free(self));
    }

    /// Frees something as soon as no submission is under way. So whatever is dropped, and whenever, the device is done with it.
    pub(crate) fn discard(&self, free: impl FnOnce(&Shared) + Send + 'static) {
        if self.hangs() {
            return;
        }
        let mut work = lock(&self.work);
        if work.submissions > 0 {
            work.discarded.push(Box::new(free));
        } else {
            drop(work);
            free(self);
        }
    }

    /// Gives a thing a name in messages of the validation layer.
    pub(crate) fn name<T: vk::Handle>(&self, handle: T, name: &str) {
        let (Some(utils), Ok(name)) = (&self.names, CString::new(name)) else { return };
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(handle).object_name(&name);
        // SAFETY: a live handle of this device, which nobody else is using yet. Without the name nothing is lost.
        let _ = unsafe { utils.set_debug_utils_object_name(&info) };
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        if self.hangs() {
            return; // it may be using anything still
        }
        // SAFETY: the last owner; all that was made with the device is gone, and it is dropped before its instance.
        unsafe {
            let _ = self.raw.device_wait_idle();
            for slot in lock(&self.idle).drain(..) {
                slot.destroy(&self.raw);
            }
            if let Some(cache) = self.cache.get() {
                cache.destroy(&self.raw);
            }
            ManuallyDrop::drop(&mut self.memory);
            self.raw.destroy_device(None);
            ManuallyDrop::drop(&mut self.instance);
        }
    }
}

/// What a poisoned lock holds is as good as before: no code that can panic leaves it half changed.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn create_device(instance: &Instance, adapter: &Adapter) -> Result<ash::Device, VulkanError> {
    let queues = [vk::DeviceQueueCreateInfo::default()
        .queue_family_index(adapter.queue_family)
        .queue_priorities(&[1.0])];
    let extensions: Vec<_> = adapter.features.extensions().iter().map(|e| e.as_ptr()).collect();
    let core = adapter.features.core();
    let mut chain = adapter.features.chain();
    let create = vk::DeviceCreateInfo::default()
        .queue_create_infos(&queues)
        .enabled_extension_names(&extensions)
        .enabled_features(&core);
    let create = chain.enable(&adapter.features, create);
    // SAFETY: an adapter of this instance; all that `create` points to is alive.
    unsafe { instance.raw.create_device(adapter.raw, &create, None) }.called("vkCreateDevice")
}

fn limits(instance: &ash::Instance, adapter: &Adapter) -> Limits {
    let mut v11 = vk::PhysicalDeviceVulkan11Properties::default();
    let mut v12 = vk::PhysicalDeviceVulkan12Properties::default();
    let mut pipeline = vk::PhysicalDeviceRayTracingPipelinePropertiesKHR::default();
    let mut all = vk::PhysicalDeviceProperties2::default()
        .push_next(&mut v11)
        .push_next(&mut v12)
        .push_next(&mut pipeline);
    // SAFETY: an adapter of this instance that has what the structures belong to.
    unsafe { instance.get_physical_device_properties2(adapter.raw, &mut all) };
    let basic = all.properties;
    let core = &basic.limits;
    // Of images with samplers, by stage and by set; a few are left for what else a pipeline has.
    let images = if adapter.features.update_after_bind {
        v12.max_per_stage_descriptor_update_after_bind_sampled_images
            .min(v12.max_per_stage_descriptor_update_after_bind_samplers)
            .min(v12.max_per_stage_update_after_bind_resources)
            .min(v12.max_descriptor_set_update_after_bind_sampled_images)
            .min(v12.max_descriptor_set_update_after_bind_samplers)
    } else {
        core.max_per_stage_descriptor_sampled_images
            .min(core.max_per_stage_descriptor_samplers)
            .min(core.max_per_stage_resources)
            .min(core.max_descriptor_set_sampled_images)
            .min(core.max_descriptor_set_samplers)
    };
    Limits {
        largest_allocation: v11.max_memory_allocation_size,
        max_groups: basic.limits.max_compute_work_group_count[0],
        max_invocations: pipeline.max_ray_dispatch_invocation_count,
        timestamp_period_ns: basic.limits.timestamp_period,
        handle_size: pipeline.shader_group_handle_size,
        handle_alignment: pipeline.shader_group_handle_alignment,
        base_alignment: pipeline.shader_group_base_alignment,
        max_sampled_images: images.saturating_sub(8),
        max_image_side: basic.limits.max_image_dimension2_d,
        max_draws: basic.limits.max_draw_indirect_count,
        pipeline_cache_uuid: basic.pipeline_cache_uuid,
        vendor: basic.vendor_id,
        device: basic.device_id,
    }
}
