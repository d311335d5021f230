//! In the place of `vulkan` where the library is built without it: there are no GPUs.

use super::{Backend, Device, DeviceInfo, GpuOptions};
use lumbre_scene::CompiledScene;

/// There is none.
pub(super) enum Gpu {}

const WITHOUT: &str = "this program is built without Vulkan";

/// # Errors
/// Always.
pub(super) fn adapters() -> Result<Vec<DeviceInfo>, String> {
    Err(WITHOUT.into())
}

/// # Errors
/// Always.
pub(super) fn open(_: &Device, _: &GpuOptions) -> Result<(Gpu, Vec<String>), String> {
    Err(WITHOUT.into())
}

/// Never called.
pub(super) fn prepare(gpu: &Gpu, _: &CompiledScene, _: bool) -> Result<Box<dyn Backend>, String> {
    match *gpu {}
}
