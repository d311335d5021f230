//! Shadow rays: how much light passes between two points in a straight line.

use crate::interaction::{Interaction, material_of};
use crate::light_sampling::LightSample;
use crate::surface::{Hue, Surface};
use crate::tracer::{CoverageKey, Tracer};
use glam::Vec3;
use lumbre_core::bsdf::DiffuseSampling;
use lumbre_core::medium::MediumStack;
use lumbre_core::ray::offset_ray_origin;
use lumbre_core::settings::{RenderSettings, TransmissiveShadows};
use lumbre_core::{Ray, Spectrum};
use lumbre_scene::compiled::material::flag;

/// A straight line to a light.
#[derive(Clone, Copy, Debug)]
pub struct ShadowRay {
    /// From here, already off the surface.
    pub origin: Vec3,
    /// Unit direction to the light.
    pub wi: Vec3,
    /// Where it ends.
    pub end: ShadowEnd,
    /// Moment in the shutter interval.
    pub time: f32,
    /// The media in which it begins.
    pub media: MediumStack,
    /// The wavelength of the path, nm, if it has taken one.
    pub wavelength: Option<f32>,
    /// Thin walls it may pass before the path would be too long.
    pub wall_budget: u32,
    /// Its light cannot be hit by scattered rays.
    pub to_delta_light: bool,
}

/// Where a shadow ray ends.
#[derive(Clone, Copy, Debug)]
pub enum ShadowEnd {
    /// At a distance along `wi`: infinite, or a light that has no surface.
    Distance(f32),
    /// On a surface.
    Surface {
        /// The point.
        point: Vec3,
        /// Its geometric normal, either side.
        ng: Vec3,
        /// Bound of the distance to the vertices of its triangle, metres.
        extent: f32,
    },
}

impl ShadowRay {
    fn ray(&self) -> Ray {
        let origin = self.origin;
        match self.end {
            ShadowEnd::Distance(d) => Ray { t_max: d, ..Ray::new(origin, self.wi, self.time) },
            ShadowEnd::Surface { point, ng, extent } => {
                // Both ends leave their surfaces towards each other, so neither is in the way.
                let to = offset_ray_origin(point, ng, -self.wi, extent) - origin;
                let d = to.length();
                let dir = if d > 0.0 { to / d } else { self.wi };
                Ray { t_max: d, ..Ray::new(origin, dir, self.time) }
            }
        }
    }
}

/// What arrives along a shadow ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arriving {
    /// Share of the light; black when something stands in between.
    pub share: Spectrum,
    /// It came straight through the surface of a solid. Paths that refract through it leave this light out, so light
    /// sampling has it to itself.
    pub through_solid: bool,
}

impl Arriving {
    const NOTHING: Arriving = Arriving { share: Spectrum::BLACK, through_solid: false };
}

/// Most transmissive surfaces that one shadow ray passes.
const MOST_SURFACES: u32 = 64;

impl Tracer<'_> {
    /// The line to a light from a vertex with `depth` scattering events before it, inside `media`; for paths of no particular moment
    /// and wavelength.
    #[inline]
    pub fn shadow_ray(
        &self,
        it: &Interaction,
        light: &LightSample,
        media: MediumStack,
        depth: u32,
    ) -> ShadowRay {
        ShadowRay {
            origin: it.leave(light.wi),
            wi: light.wi,
            end: light.end,
            time: 0.0,
            media,
            wavelength: None,
            wall_budget: self
                .settings
                .max_depth
                .unwrap_or(RenderSettings::DEPTH_BOUND)
                .saturating_sub(depth + 1),
            // The sun can be hit, but only by luck; behind glass its light is left to shadow rays like that of a point.
            to_delta_light: light.is_delta || light.light == self.scene.sun.light,
        }
    }

    /// How much of the light arrives.
    pub fn transmittance(&self, shadow: &ShadowRay, key: CoverageKey) -> Arriving {
        let ray = shadow.ray();
        let solids_pass = match self.settings.transmissive_shadows {
            TransmissiveShadows::Auto => shadow.to_delta_light,
            TransmissiveShadows::Physical => false,
            TransmissiveShadows::Straight => true,
        };
        // Most rays meet nothing transmissive: look for what blocks first.
        let mut meets_transmissive = false;
        let blocked = self.accel.any_hit(&ray, |hit| {
            if !self.covered(hit, key) {
                return false;
            }
            let material = &self.scene.materials[material_of(self.scene, hit) as usize];
            let passes = material.transmission > 0.0 && (solids_pass || !material.has(flag::SOLID));
            meets_transmissive |= passes;
            !passes
        });
        if blocked {
            Arriving::NOTHING
        } else if meets_transmissive {
            self.pass_through(ray, shadow, key)
        } else {
            Arriving { share: shadow.media.current().transmittance(ray.t_max), through_solid: false }
        }
    }

    /// Follows the ray from one transmissive surface to the next.
    fn pass_through(&self, ray: Ray, shadow: &ShadowRay, key: CoverageKey) -> Arriving {
        let mut media = shadow.media;
        let mut walls = shadow.wall_budget;
        let mut factor = Spectrum::WHITE;
        let mut through_solid = false;
        let mut ray = ray;
        let hue = shadow.wavelength.map_or(Hue::Straight, Hue::One);
        for _ in 0..MOST_SURFACES {
            let Some(hit) = self.accel.closest_hit(&ray, |hit| self.covered(hit, key)) else {
                let share = factor * media.current().transmittance(ray.t_max - ray.t_min);
                return Arriving { share, through_solid };
            };
            let it = Interaction::new(self.scene, &ray, &hit);
            let surface = Surface::new(self.scene, &it, -ray.dir, &media, hue, DiffuseSampling::Cosine);
            factor *= media.current().transmittance(hit.t - ray.t_min);
            let wo = surface.frame.to_local(-ray.dir);
            match surface.beyond {
                Some(beyond) => {
                    through_solid = true;
                    factor *= surface.bsdf.straight_transmittance(wo);
                    media.cross(beyond, it.material, it.front);
                }
                None if walls == 0 => return Arriving::NOTHING,
                None => {
                    factor *= surface.bsdf.thin_transmittance(wo);
                    walls -= 1;
                }
            }
            if factor.is_black() {
                return Arriving::NOTHING;
            }
            ray.t_min = hit.t;
        }
        Arriving::NOTHING
    }
}
