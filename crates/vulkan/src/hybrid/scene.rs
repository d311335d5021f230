//! What hybrid frames want to know of a scene beside its arrays.

use crate::{Buffer, Upload, VulkanError};
use glam::Vec3;
use lumbre_core::Spectrum;
use lumbre_core::camera::Camera;
use lumbre_core::math::PI;
use lumbre_scene::CompiledScene;
use lumbre_scene::compiled::NONE;
use lumbre_scene::compiled::lights::kind;

/// Reflectance that surfaces have in the mean, where light between them is guessed.
const TYPICAL_ALBEDO: f32 = 0.5;
/// Share of the sky that a surface sees in the mean.
const TYPICAL_SKY: f32 = 0.5;

/// Lights with sharp shadows, and how large the scene is.
pub(crate) struct HybridScene {
    sharp_lights: Buffer,
    sharp_light_count: u32,
    bounds: [Vec3; 2],
    ambient: Spectrum,
}

impl HybridScene {
    /// Looks a scene over.
    ///
    /// # Errors
    /// If memory is out.
    pub(crate) fn new(upload: &mut Upload, scene: &CompiledScene) -> Result<Self, VulkanError> {
        let sharp = |kind: u32| matches!(kind, kind::POINT | kind::SPOT | kind::DIRECTIONAL | kind::SUN);
        let ids: Vec<u32> =
            (0..).zip(scene.lights.iter()).filter(|(_, l)| sharp(l.kind)).map(|(i, _)| i).collect();
        Ok(HybridScene {
            sharp_lights: Buffer::with_content(
                upload,
                "lights with sharp shadows",
                bytemuck::cast_slice(&ids),
            )?,
            sharp_light_count: ids.len() as u32,
            bounds: scene.bounds.map(Vec3::from_array),
            ambient: ambient(scene),
        })
    }

    /// Address of their numbers.
    pub(crate) fn sharp_lights(&self) -> u64 {
        self.sharp_lights.address()
    }

    pub(crate) fn sharp_light_count(&self) -> u32 {
        self.sharp_light_count
    }

    /// Radiance that stands for light that no ray brings.
    pub(crate) fn ambient(&self) -> Spectrum {
        self.ambient
    }

    /// Metres beyond which nothing occludes ambient light: a twentieth of the scene.
    pub(crate) fn occlusion_reach(&self) -> f32 {
        0.05 * self.extent()
    }

    /// How large the scene is, metres.
    fn extent(&self) -> f32 {
        let size = (self.bounds[1] - self.bounds[0]).length();
        if size.is_finite() && size > 0.0 { size } else { 1.0 }
    }

    /// Nearest distance that is drawn, and for a camera whose rays are parallel the farthest, metres.
    pub(crate) fn range(&self, camera: &Camera) -> [f32; 2] {
        let [min, max] = self.bounds;
        let size = self.extent();
        let corner = |i: usize| {
            let pick = |axis: usize| if i >> axis & 1 == 0 { min[axis] } else { max[axis] };
            camera.forward.dot(Vec3::new(pick(0), pick(1), pick(2)) - camera.origin)
        };
        let far = (0..8).map(corner).fold(0.0, f32::max);
        [1e-6 * size, if far.is_finite() && far > 0.0 { 1.001 * far + 1e-3 * size } else { size }]
    }
}

/// Ambient radiance: half of what the sky has in the mean; what surfaces send back of light from far away, a quarter of which they see; and what
/// lamps would make of the inside of a box of the scene's size, where light is the same everywhere (the integrating sphere: Φ / (π A (1 - ρ))).
fn ambient(scene: &CompiledScene) -> Spectrum {
    let mut sum = Spectrum::BLACK;
    if scene.environment.light != NONE {
        sum += sky(scene) * TYPICAL_SKY;
    }
    let mut parallel = Spectrum::BLACK;
    let mut flux = Spectrum::BLACK;
    for light in scene.lights.iter() {
        let punctual = || &scene.punctual_lights[light.index as usize];
        match light.kind {
            kind::SUN => {
                parallel += Spectrum::from(scene.sun.radiance) * (2.0 * PI * scene.sun.one_minus_cos);
            }
            kind::DIRECTIONAL => parallel += Spectrum::from(punctual().intensity),
            kind::POINT => flux += Spectrum::from(punctual().intensity) * (4.0 * PI),
            kind::SPOT => {
                let cone = 1.0 - 0.5 * (punctual().cos_inner + punctual().cos_outer);
                flux += Spectrum::from(punctual().intensity) * (2.0 * PI * cone);
            }
            _ => {}
        }
    }
    sum += parallel * (0.25 * TYPICAL_ALBEDO / PI);
    let [min, max] = scene.bounds.map(Vec3::from_array);
    let e = max - min;
    let area = 2.0 * (e.x * e.y + e.y * e.z + e.z * e.x);
    if area.is_finite() && area > 0.0 {
        let lamps = scene.triangle_lights.iter().fold(flux, |sum, l| {
            let [e1, e2] = [l.e1, l.e2].map(Vec3::from_array);
            sum + Spectrum::from(l.radiance) * (PI * 0.5 * e1.cross(e2).length())
        });
        sum += lamps / (PI * area * (1.0 - TYPICAL_ALBEDO));
    }
    sum
}

/// Mean radiance of the environment over the sphere.
fn sky(scene: &CompiledScene) -> Spectrum {
    let (width, height) = (scene.environment.width as usize, scene.environment.height as usize);
    let mut sum = [0.0f64; 3];
    let mut weights = 0.0;
    for (row, texels) in scene.environment_pixels.chunks_exact(width.max(1)).take(height).enumerate() {
        let weight = (core::f64::consts::PI * (row as f64 + 0.5) / height as f64).sin() / width as f64;
        weights += weight * width as f64;
        for texel in texels {
            (0..3).for_each(|i| sum[i] += weight * f64::from(texel[i]));
        }
    }
    let [r, g, b] = sum.map(|s| (s / weights.max(1e-30)) as f32);
    Spectrum::new(r, g, b)
}
