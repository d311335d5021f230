//! What is drawn: each geometry of the acceleration structures once for each instance, so that the rasteriser and rays give what they find the
//! same number.

use crate::accel::plan::Plan;
use crate::buffer::Buffer;
use crate::error::VulkanError;
use crate::upload::Upload;
use ash::vk;
use bytemuck::{Pod, Zeroable};
use lumbre_scene::CompiledScene;
use lumbre_shaders::layout::HitClass;
use std::ops::Range;

/// What a pipeline must know of the triangles that it draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Face {
    /// They are there only in part.
    pub(crate) covered: bool,
    /// The camera does not see their backs.
    pub(crate) culls: bool,
    /// In the world their fronts wind clockwise.
    pub(crate) mirrored: bool,
}

/// `VkDrawIndirectCommand`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
struct Draw {
    vertices: u32,
    instances: u32,
    first_vertex: u32,
    first_instance: u32,
}

/// All draws, those of a kind together.
pub(crate) struct Draws {
    commands: Buffer,
    batches: Vec<(Face, Range<u32>)>,
}

fn sorted(scene: &CompiledScene, plan: &Plan) -> Vec<(Face, Draw)> {
    let draw = |(record, &(instance, part)): (u32, &(u32, usize))| {
        let of_instance = &scene.instances[instance as usize];
        let part = &plan.parts()[part];
        let transform = &scene.transforms[of_instance.first_transform as usize];
        let face = Face {
            covered: part.class.hit == HitClass::Covered,
            culls: part.class.culls,
            mirrored: part.class.culls && transform.handedness < 0.0,
        };
        let draw = Draw { vertices: 3 * part.count, instances: 1, first_vertex: 0, first_instance: record };
        (of_instance.mask & 0xff != 0).then_some((face, draw))
    };
    let mut all: Vec<_> = (0..).zip(&plan.hits).filter_map(draw).collect();
    all.sort_by_key(|(face, draw)| (*face, draw.first_instance));
    all
}

impl Draws {
    /// Those of a scene.
    ///
    /// # Errors
    /// If memory is out.
    pub(crate) fn new(upload: &mut Upload, scene: &CompiledScene, plan: &Plan) -> Result<Self, VulkanError> {
        let all = sorted(scene, plan);
        let mut batches: Vec<(Face, Range<u32>)> = Vec::new();
        for (i, (face, _)) in (0..).zip(&all) {
            match batches.last_mut().filter(|b| b.0 == *face) {
                Some(batch) => batch.1.end = i + 1,
                None => batches.push((*face, i..i + 1)),
            }
        }
        let draws: Vec<Draw> = all.into_iter().map(|d| d.1).collect();
        let commands = Buffer::with_content(upload, "draws", bytemuck::cast_slice(&draws))?;
        Ok(Draws { commands, batches })
    }

    /// The kinds, and which of the draws are of each.
    pub(crate) fn batches(&self) -> &[(Face, Range<u32>)] {
        &self.batches
    }

    /// Records the draws of a batch with the pipeline that is bound.
    pub(crate) fn record(&self, commands: &crate::Commands<'_>, batch: &Range<u32>) {
        let stride = size_of::<Draw>() as u32;
        // A device may bound how many draws one command holds.
        let most = commands.gpu.0.limits.max_draws.max(1);
        let mut at = batch.start;
        while at < batch.end {
            let count = most.min(batch.end - at);
            let offset = u64::from(at) * u64::from(stride);
            // SAFETY: the command buffer is being recorded inside a pass; the buffer holds as many draws.
            unsafe {
                let (device, raw): (_, vk::CommandBuffer) = (&commands.gpu.0.raw, commands.raw);
                device.cmd_draw_indirect(raw, self.commands.raw(), offset, count, stride);
            }
            at += count;
        }
    }
}
