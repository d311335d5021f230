//! White furnace of every surface model, bounded on both sides.

use lumbre_core::Spectrum;
use lumbre_core::bsdf::{Bsdf, BsdfParams, DiffuseSampling, GlossParams};
use lumbre_testkit::bsdf_rows;
use lumbre_testkit::furnace::{direction, furnace};

const COSINES: [f32; 7] = [1.0, 0.8, 0.5, 0.2, 0.05, 0.003, 2e-4];
const ROUGHNESSES: [f32; 9] = [0.0, 0.0317, 0.05, 0.15, 0.3, 0.5, 0.63, 0.75, 1.0];
const DRAWS: u32 = 16_384;
/// The base under a total reflector gets light only at grazing angles, where drawing by the cosine rarely looks.
const DRAWS_TOTAL_REFLECTION: u32 = 262_144;
/// What a white surface may be off 1: tables and draws together.
const TOLERANCE: f64 = 0.005;

/// A white surface: its name and how it differs from the default.
type White = (&'static str, fn(&mut BsdfParams));

/// Models that keep all light.
const WHITE: [White; 14] = [
    ("metal", |p| p.metallic = 1.0),
    ("plastic", |_| ()),
    ("plastic of high index", |p| p.ior = 2.4),
    ("plastic of total reflection", |p| p.ior = 0.0),
    ("weak interface", |p| p.specular = 0.4),
    ("lambert", |p| p.specular = 0.0),
    ("rough diffuse", |p| {
        p.specular = 0.0;
        p.diffuse_roughness = 1.0;
    }),
    ("leaf", |p| {
        p.specular = 0.0;
        p.diffuse_transmission = 0.3;
        p.diffuse_roughness = 0.4;
    }),
    ("leaf under an interface", |p| p.diffuse_transmission = 0.6),
    ("wax", |p| {
        p.diffuse_transmission = 0.6;
        p.thin = false;
    }),
    ("wax from inside", |p| {
        p.diffuse_transmission = 0.6;
        p.thin = false;
        p.eta = 1.0 / 1.5;
    }),
    ("thin wall", |p| p.transmission = 1.0),
    ("half metal", |p| p.metallic = 0.5),
    ("metal, plastic and thin wall", |p| {
        p.metallic = 0.3;
        p.transmission = 0.5;
    }),
];

fn white(change: fn(&mut BsdfParams), roughness: f32) -> Bsdf {
    let mut params = BsdfParams { roughness, ..BsdfParams::default() };
    change(&mut params);
    Bsdf::new(&params)
}

fn bsdf_is_total(change: fn(&mut BsdfParams)) -> bool {
    let mut params = BsdfParams::default();
    change(&mut params);
    params.ior == 0.0
}

/// Largest distance of the white furnace from 1, all roughnesses and angles, and where.
fn worst(change: fn(&mut BsdfParams), planted: f64) -> (f64, f32, f32) {
    let mut worst = (0.0, 0.0, 0.0);
    for roughness in ROUGHNESSES {
        let bsdf = white(change, roughness);
        for cos in COSINES {
            let draws = if bsdf_is_total(change) { DRAWS_TOTAL_REFLECTION } else { DRAWS };
            let total = furnace(&bsdf, direction(cos, 0.4), draws).total;
            for e in total {
                let off = (e * planted - 1.0).abs();
                if off > worst.0 {
                    worst = (off, roughness, cos);
                }
            }
        }
    }
    worst
}

#[test]
fn white_surfaces_return_everything() {
    for (name, change) in WHITE {
        let (off, roughness, cos) = worst(change, 1.0);
        assert!(off < TOLERANCE, "{name}: off by {off} at roughness {roughness}, cosine {cos}");
        assert!(worst(change, 1.01).0 > TOLERANCE, "{name}: a planted error of 1 % is not seen");
        assert!(worst(change, 0.99).0 > TOLERANCE, "{name}: a planted loss of 1 % is not seen");
    }
}

#[test]
fn smooth_surfaces_are_exact() {
    let glass: White = ("glass", |p| {
        p.transmission = 1.0;
        p.thin = false;
    });
    for (name, change) in WHITE.into_iter().chain([glass]) {
        let bsdf = white(change, 0.0);
        for cos in COSINES {
            let total = furnace(&bsdf, direction(cos, 0.4), DRAWS).total[0];
            assert!((total - 1.0).abs() < 5e-4, "{name} at {cos}: {total}");
        }
    }
}

/// Single scattering at a rough boundary loses light: how much is kept at least, both sides, is part of the documentation.
#[test]
fn rough_boundary_keeps_what_it_says() {
    for (roughness, bound) in
        [(0.05, 0.88), (0.15, 0.90), (0.3, 0.86), (0.5, 0.78), (0.75, 0.60), (1.0, 0.35)]
    {
        let mut least = f64::INFINITY;
        for eta in [1.5, 1.0 / 1.5] {
            let params =
                BsdfParams { transmission: 1.0, thin: false, roughness, eta, ..BsdfParams::default() };
            for cos in [1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.05, 0.01, 0.003, 1e-3] {
                let kept = furnace(&Bsdf::new(&params), direction(cos, 0.4), 4_096).total[0];
                assert!(kept < 1.0 + 1e-4, "gain at {roughness} {eta} {cos}: {kept}");
                least = least.min(kept);
            }
        }
        // Tight, so that a loss 3 % larger is found.
        assert!(least > bound && least * 0.97 < bound, "roughness {roughness}: keeps {least}, says {bound}");
    }
}

/// How much of the light Phong's lobe keeps, no base beneath: all at normal incidence, what its documentation says elsewhere, never more.
#[test]
fn phong_keeps_what_it_says() {
    let kept = |exponent, fresnel, cos: f32| {
        let gloss = Some(GlossParams { specular: Spectrum::WHITE, exponent, fresnel });
        let bsdf = Bsdf::new(&BsdfParams { base_color: Spectrum::BLACK, gloss, ..BsdfParams::default() });
        furnace(&bsdf, direction(cos, 0.4), 65_536).total[0]
    };
    for fresnel in [false, true] {
        for n in [0.0f32, 0.2, 0.5, 0.8, 1.0, 3.0, 10.0, 50.0, 1e3, 1e5, 1e6] {
            for cos in [1.0, 0.95, 0.8, 0.7, 0.6, 0.5, 0.3, 0.1, 0.02, 0.003] {
                let e = kept(n, fresnel, cos);
                assert!(e < 1.0005, "gain at {n} {cos}: {e}");
                let least = f64::from((n + 2.0) / (2.0 * n + 2.0) / (1.0 + 0.09 * (1.0 - n).max(0.0)));
                assert!(e > least - 2e-3, "exponent {n} at {cos}: {e} below {least}");
            }
            assert!(n < 1.0 || (kept(n, fresnel, 1.0) - 1.0).abs() < 1e-3);
        }
    }
    assert!((kept(50.0, false, 0.5) - 0.9123).abs() < 1e-3, "the figure of its documentation");
    assert!(kept(1e5, false, 0.1) > 0.98, "turns into a mirror");
    assert_eq!(kept(f32::INFINITY, false, 0.01), 1.0);
}

/// Where a solid disperses, what is reflected and what refracts still make up 1, at any index of the wavelength.
#[test]
fn a_boundary_that_disperses_keeps_all() {
    for (eta, eta_fresnel) in [(1.53, 1.5), (1.48, 1.5), (2.5, 2.417), (1.0, 1.02)] {
        let params = BsdfParams {
            transmission: 1.0,
            thin: false,
            roughness: 0.0,
            eta,
            eta_fresnel: Some(eta_fresnel),
            ..BsdfParams::default()
        };
        let bsdf = Bsdf::new(&params);
        for cos in COSINES {
            let wo = direction(cos, 0.4);
            let f = furnace(&bsdf, wo, DRAWS);
            let d_line = Bsdf::new(&BsdfParams { eta: eta_fresnel, eta_fresnel: None, ..params });
            let want = furnace(&d_line, wo, DRAWS).reflected[0];
            assert!((f.total[0] - 1.0).abs() < 5e-4 && (f.reflected[0] - want).abs() < 1e-6, "{eta} {cos}");
            // Rough, it loses no more than what does not disperse.
            let rough = Bsdf::new(&BsdfParams { roughness: 0.4, ..params });
            let kept = furnace(&rough, wo, DRAWS).total[0];
            assert!(kept < 1.0001 && (cos < 0.1 || kept > 0.75), "{eta} {cos}: {kept}");
        }
    }
}

/// Lambert drawn by the cosine has no variance at all.
#[test]
fn lambert_weight_is_the_albedo() {
    let rho = Spectrum::new(0.7, 0.3, 0.1);
    let bsdf = Bsdf::lambert(rho, DiffuseSampling::Cosine);
    for k in 0..1_000u32 {
        let u = [1, 2, 3].map(|d| lumbre_core::hash::unit(k, d));
        let mode = lumbre_core::bsdf::TransportMode::Radiance;
        let s = bsdf.sample(direction(0.3, 1.0), u[0], [u[1], u[2]], mode).expect("always");
        assert_eq!(s.weight, rho);
    }
    assert_eq!(bsdf.albedo(), rho);
    let params = BsdfParams { base_color: rho, specular: 0.0, ..BsdfParams::default() };
    assert_eq!(Bsdf::new(&params), bsdf);
}

/// No colour makes any surface return more than it gets, and no weight explodes.
#[test]
fn no_surface_gains_light() {
    let colours =
        [Spectrum::WHITE, Spectrum::BLACK, Spectrum::new(1.0, 0.0, 0.5), Spectrum::new(0.2, 0.9, 1.0)];
    for row in bsdf_rows::all() {
        for base_color in colours {
            let bsdf = Bsdf::new(&BsdfParams { base_color, ..row.params });
            for cos in COSINES {
                let f = furnace(&bsdf, direction(cos, 0.4), 4_096);
                let most = f.total.into_iter().fold(0.0, f64::max);
                assert!(most < 1.0 + TOLERANCE, "{} {base_color:?} at {cos}: {most}", row.name);
                assert!(f.largest < 20.0, "{} {base_color:?} at {cos}: weight {}", row.name, f.largest);
            }
        }
    }
}

/// The guide for denoisers is the hemispherical mean of the furnace for surfaces that reflect.
#[test]
fn albedo_is_the_mean_of_the_furnace() {
    for row in [bsdf_rows::bases(), bsdf_rows::metals(), bsdf_rows::diffuse()].concat() {
        let bsdf = row.bsdf();
        let n = 24;
        let mut mean = [0.0; 3];
        for i in 0..n {
            // Cosines in proportion to themselves.
            let cos = ((i as f32 + 0.5) / n as f32).sqrt();
            let f = furnace(&bsdf, direction(cos, 0.4), 2_048);
            for (sum, e) in mean.iter_mut().zip(f.total) {
                *sum += e / f64::from(n);
            }
        }
        for (got, want) in bsdf.albedo().to_array().into_iter().zip(mean) {
            assert!((f64::from(got) - want).abs() < 0.01, "{}: {got} {want}", row.name);
        }
    }
}
