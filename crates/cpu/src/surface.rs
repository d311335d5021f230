//! Materials at a point: textures looked up, the shading frame built, the BSDF made.

use crate::interaction::{HitAttributes, Interaction};
use crate::lobes;
use glam::Vec3;
use lumbre_core::bsdf::{Bsdf, BsdfParams, DiffuseSampling};
use lumbre_core::medium::{Medium, MediumStack};
use lumbre_core::sampler::Sampler;
use lumbre_core::wavelength::{Wavelength, dispersed_index};
use lumbre_core::{Frame, Rgb, Spectrum};
use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::NONE;
use lumbre_scene::compiled::material::{MaterialRecord, TextureUse, flag};
use lumbre_scene::compiled::texture::{Encoding, Rgba};

/// Everything the integrator asks of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Shading frame, its normal on the side the ray came from.
    pub frame: Frame,
    /// Geometric normal on the side the ray came from.
    pub ng: Vec3,
    /// Scattering.
    pub bsdf: Bsdf,
    /// Base colour, for `unlit` and the albedo plane.
    pub base_color: Rgb,
    /// The medium on the far side, for a solid.
    pub beyond: Option<Medium>,
    /// The wavelength that a path without one takes here.
    pub takes: Option<Takes>,
}

/// What a path carries, for solids that disperse.
#[derive(Clone, Copy, Debug)]
pub enum Hue<'a> {
    /// All wavelengths; the stream knows which one it takes when it must.
    All(&'a Sampler),
    /// One, nm.
    One(f32),
    /// All, along a line that does not bend: the d line stands for them.
    Straight,
}

/// A wavelength that a path must take.
#[derive(Clone, Copy, Debug)]
pub struct Takes {
    /// Which one.
    pub wavelength: Wavelength,
    /// Already on arrival. Otherwise only when it crosses: what is reflected does not depend on it.
    pub on_arrival: bool,
}

/// Base colour and alpha: factor × texture × vertex colour.
#[inline]
pub fn base_color(
    scene: &CompiledScene,
    material: &MaterialRecord,
    uv: &[[f32; 2]; 2],
    color: &[f32; 4],
) -> Rgba {
    let t = scene.texture(&material.base_color_texture, uv, Encoding::Srgb);
    Rgba {
        rgb: (material.base_color * t.rgb * Rgb::new(color[0], color[1], color[2])).max(0.0).min(1.0),
        a: (material.alpha * t.a * color[3]).clamp(0.0, 1.0),
    }
}

/// Probability that the surface is there, by its alpha mode.
#[inline]
pub fn coverage(scene: &CompiledScene, material: &MaterialRecord, at: &HitAttributes) -> f32 {
    let alpha = base_color(scene, material, &at.uv, &at.color).a;
    if material.has(flag::ALPHA_MASK) { f32::from(alpha >= material.alpha_cutoff) } else { alpha }
}

/// Radiance emitted towards the side `front`.
#[inline]
pub fn emission(
    scene: &CompiledScene,
    material: &MaterialRecord,
    uv: &[[f32; 2]; 2],
    front: bool,
) -> Spectrum {
    if !material.has(flag::EMISSIVE) || !(front || material.has(flag::DOUBLE_SIDED)) {
        return Spectrum::BLACK;
    }
    material.emission * scene.texture(&material.emissive_texture, uv, Encoding::Srgb).rgb
}

/// The medium inside a solid material.
#[inline]
pub fn medium(material: &MaterialRecord, id: u32) -> Medium {
    Medium { ior: material.ior, absorption: material.absorption, material: id }
}

/// The index of refraction of a solid at a wavelength.
#[inline]
pub fn index_at(scene: &CompiledScene, material: &MaterialRecord, nm: f32) -> f32 {
    if !material.has(flag::DISPERSION) {
        return material.ior;
    }
    dispersed_index(material.ior, scene.lobes[material.lobes as usize].dispersion, nm)
}

/// The two sides of a solid's boundary.
#[derive(Clone, Copy, Debug)]
struct Boundary {
    /// Index beyond over index here.
    eta: f32,
    /// That of the d line, where it shares out the light.
    eta_fresnel: Option<f32>,
    beyond: Medium,
    takes: Option<Takes>,
}

impl Boundary {
    #[inline]
    fn new(scene: &CompiledScene, it: &Interaction, media: &MediumStack, hue: Hue<'_>) -> Self {
        let material = &scene.materials[it.material as usize];
        let inside = medium(material, it.material);
        if material.has(flag::DISPERSION) {
            return Boundary::dispersed(scene, it, media, inside, hue);
        }
        let (here, beyond) = media.sides(inside, it.front);
        Boundary { eta: beyond.ior / here.ior, eta_fresnel: None, beyond, takes: None }
    }

    /// Media that a path is in have the index of its wavelength already: without one it is in none that disperses, or does not know.
    #[cold]
    fn dispersed(
        scene: &CompiledScene,
        it: &Interaction,
        media: &MediumStack,
        inside: Medium,
        hue: Hue<'_>,
    ) -> Self {
        let material = &scene.materials[it.material as usize];
        let at = |nm| {
            let inside = Medium { ior: index_at(scene, material, nm), ..inside };
            let (here, beyond) = media.sides(inside, it.front);
            (beyond.ior / here.ior, beyond)
        };
        let plain = |(eta, beyond)| Boundary { eta, eta_fresnel: None, beyond, takes: None };
        let wavelength = match hue {
            Hue::One(nm) => return plain(at(nm)),
            Hue::Straight => {
                let (here, beyond) = media.sides(inside, it.front);
                return plain((beyond.ior / here.ior, beyond));
            }
            Hue::All(sampler) => Wavelength::sample(sampler.wavelength()),
        };
        let (eta, beyond) = at(wavelength.nm);
        let eta_d = material.ior / media.current().ior;
        // Into a thinner medium total reflection depends on the wavelength, so what is reflected does too.
        let on_arrival = !it.front || eta.min(eta_d) < 1.0;
        let takes = Some(Takes { wavelength, on_arrival });
        Boundary { eta, eta_fresnel: (!on_arrival).then_some(eta_d), beyond, takes }
    }
}

impl Surface {
    /// The surface at `it`, seen from `wo` by light of `hue`, with the path inside `media`.
    pub fn new(
        scene: &CompiledScene,
        it: &Interaction,
        wo: Vec3,
        media: &MediumStack,
        hue: Hue<'_>,
        diffuse_sampling: DiffuseSampling,
    ) -> Self {
        let material = &scene.materials[it.material as usize];
        let base_color = base_color(scene, material, &it.uv, &it.color).rgb;
        let boundary = material.has(flag::SOLID).then(|| Boundary::new(scene, it, media, hue));
        let mut params = BsdfParams {
            eta: boundary.map_or(1.0, |b| b.eta),
            eta_fresnel: boundary.and_then(|b| b.eta_fresnel),
            inside: boundary.is_some() && !it.front,
            diffuse_sampling,
            ..bsdf_params(scene, material, &it.uv, base_color)
        };
        let ng = if it.front { it.ng } else { -it.ng };
        let normals = ShadingNormals { scene, it, wo, ng };
        let normal = normals.mapped(&material.normal_texture, material.normal_scale);
        let mut frame = Frame::from_normal_tangent(normal, it.tangent);
        if material.lobes != NONE {
            frame = lobes::add(&scene.lobes[material.lobes as usize], material, &normals, frame, &mut params);
        }
        let (beyond, takes) = boundary.map_or((None, None), |b| (Some(b.beyond), b.takes));
        Surface { frame, ng, bsdf: Bsdf::new(&params), base_color, beyond, takes }
    }
}

/// The material's values with its textures; `eta` and the diffuse sampling are left at their defaults.
pub fn bsdf_params(
    scene: &CompiledScene,
    material: &MaterialRecord,
    uv: &[[f32; 2]; 2],
    base_color: Rgb,
) -> BsdfParams {
    let texture = |t, encoding| scene.texture(t, uv, encoding);
    let rough_metal = texture(&material.metallic_roughness_texture, Encoding::Linear);
    BsdfParams {
        base_color,
        metallic: material.metallic * rough_metal.rgb.b,
        roughness: material.roughness * rough_metal.rgb.g,
        ior: material.ior,
        specular: material.specular * texture(&material.specular_texture, Encoding::Linear).a,
        specular_color: material.specular_color
            * texture(&material.specular_color_texture, Encoding::Srgb).rgb,
        transmission: material.transmission * texture(&material.transmission_texture, Encoding::Linear).rgb.r,
        thin: !material.has(flag::SOLID),
        ..BsdfParams::default()
    }
}

/// Smallest cosine between the shading normal and the viewer.
const MIN_COS_VIEW: f32 = 1e-3;

/// What shading normals at a hit are made from.
pub(crate) struct ShadingNormals<'a> {
    pub(crate) scene: &'a CompiledScene,
    pub(crate) it: &'a Interaction,
    /// Towards the viewer.
    pub(crate) wo: Vec3,
    /// Geometric normal on the viewer's side.
    pub(crate) ng: Vec3,
}

impl ShadingNormals<'_> {
    /// The interpolated normal, turned by a normal map if there is one, on the side of the viewer; unit.
    pub(crate) fn mapped(&self, texture: &TextureUse, scale: f32) -> Vec3 {
        let it = self.it;
        let mut ns = it.ns;
        if !texture.is_none() && it.tangent.length_squared() > 0.0 {
            let base = Frame::from_normal_tangent(ns, it.tangent);
            let texel = self.scene.texture(texture, &it.uv, Encoding::Linear).rgb * 2.0 - Rgb::WHITE;
            let (x, y) = (texel.r * scale, texel.g * scale);
            let mapped = base.t * x + base.b * (y * it.bitangent_sign) + base.n * texel.b;
            let mapped = mapped.normalize_or(ns);
            // A map that points below the surface is flattened onto it.
            ns = if mapped.dot(it.ng) > 0.0 {
                mapped
            } else {
                (mapped - it.ng * mapped.dot(it.ng)).normalize_or(ns)
            };
        }
        let ns = if it.front { ns } else { -ns };
        // Interpolated normals may face away from a viewer who sees the triangle: bend them until they do not.
        let cos = ns.dot(self.wo);
        if cos < MIN_COS_VIEW { (ns + self.wo * (MIN_COS_VIEW - cos)).normalize_or(self.ng) } else { ns }
    }
}
