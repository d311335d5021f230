//! How fast errors fall: independent samples by the square root of their number, scrambled Sobol points faster, on a smooth integral
//! and in pictures.

use lumbre_core::sampler::SamplerKind;
use lumbre_testkit::convergence::{integral, powers_of_two, smooth_picture, smooth_pictures};

/// ANALYTIC row 44.
#[test]
fn slopes_on_a_smooth_integral() {
    let samples = powers_of_two(3, 11);
    let slope = |kind| integral(kind, &samples, 512).fit().slope;
    let (independent, sobol) = (slope(SamplerKind::Independent), slope(SamplerKind::Sobol));
    println!("slopes on a smooth integral: independent {independent:.3}, Sobol {sobol:.3}");
    assert!((independent + 0.5).abs() <= 0.03, "independent: {independent}");
    assert!(sobol <= -1.3, "Sobol: {sobol}");
}

/// Side of the pictures, pixels.
const SIDE: u32 = 16;

#[test]
fn slopes_on_a_smooth_scene() {
    let truth = smooth_picture(SamplerKind::Sobol, 99, SIDE, 8192);
    let samples = powers_of_two(2, 9);
    let slope = |kind| smooth_pictures(kind, &samples, SIDE, &truth).fit().slope;
    let (independent, sobol) = (slope(SamplerKind::Independent), slope(SamplerKind::Sobol));
    println!("slopes on a smooth scene: independent {independent:.3}, Sobol {sobol:.3}");
    assert!((independent + 0.5).abs() <= 0.05, "independent: {independent}");
    assert!(sobol <= -0.75, "Sobol: {sobol}");
}

/// A bias that does not fall shows as a slope that flattens: the same pictures against a truth that is 0.2 % off.
#[test]
fn a_bias_is_found() {
    let mut truth = smooth_picture(SamplerKind::Sobol, 99, SIDE, 2048);
    truth.iter_mut().for_each(|v| *v *= 1.002);
    let sobol = smooth_pictures(SamplerKind::Sobol, &powers_of_two(2, 9), SIDE, &truth).fit().slope;
    assert!(sobol > -0.75, "Sobol: {sobol}");
}
