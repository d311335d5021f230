//! What materials are made of, in plain words.

use super::MaterialInfo;
use lumbre_scene::{AlphaMode, Material, Scene, TextureRef};

/// Describes every material of a scene.
pub(super) fn materials(scene: &Scene) -> Vec<MaterialInfo> {
    let mut used = vec![false; scene.materials.len()];
    for (node, _) in scene.world_nodes() {
        let mesh = scene.nodes[node.index()].mesh.and_then(|m| scene.meshes.get(m.index()));
        for material in mesh.into_iter().flat_map(|m| &m.primitives).filter_map(|p| p.material) {
            if let Some(used) = used.get_mut(material.index()) {
                *used = true;
            }
        }
    }
    let one = |(m, used): (&Material, bool)| MaterialInfo {
        name: m.name.clone(),
        used,
        lobes: lobes(m),
        textures: textures(m).count(),
    };
    scene.materials.iter().zip(used).map(one).collect()
}

/// Names of the parts of a material that can be seen.
fn lobes(m: &Material) -> Vec<&'static str> {
    if m.unlit {
        return [Some("unlit"), alpha(m)].into_iter().flatten().collect();
    }
    let metallic_textured = m.metallic_roughness_texture.is_some();
    let metal = m.metallic > 0.0;
    let dielectric = m.metallic < 1.0 || metallic_textured;
    let clear = m.transmission > 0.0;
    let opaque = m.transmission < 1.0 || m.transmission_texture.is_some();
    let phong = m.phong.is_some();
    let thin = m.volume.is_none_or(|v| v.thickness <= 0.0);
    let is = |on: bool, name: &'static str| on.then_some(name);
    let parts = [
        is(dielectric && opaque && m.base_color.max_component() > 0.0, "diffuse"),
        is(m.diffuse_roughness > 0.0, "rough diffuse"),
        is(m.diffuse_transmission.is_some_and(|d| d.factor > 0.0), "diffuse transmission"),
        is(phong, "phong"),
        is(dielectric && !phong && m.specular > 0.0, "specular"),
        is(metal, "metal"),
        is(dielectric && clear && thin, "thin transmission"),
        is(dielectric && clear && !thin, "solid transmission"),
        is(clear && m.dispersion > 0.0, "dispersion"),
        is(m.anisotropy.is_some_and(|a| a.strength > 0.0), "anisotropy"),
        is(m.iridescence.is_some_and(|i| i.factor > 0.0), "iridescence"),
        is(m.sheen.is_some_and(|s| s.color.max_component() > 0.0), "sheen"),
        is(m.clearcoat.is_some_and(|c| c.factor > 0.0), "clearcoat"),
        is(m.emission.max_component() > 0.0, "emission"),
        is(m.normal_texture.is_some(), "normal map"),
        is(m.double_sided, "two-sided"),
        is(m.shadow_catcher, "shadow catcher"),
        alpha(m),
    ];
    parts.into_iter().flatten().collect()
}

fn alpha(m: &Material) -> Option<&'static str> {
    match m.alpha_mode {
        AlphaMode::Opaque => None,
        AlphaMode::Mask { .. } => Some("alpha mask"),
        AlphaMode::Blend => Some("alpha blend"),
    }
}

/// Every texture that a material refers to.
pub(super) fn textures(m: &Material) -> impl Iterator<Item = TextureRef> {
    let base = [
        m.base_color_texture,
        m.metallic_roughness_texture,
        m.normal_texture,
        m.emissive_texture,
        m.specular_texture,
        m.specular_color_texture,
        m.transmission_texture,
    ];
    let coat = m.clearcoat.map_or([None; 3], |c| [c.texture, c.roughness_texture, c.normal_texture]);
    let sheen = m.sheen.map_or([None; 2], |s| [s.color_texture, s.roughness_texture]);
    let film = m.iridescence.map_or([None; 2], |i| [i.texture, i.thickness_texture]);
    let through = m.diffuse_transmission.map_or([None; 2], |d| [d.texture, d.color_texture]);
    let others = [m.anisotropy.and_then(|a| a.texture), m.phong.and_then(|p| p.specular_texture)];
    base.into_iter().chain(coat).chain(sheen).chain(film).chain(through).chain(others).flatten()
}
