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

#[test]
fn white_surfaces_keep_what_they_say() {
    let rows: [(&str, BsdfParams, f64); 0] = [];
    let mut out = String::new();
    for r in [0.0, 0.3, 1.0] {
        for (n, b) in [
            ("lambert", LAMBERT),
            ("plastic", PLASTIC),
            ("mirror", MIRROR),
            ("metal", METAL),
            ("thin", THIN),
            ("glass", GLASS),
        ] {
            out += &format!("coat {r} {n} {:?}\n", range(&params(b, coat(r), None)));
        }
    }
    for r in [0.05, 0.1, 0.3, 0.5, 0.7, 1.0] {
        for (n, b) in [
            ("lambert", LAMBERT),
            ("plastic", PLASTIC),
            ("mirror", MIRROR),
            ("metal", METAL),
            ("thin", THIN),
            ("glass", GLASS),
        ] {
            out += &format!("sheen {r} {n} {:?}\n", range(&params(b, None, sheen(r))));
        }
    }
    for r in [0.3, 1.0] {
        for (n, b) in [("lambert", LAMBERT), ("mirror", MIRROR)] {
            out += &format!("both {r} {n} {:?}\n", range(&params(b, coat(0.2), sheen(r))));
        }
    }
    panic!("{out}");
}
