//! Lights: emissive triangles, punctual lights, sun, environment, and the table that chooses among them by power.

use super::{CompileError, PlacedLight};
use crate::compiled::geometry::MeshRecord;
use crate::compiled::lights::{
    EnvironmentRecord, LightRecord, PunctualRecord, SunRecord, TriangleLightRecord, kind,
};
use crate::compiled::material::{MaterialRecord, flag};
use crate::compiled::texture::Encoding;
use crate::compiled::{CompiledScene, NONE};
use crate::{Background, LightKind, Scene};
use glam::{Affine3A, Vec3};
use lumbre_core::Rgb;
use lumbre_core::distribution::write_cdf;
use lumbre_core::light::sun::SunDisc;
use lumbre_core::light::triangle::TriangleLight;
use lumbre_core::light::{directional, environment, point, spot};
use lumbre_core::math::{PI, sin_cos, sqr};

/// Compiles all lights; `transforms` are those of the instances.
pub(super) fn compile(
    scene: &Scene,
    placed: &[PlacedLight],
    transforms: &[Affine3A],
    out: &mut CompiledScene,
    notes: &mut Vec<String>,
) -> Result<(), CompileError> {
    check_count(placed.len(), out)?;
    let mut powers = Vec::new();
    for (instance, to_world) in transforms.iter().enumerate() {
        add_triangles(instance, *to_world, out, &mut powers)?;
    }
    let is_directional = |id: crate::LightId| scene.lights[id.index()].kind == LightKind::Directional;
    let (far, near): (Vec<_>, Vec<_>) = placed.iter().partition(|(light, _)| is_directional(*light));
    for (light, to_world) in near {
        add_punctual(scene, light, to_world, out, &mut powers, notes);
    }
    let near = powers.len();
    for (light, to_world) in far {
        add_punctual(scene, light, to_world, out, &mut powers, notes);
    }
    add_sun(scene, out, &mut powers);
    add_environment(scene, out, &mut powers)?;
    write_cdf(&weights(&powers[..near]), &mut out.near_light_cdf);
    write_cdf(&weights(&powers[near..]), &mut out.far_light_cdf);
    Ok(())
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
    let total: u64 =
        out.instances.iter().filter(|i| i.mask != 0).map(|i| of_mesh[i.mesh as usize]).sum::<u64>()
            + punctual as u64
            + 2;
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

fn push(out: &mut CompiledScene, powers: &mut Vec<f32>, kind: u32, index: usize, power: Rgb) -> u32 {
    out.lights.push(LightRecord { kind, index: index as u32 });
    powers.push(power.average());
    out.lights.len() as u32 - 1
}

fn add_triangles(
    instance: usize,
    to_world: Affine3A,
    out: &mut CompiledScene,
    powers: &mut Vec<f32>,
) -> Result<(), CompileError> {
    let mesh = out.meshes[out.instances[instance].mesh as usize];
    if mesh.first_emissive_rank == NONE || out.instances[instance].mask == 0 {
        return Ok(());
    }
    out.instances[instance].first_light = out.lights.len() as u32;
    let handedness = out.transforms[out.instances[instance].first_transform as usize].handedness;
    for triangle in 0..mesh.triangle_count {
        let at = (mesh.first_triangle + triangle) as usize;
        let material = out.materials[out.triangle_materials[at] as usize];
        if !material.has(flag::EMISSIVE) {
            continue;
        }
        let [p0, p1, p2] =
            out.triangles[at].map(|v| to_world.transform_point3(Vec3::from_array(out.positions[v as usize])));
        let geometry = TriangleLight { p0, e1: p1 - p0, e2: p2 - p0 };
        let double_sided = material.has(flag::DOUBLE_SIDED);
        let mean = material.emission * mean_texture(&material, out.triangles[at], out);
        let power = geometry.power(mean, if double_sided { 2.0 } else { 1.0 });
        let index = out.triangle_lights.len();
        out.triangle_lights.push(TriangleLightRecord {
            p0: geometry.p0.to_array(),
            e1: geometry.e1.to_array(),
            e2: geometry.e2.to_array(),
            radiance: material.emission,
            instance: instance as u32,
            triangle,
            side: if double_sided { 0.0 } else { handedness },
            textured: u32::from(!material.emissive_texture.is_none()),
        });
        push(out, powers, kind::TRIANGLE, index, power);
    }
    Ok(())
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

fn add_punctual(
    scene: &Scene,
    light: crate::LightId,
    to_world: Affine3A,
    out: &mut CompiledScene,
    powers: &mut Vec<f32>,
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
    push(out, powers, kind, index, power);
}

/// Radius that stands for the scene in the power of infinite lights.
fn radius(out: &CompiledScene) -> f32 {
    out.radius().max(1e-3)
}

fn add_sun(scene: &Scene, out: &mut CompiledScene, powers: &mut Vec<f32>) {
    let Some(sun) = scene.environment.sun.filter(|s| s.irradiance.max_component() > 0.0) else { return };
    let direction = SunDisc::direction_of(sun.elevation, sun.azimuth);
    let disc = SunDisc::new(direction, sun.angular_radius, sun.irradiance.min(BRIGHTEST_SUN));
    let light = push(out, powers, kind::SUN, 0, disc.power(radius(out)));
    out.sun = SunRecord {
        direction: disc.direction.to_array(),
        one_minus_cos: disc.one_minus_cos,
        radiance: disc.radiance,
        light,
    };
}

/// Strongest irradiance of the sun, in each band: its radiance, some 15,000 times that, stays as finite as the brightest texel.
const BRIGHTEST_SUN: f32 = 1e25;

/// Brightest texel: sums of a whole map stay finite.
const BRIGHTEST: f32 = 1e30;

fn add_environment(
    scene: &Scene,
    out: &mut CompiledScene,
    powers: &mut Vec<f32>,
) -> Result<(), CompileError> {
    let environment = &scene.environment;
    let (width, height, pixels) = match &environment.background {
        Background::Black => (1, 1, vec![Rgb::BLACK]),
        Background::Constant(c) => (1, 1, vec![*c]),
        Background::Gradient => gradient(),
        Background::Map(map) => {
            if map.width == 0 || map.pixels.len() != map.width as usize * map.height as usize {
                let message = format!("{}x{} texels, but {} values", map.width, map.height, map.pixels.len());
                return Err(CompileError::Invalid { place: "environment".into(), message });
            }
            (map.width, map.height, map.pixels.to_vec())
        }
    };
    let strength = environment.strength.max(0.0);
    out.environment_pixels = pixels
        .iter()
        .map(|p| (*p * strength).map(|v| if v.is_nan() { 0.0 } else { v.clamp(0.0, BRIGHTEST) }))
        .collect();
    let (rows, cells, mean) = environment::build_distribution(width, height, &out.environment_pixels);
    (out.environment_row_cdf, out.environment_cell_cdf) = (rows, cells);
    let light = if mean.is_black() {
        NONE
    } else {
        push(out, powers, kind::ENVIRONMENT, 0, mean * (4.0 * PI * PI * sqr(radius(out))))
    };
    out.environment = EnvironmentRecord { width, height, rotation: environment.rotation, light };
    Ok(())
}

/// A plain clear sky: a pale horizon, a blue zenith, dull ground; its mean radiance is near 1 so that automatic and unit
/// exposure both suit it. Colours are ours.
fn gradient() -> (u32, u32, Vec<Rgb>) {
    const ROWS: u32 = 256;
    let (zenith, horizon, ground) =
        (Rgb::new(0.54, 1.07, 2.24), Rgb::new(2.04, 2.18, 2.33), Rgb::new(0.62, 0.56, 0.50));
    let row = |y: u32| {
        let elevation = 0.5 - (y as f32 + 0.5) / ROWS as f32; // in half turns, 0.5 at the zenith
        if elevation >= 0.0 {
            zenith.lerp(horizon, sqr(sqr(1.0 - 2.0 * elevation)))
        } else {
            // A soft edge of a few degrees below the horizon.
            horizon.lerp(ground, (-elevation * 40.0).min(1.0))
        }
    };
    (1, ROWS, (0..ROWS).map(row).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gradient_s_mean_is_near_one() {
        let (w, h, pixels) = gradient();
        let mean = environment::build_distribution(w, h, &pixels).2.luminance();
        assert!((mean - 1.0).abs() < 0.02, "{mean}");
    }

    #[test]
    fn no_light_vanishes_beside_a_strong_one() {
        let w = weights(&[1.0, 3.0, 1e20]);
        assert!(w[0] >= 0.05 && w[1] >= w[0] && w[2] >= 0.8, "{w:?}");
        assert!(w.iter().sum::<f32>() > 0.999);
        let dark = weights(&[0.0, f32::NAN]);
        assert!(dark.iter().all(|w| *w >= 0.1 && w.is_finite()), "{dark:?}");
    }
}
