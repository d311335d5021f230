//! Layers over a surface: what the white furnace returns at least, where it is exact, and how layers cover what lies beneath.

use lumbre_core::Spectrum;
use lumbre_core::bsdf::{Bsdf, BsdfParams, CoatParams, Lobe, SheenParams, TransportMode};
use lumbre_core::math::Vec3;
use lumbre_testkit::bsdf_rows::{coat, layered, sheen};
use lumbre_testkit::furnace::{direction, furnace};

const COSINES: [f32; 8] = [1.0, 0.9, 0.7, 0.5, 0.2, 0.05, 0.003, 2e-4];
const DRAWS: u32 = 16_384;

/// A white surface and how it differs from the default.
type White = fn(&mut BsdfParams);

const LAMBERT: White = |p| p.specular = 0.0;
const PLASTIC: White = |p| p.roughness = 0.3;
const MIRROR: White = |p| {
    p.metallic = 1.0;
    p.roughness = 0.0;
};
const METAL: White = |p| {
    p.metallic = 1.0;
    p.roughness = 0.4;
};
const THIN: White = |p| {
    p.transmission = 1.0;
    p.roughness = 0.0;
};
const GLASS: White = |p| {
    p.transmission = 1.0;
    p.roughness = 0.0;
    p.thin = false;
};

const BASES: [(&str, White); 6] = [
    ("lambert", LAMBERT),
    ("plastic", PLASTIC),
    ("mirror", MIRROR),
    ("metal", METAL),
    ("thin wall", THIN),
    ("glass", GLASS),
];

fn params(base: White, coat: Option<CoatParams>, sheen: Option<SheenParams>) -> BsdfParams {
    let mut params = BsdfParams { coat, sheen, ..BsdfParams::default() };
    base(&mut params);
    params
}

/// Least and most of the white furnace over all angles.
fn range(params: &BsdfParams) -> (f64, f64) {
    let bsdf = Bsdf::new(params);
    let totals = COSINES.map(|cos| furnace(&bsdf, direction(cos, 0.4), DRAWS).total[0]);
    totals.into_iter().fold((f64::INFINITY, 0.0), |(a, b), e| (a.min(e), b.max(e)))
}

/// What returns at least, all angles, is part of the documentation; nothing gains.
fn keeps(name: &str, params: &BsdfParams, bound: f64) {
    let (least, most) = range(params);
    assert!(most < 1.002, "{name}: gains, {most}");
    // Tight, so that a loss 1.5 % larger is found.
    assert!(least > bound && least - 0.015 < bound, "{name}: keeps {least}, says {bound}");
}

#[test]
fn coated_white_surfaces_keep_what_they_say() {
    for (roughness, bounds) in [
        (0.0, [0.953, 0.962, 0.999, 0.952, 0.999, 0.999]),
        (0.3, [0.965, 0.971, 0.998, 0.968, 0.998, 0.998]),
        (1.0, [0.990, 0.990, 0.998, 0.990, 0.998, 0.998]),
    ] {
        for ((name, base), bound) in BASES.into_iter().zip(bounds) {
            keeps(&format!("coat {roughness} on {name}"), &params(base, coat(roughness), None), bound);
        }
    }
}

#[test]
fn sheen_on_white_surfaces_keeps_what_it_says() {
    for (roughness, bounds) in [
        (0.05, [0.990, 0.990, 0.998, 0.985, 0.998, 0.998]),
        (0.1, [0.985, 0.980, 0.998, 0.975, 0.998, 0.998]),
        (0.3, [0.925, 0.935, 0.997, 0.950, 0.997, 0.997]),
        (0.5, [0.865, 0.880, 0.998, 0.945, 0.998, 0.998]),
        (0.7, [0.855, 0.865, 0.998, 0.945, 0.998, 0.998]),
        (1.0, [0.860, 0.870, 0.998, 0.945, 0.998, 0.998]),
    ] {
        for ((name, base), bound) in BASES.into_iter().zip(bounds) {
            keeps(&format!("sheen {roughness} on {name}"), &params(base, None, sheen(roughness)), bound);
        }
    }
}

#[test]
fn varnish_on_sheen_keeps_what_it_says() {
    for (roughness, base, bound) in
        [(0.3, LAMBERT, 0.90), (1.0, LAMBERT, 0.83), (0.3, MIRROR, 0.98), (1.0, MIRROR, 0.97)]
    {
        keeps("varnish on sheen", &params(base, coat(0.2), sheen(roughness)), bound);
    }
}

/// From inside a solid, what varnish turns back is lost: most where light leaves at a grazing angle.
#[test]
fn varnish_seen_from_inside_keeps_what_it_says() {
    for (roughness, least_bound, mean_bound) in [(0.0, 0.73, 0.965), (1.0, 0.97, 0.98)] {
        let coated = params(GLASS, coat(roughness), None);
        let inside = Bsdf::new(&BsdfParams { eta: 1.0 / 1.5, inside: true, ..coated });
        let (n, mut least, mut mean) = (200, f64::INFINITY, 0.0);
        for i in 0..n {
            let cos = (f64::from(i) + 0.5) / f64::from(n);
            let total = furnace(&inside, direction(cos as f32, 0.4), 1_024).total[0];
            assert!(total < 1.001, "{roughness} at {cos}: gains, {total}");
            least = total.min(least);
            mean += 2.0 * cos * total / f64::from(n);
        }
        assert!(least > least_bound && least - 0.015 < least_bound, "{roughness}: {least}");
        assert!(mean > mean_bound && mean - 0.015 < mean_bound, "{roughness}: {mean}");
    }
}

/// A layer without strength is not there, and strength is a share of the layer at full strength.
#[test]
fn strength_is_a_share() {
    let plain = Bsdf::new(&params(PLASTIC, None, None));
    let none = Some(CoatParams { factor: 0.0, roughness: 0.2, normal: Vec3::Z });
    let black = Some(SheenParams { color: Spectrum::BLACK, roughness: 0.2 });
    assert_eq!(Bsdf::new(&params(PLASTIC, none, black)), plain);
    let (wo, wi) = (direction(0.6, 0.4), direction(0.3, 2.0));
    let at = |factor| {
        let coat = Some(CoatParams { factor, roughness: 0.5, normal: Vec3::Z });
        Bsdf::new(&params(LAMBERT, coat, None)).eval(wo, wi, TransportMode::Radiance).g
    };
    assert!((at(0.5) - 0.5 * (at(1e-9) + at(1.0))).abs() < 1e-6);
}

/// Varnish is white, whatever lies beneath; a coloured sheen does not tint what lies beneath.
#[test]
fn layers_do_not_tint_what_lies_beneath() {
    let (wo, wi) = (direction(0.6, 0.4), direction(0.3, 2.0));
    let grey = |bsdf: &Bsdf| bsdf.eval(wo, wi, TransportMode::Radiance);
    let black = |p: BsdfParams| Bsdf::new(&BsdfParams { base_color: Spectrum::BLACK, ..p });
    let coated = grey(&black(params(LAMBERT, coat(0.4), None)));
    assert!(coated.r > 0.0 && coated.r == coated.g && coated.g == coated.b);
    let red = Some(SheenParams { color: Spectrum::new(0.8, 0.2, 0.0), roughness: 0.5 });
    let red = params(LAMBERT, None, red);
    let beneath = grey(&Bsdf::new(&red)) - grey(&black(red));
    assert!(beneath.r > 0.0 && (beneath.r - beneath.g).abs() < 1e-6 && (beneath.g - beneath.b).abs() < 1e-6);
}

/// Beneath a layer a mirror and a pane keep exactly what the layer does not return at that angle.
#[test]
fn smooth_varnish_leaves_mirrors_their_share() {
    for cos in COSINES {
        let wo = direction(cos, 0.4);
        let schlick = 0.04 + 0.96 * (1.0 - cos).powi(5);
        for base in [MIRROR, THIN] {
            let bsdf = Bsdf::new(&params(base, coat(0.0), None));
            let plain = Bsdf::new(&params(base, None, None));
            assert_eq!(plain.thin_transmittance(wo).is_black(), base as usize == MIRROR as usize);
            let [got, want] = [bsdf, plain].map(|b| b.thin_transmittance(wo).g);
            assert!((got - want * (1.0 - schlick)).abs() < 1e-5, "{cos}: {got} {want}");
        }
        let tint = BsdfParams { base_color: Spectrum::new(1.0, 0.5, 0.0), ..params(MIRROR, coat(0.0), None) };
        let (bsdf, mut seen) = (Bsdf::new(&tint), [false; 2]);
        for k in 0..64 {
            let u = (k as f32 + 0.5) / 64.0;
            let s = bsdf.sample(wo, u, [0.3, 0.7], TransportMode::Radiance).expect("mirrors");
            assert_eq!((s.lobe, s.wi), (Lobe::SpecularReflection, Vec3::new(-wo.x, -wo.y, wo.z)));
            let value = s.weight * s.pdf;
            let is_coat = value.r == value.b;
            seen[usize::from(is_coat)] = true;
            let want = if is_coat { schlick } else { 1.0 - schlick };
            assert!((value.r - want).abs() < 1e-5 * want + 1e-7, "{cos} {k}: {value:?} {want}");
        }
        assert!(seen[1] && (seen[0] || cos < 0.1), "{cos}: {seen:?}");
    }
}

/// Two-sided layers look the same from both sides; those of a solid lie outside.
#[test]
fn layers_of_a_solid_lie_outside() {
    let (wo, wi) = (direction(0.6, 0.4), direction(0.3, 2.0));
    let reflected = |p: &BsdfParams| Bsdf::new(p).eval(wo, wi, TransportMode::Radiance).g;
    let coated = params(GLASS, coat(0.4), sheen(0.4));
    assert!(reflected(&coated) > 0.0);
    assert_eq!(reflected(&BsdfParams { eta: 1.0 / 1.5, inside: true, ..coated }), 0.0);
    let wall = params(THIN, coat(0.4), sheen(0.4));
    assert_eq!(reflected(&wall), reflected(&BsdfParams { inside: true, ..wall }));
}

/// Sampling is good enough: no row has a second moment far above its mean.
#[test]
fn no_row_of_layers_is_noisy() {
    for row in layered() {
        let bsdf = row.bsdf();
        for cos in COSINES {
            let f = furnace(&bsdf, direction(cos, 0.4), 4_096);
            assert!(f.largest < 6.0, "{} at {cos}: weight {}", row.name, f.largest);
        }
    }
}
