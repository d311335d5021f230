//! Furnace of thin films and of anisotropic facets, bounded on both sides.

use lumbre_core::Spectrum;
use lumbre_core::bsdf::{Bsdf, BsdfParams, FilmParams};
use lumbre_testkit::furnace::{direction, furnace};

const COSINES: [f32; 6] = [1.0, 0.85, 0.6, 0.3, 0.1, 0.03];
const DRAWS: u32 = 2_048;

/// Least and most of what comes back in the brightest band, over all films and angles.
fn extremes(params: BsdfParams) -> (f64, f64) {
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    for ior in [1.2, 1.33, 1.8, 2.4] {
        for thickness_nm in [80.0, 150.0, 220.0, 300.0, 400.0, 550.0, 800.0, 1_200.0] {
            let film = FilmParams { factor: 1.0, ior, thickness_nm };
            let bsdf = Bsdf::new(&BsdfParams { film: Some(film), ..params });
            for cos in COSINES {
                let total = furnace(&bsdf, direction(cos, 0.4), DRAWS).total;
                let brightest = total.into_iter().fold(0.0, f64::max);
                least = least.min(brightest);
                most = most.max(brightest);
            }
        }
    }
    (least, most)
}

fn white(roughness: f32, anisotropy: f32) -> BsdfParams {
    BsdfParams { base_color: Spectrum::WHITE, roughness, anisotropy, ..BsdfParams::default() }
}

#[test]
fn bases_under_films_keep_what_they_say() {
    let (least, most) = extremes(white(0.0, 0.0));
    assert!(least > 0.995 && most < 1.003, "smooth: {least} {most}");
    let (mut all_least, mut all_most) = (f64::INFINITY, 0.0f64);
    for roughness in [0.1, 0.3, 0.5, 0.75, 1.0] {
        for anisotropy in [0.0, 0.7] {
            let (least, most) = extremes(white(roughness, anisotropy));
            assert!(least > 0.92 && most < 1.005, "{roughness} {anisotropy}: {least} {most}");
            (all_least, all_most) = (all_least.min(least), all_most.max(most));
        }
    }
    // Tight: a loss or gain of 2 % more would be found.
    assert!(all_least * 0.98 < 0.92 && all_most * 1.02 > 1.005, "{all_least} {all_most}");
}

/// White metal, glass and walls do not change under a film: mirrors stay mirrors, and what a boundary does not reflect it passes.
#[test]
fn films_take_nothing() {
    for roughness in [0.0, 0.4] {
        let metal = BsdfParams { metallic: 1.0, ..white(roughness, 0.0) };
        let wall = BsdfParams { transmission: 1.0, ..white(roughness, 0.0) };
        for params in [metal, wall] {
            let (least, most) = extremes(params);
            assert!(least > 0.995 && most < 1.005, "{roughness} {params:?}: {least} {most}");
        }
    }
    let glass = BsdfParams { transmission: 1.0, thin: false, ..white(0.0, 0.0) };
    for eta in [1.5, 1.0 / 1.5] {
        let (least, most) = extremes(BsdfParams { eta, ..glass });
        assert!(least > 0.9995 && most < 1.0005, "{eta}: {least} {most}");
    }
}

/// Least and most of the white furnace over widths, directions and strengths.
fn stretched(params: BsdfParams) -> (f64, f64) {
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    for roughness in [0.0, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9] {
        for anisotropy in [0.15, 0.4, 0.7, 1.0] {
            let bsdf = Bsdf::new(&BsdfParams { roughness, anisotropy, ..params });
            for cos in COSINES {
                for phi in [0.0, 0.5, 1.1, 1.57] {
                    let total = furnace(&bsdf, direction(cos, phi), DRAWS).total[0];
                    least = least.min(total);
                    most = most.max(total);
                }
            }
        }
    }
    (least, most)
}

#[test]
fn anisotropic_surfaces_keep_what_they_say() {
    let metal = BsdfParams { metallic: 1.0, ..white(0.0, 0.0) };
    let wall = BsdfParams { transmission: 1.0, ..white(0.0, 0.0) };
    let rows = [
        ("metal", metal, 0.985, 1.009),
        ("thin wall", wall, 0.985, 1.009),
        ("plastic", white(0.0, 0.0), 0.885, 1.009),
    ];
    for (name, params, low, high) in rows {
        let (least, most) = stretched(params);
        assert!(least > low && most < high, "{name}: {least} {most}");
        // Tight: 2 % more would be found.
        assert!(least * 0.98 < low && most * 1.02 > high, "{name}: {least} {most}");
    }
}
