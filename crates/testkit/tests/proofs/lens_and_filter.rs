//! Chi-square of points on the camera's lens, which are uniform over its disc, and of positions in a pixel, which follow the filter.

use glam::Vec3;
use lumbre_core::Camera;
use lumbre_core::filter::{Filter, FilterKind};
use lumbre_core::hash::unit;
use lumbre_testkit::chi_square::ChiSquare;
use lumbre_testkit::square::{self, Bins};
use std::f64::consts::PI;

const DRAWS: usize = 1_000_000;
const SIGNIFICANCE: f64 = 0.01;
/// Tests that share it: two lenses, four filters.
const TESTS: usize = 6;

fn lens(radius: f32, eye: Vec3, target: Vec3) -> Camera {
    let camera = Camera::look_at(eye, target, Vec3::Y, 0.7, 1.5);
    Camera { lens_radius: radius, focus_distance: 3.0, ..camera }
}

/// Points of a lens against a density over its area (1 is uniform), in coordinates (r²/R², azimuth) that keep areas. The points are
/// taken where rays of the camera begin.
fn lens_test(camera: &Camera, density: impl Fn(f64, f64) -> f64) -> ChiSquare {
    let draw = |k: u32| {
        let u = [unit(k, 21), unit(k, 22)];
        let offset = camera.lens_point(u);
        assert_eq!(camera.ray([0.3, 0.8], u, 0.0).origin, camera.origin + offset, "rays begin on the lens");
        assert!(offset.dot(camera.forward).abs() <= 1e-5 * camera.lens_radius, "the lens is flat");
        let [x, y] = [offset.dot(camera.right), offset.dot(camera.up)].map(f64::from);
        let r = f64::from(camera.lens_radius);
        // The rim may round to either side.
        let r2 = (x * x + y * y) / (r * r);
        let r2 = if r2 < 1.0 + 1e-6 { r2.min(1.0) } else { r2 };
        Some([r2, (y.atan2(x) / (2.0 * PI)).rem_euclid(1.0)])
    };
    square::test(Bins { columns: 32, rows: 36 }, DRAWS, draw, density)
}

fn lenses() -> [Camera; 2] {
    [
        lens(0.05, Vec3::new(0.0, 0.0, 4.0), Vec3::ZERO),
        lens(2.5, Vec3::new(7.0, 3.0, -2.0), Vec3::new(-1.0, 0.5, 2.0)),
    ]
}

#[test]
fn lens_points_are_uniform() {
    for camera in lenses() {
        let r = lens_test(&camera, |_, _| 1.0);
        assert!(r.accept(SIGNIFICANCE, TESTS) && r.accepted == 1.0, "{r:?}");
    }
}

/// A vignette of two per cent, a lens pulled to one side, and one 1 % too large are seen.
#[test]
fn lenses_that_are_a_little_wrong_are_found() {
    let [camera, _] = lenses();
    assert!(!lens_test(&camera, |r2, _| 1.02 - 0.04 * r2).accept(SIGNIFICANCE, TESTS));
    let pulled = |r2: f64, v: f64| 1.0 + 0.03 * r2.sqrt() * (2.0 * PI * v).cos();
    assert!(!lens_test(&camera, pulled).accept(SIGNIFICANCE, TESTS));
    assert!(
        !lens_test(&camera, |r2, _| if r2 < 0.98 { 1.0 / 0.98 } else { 0.0 }).accept(SIGNIFICANCE, TESTS)
    );
}

/// Offsets drawn from a filter against a shape given in one dimension, over the square of the filter's support.
fn filter_test(kind: FilterKind, shape: impl Fn(f64) -> f64) -> ChiSquare {
    let filter = Filter::new(kind);
    let r = f64::from(kind.radius());
    let draw = |k: u32| {
        let offset = filter.sample([unit(k, 31), unit(k, 32)]);
        Some(offset.map(|x| 0.5 + 0.5 * f64::from(x) / r))
    };
    let value = |t: f64| shape(r * (2.0 * t - 1.0));
    const STEPS: usize = 1 << 14;
    let norm: f64 = (0..STEPS).map(|i| value((i as f64 + 0.5) / STEPS as f64)).sum::<f64>() / STEPS as f64;
    square::test(Bins { columns: 24, rows: 24 }, DRAWS, draw, |x, y| value(x) * value(y) / (norm * norm))
}

const KINDS: [FilterKind; 4] =
    [FilterKind::Box, FilterKind::Tent, FilterKind::Gaussian, FilterKind::BlackmanHarris];

#[test]
fn positions_in_a_pixel_follow_the_filter() {
    for kind in KINDS {
        let r = filter_test(kind, |x| f64::from(kind.value(x as f32)));
        assert!(r.accept(SIGNIFICANCE, TESTS) && r.accepted == 1.0, "{kind:?}: {r:?}");
    }
}

/// Filters wider by 2 % and filters that lean by 3 % at half their radius are seen; so is one filter taken for another.
#[test]
fn filters_that_are_a_little_wrong_are_found() {
    for kind in KINDS {
        let r = f64::from(kind.radius());
        let value = |x: f64| f64::from(kind.value(x as f32));
        let wide = filter_test(kind, |x| value(x / 1.02));
        // The support of the box itself would have to grow, which the bins do not see: its test is the next one.
        assert!(kind == FilterKind::Box || !wide.accept(SIGNIFICANCE, TESTS), "{kind:?}: {wide:?}");
        let leaning = filter_test(kind, |x| value(x) * (1.0 + 0.03 * x / (0.5 * r)));
        assert!(!leaning.accept(SIGNIFICANCE, TESTS), "{kind:?}: {leaning:?}");
    }
    let taken = filter_test(FilterKind::BlackmanHarris, |x| f64::from(FilterKind::Gaussian.value(x as f32)));
    assert!(!taken.accept(SIGNIFICANCE, TESTS), "{taken:?}");
}
