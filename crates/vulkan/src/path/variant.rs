//! What the path tracer's pipeline is specialised for: settings of the render, and what its scene has, so that shaders carry neither code
//! nor registers for what is not there. Twins: `glsl/variants.glsl`, `glsl/bsdf/features.glsl`.

use crate::Specialisation;
use lumbre_core::bsdf::DiffuseSampling;
use lumbre_core::sampler::SamplerKind;
use lumbre_core::settings::{RenderSettings, TransmissiveShadows};
use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::NONE;
use lumbre_scene::compiled::lights::{LightGroup, kind};
use lumbre_scene::compiled::material::{LobesRecord, MaterialRecord, TextureUse, flag};

/// What a scene has.
#[derive(Clone, Debug)]
pub(crate) struct SceneConstants {
    constants: Specialisation,
    /// Which passes it needs.
    pub(crate) needs: Needs,
}

/// Passes and memory that only some scenes need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Needs {
    /// Lights of each group: far, near.
    pub(crate) lights: [bool; 2],
    /// Surfaces that let light through.
    pub(crate) transmission: bool,
    /// Solids that paths enter.
    pub(crate) solids: bool,
    /// Shadow catchers.
    pub(crate) catchers: bool,
    /// Surfaces that are there only in part.
    pub(crate) covered: bool,
}

impl SceneConstants {
    /// Looks the scene over.
    pub(crate) fn new(scene: &CompiledScene) -> Self {
        let constants = light_constants(Specialisation::new(), scene);
        let constants = material_constants(constants, scene);
        let any = |has: fn(&LobesRecord) -> bool| scene.lobes.iter().any(has);
        let constants = constants
            .bool(15, any(|l| !l.sheen_color.is_black()))
            .bool(16, any(|l| l.coat > 0.0))
            .bool(17, any(|l| l.iridescence > 0.0))
            .bool(18, any(|l| l.anisotropy > 0.0))
            .bool(19, any(|l| l.diffuse_roughness > 0.0))
            .bool(20, any(|l| l.diffuse_transmission > 0.0))
            .bool(61, !scene.lobes.is_empty());
        let material = |has: fn(&MaterialRecord) -> bool| scene.materials.iter().any(has);
        let needs = Needs {
            lights: [scene.has_lights(LightGroup::Far), scene.has_lights(LightGroup::Near)],
            transmission: material(|m| m.transmission > 0.0),
            solids: material(|m| m.has(flag::SOLID)),
            catchers: material(|m| m.has(flag::SHADOW_CATCHER)),
            covered: material(MaterialRecord::has_coverage),
        };
        SceneConstants { constants, needs }
    }

    /// Whether a pipeline made for `made` draws what one made for `asked` would: it may have features that nothing uses.
    /// Groups of lights, sun and environment are exact: shaders do not ask whether a sun that they know of is there, and a vertex that asks
    /// two groups of lights takes other numbers of the random stream. So are solids and transmission: with their code in it a compiler
    /// places other roundings (some samples differ in the last bit on llvmpipe).
    pub(crate) fn serves(made: &Specialisation, asked: &Specialisation) -> bool {
        made.covers(asked, |id| matches!(id, 10..=12 | 14..=20 | 52 | 53 | 56..=59 | 61..=63))
    }

    /// With the settings of a render.
    pub(crate) fn with(&self, settings: &RenderSettings) -> Specialisation {
        settings_constants(self.constants.clone(), settings)
    }
}

fn settings_constants(constants: Specialisation, settings: &RenderSettings) -> Specialisation {
    let shadows = match settings.transmissive_shadows {
        TransmissiveShadows::Auto => 0,
        TransmissiveShadows::Physical => 1,
        TransmissiveShadows::Straight => 2,
    };
    let sampler = match settings.sampler {
        SamplerKind::Sobol => 0,
        SamplerKind::Independent => 1,
    };
    constants
        .bool(0, settings.light_sampling)
        .uint(1, shadows)
        .bool(2, settings.shade_back_faces)
        .bool(3, settings.transparent_background)
        .bool(4, settings.clamp.is_some())
        .bool(21, settings.diffuse_sampling == DiffuseSampling::Uniform)
        .uint(30, sampler)
}

fn light_constants(constants: Specialisation, scene: &CompiledScene) -> Specialisation {
    let any = |kinds: &[u32]| scene.lights.iter().any(|l| kinds.contains(&l.kind));
    constants
        .bool(50, scene.has_lights(LightGroup::Near))
        .bool(51, scene.has_lights(LightGroup::Far))
        .bool(52, any(&[kind::TRIANGLE]))
        .bool(53, any(&[kind::POINT, kind::SPOT, kind::DIRECTIONAL]))
        .bool(54, scene.sun.light != NONE)
        .bool(55, scene.environment.light != NONE)
}

fn material_constants(constants: Specialisation, scene: &CompiledScene) -> Specialisation {
    let any = |has: &dyn Fn(&MaterialRecord) -> bool| scene.materials.iter().any(has);
    let flagged = |bit: u32| any(&|m| m.has(bit));
    let used = |t: &TextureUse| !t.is_none();
    let coats = scene.lobes.iter().any(|l| used(&l.coat_normal_texture));
    constants
        .bool(10, any(&|m| m.metallic > 0.0))
        .bool(11, any(&|m| m.specular > 0.0 && !m.has(flag::PHONG)))
        .bool(12, flagged(flag::PHONG))
        .bool(13, flagged(flag::SOLID))
        .bool(14, any(&|m| m.transmission > 0.0 && !m.has(flag::SOLID)))
        .bool(56, !scene.textures.is_empty())
        .bool(57, coats || any(&|m| used(&m.normal_texture)))
        .bool(58, flagged(flag::SHADOW_CATCHER))
        .bool(59, flagged(flag::DISPERSION))
        .bool(60, any(&|m| m.transmission > 0.0))
        .bool(62, flagged(flag::UNLIT))
        .bool(63, any(&|m| m.has_coverage()))
}
