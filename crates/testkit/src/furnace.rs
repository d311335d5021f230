//! The white furnace at one surface: what comes back from uniform surroundings of radiance 1, by drawing directions.
//!
//! Draws are Owen-scrambled Sobol points, so that a few ten thousand give an albedo to about 1e-4.

use lumbre_core::Spectrum;
use lumbre_core::bsdf::{Bsdf, TransportMode};
use lumbre_core::math::Vec3;
use lumbre_core::sampler::{Sampler, SamplerKind};

/// Mean weights of a furnace, in `f64` per band.
#[derive(Clone, Copy, Debug, Default)]
pub struct Furnace {
    /// Everything that comes back.
    pub total: [f64; 3],
    /// The part from the side of `wo`.
    pub reflected: [f64; 3],
    /// Largest single weight, all bands.
    pub largest: f64,
}

/// Directional albedo of `bsdf` at `wo` with `n` draws; the scaling of radiance by refraction is divided out.
pub fn furnace(bsdf: &Bsdf, wo: Vec3, n: u32) -> Furnace {
    let mut out = Furnace::default();
    for k in 0..n {
        // Lobe and direction from one set: an integral of three dimensions.
        let u = Sampler::new(SamplerKind::Sobol, 7, 0, [3, 5], k).set(2);
        let Some(s) = bsdf.sample(wo, u.number(2), u.pair(0), TransportMode::Radiance) else { continue };
        let weight: Spectrum = s.weight / s.eta_scale;
        out.largest = out.largest.max(f64::from(weight.max_component()));
        for band in 0..3 {
            let w = f64::from(weight[band]) / f64::from(n);
            out.total[band] += w;
            if s.wi.z > 0.0 {
                out.reflected[band] += w;
            }
        }
    }
    out
}

/// A direction by cosine and azimuth.
pub fn direction(cos: f32, phi: f32) -> Vec3 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let (s, c) = lumbre_core::math::sin_cos(phi);
    Vec3::new(sin * c, sin * s, cos)
}
