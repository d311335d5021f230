//! The diffuse base: what comes back after wandering inside, Lambert or rough ([`super::oren_nayar`]), and the share that leaves on the other
//! side (KHR_materials_diffuse_transmission).
//!
//! The share t of the transmission replaces (1 - t) of the reflection, as the extension mixes them: f = (1 - t) ρ/π on the side of the
//! ray, t c/π on the other, the same in all directions. A thin sheet is alike on both sides, so this is reciprocal, and it keeps at most the
//! larger of ρ and c.
//!
//! At the boundary of a solid t is the share that enters the denser medium. Of what comes back from there only t/eta² leaves, eta the ratio of the indices, since
//! the same directions outside correspond to eta² times as many inside (Veach 1997, 5.2): the rest stays in, as total reflection would have it. Radiance that crosses
//! is scaled by 1/eta² as at a clear boundary ([`super::dielectric`]); so it is reciprocal, and a white solid is invisible in a furnace.
//! Left out: scattering inside a solid; what enters it is absorbed along straight lines only.

use super::lambert::{self, DiffuseSampling};
use super::{BsdfParams, Lobe, TransportMode, oren_nayar, unit_interval};
use crate::math::{ONE_MINUS_EPSILON, Vec3};
use crate::rgb::Spectrum;

/// A diffuse base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diffuse {
    /// Albedo ρ of the reflecting part.
    rho: Spectrum,
    /// What leaves on the other side: t c.
    transmitted: Spectrum,
    /// 1 - t.
    reflecting: f32,
    /// 0 is Lambert.
    roughness: f32,
    /// Scale of radiance that crosses: 1/eta².
    crossing: f32,
    sampling: DiffuseSampling,
    /// Neither rough nor transmitting: Lambert's, and nothing above but ρ and the sampling is read.
    plain: bool,
}

impl Diffuse {
    /// The base of a material whose clamped base colour is `rho`.
    #[inline]
    pub fn new(params: &BsdfParams, rho: Spectrum) -> Self {
        if params.diffuse_roughness <= 0.0 && params.diffuse_transmission <= 0.0 {
            return Diffuse::lambert(rho, params.diffuse_sampling);
        }
        Diffuse::general(params, rho)
    }

    #[cold]
    fn general(params: &BsdfParams, rho: Spectrum) -> Self {
        let eta2 = if params.thin { 1.0 } else { params.eta * params.eta };
        let share = unit_interval(params.diffuse_transmission) * eta2.min(1.0);
        Diffuse {
            rho,
            transmitted: params.diffuse_transmission_color.map(unit_interval) * share,
            reflecting: 1.0 - share,
            roughness: unit_interval(params.diffuse_roughness),
            crossing: 1.0 / eta2,
            sampling: params.diffuse_sampling,
            plain: false,
        }
    }

    /// Lambert's.
    #[inline]
    pub fn lambert(rho: Spectrum, sampling: DiffuseSampling) -> Self {
        let transmitted = Spectrum::BLACK;
        Diffuse { rho, transmitted, reflecting: 1.0, roughness: 0.0, crossing: 1.0, sampling, plain: true }
    }

    /// The same with all that it scatters times `s` in [0, 1].
    #[inline]
    pub fn darkened(self, s: f32) -> Self {
        Diffuse { rho: self.rho * s, transmitted: self.transmitted * s, ..self }
    }

    /// True for plain Lambert: `sample` does not look at the number that chooses a lobe.
    #[inline]
    pub fn is_lambert(&self) -> bool {
        self.plain
    }

    /// How its Lambert parts are drawn.
    #[inline]
    pub fn sampling(&self) -> DiffuseSampling {
        self.sampling
    }

    /// True when it scatters nothing.
    #[inline]
    pub fn is_black(&self) -> bool {
        (self.rho.is_black() || self.reflecting == 0.0) && self.transmitted.is_black()
    }

    #[inline]
    fn reflected(&self) -> Spectrum {
        let albedo =
            if self.roughness > 0.0 { oren_nayar::albedo(self.rho, self.roughness) } else { self.rho };
        albedo * self.reflecting
    }

    /// Hemispherical albedo, both sides.
    #[inline]
    pub fn albedo(&self) -> Spectrum {
        if self.plain { self.rho } else { self.reflected() + self.transmitted }
    }

    /// Scale of radiance that crosses.
    #[inline]
    pub fn crossing(&self, mode: TransportMode) -> f32 {
        match mode {
            TransportMode::Radiance => self.crossing,
            TransportMode::Importance => 1.0,
        }
    }

    /// Probability of drawing a direction on the other side.
    #[inline]
    fn prob_transmitted(&self) -> f32 {
        if self.reflecting == 1.0 {
            return 0.0;
        }
        let (r, t) = (self.rho.average() * self.reflecting, self.transmitted.average());
        if r + t > 0.0 { t / (r + t) } else { 0.0 }
    }

    /// f · |cos θi| and the density of [`Diffuse::sample`], sr⁻¹. `wo.z > 0`.
    #[inline(always)]
    pub fn eval_pdf(&self, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Spectrum, f32) {
        if !self.plain {
            self.eval_pdf_general(wo, wi, mode)
        } else if wi.z > 0.0 {
            (self.rho * lambert::eval(wi.z), self.sampling.pdf(wi.z))
        } else {
            (Spectrum::BLACK, 0.0)
        }
    }

    #[cold]
    fn eval_pdf_general(&self, wo: Vec3, wi: Vec3, mode: TransportMode) -> (Spectrum, f32) {
        let p = self.prob_transmitted();
        if wi.z < 0.0 {
            let f = self.transmitted * (lambert::eval(-wi.z) * self.crossing(mode));
            return (f, p * self.sampling.pdf(-wi.z));
        }
        if wi.z == 0.0 {
            return (Spectrum::BLACK, 0.0);
        }
        let f = if self.roughness > 0.0 {
            oren_nayar::eval(self.rho, self.roughness, wo, wi)
        } else {
            self.rho * lambert::eval(wi.z)
        };
        let pdf = match self.sampling {
            DiffuseSampling::Cosine if self.roughness > 0.0 => oren_nayar::pdf(self.roughness, wo, wi),
            sampling => sampling.pdf(wi.z),
        };
        (f * self.reflecting, (1.0 - p) * pdf)
    }

    /// Draws a direction.
    #[inline(always)]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Vec3 {
        if self.plain { self.sampling.sample(u) } else { self.sample_general(wo, u_lobe, u) }
    }

    #[cold]
    fn sample_general(&self, wo: Vec3, u_lobe: f32, u: [f32; 2]) -> Vec3 {
        let p = self.prob_transmitted();
        if u_lobe < p {
            let wi = self.sampling.sample(u);
            return Vec3::new(wi.x, wi.y, -wi.z);
        }
        match self.sampling {
            DiffuseSampling::Cosine if self.roughness > 0.0 => {
                let u_lobe = ((u_lobe - p) / (1.0 - p)).clamp(0.0, ONE_MINUS_EPSILON);
                oren_nayar::sample(self.roughness, wo, u_lobe, u)
            }
            sampling => sampling.sample(u),
        }
    }

    /// The lobe of a direction it drew.
    #[inline]
    pub fn lobe(wi: Vec3) -> Lobe {
        if wi.z > 0.0 { Lobe::DiffuseReflection } else { Lobe::DiffuseTransmission }
    }
}
