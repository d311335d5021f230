//! The surface as integrators see it: the mixture of [`super::mixture`], sheen over it, varnish over both
//! (KHR_materials_sheen, KHR_materials_clearcoat).
//!
//! f = f_coat + Tc (f_sheen + Ts f_mixture), where T(ωo, ωi) = min(t(ωo), t(ωi)) and t = 1 - the layer's own directional albedo:
//! reciprocal, as Estevez and Kulla 2017 and KHR_materials_sheen have it. What lies beneath returns at most 1, so the whole returns at most
//! (1 - t) + t = 1 at any angle. Mirrors and straight passages beneath keep t exactly: their two angles are one. No symmetric factor that
//! is safe over every base is larger: a base may send all light of one direction into one other, and then the factor must not exceed t
//! of either. Diffuse bases pay for that, by the amount that t at one angle lies above its mean: white Lambert returns 0.953 at least under varnish
//! (seen from above; 1 at grazing angles), under white sheen 0.92 at roughness 0.3 and 0.855 at 0.7, its lowest (tested: testkit
//! `bsdf/layers`). The product t(ωo) t(ωi) over its mean is exact for Lambert, and gains light over anything else.
//!
//! Layers lie on both sides of thin walls and of opaque surfaces, on the outside of solids: inside, they do not reflect, and what crosses is
//! scaled by t at its outer direction. So the light that varnish turns back into a solid is lost: 3.4 % of what is inside clear glass of index
//! 1.5, 27 % where it leaves at the worst angle. A direction that leaves through the far side of a thin wall counts with the same
//! T; what the far layer turns back counts as passed. Left out: layers do not darken emission.

use super::coat::Coat;
use super::lambert::DiffuseSampling;
use super::mixture::{MIN_COS, Mixture};
use super::sheen::Sheen;
use super::{BsdfParams, BsdfSample, Lobe, TransportMode, unit_interval};
use crate::fresnel::schlick_weight;
use crate::math::{ONE_MINUS_EPSILON, Vec3, lerp};
use crate::rgb::Spectrum;

/// Added to the albedo of the mixture when choosing.
const ALBEDO_FLOOR: f32 = 0.05;

/// Scattering at one point. No allocation; made anew at each hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bsdf {
    mixture: Mixture,
    layers: Option<Layers>,
}

impl Bsdf {
    /// The surface with the given parameters.
    #[inline]
    pub fn new(params: &BsdfParams) -> Self {
        let mixture = Mixture::new(params);
        let layers = match (&params.coat, &params.sheen) {
            (None, None) => None,
            _ => Layers::new(params, &mixture),
        };
        Bsdf { mixture, layers }
    }

    /// A Lambert surface; `albedo` in [0, 1].
    #[inline]
    pub fn lambert(albedo: Spectrum, sampling: DiffuseSampling) -> Self {
        Bsdf { mixture: Mixture::lambert(albedo, sampling), layers: None }
    }

    /// f · |cos θi| and the density of `sample`, sr⁻¹, smooth lobes only.
    #[inline]
    pub fn eval_pdf(&self, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Spectrum, f32) {
        let beneath = self.mixture.eval_pdf(wo, wi, mode);
        match &self.layers {
            None => beneath,
            Some(_) if wo.z < MIN_COS || wi.z == 0.0 => (Spectrum::BLACK, 0.0),
            Some(layers) => layers.at(wo).eval_pdf(wi, beneath),
        }
    }

    /// f · |cos θi|, smooth lobes only.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3, mode: TransportMode) -> Spectrum {
        self.eval_pdf(wo, wi, mode).0
    }

    /// Density of `sample`, sr⁻¹, smooth lobes only. It integrates to 1 less the probabilities of delta lobes and of samples that end.
    #[inline]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.eval_pdf(wo, wi, TransportMode::Radiance).1
    }

    /// Draws a direction. `None` when the path ends here: the light of that sample is 0.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2], mode: TransportMode) -> Option<BsdfSample> {
        match &self.layers {
            None => self.mixture.sample(wo, u_lobe, u, mode),
            Some(_) if wo.z < MIN_COS => None,
            Some(layers) => layers.at(wo).sample(&self.mixture, u_lobe, u, mode),
        }
    }

    /// True for a plain Lambert surface: `sample` does not look at the number that chooses a lobe.
    #[inline]
    pub fn has_one_lobe(&self) -> bool {
        self.layers.is_none() && self.mixture.has_one_lobe()
    }

    /// False when every lobe is a delta: light sampling has nothing to find here.
    #[inline]
    pub fn has_smooth_lobes(&self) -> bool {
        self.mixture.has_smooth_lobes() || self.layers.as_ref().is_some_and(Layers::has_smooth_lobes)
    }

    /// Hemispherical albedo, approximately, in [0, 1]: a guide for denoisers.
    pub fn albedo(&self) -> Spectrum {
        let beneath = self.mixture.albedo();
        self.layers.as_ref().map_or(beneath, |layers| layers.albedo(beneath))
    }

    /// What a smooth thin wall lets straight through, for shadow rays; black for everything else. `wo.z > 0`.
    /// Exact: it is the weight of [`super::Lobe::ThinTransmission`].
    #[inline]
    pub fn thin_transmittance(&self, wo: Vec3) -> Spectrum {
        self.straight(wo, self.mixture.thin_transmittance(wo.z))
    }

    /// What crosses the smooth boundary of a solid when refraction is ignored, for shadow rays that may pass straight; black for everything
    /// else. `wo` is taken in the thinner medium on both sides, so a parallel body counts Fresnel alike on entering and leaving.
    #[inline]
    pub fn straight_transmittance(&self, wo: Vec3) -> Spectrum {
        self.straight(wo, self.mixture.straight_transmittance(wo.z))
    }

    #[inline]
    fn straight(&self, wo: Vec3, beneath: Spectrum) -> Spectrum {
        match &self.layers {
            Some(layers) if !beneath.is_black() => {
                let t = layers.at(wo);
                beneath * t.passed(-wo)
            }
            _ => beneath,
        }
    }
}

/// What lies over the mixture.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Layers {
    coat: Option<Coat>,
    sheen: Option<Sheen>,
    /// The side of `wo` has them.
    here: bool,
    /// The other side has them.
    beyond: bool,
    /// Hemispherical albedo of the mixture, mean over the bands.
    mixture_mean: f32,
}

impl Layers {
    /// `None` when no layer has any strength.
    fn new(params: &BsdfParams, mixture: &Mixture) -> Option<Self> {
        let coat = params.coat.filter(|c| c.factor > 0.0);
        let coat = coat.map(|c| Coat::new(unit_interval(c.factor), c.roughness, c.normal));
        let sheen = params.sheen.map(|s| (s.color.map(unit_interval), s.roughness));
        let sheen = sheen.filter(|(color, _)| !color.is_black()).map(|(c, r)| Sheen::new(c, r));
        let solid = !params.thin;
        (coat.is_some() || sheen.is_some()).then(|| Layers {
            coat,
            sheen,
            here: !(solid && params.inside),
            beyond: !solid || params.inside,
            mixture_mean: mixture.albedo().average(),
        })
    }

    #[inline]
    fn has_smooth_lobes(&self) -> bool {
        self.here && (self.sheen.is_some() || self.coat.as_ref().is_some_and(Coat::is_smooth_lobe))
    }

    fn albedo(&self, beneath: Spectrum) -> Spectrum {
        if !self.here {
            return beneath;
        }
        let sheen = self.sheen.as_ref();
        let covered = sheen.map_or(beneath, |s| s.albedo() + beneath * s.passed(s.average()));
        let coat = self.coat.as_ref().map_or(0.0, Coat::albedo);
        (covered * (1.0 - coat) + Spectrum::splat(coat)).min(1.0)
    }

    /// Shares of the light of `w` that pass the coat, and the albedo of the sheen; 1 and 0 on a side without layers.
    #[inline]
    fn toward(&self, w: Vec3) -> Toward {
        let covered = if w.z > 0.0 { self.here } else { self.beyond };
        let (mut coat, mut sheen) = (1.0, 0.0);
        if covered {
            coat = self.coat.as_ref().map_or(1.0, |c| c.passed(w));
            sheen = self.sheen.as_ref().map_or(0.0, |s| s.directional(w.z.abs().min(1.0)));
        }
        Toward { coat, sheen }
    }

    /// The layers seen from `wo`, with the probabilities of choosing them: by the light that they return, about.
    #[inline]
    fn at(&self, wo: Vec3) -> View<'_> {
        let o = self.toward(wo);
        let (mut sheen, mut beneath) = (0.0, o.coat);
        if let Some(s) = self.sheen.as_ref().filter(|_| self.here) {
            sheen = o.coat * s.importance(o.sheen);
            beneath *= s.passed(o.sheen);
        }
        // Whatever lies beneath may turn into a mirror at grazing angles.
        beneath *= lerp(self.mixture_mean, 1.0, schlick_weight(wo.z)) + ALBEDO_FLOOR;
        let coat = 1.0 - o.coat;
        let scale = 1.0 / (coat + sheen + beneath);
        View {
            layers: self,
            wo,
            o,
            prob_coat: coat * scale,
            prob_sheen: sheen * scale,
            prob_mixture: beneath * scale,
        }
    }
}

/// What the layers do to the light of one direction.
#[derive(Clone, Copy, Debug)]
struct Toward {
    /// Share that passes the coat.
    coat: f32,
    /// Albedo of the sheen, colour left out.
    sheen: f32,
}

/// The layers seen from one direction.
#[derive(Clone, Copy, Debug)]
struct View<'a> {
    layers: &'a Layers,
    wo: Vec3,
    o: Toward,
    prob_coat: f32,
    prob_sheen: f32,
    prob_mixture: f32,
}

impl View<'_> {
    /// T for the coat alone and for coat and sheen, between `wo` and `wi`.
    #[inline]
    fn passed_each(&self, wi: Vec3) -> (f32, f32) {
        let i = self.layers.toward(wi);
        let coat = self.o.coat.min(i.coat);
        let sheen = self.layers.sheen.as_ref().map_or(1.0, |s| s.passed(self.o.sheen.max(i.sheen)));
        (coat, coat * sheen)
    }

    #[inline]
    fn passed(&self, wi: Vec3) -> f32 {
        self.passed_each(wi).1
    }

    /// Everything together, given value and density of the mixture.
    #[inline]
    fn eval_pdf(&self, wi: Vec3, (f, pdf): (Spectrum, f32)) -> (Spectrum, f32) {
        let (coat_passed, passed) = self.passed_each(wi);
        let (mut f, mut pdf) = (f * passed, pdf * self.prob_mixture);
        if wi.z > 0.0 && self.layers.here {
            if let Some(sheen) = &self.layers.sheen {
                f += sheen.eval(self.wo, wi) * coat_passed;
                pdf += sheen.pdf(self.wo, wi) * self.prob_sheen;
            }
            if let Some(coat) = &self.layers.coat {
                let (f_coat, pdf_coat) = coat.eval_pdf(self.wo, wi);
                f += Spectrum::splat(f_coat);
                pdf += pdf_coat * self.prob_coat;
            }
        }
        (f, pdf)
    }

    fn sample(&self, mixture: &Mixture, u_lobe: f32, u: [f32; 2], mode: TransportMode) -> Option<BsdfSample> {
        let below = self.prob_coat + self.prob_sheen;
        let stretched = |u: f32| u.clamp(0.0, ONE_MINUS_EPSILON);
        let (sample, prob, passed) = if u_lobe < self.prob_coat {
            (self.layers.coat.as_ref()?.sample(self.wo, u)?, self.prob_coat, 1.0)
        } else if u_lobe < below {
            let wi = self.layers.sheen.as_ref()?.sample(self.wo, u);
            let sample = BsdfSample::new(wi, Spectrum::BLACK, 0.0, Lobe::DiffuseReflection);
            (sample, self.prob_sheen, 1.0)
        } else {
            let u_lobe = stretched((u_lobe - below) / self.prob_mixture);
            let sample = mixture.sample(self.wo, u_lobe, u, mode)?;
            (sample, self.prob_mixture, self.passed(sample.wi))
        };
        if sample.lobe.is_delta() {
            let weight = sample.weight * (passed / prob);
            return Some(BsdfSample { weight, pdf: sample.pdf * prob, ..sample });
        }
        if sample.wi.z == 0.0 {
            return None;
        }
        let (f, pdf) = self.eval_pdf(sample.wi, mixture.eval_pdf(self.wo, sample.wi, mode));
        (pdf > 0.0).then(|| BsdfSample { weight: f / pdf, pdf, ..sample })
    }
}
