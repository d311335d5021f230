//! Shadow catchers: surfaces that show the camera what lies behind them, darkened by the shadows that fall on them.
//!
//! What a catcher leaves of the light behind it is, in each band, D/U: the direct light that arrives at it over the direct light that would
//! arrive without anything in the way, both weighted as a white Lambert surface weighs them. U has no closed form, so the share is estimated
//! by resampling (Talbot, Cline and Egbert 2005): of [`CANDIDATES`] light samples one is drawn in proportion to its unshadowed contribution,
//! and what arrives of its light is the share. Bands share the number that draws, so that lights of one colour need one shadow ray, and where
//! nothing or everything is in shadow there is no noise at all.
//!
//! Its expectation is that of Σ V c / Σ c over the candidates c, a ratio of two means of a finite number, hence biased by the order of
//! the variance of those means; candidates of a sample are stratified together, which makes that small. With Sobol numbers the share of a sky of which a
//! cap is hidden is off by less than 0.003 (tested: testkit `proofs/catcher`), and it is exact where all lights contribute alike. More samples do not
//! take it away. Light that passes solid glass bent is not counted: see the table of shadow rays in the conventions.

use crate::interaction::Interaction;
use crate::light_sampling::{LightSample, sample_light};
use crate::shadow::ShadowRay;
use crate::tracer::{CoverageKey, Tracer};
use lumbre_core::Spectrum;
use lumbre_core::medium::MediumStack;
use lumbre_core::sampler::Sampler;
use lumbre_scene::compiled::lights::LightGroup;

/// Light samples of which one is asked whether it arrives; a power of two.
const CANDIDATES: u32 = 16;

/// Stream of the candidates at the `passed`-th catcher; the one after it draws among them.
fn streams(passed: u32) -> [u32; 2] {
    [2 * passed, 2 * passed + 1]
}

/// A light sample and what it would contribute without shadow.
type Candidate = (Spectrum, LightSample);

/// What a catcher leaves of the light behind it.
pub(crate) struct Caught {
    /// Its share, per band.
    pub(crate) share: Spectrum,
    /// Shadow rays traced.
    pub(crate) rays: u32,
}

/// A catcher as a camera ray meets it.
pub(crate) struct Catcher<'a> {
    pub(crate) it: &'a Interaction,
    /// Catchers that this path has passed before.
    pub(crate) passed: u32,
    pub(crate) media: MediumStack,
    pub(crate) wavelength: Option<f32>,
    /// Scattering events of the path so far.
    pub(crate) depth: u32,
    /// Moment in the shutter interval.
    pub(crate) time: f32,
}

impl Tracer<'_> {
    /// The share of direct light that arrives at a catcher, on the side of the camera.
    #[cold]
    pub(crate) fn catch(&self, catcher: &Catcher<'_>, sampler: &Sampler) -> Caught {
        let candidates = self.candidates(catcher, sampler);
        let total = candidates.iter().flatten().fold(Spectrum::BLACK, |sum, (c, _)| sum + *c);
        if total.is_black() {
            // No light that could be in shadow.
            return Caught { share: Spectrum::WHITE, rays: 0 };
        }
        let [_, draws] = streams(catcher.passed);
        let u = sampler.split(draws, 1, 0).lobe(0);
        let mut last: Option<(u32, Spectrum)> = None;
        let mut rays = 0;
        let share = [0, 1, 2].map(|band| {
            // A band without any light follows the brightest.
            let weight = |c: &Spectrum| if total[band] > 0.0 { c[band] } else { c.max_component() };
            let chosen = choose(&candidates, u, weight);
            let arrives = match last {
                Some((at, arrives)) if at == chosen => arrives,
                _ => {
                    rays += 1;
                    candidates[chosen as usize]
                        .as_ref()
                        .map_or(Spectrum::BLACK, |(_, light)| self.arriving(catcher, light, sampler))
                }
            };
            last = Some((chosen, arrives));
            arrives[band]
        });
        Caught { share: Spectrum::from_array(share), rays }
    }

    fn candidates(
        &self,
        catcher: &Catcher<'_>,
        sampler: &Sampler,
    ) -> [Option<Candidate>; CANDIDATES as usize] {
        let it = catcher.it;
        let side = if it.front { 1.0 } else { -1.0 };
        let [stream, _] = streams(catcher.passed);
        // Half of them from each group, where both have lights; all are then as many to their group.
        let [near, far] = [LightGroup::Near, LightGroup::Far].map(|g| self.scene.has_lights(g));
        let group = |part| match (near, far) {
            (true, true) if part < CANDIDATES / 2 => LightGroup::Near,
            (true, false) => LightGroup::Near,
            _ => LightGroup::Far,
        };
        core::array::from_fn(|part| {
            let numbers = sampler.split(stream, CANDIDATES, part as u32);
            let light = sample_light(self.scene, group(part as u32), it.p, numbers.light_point(0), || {
                numbers.light(0)
            })?;
            let (cos, cos_g) = (side * it.ns.dot(light.wi), side * it.ng.dot(light.wi));
            (cos > 0.0 && cos_g > 0.0).then(|| (light.radiance * (cos / light.pdf), light))
        })
    }

    fn arriving(&self, catcher: &Catcher<'_>, light: &LightSample, sampler: &Sampler) -> Spectrum {
        let Catcher { it, media, wavelength, depth, time, .. } = *catcher;
        let shadow = ShadowRay { time, wavelength, ..self.shadow_ray(it, light, media, depth) };
        let key = CoverageKey::catcher(sampler.coverage_key(), catcher.depth, catcher.passed);
        self.transmittance(&shadow, key).share
    }
}

/// Index of the candidate that `u` draws in proportion to `weight`.
fn choose(candidates: &[Option<Candidate>], u: f32, weight: impl Fn(&Spectrum) -> f32) -> u32 {
    let weights = || candidates.iter().map(|c| c.as_ref().map_or(0.0, |(c, _)| weight(c)));
    let mut left = u * weights().sum::<f32>();
    let mut chosen = 0;
    for (i, w) in weights().enumerate().filter(|(_, w)| *w > 0.0) {
        chosen = i as u32;
        left -= w;
        if left < 0.0 {
            break;
        }
    }
    chosen
}
