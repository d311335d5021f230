//! FLIP against the authors' own program on small synthetic pictures.
//!
//! The expected figures come from the Python package `flip-evaluator` 1.7 (numpy arrays in, `applyMagma=False`, LDR with
//! `inputsRGB=False`), fed with the pictures that `Pattern` makes here; these use integers, + - * / in f64 and one rounding
//! to f32, so another language makes the same ones.

use super::*;

const WIDTH: usize = 48;
const HEIGHT: usize = 32;

#[derive(Clone, Copy)]
enum Pattern {
    /// A colourful pattern of stripes against itself with noise.
    Noise,
    /// Coloured squares against the same ones a pixel to the right.
    Shift,
    /// Five decades of brightness and a very bright square, against the same with 30 % noise.
    Bright,
}

/// A random number in [0, 1) for an index (the PCG hash of Jarzynski and Olano 2020).
fn random(index: usize) -> f64 {
    let state = (index as u32).wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    f64::from((word >> 22) ^ word) / 4_294_967_296.0
}

fn square(x: usize, y: usize, c: usize) -> f64 {
    let tile = x / 7 + (y / 5) * 3;
    ((tile * (c + 2) * 37) % 11) as f64 / 10.0
}

fn value(pattern: Pattern, x: usize, y: usize, c: usize) -> (f64, f64) {
    let u = random((y * WIDTH + x) * 3 + c);
    match pattern {
        Pattern::Noise => {
            let v = ((x * (c + 1) * 5 + y * (3 - c) * 7) % 256) as f64 / 255.0;
            (v, (v + (u - 0.5) * 0.2).clamp(0.0, 1.0))
        }
        Pattern::Shift => (square(x + 1, y, c), square(x, y, c)),
        Pattern::Bright => {
            let bright = if (28..31).contains(&x) && (9..12).contains(&y) { 900.0 } else { 0.0 };
            let ramp = (x * x * x) as f64 / 400.0 + 0.01;
            let v = ramp * (1.0 + 0.3 * c as f64) / (1.0 + 0.1 * y as f64) + bright;
            (v, v * (0.7 + 0.6 * u))
        }
    }
}

fn pictures(pattern: Pattern) -> (Vec<Rgb>, Vec<Rgb>) {
    let at = |x, y| {
        let [r, g, b] = [0, 1, 2].map(|c| value(pattern, x, y, c));
        (Rgb::new(r.0 as f32, g.0 as f32, b.0 as f32), Rgb::new(r.1 as f32, g.1 as f32, b.1 as f32))
    };
    (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| at(x, y))).unzip()
}

fn view(pixels: &[Rgb]) -> ImageView<'_> {
    ImageView::new(WIDTH, HEIGHT, pixels).unwrap()
}

/// The pixels (x, y) whose errors are listed below.
const PROBES: [(usize, usize); 4] = [(0, 0), (20, 7), (29, 11), (47, 31)];

#[track_caller]
fn assert_like_reference(map: &FlipMap, mean: f64, probes: [f32; 4]) {
    assert!((map.mean - mean).abs() < 2e-5, "mean {} against {mean}", map.mean);
    for ((x, y), expected) in PROBES.into_iter().zip(probes) {
        let error = map.errors[y * WIDTH + x];
        assert!((error - expected).abs() < 1e-4, "({x}, {y}): {error} against {expected}");
    }
}

#[test]
fn ldr_agrees_with_the_reference_program() {
    let rows = [
        (Pattern::Noise, PIXELS_PER_DEGREE, 0.101_261, [0.137_957, 0.067_897, 0.077_778, 0.218_960]),
        (Pattern::Noise, 30.0, 0.204_504, [0.385_526, 0.265_281, 0.287_408, 0.324_926]),
        (Pattern::Shift, PIXELS_PER_DEGREE, 0.188_906, [0.040_446, 0.177_897, 0.143_097, 0.028_384]),
        (Pattern::Shift, 30.0, 0.196_416, [0.0, 0.348_236, 0.113_377, 0.0]),
        (Pattern::Bright, PIXELS_PER_DEGREE, 0.021_129, [0.047_476, 0.000_021, 0.0, 0.0]),
        (Pattern::Bright, 30.0, 0.036_679, [0.025_909, 0.0, 0.0, 0.0]),
    ];
    for (pattern, ppd, mean, probes) in rows {
        let (reference, test) = pictures(pattern);
        let map = flip_ldr(view(&reference), view(&test), ppd).unwrap();
        assert_eq!((map.width, map.height, map.exposures), (WIDTH, HEIGHT, None));
        assert_like_reference(&map, mean, probes);
    }
}

#[test]
fn hdr_agrees_with_the_reference_program() {
    let short = (1.132_668, 2.064_631, 2);
    let long = (-8.800_406, -2.983_022, 6);
    let rows = [
        (Pattern::Noise, PIXELS_PER_DEGREE, 0.117_743, [0.227_509, 0.116_851, 0.085_112, 0.125_377], short),
        (Pattern::Noise, 30.0, 0.216_562, [0.522_827, 0.317_684, 0.234_022, 0.204_410], short),
        (Pattern::Bright, PIXELS_PER_DEGREE, 0.098_047, [0.004_526, 0.055_996, 0.066_339, 0.217_595], long),
        (Pattern::Bright, 30.0, 0.186_050, [0.000_427, 0.276_973, 0.171_618, 0.357_230], long),
    ];
    for (pattern, ppd, mean, probes, (start, stop, count)) in rows {
        let (reference, test) = pictures(pattern);
        let map = flip_hdr(view(&reference), view(&test), ppd).unwrap();
        let e = map.exposures.unwrap();
        assert!((e.start - start).abs() < 1e-5 && (e.stop - stop).abs() < 1e-5 && e.count == count, "{e:?}");
        assert_like_reference(&map, mean, probes);
    }
}

#[test]
fn equal_pictures_have_no_error() {
    let (reference, _) = pictures(Pattern::Bright);
    for flip in [flip_ldr, flip_hdr] {
        let map = flip(view(&reference), view(&reference), PIXELS_PER_DEGREE).unwrap();
        assert_eq!(map.mean, 0.0);
        assert!(map.picture().iter().all(|c| *c == magma(0.0)));
    }
}

#[test]
fn black_against_white_is_almost_the_largest_error() {
    let map = flip_ldr(
        view(&vec![Rgb::BLACK; WIDTH * HEIGHT]),
        view(&vec![Rgb::WHITE; WIDTH * HEIGHT]),
        PIXELS_PER_DEGREE,
    );
    // Green against blue is further apart than black against white: cmax is 41.28 for HyAB 203.2 and exponent 0.7.
    let expected = 0.95 + (100.0_f64.powf(0.7) - 16.51) / (41.28 - 16.51) * 0.05;
    let mean = map.unwrap().mean;
    assert!((mean - expected).abs() < 1e-4, "{mean} against {expected}");
}

#[test]
fn a_nonfinite_pixel_is_an_error_of_its_own_only() {
    let (reference, _) = pictures(Pattern::Noise);
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut test = reference.clone();
        test[5 * WIDTH + 9].g = bad;
        for flip in [flip_ldr, flip_hdr] {
            let map = flip(view(&reference), view(&test), PIXELS_PER_DEGREE).unwrap();
            assert_eq!(map.nonfinite, NonFinite { reference: 0, test: 1, either: 1 });
            assert_eq!(map.errors[5 * WIDTH + 9], 1.0);
            assert_eq!(map.mean, 1.0 / (WIDTH * HEIGHT) as f64);
        }
    }
}

#[test]
fn what_cannot_be_compared_is_an_error() {
    let (reference, test) = pictures(Pattern::Noise);
    let other = ImageView::new(HEIGHT, WIDTH, &test).unwrap();
    let error = flip_ldr(view(&reference), other, PIXELS_PER_DEGREE).unwrap_err();
    assert_eq!(error, CompareError::SizeMismatch { reference: (48, 32), test: (32, 48) });
    for ppd in [0.0, f32::NAN, f32::INFINITY] {
        let error = flip_hdr(view(&reference), view(&test), ppd).unwrap_err();
        assert!(matches!(error, CompareError::PixelsPerDegree(_)));
    }
}

#[test]
fn the_comparison_notices_a_filter_one_percent_too_wide() {
    let (reference, test) = pictures(Pattern::Shift);
    let map = flip_ldr(view(&reference), view(&test), 1.01 * PIXELS_PER_DEGREE).unwrap();
    assert!((map.mean - 0.188_906).abs() > 1e-4, "{}", map.mean);
}
