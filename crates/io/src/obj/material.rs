//! MTL materials to the scene's. `illum` chooses the model as the format's tradition means it (Wavefront Technologies 1995):
//!
//! | illum | here |
//! |---|---|
//! | 0, 1 | diffuse |
//! | 2 | diffuse under an energy-normalised Phong gloss (Ks, Ns) |
//! | 3, 8 | diffuse under a mirror (Ks) |
//! | 5 | the same with Fresnel |
//! | 4, 9 | with `d` < 1 or `map_d` as 2, partly there; otherwise a thin pane of glass, which does not bend light |
//! | 6, 7 | solid glass of index Ni; Tf is what passes a whole body. Fresnel holds for both |
//! | 10 | catches shadows |
//! | none | 2 if there is a Ks, otherwise 1 |
//!
//! Pr and Pm instead ask for metallic-roughness, or for a rough diffuse surface (Oren-Nayar) where nothing is specular.
//! Colours are linear, Ke is radiance, `d` without glass is the probability that the surface is there.

use super::library::Entry;
use super::mtl::Mtl;
use super::textures::Textures;
use lumbre_core::Rgb;
use lumbre_scene::{AlphaMode, Anisotropy, Clearcoat, Material, Phong, Sheen, TextureRef, Volume};

/// Albedo of what has no material: a middle grey.
const GREY: f32 = 0.6;
/// Exponent of a gloss without Ns.
const PLAIN_EXPONENT: f32 = 10.0;
/// Index of glass without Ni.
const PLAIN_IOR: f32 = 1.5;
/// Indices by the first letters of a name, where the format has none.
const IOR_BY_NAME: [(&str, f32); 2] = [("water", 1.333), ("glass", 1.517)];
/// Roughness of sheen, for which MTL has no key.
const SHEEN_ROUGHNESS: f32 = 0.5;

/// For faces whose material is not known; `white` where vertex colours say all.
pub(crate) fn stand_in(name: &str, white: bool) -> Material {
    let albedo = if white { 1.0 } else { GREY };
    Material { name: name.into(), ..Material::diffuse(Rgb::splat(albedo)) }
}

/// What a surface is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Model {
    Diffuse,
    Gloss,
    Mirror {
        fresnel: bool,
    },
    Pane,
    Solid {
        ior: f32,
    },
    Catcher,
    /// Metallic-roughness.
    Metal,
    /// Rough and diffuse.
    Matte,
}

/// Makes a material of the scene. What is odd about it is told to `textures`.
pub(super) fn load(entry: &Entry, textures: &mut Textures) -> Material {
    // A picture that is not there is as if it had not been named: it must not switch anything on.
    let mut entry = entry.clone();
    entry.mtl.maps_mut().into_iter().for_each(|map| textures.forget_missing(entry.file, map));
    let entry = &entry;
    let Entry { mtl, file } = entry;
    let coverage = Coverage::new(mtl, textures);
    let model = model(mtl, &coverage, textures);
    let mut m = Material {
        name: mtl.name.clone(),
        base_color: diffuse_color(mtl, model),
        specular: 0.0,
        double_sided: true,
        emission: mapped(mtl.ke, mtl.map_ke.is_some()),
        emissive_texture: textures.plain(*file, &mtl.map_ke),
        ..Material::default()
    };
    if let Some(normals) = textures.normals(*file, &mtl.norm, &mtl.bump) {
        m.normal_texture = Some(normals.texture);
        m.normal_scale = normals.strength;
    }
    m.clearcoat = mtl.pc.filter(|&c| c > 0.0).map(|factor| coat(factor, mtl.pcr.unwrap_or(0.0)));
    m.sheen = mtl.ps.filter(|&s| s > 0.0).map(sheen);
    match model {
        Model::Pane | Model::Solid { .. } => glass(&mut m, mtl, model),
        _ => {
            cover(&mut m, entry, &coverage, textures);
            opaque(&mut m, entry, model, textures);
        }
    }
    m
}

/// `d` and `Tr`.
struct Coverage {
    /// Constant part.
    alpha: f32,
    /// Less than opaque somewhere, by what the material says (not by the alpha of a colour map).
    partial: bool,
}

impl Coverage {
    fn new(mtl: &Mtl, textures: &mut Textures) -> Self {
        let alpha = match (mtl.d, mtl.tr) {
            (Some(d), _) => d,
            // Programs that mean the opposite of transparency by Tr write 1 for what is plainly there.
            (None, Some(tr)) if tr >= 1.0 && mtl.map_d.is_none() => {
                textures.warn("Tr 1 would make it invisible; it is taken as opaque");
                1.0
            }
            (None, Some(tr)) => 1.0 - tr,
            (None, None) => 1.0,
        };
        let alpha = alpha.clamp(0.0, 1.0);
        Coverage { alpha, partial: alpha < 1.0 || mtl.map_d.is_some() }
    }
}

/// The index of refraction that the material states; 0 and the like stand for none.
fn stated_ior(mtl: &Mtl) -> Option<f32> {
    mtl.ni.filter(|&n| n >= 1.0)
}

/// The index that the name of a clear material says.
fn ior_by_name(mtl: &Mtl) -> Option<f32> {
    let lower = mtl.name.to_lowercase();
    let (_, ior) = IOR_BY_NAME.iter().find(|(begin, _)| lower.starts_with(begin))?;
    // What has a picture or shines is a thing of that name (a watermelon, a glass lamp), not the stuff.
    let plain = mtl.map_kd.is_none() && mtl.ke.is_none_or(|e| e.is_black()) && mtl.map_ke.is_none();
    (stated_ior(mtl).is_none() && plain).then_some(*ior)
}

fn model(mtl: &Mtl, coverage: &Coverage, textures: &mut Textures) -> Model {
    if let Some(ior) = ior_by_name(mtl) {
        return Model::Solid { ior };
    }
    let solid = Model::Solid { ior: stated_ior(mtl).unwrap_or(PLAIN_IOR) };
    let glossy = mtl.ks.is_some_and(|k| !k.is_black()) || mtl.map_ks.is_some();
    let physical = mtl.pr.is_some() || mtl.pm.is_some() || mtl.map_pr.is_some() || mtl.map_pm.is_some();
    let plain = if glossy { Model::Gloss } else { Model::Diffuse };
    match mtl.illum {
        Some(6 | 7) => solid,
        Some(4 | 9) if !coverage.partial => Model::Pane,
        Some(10) => Model::Catcher,
        illum if physical => {
            let metallic = mtl.pm.is_some_and(|m| m > 0.0) || mtl.map_pm.is_some();
            let dull = matches!(illum, Some(0 | 1)) || (mtl.ks.is_some() && !glossy);
            if dull && !metallic { Model::Matte } else { Model::Metal }
        }
        Some(0 | 1) => Model::Diffuse,
        Some(3 | 8) => Model::Mirror { fresnel: false },
        Some(5) => Model::Mirror { fresnel: true },
        Some(2 | 4 | 9) | None => plain,
        Some(other) => {
            textures.warn(format!("illum {other} is none of the models 0 to 10"));
            plain
        }
    }
}

/// A colour with a map: programs that give a map often leave the colour black, which would hide it.
fn mapped(color: Option<Rgb>, has_map: bool) -> Rgb {
    match color {
        Some(c) if !(has_map && c.is_black()) => c,
        _ if has_map => Rgb::WHITE,
        _ => Rgb::BLACK,
    }
}

fn diffuse_color(mtl: &Mtl, model: Model) -> Rgb {
    let reflects = matches!(model, Model::Mirror { .. });
    let glows = mtl.ke.is_some_and(|e| !e.is_black());
    match mtl.kd {
        None if mtl.map_kd.is_none() && !reflects && !glows => Rgb::splat(GREY),
        kd => mapped(kd, mtl.map_kd.is_some()),
    }
}

fn coat(factor: f32, roughness: f32) -> Clearcoat {
    Clearcoat {
        factor,
        texture: None,
        roughness,
        roughness_texture: None,
        normal_texture: None,
        normal_scale: 1.0,
    }
}

fn sheen(strength: f32) -> Sheen {
    Sheen {
        color: Rgb::splat(strength),
        color_texture: None,
        roughness: SHEEN_ROUGHNESS,
        roughness_texture: None,
    }
}

/// Clear glass: nothing of it is diffuse.
fn glass(m: &mut Material, mtl: &Mtl, model: Model) {
    let filter = mtl.tf.unwrap_or(Rgb::WHITE).max(0.0).min(1.0);
    m.transmission = 1.0;
    m.specular = 1.0;
    m.roughness = mtl.pr.unwrap_or(0.0);
    match model {
        Model::Solid { ior } => {
            m.ior = ior;
            // A body is crossed twice, in and out; the colour counts at each.
            m.base_color = filter.map(f32::sqrt);
            m.volume = Some(Volume {
                thickness: 1.0,
                attenuation_color: Rgb::WHITE,
                attenuation_distance: f32::INFINITY,
            });
        }
        _ => {
            m.ior = stated_ior(mtl).unwrap_or(PLAIN_IOR);
            m.base_color = filter;
        }
    }
}

/// Colour map and coverage.
fn cover(m: &mut Material, entry: &Entry, coverage: &Coverage, textures: &mut Textures) {
    let mtl = &entry.mtl;
    let (texture, some_alpha) = textures.color_and_coverage(entry.file, &mtl.map_kd, &mtl.map_d);
    m.base_color_texture = texture;
    m.alpha = coverage.alpha;
    if coverage.alpha < 1.0 || some_alpha {
        m.alpha_mode = AlphaMode::Blend;
    }
}

fn opaque(m: &mut Material, entry: &Entry, model: Model, textures: &mut Textures) {
    let Entry { mtl, file } = entry;
    match model {
        Model::Gloss | Model::Mirror { .. } => {
            let texture = textures.plain(*file, &mtl.map_ks);
            m.phong = Some(phong(mtl, model, texture));
        }
        Model::Catcher => m.shadow_catcher = true,
        Model::Metal => {
            m.specular = 1.0;
            m.ior = stated_ior(mtl).unwrap_or(PLAIN_IOR);
            m.metallic = factor(mtl.pm, mtl.map_pm.is_some(), 0.0);
            m.roughness = factor(mtl.pr, mtl.map_pr.is_some(), 0.5);
            m.metallic_roughness_texture = textures.rough_metal(*file, &mtl.map_pr, &mtl.map_pm);
            m.anisotropy = mtl.aniso.filter(|&a| a > 0.0).map(|strength| Anisotropy {
                strength,
                rotation: mtl.anisor.unwrap_or(0.0) * std::f32::consts::TAU,
                texture: None,
            });
        }
        Model::Matte => {
            m.diffuse_roughness = factor(mtl.pr, mtl.map_pr.is_some(), 0.0);
            m.metallic_roughness_texture = textures.rough_metal(*file, &mtl.map_pr, &None);
        }
        Model::Diffuse | Model::Pane | Model::Solid { .. } => {}
    }
}

/// A factor with a map, as for colours.
fn factor(value: Option<f32>, has_map: bool, otherwise: f32) -> f32 {
    match value {
        Some(v) if !(has_map && v == 0.0) => v,
        _ if has_map => 1.0,
        _ => otherwise,
    }
}

fn phong(mtl: &Mtl, model: Model, specular_texture: Option<TextureRef>) -> Phong {
    let exponent = match model {
        Model::Mirror { .. } => f32::INFINITY,
        _ => mtl.ns.unwrap_or(PLAIN_EXPONENT).max(0.0),
    };
    let specular = match (model, mtl.ks) {
        (Model::Mirror { .. }, None) => Rgb::WHITE,
        (_, ks) => mapped(ks, mtl.map_ks.is_some()),
    };
    Phong { specular, specular_texture, exponent, fresnel: model == Model::Mirror { fresnel: true } }
}
