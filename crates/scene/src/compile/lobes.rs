//! The further lobes of materials to records, with values brought into their domain.

use super::materials::{positive, texture_use, unit};
use crate::compiled::material::LobesRecord;
use crate::{Anisotropy, Clearcoat, DiffuseTransmission, Iridescence, Material, Phong, Sheen, TextureRef};
use lumbre_core::math::sin_cos;

/// All uses of textures by the further lobes.
pub(super) fn textures(m: &Material) -> impl Iterator<Item = &TextureRef> {
    let coat = m.clearcoat.iter().flat_map(|c| [&c.texture, &c.roughness_texture, &c.normal_texture]);
    let sheen = m.sheen.iter().flat_map(|s| [&s.color_texture, &s.roughness_texture]);
    let film = m.iridescence.iter().flat_map(|i| [&i.texture, &i.thickness_texture]);
    let diffuse = m.diffuse_transmission.iter().flat_map(|d| [&d.texture, &d.color_texture]);
    let stretched = m.anisotropy.iter().map(|a| &a.texture);
    let phong = m.phong.iter().map(|p| &p.specular_texture);
    coat.chain(sheen).chain(film).chain(diffuse).chain(stretched).chain(phong).flatten()
}

/// The use whose coordinates the tangents must follow: that of the normal map if there is one.
pub(super) fn tangent_uv_set(m: &Material) -> Option<u32> {
    let set = |t: &Option<TextureRef>| t.map(|t| t.uv_set);
    set(&m.normal_texture)
        .or_else(|| m.anisotropy.and_then(|a| (a.strength > 0.0).then(|| set(&a.texture).unwrap_or(0))))
        .or_else(|| m.clearcoat.and_then(|c| set(&c.normal_texture)))
}

/// The record of a material that has more than the base; `None` for the others.
pub(super) fn record(m: &Material) -> Option<LobesRecord> {
    if m.unlit {
        return None;
    }
    let dispersion = if m.dispersion.is_finite() { m.dispersion.max(0.0) } else { 0.0 };
    let diffuse_roughness = unit(m.diffuse_roughness, 0.0);
    let mut r = LobesRecord { dispersion, diffuse_roughness, ..LobesRecord::default() };
    let mut any = dispersion > 0.0 || diffuse_roughness > 0.0;
    if let Some(c) = &m.clearcoat {
        any |= coat(c, &mut r);
    }
    if let Some(s) = &m.sheen {
        any |= sheen(s, &mut r);
    }
    if let Some(a) = &m.anisotropy {
        any |= anisotropy(a, &mut r);
    }
    if let Some(i) = &m.iridescence {
        any |= iridescence(i, &mut r);
    }
    if let Some(d) = &m.diffuse_transmission {
        any |= diffuse_transmission(d, &mut r);
    }
    if let Some(p) = &m.phong {
        any = true;
        phong(p, &mut r);
    }
    any.then_some(r)
}

fn coat(c: &Clearcoat, r: &mut LobesRecord) -> bool {
    r.coat = unit(c.factor, 0.0);
    r.coat_roughness = unit(c.roughness, 0.0);
    r.coat_normal_scale = c.normal_scale;
    r.coat_texture = texture_use(&c.texture);
    r.coat_roughness_texture = texture_use(&c.roughness_texture);
    r.coat_normal_texture = texture_use(&c.normal_texture);
    r.coat > 0.0
}

fn sheen(s: &Sheen, r: &mut LobesRecord) -> bool {
    r.sheen_color = positive(s.color).min(1.0);
    r.sheen_roughness = unit(s.roughness, 0.0);
    r.sheen_color_texture = texture_use(&s.color_texture);
    r.sheen_roughness_texture = texture_use(&s.roughness_texture);
    !r.sheen_color.is_black()
}

fn anisotropy(a: &Anisotropy, r: &mut LobesRecord) -> bool {
    let (sin, cos) = sin_cos(if a.rotation.is_finite() { a.rotation } else { 0.0 });
    r.anisotropy = unit(a.strength, 0.0);
    r.anisotropy_direction = [cos, sin];
    r.anisotropy_texture = texture_use(&a.texture);
    r.anisotropy > 0.0
}

fn iridescence(i: &Iridescence, r: &mut LobesRecord) -> bool {
    let nm = |v: f32| if v.is_finite() { v.clamp(0.0, 1e5) } else { 0.0 };
    r.iridescence = unit(i.factor, 0.0);
    r.iridescence_ior = if i.ior.is_finite() { i.ior.clamp(1.0, 10.0) } else { 1.3 };
    r.iridescence_thickness_nm = [nm(i.thickness_min_nm), nm(i.thickness_max_nm)];
    r.iridescence_texture = texture_use(&i.texture);
    r.iridescence_thickness_texture = texture_use(&i.thickness_texture);
    r.iridescence > 0.0
}

fn diffuse_transmission(d: &DiffuseTransmission, r: &mut LobesRecord) -> bool {
    r.diffuse_transmission = unit(d.factor, 0.0);
    r.diffuse_transmission_color = positive(d.color).min(1.0);
    r.diffuse_transmission_texture = texture_use(&d.texture);
    r.diffuse_transmission_color_texture = texture_use(&d.color_texture);
    r.diffuse_transmission > 0.0
}

fn phong(p: &Phong, r: &mut LobesRecord) {
    r.phong_specular = positive(p.specular).min(1.0);
    // Infinite is a mirror; NaN the MTL format's 0.
    r.phong_exponent = if p.exponent.is_nan() { 0.0 } else { p.exponent.max(0.0) };
    r.phong_specular_texture = texture_use(&p.specular_texture);
}
