//! The one form that both backends read: flat arrays of `#[repr(C)]` records, uploaded as they are.

pub mod changes;
pub mod geometry;
pub mod lights;
pub mod material;
pub mod surroundings;
pub mod texture;
pub mod triangle;

use bytemuck::{bytes_of, cast_slice};
use geometry::{InstanceRecord, MeshRecord, TransformKey, Vertex};
use lights::{EnvironmentRecord, LightGroup, LightRecord, PunctualRecord, SunRecord, TriangleLightRecord};
use lumbre_core::light::environment::EnvironmentLight;
use lumbre_core::{Rgb, Spectrum};
use material::{LobesRecord, MaterialRecord};
use std::sync::Arc;
use texture::TextureRecord;

/// An index that points nowhere.
pub const NONE: u32 = u32::MAX;

/// A scene ready to be drawn. Clones share what can be large.
#[derive(Clone, Debug, Default)]
pub struct CompiledScene {
    /// Vertex positions, object space, metres; `vertices` holds the rest of each.
    pub positions: Arc<[[f32; 3]]>,
    /// Unit normals, object space, as many as `positions`; zero: flat shading. Apart from the other attributes, which most hits do not
    /// read: three normals then lie in one or two lines of the cache.
    pub normals: Arc<[[f32; 3]]>,
    /// Further vertex attributes, as many as `positions`.
    pub vertices: Arc<[Vertex]>,
    /// Vertex indices of each triangle, into the whole of `positions`.
    pub triangles: Arc<[[u32; 3]]>,
    /// Material of each triangle.
    pub triangle_materials: Arc<[u32]>,
    /// Meshes: ranges of `triangles`.
    pub meshes: Vec<MeshRecord>,
    /// Rank of each triangle among the emissive ones of its mesh, or [`NONE`]; only for meshes that have any.
    pub emissive_ranks: Arc<[u32]>,
    /// Meshes placed in the world.
    pub instances: Arc<[InstanceRecord]>,
    /// Transforms of the instances, keyed by time.
    pub transforms: Arc<[TransformKey]>,
    /// Materials; the last one stands in where none is given.
    pub materials: Vec<MaterialRecord>,
    /// What only some materials have.
    pub lobes: Vec<LobesRecord>,
    /// Textures, each a range of `texels`.
    pub textures: Vec<TextureRecord>,
    /// RGBA8 texels, red in the low byte.
    pub texels: Arc<[u32]>,
    /// Every light: those of the scene's space, then those from far away.
    pub lights: Arc<[LightRecord]>,
    /// Cumulative probabilities of choosing each light of [`LightGroup::Near`]: one value more than there are.
    pub near_light_cdf: Arc<[f32]>,
    /// The same for [`LightGroup::Far`].
    pub far_light_cdf: Arc<[f32]>,
    /// Emissive triangles in world space.
    pub triangle_lights: Arc<[TriangleLightRecord]>,
    /// Point, spot and directional lights.
    pub punctual_lights: Vec<PunctualRecord>,
    /// The sun; its radiance is zero when there is none.
    pub sun: SunRecord,
    /// The environment map; a black one of one texel when there is none.
    pub environment: EnvironmentRecord,
    /// Texels of the environment.
    pub environment_pixels: Arc<[Rgb]>,
    /// Its distribution over rows.
    pub environment_row_cdf: Arc<[f32]>,
    /// Its distribution within rows.
    pub environment_cell_cdf: Arc<[f32]>,
    /// Corners of the world-space bounding box; `min > max` for an empty scene.
    pub bounds: [[f32; 3]; 2],
    /// Power of each light: what the probabilities above were made from. Not read when drawing.
    pub light_powers: Arc<[f32]>,
    /// Mean radiance of the environment over the sphere: what its power was made from. Not read when drawing.
    pub environment_mean: Spectrum,
}

impl CompiledScene {
    /// The environment with its tables.
    #[inline]
    pub fn environment_light(&self) -> EnvironmentLight<'_> {
        EnvironmentLight {
            width: self.environment.width,
            height: self.environment.height,
            rotation: self.environment.rotation,
            pixels: &self.environment_pixels,
            row_cdf: &self.environment_row_cdf,
            cell_cdf: &self.environment_cell_cdf,
        }
    }

    /// Index of the first light of a group, and the table that chooses among the group.
    #[inline]
    pub fn light_group(&self, group: LightGroup) -> (usize, &[f32]) {
        match group {
            LightGroup::Near => (0, &self.near_light_cdf),
            LightGroup::Far => (self.near_light_cdf.len().saturating_sub(1), &self.far_light_cdf),
        }
    }

    /// Whether a group has lights.
    #[inline]
    pub fn has_lights(&self, group: LightGroup) -> bool {
        self.light_group(group).1.len() > 1
    }

    /// Probability that the light sampler picks this light among those of its group.
    #[inline]
    pub fn prob_light(&self, light: u32) -> f32 {
        let light = light as usize;
        let (first_far, _) = self.light_group(LightGroup::Far);
        let (cdf, at) = match light.checked_sub(first_far) {
            None => (&self.near_light_cdf, light),
            Some(at) => (&self.far_light_cdf, at),
        };
        cdf[at + 1] - cdf[at]
    }

    /// All that a scene is, field by field: names, and values as bytes. In the order of [`changes::Part`].
    pub fn sections(&self) -> Vec<(&'static str, &[u8])> {
        // All fields by name, so that none is forgotten.
        let CompiledScene {
            positions,
            normals,
            vertices,
            triangles,
            triangle_materials,
            meshes,
            emissive_ranks,
            instances,
            transforms,
            materials,
            lobes,
            textures,
            texels,
            lights,
            near_light_cdf,
            far_light_cdf,
            triangle_lights,
            punctual_lights,
            sun,
            environment,
            environment_pixels,
            environment_row_cdf,
            environment_cell_cdf,
            bounds,
            // What stands above was made from these: they say nothing more.
            light_powers: _,
            environment_mean: _,
        } = self;
        vec![
            ("positions", cast_slice(positions)),
            ("normals", cast_slice(normals)),
            ("vertices", cast_slice(vertices)),
            ("triangles", cast_slice(triangles)),
            ("triangle_materials", cast_slice(triangle_materials)),
            ("meshes", cast_slice(meshes)),
            ("emissive_ranks", cast_slice(emissive_ranks)),
            ("instances", cast_slice(instances)),
            ("transforms", cast_slice(transforms)),
            ("materials", cast_slice(materials)),
            ("lobes", cast_slice(lobes)),
            ("textures", cast_slice(textures)),
            ("texels", cast_slice(texels)),
            ("lights", cast_slice(lights)),
            ("near_light_cdf", cast_slice(near_light_cdf)),
            ("far_light_cdf", cast_slice(far_light_cdf)),
            ("triangle_lights", cast_slice(triangle_lights)),
            ("punctual_lights", cast_slice(punctual_lights)),
            ("sun", bytes_of(sun)),
            ("environment", bytes_of(environment)),
            ("environment_pixels", cast_slice(environment_pixels)),
            ("environment_row_cdf", cast_slice(environment_row_cdf)),
            ("environment_cell_cdf", cast_slice(environment_cell_cdf)),
            ("bounds", bytes_of(bounds)),
        ]
    }

    /// Memory that it holds, bytes.
    pub fn bytes(&self) -> u64 {
        self.sections().iter().map(|(_, bytes)| bytes.len() as u64).sum()
    }

    /// Radius of the sphere around the bounding box, metres; 0 for an empty scene.
    pub fn radius(&self) -> f32 {
        let [min, max] = self.bounds.map(glam::Vec3::from_array);
        if min.cmpgt(max).any() { 0.0 } else { 0.5 * (max - min).length() }
    }
}
