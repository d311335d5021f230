//! Lights: emissive triangles, punctual lights, sun, environment, and the table that chooses among them by power.

use super::{CompileError, PlacedLight};
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
    let mut powers = Vec::new();
    for (instance, to_world) in transforms.iter().enumerate() {
        add_triangles(instance, *to_world, out, &mut powers)?;
    }
    for &(light, to_world) in placed {
        add_punctual(scene, light, to_world, out, &mut powers, notes);
    }
    add_sun(scene, out, &mut powers);
    add_environment(scene, out, &mut powers)?;
    // A light whose power overflows or is not a number still gets its turn.
    let weights: Vec<f32> =
        powers.iter().map(|p| if p.is_finite() { p.max(0.0) } else { f32::MAX / 1e6 }).collect();
    write_cdf(&weights, &mut out.light_cdf);
    Ok(())
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
    if mesh.first_emissive_rank == NONE {
        return Ok(());
    }
    super::index32(out.lights.len() + mesh.triangle_count as usize, "lights")?;
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
    let disc =
        SunDisc::new(SunDisc::direction_of(sun.elevation, sun.azimuth), sun.angular_radius, sun.irradiance);
    let light = push(out, powers, kind::SUN, 0, disc.power(radius(out)));
    out.sun = SunRecord {
        direction: disc.direction.to_array(),
        one_minus_cos: disc.one_minus_cos,
        radiance: disc.radiance,
        light,
    };
}

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
            (map.width, map.height, map.pixels.clone())
        }
    };
    let strength = environment.strength.max(0.0);
    out.environment_pixels = pixels
        .iter()
        .map(|p| (*p * strength).map(|v| if v.is_finite() { v.max(0.0) } else { 0.0 }))
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
        (Rgb::new(0.28, 0.55, 1.15), Rgb::new(1.05, 1.12, 1.2), Rgb::new(0.32, 0.29, 0.26));
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
