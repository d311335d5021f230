//! What lies beneath the layers of [`super::layered`]: a mixture of metal, opaque dielectric and transmissive dielectric with fixed weights
//! (glTF 2.0 appendix B, KHR_materials_transmission, _volume, _ior, _specular).
//!
//! weight = metallic; (1 - metallic)(1 - transmission); (1 - metallic) transmission. One component is chosen, by its weight times an
//! estimate of its albedo; its smooth lobes are then weighted with the density of all components (one-sample model, Veach 1997, 9.2.4).

use super::compensation::Rough;
use super::dielectric::Dielectric;
use super::dielectric_base::DielectricBase;
use super::diffuse::Diffuse;
use super::interface::Interface;
use super::lambert::DiffuseSampling;
use super::metal::Metal;
use super::phong::Phong;
use super::thin::Thin;
use super::thin_film::ThinFilm;
use super::{BsdfParams, BsdfSample, GlossParams, TransportMode, unit_interval};
use crate::fresnel::f0_from_ior;
use crate::math::{ONE_MINUS_EPSILON, Vec3};
use crate::rgb::Spectrum;

/// Rays closer to the surface than this cosine do not scatter: half vectors would lose all digits.
pub(super) const MIN_COS: f32 = 1e-6;

/// Added to each component's albedo when choosing, so that none with weight is ever out of reach.
const ALBEDO_FLOOR: f32 = 0.05;

/// One term of the mixture.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Model {
    Metal(Metal),
    Base(DielectricBase),
    Gloss(Phong),
    Solid(Dielectric),
    Thin(Thin),
}

impl Model {
    #[inline]
    fn eval_pdf(&self, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Spectrum, f32) {
        match self {
            Model::Metal(m) => m.eval_pdf(wo, wi),
            Model::Base(m) => m.eval_pdf(wo, wi, mode),
            Model::Gloss(m) => m.eval_pdf(wo, wi, mode),
            Model::Solid(m) => m.eval_pdf(wo, wi, mode),
            Model::Thin(m) => m.eval_pdf(wo, wi),
        }
    }

    #[inline]
    fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2], mode: TransportMode) -> Option<BsdfSample> {
        match self {
            Model::Metal(m) => m.sample(wo, u_lobe, u),
            Model::Base(m) => m.sample(wo, u_lobe, u, mode),
            Model::Gloss(m) => m.sample(wo, u_lobe, u, mode),
            Model::Solid(m) => m.sample(wo, u_lobe, u, mode),
            Model::Thin(m) => m.sample(wo, u_lobe, u),
        }
    }

    #[inline]
    fn is_smooth_lobe(&self) -> bool {
        match self {
            Model::Metal(m) => m.is_smooth_lobe(),
            Model::Base(m) => m.is_smooth_lobe(),
            Model::Gloss(m) => m.is_smooth_lobe(),
            Model::Solid(m) => m.is_smooth_lobe(),
            Model::Thin(m) => m.is_smooth_lobe(),
        }
    }

    #[inline]
    fn albedo(&self) -> Spectrum {
        match self {
            Model::Metal(m) => m.albedo(),
            Model::Base(m) => m.albedo(),
            Model::Gloss(m) => m.albedo(),
            Model::Solid(m) => m.albedo(),
            Model::Thin(m) => m.albedo(),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Component {
    model: Model,
    /// Share of the mixture.
    weight: f32,
    /// Probability of being chosen.
    prob: f32,
}

/// A mixture of at most three models.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mixture {
    first: Component,
    others: [Option<Component>; 2],
}

impl Mixture {
    /// The surface with the given parameters.
    #[inline]
    pub fn new(params: &BsdfParams) -> Self {
        let base_color = params.base_color.map(unit_interval);
        let (metallic, transmission) = (unit_interval(params.metallic), unit_interval(params.transmission));
        let weights = [metallic, (1.0 - metallic) * (1.0 - transmission), (1.0 - metallic) * transmission];
        if weights[1] == 1.0 && params.is_plain_lambert() {
            return Mixture::lambert(base_color, params.diffuse_sampling);
        }
        let rough = Rough::new(params.roughness, params.anisotropy);
        // Most surfaces are of one kind.
        for (weight, term) in weights.into_iter().zip(TERMS) {
            if weight == 1.0 {
                return Mixture::single(term(params, base_color, rough));
            }
        }
        Mixture::mixed(params, weights, base_color, rough)
    }

    #[inline]
    fn single(model: Model) -> Self {
        Mixture { first: Component { model, weight: 1.0, prob: 1.0 }, others: [None; 2] }
    }

    /// Two or three terms.
    fn mixed(params: &BsdfParams, weights: [f32; 3], base_color: Spectrum, rough: Option<Rough>) -> Self {
        let mut terms =
            weights.into_iter().zip(TERMS).filter(|(weight, _)| *weight > 0.0).map(|(weight, term)| {
                let model = term(params, base_color, rough);
                Component { model, weight, prob: weight * (model.albedo().average() + ALBEDO_FLOOR) }
            });
        // The weights sum to 1, so at least one term exists.
        let first = terms.next().expect("weights sum to 1");
        let mut bsdf = Mixture { first, others: [terms.next(), terms.next()] };
        let sum: f32 = bsdf.components().map(|c| c.prob).sum();
        bsdf.first.prob /= sum;
        for c in bsdf.others.iter_mut().flatten() {
            c.prob /= sum;
        }
        bsdf
    }

    /// A Lambert surface; `albedo` in [0, 1].
    #[inline]
    pub fn lambert(albedo: Spectrum, sampling: DiffuseSampling) -> Self {
        Mixture::single(Model::Base(DielectricBase::lambert(albedo, sampling)))
    }

    #[inline]
    fn components(&self) -> impl Iterator<Item = &Component> {
        core::iter::once(&self.first).chain(self.others.iter().flatten())
    }

    #[inline]
    fn is_mixed(&self) -> bool {
        self.others[0].is_some()
    }

    /// f · |cos θi| and the density of `sample`, sr⁻¹, smooth lobes only.
    #[inline]
    pub fn eval_pdf(&self, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Spectrum, f32) {
        if wo.z < MIN_COS {
            return (Spectrum::BLACK, 0.0);
        }
        if !self.is_mixed() {
            return self.first.model.eval_pdf(wo, wi, mode);
        }
        self.components().fold((Spectrum::BLACK, 0.0), |(f, pdf), c| {
            let (f_c, pdf_c) = c.model.eval_pdf(wo, wi, mode);
            (f + f_c * c.weight, pdf + pdf_c * c.prob)
        })
    }

    /// Draws a direction. `None` when the path ends here: the light of that sample is 0.
    #[inline]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2], mode: TransportMode) -> Option<BsdfSample> {
        if wo.z < MIN_COS {
            return None;
        }
        if !self.is_mixed() {
            return self.first.model.sample(wo, u_lobe, u, mode);
        }
        // Choose a component and stretch the number that chose it over [0, 1) again.
        let mut chosen = &self.first;
        let mut below = 0.0;
        for c in self.others.iter().flatten() {
            if u_lobe < below + chosen.prob {
                break;
            }
            below += chosen.prob;
            chosen = c;
        }
        let u_lobe = ((u_lobe - below) / chosen.prob).clamp(0.0, ONE_MINUS_EPSILON);
        let sample = chosen.model.sample(wo, u_lobe, u, mode)?;
        if sample.lobe.is_delta() {
            let weight = sample.weight * (chosen.weight / chosen.prob);
            return Some(BsdfSample { weight, pdf: sample.pdf * chosen.prob, ..sample });
        }
        let (f, pdf) = self.eval_pdf(wo, sample.wi, mode);
        (pdf > 0.0).then(|| BsdfSample { weight: f / pdf, pdf, ..sample })
    }

    /// True for a plain Lambert surface: `sample` does not look at the number that chooses a lobe.
    #[inline]
    pub fn has_one_lobe(&self) -> bool {
        !self.is_mixed() && matches!(&self.first.model, Model::Base(base) if base.is_lambert())
    }

    /// False when every lobe is a delta: light sampling has nothing to find here.
    #[inline]
    pub fn has_smooth_lobes(&self) -> bool {
        self.components().any(|c| c.model.is_smooth_lobe())
    }

    /// Hemispherical albedo, approximately, in [0, 1]: a guide for denoisers.
    pub fn albedo(&self) -> Spectrum {
        self.components().fold(Spectrum::BLACK, |sum, c| sum + c.model.albedo() * c.weight).min(1.0)
    }

    /// What a smooth thin wall lets straight through at this cosine to the normal, for shadow rays; black for everything else.
    /// Exact: it is the weight of [`super::Lobe::ThinTransmission`].
    #[inline]
    pub fn thin_transmittance(&self, cos: f32) -> Spectrum {
        self.passing(|model| match model {
            Model::Thin(m) => m.transmittance(cos),
            _ => Spectrum::BLACK,
        })
    }

    /// What crosses the smooth boundary of a solid when refraction is ignored, for shadow rays that may pass straight; black for everything
    /// else. `cos` is taken in the thinner medium on both sides, so a parallel body counts Fresnel alike on entering and leaving.
    #[inline]
    pub fn straight_transmittance(&self, cos: f32) -> Spectrum {
        self.passing(|model| match model {
            Model::Solid(m) => m.straight_transmittance(cos),
            _ => Spectrum::BLACK,
        })
    }

    #[inline]
    fn passing(&self, f: impl Fn(&Model) -> Spectrum) -> Spectrum {
        self.components().fold(Spectrum::BLACK, |sum, c| sum + f(&c.model) * c.weight)
    }
}

/// Makes a term from the parameters, the clamped base colour and the interface.
type Term = fn(&BsdfParams, Spectrum, Option<Rough>) -> Model;

/// The terms of the mixture in the order of their weights.
const TERMS: [Term; 3] = [metal, base, transmissive];

#[inline]
fn metal(params: &BsdfParams, base_color: Spectrum, rough: Option<Rough>) -> Model {
    Model::Metal(Metal::new(base_color, film(params, base_color), rough))
}

#[inline]
fn base(params: &BsdfParams, base_color: Spectrum, rough: Option<Rough>) -> Model {
    let diffuse = Diffuse::new(params, base_color);
    if let Some(gloss) = &params.gloss {
        return phong(diffuse, gloss);
    }
    let specular = unit_interval(params.specular);
    let normal = f0_from_ior(params.ior);
    let f0 = params.specular_color.map(|c| unit_interval(normal * c));
    let interface = Interface::new(f0, specular, film(params, f0), rough);
    Model::Base(DielectricBase::new(diffuse, interface))
}

#[cold]
fn phong(diffuse: Diffuse, gloss: &GlossParams) -> Model {
    Model::Gloss(Phong::new(diffuse, gloss))
}

#[inline]
fn transmissive(params: &BsdfParams, base_color: Spectrum, rough: Option<Rough>) -> Model {
    if params.thin {
        Model::Thin(Thin::new(
            params.ior,
            film(params, Spectrum::splat(f0_from_ior(params.ior))),
            base_color,
            rough,
        ))
    } else {
        let eta_fresnel = params.eta_fresnel.unwrap_or(params.eta);
        let film = film(params, Spectrum::splat(f0_from_ior(eta_fresnel)));
        Model::Solid(Dielectric::new(params.eta, params.eta_fresnel, film, base_color, rough))
    }
}

/// The film over an interface that reflects `f0` at normal incidence.
#[inline]
fn film(params: &BsdfParams, f0: Spectrum) -> Option<ThinFilm> {
    params.film.as_ref().and_then(|film| ThinFilm::new(film, f0))
}
