//! Next-event estimation: choose a light of a group, mostly by power (`compile/lights.rs` makes the tables), a point on it, and know the density
//! with which scattered rays would have been matched against it.

use crate::shadow::ShadowEnd;
use crate::surface;
use glam::Vec3;
use lumbre_core::distribution::sample_cdf;
use lumbre_core::light::sun::SunDisc;
use lumbre_core::light::triangle::TriangleLight;
use lumbre_core::light::{directional, point, spot};
use lumbre_core::{Rgb, Spectrum};
use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::lights::{LightGroup, PunctualRecord, TriangleLightRecord, kind};
use lumbre_scene::compiled::texture::Encoding;

/// Light that may arrive at a point.
#[derive(Clone, Copy, Debug)]
pub struct LightSample {
    /// Which light.
    pub light: u32,
    /// Unit direction to it.
    pub wi: Vec3,
    /// End of the shadow ray.
    pub end: ShadowEnd,
    /// Radiance; for lights that cannot be hit, irradiance on a surface that faces them. Without occlusion, and divided by nothing.
    pub radiance: Spectrum,
    /// Probability of the light in its group times, for lights that can be hit, the density of `wi` in sr⁻¹.
    pub pdf: f32,
    /// It cannot be hit: no density, no competing technique.
    pub is_delta: bool,
}

/// Geometry of a triangle light.
#[inline]
pub fn triangle(record: &TriangleLightRecord) -> TriangleLight {
    TriangleLight { p0: record.p0.into(), e1: record.e1.into(), e2: record.e2.into() }
}

/// The sun, if there is one.
#[inline]
pub fn sun(scene: &CompiledScene) -> SunDisc {
    let s = &scene.sun;
    SunDisc { direction: s.direction.into(), one_minus_cos: s.one_minus_cos, radiance: s.radiance }
}

/// Below this probability a light leaves too few digits of the number that chose it for a point on it.
const FEW_DIGITS: f32 = 1.0 / 4096.0;

/// Draws a light of a group and a point on it, as seen from `p`. `None`: no light, or one that gives nothing here.
///
/// The first number of `point` chooses the light, and what is left of it the point: so a lamp of many triangles is stratified as a whole. For
/// a light of small probability `fine` gives that coordinate anew.
pub fn sample_light(
    scene: &CompiledScene,
    group: LightGroup,
    p: Vec3,
    point: [f32; 2],
    fine: impl FnOnce() -> f32,
) -> Option<LightSample> {
    let (first, cdf) = scene.light_group(group);
    let choice = sample_cdf(cdf, point[0])?;
    let u = [if choice.probability < FEW_DIGITS { fine() } else { choice.remainder }, point[1]];
    let record = scene.lights[first + choice.index];
    let prob = choice.probability;
    let light = (first + choice.index) as u32;
    let far = |wi, pdf, radiance| LightSample {
        light,
        wi,
        end: ShadowEnd::Distance(f32::INFINITY),
        radiance,
        pdf: prob * pdf,
        is_delta: false,
    };
    match record.kind {
        kind::TRIANGLE => {
            let (wi, end, radiance, pdf) =
                sample_triangle(scene, &scene.triangle_lights[record.index as usize], p, u)?;
            Some(LightSample { light, wi, end, radiance, pdf: prob * pdf, is_delta: false })
        }
        kind::SUN => {
            let sun = sun(scene);
            let wi = sun.sample(u);
            let pdf = lumbre_core::warp::uniform_cone_pdf(sun.one_minus_cos);
            Some(far(wi, pdf, sun.radiance))
        }
        kind::ENVIRONMENT => {
            let environment = scene.environment_light();
            let (wi, pdf) = environment.sample(u)?;
            Some(far(wi, pdf, environment.radiance(wi)))
        }
        _ => sample_punctual(record.kind, &scene.punctual_lights[record.index as usize], p).map(|s| {
            LightSample {
                light,
                wi: s.wi,
                end: ShadowEnd::Distance(s.distance),
                radiance: s.irradiance,
                pdf: prob,
                is_delta: true,
            }
        }),
    }
}

fn sample_punctual(kind: u32, light: &PunctualRecord, p: Vec3) -> Option<lumbre_core::light::DeltaSample> {
    let (position, axis) = (Vec3::from(light.position), Vec3::from(light.axis));
    match kind {
        kind::POINT => point::sample(position, light.intensity, p),
        kind::SPOT => {
            let cone = spot::Cone { axis, cos_inner: light.cos_inner, cos_outer: light.cos_outer };
            spot::sample(position, light.intensity, &cone, p)
        }
        _ => Some(directional::sample(axis, light.intensity)),
    }
}

fn sample_triangle(
    scene: &CompiledScene,
    record: &TriangleLightRecord,
    p: Vec3,
    u: [f32; 2],
) -> Option<(Vec3, ShadowEnd, Rgb, f32)> {
    let geometry = triangle(record);
    let s = geometry.sample(p, u)?;
    let n = geometry.scaled_normal();
    // Light leaves on the side of the normal when it travels along it, against wi.
    if record.side * n.dot(s.wi) > 0.0 {
        return None;
    }
    let mut radiance = record.radiance;
    let mesh = &scene.meshes[scene.instances[record.instance as usize].mesh as usize];
    let at = (mesh.first_triangle + record.triangle) as usize;
    let material = &scene.materials[scene.triangle_materials[at] as usize];
    if record.textured == 1 || material.has_coverage() {
        let hit = crate::bvh::Hit {
            t: s.distance,
            instance: record.instance,
            triangle: record.triangle,
            b1: s.barycentrics[0],
            b2: s.barycentrics[1],
        };
        let attributes = crate::interaction::attributes(scene, &hit);
        radiance *= scene.texture(&material.emissive_texture, &attributes.uv, Encoding::Srgb).rgb;
        // Where the surface is there only in part, a scattered ray finds it only in part.
        if material.has_coverage() {
            radiance *= surface::coverage(scene, material, &attributes);
        }
    }
    let extent = geometry.e1.abs().max_element() + geometry.e2.abs().max_element();
    let end = ShadowEnd::Surface { point: s.point, ng: n.normalize_or(-s.wi), extent };
    (!radiance.is_black()).then_some((s.wi, end, radiance, s.pdf_solid_angle))
}

/// Density, sr⁻¹, with which [`sample_light`] from `p` would have drawn the direction `wi` to a triangle light hit at
/// squared distance `d2`.
#[inline]
pub fn pdf_triangle(scene: &CompiledScene, light: u32, wi: Vec3, d2: f32) -> f32 {
    let record = &scene.triangle_lights[scene.lights[light as usize].index as usize];
    scene.prob_light(light) * triangle(record).pdf_solid_angle(wi, d2)
}

/// The same for the sun.
#[inline]
pub fn pdf_sun(scene: &CompiledScene, wi: Vec3) -> f32 {
    scene.prob_light(scene.sun.light) * sun(scene).pdf(wi)
}

/// The same for the environment.
#[inline]
pub fn pdf_environment(scene: &CompiledScene, wi: Vec3) -> f32 {
    scene.prob_light(scene.environment.light) * scene.environment_light().pdf(wi)
}
