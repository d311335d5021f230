//! What a driver's compiler says of the shaders of a pipeline.

use crate::error::{Called, VulkanError};
use ash::vk;

/// What became of one shader.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaderStatistics {
    /// As the driver calls it.
    pub shader: String,
    /// Names and values, as the driver calls and counts them.
    pub values: Vec<(String, f64)>,
}

/// Of a pipeline made with `CAPTURE_STATISTICS`.
pub(crate) fn read(
    device: &ash::khr::pipeline_executable_properties::Device,
    pipeline: vk::Pipeline,
) -> Result<Vec<ShaderStatistics>, VulkanError> {
    let info = vk::PipelineInfoKHR::default().pipeline(pipeline);
    // SAFETY: a live pipeline, here and below.
    let shaders = unsafe { device.get_pipeline_executable_properties(&info) }
        .called("vkGetPipelineExecutablePropertiesKHR")?;
    let one = |(i, shader): (usize, &vk::PipelineExecutablePropertiesKHR<'_>)| {
        let info = vk::PipelineExecutableInfoKHR::default().pipeline(pipeline).executable_index(i as u32);
        let values = unsafe { device.get_pipeline_executable_statistics(&info) }
            .called("vkGetPipelineExecutableStatisticsKHR")?;
        let values = values.iter().map(|v| (text(v.name_as_c_str()), number(v))).collect();
        Ok(ShaderStatistics { shader: text(shader.name_as_c_str()), values })
    };
    shaders.iter().enumerate().map(one).collect()
}

fn number(statistic: &vk::PipelineExecutableStatisticKHR<'_>) -> f64 {
    let value = &statistic.value;
    // SAFETY: the format says which member the driver filled.
    unsafe {
        match statistic.format {
            vk::PipelineExecutableStatisticFormatKHR::BOOL32 => f64::from(value.b32),
            vk::PipelineExecutableStatisticFormatKHR::INT64 => value.i64 as f64,
            vk::PipelineExecutableStatisticFormatKHR::UINT64 => value.u64 as f64,
            _ => value.f64,
        }
    }
}

fn text(name: Result<&std::ffi::CStr, std::ffi::FromBytesUntilNulError>) -> String {
    name.map_or_else(|_| String::new(), |n| n.to_string_lossy().into_owned())
}
