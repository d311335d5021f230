//! Materials to records. Values outside their domain are brought into it here, once, so that no BSDF meets them.

use super::{CompileError, check, index32, lobes};
use crate::compiled::material::{MaterialRecord, TextureUse, flag};
use crate::compiled::{CompiledScene, NONE};
use crate::{AlphaMode, Material, Scene, TextureRef};
use lumbre_core::Rgb;
use lumbre_core::math::sin_cos;
use lumbre_core::medium::absorption_from_color;

pub(super) fn compile(
    scene: &Scene,
    out: &mut CompiledScene,
    notes: &mut Vec<String>,
) -> Result<(), CompileError> {
    for (i, m) in scene.materials.iter().enumerate() {
        let textures = [
            &m.base_color_texture,
            &m.metallic_roughness_texture,
            &m.normal_texture,
            &m.emissive_texture,
            &m.specular_texture,
            &m.specular_color_texture,
            &m.transmission_texture,
        ];
        for t in textures.into_iter().flatten().chain(lobes::textures(m)) {
            check(Some(t.texture.0), scene.textures.len(), "texture", || format!("/materials/{i}"))?;
            if t.uv_set > 1 {
                let message = format!("texture coordinate set {} (0 and 1 are read)", t.uv_set);
                return Err(CompileError::Invalid { place: format!("/materials/{i}"), message });
            }
        }
        if is_solid(m) && m.alpha_mode != AlphaMode::Opaque {
            notes.push(format!("/materials/{i}: solid glass has no alpha; its alpha mode is ignored"));
        }
        let mut compiled = record(m);
        if let Some(lobes) = lobes::record(m) {
            compiled.lobes = index32(out.lobes.len(), "materials")?;
            out.lobes.push(lobes);
        }
        out.materials.push(compiled);
    }
    let standard = Material { metallic: 0.0, double_sided: true, ..Material::default() };
    out.materials.push(record(&standard));
    Ok(())
}

/// Not negative and finite.
pub(super) fn positive(c: Rgb) -> Rgb {
    c.map(|v| if v.is_finite() { v.max(0.0) } else { 0.0 })
}

pub(super) fn unit(v: f32, otherwise: f32) -> f32 {
    if v.is_nan() { otherwise } else { v.clamp(0.0, 1.0) }
}

/// The boundary of a solid that transmits.
fn is_solid(m: &Material) -> bool {
    let transmits = m.transmission > 0.0 || m.diffuse_transmission.is_some_and(|d| d.factor > 0.0);
    m.volume.is_some_and(|v| v.thickness > 0.0) && transmits && !m.unlit
}

fn record(m: &Material) -> MaterialRecord {
    let emission = positive(m.emission);
    let solid = is_solid(m);
    let mut flags = 0;
    let mut set = |on: bool, bit: u32| flags |= if on { bit } else { 0 };
    set(m.double_sided, flag::DOUBLE_SIDED);
    set(m.unlit, flag::UNLIT);
    // A ray that entered a solid must leave it: its two sides cannot be there by chance.
    set(matches!(m.alpha_mode, AlphaMode::Mask { .. }) && !solid, flag::ALPHA_MASK);
    set(m.alpha_mode == AlphaMode::Blend && !solid, flag::ALPHA_BLEND);
    set(solid, flag::SOLID);
    set(!emission.is_black() && !m.unlit, flag::EMISSIVE);
    set(m.shadow_catcher && !m.unlit, flag::SHADOW_CATCHER);
    if let Some(phong) = m.phong.filter(|_| !m.unlit) {
        set(true, flag::PHONG);
        set(phong.fresnel, flag::PHONG_FRESNEL);
    }
    set(m.diffuse_transmission.is_some_and(|d| d.factor > 0.0) && !m.unlit, flag::DIFFUSE_TRANSMISSION);
    set(m.dispersion > 0.0 && solid, flag::DISPERSION);
    MaterialRecord {
        base_color: positive(m.base_color).min(1.0),
        alpha: unit(m.alpha, 1.0),
        emission,
        alpha_cutoff: if let AlphaMode::Mask { cutoff } = m.alpha_mode { cutoff } else { 0.5 },
        specular_color: positive(m.specular_color),
        specular: unit(m.specular, 1.0),
        absorption: m.volume.filter(|_| solid).map_or(Rgb::BLACK, |v| {
            absorption_from_color(positive(v.attenuation_color), v.attenuation_distance)
        }),
        // KHR_materials_ior: 0 asks for total reflection, which a very large index gives.
        ior: if m.ior == 0.0 {
            1e4
        } else if m.ior.is_finite() {
            m.ior.max(1.0)
        } else {
            1.5
        },
        metallic: unit(m.metallic, 0.0),
        roughness: unit(m.roughness, 1.0),
        transmission: if m.unlit { 0.0 } else { unit(m.transmission, 0.0) },
        normal_scale: m.normal_scale,
        flags,
        lobes: NONE,
        base_color_texture: texture_use(&m.base_color_texture),
        metallic_roughness_texture: texture_use(&m.metallic_roughness_texture),
        normal_texture: texture_use(&m.normal_texture),
        emissive_texture: texture_use(&m.emissive_texture),
        specular_texture: texture_use(&m.specular_texture),
        specular_color_texture: texture_use(&m.specular_color_texture),
        transmission_texture: texture_use(&m.transmission_texture),
    }
}

/// `KHR_texture_transform`: translation · rotation · scale. With v pointing down the extension's rotation matrix is
/// (cos, sin; -sin, cos).
pub(super) fn texture_use(t: &Option<TextureRef>) -> TextureUse {
    let Some(t) = t else { return TextureUse::default() };
    let (s, c) = sin_cos(t.transform.rotation);
    let ([sx, sy], [ox, oy]) = (t.transform.scale, t.transform.offset);
    TextureUse {
        texture: t.texture.0,
        uv_set: t.uv_set,
        transform: [[c * sx, s * sy, ox], [-s * sx, c * sy, oy]],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{TextureId, TextureTransform, Volume};

    /// The example of KHR_texture_transform: a quarter turn maps (1, 0) to (0, -1) before the offset.
    #[test]
    fn texture_transform_is_the_extension_s() {
        let transform = TextureTransform {
            offset: [0.0, 1.0],
            rotation: core::f32::consts::FRAC_PI_2,
            scale: [0.5, 0.5],
        };
        let used = texture_use(&Some(TextureRef { texture: TextureId(0), uv_set: 0, transform }));
        let [u, v] = used.uv(&[[1.0, 0.0], [0.0; 2]]);
        assert!(u.abs() < 1e-6 && (v - 0.5).abs() < 1e-6, "{u} {v}");
    }

    #[test]
    fn values_are_brought_into_their_domain() {
        let m = Material {
            base_color: Rgb::new(2.0, -1.0, f32::NAN),
            ior: 0.5,
            roughness: f32::NAN,
            volume: Some(Volume {
                thickness: 1.0,
                attenuation_color: Rgb::splat(0.5),
                attenuation_distance: 2.0,
            }),
            transmission: 1.0,
            ..Material::default()
        };
        let r = record(&m);
        assert_eq!((r.base_color, r.ior, r.roughness), (Rgb::new(1.0, 0.0, 0.0), 1.0, 1.0));
        assert!(r.has(flag::SOLID) && (r.absorption.g - 0.5f32.ln().abs() / 2.0).abs() < 1e-6);
        assert!(!r.has(flag::EMISSIVE));
    }
}
