//! One wavelength of light, for paths that meet a medium which disperses: how it is drawn, what colour it carries, and the index of
//! refraction there (KHR_materials_dispersion).
//!
//! A path carries three bands until it must know its wavelength. It then takes one from its random stream and multiplies its throughput
//! by the weight of that wavelength, whose mean over all wavelengths is exactly 1 in every band: light that is not separated stays as
//! it was. The weights are the responses of the three bands, s_r, s_g and s_b, each with integral 1, over the density p = (s_r + s_g + s_b)/3
//! from which wavelengths are drawn, so that no band exceeds 3 and their sum is always 3. Drawing one of three bands with an index each
//! would be simpler and show three ghosts of every edge; here the spectrum is continuous.
//!
//! The responses are the colour matching functions of CIE 1931 (the fits of Wyman, Sloan and Shirley 2013) in Rec. 709 primaries, tabulated every 5 nm and
//! linear in between, with what is negative set to 0: pure spectral colours lie outside these primaries, and a throughput must
//! not be negative. Such colours come out as pure as the primaries allow.

use crate::math::{exp, sqr};
use crate::rgb::Spectrum;
use std::sync::LazyLock;

/// First node of the table, nm.
const FIRST: f32 = 390.0;
/// Distance between nodes, nm.
const STEP: f32 = 5.0;
/// Nodes: up to 700 nm, beyond which less than a thousandth of any response lies.
pub const NODES: usize = 63;

/// A wavelength and the colour it carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wavelength {
    /// Length in vacuum, nm.
    pub nm: f32,
    /// Factor on the throughput of a path that takes it; 1 on average.
    pub weight: Spectrum,
}

/// What [`Wavelength::sample`] looks up.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// Responses of the three bands at each node, each with integral 1 nm⁻¹.
    pub response: [Spectrum; NODES],
    /// Integral of their mean up to each node, 0 to 1.
    pub cdf: [f32; NODES],
}

static TABLE: LazyLock<Table> = LazyLock::new(Table::new);

impl Wavelength {
    /// The wavelength of a number in [0, 1).
    pub fn sample(u: f32) -> Self {
        let table = &*TABLE;
        let node = (table.cdf.partition_point(|c| *c <= u)).clamp(1, NODES - 1) - 1;
        let (a, b) = (table.response[node], table.response[node + 1]);
        let [pa, pb] = [a.average(), b.average()];
        // Invert the integral of a linear density over the cell, written so that nothing cancels.
        let part = ((u - table.cdf[node]) / (table.cdf[node + 1] - table.cdf[node])).clamp(0.0, 1.0);
        let x = (part * (pa + pb) / (pa + (sqr(pa) + part * (pb - pa) * (pb + pa)).max(0.0).sqrt())).min(1.0);
        let response = a.lerp(b, x);
        Wavelength { nm: FIRST + STEP * (node as f32 + x), weight: response / response.average() }
    }
}

impl Table {
    /// The table that all share.
    pub fn get() -> &'static Self {
        &TABLE
    }

    fn new() -> Self {
        let mut response: [Spectrum; NODES] =
            core::array::from_fn(|i| band_response(FIRST + STEP * i as f32));
        // Trapezoids are exact for what is linear between nodes.
        let mut sum = [0.0f64; 3];
        for pair in response.windows(2) {
            for (band, sum) in sum.iter_mut().enumerate() {
                *sum += 0.5 * f64::from(STEP) * (f64::from(pair[0][band]) + f64::from(pair[1][band]));
            }
        }
        let scale = Spectrum::from_array(sum.map(|s| (1.0 / s) as f32));
        response.iter_mut().for_each(|r| *r *= scale);
        let mut total = 0.0f64;
        let mut cdf = [0.0; NODES];
        for (i, pair) in response.windows(2).enumerate() {
            total += 0.5 * f64::from(STEP * (pair[0].average() + pair[1].average()));
            cdf[i + 1] = total as f32;
        }
        Table { response, cdf: cdf.map(|c| (f64::from(c) / total) as f32) }
    }
}

/// CIE 1931 in linear Rec. 709, not below 0.
fn band_response(nm: f32) -> Spectrum {
    // Lobes of different widths on both sides: Wyman, Sloan and Shirley 2013, section 2.2.
    let lobe = |mean: f32, left: f32, right: f32| {
        let t = (nm - mean) / if nm < mean { left } else { right };
        exp(-0.5 * t * t)
    };
    let x =
        1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2);
    let y = 0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1);
    let z = 1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8);
    Spectrum::new(
        3.240_6 * x - 1.537_2 * y - 0.498_6 * z,
        -0.968_9 * x + 1.875_8 * y + 0.041_5 * z,
        0.055_7 * x - 0.204_0 * y + 1.057_0 * z,
    )
    .max(0.0)
}

/// Index of refraction at `nm` of a medium with index `ior` at the d line (587.6 nm), by Cauchy's law through the Abbe number
/// V = 20 / `dispersion`: n = nd + (nd - 1)/V (523655/λ² - 1.5168), as KHR_materials_dispersion writes it. At least 1.
#[inline]
pub fn dispersed_index(ior: f32, dispersion: f32, nm: f32) -> f32 {
    (ior + (ior - 1.0) * (dispersion / 20.0) * (523_655.0 / (nm * nm) - 1.516_8)).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Light that is not separated keeps its colour: the mean weight is 1, no weight is negative or above 3, and their sum is 3.
    #[test]
    fn white_stays_white() {
        let n = 1 << 20;
        let mut sum = [0.0f64; 3];
        for i in 0..n {
            let w = Wavelength::sample((i as f32 + 0.5) / n as f32);
            assert!((390.0..=700.0).contains(&w.nm), "{w:?}");
            assert!((w.weight.average() - 1.0).abs() < 1e-5, "{w:?}");
            for (sum, v) in sum.iter_mut().zip(w.weight.to_array()) {
                assert!((0.0..=3.0001).contains(&v), "{w:?}");
                *sum += f64::from(v) / f64::from(n);
            }
        }
        assert!(sum.iter().all(|s| (s - 1.0).abs() < 1e-5), "{sum:?}");
        for u in [0.0, crate::math::ONE_MINUS_EPSILON] {
            assert!(Wavelength::sample(u).weight.is_finite());
        }
    }

    /// Wavelengths come in order, with the density that the weights are divided by.
    #[test]
    fn wavelengths_follow_their_density() {
        let nm = |u: f32| Wavelength::sample(u).nm;
        assert!((1..1000).all(|i| nm(i as f32 / 1000.0) > nm((i - 1) as f32 / 1000.0)));
        // p(λ) dλ = du.
        for i in 1..100 {
            let (u, h) = (i as f32 / 100.0, 1e-3);
            let node = (nm(u) - FIRST) / STEP;
            let (i, t) = (node as usize, node.fract());
            let p = TABLE.response[i].lerp(TABLE.response[i + 1], t).average();
            let slope = 2.0 * h / (nm(u + h) - nm(u - h));
            assert!((slope / p - 1.0).abs() < 0.05, "{u}: {slope} {p}");
        }
    }

    /// A rainbow: blue at 450 nm, green at 530, red at 620 and red with some blue at 420.
    #[test]
    fn colours_of_the_spectrum() {
        let at = |nm: f32| band_response(nm);
        assert!(at(450.0).b > 3.0 * at(450.0).r.max(at(450.0).g));
        assert!(at(530.0).g > 3.0 * at(530.0).r.max(at(530.0).b));
        assert!(at(620.0).r > 3.0 * at(620.0).g.max(at(620.0).b));
        assert!(at(420.0).b > at(420.0).r && at(420.0).r > 0.0 && at(420.0).g == 0.0);
    }

    /// The Abbe number is that of the d, F and C lines, and at the d line the index is the material's.
    #[test]
    fn abbe_number() {
        for (ior, dispersion) in [(1.5f32, 0.36f32), (2.417, 0.36), (1.33, 5.0)] {
            let n = |nm| dispersed_index(ior, dispersion, nm);
            let abbe = (n(587.56) - 1.0) / (n(486.13) - n(656.27));
            assert!((abbe * dispersion / 20.0 - 1.0).abs() < 1e-3, "{abbe}");
            assert!((n(587.56) - ior).abs() < 2e-5 * dispersion.max(1.0), "{}", n(587.56));
            assert_eq!(dispersed_index(ior, 0.0, 400.0), ior);
        }
    }
}
