//! The path tracer: radiance along a camera ray, by next-event estimation and scattering, joined by multiple importance
//! sampling. Kajiya 1986; Veach 1997. An iterative loop, never recursion; the shader twin takes the same named steps in the
//! same order.

use crate::catcher::Catcher;
use crate::interaction::Interaction;
use crate::light_sampling::{LightSample, pdf_environment, pdf_sun, pdf_triangle, sample_light, sun};
use crate::observer::{PathEvent, PathObserver};
use crate::shadow::{Arriving, ShadowRay};
use crate::surface::{Hue, Surface, emission, index_at};
use crate::tracer::{CoverageKey, Tracer};
use glam::Vec3;
use lumbre_core::bsdf::{BsdfSample, Lobe, TransportMode};
use lumbre_core::color::label;
use lumbre_core::film::{FilmSample, FirstHit};
use lumbre_core::medium::MediumStack;
use lumbre_core::mis::power_heuristic;
use lumbre_core::sampler::Sampler;
use lumbre_core::settings::{RenderSettings, TransmissiveShadows};
use lumbre_core::wavelength::Wavelength;
use lumbre_core::{Ray, Spectrum};
use lumbre_scene::compiled::NONE;
use lumbre_scene::compiled::lights::LightGroup;
use lumbre_scene::compiled::material::flag;

/// Largest probability of surviving roulette: a path without absorption ends some day too.
const MAX_SURVIVAL: f32 = 0.95;

/// Most shadow catchers that one path passes; a further one is met as the plain surface that it is.
const MOST_CATCHERS: u32 = 64;

/// A group whose light is below this share of both groups', shadows left out, is not asked for at every vertex.
const FAINT: f32 = 0.05;
/// But with this probability at least: an unshadowed share may mislead.
const LEAST_ASKED: f32 = 0.1;

/// Light that arrives at a surface if nothing is in its way.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    light: LightSample,
    /// It comes from the side that the surface reflects to.
    reflects: bool,
    /// What the surface makes of it, over its density.
    unshadowed: Spectrum,
    /// Density of scattering there, sr⁻¹.
    pdf_bsdf: f32,
}

/// How the current ray came about: what light it meets must be weighed against.
#[derive(Clone, Copy, Debug)]
struct Arrival {
    /// The last vertex that scattered (thin walls passed straight do not count).
    p: Vec3,
    /// Density of the direction there, sr⁻¹; `None` where light sampling could not have found the light (camera, delta lobes).
    pdf: Option<f32>,
    /// Since a vertex with a density, the path has done nothing but refract through smooth solids.
    through_solid: bool,
}

/// A path under way.
struct Path<'a, 't, O> {
    tracer: &'a Tracer<'t>,
    sampler: &'a Sampler,
    observer: &'a mut O,
    ray: Ray,
    radiance: Spectrum,
    /// Throughput.
    beta: Spectrum,
    /// Radiance scaling by refraction that is part of `beta`.
    eta_scale: f32,
    media: MediumStack,
    /// The wavelength that it has taken, nm, once it needed one.
    wavelength: Option<f32>,
    arrival: Arrival,
    /// So far it has only met delta lobes: what it finds is seen, not lit by.
    seen_by_camera: bool,
    /// So far it is a straight line from the camera.
    straight: bool,
    /// Shadow catchers that it has passed.
    caught: u32,
    /// Length of the rays up to the last of these, metres.
    travelled: f32,
    /// How much the background is covered.
    alpha: f32,
    /// Scattering events so far.
    depth: u32,
    max_depth: u32,
    /// Of them those at lobes that are not delta lobes.
    rough: u32,
    max_rough: u32,
}

/// Radiance along a camera ray that starts inside `media`.
pub fn radiance<O: PathObserver>(
    tracer: &Tracer<'_>,
    ray: Ray,
    media: MediumStack,
    sampler: &Sampler,
    observer: &mut O,
) -> FilmSample {
    observer.event(PathEvent::Camera { ray: &ray });
    let arrival = Arrival { p: ray.origin, pdf: None, through_solid: false };
    let mut path = Path {
        tracer,
        sampler,
        observer,
        ray,
        radiance: Spectrum::BLACK,
        beta: Spectrum::WHITE,
        eta_scale: 1.0,
        media,
        wavelength: None,
        arrival,
        seen_by_camera: true,
        straight: true,
        caught: 0,
        travelled: 0.0,
        alpha: 1.0,
        depth: 0,
        max_depth: tracer.settings.max_depth.unwrap_or(RenderSettings::DEPTH_BOUND),
        rough: 0,
        max_rough: tracer.settings.rough_bounces.unwrap_or(u32::MAX),
    };
    path.begin_inside();
    let first_hit = path.run();
    FilmSample { radiance: path.radiance, first_hit, alpha: path.alpha }
}

impl<O: PathObserver> Path<'_, '_, O> {
    /// Takes a wavelength at once where the camera stands in a medium that disperses.
    fn begin_inside(&mut self) {
        let scene = self.tracer.scene;
        let material = |id: u32| &scene.materials[id as usize];
        if !self.media.iter_mut().any(|m| material(m.material).has(flag::DISPERSION)) {
            return;
        }
        let wavelength = Wavelength::sample(self.sampler.wavelength());
        self.take(&wavelength);
        for m in self.media.iter_mut() {
            m.ior = index_at(scene, material(m.material), wavelength.nm);
        }
    }

    /// From here on the path carries one wavelength.
    fn take(&mut self, wavelength: &Wavelength) {
        self.beta *= wavelength.weight;
        self.wavelength = Some(wavelength.nm);
        self.observer.event(PathEvent::Wavelength { nm: wavelength.nm, weight: wavelength.weight });
    }

    fn run(&mut self) -> Option<FirstHit> {
        let mut first_hit = None;
        loop {
            // Find the closest surface.
            let key = CoverageKey::path(self.sampler.coverage_key(), self.depth);
            let it = match self.depth {
                0 => self.tracer.closest_hit_camera(&self.ray, key),
                _ => self.tracer.closest_hit(&self.ray, key),
            };
            let Some(it) = it else {
                self.add_sky();
                return first_hit;
            };
            // Absorb on the way to it.
            self.beta *= self.media.current().transmittance(it.t);
            // A catcher shows the camera what lies behind it.
            if self.passes_catcher(&it) {
                if self.beta.is_black() {
                    return self.end("in shadow", first_hit);
                }
                continue;
            }
            // Build the surface.
            let wo = -self.ray.dir;
            let diffuse = self.tracer.settings.diffuse_sampling;
            let hue = self.wavelength.map_or(Hue::All(self.sampler), Hue::One);
            let surface = Surface::new(self.tracer.scene, &it, wo, &self.media, hue, diffuse);
            if let Some(takes) = surface.takes.filter(|t| t.on_arrival) {
                self.take(&takes.wavelength);
            }
            self.observer.event(PathEvent::Hit { it: &it, ns: surface.frame.n, beta: self.beta });
            if self.depth == 0 {
                let planes = first_hit_planes(&it, &surface, self.travelled);
                let albedo =
                    if self.tracer.settings.object_colors { label(it.instance) } else { planes.albedo };
                first_hit = Some(FirstHit { albedo, ..planes });
            }
            // Add what it emits.
            if self.add_emission(&it, &surface) {
                return first_hit;
            }
            if self.depth >= self.max_depth {
                return self.end("the path is as long as it may be", first_hit);
            }
            // Sample one light of each group.
            let wo_local = surface.frame.to_local(wo);
            let lit = self.tracer.settings.light_sampling && self.rough <= self.max_rough;
            if lit && surface.bsdf.has_smooth_lobes() {
                self.add_lights(&it, &surface, wo_local);
            }
            // Sample the BSDF.
            let lobe = if surface.bsdf.has_one_lobe() { 0.0 } else { self.sampler.lobe(self.depth) };
            let direction = self.sampler.direction(self.depth);
            let Some(s) = surface.bsdf.sample(wo_local, lobe, direction, TransportMode::Radiance) else {
                return self.end("the surface absorbs", first_hit);
            };
            if !s.lobe.is_delta() && self.rough > self.max_rough {
                return self.end("rough surfaces scattered as often as they may", first_hit);
            }
            let wi = surface.frame.to_world(s.wi).normalize();
            self.observer.event(PathEvent::Scatter { lobe: s.lobe, wi, pdf: s.pdf, weight: s.weight });
            // Interpolated normals: directions on the wrong side of the triangle carry nothing.
            if (wi.dot(surface.ng) > 0.0) == s.lobe.is_transmission() {
                return self.end("the direction lies on the wrong side of the geometric normal", first_hit);
            }
            self.step(&it, &surface, &s, wi);
            // Play roulette.
            if self.beta.is_black() || !self.survives() {
                return self.end("absorbed", first_hit);
            }
        }
    }

    /// True when the surface is a shadow catcher seen straight from the camera: the path has then moved on behind it.
    #[inline]
    fn passes_catcher(&mut self, it: &Interaction) -> bool {
        if !self.straight {
            return false;
        }
        let material = &self.tracer.scene.materials[it.material as usize];
        if !material.has(flag::SHADOW_CATCHER) || self.caught == MOST_CATCHERS {
            return false;
        }
        self.pass_catcher(it);
        true
    }

    #[cold]
    fn pass_catcher(&mut self, it: &Interaction) {
        let catcher = Catcher {
            it,
            passed: self.caught,
            media: self.media,
            wavelength: self.wavelength,
            depth: self.depth,
            time: self.ray.time,
        };
        let caught = self.tracer.catch(&catcher, self.sampler);
        self.observer.event(PathEvent::Caught { it, share: caught.share, rays: caught.rays });
        self.beta *= caught.share;
        self.caught += 1;
        self.travelled += it.t;
        self.ray = Ray::new(it.leave(self.ray.dir), self.ray.dir, self.ray.time);
    }

    fn end(&mut self, reason: &'static str, first_hit: Option<FirstHit>) -> Option<FirstHit> {
        self.observer.event(PathEvent::End { reason });
        first_hit
    }

    /// Adds light met by the path itself.
    fn add(&mut self, source: &'static str, radiance: Spectrum, mis_weight: f32) {
        let contribution = self.clamped(self.beta * radiance * mis_weight, self.depth);
        self.radiance += contribution;
        self.observer.event(PathEvent::Emission { source, radiance, mis_weight, contribution });
    }

    /// Light that scattered this many times on its way to the camera, within the bound that the settings set.
    fn clamped(&self, contribution: Spectrum, scattered: u32) -> Spectrum {
        let Some(most) = self.tracer.settings.clamp.filter(|_| scattered > 1) else { return contribution };
        let largest = contribution.max_component();
        if largest > most { contribution * (most / largest) } else { contribution }
    }

    /// Weight of light met by scattering, whose direction light sampling draws with density `pdf_light`.
    fn mis_weight(&self, pdf_light: impl FnOnce() -> f32) -> f32 {
        match self.arrival.pdf {
            Some(pdf) if self.tracer.settings.light_sampling => power_heuristic(pdf, pdf_light()),
            _ => 1.0,
        }
    }

    /// True when shadow rays have already brought this light straight through the solid that the path refracted through.
    fn counted_by_straight_shadows(&self, mode: TransmissiveShadows) -> bool {
        self.tracer.settings.light_sampling
            && self.arrival.through_solid
            && self.tracer.settings.transmissive_shadows == mode
    }

    /// Adds the emission of a surface; true when the path ends there.
    fn add_emission(&mut self, it: &Interaction, surface: &Surface) -> bool {
        let scene = self.tracer.scene;
        let material = &scene.materials[it.material as usize];
        if material.has(flag::UNLIT) {
            // It shows itself, directly and in mirrors and panes, and lights nothing.
            if self.seen_by_camera {
                self.add("unlit surface", surface.base_color, 1.0);
            }
            return true;
        }
        let radiance = emission(scene, material, &it.uv, it.front);
        if radiance.is_black() || self.counted_by_straight_shadows(TransmissiveShadows::Straight) {
            return false;
        }
        let instance = &scene.instances[it.instance as usize];
        let rank = scene.meshes[instance.mesh as usize].emissive_rank(&scene.emissive_ranks, it.triangle);
        let (from, dir) = (self.arrival.p, self.ray.dir);
        let weight = self.mis_weight(|| match rank {
            Some(rank) if instance.first_light != NONE => {
                pdf_triangle(scene, instance.first_light + rank, dir, (it.p - from).length_squared())
            }
            _ => 0.0,
        });
        self.add("emissive surface", radiance, weight);
        false
    }

    /// Adds sun and environment to a ray that left the scene.
    fn add_sky(&mut self) {
        let scene = self.tracer.scene;
        let dir = self.ray.dir;
        self.beta *= self.media.current().transmittance(f32::INFINITY);
        self.observer.event(PathEvent::Miss { dir, beta: self.beta });
        if self.straight {
            // Its mean is right though a throughput may exceed 1 where a pane chose to transmit.
            self.alpha = 1.0 - self.beta.luminance();
            if self.tracer.settings.transparent_background {
                return;
            }
        }
        let straight = self.counted_by_straight_shadows(TransmissiveShadows::Straight);
        let straight_sun = straight || self.counted_by_straight_shadows(TransmissiveShadows::Auto);
        if scene.sun.light != NONE && !straight_sun && sun(scene).contains(dir) {
            let weight = self.mis_weight(|| pdf_sun(scene, dir));
            self.add("sun", scene.sun.radiance, weight);
        }
        if scene.environment.light != NONE && !straight {
            let radiance = scene.environment_light().radiance(dir);
            let weight = self.mis_weight(|| pdf_environment(scene, dir));
            self.add("environment", radiance, weight);
        }
    }

    /// Next-event estimation: a light of each group. Where there are both, the one that would give much less even without
    /// any shadow is asked for now and then only.
    fn add_lights(&mut self, it: &Interaction, surface: &Surface, wo_local: Vec3) {
        let scene = self.tracer.scene;
        let point = self.sampler.light_point(self.depth);
        let [near, far] = [LightGroup::Near, LightGroup::Far].map(|g| scene.has_lights(g));
        if !(near && far) {
            let group = if near { LightGroup::Near } else { LightGroup::Far };
            if let Some(candidate) = self.candidate(it, surface, wo_local, (group, point)) {
                self.add_light(it, surface, &candidate, 1.0);
            }
            return;
        }
        let second = self.sampler.second_light_point(self.depth);
        let pair = [(LightGroup::Far, point), (LightGroup::Near, second)]
            .map(|from| self.candidate(it, surface, wo_local, from));
        let both: f32 = pair.iter().flatten().map(|c| c.unshadowed.average()).sum();
        for candidate in pair.iter().flatten() {
            let share = candidate.unshadowed.average() / (FAINT * both);
            // Both cannot be faint, so one number serves.
            let prob = if share < 1.0 { share.max(LEAST_ASKED) } else { 1.0 };
            if prob >= 1.0 || self.sampler.light_roulette(self.depth) < prob {
                self.add_light(it, surface, candidate, prob);
            }
        }
    }

    /// A light sample with what the surface makes of it; `None` where that is nothing.
    #[inline]
    fn candidate(
        &self,
        it: &Interaction,
        surface: &Surface,
        wo_local: Vec3,
        (group, point): (LightGroup, [f32; 2]),
    ) -> Option<Candidate> {
        let light = sample_light(self.tracer.scene, group, it.p, point, || self.sampler.light(self.depth))?;
        let wi_local = surface.frame.to_local(light.wi);
        // Reflection and transmission are told apart by the shading normal; the geometric one must agree.
        let reflects = light.wi.dot(surface.ng) > 0.0;
        if reflects != (wi_local.z > 0.0) {
            return None;
        }
        let (mut f, pdf_bsdf) = surface.bsdf.eval_pdf(wo_local, wi_local, TransportMode::Radiance);
        if f.is_black() {
            return None;
        }
        // Light that crosses here into a solid that disperses has the wavelength that the path would take.
        if let Some(takes) = surface.takes.filter(|t| !reflects && !t.on_arrival) {
            f *= takes.wavelength.weight;
        }
        let unshadowed = f * light.radiance / light.pdf;
        Some(Candidate { light, reflects, unshadowed, pdf_bsdf })
    }

    /// Adds what arrives of a light sample that is asked for with probability `prob`.
    #[inline]
    fn add_light(&mut self, it: &Interaction, surface: &Surface, candidate: &Candidate, prob: f32) {
        let &Candidate { ref light, reflects, unshadowed, pdf_bsdf } = candidate;
        let Arriving { share: transmittance, through_solid } =
            self.light_transmittance(it, surface, light, reflects);
        // Scattered rays do not find this light, or leave it out.
        let alone = light.is_delta || through_solid;
        let mis_weight = if alone { 1.0 } else { power_heuristic(light.pdf, pdf_bsdf) };
        let contribution = self.beta * unshadowed * transmittance * mis_weight;
        let contribution = self.clamped(contribution, self.depth + 1) * (1.0 / prob);
        self.radiance += contribution;
        self.observer.event(PathEvent::Light {
            light: light.light,
            wi: light.wi,
            pdf: light.pdf * prob,
            transmittance,
            mis_weight,
            contribution,
        });
    }

    /// Traces the shadow ray.
    fn light_transmittance(
        &self,
        it: &Interaction,
        surface: &Surface,
        light: &LightSample,
        reflects: bool,
    ) -> Arriving {
        let mut media = self.media;
        let mut wavelength = self.wavelength;
        if let Some(beyond) = surface.beyond.filter(|_| !reflects) {
            media.cross(beyond, it.material, it.front);
            wavelength = wavelength.or(surface.takes.map(|t| t.wavelength.nm));
        }
        let time = self.ray.time;
        let shadow = ShadowRay { time, wavelength, ..self.tracer.shadow_ray(it, light, media, self.depth) };
        let key = CoverageKey::shadow(self.sampler.coverage_key(), self.depth);
        self.tracer.transmittance(&shadow, key)
    }

    /// Moves on along the sampled direction.
    fn step(&mut self, it: &Interaction, surface: &Surface, s: &BsdfSample, wi: Vec3) {
        if let Some(takes) = surface.takes.filter(|t| s.lobe.is_transmission() && !t.on_arrival) {
            self.take(&takes.wavelength);
        }
        self.straight &= s.lobe == Lobe::ThinTransmission;
        self.beta *= s.weight;
        self.eta_scale *= s.eta_scale;
        self.depth += 1;
        self.ray = Ray::new(it.leave(wi), wi, self.ray.time);
        if let Some(beyond) = surface.beyond.filter(|_| s.lobe.is_transmission()) {
            self.media.cross(beyond, it.material, it.front);
        }
        match s.lobe {
            // The direction did not change: to light sampling the last vertex still sees what comes.
            Lobe::ThinTransmission => {}
            Lobe::SpecularTransmission => {
                let through_solid = self.arrival.through_solid || self.arrival.pdf.is_some();
                self.arrival = Arrival { p: it.p, pdf: None, through_solid };
            }
            Lobe::SpecularReflection => self.arrival = Arrival { p: it.p, pdf: None, through_solid: false },
            _ => {
                self.arrival = Arrival { p: it.p, pdf: Some(s.pdf), through_solid: false };
                self.seen_by_camera = false;
                self.rough += 1;
            }
        }
    }

    /// Russian roulette on the throughput, without the scaling that refraction will undo.
    fn survives(&mut self) -> bool {
        let Some(first) = self.tracer.settings.roulette else { return true };
        if self.depth < first {
            return true;
        }
        let survival = (self.beta.max_component() / self.eta_scale).min(MAX_SURVIVAL);
        // The event has been counted already.
        let survived = self.sampler.roulette(self.depth - 1) < survival;
        self.observer.event(PathEvent::Roulette { survival, survived });
        if survived {
            self.beta *= 1.0 / survival;
        }
        survived
    }
}

/// The planes of the first surface, met after `travelled` metres of ray before the one that found it.
fn first_hit_planes(it: &Interaction, surface: &Surface, travelled: f32) -> FirstHit {
    FirstHit {
        albedo: surface.bsdf.albedo(),
        normal: surface.frame.n.to_array(),
        position: it.p.to_array(),
        depth: travelled + it.t,
    }
}
