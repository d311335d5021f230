//! The further lobes of a material at a point: their textures looked up, their frames built.

use crate::surface::ShadingNormals;
use lumbre_core::bsdf::{BsdfParams, CoatParams, FilmParams, GlossParams, SheenParams};
use lumbre_core::{Frame, Rgb};
use lumbre_scene::compiled::material::{LobesRecord, MaterialRecord, flag};
use lumbre_scene::compiled::texture::{Encoding, Rgba};

/// Adds what `lobes` says to `params` and returns the shading frame, its x axis along the stretched microfacets.
pub(crate) fn add(
    lobes: &LobesRecord,
    material: &MaterialRecord,
    normals: &ShadingNormals<'_>,
    frame: Frame,
    params: &mut BsdfParams,
) -> Frame {
    let (scene, it) = (normals.scene, normals.it);
    let linear = |t| -> Rgba { scene.texture(t, &it.uv, Encoding::Linear) };
    let srgb = |t| -> Rgb { scene.texture(t, &it.uv, Encoding::Srgb).rgb };
    if lobes.diffuse_roughness > 0.0 {
        params.diffuse_roughness =
            lobes.diffuse_roughness * linear(&material.metallic_roughness_texture).rgb.g;
    }
    if lobes.diffuse_transmission > 0.0 {
        params.diffuse_transmission =
            lobes.diffuse_transmission * linear(&lobes.diffuse_transmission_texture).a;
        params.diffuse_transmission_color =
            lobes.diffuse_transmission_color * srgb(&lobes.diffuse_transmission_color_texture);
    }
    if lobes.iridescence > 0.0 {
        let [min, max] = lobes.iridescence_thickness_nm;
        params.film = Some(FilmParams {
            factor: lobes.iridescence * linear(&lobes.iridescence_texture).rgb.r,
            ior: lobes.iridescence_ior,
            thickness_nm: min + (max - min) * linear(&lobes.iridescence_thickness_texture).rgb.g,
        });
    }
    if material.has(flag::PHONG) {
        params.gloss = Some(GlossParams {
            specular: lobes.phong_specular * srgb(&lobes.phong_specular_texture),
            exponent: lobes.phong_exponent,
            fresnel: material.has(flag::PHONG_FRESNEL),
        });
    }
    if !lobes.sheen_color.is_black() {
        params.sheen = Some(SheenParams {
            color: lobes.sheen_color * srgb(&lobes.sheen_color_texture),
            roughness: lobes.sheen_roughness * linear(&lobes.sheen_roughness_texture).a,
        });
    }
    let frame = if lobes.anisotropy > 0.0 { stretched(lobes, normals, frame, params) } else { frame };
    if lobes.coat > 0.0 {
        let normal = normals.mapped(&lobes.coat_normal_texture, lobes.coat_normal_scale);
        params.coat = Some(CoatParams {
            factor: lobes.coat * linear(&lobes.coat_texture).rgb.r,
            roughness: lobes.coat_roughness * linear(&lobes.coat_roughness_texture).rgb.g,
            normal: frame.to_local(normal).normalize(),
        });
    }
    frame
}

/// Sets the anisotropy and turns the frame so that its x axis lies along it (KHR_materials_anisotropy).
fn stretched(
    lobes: &LobesRecord,
    normals: &ShadingNormals<'_>,
    frame: Frame,
    params: &mut BsdfParams,
) -> Frame {
    let it = normals.it;
    let texture = &lobes.anisotropy_texture;
    let (mut direction, mut strength) = ([1.0, 0.0], 1.0);
    if !texture.is_none() {
        let texel = normals.scene.texture(texture, &it.uv, Encoding::Linear).rgb;
        direction = [2.0 * texel.r - 1.0, 2.0 * texel.g - 1.0];
        strength = texel.b;
    }
    params.anisotropy = lobes.anisotropy * strength;
    // The rotation of the material turns the direction of the texture.
    let [cos, sin] = lobes.anisotropy_direction;
    let (x, y) = (cos * direction[0] - sin * direction[1], sin * direction[0] + cos * direction[1]);
    // The bitangent of the mesh lies on the side that its tangents say, seen from the front.
    let side = if it.front { it.bitangent_sign } else { -it.bitangent_sign };
    Frame::from_normal_tangent(frame.n, frame.t * x + frame.b * (y * side))
}
