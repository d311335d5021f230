//! Chi-square of every surface's sampling against its density; also that the density integrates to 1 less what deltas and
//! ended samples take.

use lumbre_core::bsdf::{Bsdf, BsdfParams, TransportMode};
use lumbre_core::fresnel::{dielectric_refracted, refract};
use lumbre_core::hash::unit;
use lumbre_core::math::Vec3;
use lumbre_core::microfacet::ALPHA_SMOOTH;
use lumbre_testkit::bsdf_rows::{self, Row};
use lumbre_testkit::chi_square::{self, ChiSquare, Grid};
use lumbre_testkit::furnace::direction;

const DRAWS: usize = 1_000_000;
const COSINES: [f32; 3] = [0.95, 0.4, 0.06];
/// Tests that share the significance: all rows, cosines and sides, rounded up.
const TESTS: usize = 450;
const SIGNIFICANCE: f64 = 0.01;

/// A side of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Side {
    Both,
    Reflected,
    Transmitted,
}

impl Side {
    fn contains(self, wi: Vec3) -> bool {
        match self {
            Side::Both => true,
            Side::Reflected => wi.z > 0.0,
            Side::Transmitted => wi.z < 0.0,
        }
    }
}

/// Smooth draws of `bsdf` on one side against `pdf`.
fn chi_square(
    bsdf: &Bsdf,
    wo: Vec3,
    (grid, side): (Grid, Side),
    seed: u32,
    pdf: impl Fn(Vec3) -> f32,
) -> ChiSquare {
    let draw = |k: u32| {
        let u = [0, 1, 2].map(|d| unit(k, 4 * seed + d));
        let s = bsdf.sample(wo, u[0], [u[1], u[2]], TransportMode::Radiance)?;
        (!s.lobe.is_delta() && side.contains(s.wi)).then_some(s.wi)
    };
    chi_square::test(&grid, DRAWS, draw, |wi| if side.contains(wi) { pdf(wi) } else { 0.0 })
}

/// Bins suited to a row: equal areas where it is broad, crowded about the mirror and the refracted direction where it is narrow.
fn grids(row: &Row, wo: Vec3) -> Vec<(Grid, Side)> {
    if row.params.anisotropy > 0.0 {
        return grids_of_stretched(row, wo);
    }
    let alpha = f64::from(row.alpha());
    let eta = if row.params.thin { 1.0 } else { row.params.eta };
    // Refraction turns a facet's tilt into a deviation of about eta - 1 times it.
    let bend = if row.params.thin { 1.0 } else { f64::from(eta - 1.0).abs().min(1.0) };
    let transmits = row.params.transmission > 0.0;
    let broad = |width: f64| width > 0.06 || row.alpha() < ALPHA_SMOOTH || row.params.specular == 0.0;
    if broad(alpha) && (broad(alpha * bend) || !transmits) {
        return vec![(Grid::broad(), Side::Both)];
    }
    // Three tenths of the rings lie within an angle of about the width.
    let narrow = |axis, width: f64| Grid::about(axis, (0.25 * width * width).ln() / 0.3f64.ln());
    let mirror = if broad(alpha) { Grid::broad() } else { narrow(Vec3::new(-wo.x, -wo.y, wo.z), alpha) };
    let mut out = vec![(mirror, Side::Reflected)];
    let (fresnel, cos_t) = dielectric_refracted(wo.z, eta);
    if transmits && fresnel < 1.0 {
        out.push((narrow(refract(wo, Vec3::Z, cos_t, eta), alpha * bend), Side::Transmitted));
    }
    out
}

/// Facets stretched along x send light into a part of the cone about y that the mirror direction lies on, and the refracted one of
/// its own; as narrow as the smaller width.
fn grids_of_stretched(row: &Row, wo: Vec3) -> Vec<(Grid, Side)> {
    let eta = if row.params.thin { 1.0 } else { row.params.eta };
    let bend = if row.params.thin { 1.0 } else { f64::from(eta - 1.0).abs().min(1.0) };
    let mut alpha = f64::from(row.alpha().max(ALPHA_SMOOTH));
    if row.refracts() {
        // As far as digits allow.
        alpha = alpha.max(1e-4 / bend);
    }
    if alpha * bend > 0.06 || (alpha > 0.06 && row.params.transmission == 0.0) {
        return vec![(Grid::broad(), Side::Both)];
    }
    let narrow = |cos: f32, width: f64| Grid::about_cone(Vec3::Y, f64::from(cos), width.ln() / 0.3f64.ln());
    let mut out = vec![(narrow(-wo.y, alpha), Side::Reflected)];
    if row.params.transmission > 0.0 {
        let cos = if row.params.thin { wo.y } else { wo.y / eta };
        out.push((narrow(-cos, alpha * bend), Side::Transmitted));
    }
    out
}

fn run(rows: &[Row], seed: u32) {
    let mut failures = Vec::new();
    let mut tests = 0;
    for (i, row) in rows.iter().enumerate() {
        let bsdf = row.bsdf();
        if !bsdf.has_smooth_lobes() {
            continue;
        }
        for (j, &cos) in COSINES.iter().enumerate() {
            let wo = direction(cos, 0.6 + j as f32);
            for grid in grids(row, wo) {
                let r = chi_square(&bsdf, wo, grid, seed + 16 * i as u32 + j as u32, |wi| bsdf.pdf(wo, wi));
                tests += 1;
                if !r.accept(SIGNIFICANCE, TESTS) || (r.degrees < 5 && r.integral > 0.01) {
                    failures.push(format!("{} at {cos} {:?}: {r:?}", row.name, grid.1));
                }
            }
        }
    }
    assert!(tests > 0 && tests <= TESTS);
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn metals() {
    run(&bsdf_rows::metals(), 1_000);
}

#[test]
fn bases() {
    run(&bsdf_rows::bases(), 2_000);
}

#[test]
fn diffuse() {
    run(&bsdf_rows::diffuse(), 5_000);
}

#[test]
fn gloss() {
    run(&bsdf_rows::gloss(), 6_000);
}

#[test]
fn anisotropic() {
    run(&bsdf_rows::anisotropic(), 7_000);
}

#[test]
fn films() {
    run(&bsdf_rows::films(), 8_000);
}

#[test]
fn transmissive() {
    run(&bsdf_rows::transmissive(), 3_000);
}

#[test]
fn mixtures() {
    run(&bsdf_rows::mixtures(), 4_000);
}

#[test]
fn coats() {
    run(&bsdf_rows::coats(), 5_000);
}

#[test]
fn tilted_coats() {
    run(&bsdf_rows::tilted_coats(), 6_000);
}

#[test]
fn sheens() {
    run(&bsdf_rows::sheens(), 7_000);
}

/// The same test rejects densities that are a little wrong: scaled, of a slightly different roughness, tilted, without the
/// cosine, without one lobe.
#[test]
fn planted_errors_are_found() {
    let wo = direction(0.7, 0.2);
    let grid = (Grid::broad(), Side::Both);
    let find = |name: &str, pdf: &dyn Fn(&Row, &Bsdf, Vec3) -> f32| {
        let row = bsdf_rows::all().into_iter().find(|r| r.name == name).expect("row exists");
        let bsdf = row.bsdf();
        let right = chi_square(&bsdf, wo, grid, 77, |wi| bsdf.pdf(wo, wi));
        assert!(right.accept(SIGNIFICANCE, TESTS), "{name}: {right:?}");
        let wrong = chi_square(&bsdf, wo, grid, 77, |wi| pdf(&row, &bsdf, wi));
        assert!(!wrong.accept(SIGNIFICANCE, TESTS), "{name}: {wrong:?}");
    };
    for name in ["lambert", "metal 0.6", "rough glass 0.4", "thin 0.5", "all three"] {
        find(name, &|_, bsdf, wi| 1.01 * bsdf.pdf(wo, wi));
        find(name, &|_, bsdf, wi| bsdf.pdf(wo, wi) * (1.0 + 0.03 * (wi.x + wi.y)));
    }
    for name in ["metal 0.6", "rough glass 0.4", "thin 0.5"] {
        find(name, &|row, _, wi| {
            let mut other = *row;
            other.params.roughness *= 1.02;
            other.bsdf().pdf(wo, wi)
        });
    }
    find("lambert", &|_, _, wi| if wi.z > 0.0 { 0.5 / lumbre_core::math::PI } else { 0.0 });
    find("sheen 0.3 on lambert", &|row, bsdf, wi| {
        // As if sheen and base were chosen alike often.
        let plain = Bsdf::new(&BsdfParams { sheen: None, ..row.params });
        0.5 * (bsdf.pdf(wo, wi) + plain.pdf(wo, wi))
    });
    find("plastic 0.4", &|_, _, wi| wi.z.max(0.0) / lumbre_core::math::PI);
}
