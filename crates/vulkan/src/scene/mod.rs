//! A scene on the device: the arrays of `CompiledScene` as they are, textures, acceleration structures, and the table that says where
//! everything lies.

pub(crate) mod geometry;
mod textures;

use crate::accel::{Accel, AccelReport};
use crate::buffer::Buffer;
use crate::error::VulkanError;
use crate::gpu::Gpu;
use crate::upload::Upload;
use bytemuck::{Pod, bytes_of, cast_slice};
use geometry::Geometry;
use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::lights::LightGroup;
use lumbre_shaders::layout::SceneTable;
use textures::Textures;

/// How a scene is put on a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneOptions {
    /// Meshes that stand in the world once share acceleration structures.
    pub merge: bool,
    /// Bytes of a buffer of vertices or triangles, unless one mesh alone takes more.
    pub chunk: u64,
}

impl Default for SceneOptions {
    fn default() -> Self {
        SceneOptions { merge: true, chunk: 1 << 30 }
    }
}

/// A scene on a device.
pub struct SceneOnGpu {
    gpu: Gpu,
    table: Buffer,
    pub(crate) accel: Accel,
    pub(crate) textures: Textures,
    /// Held for the addresses in `table`.
    _geometry: Geometry,
    _arrays: Vec<Buffer>,
}

impl Gpu {
    /// Copies a scene to the device and builds its acceleration structures.
    ///
    /// # Errors
    /// If memory is out, an array is larger than the device can take, or the device is lost.
    pub fn scene(&self, scene: &CompiledScene, options: SceneOptions) -> Result<SceneOnGpu, VulkanError> {
        let mut upload = Upload::new(self);
        let geometry = Geometry::new(&mut upload, scene, options.chunk)?;
        let accel = Accel::new(self, scene, &geometry, options.merge)?;
        let textures = Textures::new(&mut upload, scene)?;
        let mut arrays = Vec::new();
        let mut table = table(&mut upload, scene, &mut arrays)?;
        let mut add = |name, content: &[u8]| array(&mut upload, &mut arrays, name, content);
        table.geometries = accel.records.address();
        table.meshes = add("tables of meshes", cast_slice(geometry.tables()))?;
        table.textures = add("tables of textures", cast_slice(&textures.tables))?;
        let table = Buffer::with_content(&mut upload, "the scene's table", bytes_of(&table))?;
        upload.finish()?;
        Ok(SceneOnGpu { gpu: self.clone(), table, accel, textures, _geometry: geometry, _arrays: arrays })
    }
}

/// An array in a buffer of its own; its address.
fn array(
    upload: &mut Upload,
    arrays: &mut Vec<Buffer>,
    name: &str,
    content: &[u8],
) -> Result<u64, VulkanError> {
    let buffer = Buffer::with_content(upload, name, content)?;
    let address = buffer.address();
    arrays.push(buffer);
    Ok(address)
}

/// The table, without geometries, meshes and textures.
fn table(
    upload: &mut Upload,
    scene: &CompiledScene,
    arrays: &mut Vec<Buffer>,
) -> Result<SceneTable, VulkanError> {
    fn bytes<T: Pod>(content: &[T]) -> &[u8] {
        cast_slice(content)
    }
    let mut add = |name, content| array(upload, arrays, name, content);
    let lights = |group| scene.light_group(group).1.len().saturating_sub(1) as u32;
    Ok(SceneTable {
        geometries: 0,
        meshes: 0,
        instances: add("instances", bytes(&scene.instances))?,
        transforms: add("transforms", bytes(&scene.transforms))?,
        materials: add("materials", bytes(&scene.materials))?,
        lobes: add("lobes", bytes(&scene.lobes))?,
        textures: 0,
        emissive_ranks: add("ranks of emissive triangles", bytes(&scene.emissive_ranks))?,
        lights: add("lights", bytes(&scene.lights))?,
        near_light_cdf: add("probabilities of near lights", bytes(&scene.near_light_cdf))?,
        far_light_cdf: add("probabilities of far lights", bytes(&scene.far_light_cdf))?,
        triangle_lights: add("emissive triangles", bytes(&scene.triangle_lights))?,
        punctual_lights: add("punctual lights", bytes(&scene.punctual_lights))?,
        environment_pixels: add("texels of the environment", bytes(&scene.environment_pixels))?,
        environment_row_cdf: add("rows of the environment", bytes(&scene.environment_row_cdf))?,
        environment_cell_cdf: add("cells of the environment", bytes(&scene.environment_cell_cdf))?,
        near_lights: lights(LightGroup::Near),
        far_lights: lights(LightGroup::Far),
        sun: scene.sun,
        environment: scene.environment,
    })
}

impl SceneOnGpu {
    /// The device it is on.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Where its [`SceneTable`] lies.
    pub fn address(&self) -> u64 {
        self.table.address()
    }

    /// What there is of acceleration structures and what making them took.
    pub fn accel(&self) -> &AccelReport {
        &self.accel.report
    }
}
