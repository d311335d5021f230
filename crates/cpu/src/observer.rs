//! Watching a path go by, vertex by vertex. The render loop only counts rays ([`RayCounter`]);
//! what it ignores compiles to nothing.

use crate::interaction::Interaction;
use glam::Vec3;
use lumbre_core::bsdf::Lobe;
use lumbre_core::{Ray, Spectrum};

/// Something that happened on a path.
#[derive(Clone, Copy, Debug)]
pub enum PathEvent<'a> {
    /// The camera sent a ray.
    Camera {
        /// The ray.
        ray: &'a Ray,
    },
    /// A surface was met.
    Hit {
        /// Where.
        it: &'a Interaction,
        /// Shading normal on the side of the ray.
        ns: Vec3,
        /// Throughput on arrival.
        beta: Spectrum,
    },
    /// The path took one wavelength.
    Wavelength {
        /// Which, nm.
        nm: f32,
        /// Factor on the throughput.
        weight: Spectrum,
    },
    /// A shadow catcher let the path through.
    Caught {
        /// Where.
        it: &'a Interaction,
        /// Share of the direct light that arrives there.
        share: Spectrum,
        /// Shadow rays asked for it.
        rays: u32,
    },
    /// Light was met by the path itself: an emissive surface, the sun, the environment, an unlit surface.
    Emission {
        /// What shines.
        source: &'static str,
        /// Its radiance.
        radiance: Spectrum,
        /// Weight against light sampling.
        mis_weight: f32,
        /// What it adds to the pixel.
        contribution: Spectrum,
    },
    /// A light was sampled.
    Light {
        /// Which of the compiled scene's lights.
        light: u32,
        /// Direction to it.
        wi: Vec3,
        /// Probability of the light times the density, sr⁻¹.
        pdf: f32,
        /// Share of its light that arrives.
        transmittance: Spectrum,
        /// Weight against scattering.
        mis_weight: f32,
        /// What it adds to the pixel.
        contribution: Spectrum,
    },
    /// The path went on.
    Scatter {
        /// The lobe.
        lobe: Lobe,
        /// New direction.
        wi: Vec3,
        /// Density, sr⁻¹, or probability of a delta lobe.
        pdf: f32,
        /// Factor on the throughput.
        weight: Spectrum,
    },
    /// Roulette was played.
    Roulette {
        /// Probability of going on.
        survival: f32,
        /// It did.
        survived: bool,
    },
    /// The path left the scene.
    Miss {
        /// In this direction.
        dir: Vec3,
        /// With this throughput.
        beta: Spectrum,
    },
    /// The path ended.
    End {
        /// Why.
        reason: &'static str,
    },
}

/// Receives the events of a path in order.
pub trait PathObserver {
    /// One event.
    fn event(&mut self, event: PathEvent<'_>);
}

/// Counts the rays that paths trace: one for each surface met or missed, one for each light asked.
#[derive(Clone, Copy, Debug, Default)]
pub struct RayCounter {
    /// Rays so far.
    pub rays: u64,
}

impl PathObserver for RayCounter {
    #[inline(always)]
    fn event(&mut self, event: PathEvent<'_>) {
        match event {
            PathEvent::Hit { .. } | PathEvent::Miss { .. } | PathEvent::Light { .. } => self.rays += 1,
            PathEvent::Caught { rays, .. } => self.rays += u64::from(1 + rays),
            _ => {}
        }
    }
}

impl<F: FnMut(PathEvent<'_>)> PathObserver for F {
    fn event(&mut self, event: PathEvent<'_>) {
        self(event);
    }
}

/// Formats events for people: one line each.
pub fn describe(event: &PathEvent<'_>) -> String {
    let rgb = |c: Spectrum| format!("({:.6}, {:.6}, {:.6})", c.r, c.g, c.b);
    let v = |v: Vec3| format!("({:.6}, {:.6}, {:.6})", v.x, v.y, v.z);
    match event {
        PathEvent::Camera { ray } => format!("camera  origin {} direction {}", v(ray.origin), v(ray.dir)),
        PathEvent::Hit { it, ns, beta } => format!(
            "hit     t {:.6} at {} ng {} ns {} {} instance {} triangle {} material {} throughput {}",
            it.t,
            v(it.p),
            v(it.ng),
            v(*ns),
            if it.front { "front" } else { "back" },
            it.instance,
            it.triangle,
            it.material,
            rgb(*beta)
        ),
        PathEvent::Wavelength { nm, weight } => format!("hue     {nm:.3} nm weight {}", rgb(*weight)),
        PathEvent::Caught { it, share, .. } => format!(
            "catches t {:.6} at {} instance {} triangle {} material {} shadow leaves {}",
            it.t,
            v(it.p),
            it.instance,
            it.triangle,
            it.material,
            rgb(*share)
        ),
        PathEvent::Emission { source, radiance, mis_weight, contribution } => format!(
            "found   {source}: radiance {} weight {mis_weight:.6} adds {}",
            rgb(*radiance),
            rgb(*contribution)
        ),
        PathEvent::Light { light, wi, pdf, transmittance, mis_weight, contribution } => format!(
            "light   {light} towards {} pdf {pdf:.6} arrives {} weight {mis_weight:.6} adds {}",
            v(*wi),
            rgb(*transmittance),
            rgb(*contribution)
        ),
        PathEvent::Scatter { lobe, wi, pdf, weight } => {
            format!("scatter {lobe:?} towards {} pdf {pdf:.6} weight {}", v(*wi), rgb(*weight))
        }
        PathEvent::Roulette { survival, survived } => {
            format!("roulette survival {survival:.6}: {}", if *survived { "goes on" } else { "ends" })
        }
        PathEvent::Miss { dir, beta } => format!("miss    towards {} throughput {}", v(*dir), rgb(*beta)),
        PathEvent::End { reason } => format!("end     {reason}"),
    }
}
