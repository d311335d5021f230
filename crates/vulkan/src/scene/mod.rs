//! A scene on the device: the arrays of `CompiledScene` as they are, textures, acceleration structures, and the table that says where
//! everything lies.

pub(crate) mod geometry;
mod textures;

use crate::accel::Accel;
use crate::buffer::Buffer;
use crate::descriptors::Descriptors;
use crate::error::VulkanError;
use crate::gpu::{Gpu, lock};
use crate::raster::Draws;
use crate::upload::Upload;
use bytemuck::{Pod, Zeroable, bytes_of, cast_slice};
use geometry::Geometry;
use lumbre_core::measure::AccelReport;
use lumbre_scene::compiled::lights::LightGroup;
use lumbre_scene::{CompiledScene, Part, SceneChanges};
use lumbre_shaders::layout::SceneTable;
use std::sync::{Arc, Mutex, PoisonError};
use textures::Textures;

/// How a scene is put on a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneOptions {
    /// Meshes that stand in the world once share acceleration structures: faster, but an edit that moves one builds all anew.
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
    options: SceneOptions,
    table: Buffer,
    accel: Accel,
    textures: Textures,
    geometry: Geometry,
    /// What `table` says the addresses of: arrays of the scene, tables of meshes, tables of textures.
    arrays: Vec<(Part, Buffer)>,
    mesh_tables: Buffer,
    texture_tables: Buffer,
    pub(crate) descriptors: Arc<Descriptors>,
    /// What the rasteriser draws of it.
    pub(crate) draws: Draws,
    /// Transforms as they were before an update, until a frame has been drawn since.
    previous_transforms: Mutex<Option<Buffer>>,
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
        let array = |(part, name, content): (Part, &str, &[u8])| {
            Ok((part, Buffer::with_content(&mut upload, name, content)?))
        };
        let arrays = arrays(scene).into_iter().map(array).collect::<Result<_, VulkanError>>()?;
        let draws = Draws::new(&mut upload, scene, accel.plan())?;
        let mut add = |name, content: &[u8]| Buffer::with_content(&mut upload, name, content);
        let made = SceneOnGpu {
            gpu: self.clone(),
            options,
            table: add("the scene's table", bytes_of(&SceneTable::zeroed()))?,
            mesh_tables: add("tables of meshes", cast_slice(geometry.tables()))?,
            texture_tables: add("tables of textures", cast_slice(&textures.tables))?,
            descriptors: Arc::new(Descriptors::new(self, accel.top(), &textures.views)?),
            accel,
            textures,
            geometry,
            arrays,
            draws,
            previous_transforms: Mutex::default(),
        };
        upload.write(&made.table, 0, bytes_of(&made.table_of(scene)))?;
        upload.finish()?;
        Ok(made)
    }
}

/// The arrays that go up as they are, each in a buffer of its own.
fn arrays(scene: &CompiledScene) -> [(Part, &'static str, &[u8]); 13] {
    fn bytes<T: Pod>(content: &[T]) -> &[u8] {
        cast_slice(content)
    }
    [
        (Part::Instances, "instances", bytes(&scene.instances)),
        (Part::Transforms, "transforms", bytes(&scene.transforms)),
        (Part::Materials, "materials", bytes(&scene.materials)),
        (Part::Lobes, "lobes", bytes(&scene.lobes)),
        (Part::EmissiveRanks, "ranks of emissive triangles", bytes(&scene.emissive_ranks)),
        (Part::Lights, "lights", bytes(&scene.lights)),
        (Part::NearLightCdf, "probabilities of near lights", bytes(&scene.near_light_cdf)),
        (Part::FarLightCdf, "probabilities of far lights", bytes(&scene.far_light_cdf)),
        (Part::TriangleLights, "emissive triangles", bytes(&scene.triangle_lights)),
        (Part::PunctualLights, "punctual lights", bytes(&scene.punctual_lights)),
        (Part::EnvironmentPixels, "texels of the environment", bytes(&scene.environment_pixels)),
        (Part::EnvironmentRowCdf, "rows of the environment", bytes(&scene.environment_row_cdf)),
        (Part::EnvironmentCellCdf, "cells of the environment", bytes(&scene.environment_cell_cdf)),
    ]
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

    fn transforms_buffer(&self) -> &Buffer {
        &self.arrays.iter().find(|a| a.0 == Part::Transforms).expect("one of the arrays").1
    }

    /// Where the transforms of instances lie.
    pub(crate) fn transforms(&self) -> u64 {
        self.transforms_buffer().address()
    }

    /// Before an update that moves things: what the next frame's motion is measured from.
    fn keep_transforms(&mut self, changes: SceneChanges) -> Result<(), VulkanError> {
        let kept = self.previous_transforms.get_mut().unwrap_or_else(PoisonError::into_inner);
        if changes.has(Part::Instances) {
            // Instances may have other transforms than before.
            *kept = None;
        } else if changes.has(Part::Transforms) && kept.is_none() {
            let now = self.transforms_buffer();
            let copy = Buffer::new(&self.gpu, "transforms before", now.size(), crate::Purpose::Data)?;
            self.gpu.run("keeping transforms", |commands| {
                commands.copy((now, 0), (&copy, 0), now.size());
                Ok(())
            })?;
            *lock(&self.previous_transforms) = Some(copy);
        }
        Ok(())
    }

    /// Transforms as they were when the last frame was drawn, where others took their place since: for the next frame alone.
    pub(crate) fn take_previous_transforms(&self) -> Option<Buffer> {
        lock(&self.previous_transforms).take()
    }

    /// What there is of acceleration structures and what making them took.
    pub fn accel(&self) -> &AccelReport {
        &self.accel.report
    }

    /// Takes an edited scene, which differs from the present one in `changes`: arrays that changed go up again, and of acceleration
    /// structures what must be is built again. Returns whether meshes or images changed: then all is new, and pipelines that were
    /// made for the scene are of no use. Otherwise they, and [`Self::address`], stay what they are. Nothing that reads the scene may
    /// be under way.
    ///
    /// # Errors
    /// As [`Gpu::scene`]. The scene is then of no use.
    pub fn update(&mut self, scene: &CompiledScene, changes: SceneChanges) -> Result<bool, VulkanError> {
        if changes.geometry()
            || changes.has(Part::Texels)
            || !self.geometry.has_ranges_of(&scene.meshes)
            || !self.textures.has_places_of(&scene.textures)
        {
            *self = self.gpu.scene(scene, self.options)?;
            return Ok(true);
        }
        self.keep_transforms(changes)?;
        let mut upload = Upload::new(&self.gpu);
        for ((part, buffer), (_, name, content)) in self.arrays.iter_mut().zip(arrays(scene)) {
            if changes.has(*part) {
                buffer.refill(&mut upload, name, content)?;
            }
        }
        if changes.has(Part::Meshes) {
            self.geometry.update(&scene.meshes);
            self.mesh_tables.refill(&mut upload, "tables of meshes", cast_slice(self.geometry.tables()))?;
        }
        if changes.any(&[Part::Materials, Part::Textures]) && self.textures.update(&mut upload, scene)? {
            let tables = cast_slice(&self.textures.tables);
            self.texture_tables.refill(&mut upload, "tables of textures", tables)?;
        }
        if changes.any(&[Part::Materials, Part::Instances, Part::Transforms]) {
            self.accel.update(&self.gpu, scene, &self.geometry, changes)?;
            self.draws = Draws::new(&mut upload, scene, self.accel.plan())?;
            // Another structure may have the handle of one that is gone.
            self.descriptors.write_top(self.accel.top());
        }
        upload.write(&self.table, 0, bytes_of(&self.table_of(scene)))?;
        upload.finish()?;
        Ok(false)
    }

    /// The table.
    fn table_of(&self, scene: &CompiledScene) -> SceneTable {
        let at = |part| self.arrays.iter().find(|a| a.0 == part).expect("one of the arrays").1.address();
        let lights = |group| scene.light_group(group).1.len().saturating_sub(1) as u32;
        SceneTable {
            geometries: self.accel.records.address(),
            meshes: self.mesh_tables.address(),
            instances: at(Part::Instances),
            transforms: at(Part::Transforms),
            materials: at(Part::Materials),
            lobes: at(Part::Lobes),
            textures: self.texture_tables.address(),
            emissive_ranks: at(Part::EmissiveRanks),
            lights: at(Part::Lights),
            near_light_cdf: at(Part::NearLightCdf),
            far_light_cdf: at(Part::FarLightCdf),
            triangle_lights: at(Part::TriangleLights),
            punctual_lights: at(Part::PunctualLights),
            environment_pixels: at(Part::EnvironmentPixels),
            environment_row_cdf: at(Part::EnvironmentRowCdf),
            environment_cell_cdf: at(Part::EnvironmentCellCdf),
            near_lights: lights(LightGroup::Near),
            far_lights: lights(LightGroup::Far),
            sun: scene.sun,
            environment: scene.environment,
        }
    }
}
