//! The loader, an instance, and what the validation layer says.

use crate::error::{Called, VulkanError};
use ash::vk;
use std::borrow::Cow;
use std::ffi::{CStr, c_void};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Whether the validation layer listens (with synchronisation validation).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Validation {
    /// No.
    #[default]
    Off,
    /// If it is installed; for tests.
    WhereInstalled,
    /// Yes; an error if it is not installed.
    On,
}

/// What the validation layer said, oldest first.
pub(crate) type Messages = Mutex<Vec<String>>;

/// A Vulkan instance.
pub(crate) struct Instance {
    pub(crate) raw: ash::Instance,
    messenger: Option<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    /// Boxed: the messenger keeps its address.
    pub(crate) messages: Box<Messages>,
}

/// The loader, kept for the life of the process: drivers do not all survive being unloaded.
pub(crate) fn entry() -> Result<&'static ash::Entry, VulkanError> {
    static ENTRY: OnceLock<Result<ash::Entry, VulkanError>> = OnceLock::new();
    // SAFETY: the system's Vulkan loader, whose initialisation has no preconditions; it is never unloaded.
    let load = || unsafe { ash::Entry::load() }.map_err(|e| VulkanError::NoLoader(e.to_string()));
    ENTRY.get_or_init(load).as_ref().map_err(Clone::clone)
}

impl Instance {
    /// An instance of Vulkan 1.2. Without validation it is one for the whole process, which lives as long: making one loads the drivers,
    /// which takes a tenth of a second.
    ///
    /// # Errors
    /// If Vulkan is not installed, is older, or the layer asked for is missing.
    pub(crate) fn get(validation: Validation) -> Result<Arc<Self>, VulkanError> {
        static PLAIN: OnceLock<Result<Arc<Instance>, VulkanError>> = OnceLock::new();
        match validation {
            Validation::Off => PLAIN.get_or_init(|| Self::new(Validation::Off).map(Arc::new)).clone(),
            _ => Self::new(validation).map(Arc::new),
        }
    }

    fn new(validation: Validation) -> Result<Self, VulkanError> {
        let entry = entry()?;
        // SAFETY: no preconditions.
        let version =
            unsafe { entry.try_enumerate_instance_version() }.called("vkEnumerateInstanceVersion")?;
        if version.unwrap_or(vk::API_VERSION_1_0) < vk::API_VERSION_1_2 {
            return Err(VulkanError::NoLoader("the Vulkan loader is older than 1.2".to_owned()));
        }
        let validates = match validation {
            Validation::Off => false,
            Validation::WhereInstalled => has_validation(entry)?,
            Validation::On if has_validation(entry)? => true,
            Validation::On => return Err(VulkanError::NoValidation),
        };
        let application = vk::ApplicationInfo::default()
            .application_name(c"lumbre")
            .engine_name(c"lumbre")
            .api_version(vk::API_VERSION_1_2);
        let layers = [VALIDATION_LAYER.as_ptr()];
        let extensions = [ash::ext::debug_utils::NAME.as_ptr(), ash::ext::validation_features::NAME.as_ptr()];
        let enabled = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
        let mut checks = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enabled);
        let mut create = vk::InstanceCreateInfo::default().application_info(&application);
        if validates {
            create = create
                .enabled_layer_names(&layers)
                .enabled_extension_names(&extensions)
                .push_next(&mut checks);
        }
        // SAFETY: `create` and all that it points to are alive.
        let raw = unsafe { entry.create_instance(&create, None) }.map_err(|result| match result {
            vk::Result::ERROR_INCOMPATIBLE_DRIVER => VulkanError::NoDevice(Vec::new()),
            _ => VulkanError::Call { call: "vkCreateInstance", result },
        })?;
        let mut instance = Instance { raw, messenger: None, messages: Box::default() };
        if validates {
            instance.listen(entry)?;
        }
        Ok(instance)
    }

    pub(crate) fn validates(&self) -> bool {
        self.messenger.is_some()
    }

    /// Collects what the layer says. Errors and warnings about correct use only: its hints on speed are not about correctness, and
    /// the loader's general messages are about other drivers of the machine.
    fn listen(&mut self, entry: &ash::Entry) -> Result<(), VulkanError> {
        let utils = ash::ext::debug_utils::Instance::new(entry, &self.raw);
        let create = vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(
                vk::DebugUtilsMessageSeverityFlagsEXT::ERROR | vk::DebugUtilsMessageSeverityFlagsEXT::WARNING,
            )
            .message_type(vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION)
            .pfn_user_callback(Some(collect))
            .user_data((&raw const *self.messages).cast_mut().cast());
        // SAFETY: the instance has the extension; `messages` is boxed and outlives the messenger (see `drop`).
        let messenger = unsafe { utils.create_debug_utils_messenger(&create, None) }
            .called("vkCreateDebugUtilsMessengerEXT")?;
        self.messenger = Some((utils, messenger));
        Ok(())
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: all that was made from the instance holds on to it and is gone.
        unsafe {
            if let Some((utils, messenger)) = self.messenger.take() {
                utils.destroy_debug_utils_messenger(messenger, None);
            }
            self.raw.destroy_instance(None);
        }
    }
}

fn has_validation(entry: &ash::Entry) -> Result<bool, VulkanError> {
    // SAFETY: no preconditions.
    let layers = unsafe { entry.enumerate_instance_layer_properties() }
        .called("vkEnumerateInstanceLayerProperties")?;
    Ok(layers.iter().any(|l| l.layer_name_as_c_str() == Ok(VALIDATION_LAYER)))
}

/// Called by the layer, on any thread.
unsafe extern "system" fn collect(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kinds: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    messages: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: the layer hands over a valid record whose text is null or ends in zero, and the `Messages` given to `listen`.
    let (text, messages) = unsafe {
        let text = (*data).p_message;
        let text = if text.is_null() { Cow::Borrowed("") } else { CStr::from_ptr(text).to_string_lossy() };
        (text, &*messages.cast::<Messages>())
    };
    messages.lock().unwrap_or_else(PoisonError::into_inner).push(text.into_owned());
    vk::FALSE
}
