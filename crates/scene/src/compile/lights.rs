//! Lights: emissive triangles, punctual lights, sun, environment, and the tables that choose among them by power.

use super::{CompileError, Earlier, PlacedLight, environment};
use crate::compiled::geometry::{InstanceRecord, MeshRecord};
use crate::compiled::lights::{LightRecord, PunctualRecord, SunRecord, TriangleLightRecord, kind};
use crate::compiled::material::{MaterialRecord, flag};
use crate::compiled::texture::Encoding;
use crate::compiled::{CompiledScene, NONE};
use crate::{LightKind, Scene};
use glam::{Affine3A, Vec3};
use lumbre_core::Rgb;
use lumbre_core::distribution::write_cdf;
use lumbre_core::light::sun::SunDisc;
use lumbre_core::light::triangle::TriangleLight;
use lumbre_core::light::{directional, point, spot};
use lumbre_core::math::{PI, sin_cos, sqr};
use std::sync::Arc;

/// Compiles all lights.
pub(super) fn compile(
    scene: &Scene,
    placed: &[PlacedLight],
    earlier: Option<&Earlier<'_>>,
    out: &mut CompiledScene,
    notes: &mut Vec<String>,
) -> Result<(), CompileError> {
    check_count(placed.len(), out)?;
    let mut lights = Lights::default();
    match earlier.filter(|e| same_triangles(e, out)) {
        Some(earlier) => lights.keep_triangles(earlier.compiled, out),
        None => lights.add_all_triangles(out),
    }
    let is_directional = |id: crate::LightId| scene.lights[id.index()].kind == LightKind::Directional;
    let (far, near): (Vec<_>, Vec<_>) = placed.iter().partition(|(light, _)| is_directional(*light));
    for (light, to_world) in near {
        lights.add_punctual(scene, light, to_world, out, notes);
    }
    let near = lights.powers.len();
    for (light, to_world) in far {
        lights.add_punctual(scene, light, to_world, out, notes);
    }
    lights.add_sun(scene, out);
    environment::compile(scene, earlier, out)?;
    lights.add_environment(out);
    out.near_light_cdf = cdf(&lights.powers[..near]);
    out.far_light_cdf = cdf(&lights.powers[near..]);
    out.lights = lights.records.into();
    out.light_powers = lights.powers.into();
    Ok(())
}

/// Lights and their powers while they are collected.
#[derive(Default)]
struct Lights {
    records: Vec<LightRecord>,
    powers: Vec<f32>,
}

/// Most lights: each must find a place in the table that chooses among them.
const MOST_LIGHTS: u32 = 1 << 22;

/// Counts the lights before anything is made of them.
fn check_count(punctual: usize, out: &CompiledScene) -> Result<(), CompileError> {
    let emissive = |mesh: &MeshRecord| -> u64 {
        let (first, count) = (mesh.first_emissive_rank, mesh.triangle_count);
        if first == NONE {
            return 0;
        }
        let ranks = &out.emissive_ranks[first as usize..(first + count) as usize];
        ranks.iter().filter(|&&r| r != NONE).count() as u64
    };
    let of_mesh: Vec<u64> = out.meshes.iter().map(emissive).collect();
    let visible = out.instances.iter().filter(|i| i.mask != 0);
    let total = visible.map(|i| of_mesh[i.mesh as usize]).sum::<u64>() + punctual as u64 + 2;
    if total > u64::from(MOST_LIGHTS) {
        return Err(CompileError::TooLarge {
            what: "lights (emissive triangles of every instance)",
            limit: MOST_LIGHTS,
        });
    }
    Ok(())
}

/// Share of the choice within a group that goes by power. The rest is split evenly: power says nothing of how much arrives.
const BY_POWER: f64 = 0.8;

/// Weights of the choice among the lights of a group.
fn weights(powers: &[f32]) -> Vec<f32> {
    // A light whose power overflows or is not a number still gets its turn.
    let powers =
        powers.iter().map(|p| if p.is_finite() { f64::from(p.max(0.0)) } else { f64::from(f32::MAX) });
    let powers: Vec<f64> = powers.collect();
    let total: f64 = powers.iter().sum();
    let even = (1.0 - BY_POWER) / powers.len() as f64;
    powers.iter().map(|p| (BY_POWER * p / total.max(f64::MIN_POSITIVE) + even) as f32).collect()
}

/// The table that chooses among the lights of a group.
fn cdf(powers: &[f32]) -> Arc<[f32]> {
    let mut table = Vec::with_capacity(powers.len() + 1);
    write_cdf(&weights(powers), &mut table);
    table.into()
}

/// Whether the emissive triangles are those of the earlier scene, and shine as they did.
fn same_triangles(earlier: &Earlier<'_>, out: &CompiledScene) -> bool {
    let before = earlier.compiled;
    let shine = |m: &MaterialRecord| {
        let emits = m.has(flag::EMISSIVE);
        emits
            .then(|| (m.emission.to_array().map(f32::to_bits), m.emissive_texture, m.has(flag::DOUBLE_SIDED)))
    };
    // Where ranks are shared, so is the geometry.
    Arc::ptr_eq(&before.emissive_ranks, &out.emissive_ranks)
        && earlier.stands(&out.instances, &out.transforms)
        && earlier.shows(&out.instances)
        && Arc::ptr_eq(&before.texels, &out.texels)
        && before.textures == out.textures
        && before.materials.iter().map(shine).eq(out.materials.iter().map(shine))
}

impl Lights {
    fn push(&mut self, kind: u32, index: usize, power: Rgb) -> u32 {
        self.records.push(LightRecord { kind, index: index as u32 });
        self.powers.push(power.average());
        self.records.len() as u32 - 1
    }

    /// Takes over the emissive triangles of a scene, which are the first of its lights.
    fn keep_triangles(&mut self, from: &CompiledScene, out: &mut CompiledScene) {
        let count = from.triangle_lights.len();
        self.records.extend_from_slice(&from.lights[..count]);
        self.powers.extend_from_slice(&from.light_powers[..count]);
        out.triangle_lights = from.triangle_lights.clone();
        let first_lights = from.instances.iter().map(|i| i.first_light);
        // Nodes may have other numbers now.
        instances_mut(out).iter_mut().zip(first_lights).for_each(|(i, first)| i.first_light = first);
    }

    /// Adds the emissive triangles of all instances that are not hidden.
    fn add_all_triangles(&mut self, out: &mut CompiledScene) {
        let mut triangles = Vec::new();
        for instance in 0..out.instances.len() {
            let InstanceRecord { mesh, mask, .. } = out.instances[instance];
            if out.meshes[mesh as usize].first_emissive_rank == NONE || mask == 0 {
                continue;
            }
            instances_mut(out)[instance].first_light = self.records.len() as u32;
            self.add_triangles(instance, &mut triangles, out);
        }
        out.triangle_lights = triangles.into();
    }

    fn add_triangles(&mut self, instance: usize, lights: &mut Vec<TriangleLightRecord>, out: &CompiledScene) {
        let record = &out.instances[instance];
        let mesh = &out.meshes[record.mesh as usize];
        let key = &out.transforms[record.first_transform as usize];
        let to_world = key.object_to_world();
        for triangle in 0..mesh.triangle_count {
            let at = (mesh.first_triangle + triangle) as usize;
            let material = &out.materials[out.triangle_materials[at] as usize];
            if !material.has(flag::EMISSIVE) {
                continue;
            }
            let [p0, p1, p2] = out.triangles[at]
                .map(|v| to_world.transform_point3(Vec3::from_array(out.positions[v as usize])));
            let geometry = TriangleLight { p0, e1: p1 - p0, e2: p2 - p0 };
            let double_sided = material.has(flag::DOUBLE_SIDED);
            let mean = material.emission * mean_texture(material, out.triangles[at], out);
            let power = geometry.power(mean, if double_sided { 2.0 } else { 1.0 });
            let index = lights.len();
            lights.push(TriangleLightRecord {
                p0: geometry.p0.to_array(),
                e1: geometry.e1.to_array(),
                e2: geometry.e2.to_array(),
                radiance: material.emission,
                instance: instance as u32,
                triangle,
                side: if double_sided { 0.0 } else { key.handedness },
                textured: u32::from(!material.emissive_texture.is_none()),
            });
            self.push(kind::TRIANGLE, index, power);
        }
    }

    fn add_punctual(
        &mut self,
        scene: &Scene,
        light: crate::LightId,
        to_world: Affine3A,
        out: &mut CompiledScene,
        notes: &mut Vec<String>,
    ) {
        let authored = &scene.lights[light.index()];
        let axis = -Vec3::from(to_world.matrix3.z_axis).normalize_or(Vec3::Z);
        let position = Vec3::from(to_world.translation);
        let intensity = authored.intensity;
        if !(intensity.is_finite() && intensity.max_component() > 0.0 && position.is_finite()) {
            notes.push(format!("/lights/{}: gives no light and is left out", light.0));
            return;
        }
        let mut record = PunctualRecord {
            intensity,
            position: position.to_array(),
            axis: axis.to_array(),
            cos_inner: 1.0,
            cos_outer: -1.0,
        };
        let (kind, power) = match authored.kind {
            LightKind::Point => (kind::POINT, point::power(intensity)),
            LightKind::Directional => (kind::DIRECTIONAL, directional::power(intensity, radius(out))),
            LightKind::Spot { inner_angle, outer_angle } => {
                record.cos_inner = sin_cos(inner_angle).1;
                record.cos_outer = sin_cos(outer_angle).1;
                let cone = spot::Cone { axis, cos_inner: record.cos_inner, cos_outer: record.cos_outer };
                (kind::SPOT, spot::power(intensity, &cone))
            }
        };
        let index = out.punctual_lights.len();
        out.punctual_lights.push(record);
        self.push(kind, index, power);
    }

    fn add_sun(&mut self, scene: &Scene, out: &mut CompiledScene) {
        let Some(sun) = scene.environment.sun.filter(|s| s.irradiance.max_component() > 0.0) else { return };
        let direction = SunDisc::direction_of(sun.elevation, sun.azimuth);
        let disc = SunDisc::new(direction, sun.angular_radius, sun.irradiance.min(BRIGHTEST_SUN));
        let light = self.push(kind::SUN, 0, disc.power(radius(out)));
        out.sun = SunRecord {
            direction: disc.direction.to_array(),
            one_minus_cos: disc.one_minus_cos,
            radiance: disc.radiance,
            light,
        };
    }

    fn add_environment(&mut self, out: &mut CompiledScene) {
        let mean = out.environment_mean;
        if !mean.is_black() {
            let power = mean * (4.0 * PI * PI * sqr(radius(out)));
            out.environment.light = self.push(kind::ENVIRONMENT, 0, power);
        }
    }
}

/// The instances, which nobody shares yet.
fn instances_mut(out: &mut CompiledScene) -> &mut [InstanceRecord] {
    Arc::get_mut(&mut out.instances).expect("made for this scene")
}

/// Mean of the emissive texture over a triangle, from a few points; with a floor, since a light that is wrongly thought dark
/// would be found by scattered rays alone.
fn mean_texture(material: &MaterialRecord, triangle: [u32; 3], out: &CompiledScene) -> Rgb {
    if material.emissive_texture.is_none() {
        return Rgb::WHITE;
    }
    const SIDE: usize = 6;
    let mut sum = Rgb::BLACK;
    let mut n = 0.0;
    for i in 0..SIDE {
        for j in 0..SIDE - i {
            let (b1, b2) = ((i as f32 + 0.33) / SIDE as f32, (j as f32 + 0.33) / SIDE as f32);
            let b = [1.0 - b1 - b2, b1, b2];
            let mut uv = [[0.0f32; 2]; 2];
            for (v, weight) in triangle.iter().zip(b) {
                for (set, value) in uv.iter_mut().zip(out.vertices[*v as usize].uv) {
                    set[0] += weight * value[0];
                    set[1] += weight * value[1];
                }
            }
            sum += out.texture(&material.emissive_texture, &uv, Encoding::Srgb).rgb;
            n += 1.0;
        }
    }
    (sum * (1.0 / n)).max(0.02)
}

/// Radius that stands for the scene in the power of infinite lights.
fn radius(out: &CompiledScene) -> f32 {
    out.radius().max(1e-3)
}

/// Strongest irradiance of the sun, in each band: its radiance, some 15,000 times that, stays as finite as the brightest texel.
const BRIGHTEST_SUN: f32 = 1e25;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_light_vanishes_beside_a_strong_one() {
        let w = weights(&[1.0, 3.0, 1e20]);
        assert!(w[0] >= 0.05 && w[1] >= w[0] && w[2] >= 0.8, "{w:?}");
        assert!(w.iter().sum::<f32>() > 0.999);
        let dark = weights(&[0.0, f32::NAN]);
        assert!(dark.iter().all(|w| *w >= 0.1 && w.is_finite()), "{dark:?}");
    }
}
