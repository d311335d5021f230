//! Every surface: weight = eval / pdf, probabilities of delta lobes, reciprocity, adjoint transport, and finite values everywhere.

use lumbre_core::Spectrum;
use lumbre_core::bsdf::{
    Bsdf, BsdfParams, BsdfSample, CoatParams, DiffuseSampling, FilmParams, GlossParams, SheenParams,
    TransportMode,
};
use lumbre_core::hash::unit;
use lumbre_core::math::Vec3;
use lumbre_core::warp::uniform_sphere;
use lumbre_testkit::bsdf_rows::{self, Row};
use lumbre_testkit::furnace::direction;

use TransportMode::{Importance, Radiance};

const COSINES: [f32; 5] = [1.0, 0.9, 0.5, 0.15, 0.01];

fn draw(bsdf: &Bsdf, wo: Vec3, k: u32, mode: TransportMode) -> Option<BsdfSample> {
    let u = [11, 12, 13].map(|d| unit(k, d));
    bsdf.sample(wo, u[0], [u[1], u[2]], mode)
}

/// Largest band of |a - b| over the larger of the two and `floor`.
fn relative(a: Spectrum, b: Spectrum, floor: f32) -> f32 {
    let scale = a.max_component().max(b.max_component()).max(floor);
    (a - b).map(f32::abs).max_component() / scale
}

/// Worst disagreement of a sample's weight with f/pdf and of its density with `pdf`, when the values are scaled by `planted`.
fn worst_weight(row: &Row, planted: f32) -> f32 {
    let bsdf = row.bsdf();
    let mut worst = 0.0f32;
    for mode in [Radiance, Importance] {
        for wo in COSINES.map(|c| direction(c, 2.0)) {
            for s in (0..2_000).filter_map(|k| draw(&bsdf, wo, k, mode)).filter(|s| !s.lobe.is_delta()) {
                let f = bsdf.eval(wo, s.wi, mode) * planted;
                worst = worst.max(relative(s.weight, f / bsdf.pdf(wo, s.wi), 1e-3));
                worst = worst.max((s.pdf / bsdf.pdf(wo, s.wi) - 1.0).abs());
            }
        }
    }
    worst
}

#[test]
fn weight_is_eval_over_pdf() {
    for row in bsdf_rows::all() {
        let worst = worst_weight(&row, 1.0);
        assert!(worst < 1e-4, "{}: {worst}", row.name);
        if row.bsdf().has_smooth_lobes() {
            assert!(worst_weight(&row, 1.01) > 5e-3, "{}: a planted error of 1 % is not seen", row.name);
        }
    }
}

/// How far the share of each delta lobe is from the probability it reports, in standard deviations; and their number.
fn delta_sigma(bsdf: &Bsdf, wo: Vec3, planted: f64) -> (f64, usize) {
    let n = 200_000;
    let mut lobes: Vec<(BsdfSample, u32)> = Vec::new();
    for s in (0..n).filter_map(|k| draw(bsdf, wo, k, Radiance)).filter(|s| s.lobe.is_delta()) {
        // Two components can hold the same kind of lobe: tell them apart by probability too.
        match lobes.iter_mut().find(|(l, _)| l.lobe == s.lobe && l.pdf == s.pdf) {
            Some((first, count)) => {
                assert_eq!((first.wi, first.weight), (s.wi, s.weight));
                *count += 1;
            }
            None => lobes.push((s, 1)),
        }
    }
    let worst = lobes.iter().map(|(s, count)| {
        let p = (f64::from(s.pdf) * planted).min(1.0);
        let sigma = (p * (1.0 - p) / f64::from(n)).sqrt().max(1e-6);
        (f64::from(*count) / f64::from(n) - p).abs() / sigma
    });
    (worst.fold(0.0, f64::max), lobes.len())
}

#[test]
fn delta_lobes_come_with_the_probability_they_report() {
    let (mut seen, mut planted_seen) = (0, false);
    for row in bsdf_rows::all() {
        for wo in COSINES.map(|c| direction(c, 1.0)) {
            let (sigma, count) = delta_sigma(&row.bsdf(), wo, 1.0);
            assert!(sigma < 4.5, "{} at {}: {sigma}", row.name, wo.z);
            seen += count;
            planted_seen |= delta_sigma(&row.bsdf(), wo, 0.97).0 > 4.5;
        }
    }
    assert!(seen > 60 && planted_seen, "{seen} delta lobes");
}

#[test]
fn shadow_transmittances_are_the_weights_of_the_delta_lobes() {
    let params = BsdfParams {
        base_color: Spectrum::new(0.9, 0.5, 0.2),
        metallic: 0.25,
        transmission: 0.5,
        roughness: 0.0,
        ..BsdfParams::default()
    };
    let tilted = CoatParams { factor: 0.7, roughness: 0.4, normal: Vec3::new(0.3, 0.1, 0.9).normalize() };
    for (coat, sheen) in [(None, None), (bsdf_rows::coat(0.0), bsdf_rows::sheen(0.3)), (Some(tilted), None)] {
        let params = BsdfParams { coat, sheen, ..params };
        for wo in COSINES.map(|c| direction(c, 1.0)) {
            for thin in [true, false] {
                let bsdf = Bsdf::new(&BsdfParams { thin, ..params });
                let through = (0..20_000)
                    .filter_map(|k| draw(&bsdf, wo, k, Radiance))
                    .find(|s| s.lobe.is_transmission())
                    .map(|s| s.weight * (s.pdf / s.eta_scale));
                let (want, none) = if thin {
                    (bsdf.thin_transmittance(wo), bsdf.straight_transmittance(wo))
                } else {
                    (bsdf.straight_transmittance(wo), bsdf.thin_transmittance(wo))
                };
                // Next to nothing passes varnish at grazing angles, and may not be drawn.
                match through {
                    Some(got) => assert!(relative(got, want, 1e-3) < 1e-5, "{thin} {wo}: {got:?} {want:?}"),
                    None => assert!(want.max_component() < 1e-4, "{thin} {wo}: {want:?}"),
                }
                assert!(none.is_black());
            }
            let rough = Bsdf::new(&BsdfParams { roughness: 0.3, ..params });
            assert!(rough.thin_transmittance(wo).is_black());
        }
        // From inside a solid, the same as from outside: also beyond the critical angle.
        let [out, inside] = [1.5, 1.0 / 1.5].map(|eta| {
            let params = BsdfParams { thin: false, eta, inside: eta < 1.0, ..params };
            Bsdf::new(&params).straight_transmittance(direction(0.3, 1.0))
        });
        assert!(relative(out, inside, 1e-3) < 1e-5 && !out.is_black());
    }
}

/// Worst violation of f(wo, wi) / ηo² = f(wi, wo) / ηi², where `there(wo, wi)` and `back(wi, wo)` return f |cos|.
fn worst_reciprocity(row: &Row, planted: f32) -> f32 {
    let (bsdf, behind) = (row.bsdf(), row.from_behind());
    let mut worst = 0.0f32;
    for k in 0..4_000 {
        let wo = direction(0.02 + 0.98 * unit(k, 1), 6.0 * unit(k, 2));
        // Half of the directions anywhere, half where the surface scatters.
        let wi = match draw(&bsdf, wo, k, Radiance) {
            Some(s) if k % 2 == 0 && !s.lobe.is_delta() => s.wi,
            _ => uniform_sphere([unit(k, 3), unit(k, 4)]),
        };
        if wi.z.abs() < 0.02 {
            continue;
        }
        let there = bsdf.eval(wo, wi, Radiance) * (planted / wi.z.abs());
        // From the other side the frame is turned so that +z is where the ray comes from.
        let (back, scale) = if wi.z > 0.0 {
            (bsdf.eval(wi, wo, Radiance), 1.0)
        } else {
            let eta = if row.refracts() { row.params.eta } else { 1.0 };
            (behind.eval(-wi, -wo, Radiance), 1.0 / (eta * eta))
        };
        let back = back * (scale / wo.z);
        // Half vectors that nearly cancel lose digits when the index is close to 1 or the lobe is narrow.
        worst = worst.max(relative(there, back, 1e-2));
    }
    worst
}

#[test]
fn reciprocity() {
    for row in bsdf_rows::all().into_iter().filter(|r| !r.is_tilted()) {
        let limit = if row.alpha() < 0.02 { 5e-3 } else { 1e-3 };
        let worst = worst_reciprocity(&row, 1.0);
        assert!(worst < limit, "{}: {worst}", row.name);
        if row.bsdf().has_smooth_lobes() {
            assert!(worst_reciprocity(&row, 1.01) > 8e-3, "{}: a planted error of 1 % is not seen", row.name);
        }
    }
}

#[test]
fn importance_is_the_adjoint_of_radiance() {
    for row in bsdf_rows::all().into_iter().filter(|r| r.bsdf().has_smooth_lobes() && !r.is_tilted()) {
        let (bsdf, behind) = (row.bsdf(), row.from_behind());
        for k in 0..2_000 {
            let wo = direction(0.05 + 0.95 * unit(k, 1), 6.0 * unit(k, 2));
            let Some(s) = draw(&bsdf, wo, k, Importance).filter(|s| !s.lobe.is_delta()) else { continue };
            if s.wi.z.abs() < 0.02 {
                continue;
            }
            // f*(wo, wi) = f(wi, wo): Veach 1997, chapter 3.
            let adjoint = bsdf.eval(wo, s.wi, Importance) / s.wi.z.abs();
            let swapped =
                if s.wi.z > 0.0 { bsdf.eval(s.wi, wo, Radiance) } else { behind.eval(-s.wi, -wo, Radiance) }
                    / wo.z;
            let limit = if row.alpha() < 0.02 { 5e-3 } else { 1e-3 };
            assert!(relative(adjoint, swapped, 1e-2) < limit, "{}: {wo} {}", row.name, s.wi);
        }
    }
}

#[test]
fn crossing_scales_radiance_and_says_so() {
    for row in [bsdf_rows::transmissive(), bsdf_rows::diffuse()].concat() {
        let bsdf = row.bsdf();
        let want = if row.refracts() { 1.0 / (row.params.eta * row.params.eta) } else { 1.0 };
        for k in 0..500 {
            let wo = direction(0.8, 0.1);
            let (Some(a), Some(b)) = (draw(&bsdf, wo, k, Radiance), draw(&bsdf, wo, k, Importance)) else {
                continue;
            };
            let scale = if a.lobe.is_transmission() { want } else { 1.0 };
            assert_eq!((a.lobe, a.wi), (b.lobe, b.wi));
            assert!((a.eta_scale - scale).abs() < 1e-5 && b.eta_scale == 1.0, "{}", row.name);
            assert!(relative(a.weight, b.weight * scale, 1e-6) < 1e-4, "{}", row.name);
        }
    }
}

#[test]
fn matched_indices_pass_straight() {
    for name in ["index matched", "index matched rough"] {
        let row = bsdf_rows::all().into_iter().find(|r| r.name == name).expect("row exists");
        for wo in [1.0, 0.4, 1e-3, 1e-5].map(|c| direction(c, 1.0)) {
            for k in 0..100 {
                let s = draw(&row.bsdf(), wo, k, Radiance).expect("passes");
                assert!((s.wi + wo).length() < 1e-6 && s.weight == row.params.base_color, "{name}: {s:?}");
            }
        }
    }
}

/// A number that is often one of the corners.
fn corner(k: u32, dim: u32, corners: &[f32]) -> f32 {
    let u = unit(k, 2 * dim + 100);
    let v = unit(k, 2 * dim + 101);
    if u < 0.5 { v } else { corners[(v * corners.len() as f32) as usize] }
}

#[test]
fn everything_is_finite_for_a_million_inputs() {
    let unit_corners = [0.0, 1.0, 1e-7, 1.0 - 6e-8, 0.5];
    let u_corners = [0.0, 0.999_999_94, 0.5, 1e-7, 0.25];
    let cos_corners = [1.0, 1.0 - 6e-8, 1e-6, 1e-5, 1e-3, 1e-30, 0.0, -0.5, 0.745_355_96];
    let ior_corners = [1.0, 1.5, 1.0 / 1.5, 2.417, 1.000_001, 0.999, 1.33, 10.0, 0.1];
    for k in 0..1_000_000 {
        let c = |dim| corner(k, dim, &unit_corners);
        let eta = corner(k, 10, &ior_corners).max(0.05) + if k % 5 == 0 { 1.0 } else { 0.0 };
        let params = BsdfParams {
            base_color: Spectrum::new(c(0), c(1), c(2)),
            metallic: c(3),
            roughness: corner(k, 4, &[0.0, 0.031_622_777, 0.0317, 0.04, 1.0]),
            ior: corner(k, 5, &ior_corners) + if k % 3 == 0 { 1.0 } else { 0.0 },
            specular: c(6),
            specular_color: Spectrum::new(c(7), 3.0 * c(8), 0.5),
            transmission: c(9),
            thin: k & 1 == 0,
            eta,
            inside: k & 2 == 0,
            sheen: (k & 12 == 4).then(|| SheenParams {
                color: Spectrum::new(c(17), c(18), c(19)),
                roughness: corner(k, 20, &unit_corners),
            }),
            coat: (k & 20 == 20).then(|| CoatParams {
                factor: c(21),
                roughness: corner(k, 22, &[0.0, 0.031_622_777, 0.0317, 0.04, 1.0]),
                normal: if k & 32 == 0 { Vec3::Z } else { direction(c(23), 6.3 * unit(k, 8)) },
            }),
            anisotropy: if k % 3 == 1 { c(24) } else { 0.0 },
            film: (k % 5 == 1).then(|| FilmParams {
                factor: c(25),
                ior: 1.0 + 2.0 * c(26),
                thickness_nm: corner(k, 27, &[0.0, 1e-6, 0.3, 1e9, f32::NAN]) * 1e3,
            }),
            diffuse_roughness: if k % 7 == 0 { c(17) } else { 0.0 },
            diffuse_transmission: if k % 11 == 0 { c(18) } else { 0.0 },
            gloss: (k % 13 == 0).then(|| GlossParams {
                specular: Spectrum::new(c(7), c(8), c(6)),
                exponent: corner(k, 19, &[0.0, 1.0, 1e4, 1.9e6, f32::INFINITY, f32::NAN]) * 100.0,
                fresnel: k % 2 == 0,
            }),
            eta_fresnel: (k % 17 == 0 && eta >= 1.0).then(|| 1.0 + corner(k, 28, &unit_corners)),
            diffuse_sampling: if k % 19 == 0 { DiffuseSampling::Uniform } else { DiffuseSampling::Cosine },
            diffuse_transmission_color: Spectrum::new(c(29), c(30), c(31)),
            // All of them by name: a new one has to be here.
        };
        let bsdf = Bsdf::new(&params);
        let wo = direction(corner(k, 11, &cos_corners), 6.3 * unit(k, 9));
        let wi = uniform_sphere([corner(k, 12, &u_corners), corner(k, 13, &u_corners)]);
        let check = |f: Spectrum, pdf: f32| {
            assert!(f.is_finite() && pdf.is_finite() && pdf >= 0.0, "{k}: {f:?} {pdf} {params:?} {wo} {wi}");
            assert!(f.r >= 0.0 && f.g >= 0.0 && f.b >= 0.0, "{k}: {f:?} {params:?} {wo} {wi}");
        };
        for wi in [wi, -wo, Vec3::new(-wo.x, -wo.y, wo.z), wo] {
            let (f, pdf) = bsdf.eval_pdf(wo, wi, Radiance);
            check(f, pdf);
        }
        let u = [14, 15, 16].map(|d| corner(k, d, &u_corners));
        if let Some(s) = bsdf.sample(wo, u[0], [u[1], u[2]], Radiance) {
            check(s.weight, s.pdf);
            assert!((s.wi.length() - 1.0).abs() < 1e-4, "{k}: {s:?} {params:?} {wo}");
            assert!(s.lobe.is_transmission() == (s.wi.z < 0.0) && s.eta_scale > 0.0, "{k}: {s:?}");
        }
        let above = Vec3::new(wo.x, wo.y, wo.z.abs());
        check(bsdf.albedo(), bsdf.thin_transmittance(above).r);
        check(bsdf.straight_transmittance(above), 0.0);
    }
}
